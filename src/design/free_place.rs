//! Where a new part stands while nobody has said where: where it would by default, or beside what is there.

use std::collections::BTreeMap;

use glam::DVec3;

use super::extent::Extent;
use super::gap::{gap, tolerance};
use super::place::{floor_under, plate_under, round};
use super::plan::Given;
use super::tool::Tool;
use crate::scene::{Body, Edit, Scene, Shape};

/// Inputs that say where a part stands.
const PLACE: [&str; 3] = ["Place x", "Place y", "Place z"];

/// Of the map's smallest side: the gap left beside what is there, and what offsets are multiples of.
const GAP: f64 = 0.01;

/// Obstacles passed in one direction before another is tried.
const MOST_PASSED: usize = 64;

/// Bodies of a part beyond which only its box is looked at: comparing each would make typing slow.
const MOST_COMPARED: usize = 2000;

/// Of the map's floor: what covers more is a room, in which parts stand.
const SHARE_OF_ROOM: f64 = 0.5;

/// Whether an input says where a part stands.
pub fn is_place(label: &str) -> bool {
    PLACE.contains(&label)
}

/// The values of a part with its place moved where it overlaps nothing: past what it would lie in or across, along x or z,
/// the shortest way that stays in the map. New balls may stand in a box or on a table, but a new box stands around nothing;
/// unchanged where all is free, where no place is, or for a tool that asks for none.
pub fn free_place(tool: &Tool, given: &Given<'_>, values: &[f64]) -> Vec<f64> {
    let mut values = values.to_vec();
    let at = PLACE.map(|label| tool.inputs.iter().position(|input| input.label == label));
    let [Some(x), Some(y), Some(z)] = at else { return values };
    let Ok(plan) = tool.plan(given, &values) else { return values };
    let bodies: Vec<&Body> = plan.edits.iter().filter_map(new_body).collect();
    let place = DVec3::new(values[x], values[y], values[z]);
    if let Some(offset) = Search::new(given.scene, &bodies, place).and_then(|search| search.offset()) {
        let moved = (place + offset).to_array().map(plain);
        [values[x], values[y], values[z]] = moved;
    }
    values
}

fn new_body(edit: &Edit) -> Option<&Body> {
    match edit {
        Edit::AddBody(body) => Some(body),
        _ => None,
    }
}

/// Without the rounding of sums: 9.2 for 9.200000000000001.
fn plain(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

/// Something that a part must not lie in: a part made before, or a body that belongs to none.
#[derive(Clone, Copy)]
struct Thing {
    extent: Extent,
    has_plates: bool,
    is_many: bool,
}

impl Thing {
    fn of(body: &Body) -> Self {
        let has_plates = matches!(body.shape, Shape::Plane { .. });
        Self { extent: Extent::of(body), has_plates, is_many: false }
    }

    fn with(self, other: Self) -> Self {
        let has_plates = self.has_plates || other.has_plates;
        Self { extent: self.extent.with(other.extent), has_plates, is_many: true }
    }
}

/// Parts by their outermost groups, then single bodies.
fn things(scene: &Scene) -> Vec<Thing> {
    let mut groups = BTreeMap::<&str, Thing>::new();
    let mut all = Vec::new();
    for body in scene.bodies.iter().filter(|body| !matches!(body.shape, Shape::Unbuilt { .. })) {
        let thing = Thing::of(body);
        match body.group.as_deref().and_then(|group| group.split('/').next()) {
            Some(group) => {
                let thing = match groups.remove(group) {
                    Some(known) => known.with(thing),
                    None => thing,
                };
                groups.insert(group, thing);
            }
            None => all.push(thing),
        }
    }
    all.extend(groups.into_values());
    all
}

struct Search<'a> {
    scene: &'a Scene,
    bodies: &'a [&'a Body],
    part: Thing,
    things: Vec<Thing>,
    /// Where the part stands by default.
    place: DVec3,
    /// Smallest length that makes a difference, m.
    step: f64,
}

