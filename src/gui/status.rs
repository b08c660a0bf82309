//! The status bar: where the simulation stands, how quick and how exact it is.

use egui::{RichText, Role, Ui, WidgetInfo};

use super::colors::{color32, tones};
use super::context::AppContext;
use super::widgets::mono;
use super::{badge, numbers};
use crate::editor::{Action, Verified};
use crate::record::Frame;
use crate::sim::Method;

/// What the window itself knows.
pub struct Pace {
    /// Seconds from one repaint to its end.
    pub frame_s: f64,
}

pub fn show(ui: &mut Ui, context: &AppContext<'_>, pace: &Pace) {
    let frame = context.session.frame();
    let notes: Vec<Note> = [stepped(context), outside(ui, context)].into_iter().flatten().collect();
    ui.horizontal_centered(|ui| {
        ui.spacing_mut().item_spacing.x = SPACING;
        // What tells of trouble stays whole: numbers that matter less make room for it.
        let verified_width = if context.session.verified().is_some() { VERIFIED } else { 0.0 };
        let behind = width_of(ui, &notes, |note| &note.short) + verified_width;
        let room = BADGE + behind;
        let frame_time = format!("{:.6} s", frame.time);
        item(ui, "t", &frame_time, 92.0, room, "Model time");
        let help = "Number of the Δt looked at, and how far it is open";
        item(ui, "Δt", &step_text(frame), 82.0, room, help);
        if frame.method != Method::Exact {
            item(ui, "method", frame.method.name(), 40.0, room, frame.method.meaning());
        }
        let help = "Event of this Δt looked at, and of how many, where that is known";
        item(ui, "event", &event_text(frame), 62.0, room, help);
        item(ui, "in all", &numbers::count(frame.event_count), 46.0, room, "Events since the start");
        item(ui, "bodies", &body_text(frame), 56.0, room, "Moving + static bodies in the simulation");
        let per_s = numbers::significant(frame.events_per_s, 3);
        item(ui, "events/s", &per_s, 48.0, room, "Events per second of computing, smoothed");
        badge::show(ui, context, behind);
        let whole = width_of(ui, &notes, |note| &note.long) + verified_width + STEP_AND_FRAME;
        let is_long = ui.available_width() >= whole;
        for note in notes {
            let text = if is_long { &note.long } else { &note.short };
            let response = ui.label(RichText::new(text).small().color(note.color));
            response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &note.long));
            response.on_hover_text(format!("{}\n{}", note.long, note.help));
        }
        verified(ui, context);
        let step = numbers::duration(frame.step_wall_s);
        item(ui, "step", &step, 58.0, 0.0, "Computing time of the last Δt");
        let drawing = numbers::duration(pace.frame_s);
        item(ui, "frame", &drawing, 58.0, 0.0, "Time that the window last took to draw");
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| version(ui, context));
    });
}

/// Something to be known of bodies, in full and for where there is little room.
struct Note {
    long: String,
    short: String,
    color: egui::Color32,
    help: String,
}

/// What the notes take with the space behind each, points.
fn width_of(ui: &Ui, notes: &[Note], text: impl Fn(&Note) -> &String) -> f32 {
    notes.iter().map(|note| small_width(ui, text(note))).sum()
}

/// What a small text takes with the space behind it, points.
fn small_width(ui: &Ui, text: &str) -> f32 {
    let font = egui::TextStyle::Small.resolve(ui.style());
    let color = ui.visuals().text_color();
    ui.fonts_mut(|fonts| fonts.layout_no_wrap(text.to_owned(), font, color).size().x) + SPACING
}

/// How many bodies are stepped, while there are any.
fn stepped(context: &AppContext<'_>) -> Option<Note> {
    let stepped = context.session.frame().stepped?;
    let (count, since) = (stepped.count, numbers::significant(stepped.since, 3));
    let count_text = numbers::count(count as u64);
    Some(Note {
        long: format!("{count_text} {} stepped since {since} s", bodies_word(count)),
        short: format!("{count_text} stepped"),
        color: color32(context.palette().stepped),
        help: format!(
            "Bodies that touch too often for single events go on in steps of {}, marked by diamonds in the views",
            numbers::duration(stepped.step)
        ),
    })
}

/// How many bodies have left the map, while there are any: where they are nobody may be looking.
fn outside(ui: &Ui, context: &AppContext<'_>) -> Option<Note> {
    let (scene, frame) = (context.session.scene()?, context.session.frame());
    let count = frame.bodies.iter().filter(|body| !scene.map.contains(body.position)).count();
    let count_text = numbers::count(count as u64);
    (count > 0).then(|| Note {
        long: format!("{count_text} outside the map"),
        short: format!("{count_text} outside"),
        color: tones(ui).warning,
        help: "Bodies whose centres have left the map. It holds nobody: only walls do.".into(),
    })
}

