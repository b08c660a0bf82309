//! Reading a scene and collecting everything that is wrong with it.

use std::io::Read as _;
use std::path::Path;

use super::CliError;
use crate::record::RecordingFile;
use crate::scene::{Diagnostic, Document, FileStamp, Severity, shown_path};
use crate::sim::{CompileError, Method, Simulation};

/// A scene file is at most 256 MiB; one byte more is enough for the reader to say so.
const STDIN_LIMIT: u64 = (256 << 20) + 1;

/// A document, the simulation it starts (unless it has errors), and all problems in order of place.
pub struct Examined {
    pub document: Document,
    pub simulation: Option<Simulation>,
    pub problems: Vec<Diagnostic>,
}

/// The simulation that a document starts (unless it has errors), and all problems in order of place.
pub(super) struct Begun {
    pub simulation: Option<Simulation>,
    pub problems: Vec<Diagnostic>,
}

impl Examined {
    /// How many problems are errors.
    pub fn error_count(&self) -> usize {
        error_count(&self.problems)
    }

    /// The problems as `file:line:column: severity: message (path); hint`, one line each.
    pub fn lines(&self, file: &str) -> Vec<String> {
        lines(file, &self.problems)
    }
}

/// How many problems are errors.
pub(super) fn error_count(problems: &[Diagnostic]) -> usize {
    problems.iter().filter(|problem| problem.is_error()).count()
}

/// The problems as `file:line:column: severity: message (path); hint`, one line each.
pub(super) fn lines(file: &str, problems: &[Diagnostic]) -> Vec<String> {
    problems.iter().map(|problem| problem_line(file, problem)).collect()
}

/// Reads a file, or standard input for `-`, and examines it. The simulation steps by `method`.
pub fn open(path: &Path, method: Method) -> Result<Examined, CliError> {
    Ok(examine(read(path)?, method))
}

/// Reads a file, or standard input for `-`.
pub(super) fn read(path: &Path) -> Result<Document, CliError> {
    if path.as_os_str() != "-" {
        return Ok(Document::open(path));
    }
    let mut bytes = Vec::new();
    std::io::stdin()
        .lock()
        .take(STDIN_LIMIT)
        .read_to_end(&mut bytes)
        .map_err(|error| CliError::Usage(format!("cannot read standard input: {error}")))?;
    Ok(Document::from_vec(bytes))
}

/// What to call a scene file in messages.
pub fn display_name(path: &Path) -> String {
    if path.as_os_str() == "-" { "<stdin>".into() } else { shown_path(path) }
}

/// Finds all problems: of the text, of what it means, and of the geometry at the start. The simulation steps
/// by `method`.
pub fn examine(document: Document, method: Method) -> Examined {
    if is_recording(&document) {
        return Examined { document, simulation: None, problems: vec![recording_for_a_scene()] };
    }
    let mut problems = document.diagnostics().to_vec();
    let mut simulation = None;
    if !document.has_errors()
        && let Some(scene) = document.scene()
    {
        let found = found(Simulation::with_method(scene, method), &mut simulation);
        problems.extend(found.into_iter().map(|problem| placed(&document, problem)));
        sort(&mut problems);
    }
    Examined { document, simulation, problems }
}

/// Examines a document that nobody needs later. The text and the elements of a large scene take as much memory as its
/// simulation: they are given back before it begins. Where it finds something wrong the file is read again, for the places,
/// unless it is another by now. `before` is what was there when the document was read.
pub(super) fn begin(document: Document, path: &Path, before: &FileStamp, method: Method) -> Begun {
    // A stream cannot be read again.
    let is_file = path.as_os_str() != "-" && path.is_file();
    let Some(scene) = document.scene_shared().filter(|_| is_file && !document.has_errors()) else {
        let Examined { simulation, problems, .. } = examine(document, method);
        return Begun { simulation, problems };
    };
    let mut problems = document.diagnostics().to_vec();
    drop(document);
    let mut simulation = None;
    let found = found(Simulation::of_owned(scene, method), &mut simulation);
    let again = found.iter().any(|problem| problem.key.is_some()).then(|| Document::open(path));
    let again = again.filter(|_| FileStamp::of(path) == *before);
    problems.extend(found.into_iter().map(|problem| match &again {
        Some(document) => placed(document, problem),
        None => problem,
    }));
    sort(&mut problems);
    Begun { simulation, problems }
}

/// What is wrong with a simulation that was begun.
fn found(begun: Result<Simulation, CompileError>, simulation: &mut Option<Simulation>) -> Vec<Diagnostic> {
    match begun {
        Ok(begun) => simulation.insert(begun).start_warnings().to_vec(),
        Err(error) => error.problems,
    }
}

/// What has no place sums up the others.
fn sort(problems: &mut [Diagnostic]) {
    problems.sort_by_key(|problem| (problem.position.is_none(), problem.position));
}

/// Whether somebody gave a recording where a scene is meant.
fn is_recording(document: &Document) -> bool {
    document.has_errors() && document.scene().is_none() && RecordingFile::is_meant(&document.to_bytes())
}

fn recording_for_a_scene() -> Diagnostic {
    Diagnostic {
        severity: Severity::Error,
        position: None,
        path: String::new(),
        message: "this is a recording, not a scene".into(),
        hint: "`polyscene replay` runs it again, `polyscene export` writes how its bodies moved, and the editor opens it"
            .into(),
        key: None,
    }
}

/// The simulation knows the element but not where it stands in the file.
fn placed(document: &Document, mut problem: Diagnostic) -> Diagnostic {
    if let (None, Some(key)) = (problem.position, problem.key) {
        (problem.position, problem.path) = document.place_of(key);
    }
    problem
}

pub(super) fn problem_line(file: &str, problem: &Diagnostic) -> String {
    let separator = if problem.position.is_some() { ":" } else { ": " };
    format!("{file}{separator}{problem}")
}
