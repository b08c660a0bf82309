//! The hard cases: scenes at which methods fail and whose outcome is known, each with the figures measured on
//! it and what is demanded of them.

mod case;
mod monitor;
mod table;
mod trial;

// One family of cases each.
mod chains;
mod collapse;
mod contact;
mod corners;
mod far;
mod flight;
mod gas;
mod heaps;
mod hits;
mod load;
mod orbits;
mod rack;
mod reversal;
mod rolling;
mod stacks;

pub use case::{Case, CaseResult, Demand, Figure, Source, measure};
pub use table::{STEPS, markdown, text};

/// All hard cases, in the order of their numbers: one line each.
pub const CASES: &[&Case] = &[
    &flight::THROW,
    &hits::ELASTIC_BOUNCE,
    &hits::LOSSY_BOUNCE,
    &chains::CRADLE_1,
    &chains::CRADLE_2,
    &chains::CRADLE_3,
    &rack::BILLIARD,
    &hits::BULLETS,
    &chains::PI_1,
    &chains::PI_2,
    &chains::PI_3,
    &chains::PI_4,
    &gas::THOUSAND_THIN,
    &gas::THOUSAND_DENSE,
    &gas::TEN_THOUSAND_THIN,
    &gas::TEN_THOUSAND_DENSE,
    &orbits::ELLIPSE,
    &orbits::COMET,
    &orbits::PLUNGE,
    &orbits::SWITCHED,
    &flight::DRAG,
    &hits::GRAZING,
    &corners::TWO,
    &corners::THREE,
    &corners::ANGLES,
    &contact::WEDGE,
    &contact::GROOVE,
    &contact::EDGE,
    &collapse::COLLAPSE,
    &stacks::STACK_2,
    &stacks::STACK_3,
    &stacks::PYRAMID_4,
    &stacks::PYRAMID_4_BOUNCY,
    &stacks::PYRAMID_6,
    &rolling::INCLINE,
    &rolling::SLIP_TURNS,
    &rolling::BREAK_ON_CLOTH,
    &heaps::RAFT,
    &heaps::CLUSTER,
    &heaps::COLUMN,
    &heaps::MIRROR,
    &heaps::DROP_300,
    &heaps::DROP_1000,
    &reversal::REVERSAL,
    &far::FAR,
    &load::OVERLAP,
    &load::OVERLAP_RESTING,
    &load::LEAVES_MAP,
];
