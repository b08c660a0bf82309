//! The look of the window: sizes, spacing and colours of egui's own widgets.

use egui::{Color32, CornerRadius, FontFamily, FontId, Stroke, TextStyle, Theme, Visuals, vec2};

use super::colors;

/// Height of a row of a list or table.
pub const ROW_HEIGHT: f32 = 20.0;

/// Sets both looks; which of them is shown follows the system or the user's choice.
pub fn install(ctx: &egui::Context) {
    ctx.set_fonts(fonts());
    for theme in [Theme::Dark, Theme::Light] {
        ctx.style_mut_of(theme, |style| {
            sizes(style);
            style.visuals = visuals(theme);
        });
    }
}

/// egui's fonts; the monospaced one lends the others its arrows and triangles.
fn fonts() -> egui::FontDefinitions {
    let mut fonts = egui::FontDefinitions::default();
    let mono = fonts.families.get(&FontFamily::Monospace).and_then(|names| names.first()).cloned();
    if let (Some(names), Some(mono)) = (fonts.families.get_mut(&FontFamily::Proportional), mono) {
        names.push(mono);
    }
    fonts
}

fn sizes(style: &mut egui::Style) {
    let font = |size, family| FontId::new(size, family);
    style.text_styles = [
        (TextStyle::Small, font(11.0, FontFamily::Proportional)),
        (TextStyle::Body, font(13.0, FontFamily::Proportional)),
        (TextStyle::Button, font(13.0, FontFamily::Proportional)),
        (TextStyle::Heading, font(16.0, FontFamily::Proportional)),
        (TextStyle::Monospace, font(12.0, FontFamily::Monospace)),
    ]
    .into();
    style.drag_value_text_style = TextStyle::Monospace;
    style.explanation_tooltips = false;
    style.animation_time = 0.08;
    let spacing = &mut style.spacing;
    spacing.item_spacing = vec2(6.0, 4.0);
    spacing.button_padding = vec2(6.0, 2.0);
    spacing.interact_size = vec2(32.0, 20.0);
    spacing.indent = 14.0;
    spacing.menu_margin = egui::Margin::same(6);
    spacing.tooltip_width = 380.0;
    spacing.scroll = egui::style::ScrollStyle { bar_width: 8.0, ..egui::style::ScrollStyle::solid() };
    style.interaction.tooltip_delay = 0.4;
    style.interaction.selectable_labels = false;
}

fn visuals(theme: Theme) -> Visuals {
    let dark = theme == Theme::Dark;
    let tones = colors::of(dark);
    let mut visuals = if dark { Visuals::dark() } else { Visuals::light() };
    let gray = |dark_level: [u8; 3], light_level: [u8; 3]| {
        let [r, g, b] = if dark { dark_level } else { light_level };
        Color32::from_rgb(r, g, b)
    };
    visuals.panel_fill = gray([36, 40, 47], [240, 243, 247]);
    visuals.window_fill = gray([42, 47, 55], [250, 251, 253]);
    visuals.extreme_bg_color = gray([26, 29, 35], [255, 255, 255]);
    visuals.faint_bg_color = gray([41, 45, 53], [233, 237, 242]);
    visuals.code_bg_color = visuals.extreme_bg_color;
    visuals.warn_fg_color = tones.warning;
    visuals.error_fg_color = tones.error;
    visuals.hyperlink_color = tones.accent;
    visuals.weak_text_color = Some(tones.weak);
    visuals.selection.bg_fill = gray([44, 84, 128], [186, 214, 245]);
    visuals.selection.stroke = Stroke::new(1.0, gray([230, 240, 250], [12, 40, 74]));
    visuals.window_stroke = Stroke::new(1.0, tones.line);
    visuals.window_corner_radius = CornerRadius::same(6);
    visuals.menu_corner_radius = CornerRadius::same(4);
    let text = gray([216, 221, 228], [34, 39, 46]);
    let widgets = &mut visuals.widgets;
    widgets.noninteractive.bg_stroke = Stroke::new(1.0, tones.line);
    widgets.noninteractive.fg_stroke = Stroke::new(1.0, text);
    widgets.inactive.fg_stroke = Stroke::new(1.0, text);
    widgets.inactive.weak_bg_fill = gray([52, 58, 67], [224, 229, 236]);
    widgets.inactive.bg_fill = widgets.inactive.weak_bg_fill;
    widgets.hovered.weak_bg_fill = gray([66, 74, 86], [208, 216, 226]);
    widgets.hovered.bg_fill = widgets.hovered.weak_bg_fill;
    widgets.hovered.bg_stroke = Stroke::new(1.0, gray([92, 102, 118], [150, 162, 178]));
    widgets.active.weak_bg_fill = gray([54, 92, 134], [176, 206, 240]);
    widgets.active.bg_fill = widgets.active.weak_bg_fill;
    widgets.open.weak_bg_fill = gray([58, 65, 76], [214, 221, 230]);
    for state in [
        &mut widgets.noninteractive,
        &mut widgets.inactive,
        &mut widgets.hovered,
        &mut widgets.active,
        &mut widgets.open,
    ] {
        state.corner_radius = CornerRadius::same(3);
        state.expansion = 0.0;
    }
    visuals
}
