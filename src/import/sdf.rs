//! SDF, the XML of Gazebo: models of one sphere, and spheres, planes and boxes that stand still.

use std::collections::BTreeMap;

use glam::{DMat3, DQuat, DVec3};

use super::log::Log;
use super::piece::{Piece, PieceShape, Pose, World};
use super::values::{array, checked, color, is_true, numbers, positive};
use crate::export::{Verdict, rolling_of_lever};
use crate::scene::XmlElement;

/// As SDF has it, m/s².
const GRAVITY: DVec3 = DVec3::new(0.0, 0.0, -9.8);

/// As SDF has it, in both directions.
const USUAL_FRICTION: f64 = 1.0;

/// Restitution below a closing speed of `threshold` is 0; this one nothing reaches.
const USUAL_THRESHOLD: f64 = 1e5;

pub(super) fn read(root: XmlElement<'_>, log: &mut Log) -> World {
    let mut reader = Reader { world: World::with_gravity(GRAVITY), log };
    let mut worlds = root.children().filter(|child| child.name() == "world");
    if let Some(world) = worlds.next() {
        reader.read_world(world);
        if let Some(second) = worlds.next() {
            reader.log.impossible(second, "a second world", "a scene here is one world");
        }
    } else {
        for child in root.children() {
            reader.child(child);
        }
        let how = "none is written: 9.8 m/s² downwards, as a world has it";
        reader.log.note(Verdict::Approximated, "gravity", how, None);
    }
    rolling_of_levers(&mut reader.world.pieces);
    reader.world
}

/// What stands still is met by the smallest moving sphere.
fn rolling_of_levers(pieces: &mut [Piece]) {
    let smallest = pieces.iter().filter_map(Piece::rolling_radius).fold(f64::INFINITY, f64::min);
    for piece in pieces {
        let radius = piece.rolling_radius().unwrap_or(smallest);
        let coefficient = rolling_of_lever(piece.rolling, radius);
        piece.rolling = if coefficient.is_finite() { coefficient } else { 0.0 };
    }
}

struct Reader<'l> {
    world: World,
    log: &'l mut Log,
}

