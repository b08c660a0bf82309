//! Labels into a picture, in the font that the window uses.

use ab_glyph::{Font as _, FontRef, Glyph, PxScale, ScaleFont as _, point};
use image::{Rgba, RgbaImage};

use super::RenderError;
use crate::view::{Align, Color, DrawList, Label};

/// Writes the labels of `list` over its picture.
pub fn draw_labels(picture: &mut RgbaImage, list: &DrawList) -> Result<(), RenderError> {
    let font = FontRef::try_from_slice(epaint_default_fonts::UBUNTU_LIGHT).map_err(|_| RenderError::Font)?;
    for label in &list.labels {
        draw_label(picture, &font, label, list.viewport.pixels_per_point as f32);
    }
    Ok(())
}

fn draw_label(picture: &mut RgbaImage, font: &FontRef<'_>, label: &Label, scale: f32) {
    // A font's height is its line's; the em, that sizes go by, is smaller.
    let em = font.units_per_em().unwrap_or(1000.0);
    let px = PxScale::from(label.size * scale * font.height_unscaled() / em);
    let font = font.as_scaled(px);
    let (glyphs, width) = layout(&font, &label.text);
    let size = (width, font.height());
    let at = (label.position.x * scale, label.position.y * scale);
    let (left, top) = top_left(at, size, label.align);
    let (left, top) = (left.round(), top.round());
    if label.back != Color::NONE {
        let pad = 3.0 * scale;
        let back = [left - pad, top, left + width + pad, top + size.1];
        fill_rect(picture, back, label.back);
    }
    for mut glyph in glyphs {
        glyph.position += point(left, top + font.ascent());
        let Some(outline) = font.outline_glyph(glyph) else { continue };
        let bounds = outline.px_bounds();
        outline.draw(|x, y, covered| {
            let (x, y) = (x as f32 + bounds.min.x, y as f32 + bounds.min.y);
            // The font is a light cut: a little more ink keeps it legible at small sizes.
            blend(picture, x, y, label.color, covered.clamp(0.0, 1.0).powf(0.75));
        });
    }
}

/// Glyphs on a line from 0, and its width.
fn layout<F: ab_glyph::Font>(font: &ab_glyph::PxScaleFont<F>, text: &str) -> (Vec<Glyph>, f32) {
    let mut pen = 0.0;
    let mut last = None;
    let mut glyphs = Vec::new();
    for character in text.chars() {
        let id = font.glyph_id(character);
        pen += last.map_or(0.0, |last| font.kern(last, id));
        glyphs.push(id.with_scale_and_position(font.scale(), point(pen, 0.0)));
        pen += font.h_advance(id);
        last = Some(id);
    }
    (glyphs, pen)
}

fn top_left((x, y): (f32, f32), (width, height): (f32, f32), align: Align) -> (f32, f32) {
    let (across, down) = align.fractions();
    (x - across * width, y - down * height)
}

fn fill_rect(picture: &mut RgbaImage, [left, top, right, bottom]: [f32; 4], color: Color) {
    let (mut y, bottom) = (top.max(0.0), bottom.min(picture.height() as f32));
    while y < bottom {
        let (mut x, right) = (left.max(0.0), right.min(picture.width() as f32));
        while x < right {
            blend(picture, x, y, color, 1.0);
            x += 1.0;
        }
        y += 1.0;
    }
}

/// Lays `color` over one pixel; outside the picture nothing happens.
fn blend(picture: &mut RgbaImage, x: f32, y: f32, color: Color, covered: f32) {
    if x < 0.0 || y < 0.0 {
        return;
    }
    let Some(Rgba(below)) = picture.get_pixel_mut_checked(x as u32, y as u32) else { return };
    let alpha = covered * f32::from(color.0[3]) / 255.0;
    for (channel, to) in below.iter_mut().zip(color.0).take(3) {
        let (from, to) = (f32::from(*channel), f32::from(to));
        *channel = (from + (to - from) * alpha).round() as u8;
    }
}
