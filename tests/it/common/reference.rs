//! The naive simulator on a scene that it knows.

use polyscene::scene::Scene;
use polyscene::study::reference::{Reference, ReferenceSettings};

pub fn reference(scene: &Scene) -> Reference {
    with_settings(scene, ReferenceSettings::default())
}

pub fn with_settings(scene: &Scene, settings: ReferenceSettings) -> Reference {
    Reference::new(scene, settings).expect("a scene that the reference knows")
}
