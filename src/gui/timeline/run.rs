//! The whole run: what is recorded and what was dropped, how many events there are where, edits, bookmarks, and what is
//! shown now. A click or a drag goes to a time, the wheel zooms, the right button or Ctrl moves what is shown, Shift marks a
//! range that playing repeats.

use std::sync::{Arc, Weak};

use egui::{
    Align2, Color32, FontId, Key, Mesh, PointerButton, Pos2, Rect, Response, Role, Sense, Stroke, Ui,
};
use egui::{WidgetInfo, pos2, vec2};

use super::axis::Axis;
use super::bookmarks;
use crate::editor::{Action, SessionCommand, WindowCommand};
use crate::gui::colors::{Tones, color32, tones};
use crate::gui::context::AppContext;
use crate::gui::numbers::significant;
use crate::gui::widgets::name_button;
use crate::record::{Division, Frame};

pub(super) const HEIGHT: f32 = 38.0;

/// Room for what is written at the right, points.
const RIGHT: f32 = 104.0;
const LEFT: f32 = 12.0;

/// Smallest distance of two marks of Δt, points.
const TICKS_APART: f64 = 5.0;

/// What part of the run is shown.
#[derive(Default)]
pub(super) struct RunLine {
    /// s; `None` for all of it.
    part: Option<(f64, f64)>,
    /// Where a range began that is being drawn, s.
    range_from: Option<f64>,
    bookmarks: bookmarks::Flags,
    density: Density,
}

/// The events of a frame by time, as it was drawn last.
#[derive(Default)]
struct Density {
    frame: Weak<Frame>,
    axis: Option<Axis>,
    color: Color32,
    bars: Arc<Mesh>,
}

impl RunLine {
    pub fn show(&mut self, ui: &mut Ui, context: &AppContext<'_>) {
        let size = vec2(ui.available_width(), HEIGHT);
        let (rect, response) =
            ui.allocate_exact_size(size, Sense::click_and_drag().union(Sense::focusable_noninteractive()));
        let frame = context.session.frame();
        response.widget_info(|| WidgetInfo::labeled(Role::Slider, true, "Timeline of the run"));
        let tones = tones(ui);
        ui.painter_at(rect).rect_filled(rect, 0.0, tones.heading);
        let whole = whole(frame);
        let Some(whole) = whole else {
            let text =
                "The run appears here once it has begun: step (.), play (Space) or go to the next event (N)";
            let at = rect.left_center() + vec2(10.0, 0.0);
            ui.painter().text(at, Align2::LEFT_CENTER, text, FontId::proportional(11.0), tones.weak);
            return;
        };
        let axis = self.axis(rect, whole);
        self.draw(ui, context, &axis, tones);
        memory(ui, context, rect, tones);
        self.bookmarks.show(ui, context, &axis);
        self.answer(context, &response, &axis, whole, ui);
        if let Some(at) = response.hover_pos().filter(|at| axis.line.x_range().contains(at.x)) {
            response.on_hover_text_at_pointer(describe(frame, &axis, at));
        }
    }

    fn axis(&mut self, rect: Rect, whole: (f64, f64)) -> Axis {
        let line = Rect::from_min_max(
            pos2(rect.left() + LEFT, rect.top() + 3.0),
            pos2((rect.right() - RIGHT).max(rect.left() + 2.0 * LEFT), rect.bottom() - 14.0),
        );
        self.part = self.part.filter(|(from, to)| *from < whole.1 && *to > whole.0 && from < to);
        let (from, to) = self.part.unwrap_or(whole);
        Axis { line, from, to }
    }

