//! The lossless document: a scene file in memory, its meaning and its bytes.

use std::borrow::Cow;
use std::fmt;
use std::fs::File;
use std::io::{self, Read};
use std::ops::Range;
use std::path::Path;
use std::sync::{Arc, OnceLock};

use glam::DVec3;

use super::encoding::{self, Encoding, Form};
use super::locate::Index;
use super::read::{self, Meaning};
use super::rules::MAX_FILE_BYTES;
use super::source::{Source, position_in};
use super::tree::{Child, Children, Keys, View, tag};
use super::viewpoint::{self, Viewpoint};
use super::{Diagnostic, NodeKey, NumberStyle, Scene, Severity, locate, parse, save, shown, write};

/// A scene file in memory. Immutable: an edit gives a new document that shares what did not change,
/// so undo keeps the old one. Saving writes back the very bytes of everything not edited.
///
/// Cloning is cheap. Positions in diagnostics are those of the file as it was read.
#[derive(Clone)]
pub struct Document {
    pub(super) source: Arc<Source>,
    /// Written when first asked for.
    pub(super) content: OnceLock<Content>,
    /// What is to be written, and into what.
    pub(super) unwritten: Option<Arc<Unwritten>>,
    /// Read when first asked for.
    pub(super) meaning: OnceLock<Arc<Meaning>>,
    /// Where bodies and forces stand; made when first needed.
    pub(super) index: OnceLock<Arc<Index>>,
}

#[derive(Clone)]
pub(super) enum Content {
    Tree(Children),
    /// Bytes that are no well-formed XML, kept as they are, and what is wrong with them.
    Broken(Arc<[u8]>),
}

/// Bodies that were moved since a document was written.
pub(super) struct Unwritten {
    pub before: Document,
    pub moves: Vec<Move>,
    /// Writes them into the tree of that document.
    pub write: fn(&Document, &[Move]) -> Content,
}

/// A body's new numbers, as far as they are others.
#[derive(Clone, Copy)]
pub(super) struct Move {
    pub key: NodeKey,
    /// m.
    pub position: Option<DVec3>,
    /// rad.
    pub rotation: Option<DVec3>,
    /// m/s.
    pub velocity: Option<DVec3>,
}

impl Document {
    /// An empty scene: a 10×10×10 m map of 10×10×10 tiles, no bodies, no forces.
    pub fn new(style: NumberStyle) -> Self {
        Self::from_bytes(write::new_file(style).as_bytes())
    }

    /// Reads a file's bytes, whatever they are. Never panics; every problem becomes a [`Diagnostic`].
    pub fn from_bytes(bytes: &[u8]) -> Self {
        Self::from_bytes_with_keys(bytes.into(), Arc::new(Keys::starting_at(1)))
    }

    /// As [`Self::from_bytes`], without a copy of bytes that are the text already, in UTF-8.
    pub fn from_vec(mut bytes: Vec<u8>) -> Self {
        bytes.shrink_to_fit();
        Self::from_bytes_with_keys(bytes.into(), Arc::new(Keys::starting_at(1)))
    }

    /// As [`Self::from_bytes`], with keys that another document has not used.
    pub(super) fn from_bytes_with_keys(mut bytes: Cow<'_, [u8]>, keys: Arc<Keys>) -> Self {
        if bytes.len() as u64 > MAX_FILE_BYTES {
            let message = format!("the file is larger than {} MiB", MAX_FILE_BYTES / (1024 * 1024));
            return Self::broken(&[], unreadable(message, "divide the scene"));
        }
        let decoded = match encoding::decode(&mut bytes) {
            Ok(decoded) => decoded,
            Err(fault) => {
                let position = Some(position_in(&fault.before, fault.before.len()));
                return Self::broken(
                    &bytes,
                    Diagnostic { position, ..unreadable(fault.message, &fault.hint) },
                );
            }
        };
        drop(bytes);
        let source = Source::new(decoded.text, decoded.encoding, decoded.contradiction, keys);
        match parse::document(&source.text, &source.keys) {
            Ok(tree) => Self::of_tree(Arc::new(source), tree),
            Err(fault) => {
                let (position, path) = (Some(source.position(fault.at)), fault.path);
                let diagnostic = Diagnostic { position, path, ..unreadable(fault.message, &fault.hint) };
                Self::broken(&encoding::encode(&source.text, source.encoding), diagnostic)
            }
        }
    }

