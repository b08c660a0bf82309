//! The timeline, the ledger and the controls of time, by their accessible labels.

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use polyscene::record::{EVENT_COLUMNS, Of};

use crate::gui_files::Dropped;
use crate::gui_support::Window;

pub fn type_time(window: &mut Window, text: &str) {
    let field = window.harness.get_by_role_and_label(Role::TextInput, "t");
    field.focus();
    window.harness.run();
    window.key_with(Modifiers::COMMAND, Key::A);
    window.harness.event(egui::Event::Text(text.into()));
    window.key(Key::Enter);
}

#[test]
fn a_typed_time_is_gone_to_in_both_directions() {
    let mut window = Window::thesis();
    type_time(&mut window, "2.5");
    assert_eq!(window.frame().time, 2.5);
    let count = window.frame().event_count;
    assert!(count > 0);
    type_time(&mut window, "0,5");
    assert_eq!(window.frame().time, 0.5);
    assert_eq!((window.frame().recorded.to, window.frame().ledger.len() as u64), (2.5, count));
    type_time(&mut window, "soon");
    assert!(window.has_containing("is not a time"));
    assert_eq!(window.frame().time, 0.5);
}

#[test]
fn the_timeline_is_clicked_and_stepped_through_by_arrows() {
    let mut window = Window::thesis();
    type_time(&mut window, "4");
    let line = window.harness.get_by_label("Timeline of the run");
    let rect = line.rect();
    let half = egui::pos2(rect.left() + 12.0 + 0.5 * (rect.width() - 116.0), rect.center().y);
    window.harness.drag_at(half);
    window.harness.run();
    window.harness.drop_at(half);
    window.harness.run();
    let time = window.frame().time;
    assert!((time - 2.0).abs() < 0.02, "{time}");
    let index = window.frame().dt_index;
    window.key(Key::ArrowRight);
    assert!(window.frame().time > time);
    window.key(Key::ArrowRight);
    assert!(window.frame().dt_index > index);
    let events = window.frame().event_count;
    window.key_with(Modifiers::SHIFT, Key::ArrowLeft);
    assert!(window.frame().event_count <= events);
}

#[test]
fn tile_crossings_of_the_selected_body_are_marked_on_request() {
    let mut window = Window::sample("gas");
    let body = window.scene().bodies.iter().find(|body| body.is_dynamic()).map(|body| body.label.clone());
    window.click(&body.expect("a ball"));
    type_time(&mut window, "3");
    assert!(window.has("Events in this Δt"));
    window.click("Tile crossings");
    assert!(window.has_containing("Events in this Δt, "));
    let selected = window.selected().to_vec();
    assert!(window.frame().crossings.iter().all(|crossing| selected.contains(&crossing.key)));
    window.click("Tile crossings");
    assert!(window.has("Events in this Δt"));
}

#[test]
fn the_ledger_lists_the_whole_run_and_goes_to_its_events() {
    let mut window = Window::thesis();
    type_time(&mut window, "6");
    let frame = window.frame().clone();
    assert!(window.has_containing(&format!("Events ({})", frame.ledger.len())));
    let first = frame.ledger.at(0).unwrap().clone();
    let label = format!("{:.9}", first.event.time);
    window.key(Key::Home);
    assert_eq!((window.frame().time, window.frame().ledger.len()), (0.0, frame.ledger.len()));
    window.click(&label);
    assert_eq!((window.frame().event_count, window.frame().time), (1, first.event.time));
    let shown = window.harness.state().session().shown_event().cloned().expect("it is shown");
    assert_eq!(shown.event.seq, 1);
}

#[test]
fn the_ledger_is_narrowed_to_the_step_and_to_bodies() {
    let mut window = Window::thesis();
    type_time(&mut window, "6");
    let row = window.frame().ledger.at(0).unwrap().clone();
    let cell = format!("{:.9}", row.event.time);
    window.key(Key::Home);
    assert!(window.has(&cell));
    window.click_role(Role::CheckBox, "Only this Δt");
    assert!(!window.has(&cell), "nothing happens in the first Δt");
    window.click_role(Role::CheckBox, "Only this Δt");
    assert!(window.has(&cell));
    type_into(&mut window, "Smallest impulse listed", "1e9");
    assert!(!window.has(&cell));
    window.click("All");
    assert!(window.has(&cell));
}

