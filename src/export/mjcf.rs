//! MJCF, the XML of MuJoCo: bodies with free joints, restitution as contact damping, start velocities as a keyframe.

use std::io;

use glam::DVec3;

use super::aspect::Aspect;
use super::axes::{quaternion, z_up, z_up_rotation};
use super::contact::{Yielding, damping_ratio};
use super::error::ExportError;
use super::format::{Exported, Format, Source};
use super::names;
use super::pairs::{Pairs, Surface};
use super::range;
use super::report::{Fate, NO_FORCE_IDS, Report, approximated, dropped, kept, no_meaning, not_needed};
use super::slab::Slabs;
use super::xml::{Xml, number, numbers, rgba, vector};
use crate::scene::{Body, Motion, Shape};

pub(super) const FORMAT: Format = Format {
    id: "mjcf",
    name: "MuJoCo (MJCF)",
    extension: "mjcf.xml",
    is_binary: false,
    moves: false,
    holds: "bodies, masses, start velocities, uniform gravity, drag; restitution by damping",
    write,
};

/// The drag of a sphere is ½ C ρ πr² |v| v with C = 0.5; MuJoCo's ellipsoids have c ρ πr² |v| v.
const BLUNT_DRAG: &str = "0.25 0 0 0 0";

/// Impedance: at 1 a contact would bear any load without giving way, which MuJoCo's solver cannot.
const IMPEDANCE: &str = "0.99 0.99 0.001";

/// Contacts that resist sliding, spinning and rolling.
const WITH_ROLLING: &str = "6";

/// KiB for contacts and the solver; a body of a heap has a handful of contacts.
const BASE_MEMORY: usize = 16 * 1024;
const BODY_MEMORY: usize = 128;

struct Writer<'a> {
    source: &'a Source<'a>,
    names: Vec<String>,
    contact: Yielding,
    pairs: Pairs,
    slabs: Slabs,
    /// Plates with bodies on both sides.
    two_sided: usize,
    xml: Xml,
}

fn write(source: &Source<'_>) -> Result<Exported, ExportError> {
    range::doubles(source, FORMAT.name)?;
    range::surroundings(source, FORMAT.name)?;
    let contact = Yielding::of(source);
    let mut writer = Writer {
        source,
        names: names::unique(source.scene, &["world"], str::to_owned),
        contact,
        pairs: Pairs::of(source.scene),
        slabs: Slabs::of(source, &contact),
        two_sided: 0,
        xml: Xml::new()?,
    };
    writer.file()?;
    let report = Report::of(source, |aspect| writer.fate(aspect));
    Ok(Exported { bytes: writer.xml.into_bytes(), report })
}