/// Whether the run of a recording that was opened is the recorded one.
fn verified(ui: &mut Ui, context: &AppContext<'_>) {
    let Some(verified) = context.session.verified() else { return };
    let tones = tones(ui);
    let (text, color, help) = match verified {
        Verified::Part(part) => {
            let text = format!("comparing {:.0} %", 100.0 * part);
            (
                text,
                tones.weak,
                "The recording is run again a second time and compared with what it holds".into(),
            )
        }
        Verified::Same(help) => ("as recorded".to_owned(), tones.good, help),
        Verified::Differs(help) => ("not as recorded".to_owned(), tones.error, help),
        Verified::Unknown(help) => ("not compared".to_owned(), tones.warning, help),
    };
    let is_going_on = text.starts_with("comparing");
    ui.label(RichText::new(text).small().color(color)).on_hover_text(help);
    if is_going_on && ui.small_button("Stop").on_hover_text("Gives the comparison up").clicked() {
        context.outbox.act(Action::StopVerification);
    }
}

/// Between two things, points.
const SPACING: f32 = 5.0;

/// What the comparison with a recording takes at most, points.
const VERIFIED: f32 = 150.0;

/// What the times of the last Δt and of drawing take, points.
const STEP_AND_FRAME: f32 = 200.0;

fn bodies_word(count: usize) -> &'static str {
    if count == 1 { "body" } else { "bodies" }
}

/// The format that saving writes, and why.
fn version(ui: &mut Ui, context: &AppContext<'_>) {
    if context.shown.is_none() || ui.available_width() < 90.0 {
        return;
    }
    let reasons = context.session.document().reasons_for_1_1();
    let written = context.session.document().written_version().unwrap_or_else(|| "1.0".to_owned());
    let help = if reasons.is_empty() {
        "The file uses nothing that readers of PolyPhysicsXml 1.0 do not know".to_owned()
    } else {
        format!("The file is PolyPhysicsXml 1.1 because of {}", reasons.join(", "))
    };
    ui.label(RichText::new(format!("Version {written}")).small().color(tones(ui).weak)).on_hover_text(help);
}

/// Room for the name of a number, points.
const NAME_WIDTH: f32 = 40.0;

/// What the errors take, which matter more than what stands before them, points.
const BADGE: f32 = 400.0;

/// A number with its name, where there is room for it and for what comes `behind`.
fn item(ui: &mut Ui, name: &str, value: &str, width: f32, behind: f32, help: &str) {
    if ui.available_width() < width + NAME_WIDTH + behind {
        return;
    }
    let weak = tones(ui).weak;
    let response = ui
        .scope(|ui| {
            ui.label(RichText::new(name).small().color(weak));
            // numbers stay in their places; one that is too long takes the room it needs
            let font = egui::FontId::monospace(11.5);
            let wanted = ui.fonts_mut(|fonts| fonts.layout_no_wrap(value.to_owned(), font, weak).size().x);
            let width = width.max(wanted + 6.0);
            let (rect, _) = ui.allocate_exact_size(egui::vec2(width, 16.0), egui::Sense::hover());
            let mut inner = ui.new_child(
                egui::UiBuilder::new()
                    .max_rect(rect)
                    .layout(egui::Layout::left_to_right(egui::Align::Center)),
            );
            inner.label(mono(value).size(11.5));
        })
        .response;
    response.on_hover_text(help);
}

fn step_text(frame: &Frame) -> String {
    match frame.open_step {
        Some((from, to)) if to > from => {
            format!("{} ({:.0} %)", frame.dt_index, 100.0 * (frame.time - from) / (to - from))
        }
        _ => numbers::count(frame.dt_index),
    }
}

fn event_text(frame: &Frame) -> String {
    let (before, ledger) = (frame.event_count - frame.events.len() as u64, &frame.ledger);
    let count = numbers::count(frame.events.len() as u64);
    match frame.open_step {
        None => format!("{count} of {count}"),
        Some((_, end)) if end < frame.recorded.to => {
            let last = ledger.first() + ledger.count_until(end) as u64 - 1;
            format!("{count} of {}", numbers::count(last.saturating_sub(before)))
        }
        Some(_) => count,
    }
}

fn body_text(frame: &Frame) -> String {
    format!("{}+{}", frame.plan.dynamic_bodies, frame.plan.static_bodies)
}
