//! What is different in another version of a scene, in words: one line for each body, force or setting.

use rustc_hash::FxHashMap;

use crate::scene::{Body, Force, Motion, NodeKey, Scene};

/// Most lines; the rest is counted.
const MOST: usize = 8;

/// The changes, or that there are none that mean anything.
pub(super) fn changes(before: &Scene, after: &Scene) -> Vec<String> {
    let mut lines = settings(before, after);
    items(
        (before.bodies.as_slice(), after.bodies.as_slice()),
        |body| (body.key, body.display_name()),
        |a, b| body_changes(a, b),
        &mut lines,
    );
    items(
        (&before.forces, &after.forces),
        |force| (force.key, force.display_name()),
        force_changes,
        &mut lines,
    );
    if lines.is_empty() {
        lines.push("comments, spaces or what this program does not know".to_owned());
    }
    let more = lines.len().saturating_sub(MOST);
    if more > 0 {
        lines.truncate(MOST);
        lines.push(format!("and {more} more"));
    }
    lines
}

fn settings(before: &Scene, after: &Scene) -> Vec<String> {
    let changed = [
        (before.map != after.map, "map"),
        (before.time_speed != after.time_speed, "time speed"),
        (before.params != after.params, "settings of the solver"),
    ];
    changed.into_iter().filter(|(changed, _)| *changed).map(|(_, name)| format!("{name} changed")).collect()
}

fn items<T>(
    (before, after): (&[T], &[T]),
    about: fn(&T) -> (NodeKey, &str),
    compare: fn(&T, &T) -> Vec<&'static str>,
    lines: &mut Vec<String>,
) {
    let keyed = |items: &'_ [T]| items.iter().enumerate().map(|(at, item)| (about(item).0, at)).collect();
    let (old, new): (FxHashMap<_, usize>, FxHashMap<_, usize>) = (keyed(before), keyed(after));
    for item in before.iter().filter(|item| !new.contains_key(&about(item).0)) {
        lines.push(format!("{} removed", about(item).1));
    }
    for item in after {
        let (key, name) = about(item);
        match old.get(&key).and_then(|at| before.get(*at)) {
            None => lines.push(format!("{name} added")),
            Some(old) => {
                let changed = compare(old, item);
                if !changed.is_empty() {
                    lines.push(format!("{name}: {}", changed.join(", ")));
                }
            }
        }
    }
}

fn body_changes(a: &Body, b: &Body) -> Vec<&'static str> {
    let motion = |body: &Body| match body.motion {
        Motion::Static => None,
        Motion::Dynamic { mass, velocity } => Some((mass, velocity)),
    };
    let (old, new) = (motion(a), motion(b));
    let both = old.zip(new);
    let changed = [
        (a.name != b.name || a.group != b.group || a.id != b.id, "name"),
        (a.color != b.color || a.hidden != b.hidden || a.locked != b.locked, "looks"),
        (a.position != b.position, "position"),
        (a.rotation != b.rotation, "rotation"),
        (a.shape != b.shape, "shape"),
        (a.bounce != b.bounce, "Bounce"),
        (a.material != b.material, "material"),
        (old.is_some() != new.is_some(), "moves or stands"),
        (both.is_some_and(|(old, new)| old.0 != new.0), "mass"),
        (both.is_some_and(|(old, new)| old.1 != new.1), "velocity"),
    ];
    let mut words: Vec<_> =
        changed.into_iter().filter(|(changed, _)| *changed).map(|(_, word)| word).collect();
    if words.is_empty() && a != b {
        words.push("changed");
    }
    words
}

fn force_changes(a: &Force, b: &Force) -> Vec<&'static str> {
    let mut words = Vec::new();
    if a.kind != b.kind {
        words.push("strength or place");
    }
    if (&a.name, &a.group, a.hidden, a.locked) != (&b.name, &b.group, b.hidden, b.locked) {
        words.push("looks");
    }
    if words.is_empty() && a != b {
        words.push("changed");
    }
    words
}
