//! A table of the bodies, one row each (RFC 4180), for spreadsheets and scripts.

use super::aspect::Aspect;
use super::error::ExportError;
use super::format::{Exported, Format, Source};
use super::motion::{Animation, Sample};
use super::report::{Fate, Report, dropped, kept, no_meaning, not_needed};
use super::xml::number;
use crate::scene::{Body, Motion, Shape};

pub(super) const FORMAT: Format = Format {
    id: "csv",
    name: "Table of bodies (CSV)",
    extension: "csv",
    is_binary: false,
    moves: true,
    holds: "all about each body; no forces",
    write,
};

/// Of one body; empty where it has none.
type Cell = fn(&Body) -> String;

const COLUMNS: &[(&str, Cell)] = &[
    ("label", |body| body.label.to_string()),
    ("user_id", |body| body.id.to_string()),
    ("name", |body| text(body.name.as_deref())),
    ("group", |body| text(body.group.as_deref())),
    ("motion", |body| if body.is_dynamic() { "dynamic" } else { "static" }.into()),
    ("shape", |body| match &body.shape {
        Shape::Sphere { .. } => "sphere".into(),
        Shape::Plane { .. } => "plane".into(),
        Shape::Unbuilt { element } => text(Some(element)),
    }),
    ("x_m", |body| number(body.position.x)),
    ("y_m", |body| number(body.position.y)),
    ("z_m", |body| number(body.position.z)),
    ("alpha_rad", |body| number(body.rotation.x)),
    ("beta_rad", |body| number(body.rotation.y)),
    ("gamma_rad", |body| number(body.rotation.z)),
    ("radius_m", |body| match body.shape {
        Shape::Sphere { radius } => number(radius),
        Shape::Plane { .. } | Shape::Unbuilt { .. } => String::new(),
    }),
    ("half_x_m", |body| half_sides(body).map_or(String::new(), |[x, _]| number(x))),
    ("half_y_m", |body| half_sides(body).map_or(String::new(), |[_, y]| number(y))),
    ("mass_kg", |body| match body.motion {
        Motion::Dynamic { mass, .. } => number(mass),
        Motion::Static => String::new(),
    }),
    ("vx_m_per_s", |body| velocity(body, 0)),
    ("vy_m_per_s", |body| velocity(body, 1)),
    ("vz_m_per_s", |body| velocity(body, 2)),
    ("wx_rad_per_s", |body| spin(body, 0)),
    ("wy_rad_per_s", |body| spin(body, 1)),
    ("wz_rad_per_s", |body| spin(body, 2)),
    ("bounce", |body| number(body.bounce)),
    ("friction", |body| number(body.roughness.friction)),
    ("rolling_friction", |body| number(body.roughness.rolling)),
    ("tangential", |body| number(body.roughness.tangential)),
    ("material", |body| text(body.material.as_deref())),
    ("color", |body| body.color.map_or(String::new(), |[r, g, b]| format!("#{r:02x}{g:02x}{b:02x}"))),
    ("hidden", |body| body.hidden.to_string()),
    ("locked", |body| body.locked.to_string()),
];

fn write(source: &Source<'_>) -> Result<Exported, ExportError> {
    let lines = match source.motion {
        None => bodies(source),
        Some(motion) => motion_of(source, motion),
    };
    Ok(Exported { bytes: lines.into_bytes(), report: Report::of(source, |aspect| fate(source, aspect)) })
}

fn bodies(source: &Source<'_>) -> String {
    let head = COLUMNS.iter().map(|(name, _)| (*name).to_owned()).collect::<Vec<_>>();
    let rows = source.scene.bodies.iter().map(|body| COLUMNS.iter().map(|(_, cell)| cell(body)).collect());
    let lines = std::iter::once(head).chain(rows).map(|cells: Vec<String>| cells.join(",") + "\r\n");
    lines.collect()
}

