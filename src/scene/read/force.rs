//! Forces: `GravityPoint`, `GravityPlane` and, since 1.1, `SpaceAverse`.

use compact_str::CompactString;
use glam::DVec3;

use super::cosmetic::Cosmetics;
use super::log::Log;
use crate::scene::rules::Range;
use crate::scene::tree::View;
use crate::scene::{Force, ForceKind};

pub(in crate::scene) const FORCES: [&str; 3] = ["GravityPoint", "GravityPlane", "SpaceAverse"];

/// Density of air, kg/m³: what a `SpaceAverse` without `Density` has.
const AIR_DENSITY: f64 = 1.276;

/// Reads a force. What is wrong is reported and takes its default.
pub(super) fn read<'a>(el: View<'a>, log: &mut Log<'a>, cosmetics: Cosmetics) -> Force {
    let kind = match el.name() {
        "GravityPoint" => {
            let (position, gravity) = place_and_gravity(el, log);
            let intensity = gravity.and_then(|gravity| log.scalar(gravity, Range::Any)).unwrap_or(0.0);
            ForceKind::GravityPoint { position, intensity }
        }
        "GravityPlane" => {
            let (position, gravity) = place_and_gravity(el, log);
            let acceleration =
                gravity.and_then(|gravity| log.vector(gravity, Range::Any)).unwrap_or(DVec3::ZERO);
            ForceKind::GravityPlane { position, acceleration }
        }
        _ => {
            let [density] = log.children(el, ["Density"]);
            let density = density.and_then(|density| log.scalar(density, Range::NotNegative));
            ForceKind::Drag { density: density.unwrap_or(AIR_DENSITY) }
        }
    };
    Force {
        key: el.node.key,
        id: 0,
        label: CompactString::default(),
        name: cosmetics.name,
        group: cosmetics.group,
        hidden: cosmetics.hidden,
        locked: cosmetics.locked,
        kind,
    }
}

fn place_and_gravity<'a>(el: View<'a>, log: &mut Log<'a>) -> (DVec3, Option<View<'a>>) {
    let [translation, gravity] = log.children(el, ["Translation", "Gravity"]);
    // That of a GravityPlane is only where it is drawn.
    if translation.is_none() && el.name() == "GravityPoint" {
        let hint = "write <Translation X=\"…\" Y=\"…\" Z=\"…\" />";
        log.error(el.place(), "the force has no Translation", hint);
    }
    let position = translation.and_then(|el| log.vector(el, Range::Any)).unwrap_or(DVec3::ZERO);
    if gravity.is_none() {
        log.warn(el.place(), "the force has no Gravity, so it does nothing", "write a Gravity element");
    }
    (position, gravity)
}
