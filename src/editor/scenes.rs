//! Which scene ran when: the past of a run is drawn as it was, whatever was edited since.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::record::Frame;
use crate::scene::{Body, NodeKey, Scene};
use crate::sim::SimEdit;

/// The scenes that ran before the recorded edits.
#[derive(Default)]
pub(super) struct Scenes {
    /// Of each recorded edit, in order.
    before: Vec<Arc<Scene>>,
    /// These and the one that ran, before the last edit; and what stood here before that edit.
    replaced: Option<Replaced>,
    former_replaced: Option<Replaced>,
    /// What bodies were called that edits removed from the run.
    former: BTreeMap<NodeKey, String>,
}

type Replaced = (Vec<Arc<Scene>>, Arc<Scene>);

impl Scenes {
    /// Notes an edit of a scene that ran at the moment that a frame shows; `running` is the one at the end.
    pub fn edit(&mut self, then: &Arc<Scene>, running: &Arc<Scene>, edits: &[SimEdit], frame: &Frame) {
        self.former_replaced = self.replaced.replace((self.before.clone(), running.clone()));
        // What was recorded for later is another future; what is not recorded yet is made with this one.
        if frame.recorded.edits.len() >= self.before.len() {
            self.before.resize(frame.edits_before, then.clone());
            self.before.push(then.clone());
        }
        let gone = edits.iter().filter_map(|edit| match edit {
            SimEdit::Remove(key) => then.bodies.iter().find(|body| body.key == *key),
            _ => None,
        });
        self.former.extend(gone.map(|body| (body.key, body.display_name().to_owned())));
    }

    /// Forgets an edit that the runner refused, as a frame tells, which recorded none.
    pub fn refused(&mut self, frame: &Frame) {
        if frame.recorded.edits.len() < self.before.len()
            && let Some((before, _)) = std::mem::replace(&mut self.replaced, self.former_replaced.take())
        {
            self.before = before;
        }
    }

    /// The scene that ran at what a frame shows; `None` for the one that runs at the end.
    pub fn then(&self, frame: &Frame) -> Option<&Arc<Scene>> {
        let is_unrecorded = frame.recorded.edits.len() < self.before.len();
        if is_unrecorded && frame.edits_before + 1 == self.before.len() {
            return None;
        }
        self.before.get(frame.edits_before)
    }

    /// Takes the last edit back; gives the scene that ran before it.
    pub fn bring_back(&mut self) -> Option<Arc<Scene>> {
        let (before, scene) = self.replaced.take()?;
        self.before = before;
        Some(scene)
    }

    pub fn former_name(&self, key: NodeKey) -> Option<&str> {
        self.former.get(&key).map(String::as_str)
    }
}

/// What is drawn at a moment when another scene ran than the document's: bodies as they were, but what edits touched that have
/// not reached the run as the document has it. In the present, `then` is what runs while changes wait for a reset: bodies that
/// wait to be added are drawn where they will start.
pub(super) fn drawn(
    wanted: &Arc<Scene>,
    then: &Arc<Scene>,
    is_past: bool,
    pending: &BTreeSet<NodeKey>,
) -> Arc<Scene> {
    let ran: BTreeMap<NodeKey, &Body> = then.bodies.iter().map(|body| (body.key, body)).collect();
    let of_wanted = |body: &Body| match ran.get(&body.key) {
        _ if pending.contains(&body.key) => Some(body.clone()),
        Some(ran) if is_past || body.is_dynamic() => Some(as_it_ran(ran, body)),
        None if is_past => None,
        Some(_) | None => Some(body.clone()),
    };
    let known: BTreeSet<NodeKey> = wanted.bodies.iter().map(|body| body.key).collect();
    let is_gone = |body: &&Body| !pending.contains(&body.key) && !known.contains(&body.key);
    let gone = then.bodies.iter().filter(is_gone).cloned();
    let bodies: Vec<Body> = wanted.bodies.iter().filter_map(of_wanted).chain(gone).collect();
    let forces = if is_past { &then.forces } else { &wanted.forces };
    Arc::new(Scene { bodies: bodies.into_iter().collect(), forces: forces.clone(), ..(**wanted).clone() })
}

/// A body with the place and shape that it had in the run.
fn as_it_ran(ran: &Body, wanted: &Body) -> Body {
    Body {
        position: ran.position,
        rotation: ran.rotation,
        shape: ran.shape.clone(),
        motion: ran.motion,
        ..wanted.clone()
    }
}
