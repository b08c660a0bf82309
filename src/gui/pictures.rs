//! Pictures of the samples, as `polyscene render` drew them: `scripts/screenshots.sh` draws them again.

use std::collections::BTreeMap;

use egui::{ColorImage, Context, Rect, TextureHandle, TextureOptions, pos2};

/// What of a picture is shown: without the names and scales at its edges.
pub const PART: Rect = Rect { min: pos2(0.12, 0.04), max: pos2(0.88, 0.96) };

macro_rules! pictures {
    ($($id:literal),* $(,)?) => {
        &[$(($id, include_bytes!(concat!("../../assets/samples/", $id, ".png")).as_slice())),*]
    };
}

/// PNG files by the names of samples.
const PICTURES: &[(&str, &[u8])] = pictures![
    "thesis-appendix-2",
    "bounce",
    "rest",
    "slide",
    "incline",
    "dome",
    "billiards",
    "bank-shot",
    "jump-shot",
    "break-on-cloth",
    "bowling",
    "superball",
    "bowl",
    "cradle",
    "counting-pi",
    "orbit",
    "drag",
    "bullet",
    "gas",
    "bin",
    "hopper",
    "galton",
    "galton-rough",
    "pyramid-hit",
    "masses",
    "heap-in-space",
    "pour-1000",
    "pour-5000",
];

/// Pictures that are ready to be drawn, each made when it is first asked for.
#[derive(Default)]
pub struct Pictures(BTreeMap<&'static str, Option<TextureHandle>>);

impl Pictures {
    /// `None` for a sample without a picture.
    pub fn of(&mut self, ctx: &Context, id: &'static str) -> Option<&TextureHandle> {
        self.0.entry(id).or_insert_with(|| texture(ctx, id)).as_ref()
    }
}

fn texture(ctx: &Context, id: &str) -> Option<TextureHandle> {
    let (_, bytes) = PICTURES.iter().find(|(of, _)| *of == id)?;
    let picture = image::load_from_memory_with_format(bytes, image::ImageFormat::Png).ok()?.into_rgba8();
    let size = [picture.width() as usize, picture.height() as usize];
    let color = ColorImage::from_rgba_unmultiplied(size, picture.as_raw());
    Some(ctx.load_texture(id, color, TextureOptions::LINEAR))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::editor::{SAMPLES, SampleGroup};

    #[test]
    fn every_introduction_has_a_picture_and_all_are_small() {
        let ids: Vec<&str> = PICTURES.iter().map(|(id, _)| *id).collect();
        let introductions = SAMPLES.iter().filter(|sample| sample.group == SampleGroup::Introduction);
        assert_eq!(ids, introductions.map(|sample| sample.id).collect::<Vec<_>>());
        let bytes: usize = PICTURES.iter().map(|(_, bytes)| bytes.len()).sum();
        assert!(bytes < 600_000, "{bytes} bytes");
        let ctx = Context::default();
        let mut pictures = Pictures::default();
        assert!(ids.iter().all(|id| pictures.of(&ctx, id).is_some()));
    }
}
