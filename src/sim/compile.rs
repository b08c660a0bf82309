//! Scene → model and state: sorts bodies and forces by UserID, makes the tiles, decides the plan.

use glam::{DMat3, DVec3};

use super::body::{Bodies, Body, Identity, Origin, Rare};
use super::dense::set_step;
use super::force::ForceEntry;
use super::method::Method;
use super::model::{Model, StepSource};
use super::plan::plan_of;
use super::report::Plan;
use super::shape::{self, Plate, Sphere};
use super::tiles::{Grid, StaticTiles, coarse_enough};
use crate::scene::{
    self, Diagnostic, Force, ForceKind, Motion, Roughness, Scene, Severity, Shape, rotation_matrix,
};

/// The model, and where its dynamic bodies start (same order).
pub(super) fn compile(scene: &Scene, method: Method) -> Result<(Model, Vec<Origin>), Vec<Diagnostic>> {
    let mut sorted: Vec<&scene::Body> = scene.bodies.iter().collect();
    // Stable: bodies of the same id stay in file order.
    sorted.sort_by_key(|body| body.id);
    let dynamic = sorted.iter().filter(|body| body.is_dynamic()).count();
    let mut bodies = Bodies::with_room(dynamic);
    let mut origins = Vec::with_capacity(dynamic);
    let mut problems = check_world(scene);
    let mut order = 0;
    for (index, body) in sorted.iter().enumerate() {
        order = if index > 0 && sorted[index - 1].id == body.id { order + 1 } else { 0 };
        match compile_body(body, order) {
            Ok(Compiled { identity, body, origin }) => {
                if !bodies.push(identity, body, origin.position).is_static() {
                    origins.push(origin);
                }
            }
            Err(problem) => problems.push(problem),
        }
    }
    if !problems.is_empty() {
        return Err(problems);
    }
    let mut forces: Vec<ForceEntry> = scene.forces.iter().map(ForceEntry::of).collect();
    forces.sort_by_key(|force| force.id);
    let largest = bodies.dynamic().iter().map(|body| body.shape.radius()).fold(0.0, f64::max);
    let tile_limit = scene.params.static_tile_limit as u64;
    let grid = coarse_enough(Grid::new(&scene.map, largest), &bodies, tile_limit);
    let static_tiles = StaticTiles::new(&grid, &bodies, tile_limit);
    let mut model = Model {
        params: scene.params,
        method,
        bodies,
        forces,
        grid,
        static_tiles,
        dense_step: 0.0,
        step_source: StepSource::Nothing,
        plan: Plan::default(),
        start_warnings: Vec::new(),
    };
    model.plan = plan_of(&model);
    if model.plan.stepped_groups {
        set_step(&mut model, 0.0, |body| {
            let origin = &origins[body as usize];
            (origin.position, origin.velocity)
        });
    }
    Ok((model, origins))
}

/// One body of a model.
pub(super) struct Compiled {
    pub identity: Identity,
    pub body: Body,
    pub origin: Origin,
}

/// `order` is its place among those of its id.
pub(super) fn compile_body(body: &scene::Body, order: u32) -> Result<Compiled, Diagnostic> {
    check_numbers(body)?;
    let (mass, velocity) = match body.motion {
        Motion::Dynamic { mass, velocity } => (mass, velocity),
        Motion::Static => (f64::INFINITY, DVec3::ZERO),
    };
    let shape = compile_shape(body)?;
    let rare = Rare {
        material: body.material.as_deref().map(Box::from),
        roughness: body.roughness,
        // How a plate is turned is its shape's.
        rotation: if body.is_dynamic() { body.rotation } else { DVec3::ZERO },
        spin: if body.is_dynamic() { body.spin } else { DVec3::ZERO },
    };
    Ok(Compiled {
        identity: Identity::new(body.key, &body.label, body.display_name()),
        body: Body::new((body.id, order), mass, body.bounce, shape, rare),
        origin: Origin { position: body.position, velocity },
    })
}

fn compile_shape(body: &scene::Body) -> Result<shape::Shape, Diagnostic> {
    match (&body.motion, &body.shape) {
        (_, Shape::Sphere { radius }) => Ok(shape::Shape::Sphere(Sphere { radius: *radius })),
        (Motion::Static, Shape::Plane { half_x, half_y }) => {
            let frame = snapped(rotation_matrix(body.rotation));
            Ok(shape::Shape::Plate(Box::new(Plate {
                center: body.position,
                axis_x: frame.x_axis,
                axis_y: frame.y_axis,
                normal: frame.z_axis,
                half_x: *half_x,
                half_y: *half_y,
            })))
        }
        (Motion::Dynamic { .. }, Shape::Plane { .. }) => {
            Err(problem(body, "a plane cannot be dynamic", "make it a HardObject, or use another shape"))
        }
        (_, Shape::Unbuilt { element }) => Err(problem(
            body,
            &format!("{element} cannot be simulated by this version"),
            "remove the body, or replace what this version does not know",
        )),
    }
}

