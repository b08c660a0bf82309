//! The signs before the names in the tree: what kind of thing it is, and whether it is in contact.

use egui::{Rect, Ui, vec2};

use crate::gui::colors::color32;
use crate::gui::context::AppContext;
use crate::scene::{Body, Shape};
use crate::sim::ContactState;

/// What stands before a name: a shape that shows the kind, in the colour of the views.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Chip {
    None,
    Disc,
    Ring,
    Plate,
    Diamond,
}

impl Chip {
    pub fn of(body: &Body) -> Self {
        match (&body.shape, body.is_dynamic()) {
            (Shape::Sphere { .. }, true) => Self::Disc,
            (Shape::Sphere { .. }, false) => Self::Ring,
            (Shape::Plane { .. } | Shape::Unbuilt { .. }, _) => Self::Plate,
        }
    }

    pub fn paint(self, ui: &Ui, center: egui::Pos2, color: egui::Color32) {
        let painter = ui.painter();
        let polygon = |corners: [(f32, f32); 4]| {
            let corners = corners.map(|(x, y)| center + vec2(x, y)).to_vec();
            painter.add(egui::Shape::convex_polygon(corners, color, egui::Stroke::NONE));
        };
        match self {
            Self::None => {}
            Self::Disc => drop(painter.circle_filled(center, 5.0, color)),
            Self::Ring => drop(painter.circle_stroke(center, 4.0, egui::Stroke::new(2.0, color))),
            Self::Plate => polygon([(-3.0, -4.0), (6.0, -4.0), (3.0, 4.0), (-6.0, 4.0)]),
            Self::Diamond => polygon([(0.0, -5.5), (5.5, 0.0), (0.0, 5.5), (-5.5, 0.0)]),
        }
    }
}

/// The mark that the views have for a body in contact: square at rest, ring sliding, disc rolling, diamond
/// stepped.
pub(super) fn paint_contact(ui: &Ui, context: &AppContext<'_>, center: egui::Pos2, contact: ContactState) {
    let (painter, palette) = (ui.painter(), context.palette());
    match contact {
        ContactState::Flight => {}
        ContactState::Rest => {
            painter.rect_filled(Rect::from_center_size(center, vec2(6.0, 6.0)), 0.0, color32(palette.rest));
        }
        ContactState::Slide => {
            painter.circle_stroke(center, 3.0, egui::Stroke::new(1.5, color32(palette.slide)));
        }
        ContactState::Roll => drop(painter.circle_filled(center, 3.5, color32(palette.roll))),
        ContactState::Stepped => {
            let corners = [vec2(0.0, -4.0), vec2(4.0, 0.0), vec2(0.0, 4.0), vec2(-4.0, 0.0)];
            let corners = corners.map(|corner| center + corner).to_vec();
            let color = color32(palette.stepped);
            painter.add(egui::Shape::convex_polygon(corners, color, egui::Stroke::NONE));
        }
    }
}
