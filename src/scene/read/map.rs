//! The element `Map`: size and tiles of the world.

use super::log::{Log, place_in};
use crate::scene::rules::{self, Range};
use crate::scene::tree::View;
use crate::scene::{Map, shown};

/// What an unusable size or number of tiles is shown as until it is repaired.
pub(super) const FALLBACK: Map = Map { size: glam::DVec3::splat(10.0), tiles: [10; 3] };

/// Reads the map.
pub(super) fn read<'a>(el: View<'a>, log: &mut Log<'a>) -> Map {
    log.check_attributes(el, &[]);
    let [size, tiles] = log.children(el, ["Size", "Tiles"]);
    for (part, name) in [(size, "Size"), (tiles, "Tiles")] {
        if part.is_none() {
            let hint = format!("write <{name} X=\"10\" Y=\"10\" Z=\"10\" />");
            log.error(el.place(), format!("the Map has no {name}"), hint);
        }
    }
    let size = size.and_then(|el| log.vector(el, Range::Positive));
    let tiles = tiles.and_then(|el| read_tiles(el, log));
    Map { size: size.unwrap_or(FALLBACK.size), tiles: tiles.unwrap_or(FALLBACK.tiles) }
}

fn read_tiles<'a>(el: View<'a>, log: &mut Log<'a>) -> Option<[u32; 3]> {
    log.within(el, |log| {
        log.leaf(el, &["X", "Y", "Z"]);
        let [x, y, z] = ["X", "Y", "Z"].map(|axis| {
            let value = log.number(el, axis, Range::Any)?;
            let Some(must) = rules::tiles_refusal(value) else { return Some(value as u32) };
            let at = el.attribute(axis).and_then(|attr| place_in(el, attr.value.start));
            let written = el.value(axis).unwrap_or_default();
            log.error(at, format!("{axis}=\"{}\" {must}", shown(&written)), "");
            None
        });
        Some([x?, y?, z?])
    })
}
