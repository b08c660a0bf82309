//! A body as it moves, as what it is to start with.

use glam::{DMat3, DVec3};

use crate::scene::{BodyChange, euler_angles};
use crate::sim::Rotation;

/// The changes that let a body start where and how it moves now: place, velocity, and where bodies rub how it is turned
/// and turns.
pub fn as_start(
    position: DVec3,
    velocity: DVec3,
    turn: Option<Rotation>,
) -> impl Iterator<Item = BodyChange> {
    let moves = [BodyChange::Position(position), BodyChange::Velocity(velocity)];
    let turns = turn.map(|Rotation { orientation, spin }| {
        let angles = euler_angles(DMat3::from_quat(orientation));
        [BodyChange::Rotation(angles), BodyChange::Spin(spin)]
    });
    moves.into_iter().chain(turns.into_iter().flatten())
}
