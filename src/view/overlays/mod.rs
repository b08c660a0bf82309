//! What can be shown on top of the bodies. One table line and one file each.

mod at_impact;
mod bounds;
mod contacts;
mod crowd;
mod distances;
mod force_chains;
mod forces;
mod grid;
pub(super) mod highlight;
mod labels;
mod map_box;
mod paths;
mod pattern;
mod scaled_arrows;
mod spins;
mod states;
mod tiles;
mod velocities;

use super::DrawList;
pub use scaled_arrows::velocity_scale;

use super::stage::Stage;

/// One switchable layer of a picture.
pub struct Overlay {
    /// As files and the command line write it.
    pub id: &'static str,
    pub label: &'static str,
    /// One sentence for the tooltip and the help.
    pub help: &'static str,
    pub default_on: bool,
    pub(super) add: fn(&Stage<'_>, &mut DrawList),
}

/// All overlays, in the order of menus and of drawing.
pub const OVERLAYS: &[Overlay] = &[
    Overlay {
        id: "map",
        label: "Map box",
        help: "The edges of the map. The map box itself does not collide.",
        default_on: true,
        add: map_box::add,
    },
    Overlay {
        id: "grid",
        label: "Grid",
        help: "Lines at round coordinates, with their numbers in metres.",
        default_on: false,
        add: grid::add,
    },
    Overlay {
        id: "tiles",
        label: "Tiles",
        help: "The occupied tiles of the collision grid: thin with statics only, bright with moving bodies.",
        default_on: false,
        add: tiles::add,
    },
    Overlay {
        id: "contacts",
        label: "Contacts",
        help: "Points and normals of the last Δt's impacts; an arrow's length grows with the impulse.",
        default_on: true,
        add: contacts::add,
    },
    Overlay {
        id: "impact",
        label: "At an event",
        help: "Right at an event: how fast its bodies came and left, and where they are at both ends of the Δt.",
        default_on: true,
        add: at_impact::add,
    },
    Overlay {
        id: "velocities",
        label: "Velocities",
        help: "An arrow from each moving body along its velocity.",
        default_on: false,
        add: velocities::add,
    },
    Overlay {
        id: "spins",
        label: "Spins",
        help: "An arrow from each moving body along its angular velocity, by the right-hand rule.",
        default_on: false,
        add: spins::add,
    },
    Overlay {
        id: "turning",
        label: "Turning",
        help: "Two circles on each ball that turn with it, in scenes with friction.",
        default_on: true,
        add: pattern::add,
    },
    Overlay {
        id: "forces",
        label: "Forces",
        help: "An arrow from each moving body along the total applied force.",
        default_on: false,
        add: forces::add,
    },
    Overlay {
        id: "chains",
        label: "Force chains",
        help: "What presses on what in heaps that are stepped or came to rest so: the thicker, the larger the force.",
        default_on: false,
        add: force_chains::add,
    },
    Overlay {
        id: "boxes",
        label: "Bounding boxes",
        help: "The axis-aligned box around each body.",
        default_on: false,
        add: bounds::add,
    },
    Overlay {
        id: "trails",
        label: "Paths",
        help: "Where the moving bodies were in the last second, and are in the next as far as that is recorded.",
        default_on: false,
        add: paths::add,
    },
    Overlay {
        id: "distances",
        label: "Distances",
        help: "Between two to four things that are selected: gap, way between centres, angle.",
        default_on: true,
        add: distances::add,
    },
    Overlay {
        id: "labels",
        label: "Names",
        help: "The name or UserID beside each body and force.",
        default_on: false,
        add: labels::add,
    },
    Overlay {
        id: "states",
        label: "Rest, slide, roll, stepped",
        help: "A square on each body at rest, a ring on each that slides, a disc on each that rolls, a diamond on each that is stepped.",
        default_on: true,
        add: states::add,
    },
];

/// Which overlays are shown: one bit for each line of [`OVERLAYS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct OverlaySet(u32);

impl Default for OverlaySet {
    fn default() -> Self {
        Self::from_ids(OVERLAYS.iter().filter(|overlay| overlay.default_on).map(|overlay| overlay.id))
    }
}

impl OverlaySet {
    pub const NONE: Self = Self(0);

    /// Unknown ids are skipped, so that settings of another version still load.
    pub fn from_ids<'a>(ids: impl IntoIterator<Item = &'a str>) -> Self {
        Self(ids.into_iter().fold(0, |bits, id| bits | bit(id)))
    }

    pub fn ids(self) -> impl Iterator<Item = &'static str> {
        OVERLAYS.iter().map(|overlay| overlay.id).filter(move |id| self.contains(id))
    }

    pub fn contains(self, id: &str) -> bool {
        self.0 & bit(id) != 0
    }

    pub fn set(&mut self, id: &str, on: bool) {
        self.0 = if on { self.0 | bit(id) } else { self.0 & !bit(id) };
    }

    pub fn toggle(&mut self, id: &str) {
        self.0 ^= bit(id);
    }
}

fn bit(id: &str) -> u32 {
    OVERLAYS.iter().position(|overlay| overlay.id == id).map_or(0, |index| 1 << index)
}