#[test]
fn the_rows_listed_are_written_to_files() {
    let mut window = Window::thesis();
    type_time(&mut window, "6");
    let ledger = window.frame().ledger.clone();
    let impulses = ledger.iter_from(0).map(|row| row.event.impulse);
    let mut sizes: Vec<f64> = impulses.collect();
    sizes.sort_by(f64::total_cmp);
    let least = sizes[sizes.len() / 2];
    type_into(&mut window, "Smallest impulse listed", &least.to_string());
    let expected: Vec<_> = ledger.iter_from(0).filter(|row| row.event.impulse >= least).cloned().collect();
    assert!(expected.len() > 1 && expected.len() < ledger.len());

    window.click_role(Role::Button, "CSV…");
    window.wait_for("Save the events as");
    window.type_text("File name or path", "rows");
    let text = std::fs::read_to_string(window.folder.path().join("rows.csv")).unwrap();
    let table: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    let names: Vec<_> = EVENT_COLUMNS.iter().map(|column| column.name).collect();
    assert_eq!(table[0][..names.len()], names, "as `run --events` has them");
    let own = ["fraction", "energy_change", "row", "rows", "tile_x", "tile_y", "tile_z"];
    assert_eq!(table[0][names.len()..], own);
    assert_eq!(table.len(), 1 + expected.len());

    window.click_role(Role::CheckBox, "Costs");
    window.click_role(Role::Button, "JSON…");
    window.wait_for("Save the events as");
    window.type_text("File name or path", "rows.jsonl");
    let text = std::fs::read_to_string(window.folder.path().join("rows.jsonl")).unwrap();
    let json: Vec<serde_json::Value> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(json.len(), expected.len());
    let column = |name: &str| table[0].iter().position(|column| *column == name).unwrap();
    for ((row, cells), json) in expected.iter().zip(&table[1..]).zip(&json) {
        let event = &row.event;
        assert_eq!(json["seq"], event.seq);
        let cost = ledger.cost(event.seq).unwrap();
        assert_eq!((&json["searches"], &json["dropped"]), (&cost.searches.into(), &cost.dropped.into()));
        assert_eq!((json["a"].as_str(), json["b"].as_str()), (Some(&*row.a_label), Some(&*row.b_label)));
        for (name, value) in [("t", event.time), ("impulse", event.impulse), ("point_x", event.point.x)] {
            assert_eq!(cells[column(name)].parse::<f64>().unwrap(), value, "{name}");
        }
        assert_eq!(json["energy_change"].as_f64(), row.energy_change());
        assert_eq!(json["point"][2].as_f64(), Some(event.point.z));
        let tile = json["tile"].get(2).map_or(String::new(), ToString::to_string);
        assert_eq!(cells[column("tile_z")], tile, "empty outside the map");
    }
}

/// The runner would reach the goal after 3 s, did nobody come across.
const CROSSING: &str = r#"<PolyPhysicsXml Version="1.0">
<Map><Size X="10" Y="10" Z="10" /><Tiles X="1" Y="1" Z="1" /></Map>
<Primitives>
<SoftObject UserID="1"><Translation X="1" Y="5" Z="5" /><Weight F32="1" /><InitialVelocity X="1" Y="0" Z="0" /><Sphere><Radius F32="0.5" /></Sphere></SoftObject>
<SoftObject UserID="2"><Translation X="5" Y="5" Z="5" /><Weight F32="1" /><InitialVelocity X="0" Y="0" Z="0" /><Sphere><Radius F32="0.5" /></Sphere></SoftObject>
<SoftObject UserID="3"><Translation X="2.5" Y="8" Z="5" /><Weight F32="1" /><InitialVelocity X="0" Y="-1.5" Z="0" /><Sphere><Radius F32="0.5" /></Sphere></SoftObject>
</Primitives></PolyPhysicsXml>"#;