    /// Reads a file. A file that cannot be read gives a diagnostic without a position.
    pub fn open(path: &Path) -> Self {
        match read_file(path) {
            Ok(bytes) => Self::from_vec(bytes),
            Err(err) => Self::broken(&[], unreadable(format!("the file cannot be read: {err}"), "")),
        }
    }

    /// What the document means; `None` if it has errors that leave no scene to work with.
    pub fn scene(&self) -> Option<&Scene> {
        self.meaning().scene.as_deref()
    }

    /// The scene, to be held longer than the document.
    pub fn scene_shared(&self) -> Option<Arc<Scene>> {
        self.meaning().scene.clone()
    }

    /// All problems, in the order of their places.
    pub fn diagnostics(&self) -> &[Diagnostic] {
        &self.meaning().diagnostics
    }

    /// Whether any diagnostic is an error.
    pub fn has_errors(&self) -> bool {
        self.diagnostics().iter().any(Diagnostic::is_error)
    }

    /// Line and column (1-based) and element path, for diagnostics that other layers make.
    pub fn place_of(&self, key: NodeKey) -> (Option<(u32, u32)>, String) {
        let chain = self.chain(key);
        let position = chain.last().and_then(|el| el.place()).map(|at| self.source.position(at as usize));
        let label = self.scene().and_then(|scene| locate::label_of(scene, key));
        let mut path = chain.iter().map(|el| format!("/{}", shown(el.name()))).collect::<String>();
        if let Some(label) = label {
            path.push_str(&format!("[{label}]"));
        }
        (position, path)
    }

    /// Why the file is Version 1.1: the new physics it uses, such as `SpaceAverse`. Empty for 1.0.
    pub fn reasons_for_1_1(&self) -> Vec<String> {
        self.meaning().features.used().map(|(name, ..)| name.to_owned()).collect()
    }

    /// The version of the format as the file writes it; `None` where it writes none.
    pub fn written_version(&self) -> Option<String> {
        let Content::Tree(top) = self.of_same_structure().content() else { return None };
        let root = locate::root(top, &self.source.text)?;
        Some(root.value("Version")?.trim().to_owned())
    }

    /// The viewpoints saved with the scene, in the order in which they were saved.
    pub fn viewpoints(&self) -> Vec<Viewpoint> {
        let Content::Tree(top) = self.of_same_structure().content() else { return Vec::new() };
        let root = locate::root(top, &self.source.text);
        let written = root.and_then(|root| {
            let instruction = root.raws().find(|raw| read::is_cosmetic(raw))?;
            quick_xml::escape::unescape(tag::find(instruction, viewpoint::ATTRIBUTE)?.raw).ok()
        });
        written.map(|text| viewpoint::read(&text)).unwrap_or_default()
    }

    /// The file's bytes: in the encoding and with the line ends it came with.
    pub fn to_bytes(&self) -> Vec<u8> {
        match self.content() {
            Content::Tree(top) => {
                let text = write::children(top, &self.source.text);
                encoding::encode(&text, self.source.encoding)
            }
            Content::Broken(bytes) => bytes.to_vec(),
        }
    }

    /// The text of the file, and in it the place of each body and force in bytes, in order; without these for bytes that
    /// are no well-formed XML.
    pub fn text_with_places(&self) -> (String, Vec<(NodeKey, Range<usize>)>) {
        // Bodies and forces are those elements that have been read by themselves.
        self.meaning();
        match self.content() {
            Content::Tree(top) => write::children_with_places(top, &self.source.text),
            Content::Broken(bytes) => (String::from_utf8_lossy(bytes).into_owned(), Vec::new()),
        }
    }

    /// Writes the file atomically: temporary file beside it, sync, rename.
    pub fn save(&self, path: &Path) -> io::Result<()> {
        save::write_atomically(path, &self.to_bytes())
    }

