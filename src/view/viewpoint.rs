//! Cameras as a scene file keeps them.

use super::{Camera, Projection};
use crate::scene::Viewpoint;

impl Camera {
    pub fn of_viewpoint(viewpoint: &Viewpoint) -> Self {
        let projection =
            if viewpoint.perspective { Projection::Perspective } else { Projection::Orthographic };
        let Viewpoint { target, yaw, pitch, height, .. } = *viewpoint;
        Self { projection, target, yaw, pitch, height }.usable()
    }

    pub fn viewpoint(&self, name: &str) -> Viewpoint {
        let perspective = self.projection == Projection::Perspective;
        let Self { target, yaw, pitch, height, .. } = *self;
        Viewpoint { name: name.to_owned(), perspective, target, yaw, pitch, height }
    }
}
