//! Everything that can be done by name: the command table, samples, recent files and overlays.

use super::catalog::COMMANDS;
use super::{Command, SAMPLES, SampleGroup, Session, SessionCommand, ViewCommand, WindowCommand};
use crate::design::TOOLS;
use crate::scene::shown_path;
use crate::view::OVERLAYS;

/// One line of the command palette.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PaletteEntry {
    pub command: Command,
    pub label: String,
    /// One sentence.
    pub help: String,
    /// Why it cannot be used now.
    pub disabled: Option<&'static str>,
}

/// All lines whose label has the letters of `query` in this order, best first: an empty query gives all.
pub fn palette(session: &Session, query: &str) -> Vec<PaletteEntry> {
    let mut found: Vec<(Rank, PaletteEntry)> =
        entries(session).filter_map(|entry| Some((rank(query, &entry.label)?, entry))).collect();
    found.sort_by_key(|(rank, _)| *rank);
    found.into_iter().map(|(_, entry)| entry).collect()
}

fn entries(session: &Session) -> impl Iterator<Item = PaletteEntry> {
    let commands = COMMANDS.iter().map(|row| PaletteEntry {
        command: row.command,
        label: row.label_now(session),
        help: row.help.to_owned(),
        disabled: (row.enabled)(session).err(),
    });
    let samples = SAMPLES.iter().enumerate().map(|(index, sample)| {
        let kind = if sample.group == SampleGroup::HardCase { "Hard case" } else { "Sample" };
        entry(SessionCommand::OpenSample(index), format!("{kind}: {}", sample.title), sample.shows.to_owned())
    });
    let recent = session.settings().recent.iter().enumerate().map(|(index, path)| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        entry(SessionCommand::OpenRecent(index), format!("Open recent: {name}"), shown_path(path))
    });
    let overlays = OVERLAYS.iter().enumerate().map(|(index, overlay)| {
        entry(
            ViewCommand::ToggleOverlay(index),
            format!("Overlay: {}", overlay.label),
            overlay.help.to_owned(),
        )
    });
    let tools = TOOLS.iter().enumerate().map(|(index, tool)| PaletteEntry {
        disabled: session.can_use_tool(index).err(),
        ..entry(
            WindowCommand::DesignTool(index),
            format!("{}: {}", tool.group.label(), tool.label),
            tool.help.to_owned(),
        )
    });
    commands.chain(tools).chain(samples).chain(recent).chain(overlays)
}

fn entry(command: impl Into<Command>, label: String, help: String) -> PaletteEntry {
    PaletteEntry { command: command.into(), label, help, disabled: None }
}

/// What is found sooner comes first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Rank {
    /// A word begins with what was typed.
    Word,
    /// It stands inside a word.
    Inside,
    /// Its letters are there in this order, so far apart.
    Scattered(usize),
}

/// How well a label fits; `None` where it does not.
fn rank(query: &str, label: &str) -> Option<Rank> {
    let (query, label) = (query.trim().to_lowercase(), label.to_lowercase());
    let mut places = label.match_indices(&query).map(|(at, _)| at).peekable();
    if places.peek().is_none() {
        return distance(&query, &label).map(Rank::Scattered);
    }
    let begins_word = |at: usize| !label[..at].ends_with(char::is_alphanumeric);
    Some(if places.any(begins_word) { Rank::Word } else { Rank::Inside })
}

/// How many letters of `label` lie between or before those of `query`; `None` when they are not all there
/// in this order.
fn distance(query: &str, label: &str) -> Option<usize> {
    let mut letters = label.chars().flat_map(char::to_lowercase);
    let wanted = query.chars().flat_map(char::to_lowercase).filter(|c| !c.is_whitespace());
    let mut skipped = 0;
    for letter in wanted {
        skipped += letters.by_ref().position(|c| c == letter)?;
    }
    Some(skipped)
}
