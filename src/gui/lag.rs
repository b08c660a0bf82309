//! What the transport says while playing falls behind: how far, what the time goes to, and what helps.

use egui::{RichText, Ui};

use super::colors::tones;
use super::context::AppContext;
use super::numbers::{count, duration, significant};
use crate::editor::{Action, Place, SessionCommand};
use crate::record::{Busiest, Frame, Lag, LagCause};
use crate::scene::NodeKey;

/// A menu whose title says how far playing falls behind. `slower` is a speed that can be reached, with its name.
pub fn show(ui: &mut Ui, context: &AppContext<'_>, lag: &Lag, slower: Option<(f64, &str)>) {
    let title = RichText::new(title(context, lag)).color(tones(ui).warning);
    let why = why(context, lag);
    let menu = ui.menu_button(title, |ui| {
        ui.set_max_width(340.0);
        ui.label(&why);
        ui.label(RichText::new(what_helps(lag)).color(tones(ui).weak));
        ui.separator();
        if ui.button("Pause").clicked() {
            context.outbox.command(SessionCommand::PlayPause);
            ui.close();
        }
        if let Some((speed, name)) = slower
            && ui.button(format!("Play at {name}")).clicked()
        {
            context.outbox.act(Action::SetSpeed(speed));
            ui.close();
        }
        if setting(lag).is_some() && ui.button("Show the settings of the simulation").clicked() {
            context.outbox.act(Action::SelectPlace(Place::Simulation));
            ui.close();
        }
    });
    menu.response.on_hover_text(why);
}

fn title(context: &AppContext<'_>, lag: &Lag) -> String {
    let time_speed = context.scene().map_or(1.0, |scene| scene.time_speed);
    let is_real_time = context.session.playback().speed() * time_speed == 1.0;
    let of = if is_real_time { "real time" } else { "the speed set" };
    format!("plays at {} of {of}", significant(lag.share, 2))
}

fn why(context: &AppContext<'_>, lag: &Lag) -> String {
    let name = |key: NodeKey| context.shown.and_then(|shown| shown.name(key)).unwrap_or("a body").to_owned();
    match lag.cause {
        LagCause::Stepped { bodies } => {
            let step = step(context.session.frame());
            format!("Most of the time goes to {} that are stepped together{step}.", bodies_text(bodies))
        }
        LagCause::Events { per_model_s, busiest } => {
            let events = format!(
                "Most of the time goes to events: {} per second of model time",
                significant(per_model_s, 3)
            );
            match busiest {
                Some(Busiest { a, b, share }) => {
                    let of = b.map_or_else(
                        || format!("of {}", name(a)),
                        |b| format!("between {} and {}", name(a), name(b)),
                    );
                    format!("{events}, of which {:.0} % {of} in this Δt.", 100.0 * share)
                }
                None => format!("{events}."),
            }
        }
        LagCause::Field { body: Some(body) } => {
            format!(
                "Most of the time goes to integrating the motion in fields, of {} most of all.",
                name(body)
            )
        }
        LagCause::Field { body: None } => {
            "Most of the time goes to integrating the motion in fields.".to_owned()
        }
    }
}

fn bodies_text(bodies: usize) -> String {
    match bodies {
        0 => "bodies".to_owned(),
        1 => "one body".to_owned(),
        more => format!("{} bodies", count(more as u64)),
    }
}

fn step(frame: &Frame) -> String {
    frame.stepped.map_or(String::new(), |stepped| format!(", every {} of model time", duration(stepped.step)))
}

fn what_helps(lag: &Lag) -> String {
    let always = "Nothing is left out: it only takes longer.";
    match setting(lag) {
        Some(setting) => {
            format!("{always} A larger {setting} is quicker and less exact; it takes hold at a reset.")
        }
        None => format!("{always} A lower speed shows it evenly."),
    }
}

/// The setting of the simulation that trades exactness for speed here.
fn setting(lag: &Lag) -> Option<&'static str> {
    match lag.cause {
        LagCause::Stepped { .. } => Some("Dense step"),
        LagCause::Field { .. } => Some("Field tolerance"),
        LagCause::Events { .. } => None,
    }
}
