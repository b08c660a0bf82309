//! The tool bar's icons, drawn with lines so that they are crisp and alike at every scale.

use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, pos2, vec2};

use crate::editor::{Addition, Command, SessionCommand, TravelCommand, ViewCommand};
use crate::view::{Pivot, Tool};

/// Draws a command's icon into a square; `false` if it has none.
pub fn paint(painter: &Painter, square: Rect, command: Command, color: Color32) -> bool {
    let pen = Pen { painter, square, color };
    match command {
        Command::Session(SessionCommand::Reset) => {
            pen.bar(0.16);
            pen.triangle(0.9, 0.3);
        }
        Command::Session(SessionCommand::StepBack) => {
            pen.triangle(0.72, 0.22);
            pen.bar(0.8);
        }
        Command::Session(SessionCommand::EventBack) => {
            pen.triangle(0.62, 0.12);
            pen.dot(0.82);
        }
        Command::Session(SessionCommand::PlayPause) => pen.triangle(0.22, 0.86),
        Command::Session(SessionCommand::Travel(TravelCommand::PlayBack)) => pen.triangle(0.78, 0.14),
        Command::Session(SessionCommand::StepForward) => {
            pen.bar(0.2);
            pen.triangle(0.28, 0.78);
        }
        Command::Session(SessionCommand::NextEvent) => {
            pen.dot(0.18);
            pen.triangle(0.38, 0.88);
        }
        Command::Session(SessionCommand::FinishStep) => {
            pen.triangle(0.1, 0.7);
            pen.bar(0.84);
        }
        Command::Session(SessionCommand::Undo) => pen.turn(false),
        Command::Session(SessionCommand::Redo) => pen.turn(true),
        Command::Session(SessionCommand::Add(Addition::SphereDynamic)) => {
            painter.circle_filled(pen.at(0.5, 0.5), 0.38 * square.width(), color);
        }
        Command::Session(SessionCommand::Add(Addition::SphereStatic)) => {
            painter.circle_stroke(pen.at(0.5, 0.5), 0.36 * square.width(), pen.line());
        }
        Command::Session(SessionCommand::Add(Addition::Plane)) => {
            pen.outline(&[(0.3, 0.2), (0.95, 0.2), (0.7, 0.8), (0.05, 0.8)]);
        }
        Command::Session(SessionCommand::Add(Addition::GravityPlane)) => {
            pen.polyline(&[(0.5, 0.08), (0.5, 0.9)]);
            pen.polyline(&[(0.22, 0.6), (0.5, 0.92), (0.78, 0.6)]);
        }
        Command::Session(SessionCommand::Add(Addition::GravityPoint)) => {
            pen.outline(&[(0.5, 0.1), (0.9, 0.5), (0.5, 0.9), (0.1, 0.5)]);
            painter.circle_filled(pen.at(0.5, 0.5), 0.12 * square.width(), color);
        }
        Command::Session(SessionCommand::Add(Addition::Drag)) => {
            for (y, right) in [(0.25, 0.85), (0.5, 0.65), (0.75, 0.8)] {
                pen.polyline(&[(0.1, y), (right, y)]);
            }
        }
        Command::View(ViewCommand::ToggleSnapping) => {
            for (column, row) in (0..9_u8).map(|i| (f32::from(i % 3), f32::from(i / 3))) {
                let radius = if column == 1.0 && row == 1.0 { 0.2 } else { 0.08 };
                let center = pen.at(0.12 + 0.38 * column, 0.12 + 0.38 * row);
                painter.circle_filled(center, radius * square.width(), color);
            }
        }
        Command::View(ViewCommand::Tool(tool)) => paint_tool(&pen, tool),
        Command::View(ViewCommand::Pivot(pivot)) => paint_pivot(&pen, pivot),
        Command::View(ViewCommand::ToggleLocalAxes) => {
            pen.polyline(&[(0.12, 0.3), (0.35, 0.85), (0.92, 0.62)]);
            pen.polyline(&[(0.35, 0.85), (0.55, 0.12)]);
        }
        _ => return false,
    }
    true
}

