//! What presses on a body of a heap: with whom it is in contact, and how strongly.

use egui::{Grid, Ui};
use glam::DVec3;

use super::bodies::row;
use super::section;
use crate::gui::context::AppContext;
use crate::gui::numbers::significant;
use crate::record::{ContactFrame, Frame};
use crate::scene::NodeKey;

/// Contacts that are listed, the strongest; the sum is over all.
const MOST: usize = 8;

const DIGITS: usize = 8;

/// Shows nothing for a body without known contact forces.
pub(super) fn show(ui: &mut Ui, context: &AppContext<'_>, key: NodeKey) {
    let mut pressed = pressed(context.session.frame(), key);
    if pressed.is_empty() {
        return;
    }
    let sum: DVec3 = pressed.iter().map(|(_, force)| *force).sum();
    let count = pressed.len();
    pressed.sort_by(|(_, one), (_, other)| other.length().total_cmp(&one.length()));
    section(ui, "Contacts");
    Grid::new("body contacts").num_columns(3).spacing([6.0, 3.0]).show(ui, |ui| {
        for (other, force) in pressed.iter().take(MOST) {
            let name = context.shown.and_then(|shown| shown.name(*other));
            let name = name.or_else(|| context.session.former_name(*other)).unwrap_or("a body");
            let help = "Normal force between the two, in the last step";
            row(ui, [name, ""], significant(force.length(), DIGITS), "N", help);
        }
        if count > MOST {
            row(ui, [&format!("and {} weaker", count - MOST), ""], String::new(), "", "");
        }
        let help = "Sum of the normal forces on this body, all contacts of heaps together";
        for (axis, value) in ["x", "y", "z"].into_iter().zip(sum.to_array()) {
            let label = if axis == "x" { "Sum on this body" } else { "" };
            row(ui, [label, axis], significant(value, DIGITS), "N", help);
        }
    });
}

/// The others in contact with a body, and the forces of these on it, N.
fn pressed(frame: &Frame, key: NodeKey) -> Vec<(NodeKey, DVec3)> {
    let on_it = |contact: &ContactFrame| {
        let ContactFrame { keys: [a, b], ends, force } = *contact;
        let towards = force * (ends[1] - ends[0]).normalize_or_zero();
        match key {
            key if key == a => Some((b, -towards)),
            key if key == b => Some((a, towards)),
            _ => None,
        }
    };
    frame.contacts.iter().filter_map(on_it).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forces_push_apart() {
        let contact =
            ContactFrame { keys: [NodeKey(1), NodeKey(2)], ends: [DVec3::Y, DVec3::ZERO], force: 3.0 };
        let frame = Frame { contacts: vec![contact], ..Frame::default() };
        assert_eq!(pressed(&frame, NodeKey(1)), [(NodeKey(2), 3.0 * DVec3::Y)]);
        assert_eq!(pressed(&frame, NodeKey(2)), [(NodeKey(1), -3.0 * DVec3::Y)]);
        assert_eq!(pressed(&frame, NodeKey(3)), []);
    }
}
