//! The Δt being looked at, stretched to the width of the window: each event at its own time, also those to come that are
//! recorded. A click goes to an event, or to the time between two.

use std::sync::Arc;

use egui::{Align2, Color32, FontId, Mesh, Pos2, Rect, Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

use crate::editor::Action;
use crate::gui::colors::{Tones, color32, tones};
use crate::gui::context::{AppContext, Message};
use crate::gui::numbers::significant;
use crate::record::{Crossing, EventRow, Frame};
use crate::sim::{BodyRef, EventKind};

pub const HEIGHT: f32 = 30.0;

/// Width of the switch of the tile crossings, points.
const SWITCH: f32 = 56.0;

/// How near the pointer must be to an event, points.
const REACH: f32 = 6.0;

/// Events of one Δt that are drawn at all.
const MOST_EVENTS: usize = 20_000;
/// Events up to which each has its mark.
const ALL_DRAWN: usize = 1000;
/// How far apart marks must stand on average for their edges to be seen, points.
const APART: f32 = 6.0;
/// Places along the line that are told apart where there are more.
const PLACES_PER_POINT: f32 = 1.0;

pub fn show(ui: &mut Ui, context: &AppContext<'_>, crossings: &mut bool) {
    let tones = tones(ui);
    let size = vec2(ui.available_width(), HEIGHT);
    let (whole, _) = ui.allocate_exact_size(size, Sense::hover());
    ui.painter().rect_filled(whole, 0.0, tones.heading);
    let rect = show_switch(ui, whole, crossings);
    let frame = context.session.frame();
    let response = ui.interact(rect, ui.scope_id().with("events of a Δt"), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Group, true, label(frame, *crossings)));
    let painter = ui.painter_at(rect);
    let small = FontId::proportional(11.0);
    let Some((from, to)) = frame.step.filter(|(from, to)| to > from) else {
        let text = "The events of a Δt appear here at their times, once there is one";
        painter.text(rect.left_center() + vec2(10.0, 0.0), Align2::LEFT_CENTER, text, small, tones.weak);
        return;
    };
    let axis = Axis { line: axis_rect(ui, rect, frame, (from, to), &small, tones), from, to };
    axis.draw(ui, frame, tones);
    frame.crossings.iter().for_each(|crossing| axis.mark_crossing(ui, crossing, tones));
    let events = events_between(frame, from, to);
    let hovered = response.hover_pos().and_then(|at| axis.nearest(&events, at));
    let largest = events.iter().map(|row| row.event.impulse).fold(0.0, f64::max);
    let shown = context.session.shown_event();
    let shown = shown.filter(|shown| is_among(&events, shown.event.seq));
    let marks = axis.marks(&events);
    let is_crowd = marks.len() as f32 * APART > axis.line.width();
    let mut crowd = Mesh::default();
    for event in marks {
        let is_to_come = event.event.seq > frame.event_count;
        let mark =
            Mark { event, largest, color: if is_to_come { tones.weak } else { tones.strong }, size: 1.0 };
        if is_crowd { axis.add_to_crowd(&mut crowd, &mark) } else { axis.mark(ui, &mark) }
    }
    ui.painter().add(crowd);
    for event in shown.into_iter().chain(hovered) {
        axis.mark(ui, &Mark { event, largest, color: color32(context.palette().highlight), size: 1.5 });
    }
    answer(context, &response, &axis, hovered);
    let text = match (hovered, response.hover_pos()) {
        (Some(event), _) => describe(context, event),
        (None, Some(at)) => match axis.nearest_crossing(frame, at) {
            Some(crossing) => describe_crossing(context, crossing),
            None => format!("t = {:.9} s", axis.time(at.x)),
        },
        (None, None) => return,
    };
    response.on_hover_text_at_pointer(text);
}

/// The switch of the tile crossings at the right end; gives the room that is left of it.
fn show_switch(ui: &mut Ui, whole: Rect, crossings: &mut bool) -> Rect {
    let (rest, place) = whole.split_left_right_at_x(whole.right() - SWITCH);
    let text = egui::RichText::new("Tiles").size(11.0);
    let switch = ui.put(place.shrink2(vec2(4.0, 4.0)), egui::Button::selectable(*crossings, text));
    switch.widget_info(|| WidgetInfo::selected(Role::CheckBox, true, *crossings, "Tile crossings"));
    if switch.clicked() {
        *crossings = !*crossings;
    }
    switch.on_hover_text(
        "Marks when the selected bodies cross from one tile of the map to the next in this Δt",
    );
    rest
}

