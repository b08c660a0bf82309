//! The document of a scene that was put together in code.

use super::edit::{Edit, EditError};
use super::{Document, NumberStyle, Scene};

impl Document {
    /// A new document that means `scene`. Bodies and forces keep their ids where these are unique.
    pub fn of_scene(scene: &Scene, style: NumberStyle) -> Result<Self, EditError> {
        let mut edits = vec![
            Edit::MapSize(scene.map.size),
            Edit::MapTiles(scene.map.tiles),
            Edit::TimeSpeed(scene.time_speed),
            Edit::Params(scene.params),
        ];
        edits.extend(scene.forces.iter().map(|force| Edit::AddForce(Box::new(force.clone()))));
        edits.extend(scene.bodies.iter().map(|body| Edit::AddBody(Box::new(body.clone()))));
        Ok(Self::new(style).apply(&Edit::All(edits))?.document)
    }
}
