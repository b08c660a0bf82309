//! Ways to build, arrange, select and repair: pure functions from a scene to the edits that change it, each one undo
//! step. Knows neither widgets nor files.
//!
//! [`TOOLS`] is the one table: menus, palette, dialogs and tests follow.

mod arrange;
mod builder;
mod copies;
mod extent;
mod formula;
mod free_place;
mod gap;
mod group;
mod group_order;
mod measure;
mod moving;
mod near;
mod ordering;
mod parts;
mod place;
mod plan;
mod repair;
mod select;
mod tool;
mod tools;
mod trouble;
mod turn;

pub use copies::{duplicate, is_clear, paste};
pub use extent::Extent;
pub use formula::{Formula, Instance};
pub use free_place::{free_place, is_place};
pub use gap::{Gap, gap};
pub use group::{group, regroup, rename_group, ungroup};
pub use group_order::{group_ranks, put_group_beside};
pub use measure::Repair;
pub use moving::moved;
pub use ordering::{put_beside, shift};
pub use place::round as round_size;
pub use plan::{Eye, Given, Plan};
pub use repair::{Repaired, repair, repair_all};
pub use tool::{Input, Kind, Tool, ToolGroup, Values};
pub use tools::TOOLS;
pub use trouble::{Trouble, TroubleKind, troubles};
pub use turn::{turn, turned};