/// What is said of the line to those who do not see it.
fn label(frame: &Frame, crossings: bool) -> String {
    match frame.crossings.len() {
        _ if !crossings => "Events in this Δt".into(),
        1 => "Events in this Δt, 1 tile crossing".into(),
        count => format!("Events in this Δt, {count} tile crossings"),
    }
}

/// The recorded events of a Δt; of very many the first.
fn events_between(frame: &Frame, from: f64, to: f64) -> Vec<&Arc<EventRow>> {
    let first = frame.ledger.count_before(from);
    let until = frame.ledger.count_until(to.min(frame.recorded.to));
    frame.ledger.iter_from(first).take(until.saturating_sub(first).min(MOST_EVENTS)).collect()
}

/// Whether an event of this number is in rows that are in order.
fn is_among(rows: &[&Arc<EventRow>], seq: u64) -> bool {
    rows.binary_search_by_key(&seq, |row| row.event.seq).is_ok()
}

/// A click goes to an event, a double click shows its place large; elsewhere a click or a drag goes to that time.
fn answer(context: &AppContext<'_>, response: &egui::Response, axis: &Axis, hovered: Option<&Arc<EventRow>>) {
    match hovered {
        Some(event) if response.clicked() => context.outbox.act(Action::GoToEvent(event.event.seq)),
        _ if response.clicked() || response.dragged() => {
            if let Some(at) = response.interact_pointer_pos() {
                context.outbox.act(Action::Seek(axis.time(at.x).min(context.session.frame().recorded.to)));
            }
        }
        _ => {}
    }
    if let Some(event) = hovered.filter(|_| response.double_clicked()) {
        context.outbox.send(Message::FramePlace(event.event.point));
    }
}

/// Writes what the Δt is at both ends, and returns the room between.
fn axis_rect(
    ui: &Ui,
    rect: Rect,
    frame: &Frame,
    (from, to): (f64, f64),
    font: &FontId,
    tones: Tones,
) -> Rect {
    let painter = ui.painter_at(rect);
    let left = format!("Δt {}   {} s", frame.dt_index, significant(from, 8));
    let right = format!("{} s", significant(to, 8));
    let middle = rect.center().y;
    let at = pos2(rect.left() + 10.0, middle);
    let left = painter.text(at, Align2::LEFT_CENTER, left, font.clone(), tones.weak);
    let at = pos2(rect.right() - 10.0, middle);
    let right = painter.text(at, Align2::RIGHT_CENTER, right, font.clone(), tones.weak);
    // the same width for every Δt, so that the marks do not jump
    let inset = left.width().max(right.width()).max(120.0) + 20.0;
    Rect::from_min_max(
        pos2(rect.left() + inset, rect.top() + 4.0),
        pos2(rect.right() - inset, rect.bottom() - 4.0),
    )
}

/// What tells who met.
#[derive(Clone, Copy)]
enum Head {
    Disc,
    Square,
    Diamond,
}

impl Head {
    fn of(row: &EventRow) -> Self {
        let is_impact = matches!(row.event.kind, EventKind::Impact | EventKind::Collapse);
        match (is_impact, row.event.b) {
            (true, Some(BodyRef::Dynamic(_))) => Self::Disc,
            (true, _) => Self::Square,
            (false, _) => Self::Diamond,
        }
    }
}

/// How an event is marked.
struct Mark<'a> {
    event: &'a EventRow,
    /// The largest impulse of all, N·s.
    largest: f64,
    color: Color32,
    /// 1 unless it is to stand out.
    size: f32,
}

impl Mark<'_> {
    fn radius(&self) -> f32 {
        3.0 * self.size
    }

    fn square(&self, head: Pos2) -> Rect {
        Rect::from_center_size(head, vec2(1.8, 1.8) * self.radius())
    }

    fn diamond(&self, head: Pos2) -> [Pos2; 4] {
        [vec2(0.0, -1.0), vec2(1.0, 0.0), vec2(0.0, 1.0), vec2(-1.0, 0.0)]
            .map(|corner| head + 1.3 * self.radius() * corner)
    }

    fn hexagon(&self, head: Pos2) -> [Pos2; 6] {
        [
            vec2(1.0, 0.0),
            vec2(0.5, 0.87),
            vec2(-0.5, 0.87),
            vec2(-1.0, 0.0),
            vec2(-0.5, -0.87),
            vec2(0.5, -0.87),
        ]
        .map(|corner| head + self.radius() * corner)
    }
}

