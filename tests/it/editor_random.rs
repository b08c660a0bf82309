//! Random commands, edits and tools: nothing panics, undoing all gives the file's bytes, redoing all the end, and the
//! document always saves and reloads to the same scene.

use glam::DVec3;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

use polyscene::design::{Eye, TOOLS};
use polyscene::editor::{
    Action, Answer, BODY_FIELDS, COMMANDS, Command, Drag, Gesture, Menu, Request, SessionCommand, Typed,
};
use polyscene::scene::{Document, NodeKey};
use polyscene::view::Pull;

use super::editor_support::{Bench, SCENE};

/// Commands of one sequence.
const LENGTH: usize = 1000;

/// A scene may grow; beyond this it is cut down, so that a thousand doublings end.
const MOST_BODIES: usize = 200;

/// What a person does next, by numbers that the scene at hand gives a meaning.
#[derive(Clone, Debug)]
enum Step {
    Command(usize),
    Tool(usize, u64),
    Select(Vec<usize>),
    Toggle(usize),
    Drag(Vec<[i8; 3]>, bool),
    Field(usize, usize, i8),
    Paste(bool),
    Repair,
}

fn step() -> impl Strategy<Value = Step> {
    prop_oneof![
        6 => any::<usize>().prop_map(Step::Command),
        3 => (any::<usize>(), any::<u64>()).prop_map(|(tool, bits)| Step::Tool(tool, bits)),
        3 => prop::collection::vec(any::<usize>(), 0..6).prop_map(Step::Select),
        1 => any::<usize>().prop_map(Step::Toggle),
        2 => (prop::collection::vec(any::<[i8; 3]>(), 1..4), any::<bool>()).prop_map(|(way, drop)| Step::Drag(way, drop)),
        2 => (any::<usize>(), any::<usize>(), any::<i8>()).prop_map(|(field, axis, value)| Step::Field(field, axis, value)),
        1 => any::<bool>().prop_map(Step::Paste),
        1 => Just(Step::Repair),
    ]
}

/// A bench, and what a window would keep of it.
struct Person {
    bench: Bench,
    clipboard: String,
    gestures: u64,
}

impl Person {
    fn keys(&self) -> Vec<NodeKey> {
        let scene = self.bench.session.scene().unwrap();
        let forces = scene.forces.iter().map(|force| force.key);
        forces.chain(scene.bodies.iter().map(|body| body.key)).collect()
    }

    fn does(&mut self, step: &Step) {
        let keys = self.keys();
        let key = |at: usize| keys.get(at % keys.len().max(1)).copied();
        match step {
            Step::Command(at) => self.command(*at),
            Step::Tool(at, bits) => self.uses(*at, *bits),
            Step::Select(places) => {
                let keys = places.iter().filter_map(|at| key(*at)).collect();
                self.bench.act(Action::Select(keys));
            }
            Step::Toggle(at) => drop(key(*at).map(|key| self.bench.act(Action::ToggleSelected(key)))),
            Step::Drag(way, dropped) => self.drags(way, *dropped),
            Step::Field(field, axis, value) => self.types(*field, *axis, *value),
            Step::Paste(in_place) => {
                let text = self.clipboard.clone();
                let paste = if *in_place { Action::PasteInPlace(text) } else { Action::Paste(text) };
                self.bench.act(paste);
            }
            Step::Repair => {
                let fixes: Vec<_> =
                    self.bench.session.problems().into_iter().filter_map(|problem| problem.fix).collect();
                if let Some(polyscene::editor::Fix::Repair(repair)) = fixes.first() {
                    self.bench.act(Action::Repair(*repair));
                }
            }
        }
        self.answers();
        if self.keys().len() > MOST_BODIES {
            self.bench.run(SessionCommand::SelectAll);
            self.bench.run(SessionCommand::UnlockAll);
            self.bench.run(SessionCommand::Delete);
        }
    }

    /// Any command that does not open another document, undo or redo.
    fn command(&mut self, at: usize) {
        let rows: Vec<_> = COMMANDS.iter().filter(|row| row.menu != Menu::File).collect();
        let row = rows[at % rows.len()];
        let Command::Session(command) = row.command else { return };
        if !matches!(command, SessionCommand::Undo | SessionCommand::Redo) {
            self.bench.run(command);
        }
    }

