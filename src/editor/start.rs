//! A session begins: with an empty scene, and a question when an earlier run left unsaved work.

use super::kept::Kept;
use super::open_document::{OpenDocument, OpenFile};
use super::run::Run;
use super::talk::Talk;
use super::travel::Travel;
use super::{Playback, Selection, Session, Storage};
use crate::record::Runner;
use crate::scene::{Document, NumberStyle};

impl Session {
    /// A new, empty scene; nothing is kept on the disk but what the user saves.
    pub fn new(runner: Box<dyn Runner>) -> Self {
        Self::with_storage(runner, Storage::default())
    }

    /// A new, empty scene, with settings and recovery files in the folders given. Asks for what to do
    /// with unsaved work of an earlier run.
    pub fn with_storage(runner: Box<dyn Runner>, storage: Storage) -> Self {
        let kept = Kept::in_storage(storage);
        let mut playback = Playback::default();
        if let Some(dt) = &kept.settings.dt {
            // a Δt that is no longer accepted leaves the default
            let _ = playback.set_dt(dt);
        }
        let document = Document::new(NumberStyle::Point);
        let mut session = Self {
            doc: OpenDocument::new(document, OpenFile::untitled("Untitled"), true),
            run: Run::new(runner, playback),
            selection: Selection::default(),
            travel: Travel::default(),
            talk: Talk::default(),
            kept,
        };
        if let Some(bytes) = session.kept.settings.recording_bytes {
            session.run.set_memory(bytes);
        }
        session.offer_recovery();
        session.sync();
        session
    }
}
