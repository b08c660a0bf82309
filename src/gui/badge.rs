//! The error badge of the status bar: the residuals, the worst overlap and the events of this Δt; a click
//! goes to the event at which the residual grew most.

use std::fmt::Write as _;

use egui::{Button, RichText, Ui, vec2};

use super::colors::tones;
use super::context::{AppContext, Message};
use super::numbers::{significant, tiny};
use super::widgets::{mono, severity_icon};
use crate::editor::Action;
use crate::record::Frame;
use crate::scene::Scene;

/// Residuals above this, and overlaps in metres, deserve a second look. Below, nothing can be seen.
const NOTICEABLE: f64 = 1e-6;

/// Overlap of stepped bodies that is part of the method, in radii of the smallest.
const OF_STEPPED: f64 = 1e-3;

/// What the place of the largest error takes, points.
const MOST_AT: f32 = 130.0;

/// What the badge says.
struct Figures {
    energy: Option<f64>,
    momentum: Option<f64>,
    overlap: f64,
    /// Overlap that does not deserve a second look, m.
    allowed: f64,
    events: usize,
}

impl Figures {
    fn of(context: &AppContext<'_>) -> Self {
        let frame = context.session.frame();
        let overlap = frame.worst_overlap;
        let smallest = || context.scene().and_then(Scene::smallest_radius).unwrap_or(0.0);
        let allowed = if overlap.is_of_stepped { OF_STEPPED * smallest() } else { 0.0 };
        Self {
            allowed: allowed.max(NOTICEABLE),
            energy: frame.energy.and_then(|energy| energy.residual),
            momentum: frame.momentum.map(|momentum| momentum.residual),
            overlap: overlap.depth,
            events: frame.events.len(),
        }
    }

    fn is_noticeable(&self) -> bool {
        let mut residuals = [self.energy, self.momentum].into_iter().flatten();
        self.overlap > self.allowed || residuals.any(|residual| residual.abs() > NOTICEABLE)
    }

    fn text(&self) -> String {
        let residual = |value: Option<f64>| value.map_or("–".to_owned(), tiny);
        let overlap = if self.overlap > 0.0 { tiny(self.overlap) } else { "0".to_owned() };
        let plural = if self.events == 1 { "" } else { "s" };
        format!(
            "ΔE {}  Δp {}  overlap {overlap} m  {} event{plural}/Δt",
            residual(self.energy),
            residual(self.momentum),
            self.events
        )
    }
}

/// In a narrow window the errors alone, with `behind` points left for what comes next.
pub fn show(ui: &mut Ui, context: &AppContext<'_>, behind: f32) {
    let frame = context.session.frame();
    let figures = Figures::of(context);
    if figures.is_noticeable() {
        severity_icon(ui, false).on_hover_text(
            "A residual is above 1e-6, or an overlap above 1e-6 m and what stepped bodies may have",
        );
    }
    let jump = frame.largest_jump;
    let color = if figures.is_noticeable() { tones(ui).warning } else { ui.visuals().text_color() };
    let text = mono(figures.text()).size(11.5).color(color);
    // what stands behind it stays in its place
    let button = Button::new(text).small().frame_when_inactive(jump.is_some()).min_size(vec2(300.0, 0.0));
    let response = ui.add_enabled(jump.is_some(), button);
    let help = || help(frame);
    let response = response.on_hover_text(help()).on_disabled_hover_text(help());
    let target = jump.map_or(String::new(), |jump| format!("; go to event {}", jump.event));
    let name = format!("Errors: {}{target}", figures.text());
    let enabled = jump.is_some();
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, enabled, &name));
    if let (true, Some(jump)) = (response.clicked(), jump) {
        context.outbox.send(Message::ShowEvents);
        context.outbox.act(Action::GoToEvent(jump.event));
    }
    if let Some(jump) = jump.filter(|_| ui.available_width() > MOST_AT + behind) {
        ui.label(RichText::new(format!("most at event {}", jump.event)).small().color(tones(ui).weak));
    }
    ui.add_space(10.0);
}

/// What the figures mean, and where a click leads.
fn help(frame: &Frame) -> String {
    let mut text = "ΔE: change of the total energy that impacts, drag and edits do not explain, over the energy at \
                    the start.\nΔp: change of the momentum that forces and static bodies do not explain, over the \
                    largest sum of momenta so far.\nOverlap: the deepest of any two bodies up to this time; of stepped ones up to a thousandth \
                    of their radius.\n"
        .to_owned();
    if let Some(total) = frame.energy.and_then(|energy| energy.total) {
        // writing to a string cannot fail
        let _ = writeln!(text, "Total energy: {} J.", significant(total, 9));
    }
    match frame.largest_jump {
        Some(jump) => {
            let _ = write!(
                text,
                "The residual changed most, by {}, at event {} (t = {} s), the flights before it included. Click \
                 to go back there.",
                tiny(jump.size),
                jump.event,
                significant(jump.time, 6)
            );
        }
        None => text += "No event has changed the residual yet.",
    }
    text
}
