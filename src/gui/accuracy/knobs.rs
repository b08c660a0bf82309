//! The knobs of a study as a person types them.

use egui::{Grid, RichText, TextEdit, Ui};

use crate::editor;
use crate::gui::colors::tones;
use crate::sim::Method;
use crate::study::{KNOBS, Knob, SettingsError, StudySettings, seconds, short};

/// Knobs shown at once; the others are folded away.
const FIRST: [&str; 4] = ["until", "dt", "tolerances", "repeat"];

/// Width of a field, points.
const WIDTH: f32 = 140.0;

/// The texts being typed, one for each knob, and the methods chosen.
pub struct Knobs {
    texts: Vec<String>,
    methods: Vec<Method>,
}

impl Default for Knobs {
    fn default() -> Self {
        let settings = StudySettings::default();
        let texts = KNOBS.iter().map(|knob| text_of(&settings, knob.name)).collect();
        Self { texts, methods: settings.methods }
    }
}

impl Knobs {
    pub fn show(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            for method in Method::ALL {
                let mut chosen = self.methods.contains(&method);
                if ui.checkbox(&mut chosen, method.name()).on_hover_text(method.meaning()).changed() {
                    self.methods.retain(|other| *other != method);
                    self.methods.extend(chosen.then_some(method));
                }
            }
        });
        self.grid(ui, "knobs", |knob| FIRST.contains(&knob.name));
        ui.collapsing("More settings", |ui| {
            self.grid(ui, "more knobs", |knob| knob.name != "methods" && !FIRST.contains(&knob.name));
        });
    }

    fn grid(&mut self, ui: &mut Ui, name: &str, wanted: impl Fn(&Knob) -> bool) {
        let wrong = self.settings().err().map(|error| error.name);
        Grid::new(name).num_columns(3).spacing([6.0, 3.0]).show(ui, |ui| {
            for (knob, text) in KNOBS.iter().zip(&mut self.texts).filter(|(knob, _)| wanted(knob)) {
                let label = ui.label(knob.label).on_hover_text(knob.reason);
                let is_wrong = wrong == Some(knob.name);
                let color = if is_wrong { tones(ui).error } else { ui.visuals().text_color() };
                let edit = TextEdit::singleline(text)
                    .font(egui::TextStyle::Monospace)
                    .text_color(color)
                    .desired_width(WIDTH);
                ui.add_sized([WIDTH, 20.0], edit).labelled_by(label.id).on_hover_text(knob.reason);
                ui.label(RichText::new(knob.unit).weak());
                ui.end_row();
            }
        });
    }

    /// What is typed, or which knob is wrong and why.
    pub fn settings(&self) -> Result<StudySettings, SettingsError> {
        let mut settings = StudySettings { methods: self.methods.clone(), ..StudySettings::default() };
        for (knob, text) in KNOBS.iter().zip(&self.texts) {
            set(&mut settings, knob.name, text).ok_or(SettingsError {
                name: knob.name,
                complaint: "is not a number or a list of numbers",
            })?;
        }
        settings.check().map(|()| settings)
    }
}

/// What the panel calls the knob that is wrong.
pub fn complaint(error: &SettingsError) -> String {
    let label = KNOBS.iter().find(|knob| knob.name == error.name).map_or(error.name, |knob| knob.label);
    format!("{label} {}", error.complaint)
}

fn text_of(settings: &StudySettings, name: &str) -> String {
    let list = |values: &[f64], text: fn(f64) -> String| {
        values.iter().map(|value| text(*value)).collect::<Vec<_>>().join(", ")
    };
    match name {
        "until" => short(settings.until),
        "dt" => list(&settings.dts, |dt| seconds(dt).trim_end_matches(" s").to_owned()),
        "tolerances" => list(&settings.tolerances, short),
        "group-steps" => list(&settings.group_steps, short),
        "repeat" => settings.repeat.to_string(),
        "samples" => settings.samples.to_string(),
        "trusted-error" => short(settings.trusted_error),
        "agreement" => short(settings.agreement),
        "event-window" => short(settings.event_window),
        "reference-limit" => short(settings.reference_limit),
        "run-limit" => short(settings.run_limit),
        _ => String::new(),
    }
}

fn set(settings: &mut StudySettings, name: &str, text: &str) -> Option<()> {
    let number = || editor::parse_number(text);
    let list = || -> Option<Vec<f64>> {
        text.split([',', ';'])
            .map(str::trim)
            .filter(|part| !part.is_empty())
            .map(editor::parse_number)
            .collect()
    };
    let whole = || text.trim().parse::<u32>().ok();
    match name {
        "until" => settings.until = number()?,
        "dt" => settings.dts = list()?,
        "tolerances" => settings.tolerances = list()?,
        "group-steps" => settings.group_steps = list()?,
        "repeat" => settings.repeat = whole()?,
        "samples" => settings.samples = whole()?,
        "trusted-error" => settings.trusted_error = number()?,
        "agreement" => settings.agreement = number()?,
        "event-window" => settings.event_window = number()?,
        "reference-limit" => settings.reference_limit = number()?,
        "run-limit" => settings.run_limit = number()?,
        // Chosen by boxes, not typed.
        _ => {}
    }
    Some(())
}
