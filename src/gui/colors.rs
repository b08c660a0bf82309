//! The window's colours beside egui's own: one calm set for dark, one for light.

use egui::Color32;

use crate::view;

/// Colours with a meaning. Nothing is shown by colour alone: a shape or a word goes with each.
#[derive(Clone, Copy)]
pub struct Tones {
    pub accent: Color32,
    pub error: Color32,
    pub warning: Color32,
    pub good: Color32,
    pub weak: Color32,
    pub strong: Color32,
    /// Behind the panels' own headings.
    pub heading: Color32,
    pub line: Color32,
}

const DARK: Tones = Tones {
    accent: Color32::from_rgb(98, 164, 232),
    error: Color32::from_rgb(255, 122, 112),
    warning: Color32::from_rgb(240, 190, 88),
    good: Color32::from_rgb(112, 200, 142),
    weak: Color32::from_rgb(152, 160, 172),
    strong: Color32::from_rgb(238, 241, 245),
    heading: Color32::from_rgb(45, 50, 58),
    line: Color32::from_rgb(58, 64, 74),
};

const LIGHT: Tones = Tones {
    accent: Color32::from_rgb(22, 100, 190),
    error: Color32::from_rgb(190, 30, 28),
    warning: Color32::from_rgb(150, 88, 0),
    good: Color32::from_rgb(20, 120, 60),
    weak: Color32::from_rgb(92, 100, 112),
    strong: Color32::from_rgb(18, 22, 28),
    heading: Color32::from_rgb(228, 232, 238),
    line: Color32::from_rgb(204, 210, 218),
};

pub fn tones(ui: &egui::Ui) -> Tones {
    of(ui.visuals().dark_mode)
}

pub fn of(dark: bool) -> Tones {
    if dark { DARK } else { LIGHT }
}

/// The views' colour as egui's.
pub fn color32(color: view::Color) -> Color32 {
    let [r, g, b, a] = color.0;
    Color32::from_rgba_unmultiplied(r, g, b, a)
}