impl<'a> Search<'a> {
    fn new(scene: &'a Scene, bodies: &'a [&'a Body], place: DVec3) -> Option<Self> {
        let part = bodies.iter().map(|body| Thing::of(body)).reduce(Thing::with)?;
        let step = round(scene.map.size.min_element() * GAP);
        Some(Self { scene, bodies, part, things: things(scene), place, step })
    }

    /// `None` where the part is free already, or nothing is.
    fn offset(&self) -> Option<DVec3> {
        if self.blockers(DVec3::ZERO).is_empty() {
            return None;
        }
        let ways = [DVec3::X, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Z];
        let found = ways.into_iter().filter_map(|way| self.along(way));
        let map = Extent { min: DVec3::splat(-self.step / 2.0), max: self.scene.map.size + self.step / 2.0 };
        let leaves = |offset: DVec3| !map.holds(self.part.extent.moved(offset));
        found.min_by(|a, b| leaves(*a).cmp(&leaves(*b)).then(a.length().total_cmp(&b.length())))
    }

    /// The first free place in a direction.
    fn along(&self, way: DVec3) -> Option<DVec3> {
        let mut length = 0.0;
        for _ in 0..MOST_PASSED {
            let offset = self.grounded(way * length);
            let blockers = self.blockers(offset);
            if blockers.is_empty() {
                return Some(offset);
            }
            let next = blockers.into_iter().map(|extent| self.past(way, extent));
            length = next.filter(|next| *next > length).min_by(f64::total_cmp)?;
        }
        None
    }

    /// How far to go until an obstacle lies behind, as a multiple of the step.
    fn past(&self, way: DVec3, obstacle: Extent) -> f64 {
        let [ahead, behind] = [obstacle.max, -obstacle.min].map(|corner| corner.dot(way.abs()));
        let [begin, end] = [self.part.extent.min, -self.part.extent.max].map(|corner| corner.dot(way.abs()));
        let distance = if way.element_sum() > 0.0 { ahead - begin } else { behind - end };
        ((distance / self.step).floor() + 1.0) * self.step
    }

    /// On the floor there, as far above it as by default.
    fn grounded(&self, offset: DVec3) -> DVec3 {
        let middle = self.scene.map.size / 2.0;
        let floor = |at: DVec3| floor_under(self.scene, DVec3::new(at.x, middle.y, at.z));
        offset.with_y(floor(self.place + offset) - floor(self.place))
    }

    /// What the part would lie in or across.
    fn blockers(&self, offset: DVec3) -> Vec<Extent> {
        let extent = self.part.extent.moved(offset);
        let crossed: Vec<&Thing> =
            self.things.iter().filter(|thing| self.cross(extent, thing.extent)).collect();
        let blocking = crossed.iter().filter(|thing| self.blocks(thing, extent)).map(|thing| thing.extent);
        let blocking: Vec<Extent> = blocking.chain(self.stood_on(offset, extent)).collect();
        if !blocking.is_empty() || self.bodies.len() > MOST_COMPARED || self.is_clear(offset) {
            return blocking;
        }
        // A body is in the way: what is smallest goes first, since what holds the part cannot be passed.
        let around = |thing: &&&Thing| !is_level_in(extent, thing.extent);
        let beside: Vec<Extent> = crossed.iter().filter(around).map(|thing| thing.extent).collect();
        if beside.is_empty() { crossed.iter().map(|thing| thing.extent).collect() } else { beside }
    }

    /// A plate on which the part would stand but must not: it reaches over the edge, or both are parts made of plates.
    fn stood_on(&self, offset: DVec3, part: Extent) -> Option<Extent> {
        let at = (self.place + offset).with_y(self.scene.map.size.y / 2.0);
        let body = plate_under(self.scene, at)?;
        let plate = Extent::of(body);
        let stands = (part.min.y - plate.max.y).abs() < self.step;
        let of_part = self.part.has_plates && body.group.is_some() && !self.is_room(plate);
        (stands && (of_part || !is_level_in(part, plate))).then_some(plate)
    }

    /// Whether two boxes share more than their faces.
    fn cross(&self, a: Extent, b: Extent) -> bool {
        let margin = DVec3::splat(1e-6 * self.step);
        a.min.cmplt(b.max - margin).all() && b.min.cmplt(a.max - margin).all()
    }

    /// Whether it covers so much of the map's floor that parts stand in it or on it.
    fn is_room(&self, extent: Extent) -> bool {
        let floor = |size: DVec3| size.x * size.z;
        floor(extent.size()) >= SHARE_OF_ROOM * floor(self.scene.map.size)
    }

    /// Whether no ball overlaps anything. Plates meet wherever boxes stand on floors: their boxes are compared instead.
    fn is_clear(&self, offset: DVec3) -> bool {
        let all = self.part.extent.moved(offset);
        let near = self.scene.bodies.iter().filter(|other| Extent::of(other).meets(all, 0.0));
        let near: Vec<&Body> = near.collect();
        self.bodies.iter().all(|body| {
            let copy = Body { position: body.position + offset, ..(*body).clone() };
            near.iter().all(|other| {
                gap(&copy, other).is_none_or(|gap| gap.distance >= -tolerance(self.scene, &copy, other))
            })
        })
    }

    /// Whether a part must not stand there although none of its bodies need overlap.
    fn blocks(&self, thing: &Thing, part: Extent) -> bool {
        match (self.part.has_plates, thing.has_plates) {
            (false, false) => false,
            // balls stand in a box or on a table, but not across a ramp
            (false, true) => !(thing.is_many && is_level_in(part, thing.extent)),
            // no plate need touch a ball that a block or stairs would shut in: whatever lies in the part's box is in the way
            (true, false) => true,
            (true, true) => !(thing.is_many && self.is_room(thing.extent) && is_level_in(part, thing.extent)),
        }
    }
}

/// Whether one box lies in the outline of another, seen from above.
fn is_level_in(inner: Extent, outer: Extent) -> bool {
    // what fills it is in it, whatever its places were rounded to
    let margin = 1e-9 * outer.size().max_element();
    let outline = |extent: Extent, margin: f64| Extent {
        min: (extent.min - margin).with_y(0.0),
        max: (extent.max + margin).with_y(0.0),
    };
    outline(outer, margin).holds(outline(inner, 0.0))
}
