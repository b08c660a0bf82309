//! MJCF, the XML of MuJoCo: spheres on free joints, and spheres, planes and boxes that stand still.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::f64::consts::PI;

use glam::{DMat3, DQuat, DVec3};

use super::log::Log;
use super::mjcf_contact::{Contact, Surface, USUAL_FRICTION, USUAL_SOLREF, give_surfaces, restitution};
use super::mjcf_defaults::Defaults;
use super::piece::{Piece, PieceShape, Pose, World, euler};
use super::values::{array, checked, color, numbers, positive};
use crate::export::Verdict;
use crate::scene::XmlElement;

/// As MuJoCo has it, m/s².
const GRAVITY: DVec3 = DVec3::new(0.0, 0.0, -9.81);
/// Of geoms, kg/m³.
const DENSITY: f64 = 1000.0;

/// Its law for bodies without `fluidshape`, for the box of a solid sphere's inertia: 2ρ·(3/5)r² instead of ¼πρr².
const BOX_DRAG: f64 = 4.8 / PI;

pub(super) fn read(root: XmlElement<'_>, log: &mut Log) -> World {
    let defaults = Defaults::of(root);
    let mut reader = Reader {
        defaults: &defaults,
        radians: false,
        euler_order: "xyz".into(),
        root,
        pieces: Vec::new(),
        contacts: Vec::new(),
        geoms: BTreeMap::new(),
        movers: Vec::new(),
        log,
    };
    reader.compiler();
    for child in root.children() {
        match child.name() {
            "worldbody" => reader.body(child, Pose::IDENTITY, None, 0),
            "compiler" | "option" | "default" | "keyframe" | "contact" | "custom" => {}
            "size" | "statistic" | "visual" | "asset" | "sensor" => reader.log.not_needed(child),
            "include" => {
                reader.log.impossible(child, "<include>", "only one file is read: put its content here");
            }
            "actuator" | "tendon" | "equality" | "deformable" | "extension" => {
                let what = format!("<{}>", child.name());
                reader.log.impossible(child, &what, "bodies here move by forces and impacts alone");
            }
            _ => reader.log.dropped(child, &format!("<{}>", child.name()), "it is not known here"),
        }
    }
    give_surfaces(&mut reader.pieces, &reader.contacts);
    reader.pairs();
    reader.keyframe();
    reader.world()
}

struct Reader<'a, 'l> {
    defaults: &'l Defaults<'a>,
    radians: bool,
    euler_order: String,
    root: XmlElement<'a>,
    pieces: Vec<Piece>,
    /// One for each piece.
    contacts: Vec<Contact>,
    /// Names of geoms, and which piece each is.
    geoms: BTreeMap<String, usize>,
    /// In the order of the moving bodies.
    movers: Vec<Mover>,
    log: &'l mut Log,
}

/// A moving body beside its piece.
struct Mover {
    /// Where the body is, and its geom in it.
    frame: Pose,
    geom: Pose,
    /// By how much this program's law of drag must be multiplied.
    drag_share: f64,
}