/// Adds a convex polygon as a fan of triangles.
fn add_polygon(mesh: &mut Mesh, corners: &[Pos2], color: Color32) {
    let first = mesh.vertices.len() as u32;
    corners.iter().for_each(|corner| mesh.colored_vertex(*corner, color));
    (1..corners.len() as u32 - 1).for_each(|nth| mesh.add_triangle(first, first + nth, first + nth + 1));
}

/// The stretch of the screen that stands for the Δt.
struct Axis {
    line: Rect,
    from: f64,
    to: f64,
}

impl Axis {
    fn x(&self, time: f64) -> f32 {
        let share = ((time - self.from) / (self.to - self.from)).clamp(0.0, 1.0);
        self.line.left() + self.line.width() * share as f32
    }

    fn time(&self, x: f32) -> f64 {
        let share = ((x - self.line.left()) / self.line.width().max(1.0)).clamp(0.0, 1.0);
        self.from + (self.to - self.from) * f64::from(share)
    }

    /// The line, and how far the Δt is gone through.
    fn draw(&self, ui: &Ui, frame: &Frame, tones: Tones) {
        let painter = ui.painter();
        let bottom = self.line.bottom() - 2.0;
        painter.hline(self.line.x_range(), bottom, Stroke::new(2.0, tones.line));
        let now = self.x(frame.time);
        painter.hline(self.line.left()..=now, bottom, Stroke::new(2.0, tones.accent));
        for x in [self.line.left(), self.line.right()] {
            painter.vline(x, bottom - 5.0..=bottom, Stroke::new(1.0, tones.weak));
        }
        if frame.open_step.is_some() {
            painter.vline(now, self.line.y_range(), Stroke::new(1.0, tones.accent));
        }
    }

    /// The events to be drawn: of many, at each place the one of each kind of head that hides the others, for what
    /// cannot be told apart need not be drawn.
    fn marks<'a>(&self, rows: &[&'a Arc<EventRow>]) -> Vec<&'a Arc<EventRow>> {
        if rows.len() <= ALL_DRAWN {
            return rows.to_vec();
        }
        let places = (self.line.width() * PLACES_PER_POINT).max(0.0) as usize + 1;
        let mut highest: Vec<[Option<&Arc<EventRow>>; 3]> = vec![[None; 3]; places];
        for row in rows.iter().copied() {
            let place = ((self.x(row.event.time) - self.line.left()) * PLACES_PER_POINT) as usize;
            let kept = &mut highest[place.min(places - 1)][Head::of(row) as usize];
            if kept.is_none_or(|kept| kept.event.impulse < row.event.impulse) {
                *kept = Some(row);
            }
        }
        highest.into_iter().flatten().flatten().collect()
    }

    /// The foot of a mark and its head.
    fn ends(&self, mark: &Mark<'_>) -> [Pos2; 2] {
        let event = &mark.event.event;
        let share = if mark.largest > 0.0 { (event.impulse / mark.largest).sqrt() } else { 0.0 };
        let foot = pos2(self.x(event.time), self.line.bottom() - 2.0);
        [foot, foot - vec2(0.0, 5.0 + (self.line.height() - 10.0) * share as f32)]
    }

    /// A stem as high as the impulse is large; its head tells who met: a disc for two moving bodies, a
    /// square for one at a static body, a diamond for what is no impact.
    fn mark(&self, ui: &Ui, mark: &Mark<'_>) {
        let [foot, head] = self.ends(mark);
        let (painter, color) = (ui.painter(), mark.color);
        painter.line_segment([foot, head], Stroke::new(mark.size.round(), color));
        match Head::of(mark.event) {
            Head::Disc => drop(painter.circle_filled(head, mark.radius(), color)),
            Head::Square => drop(painter.rect_filled(mark.square(head), 0.0, color)),
            Head::Diamond => {
                let corners = mark.diamond(head).to_vec();
                painter.add(egui::Shape::convex_polygon(corners, color, Stroke::NONE));
            }
        }
    }

    /// The same in few triangles, which shows where thousands of marks stand side by side and must be drawn in each frame: a
    /// disc is a hexagon there, and edges are not smoothed.
    fn add_to_crowd(&self, crowd: &mut Mesh, mark: &Mark<'_>) {
        let [foot, head] = self.ends(mark);
        crowd.add_colored_rect(Rect::from_two_pos(foot - vec2(0.5, 0.0), head + vec2(0.5, 0.0)), mark.color);
        match Head::of(mark.event) {
            Head::Disc => add_polygon(crowd, &mark.hexagon(head), mark.color),
            Head::Square => crowd.add_colored_rect(mark.square(head), mark.color),
            Head::Diamond => add_polygon(crowd, &mark.diamond(head), mark.color),
        }
    }

    /// A wedge that hangs from above.
    fn mark_crossing(&self, ui: &Ui, crossing: &Crossing, tones: Tones) {
        let tip = pos2(self.x(crossing.time), self.line.top() + 7.0);
        let corners = vec![tip, tip + vec2(-3.0, -7.0), tip + vec2(3.0, -7.0)];
        ui.painter().add(egui::Shape::convex_polygon(corners, tones.warning, Stroke::NONE));
    }

    fn nearest_crossing<'a>(&self, frame: &'a Frame, at: Pos2) -> Option<&'a Crossing> {
        let distance = |crossing: &Crossing| (self.x(crossing.time) - at.x).abs();
        let near = frame.crossings.iter().filter(|crossing| distance(crossing) < REACH);
        near.min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    fn nearest<'a>(&self, rows: &[&'a Arc<EventRow>], at: Pos2) -> Option<&'a Arc<EventRow>> {
        let distance = |row: &EventRow| (self.x(row.event.time) - at.x).abs();
        let near = rows.iter().copied().filter(|row| distance(row) < REACH);
        near.min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }
}

