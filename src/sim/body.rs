//! Bodies: how they are told apart, and what does not change about them while they move.

use std::collections::{BTreeMap, BTreeSet};

use compact_str::CompactString;
use glam::{DQuat, DVec3};

use super::event::BodyRef;
use super::segment::Segment;
use super::shape::Shape;
use crate::scene::{NodeKey, Roughness, rotation_matrix};

/// A body of a run. Dynamic ones are numbered from 0, which is their place in all columns of the state; static
/// ones carry the highest bit, so that of two bodies the dynamic one comes first. A number never changes, whoever
/// is added or removed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct BodyId(u32);

const STATIC: u32 = 1 << 31;

impl BodyId {
    /// No body; it counts as static.
    pub const NONE: Self = Self(u32::MAX);

    pub fn of_dynamic(index: u32) -> Self {
        debug_assert!(index < STATIC, "no dynamic body has the number {index}");
        Self(index)
    }

    pub fn of_static(index: u32) -> Self {
        Self(STATIC | index)
    }

    pub fn is_static(self) -> bool {
        self.0 >= STATIC
    }

    /// Place among the bodies of its kind.
    pub fn index(self) -> u32 {
        self.0 & !STATIC
    }

    /// Place in the columns of the state.
    pub fn dynamic(self) -> Option<u32> {
        (!self.is_static()).then_some(self.0)
    }

    pub fn to_ref(self) -> BodyRef {
        if self.is_static() { BodyRef::Static(self.index()) } else { BodyRef::Dynamic(self.0) }
    }

    pub fn from_ref(body: BodyRef) -> Self {
        match body {
            BodyRef::Dynamic(index) if index < STATIC => Self::of_dynamic(index),
            BodyRef::Static(index) if index < STATIC => Self::of_static(index),
            BodyRef::Dynamic(_) | BodyRef::Static(_) => Self::NONE,
        }
    }
}

/// Who a body is. Short labels lie in place: small pieces of memory, one for each of many bodies, would keep what lay
/// between them from being used again.
#[derive(Clone, Debug)]
pub(super) struct Identity {
    pub key: NodeKey,
    pub label: CompactString,
    /// Where it is not the label.
    name: Option<Box<str>>,
}

impl Identity {
    /// `name` is what a person calls it.
    pub fn new(key: NodeKey, label: &str, name: &str) -> Self {
        Self { key, label: label.into(), name: (name != label).then(|| name.into()) }
    }

    /// What a person calls it: its name, else its label.
    pub fn name(&self) -> &str {
        self.name.as_deref().unwrap_or(&self.label)
    }
}

/// What does not change about a body. An impact looks at both: each fills one cache line.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(super) struct Body {
    /// The body's place in UserID order: the id, and the order among bodies of the same id.
    id: i64,
    order: u32,
    /// kg; infinite for a static body.
    mass: f64,
    pub bounce: f64,
    pub shape: Shape,
    /// Apart, since most have nothing of it.
    rare: Option<Box<Rare>>,
    /// False once it is removed: the numbers of the others stay.
    pub present: bool,
}

/// What few bodies have.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Rare {
    pub material: Option<Box<str>>,
    pub roughness: Roughness,
    /// Euler angles and angular velocity at the start, rad and rad/s.
    pub rotation: DVec3,
    pub spin: DVec3,
}

impl Body {
    /// `rank` is its place in UserID order; `mass` in kg, infinite for a static body.
    pub fn new((id, order): (i64, u32), mass: f64, bounce: f64, shape: Shape, rare: Rare) -> Self {
        Self {
            id,
            order,
            mass,
            bounce,
            shape,
            rare: (rare != Rare::default()).then(|| Box::new(rare)),
            present: true,
        }
    }

    pub fn is_static(&self) -> bool {
        self.mass.is_infinite()
    }

    /// UserID order.
    pub fn rank(&self) -> (i64, u32) {
        (self.id, self.order)
    }

    pub fn material(&self) -> Option<&str> {
        self.rare.as_ref()?.material.as_deref()
    }

    pub fn roughness(&self) -> Roughness {
        self.rare.as_ref().map_or(Roughness::default(), |rare| rare.roughness)
    }

    pub fn set_roughness(&mut self, roughness: Roughness) {
        self.rare.get_or_insert_default().roughness = roughness;
    }

    /// World from body, and angular velocity, rad/s, at the start.
    pub fn turn_at_start(&self) -> (DQuat, DVec3) {
        let Some(rare) = &self.rare else { return (DQuat::IDENTITY, DVec3::ZERO) };
        (DQuat::from_mat3(&rotation_matrix(rare.rotation)).normalize(), rare.spin)
    }

    /// kg; infinite for a static body.
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// 1/kg; 0 for a static body.
    pub fn inverse_mass(&self) -> f64 {
        1.0 / self.mass
    }

    /// kg, of a dynamic body.
    pub fn set_mass(&mut self, mass: f64) {
        self.mass = mass;
    }
}

#[cfg(not(test))]
const _: () = assert!(size_of::<Body>() == 64, "a body fills one cache line");

/// Where a body starts; a static one stays there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Origin {
    /// m.
    pub position: DVec3,
    /// m/s.
    pub velocity: DVec3,
}

