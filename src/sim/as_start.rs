//! A body as it moves, as what it is to start with.

use glam::{DMat3, DVec3};

use super::report::Rotation;
use crate::scene::{BodyChange, euler_near};

/// The changes that let a body start where and how it moves now: place, velocity, and where bodies rub how it is turned
/// and turns.
pub fn as_start(
    position: DVec3,
    velocity: DVec3,
    turn: Option<Rotation>,
) -> impl Iterator<Item = BodyChange> {
    let moves = [BodyChange::Position(position), BodyChange::Velocity(velocity)];
    let turns = turn.map(|Rotation { orientation, spin }| {
        let angles = euler_near(DMat3::from_quat(orientation), DVec3::ZERO);
        [BodyChange::Rotation(angles), BodyChange::Spin(spin)]
    });
    moves.into_iter().chain(turns.into_iter().flatten())
}
