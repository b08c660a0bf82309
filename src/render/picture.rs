//! Pictures of one or several views side by side.

use std::io;
use std::path::Path;

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder as _, RgbaImage};

use super::{Offscreen, RenderError};
use crate::scene::{shown_path, write_atomically};
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

/// Refuses a name that promises another format than is written; the error says what to write instead. One without an
/// ending, such as that of a device, promises none.
pub fn check_png_name(path: &Path) -> Result<(), String> {
    match path.extension() {
        Some(ending) if !ending.eq_ignore_ascii_case("png") => {
            let (name, better) = (shown_path(path), shown_path(&path.with_extension("png")));
            Err(format!("{name}: pictures are PNG files; give a name such as {better}"))
        }
        _ => Ok(()),
    }
}

/// Writes a PNG file in one go, so that nobody sees a part of it.
pub fn write_png(path: &Path, rgba: &[u8], size: [u32; 2]) -> io::Result<()> {
    write_atomically(path, &png(rgba, size)?)
}

/// The bytes of a PNG file. Packed well: the smooth background takes eight times the room otherwise.
pub fn png(rgba: &[u8], [width, height]: [u32; 2]) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::Adaptive)
        .write_image(rgba, width, height, ExtendedColorType::Rgba8)
        .map_err(io::Error::other)?;
    Ok(bytes)
}