    fn answer(
        &mut self,
        context: &AppContext<'_>,
        response: &Response,
        axis: &Axis,
        whole: (f64, f64),
        ui: &Ui,
    ) {
        if response.clicked() {
            response.request_focus();
        }
        let (modifiers, scroll) = ui.input(|input| (input.modifiers, input.smooth_scroll_delta()));
        if let Some(at) = response.hover_pos().filter(|_| scroll.y != 0.0) {
            let factor = libm::exp(-0.005 * f64::from(scroll.y));
            self.part = Some(axis.zoomed(factor, at.x, whole)).filter(|part| *part != whole);
        }
        let pans = response.dragged_by(PointerButton::Secondary)
            || response.dragged_by(PointerButton::Middle)
            || (response.dragged_by(PointerButton::Primary) && modifiers.command);
        if pans {
            self.part = Some(axis.panned(response.drag_delta().x, whole)).filter(|part| *part != whole);
        }
        if response.double_clicked() {
            self.part = None;
        }
        if let Some(at) = response.interact_pointer_pos().filter(|_| !pans) {
            self.point(context, response, axis.time(at.x), modifiers.shift);
        } else {
            self.range_from = None;
        }
        if response.has_focus() {
            keys(ui, context, modifiers);
        }
    }

    /// The pointer is held at a time.
    fn point(&mut self, context: &AppContext<'_>, response: &Response, time: f64, shift: bool) {
        if response.secondary_clicked() || !(response.clicked() || response.is_pointer_button_down_on()) {
            return;
        }
        if shift && self.range_from.is_none() && response.drag_started() {
            self.range_from = Some(time);
        }
        match self.range_from {
            Some(from) => {
                let range = (from.min(time), from.max(time));
                context.outbox.act(Action::SetRange((range.0 < range.1).then_some(range)));
            }
            None if shift && response.clicked() => context.outbox.act(Action::SetRange(None)),
            None if shift => {}
            None if response.clicked() || response.dragged() => {
                context.outbox.act(Action::Seek(time.min(context.session.frame().recorded.to)));
            }
            None => {}
        }
    }

    fn draw(&mut self, ui: &Ui, context: &AppContext<'_>, axis: &Axis, tones: Tones) {
        let frame = context.session.frame();
        let painter = ui.painter().with_clip_rect(axis.line.expand2(vec2(LEFT, 20.0)));
        let bottom = axis.line.bottom();
        let clamped = |time: f64| axis.x(time).clamp(axis.line.left(), axis.line.right());
        let known = clamped(frame.recorded.from)..=clamped(frame.recorded.to);
        if let Some((from, to)) = context.session.travel().range() {
            let rect = Rect::from_x_y_ranges(clamped(from)..=clamped(to), axis.line.y_range());
            painter.rect_filled(rect, 0.0, tones.accent.gamma_multiply(0.25));
        }
        painter.add(self.density.bars(frame, axis, tones.strong.gamma_multiply(0.55)));
        painter.hline(axis.line.x_range(), bottom, Stroke::new(1.0, tones.line));
        painter.hline(known, bottom, Stroke::new(2.0, tones.accent));
        ticks(&painter, frame, axis, tones.weak);
        scale(&painter, axis, tones.weak);
        for time in &frame.recorded.edits {
            let x = axis.x(*time);
            painter.vline(x, axis.line.y_range(), Stroke::new(1.0, tones.warning));
        }
        dropped(&painter, frame, axis, tones);
        let now = clamped(frame.time);
        painter.vline(
            now,
            axis.line.top()..=bottom + 3.0,
            Stroke::new(2.0, color32(context.palette().highlight)),
        );
    }
}

/// The arrow keys step while the timeline has the keyboard: by Δt, with Shift by events.
fn keys(ui: &Ui, context: &AppContext<'_>, modifiers: egui::Modifiers) {
    let pressed = |key: Key| ui.input(|input| input.key_pressed(key));
    let command = match (pressed(Key::ArrowLeft), pressed(Key::ArrowRight), modifiers.shift) {
        (true, _, false) => SessionCommand::StepBack,
        (true, _, true) => SessionCommand::EventBack,
        (_, true, false) => SessionCommand::StepForward,
        (_, true, true) => SessionCommand::NextEvent,
        _ => return,
    };
    context.outbox.command(command);
}

/// From the start to the last time that is recorded; `None` before the first step.
fn whole(frame: &Frame) -> Option<(f64, f64)> {
    let end = frame.recorded.to.max(frame.step.map_or(0.0, |(_, end)| end));
    (end > 0.0).then_some((0.0, end))
}

