//! The steps of a script for the window, as `--do` gives them: text in, commands out. docs/scripts.md lists them.

use super::dock::Panel;
use crate::design::{TOOLS, Tool};
use crate::editor::{COMMANDS, Command, ViewCommand, WindowCommand, parse_number};
use crate::export::FORMATS;
use crate::sim::Method;
use crate::view::OVERLAYS;

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Step {
    Command(Command),
    Select(String),
    Dt(String),
    Method(Method),
    Panel(Panel),
    Event(usize),
    /// A tool with its default values but these.
    Build(usize, Vec<(String, f64)>),
    /// Runs a study and waits for it.
    Study,
}

/// A step and how often it is taken: `id*count`.
pub(super) fn counted_step(text: &str) -> Result<(Step, usize), String> {
    /// More than anyone waits for.
    const MOST: usize = 100_000;
    let (name, count) = match text.rsplit_once('*') {
        Some((name, count)) => (name.trim(), Some(count.trim())),
        None => (text, None),
    };
    let step = match name.strip_prefix("build:") {
        Some(built) => build(built).map_err(|problem| format!("--do {name}: {problem}"))?,
        None => step(name).ok_or_else(|| format!("--do: there is no step `{name}`"))?,
    };
    match count.map_or(Ok(1), str::parse) {
        Ok(count @ 1..=MOST) => Ok((step, count)),
        _ => Err(format!("--do {text}: the count after * must be a whole number from 1 to {MOST}")),
    }
}

fn step(text: &str) -> Option<Step> {
    if let Some((kind, value)) = text.split_once(':') {
        return match kind {
            "select" => Some(Step::Select(value.to_owned())),
            "dt" => Some(Step::Dt(value.to_owned())),
            "export" => {
                let index = FORMATS.iter().position(|format| format.id == value)?;
                Some(Step::Command(WindowCommand::Export(Some(index)).into()))
            }
            "method" => Some(Step::Method(Method::from_name(value)?)),
            "event" => Some(Step::Event(value.parse().ok()?)),
            "tab" if value == "problems" => Some(Step::Panel(Panel::Problems)),
            "tab" if value == "xml" => Some(Step::Panel(Panel::Xml)),
            "tab" if value == "accuracy" => Some(Step::Panel(Panel::Accuracy)),
            "tab" if value == "events" => Some(Step::Panel(Panel::Events)),
            "overlay" => {
                let index = OVERLAYS.iter().position(|overlay| overlay.id == value)?;
                Some(Step::Command(ViewCommand::ToggleOverlay(index).into()))
            }
            _ => None,
        };
    }
    if text == "study" {
        return Some(Step::Study);
    }
    let tool =
        || TOOLS.iter().position(|tool| tool.id == text).map(|index| WindowCommand::DesignTool(index).into());
    let row = COMMANDS.iter().find(|row| row.id == text).map(|row| row.command);
    row.or_else(tool).map(Step::Command)
}

/// `rack;Rows=3;Ball radius=0.2`; the error says which part of it is wrong, and what there is instead.
fn build(text: &str) -> Result<Step, String> {
    let (id, values) = text.split_once(';').map_or((text, None), |(id, values)| (id, Some(values)));
    let id = id.trim();
    let found = TOOLS.iter().enumerate().find(|(_, tool)| tool.id == id);
    let (index, tool) = found.ok_or_else(|| {
        let ids: Vec<&str> = TOOLS.iter().map(|tool| tool.id).collect();
        format!("there is no tool `{id}`; there are: {}", ids.join(", "))
    })?;
    let value = |part: &str| {
        let (label, typed) =
            part.split_once('=').ok_or_else(|| format!("`{}` is not LABEL=VALUE", part.trim()))?;
        let (label, typed) = (label.trim(), typed.trim());
        if tool.inputs.iter().all(|input| input.label != label) {
            return Err(unknown_label(tool, label));
        }
        let number = parse_number(typed).ok_or_else(|| format!("{label}: `{typed}` is not a number"))?;
        Ok((label.to_owned(), number))
    };
    let values = values.into_iter().flat_map(|values| values.split(';')).map(value);
    Ok(Step::Build(index, values.collect::<Result<Vec<_>, String>>()?))
}

fn unknown_label(tool: &Tool, label: &str) -> String {
    let labels: Vec<&str> = tool.inputs.iter().map(|input| input.label).collect();
    if labels.is_empty() {
        return format!("{} asks for nothing, so not for `{label}` either", tool.id);
    }
    format!("{} has no value `{label}`; it has: {}", tool.id, labels.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::editor::SessionCommand;

    #[test]
    fn steps_are_read_and_unknown_ones_refused() {
        assert_eq!(step("next_event"), Some(Step::Command(SessionCommand::NextEvent.into())));
        assert_eq!(step("select:5853"), Some(Step::Select("5853".into())));
        assert_eq!(step("tab:problems"), Some(Step::Panel(Panel::Problems)));
        assert!(matches!(build("rack;Rows=3"), Ok(Step::Build(_, values)) if values[0].1 == 3.0));
        assert!(matches!(counted_step("build:rack;Rows=3"), Ok((Step::Build(..), 1))));
        assert_eq!(step("fly"), None);
        assert_eq!(step("overlay:nothing"), None);
        assert_eq!(counted_step("next_event*3"), Ok((Step::Command(SessionCommand::NextEvent.into()), 3)));
        for (text, reason) in [
            ("next_event*-1", "count"),
            ("next_event*0", "count"),
            ("next_event*x", "count"),
            ("fly*2", "`fly`"),
            ("build:castle", "there is no tool `castle`; there are: "),
            ("build:room;Width x=abc", "Width x: `abc` is not a number"),
            ("build:room;Width x=", "Width x: `` is not a number"),
            ("build:room;Nope=3", "room has no value `Nope`; it has: Width x, Height y, Depth z, Bounce"),
            ("build:room;wide", "`wide` is not LABEL=VALUE"),
        ] {
            let error = counted_step(text).unwrap_err();
            assert!(error.contains(reason), "{text}: {error}");
        }
    }
}
