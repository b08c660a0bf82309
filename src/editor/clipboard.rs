//! Cut, copy and paste: the clipboard holds a small scene file, so that scenes can be put together from
//! others and text editors see what was copied.

use glam::DVec3;

use super::{Outcome, Request, Session};
use crate::scene::{Document, Edit, NodeKey, NumberStyle, Scene};

impl Session {
    pub(super) fn copy(&mut self) -> Outcome {
        let Some(scene) = self.scene() else { return Outcome::no_scene() };
        match text_of(scene, self.selection.keys()) {
            Ok(text) => self.talk.requests.push(Request::SetClipboard(text)),
            Err(reason) => return Outcome::Refused(reason),
        }
        Outcome::Done
    }

    pub(super) fn cut(&mut self) -> Outcome {
        match self.copy() {
            Outcome::Done => self.delete(),
            refused @ Outcome::Refused(_) => refused,
        }
    }

    /// Adds the bodies and forces of a scene given as text, beside what is there.
    pub(super) fn paste(&mut self, text: &str) -> Outcome {
        let pasted = Document::from_bytes(text.as_bytes());
        let (Some(scene), Some(from)) = (self.scene(), pasted.scene()) else {
            return Outcome::Refused("The clipboard holds no scene".to_owned());
        };
        let keys: Vec<NodeKey> = from.bodies.iter().map(|body| body.key).collect();
        let covers =
            from.bodies.iter().any(|new| scene.bodies.iter().any(|old| old.position == new.position));
        let offset = if covers { super::creation::offset_of_copy(from, &keys) } else { DVec3::ZERO };
        let mut edits: Vec<Edit> = from.forces.iter().map(|f| Edit::AddForce(Box::new(f.clone()))).collect();
        for body in &from.bodies {
            let mut body = body.clone();
            body.position += offset;
            edits.push(Edit::AddBody(Box::new(body)));
        }
        if edits.is_empty() {
            return Outcome::Refused("The clipboard holds a scene without bodies and forces".to_owned());
        }
        let label = format!("Paste {} objects", edits.len());
        self.edit_as(&Edit::All(edits), None, Some(label))
    }
}

fn text_of(scene: &Scene, keys: &[NodeKey]) -> Result<String, String> {
    let chosen: std::collections::BTreeSet<NodeKey> = keys.iter().copied().collect();
    let forces = scene.forces.iter().filter(|force| chosen.contains(&force.key));
    let bodies = scene.bodies.iter().filter(|body| chosen.contains(&body.key));
    let mut edits = vec![Edit::MapSize(scene.map.size), Edit::MapTiles(scene.map.tiles)];
    edits.extend(forces.map(|force| Edit::AddForce(Box::new(force.clone()))));
    edits.extend(bodies.map(|body| Edit::AddBody(Box::new(body.clone()))));
    let small = Document::new(NumberStyle::Point).apply(&Edit::All(edits)).map_err(|err| err.to_string())?;
    String::from_utf8(small.document.to_bytes()).map_err(|err| err.to_string())
}