impl<'a> Reader<'a, '_> {
    fn compiler(&mut self) {
        for el in self.root.children().filter(|child| child.name() == "compiler") {
            if let Some(angle) = el.attribute("angle") {
                self.radians = angle == "radian";
            }
            if let Some(order) = el.attribute("eulerseq") {
                self.euler_order = order.into_owned();
            }
        }
    }

    /// A body with what is inside; `depth` is 0 for the world.
    fn body(&mut self, el: XmlElement<'a>, at: Pose, class: Option<&str>, depth: usize) {
        let class = el.attribute("childclass").or_else(|| class.map(|class| class.to_owned().into()));
        let is_free = self.is_free(el, class.as_deref());
        let mut shapes = 0;
        for child in el.children() {
            match child.name() {
                "geom" if self.collides(child, class.as_deref()) => {
                    shapes += 1;
                    let free = is_free.then_some(el);
                    if is_free && shapes > 1 {
                        let why = "a moving body here is one sphere";
                        self.log.impossible(child, "a second geom of a moving body", why);
                    } else {
                        self.geom(child, at, class.as_deref(), free, el);
                    }
                }
                "geom" => self.log.dropped(child, "geom that touches nothing", "it is only seen"),
                "body" | "frame" => {
                    let inner = at.then(self.pose(child));
                    if child.name() == "body" && is_free {
                        let why = "a moving body here is one sphere";
                        self.log.impossible(child, "a body that is part of a moving body", why);
                    } else {
                        self.body(child, inner, class.as_deref(), depth + 1);
                    }
                }
                "freejoint" | "inertial" => {}
                "joint" if is_free && self.is_free_joint(child, class.as_deref()) => {}
                "joint" => {
                    let why = "bodies here move freely or not at all";
                    self.log.impossible(child, "a joint that is not free", why);
                }
                "light" | "camera" | "site" => self.log.not_needed(child),
                name => {
                    let what = format!("<{name}>");
                    self.log.impossible(child, &what, "this version knows bodies and geoms only");
                }
            }
        }
        if is_free && shapes == 0 {
            self.log.impossible(el, "a moving body without a geom", "a body here has one shape");
        }
        if is_free && depth != 1 {
            self.log.error(
                el,
                "a free joint stands below the top of the world".into(),
                "MuJoCo refuses it too",
            );
        }
    }

    fn is_free(&self, el: XmlElement<'a>, class: Option<&str>) -> bool {
        el.children().any(|child| child.name() == "freejoint" || self.is_free_joint(child, class))
    }

    fn is_free_joint(&self, el: XmlElement<'a>, class: Option<&str>) -> bool {
        el.name() == "joint" && self.defaults.attribute(el, class, "type").as_deref() == Some("free")
    }

    fn collides(&self, el: XmlElement<'a>, class: Option<&str>) -> bool {
        let is_zero =
            |name| self.defaults.attribute(el, class, name).is_some_and(|value| value.trim() == "0");
        !(is_zero("contype") && is_zero("conaffinity"))
    }

    /// `free` is the body, if it moves.
    fn geom(
        &mut self,
        el: XmlElement<'a>,
        at: Pose,
        class: Option<&str>,
        free: Option<XmlElement<'a>>,
        body: XmlElement<'a>,
    ) {
        let Some(shape) = self.shape(el, class, free.is_some()) else { return };
        let defaults = self.defaults;
        let attribute = |name: &str| defaults.attribute(el, class, name);
        let own = (body.name() == "body").then(|| body.attribute("name")).flatten();
        let color_of = |text: Cow<'_, str>| color(&text);
        let material = attribute("material").and_then(|name| self.material_color(&name));
        let group = attribute("group").and_then(|text| text.trim().parse::<u32>().ok());
        let inner = self.pose(el);
        let piece = Piece {
            name: own.or(el.attribute("name")).map(Cow::into_owned),
            id: body.attribute("user").and_then(|text| id(&text)),
            pose: at.then(inner),
            motion: free.map(|body| (self.mass(body, el, class, shape), DVec3::ZERO)),
            shape,
            spin: DVec3::ZERO,
            bounce: 1.0,
            friction: 0.0,
            rolling: 0.0,
            color: attribute("rgba").and_then(color_of).or(material),
            // The viewer shows the groups 0 to 2 at first.
            hidden: group.is_some_and(|group| group > 2),
            origin: el.position(),
        };
        if free.is_some() {
            let drag_share = self.drag_share(el, class);
            self.movers.push(Mover { frame: at, geom: inner, drag_share });
        }
        let contact = self.contact(el, class);
        if let Some(name) = el.attribute("name") {
            self.geoms.insert(name.into_owned(), self.pieces.len());
        }
        self.pieces.push(piece);
        self.contacts.push(contact);
    }

    fn shape(&mut self, el: XmlElement<'a>, class: Option<&str>, moves: bool) -> Option<PieceShape> {
        let attribute = |name: &str| self.defaults.attribute(el, class, name);
        let kind = attribute("type").unwrap_or("sphere".into());
        let size = attribute("size").map_or(Some(Vec::new()), |text| numbers(&text)).unwrap_or_default();
        let side = |at: usize| size.get(at).copied().filter(|side: &f64| *side > 0.0);
        let shape = match &*kind {
            "sphere" => side(0).map(PieceShape::Sphere),
            "plane" => Some(PieceShape::Plane([0, 1].map(|at| side(at).unwrap_or(0.0)))),
            "box" => {
                side(0).zip(side(1)).zip(side(2)).map(|((x, y), z)| PieceShape::Box(DVec3::new(x, y, z)))
            }
            other => {
                let what = format!("a geom of type {other}");
                self.log.impossible(el, &what, "shapes here are spheres, planes, and boxes that stand still");
                return None;
            }
        };
        if shape.is_none() {
            self.log.error(el, format!("the size of a {kind} is missing or not greater than 0"), "");
        }
        if moves && matches!(shape, Some(PieceShape::Plane(_) | PieceShape::Box(_))) {
            self.log.impossible(el, &format!("a moving {kind}"), "moving bodies here are spheres");
            return None;
        }
        shape
    }

    fn contact(&mut self, el: XmlElement<'a>, class: Option<&str>) -> Contact {
        let attribute = |name: &str| self.defaults.attribute(el, class, name);
        let number = |name: &str| attribute(name).and_then(|text| array::<1>(&text)).map(|[value]| value);
        let (priority, solmix) = (number("priority").unwrap_or(0.0) as i64, number("solmix").unwrap_or(1.0));
        let solref = attribute("solref").and_then(|text| array::<2>(&text));
        if solref.is_none() {
            let how = "as restitution 0.135, of the critical damping that MuJoCo has without `solref`";
            self.log.note(Verdict::Approximated, "contact of a geom", how, el.position());
        } else {
            let how = "as the restitution of its damping; impacts here take no time";
            self.log.note(Verdict::Approximated, "contact of a geom", how, el.position());
        }
        let friction = self.friction(el, class);
        if friction.is_none() {
            self.log.note(Verdict::Kept, "contact without friction", "", el.position());
        } else {
            let how = "as Friction; a pair here has the geometric mean of both";
            self.log.note(Verdict::Approximated, "friction of a geom", how, el.position());
        }
        let lever = self.lever(el, class, 2);
        if lever > 0.0 {
            let how =
                "as RollingFriction, 5/7 of it over the radius; a pair here has the geometric mean of both";
            self.log.note(Verdict::Approximated, "rolling friction of a geom", how, el.position());
        }
        let about_normal = self.dimensions(el, class) > 3 && self.coefficient(el, class, 1) > 0.0;
        if about_normal && attribute("friction").is_some() {
            let what = "torsional friction of a geom";
            self.log.dropped(el, what, "what only spins on its place is not slowed here");
        }
        Contact { solref: solref.unwrap_or(USUAL_SOLREF), friction, lever, priority, solmix }
    }

    /// Directions in which a contact has force: 1 for the normal, 3 with sliding, 4 with spin about the normal, 6 with rolling.
    fn dimensions(&self, el: XmlElement<'a>, class: Option<&str>) -> u32 {
        let said = self.defaults.attribute(el, class, "condim");
        said.and_then(|text| text.trim().parse().ok()).unwrap_or(3)
    }

    /// One of the numbers of `friction`.
    fn coefficient(&self, el: XmlElement<'a>, class: Option<&str>, at: usize) -> f64 {
        let said = self.defaults.attribute(el, class, "friction").and_then(|text| numbers(&text));
        let usual = if at == 0 { USUAL_FRICTION } else { 0.0 };
        said.and_then(|said| said.get(at).copied()).unwrap_or(usual).max(0.0)
    }

    /// Of rolling friction, m: the third number of a geom, the fourth of a pair. The tenth of a millimetre that MuJoCo has unless
    /// told is none here.
    fn lever(&self, el: XmlElement<'a>, class: Option<&str>, at: usize) -> f64 {
        if self.dimensions(el, class) < 6 { 0.0 } else { self.coefficient(el, class, at) }
    }

    /// The first of its coefficients, which is for sliding; `None` with condim 1.
    fn friction(&self, el: XmlElement<'a>, class: Option<&str>) -> Option<f64> {
        (self.dimensions(el, class) > 1).then(|| self.coefficient(el, class, 0))
    }

    /// Of a moving sphere, kg.
    fn mass(
        &mut self,
        body: XmlElement<'a>,
        el: XmlElement<'a>,
        class: Option<&str>,
        shape: PieceShape,
    ) -> f64 {
        if let Some(inertial) = body.child("inertial")
            && let Some(text) = inertial.attribute("mass")
        {
            let place = inertial.attribute("pos").and_then(|text| array::<3>(&text)).map(DVec3::from);
            if place.is_some_and(|place| place.length() > 1e-12) {
                self.log.impossible(inertial, "a centre of mass beside the centre", "a sphere here is solid");
            }
            return positive(inertial, "mass", &text, self.log).unwrap_or(1.0);
        }
        if let Some(text) = self.defaults.attribute(el, class, "mass") {
            return positive(el, "mass", &text, self.log).unwrap_or(1.0);
        }
        let density = self.defaults.attribute(el, class, "density");
        let density = density.map_or(Some(DENSITY), |text| positive(el, "density", &text, self.log));
        let PieceShape::Sphere(radius) = shape else { return 1.0 };
        density.unwrap_or(DENSITY) * 4.0 / 3.0 * PI * radius * radius * radius
    }

    fn drag_share(&self, el: XmlElement<'a>, class: Option<&str>) -> f64 {
        let attribute = |name: &str| self.defaults.attribute(el, class, name);
        if attribute("fluidshape").as_deref() != Some("ellipsoid") {
            return BOX_DRAG;
        }
        let blunt = attribute("fluidcoef").and_then(|text| numbers(&text)?.first().copied());
        4.0 * blunt.unwrap_or(0.5)
    }

    fn material_color(&self, name: &str) -> Option<[u8; 3]> {
        let assets = self.root.children().filter(|child| child.name() == "asset");
        let mut materials = assets.flat_map(XmlElement::children).filter(|child| child.name() == "material");
        let material = materials.find(|material| material.attribute("name").as_deref() == Some(name))?;
        color(&material.attribute("rgba")?)
    }

    /// Where an element is in its parent.
    fn pose(&mut self, el: XmlElement<'a>) -> Pose {
        let place = match el.attribute("pos") {
            Some(text) => checked::<3>(el, "pos", &text, self.log).map_or(DVec3::ZERO, DVec3::from),
            None => DVec3::ZERO,
        };
        Pose { place, turn: self.turn(el).unwrap_or(DMat3::IDENTITY) }
    }

    fn turn(&mut self, el: XmlElement<'a>) -> Option<DMat3> {
        let unit = if self.radians { 1.0 } else { PI / 180.0 };
        if let Some(text) = el.attribute("quat") {
            let [w, x, y, z] = checked::<4>(el, "quat", &text, self.log)?;
            let q = DQuat::from_xyzw(x, y, z, w);
            return (q.length() > 0.0).then(|| DMat3::from_quat(q.normalize()));
        }
        if let Some(text) = el.attribute("axisangle") {
            let [x, y, z, angle] = checked::<4>(el, "axisangle", &text, self.log)?;
            return Some(DMat3::from_axis_angle(DVec3::new(x, y, z).try_normalize()?, angle * unit));
        }
        if let Some(text) = el.attribute("euler") {
            let angles = checked::<3>(el, "euler", &text, self.log)?;
            return Some(euler(&self.euler_order, angles.map(|angle| angle * unit)));
        }
        if let Some(text) = el.attribute("xyaxes") {
            let [a, b, c, d, e, f] = checked::<6>(el, "xyaxes", &text, self.log)?;
            let x = DVec3::new(a, b, c).try_normalize()?;
            let y = DVec3::new(d, e, f);
            let y = (y - x * x.dot(y)).try_normalize()?;
            return Some(DMat3::from_cols(x, y, x.cross(y)));
        }
        let text = el.attribute("zaxis")?;
        let z = DVec3::from(checked::<3>(el, "zaxis", &text, self.log)?).try_normalize()?;
        Some(DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Z, z)))
    }

    /// What is written for a pair must be the product of the two Bounce values and the mean of the frictions, or is lost.
    fn pairs(&mut self) {
        let contacts = self.root.children().filter(|child| child.name() == "contact");
        let found: Vec<_> = contacts.flat_map(XmlElement::children).collect();
        for el in found {
            if el.name() != "pair" {
                self.log.dropped(el, &format!("<{}>", el.name()), "all bodies here touch each other");
                continue;
            }
            let surface = |name| {
                let at = self.geoms.get(&*el.attribute(name)?)?;
                self.pieces.get(*at).map(Surface::of)
            };
            let solref = self.defaults.attribute(el, None, "solref").and_then(|text| array::<2>(&text));
            let said = restitution(solref.unwrap_or(USUAL_SOLREF));
            let rubs = self.friction(el, None).unwrap_or(0.0);
            let lever = self.lever(el, None, 3);
            match surface("geom1").zip(surface("geom2")) {
                Some((one, other)) if one.meets(&other, said, rubs, lever) => {
                    let how = "as the product of both Bounce values, and the mean of the frictions";
                    self.log.note(Verdict::Kept, "contact of a pair", how, el.position());
                }
                _ => {
                    let how =
                        "a pair here has the product of both Bounce values, and the mean of the frictions";
                    self.log.note(Verdict::Approximated, "contact of a pair", how, el.position());
                }
            }
        }
    }

    /// Places and velocities of the first keyframe, if the file has one.
    fn keyframe(&mut self) {
        let frames = self.root.children().filter(|child| child.name() == "keyframe");
        let mut keys = frames.flat_map(XmlElement::children).filter(|child| child.name() == "key");
        let Some(key) = keys.next() else { return };
        if let Some(other) = keys.next() {
            self.log.dropped(other, "keyframe after the first", "a scene here has one start");
        }
        let numbers_of = |name: &str| key.attribute(name).map(|text| numbers(&text).unwrap_or_default());
        let moving = self.pieces.iter_mut().filter(|piece| piece.motion.is_some());
        let moving: Vec<_> = moving.collect();
        let count = moving.len();
        let (places, speeds) = (numbers_of("qpos"), numbers_of("qvel"));
        let fits = |values: &Option<Vec<f64>>, each: usize| {
            values.as_ref().is_none_or(|values| values.len() == each * count)
        };
        if !(fits(&places, 7) && fits(&speeds, 6)) {
            let text =
                format!("the keyframe has not 7 places and 6 speeds for each of {count} moving bodies");
            return self.log.error(key, text, "");
        }
        for ((nth, piece), mover) in moving.into_iter().enumerate().zip(&self.movers) {
            let mut frame = mover.frame;
            if let Some([x, y, z, w, i, j, k]) = nth_of::<7>(&places, nth) {
                let turn = DQuat::from_xyzw(i, j, k, w);
                let turn = if turn.length() > 0.0 { DMat3::from_quat(turn.normalize()) } else { frame.turn };
                frame = Pose { place: DVec3::new(x, y, z), turn };
                piece.pose = frame.then(mover.geom);
            }
            // The speed is that of the body's origin, and the spin is in the axes of the body.
            if let (Some([x, y, z, spin @ ..]), Some((_, velocity))) =
                (nth_of::<6>(&speeds, nth), &mut piece.motion)
            {
                piece.spin = frame.turn * DVec3::from(spin);
                *velocity = DVec3::new(x, y, z) + piece.spin.cross(frame.turn * mover.geom.place);
            }
        }
        self.log.note(Verdict::Kept, "keyframe", "as the start", key.position());
    }

    fn world(&mut self) -> World {
        let mut world = World::with_gravity(GRAVITY);
        for el in self.root.children().filter(|child| child.name() == "option") {
            if let Some(text) = el.attribute("gravity") {
                world.gravity =
                    checked::<3>(el, "gravity", &text, self.log).map_or(world.gravity, DVec3::from);
            }
            if el.child("flag").and_then(|flag| flag.attribute("gravity")).as_deref() == Some("disable") {
                world.gravity = DVec3::ZERO;
            }
            if let Some([density]) = el.attribute("density").and_then(|text| array::<1>(&text)) {
                world.density = self.drag(el, density);
            }
            for name in ["wind", "viscosity", "magnetic"] {
                let said = el.attribute(name).and_then(|text| numbers(&text)).unwrap_or_default();
                if said.iter().any(|value| *value != 0.0) {
                    self.log.dropped(el, name, "the air here is at rest and resists by its density");
                }
            }
            self.log.note(Verdict::NotNeeded, "steps and solver of <option>", "", el.position());
        }
        self.log.note(Verdict::Kept, "gravity", "", None);
        let customs = self.root.children().filter(|child| child.name() == "custom");
        let numeric = |el: &XmlElement<'_>| el.attribute("name").as_deref() == Some("map_size_y_up");
        let size = customs
            .flat_map(XmlElement::children)
            .find(numeric)
            .and_then(|el| array::<3>(&el.attribute("data")?));
        world.map = size.map(DVec3::from).filter(|size| size.min_element() > 0.0);
        world.pieces = std::mem::take(&mut self.pieces);
        world
    }

    fn drag(&mut self, el: XmlElement<'a>, density: f64) -> f64 {
        let first = self.movers.first().map_or(1.0, |mover| mover.drag_share);
        let (verdict, how) = if first == BOX_DRAG {
            (Verdict::Approximated, "MuJoCo takes the box of a body's inertia, and this program the sphere")
        } else if self.movers.iter().any(|mover| mover.drag_share != first) {
            (Verdict::Approximated, "bodies with different coefficients all get that of the first")
        } else {
            (Verdict::Kept, "as the density of air")
        };
        if density > 0.0 && !self.movers.is_empty() {
            self.log.note(verdict, "drag of the medium", how, el.position());
        }
        (density * first).max(0.0)
    }
}

/// A whole number that a file of this program has for a body.
fn id(text: &str) -> Option<i64> {
    text.split_whitespace().next()?.parse().ok()
}

fn nth_of<const N: usize>(values: &Option<Vec<f64>>, nth: usize) -> Option<[f64; N]> {
    values.as_ref()?.get(nth * N..(nth + 1) * N)?.try_into().ok()
}