impl Density {
    /// Bars whose heights grow with the logarithm of how many events there are; made anew when something else is to be seen.
    fn bars(&mut self, frame: &Arc<Frame>, axis: &Axis, color: Color32) -> Arc<Mesh> {
        let now = (Arc::as_ptr(frame), Some(*axis), color);
        if now != (self.frame.as_ptr(), self.axis, self.color) {
            *self = Self {
                frame: Arc::downgrade(frame),
                axis: Some(*axis),
                color,
                bars: density(frame, axis, color).into(),
            };
        }
        self.bars.clone()
    }
}

/// How many events there are in each stretch of a point.
fn density(frame: &Frame, axis: &Axis, color: Color32) -> Mesh {
    // One mesh of all: a thousand lines with smoothed edges are felt in each frame.
    let mut bars = Mesh::default();
    if frame.ledger.is_empty() {
        return bars;
    }
    let columns = axis.line.width().max(1.0) as usize;
    let times = (0..=columns).map(|nth| axis.from + (axis.to - axis.from) * nth as f64 / columns as f64);
    let before = frame.ledger.counts_before(times);
    let counts: Vec<usize> = before.windows(2).map(|pair| pair[1].saturating_sub(pair[0])).collect();
    let height = |count: usize| libm::log1p(count as f64);
    let most = counts.iter().copied().max().map_or(1.0, height).max(1.0);
    for (column, count) in counts.into_iter().enumerate().filter(|(_, count)| *count > 0) {
        let foot = pos2(axis.line.left() + column as f32, axis.line.bottom());
        let length = ((axis.line.height() - 4.0) * (height(count) / most) as f32).max(2.0);
        bars.add_colored_rect(Rect::from_two_pos(foot, foot + vec2(1.0, -length)), color);
    }
    bars
}

/// Where the Δt end, if that can be told apart.
fn ticks(painter: &egui::Painter, frame: &Frame, axis: &Axis, color: Color32) {
    let bottom = axis.line.bottom();
    // The one that is open has not ended yet.
    let is_seen = |(from, to): &(f64, f64)| to - from >= TICKS_APART * axis.scale() && *to <= axis.to;
    let open = frame.open_step.filter(is_seen).map(|(_, to)| to);
    for time in tick_times(&frame.recorded.divisions, axis).into_iter().chain(open) {
        painter.vline(axis.x(time), bottom - 3.0..=bottom, Stroke::new(1.0, color));
    }
}

/// Ends of the Δt that lie on the axis, of those that are long enough.
fn tick_times(divisions: &[Division], axis: &Axis) -> Vec<f64> {
    let mut times = Vec::new();
    let mut before = f64::NEG_INFINITY;
    for division in divisions {
        let Division { origin, dt, to } = *division;
        let from = axis.from.max(origin).max(before);
        before = to;
        if dt < TICKS_APART * axis.scale() || from > to {
            continue;
        }
        let first = ((from - origin) / dt).floor();
        let count = ((axis.to.min(to) - from) / dt).clamp(0.0, 10_000.0) as u32 + 2;
        let ends = (0..=count).map(|nth| origin + (first + f64::from(nth)) * dt);
        times.extend(ends.filter(|time| (from..=axis.to.min(to)).contains(time)));
    }
    times
}

/// Times below the line.
fn scale(painter: &egui::Painter, axis: &Axis, color: Color32) {
    let (marks, step) = axis.marks();
    let digits = 3 + (libm::log10((axis.to.abs() / step).max(1.0))) as usize;
    for time in marks {
        let at = pos2(axis.x(time), axis.line.bottom());
        painter.vline(at.x, at.y..=at.y + 3.0, Stroke::new(1.0, color));
        let text = format!("{} s", significant(time, digits));
        painter.text(at + vec2(0.0, 2.0), Align2::CENTER_TOP, text, FontId::proportional(9.5), color);
    }
}

