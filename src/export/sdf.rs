//! SDF 1.9, the XML of Gazebo: one model per body, surfaces that bounce and rub, start velocities as a state.

use std::io;

use super::aspect::Aspect;
use super::axes::{roll_pitch_yaw, z_up, z_up_rotation};
use super::contact::{Yielding, rolling_lever};
use super::error::ExportError;
use super::format::{Exported, Format, Source};
use super::names;
use super::range;
use super::report::{Fate, NO_FORCE_IDS, Report, approximated, dropped, kept, no_meaning, not_needed};
use super::slab::Slabs;
use super::xml::{Xml, number, numbers, rgba, vector};
use crate::scene::{Body, Motion, Shape};

pub(super) const FORMAT: Format = Format {
    id: "sdf",
    name: "Gazebo (SDF 1.9)",
    extension: "sdf",
    is_binary: false,
    moves: false,
    holds: "bodies, masses, uniform gravity, restitution of each surface",
    write,
};

const WORLD: &str = "PolyScene";

struct Writer<'a> {
    source: &'a Source<'a>,
    names: Vec<String>,
    contact: Yielding,
    slabs: Slabs,
    two_sided: usize,
    xml: Xml,
}

fn write(source: &Source<'_>) -> Result<Exported, ExportError> {
    range::doubles(source, FORMAT.name)?;
    let contact = Yielding::of(source);
    let mut writer = Writer {
        source,
        names: names::unique(source.scene, &["world", "sun"], clean),
        contact,
        slabs: Slabs::of(source, &contact),
        two_sided: 0,
        xml: Xml::new()?,
    };
    writer.file()?;
    let report = Report::of(source, |aspect| writer.fate(aspect));
    Ok(Exported { bytes: writer.xml.into_bytes(), report })
}

/// `::` parts names, and names within double underscores are reserved.
fn clean(name: &str) -> String {
    let name = name.replace("::", "-");
    if name.starts_with("__") { format!("body{name}") } else { name }
}