/// Scenes made by code have passed no reader.
fn check_numbers(body: &scene::Body) -> Result<(), Diagnostic> {
    let wrong = |what: &str, hint: &str| Err(problem(body, &format!("{what} is out of range"), hint));
    if !body.position.is_finite() || !body.rotation.is_finite() {
        return wrong("its position or rotation", "give finite numbers");
    }
    if !(body.bounce.is_finite() && body.bounce >= 0.0) {
        return wrong("its Bounce", "give a number of 0 or more");
    }
    check_roughness(&body.roughness).or_else(|hint| wrong("its friction", hint))?;
    if !body.spin.is_finite() {
        return wrong("its angular velocity", "give finite numbers");
    }
    if let (Motion::Dynamic { mass, .. }, Shape::Sphere { radius }) = (&body.motion, &body.shape)
        && !(mass * (radius * body.spin).length_squared()).is_finite()
    {
        return wrong("its angular velocity", "give one whose energy is a number");
    }
    if let Motion::Dynamic { mass, velocity } = body.motion
        && !(mass.is_finite() && mass > 0.0 && velocity.is_finite())
    {
        return wrong("its mass or velocity", "give a mass above 0 kg and a finite velocity");
    }
    let sizes = match body.shape {
        Shape::Sphere { radius } => [radius, radius],
        Shape::Plane { half_x, half_y } => [half_x, half_y],
        Shape::Unbuilt { .. } => return Ok(()),
    };
    if sizes.into_iter().all(|size| size.is_finite() && size > 0.0) {
        Ok(())
    } else {
        wrong("its size", "give sizes above 0 m")
    }
}

/// What is wrong with friction that no reader has seen.
pub(super) fn check_roughness(roughness: &Roughness) -> Result<(), &'static str> {
    let Roughness { friction, rolling, tangential } = *roughness;
    let is_sound = |value: f64| value.is_finite() && value >= 0.0;
    if is_sound(friction) && is_sound(rolling) && (0.0..=1.0).contains(&tangential) {
        Ok(())
    } else {
        Err("give friction of 0 or more, and a tangential restitution between 0 and 1")
    }
}

fn check_world(scene: &Scene) -> Vec<Diagnostic> {
    let mut problems = Vec::new();
    let size = scene.map.size;
    if !(size.is_finite() && size.min_element() > 0.0) || scene.map.tiles.contains(&0) {
        problems.push(Diagnostic {
            severity: Severity::Error,
            position: None,
            path: String::new(),
            message: "the map's size or tile counts are out of range".into(),
            hint: "give sizes above 0 m and counts above 0".into(),
            key: None,
        });
    }
    problems.extend(scene.forces.iter().filter_map(|force| check_force(force).err()));
    problems
}

pub(super) fn check_force(force: &Force) -> Result<(), Diagnostic> {
    let sound = match force.kind {
        ForceKind::GravityPoint { position, intensity } => position.is_finite() && intensity.is_finite(),
        ForceKind::GravityPlane { acceleration, .. } => acceleration.is_finite(),
        ForceKind::Drag { density } => density.is_finite() && density >= 0.0,
    };
    if sound {
        return Ok(());
    }
    Err(Diagnostic {
        severity: Severity::Error,
        position: None,
        path: String::new(),
        message: format!(
            "force {}: its numbers are out of range",
            force.name.as_deref().unwrap_or(&force.label)
        ),
        hint: "give finite numbers, and a density of 0 or more".into(),
        key: Some(force.key),
    })
}

fn problem(body: &scene::Body, what: &str, hint: &str) -> Diagnostic {
    Diagnostic {
        severity: Severity::Error,
        position: None,
        path: String::new(),
        message: format!("body {}: {what}", body.display_name()),
        hint: hint.into(),
        key: Some(body.key),
    }
}

/// Entries that are 0 or ±1 but for rounding become so. Else a floor turned by −π/2, which no binary
/// number equals, would be an incline of 6e-17 on which nothing ever lies still.
fn snapped(matrix: DMat3) -> DMat3 {
    const ROUNDING: f64 = 4.0 * f64::EPSILON;
    DMat3::from_cols_array(&matrix.to_cols_array().map(|entry| {
        if entry.abs() < ROUNDING {
            0.0
        } else if (entry.abs() - 1.0).abs() < ROUNDING {
            entry.signum()
        } else {
            entry
        }
    }))
}
