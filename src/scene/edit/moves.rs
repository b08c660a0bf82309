//! Moves of several bodies, as a hand makes them from frame to frame: what the document means then is known at once, and its
//! tree is written when somebody asks for that.

use std::sync::{Arc, OnceLock};

use rustc_hash::FxHashMap;

use super::pen::check_vector;
use super::work::Work;
use super::{BodyChange, Edit, Edited, Touched, body};
use crate::scene::document::{Content, Move, Unwritten};
use crate::scene::locate::{self, List};
use crate::scene::read::{Item, Meaning};
use crate::scene::rules::Range;
use crate::scene::tree::Child;
use crate::scene::{Body, BodyList, Document, Motion, NodeKey, Scene};

/// The document after an edit that does nothing but move several bodies; `None` for any other edit, and where what one of them
/// means could be something else than what it is given.
pub(super) fn moved(document: &Document, edit: &Edit) -> Option<Edited> {
    let Edit::All(edits) = edit else { return None };
    if edits.len() < 2 {
        return None;
    }
    let moves = moves_of(edits)?;
    let old = document.scene()?;
    let bodies = moved_bodies(old, &moves)?;
    let differs = |(old, new): &(&Body, &Body)| old != new;
    let touched = old.bodies.iter().zip(&bodies).filter(differs).map(|(_, new)| new.key).collect();
    let touched = Touched { keys: touched, ..Touched::default() };
    let unwritten = match document.unwritten() {
        Some(before) if is_of_same(&before.moves, &moves) => {
            let moves = before.moves.iter().zip(moves).map(|(old, new)| new.after(old)).collect();
            Unwritten { before: before.before.clone(), moves, write }
        }
        _ => {
            let before = document.written();
            moves.iter().all(|one| is_plain(&before, one.key)).then_some(())?;
            Unwritten { before, moves, write }
        }
    };
    let Scene { map, time_speed, params, ref forces, bodies: _ } = *old;
    let scene = Scene { map, time_speed, params, forces: forces.clone(), bodies };
    let (diagnostics, features) = (document.diagnostics().to_vec(), document.meaning().features.clone());
    let meaning = Meaning { scene: Some(Arc::new(scene)), diagnostics, features };
    let moved = Document {
        source: document.source.clone(),
        content: OnceLock::new(),
        index: unwritten.before.index.clone(),
        unwritten: Some(Arc::new(unwritten)),
        meaning: OnceLock::from(Arc::new(meaning)),
    };
    Some(Edited { document: moved, added: Vec::new(), touched })
}

fn moves_of(edits: &[Edit]) -> Option<Vec<Move>> {
    let mut moves: Vec<Move> = Vec::with_capacity(edits.len());
    for edit in edits {
        let Edit::Body { key, change } = edit else { return None };
        if moves.last().is_none_or(|last| last.key != *key) {
            moves.push(Move { key: *key, position: None, rotation: None, velocity: None });
        }
        let last = moves.last_mut()?;
        let (place, value) = match change {
            BodyChange::Position(value) => (&mut last.position, value),
            BodyChange::Rotation(value) => (&mut last.rotation, value),
            BodyChange::Velocity(value) => (&mut last.velocity, value),
            _ => return None,
        };
        check_vector("the value", *value, Range::Any).ok()?;
        *place = Some(*value);
    }
    Some(moves)
}

fn is_of_same(before: &[Move], now: &[Move]) -> bool {
    before.len() == now.len() && before.iter().zip(now).all(|(before, now)| before.key == now.key)
}

/// The bodies of the scene after the moves; `None` where one is not there, or has no velocity to change.
fn moved_bodies(scene: &Scene, moves: &[Move]) -> Option<BodyList> {
    let mut bodies = scene.bodies.clone();
    let places = OnceLock::<FxHashMap<NodeKey, usize>>::new();
    let mut next = 0;
    for one in moves {
        // They come in the order of the scene as a rule.
        if bodies.get(next).is_none_or(|body| body.key != one.key) {
            let all = || scene.bodies.iter().enumerate().map(|(at, body)| (body.key, at)).collect();
            next = *places.get_or_init(all).get(&one.key)?;
        }
        let body = bodies.get_mut(next)?;
        body.position = one.position.unwrap_or(body.position);
        body.rotation = one.rotation.unwrap_or(body.rotation);
        match (&mut body.motion, one.velocity) {
            (Motion::Dynamic { velocity, .. }, Some(now)) => *velocity = now,
            (Motion::Static, Some(_)) => return None,
            (_, None) => {}
        }
        next += 1;
    }
    Some(bodies)
}

/// Whether a body was read without problems, which could be about the very numbers that change.
fn is_plain(document: &Document, key: NodeKey) -> bool {
    let (Content::Tree(top), text) = (document.content(), document.source_text()) else { return false };
    let Some(&(List::Bodies, at)) = document.index(top).get(&key) else { return false };
    let item = locate::root(top, text).and_then(|root| {
        let list = List::Bodies.find(root)?;
        list.node.children(text).get(at).and_then(Child::element)?.reading.get()
    });
    item.is_some_and(|reading| reading.problems().is_empty() && matches!(reading.item, Item::Body(_)))
}

/// The tree with the moves in it. They cannot be refused, for they were looked at.
fn write(before: &Document, moves: &[Move]) -> Content {
    let mut changes = Vec::with_capacity(moves.len());
    for one in moves {
        changes.extend(one.position.map(|value| (one.key, BodyChange::Position(value))));
        changes.extend(one.rotation.map(|value| (one.key, BodyChange::Rotation(value))));
        changes.extend(one.velocity.map(|value| (one.key, BodyChange::Velocity(value))));
    }
    let changes: Vec<_> = changes.iter().map(|(key, change)| (*key, change)).collect();
    let written = Work::on(before).and_then(|mut work| {
        work.items_changed(List::Bodies, &changes, body::change)?;
        Ok(Content::Tree(work.tree()))
    });
    written.unwrap_or_else(|_| before.content().clone())
}

impl Move {
    /// This move after an earlier one of the same body.
    fn after(self, before: &Self) -> Self {
        Self {
            key: self.key,
            position: self.position.or(before.position),
            rotation: self.rotation.or(before.rotation),
            velocity: self.velocity.or(before.velocity),
        }
    }
}
