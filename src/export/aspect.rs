//! Everything a scene can say, one row each. Every format answers for every row, by an exhaustive `match`: what is
//! added here is lost nowhere silently.

use super::format::Source;
use super::motion::{Animation, Frames};
use crate::scene::{Body, Force, ForceKind, Motion, PARAMS, Shape, SimParams};

/// One thing that scenes say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aspect {
    Spheres,
    Plates,
    /// Shapes this version cannot simulate.
    Unbuilt,
    Masses,
    Velocities,
    /// Restitution, the product of both bodies' Bounce.
    Bounce,
    /// That contact is without friction, so that nothing begins to spin.
    Frictionless,
    /// Coulomb's friction, the geometric mean of both bodies' coefficients.
    Friction,
    RollingFriction,
    /// Tangential restitution.
    Tangential,
    /// Angular velocities at the start.
    Spins,
    UniformGravity,
    PointGravity,
    Drag,
    UserIds,
    ForceIds,
    BodyNames,
    Groups,
    Colors,
    Hidden,
    Locked,
    Materials,
    /// Name, group, place and switches of a force, which say how it is shown.
    ForceLooks,
    Map,
    TimeSpeed,
    Solver,
    Viewpoints,
    Comments,
    /// How the scene goes on, sampled at frames.
    Motion,
    /// Elements, attributes, texts and instructions that the format does not know.
    Unknown,
}

