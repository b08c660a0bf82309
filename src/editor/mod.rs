//! One user's work: the document with undo, selection, playback, commands, files, recovery.
//! Knows no widgets and no OpenGL. [`Session`] holds it all; panels read it and send it [`Action`]s.

mod action;
mod building;
mod catalog;
mod claim;
mod clipboard;
mod command;
mod command_info;
mod copies;
mod creation;
mod dialogue;
mod disk;
mod disk_watch;
mod drag;
mod edits;
mod execute;
mod exporting;
mod expression;
mod fields;
mod files;
mod history;
mod kept;
mod label;
mod live;
mod moving;
mod notice;
mod open_document;
mod palette;
mod path_text;
mod playback;
mod problems;
mod recording;
mod recovered;
mod recovery;
mod reloading;
mod run;
mod safekeeping;
mod samples;
mod scene_changes;
mod selection;
mod session;
mod settings;
mod start;
mod sync;
mod talk;
mod text;
mod text_diff;
mod travel;
mod trouble_list;

pub use action::Action;
pub use catalog::{COMMANDS, info};
pub use command::{
    Addition, Command, Key, Menu, Outcome, SessionCommand, Shortcut, TravelCommand, ViewCommand,
    WindowCommand,
};
pub use command_info::CommandInfo;
pub use dialogue::{Answer, Intent, Question, Request};
pub use drag::Drag;
pub use exporting::ExportedFile;
pub use expression::{Typed, parse_angle, parse_number};
pub use fields::{BODY_FIELDS, FORCE_FIELDS, Field, SCENE_FIELDS, Shared, allows, limits, shared};
pub use history::Gesture;
pub use live::needs_reset;
pub use notice::{Notice, NoticeLevel};
pub use palette::{PaletteEntry, palette};
pub use playback::Playback;
pub use problems::{Fix, Problem, ProblemSource};
pub use recovered::Recovered;
pub use safekeeping::INTERVAL as RECOVERY_INTERVAL;
pub use samples::{SAMPLES, Sample, SampleGroup};
pub use selection::{Place, Selection};
pub use session::Session;
pub use settings::{EditorSettings, Storage};
pub use text::DocumentText;
pub use text_diff::{DiffLine, diff};
pub use travel::{Bookmark, Travel};