    /// What stands outside any element, and the root.
    pub(super) fn top(&self) -> impl Iterator<Item = &Child> {
        let top = match self.content() {
            Content::Tree(top) => Some(top),
            Content::Broken(_) => None,
        };
        top.into_iter().flat_map(Children::iter)
    }

    /// What pieces of the tree were cut from.
    pub(super) fn source_text(&self) -> &str {
        &self.source.text
    }

    pub(super) fn of_tree(source: Arc<Source>, tree: Children) -> Self {
        let (meaning, index) = (OnceLock::new(), OnceLock::new());
        Self { source, content: OnceLock::from(Content::Tree(tree)), unwritten: None, meaning, index }
    }

    pub(super) fn content(&self) -> &Content {
        self.content.get_or_init(|| match &self.unwritten {
            Some(unwritten) => (unwritten.write)(&unwritten.before, &unwritten.moves),
            None => Content::Broken(Arc::default()),
        })
    }

    /// The moves that are still to be written.
    pub(super) fn unwritten(&self) -> Option<&Unwritten> {
        self.unwritten.as_deref().filter(|_| self.content.get().is_none())
    }

    /// This document, or the one that it was before moves that are still to be written: all else stands where it stood.
    fn of_same_structure(&self) -> &Self {
        self.unwritten().map_or(self, |unwritten| &unwritten.before)
    }

    /// The same document with all its moves written, which is otherwise done when its bytes are asked for.
    pub fn written(&self) -> Self {
        let content = OnceLock::from(self.content().clone());
        Self { content, unwritten: None, ..self.clone() }
    }

    /// Where bodies and forces stand.
    pub(super) fn index(&self, top: &Children) -> &Index {
        self.index.get_or_init(|| Arc::new(locate::index(top, &self.source.text)))
    }

    pub(super) fn meaning(&self) -> &Meaning {
        self.meaning.get_or_init(|| match self.content() {
            Content::Tree(top) => Arc::new(read::read(&self.source, top)),
            Content::Broken(_) => Arc::default(),
        })
    }

    /// The elements from the root down to the one with that key; empty if there is none.
    fn chain(&self, key: NodeKey) -> Vec<View<'_>> {
        let document = self.of_same_structure();
        let Content::Tree(top) = document.content() else { return Vec::new() };
        let text = &self.source.text;
        match (document.index(top).get(&key), locate::root(top, text)) {
            (Some(&(list, at)), Some(root)) => locate::item_chain(root, list, at),
            _ => locate::chain(top, text, key),
        }
    }

    /// A document of bytes that hold no tree.
    fn broken(bytes: &[u8], diagnostic: Diagnostic) -> Self {
        let encoding = Encoding { bom: false, form: Form::Utf8 };
        let meaning = Meaning { diagnostics: vec![diagnostic], ..Meaning::default() };
        Self {
            source: Arc::new(Source::new(String::new(), encoding, None, Arc::new(Keys::starting_at(1)))),
            content: OnceLock::from(Content::Broken(bytes.into())),
            unwritten: None,
            meaning: OnceLock::from(Arc::new(meaning)),
            index: OnceLock::new(),
        }
    }
}

/// A file's bytes, one more than the limit at most.
pub(super) fn read_file(path: &Path) -> io::Result<Vec<u8>> {
    let file = File::open(path)?;
    let most = MAX_FILE_BYTES + 1;
    // One more than there is to read, so that the end is seen without more room. Streams say that they are empty.
    let expected = file.metadata().map_or(0, |metadata| metadata.len().saturating_add(1));
    let mut bytes = Vec::with_capacity(expected.min(most) as usize);
    file.take(most).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// What is wrong with a file that could not be read.
fn unreadable(message: String, hint: &str) -> Diagnostic {
    let (severity, path) = (Severity::Error, String::new());
    Diagnostic { severity, position: None, path, message, hint: hint.to_owned(), key: None }
}

impl fmt::Debug for Document {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let meaning = self.meaning();
        f.debug_struct("Document")
            .field("scene", &meaning.scene)
            .field("diagnostics", &meaning.diagnostics)
            .finish_non_exhaustive()
    }
}