fn describe_crossing(context: &AppContext<'_>, crossing: &Crossing) -> String {
    let name = context.shown.and_then(|shown| shown.name(crossing.key)).unwrap_or("A body");
    let (axis, [left, entered]) = (["x", "y", "z"][crossing.axis], crossing.tiles);
    format!("{name} goes from tile {left} to {entered} in {axis}\nt = {:.9} s", crossing.time)
}

fn describe(context: &AppContext<'_>, row: &EventRow) -> String {
    let event = &row.event;
    let kind = event.kind.name().replace('_', " ");
    let bodies = crate::gui::ledger::bodies(context, row);
    let impulse = significant(event.impulse, 6);
    format!("{} {kind}: {bodies}\nt = {:.9} s, {impulse} N·s", event.seq, event.time)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::scene::NodeKey;
    use crate::sim::Event;

    fn row(seq: u64) -> Arc<EventRow> {
        let event = Event {
            seq,
            time: seq as f64 / 20_000.0,
            impulse: (seq * 7919 % 10_007) as f64,
            kind: EventKind::Impact,
            a: BodyRef::Dynamic(0),
            b: Some(BodyRef::Dynamic(1)),
            point: DVec3::ZERO,
            normal: DVec3::X,
            vn_before: -1.0,
            vn_after: 1.0,
            group: 0,
            row_in_group: [0; 2],
            bodies: 2,
            gap: 0.0,
            rounds: 0,
        };
        Arc::new(EventRow {
            event,
            a_key: NodeKey(1),
            b_key: Some(NodeKey(2)),
            a_label: Arc::default(),
            b_label: Arc::default(),
        })
    }

    /// Symptom: a repaint took most of a second while a Δt with thousands of events was shown.
    /// Expected: as many marks as there are places, the highest of each among them.
    /// Cause: each event was drawn, and looked through all for the largest impulse.
    #[test]
    fn many_events_are_drawn_as_many_marks_as_can_be_told_apart() {
        let rows: Vec<_> = (1..=20_000).map(row).collect();
        let rows: Vec<_> = rows.iter().collect();
        assert!(is_among(&rows, 77) && !is_among(&rows, 20_001));
        let axis = Axis { line: Rect::from_min_size(Pos2::ZERO, vec2(800.0, 20.0)), from: 0.0, to: 1.0 };
        let marks = axis.marks(&rows);
        assert!((800..=3 * 801).contains(&marks.len()), "{} marks", marks.len());
        let largest = |rows: &mut dyn Iterator<Item = f64>| rows.fold(0.0, f64::max);
        assert_eq!(
            largest(&mut marks.iter().map(|row| row.event.impulse)),
            largest(&mut rows.iter().map(|row| row.event.impulse))
        );
        assert_eq!(axis.marks(&rows[..ALL_DRAWN]).len(), ALL_DRAWN);
    }
}
