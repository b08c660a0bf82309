//! What the table of commands holds for each: names, keys, help, and when it can be used.

use super::Session;
use super::command::{Command, Menu, SessionCommand, Shortcut, ViewCommand, WindowCommand};

/// One row of [`super::COMMANDS`].
#[derive(Clone, Copy)]
pub struct CommandInfo {
    pub command: Command,
    /// Stable name for tests and logs.
    pub id: &'static str,
    /// Sentence case; ends in `…` when a dialog follows.
    pub label: &'static str,
    pub menu: Menu,
    /// Rows of the same menu with another group are parted by a line.
    pub group: u8,
    /// The first is the one shown.
    pub shortcuts: &'static [Shortcut],
    pub icon: Option<char>,
    /// One sentence.
    pub help: &'static str,
    /// `Err` says why the command cannot be used now.
    pub enabled: fn(&Session) -> Result<(), &'static str>,
}

impl CommandInfo {
    /// What to write on a button or menu entry now: `Undo` also says what.
    pub fn label_now(&self, session: &Session) -> String {
        let subject = match self.command {
            Command::Session(SessionCommand::Undo) => session.undo_label(),
            Command::Session(SessionCommand::Redo) => session.redo_label(),
            _ => None,
        };
        subject.map_or_else(|| self.label.to_owned(), |subject| format!("{}: {subject}", self.label))
    }

    /// Help, why it is disabled now, and the shortcut, for a tooltip.
    pub fn tooltip(&self, session: &Session) -> String {
        let mut text = format!("{}. {}", self.label.trim_end_matches('…'), self.help);
        if let Some(shortcut) = self.shortcuts.first() {
            text.push_str(&format!(" ({shortcut})"));
        }
        if let Err(reason) = (self.enabled)(session) {
            text.push_str(&format!("\nNot now: {reason}."));
        }
        text
    }
}

/// A row without keys, that is never disabled; the methods below add the rest.
pub(super) const fn row(
    menu: Menu,
    group: u8,
    id: &'static str,
    label: &'static str,
    help: &'static str,
) -> CommandInfo {
    CommandInfo {
        command: Command::Window(WindowCommand::About),
        id,
        label,
        menu,
        group,
        shortcuts: &[],
        icon: None,
        help,
        enabled: |_| Ok(()),
    }
}

impl CommandInfo {
    pub(super) const fn session(mut self, command: SessionCommand) -> Self {
        self.command = Command::Session(command);
        self
    }

    pub(super) const fn view(mut self, command: ViewCommand) -> Self {
        self.command = Command::View(command);
        self
    }

    pub(super) const fn window(mut self, command: WindowCommand) -> Self {
        self.command = Command::Window(command);
        self
    }

    pub(super) const fn icon(mut self, icon: char) -> Self {
        self.icon = Some(icon);
        self
    }

    pub(super) const fn keys(mut self, shortcuts: &'static [Shortcut]) -> Self {
        self.shortcuts = shortcuts;
        self
    }

    pub(super) const fn when(mut self, enabled: fn(&Session) -> Result<(), &'static str>) -> Self {
        self.enabled = enabled;
        self
    }
}