/// Two things, with a ring about what they are turned about.
fn paint_pivot(pen: &Pen<'_>, pivot: Pivot) {
    let rings: &[(f32, f32)] = match pivot {
        Pivot::Middle => &[(0.5, 0.5)],
        Pivot::Last => &[(0.78, 0.22)],
        Pivot::Each => &[(0.22, 0.78), (0.78, 0.22)],
    };
    let side = pen.square.width();
    for (x, y) in [(0.22, 0.78), (0.78, 0.22)] {
        pen.painter.circle_filled(pen.at(x, y), 0.12 * side, pen.color);
    }
    for (x, y) in rings {
        pen.painter.circle_stroke(pen.at(*x, *y), 0.22 * side, pen.line());
    }
}

/// What the handles of a selection do.
fn paint_tool(pen: &Pen<'_>, tool: Tool) {
    match tool {
        Tool::Select => pen.outline(&[(0.25, 0.08), (0.8, 0.58), (0.5, 0.62), (0.3, 0.88)]),
        Tool::Move => {
            pen.polyline(&[(0.5, 0.06), (0.5, 0.94)]);
            pen.polyline(&[(0.06, 0.5), (0.94, 0.5)]);
            for [a, b, c] in [
                [(0.36, 0.2), (0.5, 0.05), (0.64, 0.2)],
                [(0.36, 0.8), (0.5, 0.95), (0.64, 0.8)],
                [(0.2, 0.36), (0.05, 0.5), (0.2, 0.64)],
                [(0.8, 0.36), (0.95, 0.5), (0.8, 0.64)],
            ] {
                pen.polyline(&[a, b, c]);
            }
        }
        Tool::Turn => {
            let bow = (0..=14).map(|i| {
                let angle = i as f32 / 14.0 * 1.6 * std::f32::consts::PI;
                (0.5 + 0.38 * angle.cos(), 0.5 + 0.38 * angle.sin())
            });
            pen.polyline(&bow.collect::<Vec<_>>());
            pen.polyline(&[(0.38, 0.12), (0.62, 0.14), (0.5, 0.36)]);
        }
        Tool::Size => {
            pen.outline(&[(0.1, 0.9), (0.1, 0.5), (0.5, 0.5), (0.5, 0.9)]);
            pen.polyline(&[(0.5, 0.5), (0.92, 0.08)]);
            pen.polyline(&[(0.6, 0.08), (0.92, 0.08), (0.92, 0.4)]);
        }
    }
}

/// Two bars: the simulation runs and can be paused.
pub fn paint_pause(painter: &Painter, square: Rect, color: Color32) {
    let pen = Pen { painter, square, color };
    pen.bar(0.32);
    pen.bar(0.68);
}

/// An eye, crossed out when `hidden`.
pub fn paint_eye(painter: &Painter, square: Rect, color: Color32, hidden: bool) {
    let pen = Pen { painter, square, color };
    let upper: Vec<(f32, f32)> = arc(0.30);
    let lower: Vec<(f32, f32)> = arc(-0.30);
    pen.polyline(&upper);
    pen.polyline(&lower);
    if hidden {
        pen.polyline(&[(0.14, 0.9), (0.86, 0.1)]);
    } else {
        painter.circle_filled(pen.at(0.5, 0.5), 0.14 * square.width(), color);
    }
}

