//! Scenes of other programs, MJCF and SDF: spheres, planes, boxes that stand still, and gravity. What else a file says is
//! listed with its line; what moving bodies cannot be here is an error, with the way out.

mod assemble;
mod log;
mod mjcf;
mod mjcf_contact;
mod mjcf_defaults;
mod piece;
mod sdf;
mod values;

pub use log::{ImportLine, ImportReport};

use crate::scene::{Diagnostic, Document};
use log::Log;
use piece::World;

/// A kind of file that can be imported.
#[derive(Debug)]
pub struct Source {
    /// Name of the root element, by which it is known.
    pub root: &'static str,
    pub name: &'static str,
    /// Usual endings of its files.
    pub extensions: &'static [&'static str],
    read: fn(crate::scene::XmlElement<'_>, &mut Log) -> World,
}

/// All of them.
pub const SOURCES: &[Source] = &[
    Source { root: "mujoco", name: "MuJoCo (MJCF)", extensions: &["xml", "mjcf"], read: mjcf::read },
    Source { root: "sdf", name: "Gazebo (SDF)", extensions: &["sdf", "world"], read: sdf::read },
];

/// What became of a file.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The scene, unless there are errors.
    pub document: Option<Document>,
    pub report: ImportReport,
    /// Errors, in the order of their places.
    pub problems: Vec<Diagnostic>,
    /// Labels of the scene's bodies, and where in the file they come from.
    origins: Vec<(String, Option<(u32, u32)>)>,
}

impl Imported {
    /// A problem of the scene that came of the file, at the place of its body in the file instead of in the scene.
    pub fn in_the_file(&self, mut problem: Diagnostic) -> Diagnostic {
        let scene = self.document.as_ref().and_then(Document::scene);
        let body = scene.and_then(|scene| scene.bodies.iter().find(|body| Some(body.key) == problem.key));
        let origin = body.and_then(|body| self.origins.iter().find(|(label, _)| *label == body.label));
        problem.position = origin.and_then(|(_, position)| *position);
        if problem.position.is_some() {
            problem.path.clear();
        }
        problem
    }
}

/// The kind of file that a document is, unless it is a scene already or anything else.
pub fn source_of(document: &Document) -> Option<&'static Source> {
    let root = document.xml_root()?;
    SOURCES.iter().find(|source| source.root == root.name())
}

/// Reads a file of another program, given as a document of its bytes. With `leave_out` things that cannot be here are
/// dropped instead of being errors.
pub fn import(document: &Document, leave_out: bool) -> Imported {
    let mut log = Log::new(leave_out);
    let Some((root, source)) = document.xml_root().zip(source_of(document)) else {
        let (report, problems) = (ImportReport::default(), unknown(document));
        return Imported { document: None, report, problems, origins: Vec::new() };
    };
    let world = (source.read)(root, &mut log);
    let (scene, origins) = assemble::scene(world, &mut log);
    let labels = scene.bodies.iter().map(|body| body.label.to_string());
    let origins = labels.zip(origins).collect();
    let (report, mut problems) = log.into_parts();
    let document = match Document::of_scene(&scene, crate::scene::NumberStyle::Point) {
        Ok(document) if problems.is_empty() => Some(document),
        Ok(_) => None,
        Err(error) => {
            problems.push(log::error(None, error.to_string(), ""));
            None
        }
    };
    Imported { document, report, problems, origins }
}

fn unknown(document: &Document) -> Vec<Diagnostic> {
    match document.xml_root() {
        Some(root) => {
            let known: Vec<_> = SOURCES.iter().map(|source| format!("<{}>", source.root)).collect();
            let message = format!("the root element <{}> is none that can be imported", root.name());
            vec![log::error(root.position(), message, &format!("it should be one of {}", known.join(", ")))]
        }
        None => document.diagnostics().to_vec(),
    }
}
