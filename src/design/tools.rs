//! The one table of tools.

use super::tool::Tool;
use super::{arrange, parts, repair, select};

/// All tools, in the order in which menus list them.
pub const TOOLS: &[Tool] = &[
    parts::ROOM,
    parts::OPEN_BOX,
    parts::BLOCK,
    parts::TABLE,
    parts::RAMP,
    parts::STAIRS,
    parts::FUNNEL,
    parts::PEGBOARD,
    parts::VIEW_PLATE,
    parts::RACK,
    parts::PYRAMID,
    parts::CRADLE,
    parts::CONTAINER,
    parts::ORBIT,
    arrange::FILL,
    arrange::ARRAY,
    arrange::LINE,
    arrange::CIRCLE,
    arrange::MIRROR,
    arrange::ALIGN,
    arrange::DISTRIBUTE,
    arrange::PACK,
    select::SAME_KIND,
    select::SAME_MATERIAL,
    select::SAME_GROUP,
    select::TOUCHING,
    select::IN_TILE,
    repair::PUSH_APART,
    repair::GROW_MAP,
    repair::FIT_TILES,
];