/// A padlock, open or shut.
pub fn paint_lock(painter: &Painter, square: Rect, color: Color32, locked: bool) {
    let pen = Pen { painter, square, color };
    let body = Rect::from_min_max(pen.at(0.22, 0.46), pen.at(0.78, 0.9));
    let shift = if locked { 0.0 } else { -0.1 };
    pen.polyline(&[(0.33, 0.46), (0.33, 0.26 + shift), (0.5, 0.14 + shift), (0.67, 0.26 + shift)]);
    if locked {
        pen.polyline(&[(0.67, 0.26), (0.67, 0.46)]);
        painter.rect_filled(body, 1.0, color);
    } else {
        painter.rect_stroke(body, 1.0, pen.line(), egui::StrokeKind::Inside);
    }
}

/// Four, two or one panes.
pub fn paint_panes(painter: &Painter, square: Rect, color: Color32, panes: usize) {
    let pen = Pen { painter, square, color };
    let frame = square.shrink(0.08 * square.width());
    painter.rect_stroke(frame, 1.0, pen.line(), egui::StrokeKind::Inside);
    if panes > 1 {
        pen.polyline(&[(0.5, 0.08), (0.5, 0.92)]);
    }
    if panes > 2 {
        pen.polyline(&[(0.08, 0.5), (0.92, 0.5)]);
    }
}

fn arc(height: f32) -> Vec<(f32, f32)> {
    (0..=10)
        .map(|i| {
            let x = i as f32 / 10.0;
            (0.04 + 0.92 * x, 0.5 - height * 4.0 * x * (1.0 - x))
        })
        .collect()
}

struct Pen<'a> {
    painter: &'a Painter,
    square: Rect,
    color: Color32,
}

impl Pen<'_> {
    fn at(&self, x: f32, y: f32) -> Pos2 {
        self.square.min + vec2(x * self.square.width(), y * self.square.height())
    }

    fn line(&self) -> Stroke {
        Stroke::new((0.1 * self.square.width()).max(1.2), self.color)
    }

    /// From the upright side at `back` to the tip.
    fn triangle(&self, back: f32, tip: f32) {
        let corners = [(back, 0.14), (tip, 0.5), (back, 0.86)];
        let points = corners.map(|(x, y)| self.at(x, y)).to_vec();
        self.painter.add(Shape::convex_polygon(points, self.color, Stroke::NONE));
    }

    fn bar(&self, x: f32) {
        let half = 0.08;
        let rect = Rect::from_min_max(self.at(x - half, 0.14), self.at(x + half, 0.86));
        self.painter.rect_filled(rect, 0.0, self.color);
    }

    fn dot(&self, x: f32) {
        self.painter.circle_filled(self.at(x, 0.5), 0.15 * self.square.width(), self.color);
    }

    fn polyline(&self, points: &[(f32, f32)]) {
        let points: Vec<Pos2> = points.iter().map(|(x, y)| self.at(*x, *y)).collect();
        self.painter.add(Shape::line(points, self.line()));
    }

    fn outline(&self, points: &[(f32, f32)]) {
        let points: Vec<Pos2> = points.iter().map(|(x, y)| self.at(*x, *y)).collect();
        self.painter.add(Shape::closed_line(points, self.line()));
    }

    /// An arrow that turns back, or forward.
    fn turn(&self, forward: bool) {
        let flip = |x: f32| if forward { 1.0 - x } else { x };
        let bow: Vec<(f32, f32)> = (0..=12)
            .map(|i| {
                let angle = -std::f32::consts::FRAC_PI_2 + i as f32 / 12.0 * std::f32::consts::PI;
                (flip(0.55 + 0.3 * angle.cos()), 0.55 + 0.3 * angle.sin())
            })
            .collect();
        let first = bow.first().copied().unwrap_or((0.5, 0.25));
        self.polyline(&bow);
        self.polyline(&[first, (flip(0.12), 0.25)]);
        self.polyline(&[(flip(0.34), 0.04), (flip(0.1), 0.25), (flip(0.34), 0.46)]);
        let end = bow.last().map_or(pos2(0.5, 0.85), |(x, y)| pos2(*x, *y));
        self.polyline(&[(end.x, end.y), (flip(0.35), 0.85)]);
    }
}