/// Hatches what was dropped to stay within the memory.
fn dropped(painter: &egui::Painter, frame: &Frame, axis: &Axis, tones: Tones) {
    let end = axis.x(frame.recorded.from).min(axis.line.right());
    if frame.recorded.from <= 0.0 || end <= axis.line.left() {
        return;
    }
    let mut x = axis.line.left();
    while x < end {
        let line = [pos2(x, axis.line.bottom()), pos2((x + 6.0).min(end), axis.line.top())];
        painter.line_segment(line, Stroke::new(1.0, tones.line));
        x += 6.0;
    }
}

/// How much memory the recording takes of what it may, and what was dropped to stay within it; a click opens the settings.
fn memory(ui: &Ui, context: &AppContext<'_>, rect: Rect, tones: Tones) {
    let frame = context.session.frame();
    let mib = |bytes: usize| bytes as f64 / f64::from(1 << 20);
    let (used, budget) = (mib(frame.recorded.bytes), mib(frame.recorded.budget));
    let memory = format!("{} of {} MiB", significant(used, 2), significant(budget, 4));
    let events = format!("{} events", crate::gui::numbers::count(frame.ledger.len() as u64));
    let has_dropped = frame.recorded.from > 0.0;
    let kept = if has_dropped {
        format!("kept from {} s", significant(frame.recorded.from, 4))
    } else {
        String::new()
    };
    let color = if used > 0.8 * budget { tones.warning } else { tones.weak };
    let area = Rect::from_min_max(pos2(rect.right() - RIGHT + 4.0, rect.top()), rect.max);
    let response = ui.interact(area, ui.scope_id().with("memory"), Sense::click());
    let name = format!("Recording: {memory}, {events}{}{kept}", if has_dropped { ", " } else { "" });
    name_button(ui, &response, &name, false);
    if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(area.shrink(1.0), 3.0, ui.visuals().widgets.hovered.weak_bg_fill);
    }
    let lines = [(memory, color), (events, tones.weak), (kept, tones.warning)];
    for (nth, (text, color)) in lines.into_iter().enumerate() {
        let at = pos2(rect.right() - 8.0, rect.top() + 8.0 + 11.0 * nth as f32);
        ui.painter().text(at, Align2::RIGHT_CENTER, text, FontId::proportional(10.0), color);
    }
    let help = "Memory that the recording of the run takes, of what it may. When that is used up, it keeps fewer states \
                to go on from; then its oldest part is dropped. A click opens the settings, where it is set.";
    if response.on_hover_text(help).clicked() {
        context.outbox.command(WindowCommand::Settings);
    }
}

fn describe(frame: &Frame, axis: &Axis, at: Pos2) -> String {
    let time = axis.time(at.x);
    let near = 4.0 * axis.scale();
    let count = frame.ledger.count_before(time + near) - frame.ledger.count_before(time - near);
    let mut text = format!("t = {} s, {count} events near", significant(time, 7));
    if time < frame.recorded.from {
        text += "\nDropped to stay within the memory that recordings may take";
    }
    text += "\nWheel: zoom. Right button: move. Shift: range that playing repeats. Double click: all";
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Symptom: the ends of all Δt were marked as though each had been as long as the present one. Expected: where they are.
    #[test]
    fn the_ends_of_delta_t_of_each_length_are_marked() {
        let divisions = [(0.0, 1.0, 3.0), (3.0, 0.5, 4.5)];
        let divisions = divisions.map(|(origin, dt, to)| Division { origin, dt, to });
        let line = Rect::from_min_size(pos2(0.0, 0.0), vec2(500.0, 20.0));
        let times = |from: f64, to: f64| {
            let mut times = tick_times(&divisions, &Axis { line, from, to });
            times.dedup();
            times
        };
        assert_eq!(times(0.0, 5.0), [0.0, 1.0, 2.0, 3.0, 3.5, 4.0, 4.5]);
        assert_eq!(times(1.5, 3.6), [2.0, 3.0, 3.5]);
        assert!(times(4.6, 5.0).is_empty());
    }
}
