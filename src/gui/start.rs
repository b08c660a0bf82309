//! What an empty window offers: open a file, a sample, or begin.

use egui::{
    Align2, FontId, Label, Rect, Response, RichText, Role, Sense, Stroke, StrokeKind, TextureHandle, Ui,
};
use egui::{Vec2, WidgetInfo, vec2};

use super::colors::tones;
use super::context::AppContext;
use super::pictures::{self, Pictures};
use crate::editor::{SAMPLES, SampleGroup, Session, SessionCommand};
use crate::scene::shown_path;

/// Whether there is nothing to lose and nothing to see yet.
fn is_wanted(session: &Session) -> bool {
    let empty = session.scene().is_some_and(|scene| scene.bodies.is_empty() && scene.forces.is_empty());
    empty && session.path().is_none() && !session.is_dirty()
}

/// Width of the card within its frame, with names alone and with pictures, points.
const WIDTH: f32 = 500.0;
const WIDTH_WITH_PICTURES: f32 = 840.0;

/// A window smaller than this, points, has no room for pictures.
const ROOM_FOR_PICTURES: Vec2 = vec2(920.0, 640.0);

/// The card leaves the menus at the top of the window free, points.
const MENUS: f32 = 26.0;

/// Samples beside each other: all of them fit in a window of 500 points.
const COLUMNS: usize = 3;
const COLUMNS_OF_PICTURES: usize = 7;

/// Size of a picture, points.
const PICTURE: Vec2 = vec2(112.0, 84.0);

/// The card, with its pictures once they were wanted.
#[derive(Default)]
pub struct Start {
    is_closed: bool,
    pictures: Pictures,
}

impl Start {
    /// It does not come back.
    pub fn close(&mut self) {
        *self = Self { is_closed: true, ..Self::default() };
    }

    /// A card over the views while it is wanted, as low as it can be: small windows show all of it.
    pub fn show(&mut self, ctx: &egui::Context, area: Rect, context: &AppContext<'_>) {
        if self.is_closed || !is_wanted(context.session) {
            return;
        }
        let mut closed = ctx.input(|input| input.key_pressed(egui::Key::Escape));
        let screen = ctx.content_rect();
        let pictured = screen.width() >= ROOM_FOR_PICTURES.x && screen.height() >= ROOM_FOR_PICTURES.y;
        egui::Area::new(egui::Id::unique("start"))
            .fixed_pos(area.center())
            .pivot(Align2::CENTER_CENTER)
            .constrain_to(screen.with_min_y(MENUS))
            .order(egui::Order::Middle)
            .show(ctx, |ui| {
                egui::Frame::window(ui.style()).inner_margin(egui::Margin::same(18)).show(ui, |ui| {
                    ui.set_width(if pictured { WIDTH_WITH_PICTURES } else { WIDTH });
                    closed |= begin(ui, context);
                    ui.add_space(8.0);
                    samples(ui, context, pictured.then_some(&mut self.pictures));
                    recent(ui, context);
                    ui.add_space(4.0);
                    ui.label(RichText::new("A scene file can also be dropped on the window.").weak());
                });
            });
        if closed {
            self.close();
        }
    }
}

/// What to begin with beside samples; whether the card is closed by that.
fn begin(ui: &mut Ui, context: &AppContext<'_>) -> bool {
    ui.label(RichText::new("PolyScene").heading().strong());
    ui.label(RichText::new("Design a scene of rigid bodies, then step through its collisions.").weak());
    ui.add_space(8.0);
    ui.horizontal(|ui| {
        if ui.button("Open…").on_hover_text("Opens a scene file (Ctrl+O)").clicked() {
            context.outbox.command(SessionCommand::Open);
        }
        let empty = ui.button("Empty scene");
        empty.on_hover_text("Closes this card (Esc); add bodies from the Add menu").clicked()
    })
    .inner
}

fn samples(ui: &mut Ui, context: &AppContext<'_>, mut pictures: Option<&mut Pictures>) {
    ui.label(RichText::new("Samples").strong());
    let introductions: Vec<usize> =
        (0..SAMPLES.len()).filter(|index| SAMPLES[*index].group == SampleGroup::Introduction).collect();
    let (columns, whole) = match pictures {
        Some(_) => (COLUMNS_OF_PICTURES, WIDTH_WITH_PICTURES),
        None => (COLUMNS, WIDTH),
    };
    // Names stand down the first column, then the next, pictures row by row: their order is that of learning.
    let rows = introductions.len().div_ceil(columns);
    let mut meant = None;
    let gap = if pictures.is_some() { 8.0 } else { 12.0 };
    let grid = egui::Grid::new(("start samples", columns)).num_columns(columns).spacing([gap, 3.0]);
    grid.min_col_width(whole / columns as f32 - gap).show(ui, |ui| {
        for row in 0..rows {
            for column in 0..columns {
                let nth = if pictures.is_some() { row * columns + column } else { column * rows + row };
                let Some(index) = introductions.get(nth) else { continue };
                let link = match &mut pictures {
                    Some(pictures) => pictured(ui, *index, pictures.of(ui.ctx(), SAMPLES[*index].id)),
                    None => ui.link(SAMPLES[*index].title),
                };
                if link.hovered() || link.has_focus() {
                    meant = Some(SAMPLES[*index].shows);
                }
                if link.clicked() {
                    context.outbox.command(SessionCommand::OpenSample(*index));
                }
            }
            ui.end_row();
        }
    });
    ui.add_space(4.0);
    // One line whatever it says, so that the card keeps its size under the pointer.
    let shows = meant.unwrap_or("Point at a sample to read what it shows. Hard cases: File, Samples.");
    ui.add(Label::new(RichText::new(shows).weak()).truncate());
    ui.add_space(8.0);
}

/// A link with a picture above its name.
fn pictured(ui: &mut Ui, index: usize, picture: Option<&TextureHandle>) -> Response {
    let title = SAMPLES[index].title;
    let name_height = 18.0;
    let (rect, response) = ui.allocate_exact_size(PICTURE + vec2(0.0, name_height), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Link, true, title));
    let frame = Rect::from_min_size(rect.min, PICTURE);
    if let Some(picture) = picture {
        ui.painter().image(picture.id(), frame, pictures::PART, egui::Color32::WHITE);
    }
    let is_meant = response.hovered() || response.has_focus();
    let tones = tones(ui);
    let pen = Stroke::new(if is_meant { 2.0 } else { 1.0 }, if is_meant { tones.accent } else { tones.line });
    ui.painter().rect_stroke(frame, 2.0, pen, StrokeKind::Inside);
    let at = frame.left_bottom() + vec2(1.0, 2.0);
    ui.painter().text(at, Align2::LEFT_TOP, title, FontId::proportional(12.0), tones.accent);
    response.on_hover_cursor(egui::CursorIcon::PointingHand)
}

fn recent(ui: &mut Ui, context: &AppContext<'_>) {
    let recent = &context.session.settings().recent;
    if recent.is_empty() {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 12.0;
        ui.label(RichText::new("Recent").strong());
        for (index, path) in recent.iter().take(5).enumerate() {
            let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
            if ui.link(name.as_ref()).on_hover_text(shown_path(path)).clicked() {
                context.outbox.command(SessionCommand::OpenRecent(index));
            }
        }
    });
    ui.add_space(4.0);
}