#[test]
fn costs_tell_what_the_event_shown_cancelled() {
    let mut window = Window::bytes(CROSSING.as_bytes());
    window.key(Key::N);
    assert_eq!(window.frame().event_count, 1);
    assert!(window.frame().cancelled.is_none(), "nobody asked");
    window.click_role(Role::CheckBox, "Costs");
    let line = "Event 1 cancelled 1 predicted impact: 1 – 2 at 3 s, not predicted now";
    assert!(window.has(line), "{:?}", window.labels());
    window.click(line);
    let keys: Vec<_> = ["1", "2"].map(|label| window.body(label).key).into();
    assert_eq!(window.selected(), keys);
    window.key(Key::Home);
    assert!(window.has("Go to an event to see which predicted impacts it cancelled"));
}

fn type_into(window: &mut Window, label: &str, text: &str) {
    window.harness.get_by_role_and_label(Role::TextInput, label).focus();
    window.harness.run();
    window.harness.event(egui::Event::Text(text.into()));
    window.harness.run();
}

#[test]
fn bookmarks_are_set_gone_to_and_removed() {
    let mut window = Window::thesis();
    type_time(&mut window, "3");
    window.key(Key::Home);
    window.key(Key::N);
    window.key(Key::K);
    let at = window.frame().time;
    assert!(window.has("Bookmark 1: event 1"));
    type_time(&mut window, "2");
    window.key(Key::K);
    window.key(Key::Home);
    window.key(Key::CloseBracket);
    assert_eq!((window.frame().time, window.frame().event_count), (at, 1));
    window.key(Key::CloseBracket);
    assert_eq!(window.frame().time, 2.0);
    window.key(Key::OpenBracket);
    assert_eq!(window.frame().time, at);
    window.harness.get_by_label("Bookmark 1: event 1").click_secondary();
    window.harness.run();
    window.click("Remove bookmark");
    assert!(!window.has("Bookmark 1: event 1"));
}

#[test]
fn playing_backwards_has_a_button_and_a_key() {
    let mut window = Window::thesis();
    let back = window.harness.get_by_role_and_label(Role::Button, "Play backwards");
    assert!(back.accesskit_node().is_disabled(), "nothing is recorded yet");
    type_time(&mut window, "1");
    window.harness.get_by_role_and_label(Role::Button, "Play backwards").click();
    window.harness.run_steps(4);
    window.harness.get_by_role_and_label(Role::Button, "Pause").click();
    window.harness.run_steps(4);
    assert!(window.frame().time <= 1.0);
}

#[test]
fn a_run_goes_on_until_its_goal() {
    let mut window = Window::thesis();
    window.click_role(Role::Button, "Run");
    window.click_role(Role::Button, "For 10 events");
    assert_eq!(window.frame().event_count, 10);
}

/// Find the collision that throws the ball out of the box: go back over the events of a body, with the keyboard alone.
#[test]
fn the_events_of_the_selection_are_gone_through() {
    let mut window = Window::thesis();
    type_time(&mut window, "6");
    window.click_role(Role::TreeItem, "15921");
    let key = window.body("15921").key;
    window.key_with(Modifiers::SHIFT, Key::B);
    let frame = window.frame().clone();
    let row = frame.event(frame.event_count).expect("an event").clone();
    assert!(Of::Body(key).holds(&row));
    window.key_with(Modifiers::SHIFT, Key::B);
    let before = window.frame().clone();
    assert!(before.event_count < frame.event_count);
    assert!(before.event(before.event_count).is_some_and(|row| Of::Body(key).holds(row)));
    assert!(!before.at_impact.is_empty());
}

