//! What the transport says of a run in which nothing can ever move: why, and what would change that.

use egui::{RichText, Ui};
use glam::DVec3;

use super::colors::tones;
use super::context::AppContext;
use crate::editor::{Addition, SessionCommand};
use crate::record::RunState;
use crate::scene::{Body, ForceKind, Motion, Scene};

/// Room for the whole title, points.
const WIDE: f32 = 560.0;

/// Why nothing moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Still {
    NoMovingBodies,
    NothingActs,
}

impl Still {
    /// `None` while something moves or will, and before the run has begun.
    pub fn of(context: &AppContext<'_>) -> Option<Self> {
        let (scene, frame) = (context.scene()?, context.session.frame());
        let has_begun = frame.time > 0.0 || matches!(frame.state, RunState::Playing | RunState::Busy);
        if !has_begun || frame.state == RunState::Faulted {
            return None;
        }
        if !scene.bodies.iter().any(Body::is_dynamic) {
            return frame.bodies.is_empty().then_some(Self::NoMovingBodies);
        }
        let moves_now = || {
            frame.bodies.iter().any(|body| {
                body.velocity != DVec3::ZERO || body.turn.is_some_and(|turn| turn.spin != DVec3::ZERO)
            })
        };
        (!is_pulled(scene) && !starts(scene) && !moves_now()).then_some(Self::NothingActs)
    }

    fn reason(self) -> &'static str {
        match self {
            Self::NoMovingBodies => "no moving bodies",
            Self::NothingActs => "no gravity, no velocities",
        }
    }
}

fn is_pulled(scene: &Scene) -> bool {
    scene.forces.iter().any(|force| match force.kind {
        ForceKind::GravityPlane { acceleration, .. } => acceleration != DVec3::ZERO,
        ForceKind::GravityPoint { intensity, .. } => intensity != 0.0,
        ForceKind::Drag { .. } => false,
    })
}

fn starts(scene: &Scene) -> bool {
    scene.bodies.iter().any(|body| match body.motion {
        Motion::Dynamic { velocity, .. } => velocity != DVec3::ZERO || body.spin != DVec3::ZERO,
        Motion::Static => false,
    })
}

/// A menu whose title says that nothing moves and why.
pub fn show(ui: &mut Ui, context: &AppContext<'_>, still: Still) {
    let reason = still.reason();
    let short = ui.available_width() < WIDE;
    let title = if short { "nothing moves".to_owned() } else { format!("nothing moves: {reason}") };
    let menu = ui.menu_button(RichText::new(title).color(tones(ui).warning), |ui| {
        ui.set_max_width(300.0);
        ui.label(format!("Nothing moves: {reason}."));
        let (label, help, addition) = match still {
            Still::NothingActs => {
                ("Add gravity", "Adds 9.81 m/s² downwards and starts again", Addition::GravityPlane)
            }
            Still::NoMovingBodies => (
                "Add a dynamic sphere",
                "Adds a sphere that forces and collisions move, and starts again",
                Addition::SphereDynamic,
            ),
        };
        if ui.button(label).on_hover_text(help).clicked() {
            context.outbox.command(SessionCommand::Add(addition));
            // Nothing has moved: starting again loses nothing.
            context.outbox.command(SessionCommand::Reset);
            if context.session.frame().state == RunState::Playing {
                context.outbox.command(SessionCommand::PlayPause);
            }
            ui.close();
        }
        if still == Still::NothingActs {
            ui.label(RichText::new("Or give a body a velocity in the inspector.").color(tones(ui).weak));
        }
    });
    menu.response.on_hover_text(format!("Nothing moves: {reason}. A click says what helps."));
}
