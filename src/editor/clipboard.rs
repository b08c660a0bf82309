//! Cut, copy and paste: the clipboard holds a small scene file, so that scenes can be put together from
//! others and text editors see what was copied.

use super::{Outcome, Request, Session};
use crate::design;
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

    /// Adds the bodies and forces of a scene given as text: clear of what is there, or in their own places.
    pub(super) fn paste(&mut self, text: &str, in_place: bool) -> Outcome {
        let in_place = std::mem::take(&mut self.talk.paste_in_place) || in_place;
        let pasted = Document::from_bytes(text.as_bytes());
        let (Some(scene), Some(from)) = (self.scene(), pasted.scene()) else {
            return Outcome::Refused("The clipboard holds no scene".to_owned());
        };
        let plan = design::paste(scene, from, in_place);
        if plan.edits.is_empty() {
            return Outcome::Refused("The clipboard holds a scene without bodies and forces".to_owned());
        }
        self.apply_plan(plan)
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