/// Send a colleague the moment that goes wrong: the recording is saved with its bookmark, and opened runs the same again.
#[test]
fn a_recording_is_saved_and_opened_as_the_same_run() {
    let mut window = Window::thesis();
    type_time(&mut window, "2.5");
    window.key(Key::Home);
    window.key(Key::N);
    window.key(Key::K);
    let recorded = window.frame().clone();
    window.menu("File", "Save recording…");
    assert!(window.has_containing("scene.psrec") || window.has("Save"), "the dialog is open");
    window.click_role(Role::Button, "Save");
    let file = window.folder.path().join("scene.psrec");
    assert!(file.exists(), "it lies beside the scene");
    let text = std::fs::read_to_string(&file).unwrap();

    let mut other = Window::empty();
    std::fs::write(other.folder.path().join("sent.psrec"), &text).unwrap();
    let sent = Dropped(other.folder.path().join("sent.psrec"));
    other.harness.input_mut().dropped_files.push(std::sync::Arc::new(sent));
    other.harness.run_steps(6);
    let frame = other.frame().clone();
    assert_eq!((frame.time, frame.ledger.len()), (2.5, recorded.ledger.len()));
    assert!(other.has("Bookmark 1: event 1"));
    other.key(Key::Home);
    other.key(Key::CloseBracket);
    let again = other.frame().clone();
    assert_eq!((again.event_count, again.time), (recorded.event_count, recorded.time));
    let places =
        |frame: &polyscene::record::Frame| frame.bodies.iter().map(|body| body.position).collect::<Vec<_>>();
    assert_eq!(places(&again), places(&recorded));
    assert!(!other.harness.state().session().is_dirty());
    other.wait_for("as recorded");
    assert!(!other.has("not as recorded"), "{:?}", other.labels());

    // Symptom: a recording that does not come again was shown without a word. Expected: said, with when and what.
    let mut file: serde_json::Value = serde_json::from_str(&text).unwrap();
    let last = file["checkpoints"].as_array_mut().unwrap().last_mut().unwrap();
    let hash = u64::from_str_radix(last["hash"].as_str().unwrap(), 16).unwrap();
    last["hash"] = format!("{:016x}", hash ^ 1).into();
    std::fs::write(other.folder.path().join("other.psrec"), file.to_string()).unwrap();
    let sent = Dropped(other.folder.path().join("other.psrec"));
    other.harness.input_mut().dropped_files.push(std::sync::Arc::new(sent));
    other.harness.run_steps(6);
    other.wait_for("not as recorded");
    assert!(other.has_containing("the run parts from the recording after t = "), "{:?}", other.labels());
    assert!(other.has_containing("before 2.5 s"), "{:?}", other.labels());
}

/// The recording keeps to a memory that is set while it runs; what it dropped for that is said.
#[test]
fn the_memory_of_a_recording_is_set_and_what_it_dropped_is_shown() {
    let mut window = Window::sample("gas");
    type_time(&mut window, "60");
    let before = window.frame().recorded.clone();
    assert!(before.bytes > 2 << 20 && before.budget == 1 << 30 && before.from == 0.0, "{before:?}");
    assert!(window.has_containing("Recording: ") && !window.has_containing("kept from"));
    let button = window.labels().into_iter().find(|label| label.starts_with("Recording: ")).unwrap();
    window.click(&button);
    assert!(window.has_containing("nothing was dropped"));
    window.type_text("Memory of a recording", "none");
    assert!(window.has_containing("must lie between 1 and"));
    assert_eq!(window.frame().recorded.budget, 1 << 30);
    window.type_text("Memory of a recording", "1");
    let after = window.frame().recorded.clone();
    assert_eq!((after.budget, after.to), (1 << 20, before.to));
    assert!(after.from > 0.0 && after.bytes < before.bytes, "{after:?}");
    assert!(window.has_containing("s was dropped"));
    window.click("Close");
    assert!(window.has_containing("of 1 MiB, ") && window.has_containing("kept from"));
    window.key(Key::Home);
    assert_eq!(window.frame().time, after.from, "the first time that is kept");
    window.menu("File", "Settings…");
    window.click("Reset memory of a recording");
    assert_eq!(window.frame().recorded.budget, 1 << 30);
    assert_eq!(window.harness.state().session().settings().recording_bytes, None);
}

/// Symptom: a budget set while an earlier time was shown dropped what the window looked at. Expected: the state shown stays known.
#[test]
fn a_smaller_memory_is_set_while_the_beginning_is_shown() {
    let mut window = Window::sample("gas");
    type_time(&mut window, "60");
    window.key(Key::Home);
    window.menu("File", "Settings…");
    window.type_text("Memory of a recording", "1");
    window.click("Close");
    let bodies = window.frame().bodies.len();
    assert_eq!(bodies, window.scene().bodies.iter().filter(|body| body.is_dynamic()).count());
    window.key(Key::Period);
    assert!(window.frame().bodies.iter().all(|body| body.position.is_finite()));
}