/// The table of all bodies.
#[derive(Clone, Debug, Default)]
pub(super) struct Bodies {
    dynamic: Vec<Body>,
    statics: Vec<Body>,
    /// Who they are: apart, since events never look at it.
    dynamic_identities: Vec<Identity>,
    static_identities: Vec<Identity>,
    /// Radii of the dynamic bodies, m: close together, for predictions read many.
    radii: Vec<f64>,
    /// The least and the largest of those that are there, m.
    range_of_radii: Option<(f64, f64)>,
    /// Where the static bodies are, as motions that never change.
    static_segments: Vec<Segment>,
    /// Those that are there, by their keys.
    by_key: BTreeSet<(NodeKey, BodyId)>,
    /// How many there ever were of each id.
    of_id: BTreeMap<i64, u32>,
}

impl Bodies {
    /// None yet, with room for so many dynamic ones.
    pub fn with_room(dynamic: usize) -> Self {
        Self {
            dynamic: Vec::with_capacity(dynamic),
            dynamic_identities: Vec::with_capacity(dynamic),
            radii: Vec::with_capacity(dynamic),
            ..Self::default()
        }
    }

    /// Adds a body; a static one at this place, m.
    pub fn push(&mut self, identity: Identity, body: Body, position: DVec3) -> BodyId {
        let key = identity.key;
        *self.of_id.entry(body.id).or_default() += 1;
        let id = if body.is_static() {
            self.statics.push(body);
            self.static_identities.push(identity);
            self.static_segments.push(Segment::resting(position));
            BodyId::of_static(self.statics.len() as u32 - 1)
        } else {
            let radius = body.shape.radius();
            let (least, largest) = self.range_of_radii.unwrap_or((radius, radius));
            self.range_of_radii = Some((least.min(radius), largest.max(radius)));
            self.radii.push(radius);
            self.dynamic.push(body);
            self.dynamic_identities.push(identity);
            BodyId::of_dynamic(self.dynamic.len() as u32 - 1)
        };
        self.by_key.insert((key, id));
        id
    }

    /// Takes a body away: its number stays. [`Self::measure`] is due after the last of several.
    pub fn remove(&mut self, id: BodyId) {
        self.get_mut(id).present = false;
        let key = self.identity(id).key;
        self.by_key.remove(&(key, id));
    }

    /// Puts another static body of the same key in the place of one.
    pub fn replace_static(&mut self, index: u32, identity: Identity, body: Body, position: DVec3) {
        self.statics[index as usize] = body;
        self.static_identities[index as usize] = identity;
        self.static_segments[index as usize] = Segment::resting(position);
    }

    /// Who a body is.
    pub fn identity(&self, id: BodyId) -> &Identity {
        &self.identities(id.is_static())[id.index() as usize]
    }

    pub fn find_identity(&self, id: BodyId) -> Option<&Identity> {
        self.identities(id.is_static()).get(id.index() as usize)
    }

    fn identities(&self, is_static: bool) -> &[Identity] {
        if is_static { &self.static_identities } else { &self.dynamic_identities }
    }

    pub fn find(&self, id: BodyId) -> Option<&Body> {
        self.of_kind(id.is_static()).get(id.index() as usize)
    }

    pub fn get(&self, id: BodyId) -> &Body {
        &self.of_kind(id.is_static())[id.index() as usize]
    }

    pub fn get_mut(&mut self, id: BodyId) -> &mut Body {
        let list = if id.is_static() { &mut self.statics } else { &mut self.dynamic };
        &mut list[id.index() as usize]
    }

    fn of_kind(&self, is_static: bool) -> &[Body] {
        if is_static { &self.statics } else { &self.dynamic }
    }

    pub fn dynamic(&self) -> &[Body] {
        &self.dynamic
    }

    pub fn radius(&self, body: u32) -> f64 {
        self.radii[body as usize]
    }

    /// The body of a key, if it is there.
    pub fn of_key(&self, key: NodeKey) -> Option<BodyId> {
        self.by_key.range((key, BodyId(0))..=(key, BodyId::NONE)).next().map(|(_, id)| *id)
    }

    /// How many bodies there ever were of an id.
    pub fn count_of(&self, id: i64) -> u32 {
        self.of_id.get(&id).copied().unwrap_or(0)
    }

    /// Finds the least and the largest radius anew, after bodies were removed.
    pub fn measure(&mut self) {
        let radii = self.present_dynamic().map(|body| self.radius(body));
        self.range_of_radii = radii.fold(None, |range, radius| {
            let (least, largest) = range.unwrap_or((radius, radius));
            Some((radius.min(least), radius.max(largest)))
        });
    }

    /// The least and the largest radius of the dynamic bodies that are there, m.
    pub fn range_of_radii(&self) -> (f64, f64) {
        self.range_of_radii.unwrap_or_default()
    }

    /// How many static bodies there are, with those removed.
    pub fn static_len(&self) -> usize {
        self.statics.len()
    }

    /// Where a static body is.
    pub fn static_segment(&self, index: u32) -> &Segment {
        &self.static_segments[index as usize]
    }

    /// All dynamic bodies that are there.
    pub fn present_dynamic(&self) -> impl Iterator<Item = u32> + '_ {
        (0u32..).zip(&self.dynamic).filter(|(_, body)| body.present).map(|(index, _)| index)
    }

    /// All static bodies that are there.
    pub fn present_statics(&self) -> impl Iterator<Item = u32> + '_ {
        (0u32..).zip(&self.statics).filter(|(_, body)| body.present).map(|(index, _)| index)
    }

    /// All bodies, with those removed: dynamic ones first.
    pub fn iter(&self) -> impl Iterator<Item = (BodyId, &Body)> {
        let dynamic = (0u32..).zip(&self.dynamic).map(|(index, body)| (BodyId::of_dynamic(index), body));
        let statics = (0u32..).zip(&self.statics).map(|(index, body)| (BodyId::of_static(index), body));
        dynamic.chain(statics)
    }
}
