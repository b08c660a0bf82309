//! What the panels of the window hold.

use egui::Ui;

use super::accuracy::Accuracy;
use super::context::AppContext;
use super::dock::{self, Panel};
use super::inspector::Inspector;
use super::ledger::LedgerPanel;
use super::problems::Problems;
use super::tree::Tree;
use super::viewport::Views;
use super::xml::XmlPane;

/// The panels, for the layout to show.
pub(super) struct Contents<'a> {
    pub context: &'a AppContext<'a>,
    /// With what a dialog is about to make.
    pub preview: &'a AppContext<'a>,
    pub tree: &'a mut Tree,
    pub inspector: &'a mut Inspector,
    pub ledger: &'a mut LedgerPanel,
    pub problems: &'a mut Problems,
    pub accuracy: &'a mut Accuracy,
    pub xml: &'a mut XmlPane,
    pub views: &'a mut Views,
    /// Around the views shown so far.
    pub area: Option<egui::Rect>,
}

impl dock::Contents for Contents<'_> {
    fn title(&self, panel: Panel) -> String {
        match panel {
            Panel::Tree => "Scene".to_owned(),
            Panel::Inspector => "Inspector".to_owned(),
            Panel::Events => LedgerPanel::title(self.context),
            Panel::Problems => self.problems.title(),
            Panel::Accuracy if self.accuracy.is_running() => "Accuracy (running)".to_owned(),
            Panel::Accuracy => "Accuracy".to_owned(),
            Panel::Xml => "XML".to_owned(),
            Panel::View(index) => self.views.title(index).to_owned(),
        }
    }

    fn show(&mut self, ui: &mut Ui, panel: Panel) -> bool {
        let framed = |ui: &mut Ui, show: &mut dyn FnMut(&mut Ui)| {
            egui::Frame::new().inner_margin(egui::Margin::symmetric(6, 2)).show(ui, |ui| {
                show(ui);
                ui.take_available_space();
            });
        };
        match panel {
            Panel::Tree => self.tree.show(ui, self.context),
            Panel::Inspector => self.inspector.show(ui, self.context),
            Panel::Events => framed(ui, &mut |ui| self.ledger.show(ui, self.context)),
            Panel::Problems => framed(ui, &mut |ui| self.problems.show(ui, self.context)),
            Panel::Accuracy => framed(ui, &mut |ui| self.accuracy.show(ui, self.context)),
            Panel::Xml => framed(ui, &mut |ui| self.xml.show(ui, self.context)),
            Panel::View(index) => {
                let rect = ui.max_rect();
                self.area = Some(self.area.map_or(rect, |area| area.union(rect)));
                return self.views.show(ui, index, self.preview);
            }
        }
        false
    }

    fn beside_tabs(&mut self, ui: &mut Ui, panel: Panel) {
        if panel == Panel::Problems {
            self.problems.show_beside_tab(ui, self.context);
        }
        if panel == Panel::Events && !self.context.session.frame().ledger.is_empty() {
            self.ledger.buttons(ui, self.context);
        }
    }
}
