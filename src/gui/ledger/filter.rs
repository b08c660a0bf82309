//! Which events the ledger lists: of a body or a pair, of some kinds, in a time, of a size; and the row where that is chosen.

use egui::{TextEdit, Ui};

use crate::editor::parse_number;
use crate::gui::colors::tones;
use crate::gui::context::AppContext;
use crate::record::{Ledger, Of};
use crate::sim::EventKind;

/// All conditions hold of the events listed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Filter {
    pub of: Of,
    /// Kinds that are left out.
    pub without: Vec<EventKind>,
    /// s.
    pub from: f64,
    pub to: f64,
    /// N·s.
    pub impulse: f64,
}

impl Default for Filter {
    fn default() -> Self {
        Self { of: Of::All, without: Vec::new(), from: 0.0, to: f64::INFINITY, impulse: 0.0 }
    }
}

impl Filter {
    /// Whether it holds of the n-th row of a ledger.
    pub fn holds(&self, ledger: &Ledger, nth: usize) -> bool {
        let of_event = ledger.event_at(nth).is_some_and(|event| {
            (self.from..=self.to).contains(&event.time)
                && event.impulse >= self.impulse
                && !self.without.contains(&event.kind)
        });
        let of_bodies =
            || self.of == Of::All || ledger.keys_at(nth).is_some_and(|(a, b)| self.of.holds_between(a, b));
        of_event && of_bodies()
    }
}

/// Keeps what is typed.
#[derive(Default)]
pub(super) struct FilterBar {
    pub filter: Filter,
    /// Only the Δt being looked at.
    pub only_step: bool,
    from: String,
    to: String,
    impulse: String,
}

impl FilterBar {
    pub fn show(&mut self, ui: &mut Ui, context: &AppContext<'_>) {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            ui.checkbox(&mut self.only_step, "Only this Δt")
                .on_hover_text("Only events of the Δt being looked at");
            self.bodies(ui, context);
            self.kinds(ui);
            let is_time = "Seconds; empty for no bound";
            self.filter.from =
                typed(ui, "from", &mut self.from, "Earliest time listed", is_time).unwrap_or(0.0);
            self.filter.to =
                typed(ui, "to", &mut self.to, "Latest time listed", is_time).unwrap_or(f64::INFINITY);
            let help = "Newton seconds; empty for no bound";
            self.filter.impulse =
                typed(ui, "J ≥", &mut self.impulse, "Smallest impulse listed", help).unwrap_or(0.0);
            let is_all = self.filter == Filter::default() && !self.only_step;
            if !is_all && ui.small_button("All").on_hover_text("Lists every event again").clicked() {
                *self = Self::default();
            }
        });
    }

    /// The filter, narrowed to the Δt being looked at where that is asked for.
    pub fn wanted(&self, context: &AppContext<'_>) -> Filter {
        if !self.only_step {
            return self.filter.clone();
        }
        // Before the first Δt there is nothing to list.
        let (from, to) = context.session.frame().step.unwrap_or((f64::INFINITY, f64::INFINITY));
        Filter { from: self.filter.from.max(from), to: self.filter.to.min(to), ..self.filter.clone() }
    }

    /// All bodies, or those that are selected when it is chosen.
    fn bodies(&mut self, ui: &mut Ui, context: &AppContext<'_>) {
        let name = |key| context.shown.and_then(|shown| shown.name(key)).unwrap_or("?").to_owned();
        let text = match self.filter.of {
            Of::All => "All bodies".to_owned(),
            Of::Body(key) => name(key),
            Of::Pair(a, b) => format!("{} – {}", name(a), name(b)),
        };
        let selection = context.session.selection().keys();
        let combo = egui::ComboBox::from_id_salt("ledger bodies").selected_text(text).width(96.0);
        let response = combo.show_ui(ui, |ui| {
            ui.selectable_value(&mut self.filter.of, Of::All, "All bodies");
            if let [.., last] = selection {
                ui.selectable_value(&mut self.filter.of, Of::Body(*last), format!("Only {}", name(*last)));
            }
            if let [a, b] = selection {
                let text = format!("Only {} with {}", name(*a), name(*b));
                ui.selectable_value(&mut self.filter.of, Of::Pair(*a, *b), text);
            }
            if selection.is_empty() {
                ui.weak("Select one body, or two, to list only their events");
            }
        });
        named(&response.response, "Bodies listed");
        response
            .response
            .on_hover_text("Whose events are listed: all, of the body selected, or between two selected");
    }

    fn kinds(&mut self, ui: &mut Ui) {
        let text = match self.filter.without.len() {
            0 => "All kinds".to_owned(),
            without => format!("{} kinds", EventKind::ALL.len() - without),
        };
        let combo = egui::ComboBox::from_id_salt("ledger kinds").selected_text(text).width(80.0);
        let response = combo.show_ui(ui, |ui| {
            for kind in EventKind::ALL {
                let mut listed = !self.filter.without.contains(&kind);
                let name = kind.name().replace('_', " ");
                if ui.checkbox(&mut listed, name).on_hover_text(kind.meaning()).changed() {
                    self.filter.without.retain(|other| *other != kind);
                    if !listed {
                        self.filter.without.push(kind);
                    }
                }
            }
        });
        named(&response.response, "Kinds listed");
        response.response.on_hover_text("Which kinds of events are listed");
    }
}

fn named(response: &egui::Response, name: &str) {
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, name));
}

/// A number that may be left out.
fn typed(ui: &mut Ui, title: &str, text: &mut String, name: &str, help: &str) -> Option<f64> {
    ui.weak(title);
    let value = parse_number(text);
    let is_wrong = value.is_none() && !text.trim().is_empty();
    let color = if is_wrong { tones(ui).error } else { ui.visuals().text_color() };
    let response = ui.add(TextEdit::singleline(text).desired_width(54.0).text_color(color));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, name));
    response.on_hover_text(format!("{name}. {help}"));
    value
}
