//! One picture of a frame: the views side by side, with the time.

use clap::ValueEnum as _;

use super::{RenderArgs, View};
use crate::record::Frame;
use crate::render::Tile;
use crate::scene::Scene;
use crate::view::{
    Align, Camera, DrawList, Label, VIEWS, ViewInput, ViewPreset, Viewport, build_draw_list, scene_bounds,
};

/// Pixels between the views of a quad picture.
const GAP: u32 = 2;

/// The views of the picture, each at its place.
pub(super) fn tiles(args: &RenderArgs, scene: &Scene, frame: &Frame) -> Vec<Tile> {
    let [width, height] = args.size;
    if args.view == View::Quad {
        let half = |side: u32| ((side.saturating_sub(GAP)) / 2).max(1);
        let size = [half(width), half(height)];
        return VIEWS
            .iter()
            .zip([[0, 0], [1, 0], [0, 1], [1, 1]])
            .map(|(preset, [column, row])| Tile {
                list: list(args, preset, scene, frame, size),
                x: column * (width - size[0]),
                y: row * (height - size[1]),
            })
            .collect();
    }
    let one = VIEWS.iter().find(|preset| View::from_str(preset.id, false) == Ok(args.view));
    one.map(|preset| Tile { list: list(args, preset, scene, frame, args.size), x: 0, y: 0 })
        .into_iter()
        .collect()
}

fn list(args: &RenderArgs, preset: &ViewPreset, scene: &Scene, frame: &Frame, size: [u32; 2]) -> DrawList {
    let [width, height] = size.map(|side| f64::from(side) / args.zoom);
    let viewport = Viewport::new(width, height, args.zoom);
    let theme = args.theme();
    let mut input = ViewInput::new(scene, Camera::default(), viewport);
    // Around the start, so that pictures of different times can be laid over each other.
    input.camera = preset.camera(scene_bounds(&input, None), viewport.aspect());
    input.frame = Some(frame);
    input.overlays = args.overlays.unwrap_or_else(|| preset.overlay_set());
    input.theme = theme;
    let mut list = build_draw_list(&input);
    list.labels.push(Label {
        position: glam::Vec2::new(10.0, 7.0),
        text: format!("{} · t = {} s", preset.label, crate::view::number(frame.time, 6)),
        color: theme.palette().text,
        size: 13.0,
        align: Align::LeftTop,
        back: theme.palette().label_back,
    });
    list
}