impl Reader<'_> {
    fn read_world(&mut self, el: XmlElement<'_>) {
        for child in el.children() {
            self.child(child);
        }
        for state in el.children().filter(|child| child.name() == "state") {
            self.state(state);
        }
        self.log.note(Verdict::Kept, "gravity", "", None);
    }

    fn child(&mut self, el: XmlElement<'_>) {
        match el.name() {
            "gravity" => {
                let gravity = checked::<3>(el, "gravity", &el.text(), self.log);
                self.world.gravity = gravity.map_or(self.world.gravity, DVec3::from);
            }
            "physics" => {
                let factor = el.child("real_time_factor").and_then(|el| array::<1>(&el.text()));
                if let Some([factor]) = factor.filter(|[factor]| *factor > 0.0) {
                    self.world.time_speed = factor;
                }
                self.log.note(Verdict::NotNeeded, "steps and solver of <physics>", "", el.position());
            }
            "model" => self.model(el, Pose::IDENTITY, false),
            "include" => self.include(el),
            "state" => {}
            "light"
            | "gui"
            | "scene"
            | "spherical_coordinates"
            | "magnetic_field"
            | "atmosphere"
            | "audio" => {
                self.log.not_needed(el);
            }
            "plugin" => {
                self.log.dropped(el, "<plugin>", "code of Gazebo; forces of your own are code here too");
            }
            "wind" => self.log.dropped(el, "<wind>", "the air here is at rest"),
            name => {
                let what = format!("<{name}>");
                self.log.impossible(el, &what, "this version knows models and gravity only");
            }
        }
    }

    /// Only two files of Gazebo's own are known without looking.
    fn include(&mut self, el: XmlElement<'_>) {
        let uri = el.child("uri").map(XmlElement::text).unwrap_or_default();
        match uri.rsplit('/').next().unwrap_or_default() {
            "sun" | "Sun" => self.log.not_needed(el),
            "ground_plane" | "Ground Plane" => {
                let pose = self.pose(el);
                let shape = PieceShape::Plane([50.0; 2]);
                let piece = new_piece(Some("ground_plane".into()), pose, shape, el.position());
                self.world.pieces.push(piece);
                self.log.note(Verdict::Kept, "model://ground_plane", "as a plane", el.position());
            }
            _ => self.log.impossible(el, "<include>", "only one file is read: put the model here"),
        }
    }

    fn model(&mut self, el: XmlElement<'_>, at: Pose, fixed: bool) {
        let at = at.then(self.pose(el));
        let fixed = fixed || el.child("static").is_some_and(|el| is_true(&el.text()));
        let links = el.children().filter(|child| child.name() == "link").count();
        for child in el.children() {
            match child.name() {
                "link" if !fixed && links > 1 => {
                    self.log.impossible(
                        child,
                        "a moving model of several links",
                        "a moving body here is one sphere",
                    );
                }
                "link" => self.link(el, child, at, fixed),
                "model" => self.model(child, at, fixed),
                "joint" if fixed => self.log.not_needed(child),
                "joint" | "gripper" => {
                    self.log.impossible(child, "a joint", "bodies here move freely or not at all");
                }
                "static" | "pose" | "self_collide" | "allow_auto_disable" | "enable_wind" => {}
                "plugin" => self.log.dropped(child, "<plugin>", "code of Gazebo"),
                "include" => self.include(child),
                name => {
                    let what = format!("<{name}>");
                    self.log.impossible(child, &what, "this version knows links only");
                }
            }
        }
    }

    fn link(&mut self, model: XmlElement<'_>, el: XmlElement<'_>, at: Pose, fixed: bool) {
        let at = at.then(self.pose(el));
        let without = |name: &str| el.child(name).is_some_and(|el| !is_true(&el.text()));
        if !fixed && without("gravity") {
            self.log.impossible(el, "a body without gravity", "gravity here is for all bodies");
        }
        if el.child("kinematic").is_some_and(|el| is_true(&el.text())) && !fixed {
            self.log.impossible(el, "a kinematic body", "bodies here move freely or not at all");
        }
        for sensor in el.children().filter(|child| matches!(child.name(), "sensor" | "light" | "projector")) {
            self.log.not_needed(sensor);
        }
        let collisions: Vec<_> = el.children().filter(|child| child.name() == "collision").collect();
        if let (false, [_, second, ..]) = (fixed, &collisions[..]) {
            let why = "a moving body here is one sphere";
            return self.log.impossible(*second, "a second collision of a moving body", why);
        }
        if collisions.is_empty() {
            return self.log.dropped(el, "link without a collision", "nothing touches it");
        }
        let visual = el.child("visual");
        for collision in collisions {
            let Some((pose, shape)) = self.collision(collision, fixed) else { continue };
            let name = model.attribute("name").map(Into::into);
            let mut piece = new_piece(name, at.then(pose), shape, model.position());
            piece.bounce = self.bounce(collision);
            piece.friction = self.friction(collision);
            piece.rolling = self.lever(collision);
            piece.hidden = visual.is_none();
            piece.color = visual.and_then(color_of);
            if !fixed {
                piece.motion = Some((self.mass(el), DVec3::ZERO));
            }
            self.world.pieces.push(piece);
        }
    }

    fn collision(&mut self, el: XmlElement<'_>, fixed: bool) -> Option<(Pose, PieceShape)> {
        let mut pose = self.pose(el);
        let Some(shape) = el.child("geometry").and_then(|geometry| geometry.children().next()) else {
            self.log.error(el, "the collision has no geometry".into(), "");
            return None;
        };
        let said = |name: &str| shape.child(name).map(XmlElement::text);
        let found = match shape.name() {
            "sphere" => {
                let radius = said("radius").unwrap_or("1".into());
                PieceShape::Sphere(positive(shape, "radius", &radius, self.log)?)
            }
            "plane" if fixed => {
                let normal = said("normal").and_then(|text| array::<3>(&text)).map(DVec3::from);
                let normal = normal.and_then(DVec3::try_normalize).unwrap_or(DVec3::Z);
                let turn = DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Z, normal));
                pose = pose.then(Pose { place: DVec3::ZERO, turn });
                let size = said("size").and_then(|text| array::<2>(&text)).unwrap_or_default();
                PieceShape::Plane(size.map(|side| (0.5 * side).max(0.0)))
            }
            "box" if fixed => {
                let size = said("size").unwrap_or("1 1 1".into());
                let size = DVec3::from(checked::<3>(shape, "size", &size, self.log)?);
                if size.min_element() <= 0.0 {
                    self.log.error(shape, "the size of a box is not greater than 0".into(), "");
                    return None;
                }
                PieceShape::Box(0.5 * size)
            }
            name => {
                let what = if fixed { format!("a {name}") } else { format!("a moving {name}") };
                self.log.impossible(
                    shape,
                    &what,
                    "shapes here are spheres, and planes and boxes that stand still",
                );
                return None;
            }
        };
        Some((pose, found))
    }

    /// Kept for each surface; what a pair makes of both is the product here.
    fn bounce(&mut self, collision: XmlElement<'_>) -> f64 {
        let bounce = collision.child("surface").and_then(|surface| surface.child("bounce"));
        let number = |name: &str, usual| {
            let text = bounce.and_then(|bounce| bounce.child(name)).map(XmlElement::text);
            text.and_then(|text| array::<1>(&text)).map_or(usual, |[value]| value)
        };
        let restitution = number("restitution_coefficient", 0.0).max(0.0);
        if restitution > 0.0 && number("threshold", USUAL_THRESHOLD) >= USUAL_THRESHOLD {
            let how = "as 0: without a lower `threshold` Gazebo lets nothing bounce";
            self.log.note(Verdict::Approximated, "restitution of a surface", how, collision.position());
            return 0.0;
        }
        let how = "as Bounce; a pair here has the product of both";
        self.log.note(Verdict::Approximated, "restitution of a surface", how, collision.position());
        restitution
    }

    /// The first of two directions; what a pair makes of both bodies' is the mean here.
    fn friction(&mut self, collision: XmlElement<'_>) -> f64 {
        let friction = collision.child("surface").and_then(|surface| surface.child("friction"));
        let ode = friction.and_then(|friction| friction.child("ode"));
        let number = |name: &str| {
            let said = ode.and_then(|ode| ode.child(name)).and_then(|el| array::<1>(&el.text()));
            said.map_or(USUAL_FRICTION, |[value]| value.max(0.0))
        };
        let (first, second) = (number("mu"), number("mu2"));
        if first == 0.0 && second == 0.0 {
            self.log.note(Verdict::Kept, "contact without friction", "", collision.position());
        } else {
            let how = if first == second {
                "as Friction; a pair here has the geometric mean of both, ODE the smaller"
            } else {
                "as Friction, its mu in all directions; a pair here has the geometric mean of both, ODE the smaller"
            };
            self.log.note(Verdict::Approximated, "friction of a surface", how, collision.position());
        }
        if friction.and_then(|friction| friction.child("torsional")).is_some() {
            self.log.dropped(
                collision,
                "torsional friction of a surface",
                "what only spins on its place is not slowed here",
            );
        }
        first
    }

    /// Of the friction that resists rolling, m: Bullet's, the only one that SDF knows.
    fn lever(&mut self, collision: XmlElement<'_>) -> f64 {
        let friction = collision.child("surface").and_then(|surface| surface.child("friction"));
        let bullet = friction.and_then(|friction| friction.child("bullet"));
        let said = bullet.and_then(|bullet| array::<1>(&bullet.child("rolling_friction")?.text()));
        let lever = said.map_or(0.0, |[value]| value.max(0.0));
        if lever > 0.0 {
            let how =
                "as RollingFriction, 5/7 of it over the radius; a pair here has the geometric mean of both";
            self.log.note(Verdict::Approximated, "rolling friction of a surface", how, collision.position());
        }
        lever
    }

    fn mass(&mut self, link: XmlElement<'_>) -> f64 {
        let Some(inertial) = link.child("inertial") else { return 1.0 };
        if self.pose(inertial).place.length() > 1e-12 {
            self.log.impossible(inertial, "a centre of mass beside the centre", "a sphere here is solid");
        }
        let Some(mass) = inertial.child("mass") else { return 1.0 };
        positive(mass, "mass", &mass.text(), self.log).unwrap_or(1.0)
    }

    /// `x y z roll pitch yaw`, in radians or degrees.
    fn pose(&mut self, el: XmlElement<'_>) -> Pose {
        let Some(pose) = el.child("pose") else { return Pose::IDENTITY };
        let frame = pose.attribute("relative_to").or_else(|| pose.attribute("frame"));
        if frame.is_some_and(|frame| !matches!(&*frame, "" | "world" | "__model__")) {
            let why = "poses are read relative to what they stand in";
            self.log.impossible(pose, "a pose relative to a frame", why);
        }
        let text = pose.text();
        if text.is_empty() {
            return Pose::IDENTITY;
        }
        let values = numbers(&text).unwrap_or_default();
        match values[..] {
            [x, y, z, i, j, k, w] if pose.attribute("rotation_format").as_deref() == Some("quat_xyzw") => {
                let turn = DQuat::from_xyzw(i, j, k, w);
                let turn =
                    if turn.length() > 0.0 { DMat3::from_quat(turn.normalize()) } else { DMat3::IDENTITY };
                Pose { place: DVec3::new(x, y, z), turn }
            }
            [x, y, z, roll, pitch, yaw] => {
                let degrees = pose.attribute("degrees").is_some_and(|text| is_true(&text));
                let unit = if degrees { std::f64::consts::PI / 180.0 } else { 1.0 };
                let turn = DMat3::from_rotation_z(unit * yaw)
                    * DMat3::from_rotation_y(unit * pitch)
                    * DMat3::from_rotation_x(unit * roll);
                Pose { place: DVec3::new(x, y, z), turn }
            }
            _ => {
                self.log.error(pose, "the pose is not six numbers".into(), "write x y z roll pitch yaw");
                Pose::IDENTITY
            }
        }
    }

    /// Places and velocities at the start, by the names of models.
    fn state(&mut self, el: XmlElement<'_>) {
        let moving = self.world.pieces.iter().enumerate().filter(|(_, piece)| piece.motion.is_some());
        let named = moving.filter_map(|(at, piece)| Some((piece.name.clone()?, at)));
        let named: BTreeMap<_, _> = named.collect();
        for model in el.children().filter(|child| child.name() == "model") {
            let name = model.attribute("name").unwrap_or_default();
            let pose = model.child("pose").map(|_| self.pose(model));
            let velocity = model.child("link").and_then(|link| link.child("velocity"));
            let velocity = velocity.and_then(|el| checked::<6>(el, "velocity", &el.text(), self.log));
            let at = named.get(&*name).copied();
            let Some(piece) = at.and_then(|at| self.world.pieces.get_mut(at)) else { continue };
            piece.pose = pose.unwrap_or(piece.pose);
            if let (Some([x, y, z, spin @ ..]), Some((_, now))) = (velocity, &mut piece.motion) {
                *now = DVec3::new(x, y, z);
                piece.spin = DVec3::from(spin);
            }
        }
        self.log.note(Verdict::Kept, "state of the world", "as the start", el.position());
    }
}

fn new_piece(name: Option<String>, pose: Pose, shape: PieceShape, origin: Option<(u32, u32)>) -> Piece {
    let (id, motion, color, hidden) = (None, None, None, false);
    let (spin, bounce, friction, rolling) = (DVec3::ZERO, 0.0, USUAL_FRICTION, 0.0);
    Piece { name, id, pose, shape, motion, spin, bounce, friction, rolling, color, hidden, origin }
}

fn color_of(visual: XmlElement<'_>) -> Option<[u8; 3]> {
    let material = visual.child("material")?;
    let said = |name| material.child(name).and_then(|el| color(&el.text()));
    said("diffuse").or_else(|| said("ambient"))
}
