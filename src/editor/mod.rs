//! One user's work: the document with undo, selection, playback, commands, files, recovery.
//! Knows no widgets and no OpenGL. [`Session`] holds it all; panels read it and send it [`Action`]s.

mod action;
mod catalog;
mod clipboard;
mod command;
mod creation;
mod dialogue;
mod disk;
mod drag;
mod edits;
mod execute;
mod expression;
mod fields;
mod files;
mod history;
mod label;
mod live;
mod notice;
mod palette;
mod path_text;
mod playback;
mod problems;
mod recovery;
mod samples;
mod selection;
mod session;
mod settings;

pub use action::Action;
pub use catalog::COMMANDS;
pub use command::{Command, CommandInfo, Key, Menu, Outcome, Shortcut, info};
pub use dialogue::{Answer, Intent, Question, Request};
pub use drag::Drag;
pub use expression::{parse_angle, parse_number};
pub use fields::{BODY_FIELDS, FORCE_FIELDS, Field, SCENE_FIELDS, Shared, allows, limits, shared};
pub use history::Gesture;
pub use live::needs_reset;
pub use notice::{Notice, NoticeLevel};
pub use palette::{PaletteEntry, palette};
pub use playback::Playback;
pub use problems::{Problem, ProblemSource};
pub use recovery::Recovered;
pub use samples::{SAMPLES, Sample, SampleGroup};
pub use selection::{Place, Selection};
pub use session::Session;
pub use settings::{Settings, Storage};
