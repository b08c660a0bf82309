//! Pictures of one or several views side by side.

use image::RgbaImage;

use super::{Offscreen, RenderError};
use crate::view::DrawList;

/// A view's place in a picture, pixels from the top left corner.
#[derive(Clone, Debug)]
pub struct Tile {
    pub list: DrawList,
    pub x: u32,
    pub y: u32,
}

/// Draws every tile at its place; what no tile covers has the colour `gap`.
pub fn render_picture(
    offscreen: &mut Offscreen,
    size: [u32; 2],
    gap: [u8; 4],
    tiles: &[Tile],
) -> Result<RgbaImage, RenderError> {
    let mut picture = RgbaImage::from_pixel(size[0], size[1], image::Rgba(gap));
    for tile in tiles {
        let view = offscreen.render(&tile.list)?;
        image::imageops::replace(&mut picture, &view, i64::from(tile.x), i64::from(tile.y));
    }
    Ok(picture)
}