pub(super) struct AspectInfo {
    pub aspect: Aspect,
    one: &'static str,
    many: &'static str,
    /// What of it a scene has, by name.
    pub found: fn(&Source<'_>) -> Vec<String>,
}

impl AspectInfo {
    /// `2 point gravities (sun, 7)`; `None` for none.
    pub fn counted(&self, found: &[String]) -> Option<String> {
        const MOST_NAMED: usize = 3;
        let noun = if found.len() == 1 { self.one } else { self.many };
        let named: Vec<_> = found.iter().map(String::as_str).filter(|name| !name.is_empty()).collect();
        // Where there are many, their number says it.
        let names = if (1..=MOST_NAMED).contains(&named.len()) {
            format!(" ({})", named.join(", "))
        } else {
            String::new()
        };
        (!found.is_empty()).then(|| format!("{} {noun}{names}", found.len()))
    }
}

const fn row(
    aspect: Aspect,
    one: &'static str,
    many: &'static str,
    found: fn(&Source<'_>) -> Vec<String>,
) -> AspectInfo {
    AspectInfo { aspect, one, many, found }
}

/// In the order in which they are reported.
pub(super) const ASPECTS: &[AspectInfo] = &[
    row(Aspect::Spheres, "sphere", "spheres", |s| {
        bodies(s, |body| matches!(body.shape, Shape::Sphere { .. }))
    }),
    row(Aspect::Plates, "bounded plane", "bounded planes", |s| {
        bodies(s, |body| matches!(body.shape, Shape::Plane { .. }))
    }),
    row(Aspect::Unbuilt, "shape that is not simulated", "shapes that are not simulated", |s| {
        bodies(s, |body| matches!(body.shape, Shape::Unbuilt { .. }))
    }),
    row(Aspect::Masses, "mass", "masses", |s| bodies(s, Body::is_dynamic)),
    row(Aspect::Velocities, "start velocity", "start velocities", |s| bodies(s, moves)),
    row(Aspect::Bounce, "restitution", "restitutions", |s| bodies(s, |_| true)),
    row(Aspect::Frictionless, "contact law without friction", "", |s| {
        let is_smooth = s.scene.bodies.iter().all(|body| body.roughness.friction == 0.0);
        if is_smooth && s.dynamic().next().is_some() { vec![String::new()] } else { Vec::new() }
    }),
    row(Aspect::Friction, "friction", "frictions", |s| bodies(s, |body| body.roughness.friction != 0.0)),
    row(Aspect::RollingFriction, "rolling friction", "rolling frictions", |s| {
        bodies(s, |body| body.roughness.rolling != 0.0)
    }),
    row(Aspect::Tangential, "tangential restitution", "tangential restitutions", |s| {
        bodies(s, |body| body.roughness.tangential != 0.0)
    }),
    row(Aspect::Spins, "start spin", "start spins", |s| bodies(s, |body| body.spin != glam::DVec3::ZERO)),
    row(Aspect::UniformGravity, "uniform gravity", "uniform gravities", |s| {
        forces(s, |force| matches!(force.kind, ForceKind::GravityPlane { .. }))
    }),
    row(Aspect::PointGravity, "point gravity", "point gravities", |s| {
        forces(s, |force| matches!(force.kind, ForceKind::GravityPoint { .. }))
    }),
    row(Aspect::Drag, "air drag", "air drags", |s| {
        forces(s, |force| matches!(force.kind, ForceKind::Drag { .. }))
    }),
    row(Aspect::UserIds, "UserID of a body", "UserIDs of bodies", |s| {
        s.scene.bodies.iter().map(|body| body.label.to_string()).collect()
    }),
    row(Aspect::ForceIds, "UserID of a force", "UserIDs of forces", |s| {
        s.scene.forces.iter().map(|force| force.label.to_string()).collect()
    }),
    row(Aspect::BodyNames, "name of a body", "names of bodies", |s| bodies(s, |body| body.name.is_some())),
    row(Aspect::Groups, "body in a group", "bodies in groups", |s| bodies(s, |body| body.group.is_some())),
    row(Aspect::Colors, "colour", "colours", |s| bodies(s, |body| body.color.is_some())),
    row(Aspect::Hidden, "hidden body", "hidden bodies", |s| bodies(s, |body| body.hidden)),
    row(Aspect::Locked, "locked body", "locked bodies", |s| bodies(s, |body| body.locked)),
    row(Aspect::Materials, "material", "materials", |s| bodies(s, |body| body.material.is_some())),
    row(Aspect::ForceLooks, "place or name of a force", "places and names of forces", |s| {
        forces(s, |force| force.name.is_some() || !matches!(force.kind, ForceKind::Drag { .. }))
    }),
    row(Aspect::Map, "map with its tiles", "", |_| vec![String::new()]),
    row(Aspect::TimeSpeed, "speed of watching", "", |s| {
        if s.scene.time_speed == 1.0 { Vec::new() } else { vec![s.scene.time_speed.to_string()] }
    }),
    row(Aspect::Solver, "setting of the solver", "settings of the solver", |s| {
        let default = SimParams::default();
        let set = PARAMS.iter().filter(|info| (info.get)(&s.scene.params) != (info.get)(&default));
        set.map(|info| info.name.to_owned()).collect()
    }),
    row(Aspect::Viewpoints, "saved viewpoint", "saved viewpoints", |s| {
        s.document.viewpoints().into_iter().map(|viewpoint| viewpoint.name).collect()
    }),
    row(Aspect::Comments, "comment", "comments", |s| vec![String::new(); s.foreign.comments]),
    row(Aspect::Motion, "motion", "", |s| {
        let of = |motion: &Animation| {
            let Frames { from, to, .. } = motion.frames;
            format!("{from} s to {to} s in {} frames", motion.times.len())
        };
        s.motion.iter().map(|motion| of(motion)).collect()
    }),
    row(Aspect::Unknown, "piece unknown here", "pieces unknown here", |s| s.foreign.unknown.clone()),
];

fn moves(body: &Body) -> bool {
    matches!(body.motion, Motion::Dynamic { velocity, .. } if velocity != glam::DVec3::ZERO)
}

fn bodies(source: &Source<'_>, wanted: impl Fn(&Body) -> bool) -> Vec<String> {
    let found = source.scene.bodies.iter().filter(|body| wanted(body));
    found.map(|body| body.display_name().to_owned()).collect()
}

fn forces(source: &Source<'_>, wanted: impl Fn(&Force) -> bool) -> Vec<String> {
    let found = source.scene.forces.iter().filter(|force| wanted(force));
    found.map(|force| force.name.clone().unwrap_or_else(|| force.label.to_string())).collect()
}
