//! Heaps in the window: which bodies are stepped, what the overlay shows, and why playing falls behind.

use std::cell::RefCell;
use std::sync::Arc;
use std::time::Instant;

use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use glam::DVec3;
use polyscene::editor::Place;
use polyscene::gui::{App, Parts};
use polyscene::record::{
    Busiest, EventRow, Frame, InlineRunner, Lag, LagCause, Ledger, Recorded, RunCommand, RunState, Runner,
};
use polyscene::scene::NodeKey;
use polyscene::sim::{BodyRef, ContactState, Event, EventKind, SteppedBodies};

use super::gui_support::{SIZE, Window, parts, sample_path};

impl Window {
    /// The bin after some seconds.
    fn bin(seconds: &str) -> Self {
        let mut window = Self::sample("bin");
        window.type_text("Δt", seconds);
        window.click("Step forward");
        window
    }

    fn states(&self) -> Vec<ContactState> {
        self.frame().bodies.iter().map(|body| body.contact).collect()
    }
}

#[test]
fn the_status_bar_counts_stepped_bodies_and_says_since_when() {
    let mut window = Window::bin("0.5");
    let stepped = window.frame().stepped.expect("the bin is stepped by then");
    let count = window.states().iter().filter(|state| **state == ContactState::Stepped).count();
    assert_eq!(stepped.count, count);
    assert!(window.has_containing(&format!("{count} bodies stepped since 0.")));
    window.click("Reset");
    assert!(!window.has_containing("stepped since"));
}

#[test]
fn the_events_of_a_heap_say_how_many_bodies_they_are_about() {
    // It is entered at 0.2127 s, so that the row is among the last, which are in sight.
    let window = Window::bin("0.213");
    let rows = &window.frame().events;
    let entered = rows.iter().find(|row| row.event.kind == EventKind::Dense).expect("it was entered");
    assert!(entered.event.bodies > 1);
    assert!(window.has_containing(&format!(" and {} more", entered.event.bodies - 1)));
}

#[test]
fn a_heap_at_rest_keeps_its_force_chains() {
    let window = Window::bin("21");
    assert!(window.states().iter().all(|state| *state == ContactState::Rest), "{:?}", window.states());
    assert!(window.frame().stepped.is_none() && !window.has_containing("stepped since"));
    let floor = window.body("1").key;
    let on_floor: f64 =
        window.frame().contacts.iter().filter(|it| it.keys[1] == floor).map(|it| it.force).sum();
    assert!(on_floor > 0.0);
    assert!(!window.has("warning"), "overlap within what stepping allows is no warning");
}

#[test]
fn the_overlay_is_offered_in_each_view() {
    let mut window = Window::bin("0.5");
    window.click("Overlays of Top view");
    window.click_role(Role::CheckBox, "Force chains");
    let box_ = window.harness.get_by_role_and_label(Role::CheckBox, "Force chains");
    assert_eq!(box_.accesskit_node().toggled(), Some(egui::accesskit::Toggled::True));
}

/// Publishes frames that were changed.
struct Changed<F: Fn(&mut Frame)> {
    inner: InlineRunner,
    change: F,
    made: RefCell<Option<Arc<Frame>>>,
}

impl<F: Fn(&mut Frame)> Runner for Changed<F> {
    fn send(&mut self, command: RunCommand) -> u64 {
        self.inner.send(command)
    }

    fn frame(&self) -> Arc<Frame> {
        let now = self.inner.frame();
        let mut made = self.made.borrow_mut();
        if let Some(frame) = made.as_ref().filter(|made| made.revision == now.revision) {
            return frame.clone();
        }
        let mut frame = Frame::clone(&now);
        (self.change)(&mut frame);
        made.insert(Arc::new(frame)).clone()
    }

    fn tick(&mut self, _wall_s: f64) {}
}

/// A window that says that it plays and falls behind.
fn behind(cause: LagCause) -> Harness<'static, App> {
    changed(move |frame| {
        frame.state = RunState::Playing;
        frame.lag = Some(Lag { share: 0.3, cause });
        frame.stepped = Some(SteppedBodies { count: 12, since: 0.213, step: 1e-3 });
    })
}

