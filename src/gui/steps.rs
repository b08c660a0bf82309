//! The steps of a script for the window, as `--do` gives them: text in, commands out. docs/scripts.md lists them.

use super::dock::Panel;
use crate::design::TOOLS;
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
    let step = step(name).ok_or_else(|| format!("--do: there is no step `{name}`"))?;
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
            "build" => build(value),
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

/// `rack;Rows=3;Ball radius=0.2`
fn build(text: &str) -> Option<Step> {
    let mut parts = text.split(';');
    let id = parts.next()?.trim();
    let index = TOOLS.iter().position(|tool| tool.id == id)?;
    let values = parts.map(|part| {
        let (label, value) = part.split_once('=')?;
        let known = TOOLS.get(index)?.inputs.iter().any(|input| input.label == label.trim());
        known.then(|| Some((label.trim().to_owned(), parse_number(value)?))).flatten()
    });
    Some(Step::Build(index, values.collect::<Option<Vec<_>>>()?))
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
        assert!(matches!(step("build:rack;Rows=3"), Some(Step::Build(_, values)) if values[0].1 == 3.0));
        assert_eq!(step("build:rack;Wings=2"), None);
        assert_eq!(step("build:castle"), None);
        assert_eq!(step("fly"), None);
        assert_eq!(step("overlay:nothing"), None);
        assert_eq!(counted_step("next_event*3"), Ok((Step::Command(SessionCommand::NextEvent.into()), 3)));
        for (text, reason) in [
            ("next_event*-1", "count"),
            ("next_event*0", "count"),
            ("next_event*x", "count"),
            ("fly*2", "`fly`"),
        ] {
            let error = counted_step(text).unwrap_err();
            assert!(error.contains(reason), "{text}: {error}");
        }
    }
}
