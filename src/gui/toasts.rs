//! Short messages in the corner. They are widgets with names, and an idle window stays idle: the next
//! repaint is asked for when the next message goes.

use std::time::{Duration, Instant};

use egui::{Align2, RichText, Ui};

use super::widgets::severity_icon;
use crate::editor::{Notice, NoticeLevel};

/// Most messages shown at once; older ones go first.
const MOST: usize = 4;

#[derive(Default)]
pub struct Toasts {
    toasts: Vec<Toast>,
}

struct Toast {
    notice: Notice,
    until: Instant,
}

impl Toasts {
    pub fn add(&mut self, notice: Notice) {
        let time = match notice.level {
            NoticeLevel::Info => 4,
            NoticeLevel::Warning => 8,
            NoticeLevel::Error => 15,
        };
        self.toasts.retain(|toast| toast.notice != notice);
        self.toasts.push(Toast { notice, until: Instant::now() + Duration::from_secs(time) });
        let too_many = self.toasts.len().saturating_sub(MOST);
        self.toasts.drain(..too_many);
    }

    /// Above the status bar at the right.
    pub fn show(&mut self, ctx: &egui::Context) {
        let now = Instant::now();
        self.toasts.retain(|toast| toast.until > now);
        let Some(next) = self.toasts.iter().map(|toast| toast.until).min() else { return };
        ctx.request_repaint_after(next.saturating_duration_since(now) + Duration::from_millis(20));
        let mut closed = None;
        egui::Area::new(egui::Id::unique("toasts"))
            .anchor(Align2::RIGHT_BOTTOM, [-12.0, -36.0])
            .order(egui::Order::Foreground)
            .show(ctx, |ui| {
                for (index, toast) in self.toasts.iter().enumerate() {
                    if show_one(ui, &toast.notice) {
                        closed = Some(index);
                    }
                }
            });
        if let Some(index) = closed {
            self.toasts.remove(index);
        }
    }
}

/// Whether it was closed.
fn show_one(ui: &mut Ui, notice: &Notice) -> bool {
    let frame = egui::Frame::popup(ui.style()).inner_margin(egui::Margin::symmetric(10, 6));
    frame
        .show(ui, |ui| {
            ui.horizontal(|ui| {
                if notice.level > NoticeLevel::Info {
                    severity_icon(ui, notice.level == NoticeLevel::Error);
                }
                ui.scope(|ui| {
                    ui.set_max_width(420.0);
                    ui.label(RichText::new(&notice.text));
                });
                ui.small_button("×").on_hover_text("Close").clicked()
            })
            .inner
        })
        .inner
}
