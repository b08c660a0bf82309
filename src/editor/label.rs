//! What an edit is called in the Edit menu: `Move 5853`, `Change bounce of 3 objects`.

use std::collections::BTreeSet;

use crate::scene::{Body, BodyChange, Edit, ForceChange, NodeKey, Scene};

/// Names an edit after what it does and to what, in the scene before it.
pub(super) fn describe(edit: &Edit, scene: Option<&Scene>) -> String {
    let verb = verb_of(edit);
    let mut subjects = BTreeSet::new();
    collect_subjects(edit, &mut subjects);
    match (subjects.len(), subjects.first()) {
        (0, _) => verb.to_owned(),
        (1, Some(key)) => match scene.and_then(|scene| name_of(scene, *key)) {
            Some(name) => format!("{verb} {name}"),
            None => format!("{verb} 1 object"),
        },
        (count, _) => format!("{verb} {count} objects"),
    }
}

/// What to call a body or force: its name, or its unique label.
pub(super) fn name_of(scene: &Scene, key: NodeKey) -> Option<&str> {
    let body = scene.bodies.iter().find(|body| body.key == key).map(Body::display_name);
    body.or_else(|| {
        let force = scene.forces.iter().find(|force| force.key == key)?;
        Some(force.display_name())
    })
}

fn verb_of(edit: &Edit) -> &'static str {
    match edit {
        Edit::MapSize(_) => "Resize the map",
        Edit::MapTiles(_) => "Change the tiles",
        Edit::TimeSpeed(_) => "Change the time speed",
        Edit::Params(_) => "Change the solver",
        Edit::Viewpoints(_) => "Change the viewpoints",
        Edit::Body { change, .. } => body_verb(change),
        Edit::Force { change, .. } => force_verb(change),
        Edit::AddBody(_) => "Add a body",
        Edit::AddForce(_) => "Add a force",
        Edit::Duplicate { .. } | Edit::CopyBodies(_) => "Duplicate",
        Edit::Delete { .. } => "Delete",
        Edit::Reorder { .. } => "Change the order of",
        Edit::MakeIdsUnique => "Make IDs unique",
        Edit::All(edits) => {
            let verbs: BTreeSet<&str> = edits.iter().map(verb_of).collect();
            match (verbs.len(), edits.first()) {
                (1, Some(first)) => verb_of(first),
                _ => verb_of_drag(&verbs).unwrap_or("Edit"),
            }
        }
    }
}

/// A drag that turns or resizes moves too, and turns velocities: it is called after the first of these.
fn verb_of_drag(verbs: &BTreeSet<&str>) -> Option<&'static str> {
    const DRAGGED: [&str; 4] = ["Resize", "Rotate", "Move", "Change velocity of"];
    let dragged = verbs.iter().all(|verb| DRAGGED.contains(verb));
    dragged.then(|| DRAGGED.into_iter().find(|verb| verbs.contains(verb))).flatten()
}

fn body_verb(change: &BodyChange) -> &'static str {
    match change {
        BodyChange::Id(_) => "Change ID of",
        BodyChange::Name(_) => "Rename",
        BodyChange::Group(_) => "Group",
        BodyChange::Color(_) => "Colour",
        BodyChange::Hidden(true) => "Hide",
        BodyChange::Hidden(false) => "Show",
        BodyChange::Locked(true) => "Lock",
        BodyChange::Locked(false) => "Unlock",
        BodyChange::Position(_) => "Move",
        BodyChange::Rotation(_) => "Rotate",
        BodyChange::Bounce(_) => "Change bounce of",
        BodyChange::Friction(_) => "Change friction of",
        BodyChange::RollingFriction(_) => "Change rolling friction of",
        BodyChange::Tangential(_) => "Change tangential restitution of",
        BodyChange::Spin(_) => "Change spin of",
        BodyChange::Material(_) => "Change material of",
        BodyChange::Mass(_) => "Change mass of",
        BodyChange::Velocity(_) => "Change velocity of",
        BodyChange::Shape(_) => "Resize",
    }
}

fn force_verb(change: &ForceChange) -> &'static str {
    match change {
        ForceChange::Id(_) => "Change ID of",
        ForceChange::Name(_) => "Rename",
        ForceChange::Group(_) => "Group",
        ForceChange::Hidden(true) => "Hide",
        ForceChange::Hidden(false) => "Show",
        ForceChange::Locked(true) => "Lock",
        ForceChange::Locked(false) => "Unlock",
        ForceChange::Kind(_) => "Change",
    }
}

fn collect_subjects(edit: &Edit, subjects: &mut BTreeSet<NodeKey>) {
    match edit {
        Edit::Body { key, .. } | Edit::Force { key, .. } => drop(subjects.insert(*key)),
        Edit::Duplicate { keys, .. } | Edit::Delete { keys } | Edit::Reorder { keys, .. } => {
            subjects.extend(keys);
        }
        Edit::CopyBodies(copies) => subjects.extend(copies.iter().map(|copy| copy.of)),
        Edit::All(edits) => edits.iter().for_each(|edit| collect_subjects(edit, subjects)),
        Edit::MapSize(_)
        | Edit::MapTiles(_)
        | Edit::TimeSpeed(_)
        | Edit::Params(_)
        | Edit::Viewpoints(_)
        | Edit::AddBody(_)
        | Edit::AddForce(_)
        | Edit::MakeIdsUnique => {}
    }
}
