//! From keys to commands, by the table of commands alone.

use egui::{Event, Modifiers};

use super::context::Outbox;
use crate::editor::{Action, COMMANDS, Command, Key, SessionCommand, Shortcut, TravelCommand};

/// Sends the commands whose keys were pressed in this turn.
///
/// A button that has the keyboard takes the space bar for itself; a view (`view_focused`) leaves it. Escape
/// out of a text field (`was_typing` before this turn) does nothing else.
pub fn collect(ctx: &egui::Context, outbox: &Outbox, view_focused: bool, was_typing: bool) {
    let typing = ctx.text_edit_focused();
    let on_button = !view_focused && ctx.memory(|memory| memory.focused().is_some());
    let (mut pasted, mut in_place) = (None, false);
    let commands: Vec<Command> = ctx.input(|input| {
        let mut found = Vec::new();
        for event in &input.events {
            match event {
                Event::Copy if !typing => found.push(SessionCommand::Copy.into()),
                Event::Cut if !typing => found.push(SessionCommand::Cut.into()),
                Event::Paste(text) if !typing => {
                    pasted = Some(text.clone());
                    in_place = input.modifiers.shift;
                }
                Event::Key { key: egui::Key::Space, .. } if on_button => {}
                Event::Key { key: egui::Key::Escape, .. } if was_typing => {}
                Event::Key { key, pressed: true, modifiers, repeat, .. } => {
                    let command = command_of(*key, *modifiers, typing);
                    found.extend(command.filter(|command| !repeat || repeats(*command)));
                }
                _ => {}
            }
        }
        found
    });
    commands.into_iter().for_each(|command| outbox.command(command));
    if let Some(text) = pasted {
        outbox.act(if in_place { Action::PasteInPlace(text) } else { Action::Paste(text) });
    }
}

/// Holding the key down goes on and on.
fn repeats(command: Command) -> bool {
    matches!(
        command,
        Command::Session(
            SessionCommand::StepForward
                | SessionCommand::StepBack
                | SessionCommand::NextEvent
                | SessionCommand::EventBack
                | SessionCommand::Travel(
                    TravelCommand::NextEventOfSelection | TravelCommand::EventBackOfSelection
                )
                | SessionCommand::MoveUp
                | SessionCommand::MoveDown
                | SessionCommand::Undo
                | SessionCommand::Redo
        )
    )
}

fn command_of(key: egui::Key, modifiers: Modifiers, typing: bool) -> Option<Command> {
    let row = COMMANDS.iter().find(|row| {
        row.shortcuts.iter().any(|shortcut| {
            (!typing || shortcut.works_while_typing()) && is_pressed(*shortcut, key, modifiers)
        })
    });
    row.map(|row| row.command)
}

fn is_pressed(shortcut: Shortcut, key: egui::Key, modifiers: Modifiers) -> bool {
    let Some(wanted) = egui_key(shortcut.key) else { return false };
    // On some keyboards these need Shift, on others not.
    let any_shift = matches!(shortcut.key, Key::Char('?' | '+'));
    wanted == key
        && modifiers.command == shortcut.ctrl
        && !modifiers.alt
        && (any_shift || modifiers.shift == shortcut.shift)
}

fn egui_key(key: Key) -> Option<egui::Key> {
    match key {
        Key::Char(',') => Some(egui::Key::Comma),
        Key::Char('.') => Some(egui::Key::Period),
        Key::Char('+') => Some(egui::Key::Plus),
        Key::Char('-') => Some(egui::Key::Minus),
        Key::Char('?') => Some(egui::Key::Questionmark),
        Key::Char('[') => Some(egui::Key::OpenBracket),
        Key::Char(']') => Some(egui::Key::CloseBracket),
        Key::Char(c) => egui::Key::from_name(c.encode_utf8(&mut [0; 4])),
        Key::Space => Some(egui::Key::Space),
        Key::Delete => Some(egui::Key::Delete),
        Key::Escape => Some(egui::Key::Escape),
        Key::End => Some(egui::Key::End),
        Key::Home => Some(egui::Key::Home),
        Key::Up => Some(egui::Key::ArrowUp),
        Key::Down => Some(egui::Key::ArrowDown),
        Key::Function(n) => egui::Key::from_name(&format!("F{n}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shortcut_has_a_key_and_none_is_given_twice() {
        let mut seen: Vec<Shortcut> = Vec::new();
        for shortcut in COMMANDS.iter().flat_map(|row| row.shortcuts) {
            assert!(egui_key(shortcut.key).is_some(), "{shortcut}");
            assert!(!seen.contains(shortcut), "{shortcut} twice");
            seen.push(*shortcut);
        }
    }
}