    fn uses(&mut self, at: usize, bits: u64) {
        let tool = &TOOLS[at % TOOLS.len()];
        let given = self.bench.session.given(Eye::default()).unwrap();
        let mut values = tool.defaults(&given);
        for (nth, value) in values.iter_mut().enumerate() {
            // counts up to four, and lengths of about their defaults
            let digit = (bits >> (4 * (nth % 16)) & 15) as f64;
            *value = if value.fract() == 0.0 { (digit / 4.0).ceil() } else { *value * (0.5 + digit / 8.0) };
        }
        if let Ok(plan) = tool.plan(&given, &values) {
            self.bench.act(Action::Apply(plan));
        }
    }

    fn drags(&mut self, way: &[[i8; 3]], dropped: bool) {
        self.gestures += 1;
        let Some(drag) = Drag::of_selection(&self.bench.session, Gesture(self.gestures)) else { return };
        for at in way {
            let offset = DVec3::from_array(at.map(f64::from)) / 32.0;
            self.bench.act(drag.pull(&Pull::Move(offset), DVec3::ZERO));
        }
        self.bench.act(if dropped { Action::EndGesture } else { Action::AbandonGesture });
    }

    fn types(&mut self, field: usize, axis: usize, value: i8) {
        let field = &BODY_FIELDS[field % BODY_FIELDS.len()];
        let scene = self.bench.session.scene().unwrap();
        let keys = self.bench.session.selection().keys();
        let typed = Typed::Value(f64::from(value) / 16.0);
        if let Ok(edit) = field.edit(scene, keys, axis % field.axes.len(), &typed) {
            self.bench.edit(edit);
        }
    }

    /// What the window answers.
    fn answers(&mut self) {
        for request in self.bench.session.take_requests() {
            match request {
                Request::SetClipboard(text) => self.clipboard = text,
                Request::ReadClipboard => drop(self.bench.act(Action::Paste(self.clipboard.clone()))),
                _ => {}
            }
        }
        if self.bench.session.question().is_some() {
            self.bench.act(Action::Answer(Answer::Cancel));
        }
        self.bench.session.take_notices();
    }
}

fn is_sound(bench: &Bench) -> bool {
    let document = bench.session.document();
    let again = Document::from_bytes(&document.to_bytes());
    let texts = |document: &Document| {
        let scene = document.scene().expect("a scene");
        let bodies = scene
            .bodies
            .iter()
            .map(|body| format!("{:?}", polyscene::scene::Body { key: NodeKey::default(), ..body.clone() }));
        (scene.map, scene.params, scene.forces.len(), bodies.collect::<Vec<_>>())
    };
    texts(document) == texts(&again)
}

#[test]
fn a_thousand_commands_are_undone_and_redone_to_the_byte() {
    let config = Config { cases: 4, failure_persistence: None, max_shrink_iters: 200, ..Config::default() };
    let steps = prop::collection::vec(step(), LENGTH);
    TestRunner::new(config)
        .run(&steps, |steps| {
            let mut person = Person { bench: Bench::open(), clipboard: String::new(), gestures: 0 };
            for (nth, step) in steps.iter().enumerate() {
                person.does(step);
                if nth % 50 == 0 {
                    prop_assert!(is_sound(&person.bench), "after step {nth}: {step:?}");
                }
            }
            prop_assert!(is_sound(&person.bench));
            let end = person.bench.bytes();
            let mut undone = 0;
            while person.bench.session.undo_label().is_some() {
                person.bench.run(SessionCommand::Undo);
                undone += 1;
            }
            prop_assert_eq!(person.bench.bytes(), SCENE, "{} points", undone);
            prop_assert!(!person.bench.session.is_dirty());
            for _ in 0..undone {
                person.bench.run(SessionCommand::Redo);
            }
            prop_assert_eq!(person.bench.bytes(), end);
            Ok(())
        })
        .unwrap();
}
