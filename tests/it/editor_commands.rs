//! The command table is complete, consistent and says why a command cannot be used.

use std::collections::BTreeMap;

use polyscene::editor::{
    Action, COMMANDS, Command, Menu, NoticeLevel, Outcome, SessionCommand, Shortcut, ViewCommand,
    WindowCommand, info, palette,
};
use polyscene::sim::Method;

use super::editor_support::Bench;

#[test]
fn names_are_unique_and_written_in_one_style() {
    let mut ids = BTreeMap::new();
    let mut labels = BTreeMap::new();
    for row in COMMANDS {
        assert!(ids.insert(row.id, ()).is_none(), "id {} twice", row.id);
        assert!(labels.insert(row.label, ()).is_none(), "label {} twice", row.label);
        assert!(row.id.bytes().all(|b| b.is_ascii_lowercase() || b == b'_'), "{}", row.id);
        assert!(row.label.starts_with(char::is_uppercase), "{}", row.label);
        assert!(row.help.starts_with(char::is_uppercase) && !row.help.ends_with('.'), "{}", row.help);
        assert!(!row.help.is_empty() && row.help.len() < 110, "{}", row.help);
    }
}

#[test]
fn every_command_has_one_row() {
    for row in COMMANDS {
        assert_eq!(info(row.command).map(|found| found.id), Some(row.id), "{:?} has two rows", row.command);
    }
}

#[test]
fn no_two_commands_share_a_key() {
    let mut taken: BTreeMap<String, &str> = BTreeMap::new();
    for row in COMMANDS {
        for shortcut in row.shortcuts {
            if let Some(other) = taken.insert(shortcut.to_string(), row.id) {
                panic!("{shortcut} means {other} and {}", row.id);
            }
        }
    }
    assert_eq!(taken.get("Space"), Some(&"play_pause"));
    assert_eq!(taken.get("Ctrl+Shift+Z"), Some(&"redo"));
}

#[test]
fn menus_list_their_groups_in_order() {
    for menu in Menu::ALL {
        let groups: Vec<u8> = COMMANDS.iter().filter(|row| row.menu == menu).map(|row| row.group).collect();
        assert!(!groups.is_empty(), "{} is empty", menu.label());
        assert!(groups.is_sorted(), "{}: {groups:?}", menu.label());
    }
    let menus: Vec<Menu> = COMMANDS.iter().map(|row| row.menu).collect();
    assert!(menus.is_sorted(), "the table is in menu order");
}

#[test]
fn a_text_field_keeps_its_own_keys() {
    assert!(Shortcut::ctrl('S').works_while_typing());
    assert!(!Shortcut::ctrl('Z').works_while_typing());
    assert!(!Shortcut::plain(polyscene::editor::Key::Char('R')).works_while_typing());
    assert!(!Shortcut::plain(polyscene::editor::Key::Delete).works_while_typing());
}

#[test]
fn a_disabled_command_is_refused_with_its_reason() {
    let mut bench = Bench::new();
    let mut refused = 0;
    for row in COMMANDS {
        if let Err(reason) = (row.enabled)(&bench.session) {
            let refusal = bench.session.refusal(row.command);
            assert!(refusal.is_some_and(|text| text.contains(reason)), "{}", row.id);
            assert!(row.tooltip(&bench.session).contains(reason));
            refused += 1;
            // those of the views and the window never reach the session
            let Command::Session(command) = row.command else { continue };
            let before = bench.session.document_state();
            let outcome = bench.run(command);
            assert!(matches!(&outcome, Outcome::Refused(text) if text.contains(reason)), "{}", row.id);
            assert_eq!(bench.session.document_state(), before);
            let notices = bench.session.take_notices();
            assert_eq!(notices.len(), 1);
            assert_eq!(notices[0].level, NoticeLevel::Warning);
        }
    }
    assert!(refused > 10, "an empty scene disables more than {refused} commands");
}

#[test]
fn every_enabled_command_of_the_session_is_carried_out() {
    for row in COMMANDS {
        let mut bench = Bench::open();
        bench.run(SessionCommand::SelectAll);
        let Command::Session(command) = row.command else { continue };
        if (row.enabled)(&bench.session).is_ok() {
            assert_eq!(bench.run(command), Outcome::Done, "{}", row.id);
        }
    }
}

#[test]
fn undo_says_what_it_takes_back() {
    let mut bench = Bench::open();
    let row = info(SessionCommand::Undo).unwrap();
    assert_eq!(row.label_now(&bench.session), "Undo");
    bench.change(7, polyscene::scene::BodyChange::Mass(3.0));
    assert_eq!(row.label_now(&bench.session), "Undo: Change mass of 7");
}

#[test]
fn the_palette_finds_commands_samples_and_overlays_by_their_letters() {
    let bench = Bench::open();
    let best = |query: &str| palette(&bench.session, query).first().map(|entry| entry.command);
    assert_eq!(best("save as"), Some(SessionCommand::SaveAs.into()));
    assert_eq!(best("next ev"), Some(SessionCommand::NextEvent.into()));
    assert!(matches!(best("sample orb"), Some(Command::Session(SessionCommand::OpenSample(_)))));
    assert!(matches!(best("overlay veloc"), Some(Command::View(ViewCommand::ToggleOverlay(_)))));
    // A word that is typed whole comes before letters that happen to be there.
    assert!(matches!(best("ramp"), Some(Command::Window(WindowCommand::DesignTool(_)))));
    assert!(palette(&bench.session, "qqqq").is_empty());
    assert!(palette(&bench.session, "").len() > COMMANDS.len());
}

#[test]
fn another_method_is_told_to_the_runner_and_goes_to_the_start() {
    let mut bench = Bench::open();
    bench.step();
    bench.act(Action::SetMethod(Method::Exact));
    assert!(bench.sent().is_empty(), "it is the method already");
    bench.act(Action::SetMethod(Method::Fixed));
    assert_eq!(bench.sent(), ["Method(Fixed)", "Reset"]);
    assert!(bench.session.playback().is_at_start());
    assert_eq!(bench.session.playback().method(), Method::Fixed);
    assert!(bench.notices().contains("the method is now fixed"));
}