impl Writer<'_> {
    fn file(&mut self) -> io::Result<()> {
        self.xml.open("sdf", &[("version", "1.9")])?;
        self.xml.open("world", &[("name", WORLD)])?;
        self.xml.open("physics", &[("name", "steps"), ("type", "ode")])?;
        self.xml.text("max_step_size", &number(self.contact.step))?;
        self.xml.text("real_time_factor", &number(self.source.scene.time_speed))?;
        self.xml.close("physics")?;
        self.xml.text("gravity", &vector(z_up(self.source.gravity())))?;
        self.light()?;
        for (at, body) in self.source.scene.bodies.iter().enumerate() {
            self.model(at, body)?;
        }
        self.state()?;
        self.xml.close("world")?;
        self.xml.close("sdf")
    }

    fn light(&mut self) -> io::Result<()> {
        self.xml.open("light", &[("name", "sun"), ("type", "directional")])?;
        self.xml.text("direction", "-0.3 0.4 -0.9")?;
        self.xml.close("light")
    }

    fn model(&mut self, at: usize, body: &Body) -> io::Result<()> {
        let name = self.names[at].clone();
        self.xml.open("model", &[("name", &name)])?;
        self.xml.text("static", if body.is_dynamic() { "false" } else { "true" })?;
        self.xml.text("pose", &pose(body))?;
        self.xml.open("link", &[("name", "link")])?;
        self.inertia(body)?;
        self.part("collision", body)?;
        if !body.hidden {
            self.part("visual", body)?;
        }
        self.xml.close("link")?;
        self.xml.close("model")
    }

    fn inertia(&mut self, body: &Body) -> io::Result<()> {
        let (Motion::Dynamic { mass, .. }, Shape::Sphere { radius }) = (body.motion, &body.shape) else {
            return Ok(());
        };
        let moment = number(0.4 * mass * radius * radius);
        self.xml.open("inertial", &[])?;
        self.xml.text("mass", &number(mass))?;
        self.xml.open("inertia", &[])?;
        for axis in ["ixx", "iyy", "izz"] {
            self.xml.text(axis, &moment)?;
        }
        for axis in ["ixy", "ixz", "iyz"] {
            self.xml.text(axis, "0")?;
        }
        self.xml.close("inertia")?;
        self.xml.close("inertial")
    }

    /// The shape as it collides, or as it is seen.
    fn part(&mut self, kind: &str, body: &Body) -> io::Result<()> {
        if matches!(body.shape, Shape::Unbuilt { .. }) {
            return Ok(());
        }
        self.xml.open(kind, &[("name", kind)])?;
        self.geometry(kind == "collision", body)?;
        if kind == "collision" {
            self.surface(body)?;
        } else if let Some(color) = body.color {
            self.xml.open("material", &[])?;
            self.xml.text("ambient", &rgba(color))?;
            self.xml.text("diffuse", &rgba(color))?;
            self.xml.close("material")?;
        }
        self.xml.close(kind)
    }

    fn geometry(&mut self, collides: bool, body: &Body) -> io::Result<()> {
        match body.shape {
            Shape::Sphere { radius } => {
                self.xml.open("geometry", &[])?;
                self.xml.open("sphere", &[])?;
                self.xml.text("radius", &number(radius))?;
                self.xml.close("sphere")?;
            }
            Shape::Plane { half_x, half_y } => {
                let slab = self.slabs.of_plate(body);
                self.two_sided += usize::from(collides && slab.offset == 0.0);
                self.xml.text("pose", &format!("0 0 {} 0 0 0", number(slab.offset)))?;
                self.xml.open("geometry", &[])?;
                self.xml.open("box", &[])?;
                self.xml
                    .text("size", &numbers(&[half_x, half_y, slab.half_thickness].map(|half| 2.0 * half)))?;
                self.xml.close("box")?;
            }
            Shape::Unbuilt { .. } => return Ok(()),
        }
        self.xml.close("geometry")
    }

    /// Without a threshold of 0 nothing slower than 100 km/s would bounce.
    fn surface(&mut self, body: &Body) -> io::Result<()> {
        self.xml.open("surface", &[])?;
        self.xml.open("bounce", &[])?;
        self.xml.text("restitution_coefficient", &number(body.bounce.min(1.0)))?;
        self.xml.text("threshold", "0")?;
        self.xml.close("bounce")?;
        self.xml.open("friction", &[])?;
        self.xml.open("ode", &[])?;
        let friction = number(body.roughness.friction);
        self.xml.text("mu", &friction)?;
        self.xml.text("mu2", &friction)?;
        self.xml.close("ode")?;
        self.rolling(body, &friction)?;
        self.xml.close("friction")?;
        self.xml.close("surface")
    }

    /// Of engines that SDF knows only Bullet resists rolling. What stands still is met by the smallest moving sphere.
    fn rolling(&mut self, body: &Body, friction: &str) -> io::Result<()> {
        if body.roughness.rolling == 0.0 {
            return Ok(());
        }
        let radius = match (&body.shape, body.is_dynamic()) {
            (Shape::Sphere { radius }, true) => *radius,
            _ => self.contact.radius,
        };
        self.xml.open("bullet", &[])?;
        self.xml.text("friction", friction)?;
        self.xml.text("friction2", friction)?;
        self.xml.text("rolling_friction", &number(rolling_lever(body.roughness.rolling, radius)))?;
        self.xml.close("bullet")
    }

    /// Velocities at the start.
    fn state(&mut self) -> io::Result<()> {
        let moving: Vec<_> = (self.source.scene.bodies.iter().enumerate())
            .filter_map(|(at, body)| match body.motion {
                Motion::Dynamic { velocity, .. }
                    if velocity != glam::DVec3::ZERO || body.spin != glam::DVec3::ZERO =>
                {
                    Some((at, body, velocity))
                }
                Motion::Dynamic { .. } | Motion::Static => None,
            })
            .collect();
        if moving.is_empty() {
            return Ok(());
        }
        self.xml.open("state", &[("world_name", WORLD)])?;
        for (at, body, velocity) in moving {
            let name = self.names[at].clone();
            self.xml.open("model", &[("name", &name)])?;
            self.xml.text("pose", &pose(body))?;
            self.xml.open("link", &[("name", "link")])?;
            self.xml.text("pose", &pose(body))?;
            self.xml.text("velocity", &format!("{} {}", vector(z_up(velocity)), vector(z_up(body.spin))))?;
            self.xml.close("link")?;
            self.xml.close("model")?;
        }
        self.xml.close("state")
    }

    fn fate(&self, aspect: Aspect) -> Fate {
        match aspect {
            Aspect::Spheres => kept("as models, z up"),
            Aspect::Plates => approximated(self.slabs.how(self.two_sided)),
            Aspect::Unbuilt => dropped("models without a shape are left"),
            Aspect::Masses => kept("with the inertia of solid spheres"),
            Aspect::Velocities => {
                approximated("as a state of the world, which Gazebo Classic reads and gz sim does not")
            }
            Aspect::Bounce => approximated(format!(
                "each surface has its Bounce, above 1 as 1; engines mix two of them in their own ways (here it is the \
                 product) and take steps, of {:.3e} s",
                self.contact.step
            )),
            Aspect::Frictionless => kept("as mu 0 and mu2 0"),
            Aspect::Friction => approximated(
                "each surface has its own as mu and mu2; ODE takes the smaller of two (here: geometric mean)",
            ),
            Aspect::RollingFriction => approximated(
                "as rolling_friction of Bullet, a lever of 7/5 of coefficient and radius (of what stands still: of the \
                 smallest moving sphere); other engines have none",
            ),
            Aspect::Tangential => dropped("SDF restores no slip"),
            Aspect::Spins => {
                approximated("as a state of the world, which Gazebo Classic reads and gz sim does not")
            }
            Aspect::UniformGravity => kept("as their sum"),
            Aspect::PointGravity => dropped("a world has one uniform gravity"),
            Aspect::Drag => dropped("there is no drag of air without a plugin"),
            Aspect::UserIds => dropped("models go by name; without one it is the UserID"),
            Aspect::ForceIds => not_needed(NO_FORCE_IDS),
            Aspect::BodyNames => kept("made unique where they repeat"),
            Aspect::Groups => dropped("each body is a model of the world"),
            Aspect::Colors => kept(""),
            Aspect::Hidden => kept("by leaving out the visual"),
            Aspect::Locked => not_needed("protects bodies in this editor"),
            Aspect::Materials => dropped("names of materials are for forces of code"),
            Aspect::ForceLooks => not_needed("says where this editor draws and lists a force"),
            Aspect::Map => not_needed("a search grid, on which no result depends"),
            Aspect::TimeSpeed => kept("as real_time_factor"),
            Aspect::Solver => dropped("settings of this program's core"),
            Aspect::Viewpoints => dropped("not written by this version"),
            Aspect::Motion => dropped("it has a start only"),
            Aspect::Comments | Aspect::Unknown => no_meaning(),
        }
    }
}

/// Place and fixed-axis angles.
fn pose(body: &Body) -> String {
    let angles = roll_pitch_yaw(z_up_rotation(body.rotation));
    format!("{} {}", vector(z_up(body.position)), vector(angles))
}
