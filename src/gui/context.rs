//! What panels see, and how they answer: everything read-only, messages up.

use std::cell::RefCell;
use std::path::PathBuf;
use std::sync::Arc;

use glam::DVec3;
use rustc_hash::FxHashMap;

use super::accuracy::Export;
use crate::editor::{Action, Command, ExportedFile, Session};
use crate::scene::{Body, Force, NodeKey, Scene};
use crate::view;

/// What a panel asks for.
#[derive(Debug)]
pub enum Message {
    /// To the session.
    Do(Action),
    /// To the session, the views or the window.
    Command(Command),
    /// To the views.
    Frame(Vec<NodeKey>),
    FramePlace(DVec3),
    /// Opens the name field of a row of the scene tree.
    Rename(NodeKey),
    ShowProblems,
    ShowEvents,
    OverlaysInAllViews(view::OverlaySet),
    /// A short message, as a toast.
    Tell(String),
    /// As [`Self::Tell`], for what was refused.
    Warn(String),
    /// Asks where figures or diagrams of a study should go.
    AskExport {
        export: Export,
        file_name: String,
    },
    /// Asks where a file that was made should go.
    AskWhere {
        title: &'static str,
        file: ExportedFile,
        file_name: String,
    },
    /// Writes figures or diagrams of a study there.
    Export(Export, PathBuf),
}

/// Collects messages during a turn of the window.
#[derive(Default)]
pub struct Outbox(RefCell<Vec<Message>>);

impl Outbox {
    pub fn send(&self, message: Message) {
        self.0.borrow_mut().push(message);
    }

    pub fn act(&self, action: Action) {
        self.send(Message::Do(action));
    }

    pub fn command(&self, command: impl Into<Command>) {
        self.send(Message::Command(command.into()));
    }

    pub fn take(&self) -> Vec<Message> {
        self.0.take()
    }
}

/// Where a key is found in the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Item {
    Body(usize),
    Force(usize),
}

/// The scene of one state of the document, with what is looked up in it often.
pub struct Shown {
    pub scene: Arc<Scene>,
    /// Differs for every scene shown.
    pub revision: u64,
    items: FxHashMap<NodeKey, Item>,
    /// For each body: how many dynamic ones are before it in the file. Gives it its colour.
    nth_dynamic: Vec<usize>,
}

impl Shown {
    pub fn new(scene: Arc<Scene>, revision: u64) -> Self {
        let bodies = scene.bodies.iter().enumerate().map(|(i, body)| (body.key, Item::Body(i)));
        let forces = scene.forces.iter().enumerate().map(|(i, force)| (force.key, Item::Force(i)));
        let items = bodies.chain(forces).collect();
        let mut dynamic = 0;
        let nth_dynamic = scene
            .bodies
            .iter()
            .map(|body| {
                let nth = dynamic;
                dynamic += usize::from(body.is_dynamic());
                nth
            })
            .collect();
        Self { scene, revision, items, nth_dynamic }
    }

    pub fn item(&self, key: NodeKey) -> Option<Item> {
        self.items.get(&key).copied()
    }

    pub fn body(&self, key: NodeKey) -> Option<&Body> {
        match self.item(key)? {
            Item::Body(index) => self.scene.bodies.get(index),
            Item::Force(_) => None,
        }
    }

    pub fn force(&self, key: NodeKey) -> Option<&Force> {
        match self.item(key)? {
            Item::Force(index) => self.scene.forces.get(index),
            Item::Body(_) => None,
        }
    }

    /// What to call a body or force.
    pub fn name(&self, key: NodeKey) -> Option<&str> {
        let force = || self.force(key).map(Force::display_name);
        self.body(key).map(Body::display_name).or_else(force)
    }

    /// As the views draw it.
    pub fn color(&self, key: NodeKey, palette: &view::Palette) -> Option<view::Color> {
        match self.item(key)? {
            Item::Body(index) => {
                let nth = self.nth_dynamic.get(index).copied().unwrap_or(0);
                Some(view::body_color(self.scene.bodies.get(index)?, nth, palette))
            }
            Item::Force(_) => Some(palette.force),
        }
    }
}

/// Everything a panel may look at.
#[derive(Clone, Copy)]
pub struct AppContext<'a> {
    pub session: &'a Session,
    /// `None` while the document has errors that leave no scene.
    pub shown: Option<&'a Shown>,
    pub theme: view::Theme,
    pub outbox: &'a Outbox,
}

impl<'a> AppContext<'a> {
    pub fn scene(&self) -> Option<&'a Scene> {
        self.shown.map(|shown| &*shown.scene)
    }

    pub fn palette(&self) -> &'static view::Palette {
        self.theme.palette()
    }
}