fn changed(change: impl Fn(&mut Frame) + 'static) -> Harness<'static, App> {
    let runner = Box::new(Changed { inner: InlineRunner::new(), change, made: RefCell::default() });
    let parts = Parts { runner, ..parts(Some(sample_path("bin"))) };
    let mut harness =
        Harness::builder().with_size(SIZE).with_max_steps(12).build_eframe(move |cc| App::new(cc, parts));
    harness.run_steps(4);
    harness
}

fn click(harness: &mut Harness<'static, App>, label: &str) {
    harness.get_by_role_and_label(Role::Button, label).click();
    harness.run_steps(4);
}

#[test]
fn playing_that_falls_behind_says_how_far_and_why() {
    let mut harness = behind(LagCause::Stepped { bodies: 12 });
    assert!(harness.query_by_label("12 bodies stepped since 0.213 s").is_some());
    click(&mut harness, "plays at 0.3 of real time");
    let why = "Most of the time goes to 12 bodies that are stepped together, every 1.0 ms of model time.";
    assert!(harness.query_by_label(why).is_some());
    assert!(harness.query_by_label_contains("A larger Dense step is quicker").is_some());
    click(&mut harness, "Play at 1/4 ×");
    assert_eq!(harness.state().session().playback().speed(), 0.25);
    click(&mut harness, "plays at 0.3 of the speed set");
    click(&mut harness, "Show the settings of the simulation");
    assert_eq!(harness.state().session().selection().place(), Some(Place::Simulation));
}

#[test]
fn events_that_cost_most_are_named() {
    let (a, b) = {
        let window = Window::sample("bin");
        (window.body("6").key, window.body("7").key)
    };
    let busiest = Some(Busiest { a, b: Some(b), share: 0.62 });
    let mut harness = behind(LagCause::Events { per_model_s: 34_000.0, busiest });
    click(&mut harness, "plays at 0.3 of real time");
    let why = "34000 per second of model time, of which 62 % between 6 and 7 in this Δt.";
    assert!(harness.query_by_label_contains(why).is_some());
    assert!(harness.query_by_label("Show the settings of the simulation").is_none());
    let mut harness = behind(LagCause::Field { body: Some(NodeKey(a.0)) });
    click(&mut harness, "plays at 0.3 of real time");
    assert!(harness.query_by_label_contains("integrating the motion in fields, of 6 most of all").is_some());
    assert!(harness.query_by_label_contains("A larger Field tolerance is quicker").is_some());
}

fn event(seq: u64) -> EventRow {
    let event = Event {
        seq,
        time: seq as f64 * 1e-6,
        kind: EventKind::Impact,
        a: BodyRef::Dynamic(0),
        b: Some(BodyRef::Dynamic(1)),
        point: DVec3::ONE,
        normal: DVec3::X,
        impulse: (seq % 97) as f64,
        vn_before: -1.0,
        vn_after: 1.0,
        group: 0,
        row_in_group: [0; 2],
        bodies: 1,
        gap: 0.0,
        rounds: 0,
    };
    let [a_label, b_label] = ["6", "7"].map(Arc::from);
    EventRow { event, a_key: NodeKey(u64::MAX), b_key: None, a_label, b_label }
}

/// Milliseconds of the quickest of some repaints.
fn repaint(harness: &mut Harness<'static, App>) -> f64 {
    let once = |_| {
        let since = Instant::now();
        harness.step();
        1e3 * since.elapsed().as_secs_f64()
    };
    (0..20).map(once).fold(f64::INFINITY, f64::min)
}

/// Expected: only rows in sight are made, and a repaint takes about as long with a million events as with none; also when
/// they are narrowed or sorted.
#[test]
fn a_long_list_of_events_costs_no_more_than_what_is_seen_of_it() {
    let mut times = Vec::new();
    for count in [0, 1_000_000] {
        let ledger: Ledger = (1..=count).map(event).collect();
        let mut harness = changed(move |frame| {
            (frame.step, frame.dt_index) = (Some((0.0, 0.02)), 1);
            frame.recorded = Arc::new(Recorded { to: 1.0, ..Recorded::default() });
            frame.ledger = ledger.clone();
        });
        // The list is looked through in portions.
        harness.run_steps(12);
        let shown = repaint(&mut harness);
        let seen = harness.query_all_by_label("6 – 7").count();
        assert!(seen <= 60 && (seen > 0) == (count > 0), "{seen} rows of {count}");
        let longest = if count > 0 { longest_while_narrowed(&mut harness) } else { 0.0 };
        click(&mut harness, "Accuracy");
        times.push((shown, repaint(&mut harness), longest));
    }
    println!(
        "repaints in ms, list shown, hidden, longest while narrowed: {times:.2?} without and with 10⁶ events"
    );
    let [(without, ..), (with, _, longest)] = times[..] else { panic!("two windows") };
    // Generous: other tests run beside this one.
    assert!(with < 10.0 * without + 20.0, "{with} ms with events, {without} ms without");
    assert!(longest < 400.0, "{longest} ms while the list is narrowed");
}

/// Milliseconds of the longest repaint while a filter looks through all rows.
fn longest_while_narrowed(harness: &mut Harness<'static, App>) -> f64 {
    harness.get_by_role_and_label(Role::CheckBox, "Only this Δt").click();
    let once = |_| {
        let since = Instant::now();
        harness.step();
        1e3 * since.elapsed().as_secs_f64()
    };
    (0..14).map(once).fold(0.0, f64::max)
}
