//! A session begins: with an empty scene, and a question when an earlier run left unsaved work.

use super::history::History;
use super::recovery::Recovery;
use super::session::OpenFile;
use super::trouble_list::TroubleList;
use super::{EditorSettings, Playback, Selection, Session, Storage};
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
        let settings = EditorSettings::load(&storage);
        let mut playback = Playback::default();
        if let Some(dt) = &settings.dt {
            // a Δt that is no longer accepted leaves the default
            let _ = playback.set_dt(dt);
        }
        let mut session = Self {
            history: History::new(Document::new(NumberStyle::Point), true),
            file: OpenFile::untitled("Untitled"),
            selection: Selection::default(),
            playback,
            recovery: Recovery::new(&storage),
            settings,
            storage,
            notices: Vec::new(),
            question: None,
            requests: Vec::new(),
            after_save: None,
            frame: runner.frame(),
            shown_event: None,
            awaited_event: None,
            opened: 0,
            runner,
            running: None,
            unsynced: false,
            settling: None,
            last_poll: None,
            last_copies: None,
            paste_in_place: false,
            troubles: TroubleList::default(),
        };
        session.offer_recovery();
        session.sync();
        session
    }
}
