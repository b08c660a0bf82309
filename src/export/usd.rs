//! USD as text with `UsdPhysics`: y up, metres, kilograms; plates are static meshes of one square, hit from both sides.

use std::fmt::Write as _;

use glam::DVec3;

use super::aspect::Aspect;
use super::axes::quaternion;
use super::error::ExportError;
use super::format::{Exported, Format, Source};
use super::motion::{Animation, Frames, Key};
use super::names;
use super::range;
use super::report::{Fate, NO_FORCE_IDS, Report, approximated, dropped, kept, no_meaning, not_needed};
use super::xml::number;
use crate::scene::{Body, Motion, Shape, escaped, rotation_matrix};

pub(super) const FORMAT: Format = Format {
    id: "usd",
    name: "USD with physics, text",
    extension: "usda",
    is_binary: false,
    moves: true,
    holds: "bodies, masses, motion, start velocities, uniform gravity, restitution of each body",
    write,
};

fn write(source: &Source<'_>) -> Result<Exported, ExportError> {
    range::singles(source, FORMAT.name)?;
    let mut text = header(source.motion);
    gravity(&mut text, source.gravity());
    let surfaces = surfaces(source);
    materials(&mut text, &surfaces);
    text.push_str("    def Xform \"Bodies\"\n    {\n");
    for (body, name) in source.scene.bodies.iter().zip(names::identifiers(source.scene)) {
        prim(&mut text, source, body, &name, &surfaces);
    }
    text.push_str("    }\n}\n");
    Ok(Exported { bytes: text.into_bytes(), report: Report::of(source, fate) })
}