/// The quaternion turns the body's axes to where they are; it and the angular velocity are empty where nothing rubs.
const MOTION_HEAD: &str = "t_s,label,name,x_m,y_m,z_m,vx_m_per_s,vy_m_per_s,vz_m_per_s,qx,qy,qz,qw,\
                           wx_rad_per_s,wy_rad_per_s,wz_rad_per_s\r\n";

/// Columns of it with numbers of a body.
const MOTION_NUMBERS: usize = 13;

/// One row for each moving body at each frame, frame by frame.
fn motion_of(source: &Source<'_>, motion: &Animation) -> String {
    let mut text = MOTION_HEAD.to_owned();
    let named = |body: &Body| format!("{},{}", body.label, self::text(body.name.as_deref()));
    let tracks = source.scene.bodies.iter().filter_map(|body| Some((named(body), motion.of(body.key)?)));
    let tracks: Vec<_> = tracks.collect();
    for (frame, time) in motion.times.iter().enumerate() {
        let time = number(*time);
        for (name, track) in &tracks {
            let Some(Sample { position, velocity, turn }) = track.get(frame) else { continue };
            let mut numbers = [position.to_array(), velocity.to_array()].concat();
            numbers.extend(turn.iter().flat_map(|turn| turn.orientation.to_array()));
            numbers.extend(turn.iter().flat_map(|turn| turn.spin.to_array()));
            let mut cells: Vec<_> = numbers.into_iter().map(number).collect();
            cells.resize(MOTION_NUMBERS, String::new());
            text.push_str(&format!("{time},{name},{}\r\n", cells.join(",")));
        }
    }
    text
}

/// In quotes where it holds what parts cells or lines.
fn text(text: Option<&str>) -> String {
    let text = text.unwrap_or_default();
    let parted = text.contains([',', '"', '\n', '\r']) || text.trim() != text;
    if parted { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

fn half_sides(body: &Body) -> Option<[f64; 2]> {
    match body.shape {
        Shape::Plane { half_x, half_y } => Some([half_x, half_y]),
        Shape::Sphere { .. } | Shape::Unbuilt { .. } => None,
    }
}

fn velocity(body: &Body, axis: usize) -> String {
    match body.motion {
        Motion::Dynamic { velocity, .. } => number(velocity.to_array()[axis]),
        Motion::Static => String::new(),
    }
}

fn spin(body: &Body, axis: usize) -> String {
    if body.is_dynamic() { number(body.spin.to_array()[axis]) } else { String::new() }
}

fn fate(source: &Source<'_>, aspect: Aspect) -> Fate {
    const NO_MOTION: [Aspect; 5] =
        [Aspect::BodyNames, Aspect::UserIds, Aspect::Motion, Aspect::Comments, Aspect::Unknown];
    match aspect {
        // The table of a motion has nothing else.
        other if source.motion.is_some() && !NO_MOTION.contains(&other) => {
            dropped("a table of motion has places, orientations and velocities of moving bodies only")
        }
        Aspect::Spheres
        | Aspect::Plates
        | Aspect::Masses
        | Aspect::Velocities
        | Aspect::Bounce
        | Aspect::Friction
        | Aspect::RollingFriction
        | Aspect::Tangential
        | Aspect::Spins
        | Aspect::BodyNames
        | Aspect::Groups
        | Aspect::Colors
        | Aspect::Hidden
        | Aspect::Locked
        | Aspect::Materials => kept(""),
        Aspect::Motion => kept("at the frames"),
        Aspect::UserIds => kept(""),
        Aspect::Unbuilt => dropped("the shape's name is kept, its sizes are not"),
        Aspect::Frictionless => not_needed("a table has no laws"),
        Aspect::UniformGravity
        | Aspect::PointGravity
        | Aspect::Drag
        | Aspect::ForceLooks
        | Aspect::ForceIds => dropped("the table has bodies only"),
        Aspect::Map => not_needed("a search grid, on which no result depends"),
        Aspect::TimeSpeed | Aspect::Solver | Aspect::Viewpoints => dropped("the table has bodies only"),
        Aspect::Comments | Aspect::Unknown => no_meaning(),
    }
}
