//! The editor's window: panels and views in egui, over the layers `editor`, `view` and `render`.
//! Panels get a read-only `AppContext` and send messages up; [`App`] carries them out.

mod accuracy;
mod app;
mod background;
mod badge;
mod bench;
mod bench_play;
mod colors;
mod context;
mod dialogs;
mod dock;
mod error;
mod icons;
mod inspector;
mod lag;
mod launch;
mod ledger;
mod menu;
mod numbers;
mod panels;
mod pictures;
mod problems;
mod shortcuts;
mod start;
mod status;
mod steps;
mod still;
mod theme;
mod timeline;
mod toasts;
mod transport;
mod tree;
mod viewport;
mod widgets;
mod xml;

pub use app::{App, Parts};
pub use dialogs::{FileAnswer, FileDialogs, FileRequest, NoFileDialogs};
pub use error::GuiError;
pub use launch::{Options, Report, run};