fn header(motion: Option<&Animation>) -> String {
    let timing = motion.map(|motion| {
        let Frames { from, to, fps } = motion.frames;
        format!(
            "    endTimeCode = {}
    startTimeCode = 0
    timeCodesPerSecond = {}
",
            number((to - from) * fps),
            number(fps)
        )
    });
    format!(
        "#usda 1.0
(
    defaultPrim = \"World\"
    kilogramsPerUnit = 1
    metersPerUnit = 1
    upAxis = \"Y\"
{})

def Xform \"World\"
{{
",
        timing.unwrap_or_default()
    )
}

fn gravity(text: &mut String, gravity: DVec3) {
    let magnitude = gravity.length();
    let direction = gravity.try_normalize().unwrap_or(DVec3::NEG_Y);
    let _ = write!(
        text,
        "    def PhysicsScene \"PhysicsScene\"
    {{
        vector3f physics:gravityDirection = {}
        float physics:gravityMagnitude = {}
    }}

",
        tuple(&direction.to_array()),
        number(magnitude)
    );
}

/// Bounce and friction of a body.
type Surface = (f64, f64);

fn surface(body: &Body) -> Surface {
    (body.bounce, body.roughness.friction)
}

fn in_order(one: &Surface, other: &Surface) -> std::cmp::Ordering {
    one.0.total_cmp(&other.0).then(one.1.total_cmp(&other.1))
}

/// The different surfaces, in order.
fn surfaces(source: &Source<'_>) -> Vec<Surface> {
    let mut surfaces: Vec<_> = source.scene.bodies.iter().map(surface).collect();
    surfaces.sort_by(in_order);
    surfaces.dedup();
    surfaces
}

/// One per surface. How two mix is not said by USD; PhysX is told to multiply their restitutions.
fn materials(text: &mut String, surfaces: &[Surface]) {
    text.push_str("    def Scope \"Materials\"\n    {\n");
    for (at, (bounce, friction)) in surfaces.iter().enumerate() {
        let _ = write!(
            text,
            "        def Material \"Bounce{at}\" (
            prepend apiSchemas = [\"PhysicsMaterialAPI\"]
        )
        {{
            float physics:dynamicFriction = {friction}
            float physics:restitution = {}
            float physics:staticFriction = {friction}
            custom uniform token physxMaterial:restitutionCombineMode = \"multiply\"
        }}
",
            number(bounce.min(1.0)),
            friction = number(*friction)
        );
    }
    text.push_str("    }\n\n");
}

fn prim(text: &mut String, source: &Source<'_>, body: &Body, name: &str, surfaces: &[Surface]) {
    let kind = match body.shape {
        Shape::Sphere { .. } => "Sphere",
        Shape::Plane { .. } => "Mesh",
        Shape::Unbuilt { .. } => "Xform",
    };
    let collides = !matches!(body.shape, Shape::Unbuilt { .. });
    let schemas = [
        (collides, "PhysicsCollisionAPI"),
        (kind == "Mesh", "PhysicsMeshCollisionAPI"),
        (body.is_dynamic(), "PhysicsRigidBodyAPI"),
        (body.is_dynamic(), "PhysicsMassAPI"),
        (collides, "MaterialBindingAPI"),
    ];
    let schemas: Vec<_> =
        schemas.iter().filter(|(has, _)| *has).map(|(_, schema)| format!("\"{schema}\"")).collect();
    let _ = write!(
        text,
        "        def {kind} \"{name}\" (
            customData = {{
{}            }}
            displayName = {}
            prepend apiSchemas = [{}]
        )
        {{
",
        custom_data(body),
        quoted(body.display_name()),
        schemas.join(", ")
    );
    for line in attributes(body, surfaces) {
        let _ = writeln!(text, "            {line}");
    }
    if let Some(motion) = source.motion {
        time_samples(text, body, motion);
    }
    text.push_str("        }\n");
}

fn custom_data(body: &Body) -> String {
    let mut data = format!("                string UserID = {}\n", quoted(&body.id.to_string()));
    for (name, value) in [("group", &body.group), ("material", &body.material)] {
        if let Some(value) = value {
            let _ = writeln!(data, "                string {name} = {}", quoted(value));
        }
    }
    data
}

fn attributes(body: &Body, surfaces: &[Surface]) -> Vec<String> {
    let mut lines = shape(&body.shape);
    if let Motion::Dynamic { mass, velocity } = body.motion {
        lines.push(format!("float physics:mass = {}", number(mass)));
        lines.push(format!("vector3f physics:velocity = {}", tuple(&velocity.to_array())));
        if body.spin != DVec3::ZERO {
            let degrees = body.spin.to_array().map(f64::to_degrees);
            lines.push(format!("vector3f physics:angularVelocity = {}", tuple(&degrees)));
        }
    }
    if !matches!(body.shape, Shape::Unbuilt { .. }) {
        let own = surface(body);
        let at = surfaces.binary_search_by(|other| in_order(other, &own)).unwrap_or_default();
        lines.push(format!("rel material:binding:physics = </World/Materials/Bounce{at}>"));
    }
    if let Some(color) = body.color {
        let color = color.map(|channel| (f64::from(channel) / 255.0 * 1e4).round() / 1e4);
        lines.push(format!("color3f[] primvars:displayColor = [{}]", tuple(&color)));
    }
    if body.hidden {
        lines.push("token visibility = \"invisible\"".into());
    }
    let q = quaternion(rotation_matrix(body.rotation));
    lines.push(format!("quatd xformOp:orient = {}", tuple(&[q.w, q.x, q.y, q.z])));
    lines.push(format!("double3 xformOp:translate = {}", tuple(&body.position.to_array())));
    lines.push("uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:orient\"]".into());
    lines
}

/// Where a moving body is at each frame. An engine must follow that and not move it itself.
fn time_samples(text: &mut String, body: &Body, motion: &Animation) {
    let Some(keys) = motion.keys(body.key) else { return };
    text.push_str("            bool physics:kinematicEnabled = 1\n");
    let code = |key: &Key| number((key.time - motion.frames.from) * motion.frames.fps);
    text.push_str("            double3 xformOp:translate.timeSamples = {\n");
    for key in &keys {
        let _ = writeln!(text, "                {}: {},", code(key), tuple(&key.position.to_array()));
    }
    text.push_str("            }\n");
    if keys.iter().any(|key| key.orientation.is_some()) {
        text.push_str("            quatd xformOp:orient.timeSamples = {\n");
        for (key, q) in keys.iter().filter_map(|key| Some((key, key.orientation?))) {
            let _ = writeln!(text, "                {}: {},", code(key), tuple(&[q.w, q.x, q.y, q.z]));
        }
        text.push_str("            }\n");
    }
}

fn shape(shape: &Shape) -> Vec<String> {
    match *shape {
        Shape::Sphere { radius } => vec![
            format!("float3[] extent = [{}, {}]", tuple(&[-radius; 3]), tuple(&[radius; 3])),
            format!("double radius = {}", number(radius)),
        ],
        Shape::Plane { half_x: x, half_y: y } => vec![
            "uniform bool doubleSided = 1".into(),
            format!("float3[] extent = [{}, {}]", tuple(&[-x, -y, 0.0]), tuple(&[x, y, 0.0])),
            "int[] faceVertexCounts = [4]".into(),
            "int[] faceVertexIndices = [0, 1, 2, 3]".into(),
            format!(
                "point3f[] points = [{}, {}, {}, {}]",
                tuple(&[-x, -y, 0.0]),
                tuple(&[x, -y, 0.0]),
                tuple(&[x, y, 0.0]),
                tuple(&[-x, y, 0.0])
            ),
            "uniform token subdivisionScheme = \"none\"".into(),
            // The triangles themselves, not their convex hull.
            "uniform token physics:approximation = \"none\"".into(),
        ],
        Shape::Unbuilt { .. } => Vec::new(),
    }
}

fn tuple(values: &[f64]) -> String {
    let values: Vec<_> = values.iter().map(|value| number(*value)).collect();
    format!("({})", values.join(", "))
}

/// A string of USD, which knows no escapes but these.
fn quoted(text: &str) -> String {
    format!("\"{}\"", escaped(text).replace('\\', "\\\\").replace('"', "\\\""))
}

fn fate(aspect: Aspect) -> Fate {
    match aspect {
        Aspect::Spheres => kept(""),
        Aspect::Plates => kept("as meshes of one square that collide as they are"),
        Aspect::Unbuilt => dropped("frames without a shape are left"),
        Aspect::Masses => kept("to the digits of a 32-bit number"),
        Aspect::Velocities => kept("to the digits of a 32-bit number"),
        Aspect::Bounce => approximated(
            "each body has its Bounce, above 1 as 1; how two mix is up to the engine (PhysX is told to multiply, as here)",
        ),
        Aspect::Frictionless => kept("as friction 0"),
        Aspect::Friction => approximated(
            "each body has its own as static and dynamic friction; how two mix is up to the engine (here: geometric mean)",
        ),
        Aspect::RollingFriction => dropped("UsdPhysics has none"),
        Aspect::Tangential => dropped("UsdPhysics restores no slip"),
        Aspect::Spins => kept("in degrees per second, to the digits of a 32-bit number"),
        Aspect::UniformGravity => kept("as their sum"),
        Aspect::PointGravity => dropped("a PhysicsScene has one uniform gravity"),
        Aspect::Drag => dropped("UsdPhysics has no drag of air"),
        Aspect::UserIds => kept("in customData"),
        Aspect::ForceIds => not_needed(NO_FORCE_IDS),
        Aspect::BodyNames => kept("as displayName; names of prims are letters and digits"),
        Aspect::Groups | Aspect::Materials => kept("in customData"),
        Aspect::Colors => kept("as displayColor"),
        Aspect::Hidden => kept("as invisible"),
        Aspect::Locked => not_needed("protects bodies in this editor"),
        Aspect::ForceLooks => not_needed("says where this editor draws and lists a force"),
        Aspect::Map => not_needed("a search grid, on which no result depends"),
        Aspect::TimeSpeed => dropped("time samples go by model time"),
        Aspect::Solver => dropped("settings of this program's core"),
        Aspect::Viewpoints => dropped("not written by this version"),
        Aspect::Motion => approximated(
            "as time samples of kinematic bodies, along straight lines between the frames and the events of a body, by the shorter turn; time code 0 is the first",
        ),
        Aspect::Comments | Aspect::Unknown => no_meaning(),
    }
}
