//! Selecting by drawing: a rectangle, or with Alt an outline by hand.

use egui::{Pos2, Rect, Shape, Stroke, StrokeKind, Ui};

use super::pane::Pane;
use super::{Scenery, ndc};
use crate::editor::Action;
use crate::gui::colors::tones;
use crate::view::{ViewInput, pick_outline, pick_rect};

/// A new corner of an outline is this far from the last one, points.
const CORNER: f32 = 3.0;

/// What is being drawn, on the screen.
pub(super) enum Rubber {
    /// Two opposite corners.
    Rectangle(Pos2, Pos2),
    Outline(Vec<Pos2>),
}

impl Rubber {
    pub fn begin(at: Pos2, by_hand: bool) -> Self {
        if by_hand { Self::Outline(vec![at]) } else { Self::Rectangle(at, at) }
    }

    pub fn draw_to(&mut self, at: Pos2) {
        match self {
            Self::Rectangle(_, corner) => *corner = at,
            Self::Outline(corners) => {
                if corners.last().is_none_or(|last| last.distance(at) >= CORNER) {
                    corners.push(at);
                }
            }
        }
    }

    /// Selects what is inside, or adds it with Ctrl or Shift.
    pub fn select(&self, ui: &Ui, rect: Rect, scenery: &Scenery<'_>, input: &ViewInput<'_>) {
        let place = |at: &Pos2| ndc(&input.viewport, rect, *at);
        let keys = match self {
            Self::Rectangle(a, b) => pick_rect(input, place(a), place(b), scenery.through),
            Self::Outline(corners) => {
                let outline: Vec<_> = corners.iter().map(place).collect();
                pick_outline(input, &outline, scenery.through)
            }
        };
        let add = ui.input(|input| input.modifiers.command || input.modifiers.shift);
        scenery.context.outbox.act(if add { Action::AddToSelection(keys) } else { Action::Select(keys) });
    }
}

impl Pane {
    pub(super) fn draw_rubber_band(&self, ui: &Ui, rect: Rect) {
        let Some(rubber) = &self.gestures.rubber else { return };
        let accent = tones(ui).accent;
        let painter = ui.painter_at(rect);
        match rubber {
            Rubber::Rectangle(a, b) => {
                let band = Rect::from_two_pos(*a, *b);
                painter.rect_filled(band, 0.0, accent.gamma_multiply(0.12));
                painter.rect_stroke(band, 0.0, Stroke::new(1.0, accent), StrokeKind::Inside);
            }
            Rubber::Outline(corners) => {
                painter.add(Shape::line(corners.clone(), Stroke::new(1.5, accent)));
                if let [first, .., last] = corners.as_slice() {
                    // how it will be closed
                    painter.add(Shape::dashed_line(&[*last, *first], Stroke::new(1.0, accent), 4.0, 4.0));
                }
            }
        }
    }
}