impl Writer<'_> {
    fn file(&mut self) -> io::Result<()> {
        self.xml.open("mujoco", &[("model", "PolyScene")])?;
        self.xml.empty("compiler", &[("angle", "radian")])?;
        self.options()?;
        self.memory()?;
        self.map()?;
        self.xml.open("default", &[])?;
        let condim = if self.is_rough() { "3" } else { "1" };
        self.xml.empty("geom", &[("condim", condim), ("solimp", IMPEDANCE)])?;
        self.xml.empty("pair", &[("condim", condim), ("solimp", IMPEDANCE)])?;
        self.xml.close("default")?;
        self.xml.open("worldbody", &[])?;
        self.xml.empty("light", &[("directional", "true"), ("pos", "0 0 1"), ("dir", "-0.3 0.4 -0.9")])?;
        for (at, body) in self.source.scene.bodies.iter().enumerate() {
            self.body(at, body)?;
        }
        self.xml.close("worldbody")?;
        self.pair_elements()?;
        self.keyframe()?;
        self.xml.close("mujoco")
    }

    fn options(&mut self) -> io::Result<()> {
        let step = number(self.contact.step);
        let gravity = vector(z_up(self.source.gravity()));
        let density = number(self.source.air_density());
        // RK4: exact along parabolas, and it keeps the energy of elastic contact.
        let mut attributes =
            vec![("timestep", &*step), ("gravity", &gravity), ("density", &density), ("integrator", "RK4")];
        if self.is_rough() {
            // Coulomb's own: the usual pyramid slows a rolling ball too little.
            attributes.push(("cone", "elliptic"));
        }
        self.xml.empty("option", &attributes)
    }

    /// What MuJoCo takes unless told is quadratic in the number of bodies.
    fn memory(&mut self) -> io::Result<()> {
        let kibibytes =
            BASE_MEMORY.saturating_add(self.source.scene.bodies.len().saturating_mul(BODY_MEMORY));
        self.xml.empty("size", &[("memory", &format!("{kibibytes}K"))])
    }

    /// What the viewer frames, and the map as numbers of the user's own.
    fn map(&mut self) -> io::Result<()> {
        let map = self.source.scene.map;
        let (center, extent) = (vector(z_up(0.5 * map.size)), number(0.5 * map.size.length()));
        self.xml.empty("statistic", &[("center", &center), ("extent", &extent)])?;
        self.xml.open("custom", &[])?;
        self.xml.empty("numeric", &[("name", "map_size_y_up"), ("data", &vector(map.size))])?;
        self.xml.close("custom")
    }

    fn body(&mut self, at: usize, body: &Body) -> io::Result<()> {
        let position = vector(z_up(body.position));
        let q = quaternion(z_up_rotation(body.rotation));
        let turned = numbers(&[q.w, q.x, q.y, q.z]);
        let name = self.names[at].clone();
        let id = body.id.to_string();
        let attributes = [("name", &*name), ("pos", &position), ("quat", &turned), ("user", &id)];
        self.xml.open("body", &attributes)?;
        if body.is_dynamic() {
            self.xml.empty("freejoint", &[])?;
        }
        self.geom(&name, body)?;
        self.xml.close("body")
    }

    fn geom(&mut self, name: &str, body: &Body) -> io::Result<()> {
        let own = self.pairs.own(body);
        let mut attributes = vec![("name", name.to_owned()), ("solref", self.solref(own.bounce))];
        if self.is_rough() {
            attributes.push(("friction", format!("{} 0 {}", number(own.friction), number(own.lever()))));
            if own.lever() > 0.0 {
                attributes.push(("condim", WITH_ROLLING.into()));
            }
        }
        match body.shape {
            Shape::Sphere { radius } => {
                attributes.extend([("type", "sphere".into()), ("size", number(radius))]);
            }
            Shape::Plane { half_x, half_y } => {
                let slab = self.slabs.of_plate(body);
                self.two_sided += usize::from(slab.offset == 0.0);
                let size = numbers(&[half_x, half_y, slab.half_thickness]);
                let offset = format!("0 0 {}", number(slab.offset));
                attributes.extend([("type", "box".into()), ("size", size), ("pos", offset)]);
            }
            Shape::Unbuilt { .. } => return Ok(()),
        }
        match body.motion {
            Motion::Dynamic { mass, .. } => {
                attributes.push(("mass", number(mass)));
                if self.source.air_density() != 0.0 {
                    attributes.push(("fluidshape", "ellipsoid".into()));
                    attributes.push(("fluidcoef", BLUNT_DRAG.into()));
                }
            }
            Motion::Static => attributes.push(("priority", "1".into())),
        }
        attributes.extend(body.color.map(|color| ("rgba", rgba(color))));
        if body.hidden {
            // The viewer shows the groups 0 to 2 at first.
            attributes.push(("group", "3".into()));
        }
        let attributes: Vec<_> = attributes.iter().map(|(name, value)| (*name, value.as_str())).collect();
        self.xml.empty("geom", &attributes)
    }

    fn is_rough(&self) -> bool {
        self.source.scene.bodies.iter().any(|body| body.roughness.friction != 0.0)
    }

    /// Stiffness and damping themselves, which MuJoCo marks by their sign.
    fn solref(&self, restitution: f64) -> String {
        let stiffness = self.contact.stiffness;
        let damping = 2.0 * damping_ratio(restitution) * libm::sqrt(stiffness);
        format!("{} {}", number(-stiffness), number(-damping))
    }

    fn pair_elements(&mut self) -> io::Result<()> {
        if self.pairs.written.is_empty() {
            return Ok(());
        }
        self.xml.open("contact", &[])?;
        let is_rough = self.is_rough();
        let mut last = (f64::NAN, String::new());
        for &(one, other, surface) in &self.pairs.written {
            let Surface { bounce, friction, .. } = surface;
            if last.0 != bounce {
                last = (bounce, self.solref(bounce));
            }
            let (one, other) = (&*self.names[one], &*self.names[other]);
            let mut geoms = vec![("geom1", one), ("geom2", other), ("solref", &*last.1)];
            let friction = format!("{0} {0} 0 {1} {1}", number(friction), number(surface.lever()));
            if is_rough {
                geoms.push(("friction", &friction));
            }
            if is_rough && surface.lever() > 0.0 {
                geoms.push(("condim", WITH_ROLLING));
            }
            self.xml.empty("pair", &geoms)?;
        }
        self.xml.close("contact")
    }

    /// Places and velocities of all free joints at the start.
    fn keyframe(&mut self) -> io::Result<()> {
        let (mut places, mut velocities) = (Vec::new(), Vec::new());
        for body in self.source.dynamic() {
            let Motion::Dynamic { velocity, .. } = body.motion else { continue };
            let q = quaternion(z_up_rotation(body.rotation));
            places.push(format!("{} {}", vector(z_up(body.position)), numbers(&[q.w, q.x, q.y, q.z])));
            // MuJoCo has the spin of a free joint in the axes of the body.
            let spin = z_up_rotation(body.rotation).transpose() * z_up(body.spin);
            velocities.push(format!("{} {}", vector(z_up(velocity)), vector(spin + DVec3::ZERO)));
        }
        if places.is_empty() {
            return Ok(());
        }
        let (places, velocities) = (places.join(" "), velocities.join(" "));
        self.xml.open("keyframe", &[])?;
        self.xml.empty("key", &[("name", "start"), ("qpos", &places), ("qvel", &velocities)])?;
        self.xml.close("keyframe")
    }

    fn fate(&self, aspect: Aspect) -> Fate {
        match aspect {
            Aspect::Spheres => kept("as geoms, z up"),
            Aspect::Plates => approximated(self.slabs.how(self.two_sided)),
            Aspect::Unbuilt => dropped("bodies without a shape are left"),
            Aspect::Masses => kept(""),
            Aspect::Velocities => kept("in the keyframe `start`: reset to it before the first step"),
            Aspect::Bounce => approximated(self.how_bounce()),
            Aspect::Frictionless => kept("as condim 1"),
            Aspect::Friction => {
                approximated("as condim 3 with an elliptic cone, over steps instead of at once")
            }
            Aspect::RollingFriction if self.is_rough() => approximated(
                "as condim 6 with a lever of 7/5 of coefficient and radius, the geometric mean for each pair; \
                 of two balls the smaller radius",
            ),
            Aspect::RollingFriction => not_needed("nothing rolls where nothing rubs"),
            Aspect::Tangential => dropped("MuJoCo restores no slip"),
            Aspect::Spins => kept("in the keyframe `start`, in the axes of the body"),
            Aspect::UniformGravity => kept("as their sum, in `option`"),
            Aspect::PointGravity => dropped("MuJoCo has uniform gravity only"),
            Aspect::Drag => kept("as the density of the medium, with a blunt drag coefficient of 0.25"),
            Aspect::UserIds => kept("as their `user` number"),
            Aspect::ForceIds => not_needed(NO_FORCE_IDS),
            Aspect::BodyNames => kept("made unique where they repeat"),
            Aspect::Groups => dropped("its groups are numbers"),
            Aspect::Colors => kept(""),
            Aspect::Hidden => kept("in geom group 3, which is not shown at first"),
            Aspect::Locked => not_needed("protects bodies in this editor"),
            Aspect::Materials => dropped("names of materials are for forces of code"),
            Aspect::ForceLooks => not_needed("says where this editor draws and lists a force"),
            Aspect::Map => not_needed("a search grid, on which no result depends; its size is in `custom`"),
            Aspect::TimeSpeed => dropped("the viewer has its own"),
            Aspect::Solver => dropped("settings of this program's core"),
            Aspect::Viewpoints => dropped("not written by this version"),
            Aspect::Motion => dropped("it has a start only"),
            Aspect::Comments | Aspect::Unknown => no_meaning(),
        }
    }

    fn how_bounce(&self) -> String {
        let left_out = match self.pairs.left_out {
            0 => String::new(),
            more => format!("; {more} pairs of bodies with different Bounce have that of one of them"),
        };
        format!(
            "as solref (stiffness {:.3e} 1/s², damping for the product of both), with a step of {:.3e} s, over 30 \
             steps instead of at once, above 1 as 1, below 0.01 as 0.01{left_out}",
            self.contact.stiffness, self.contact.step
        )
    }
}
