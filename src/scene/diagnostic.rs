//! A problem of a scene file: where it is, what is wrong, and the way out.

use std::fmt;
use std::path::Path;

/// Whether a problem keeps the scene from running.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    Warning,
    Error,
}

/// One problem. [`fmt::Display`] gives `line:column: severity: message (path); hint`, without the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    pub severity: Severity,
    /// 1-based line and column (in characters) in the source; `None` where there is no such place
    /// (a file that cannot be read, an element that was added and not saved yet).
    pub position: Option<(u32, u32)>,
    /// Path of the element, such as `/PolyPhysicsXml/Primitives/SoftObject[5853]/Sphere`; may be empty.
    pub path: String,
    pub message: String,
    /// What to do about it; may be empty.
    pub hint: String,
    /// The body, force or other element to select when the problem is clicked.
    pub key: Option<super::NodeKey>,
}

impl Diagnostic {
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}

impl fmt::Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Warning => "warning",
            Self::Error => "error",
        })
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((line, column)) = self.position {
            write!(f, "{line}:{column}: ")?;
        }
        write!(f, "{}: {}", self.severity, escaped(&self.message))?;
        if !self.path.is_empty() {
            write!(f, " ({})", escaped(&self.path))?;
        }
        if !self.hint.is_empty() {
            write!(f, "; {}", escaped(&self.hint))?;
        }
        Ok(())
    }
}

/// A piece of the file for a message: short, and without characters that steer a terminal.
pub(super) fn shown(text: &str) -> String {
    const LONGEST: usize = 60;
    let mut shown = String::new();
    for (count, c) in text.chars().enumerate() {
        if count == LONGEST {
            shown.push('…');
            break;
        }
        push_escaped(c, &mut shown);
    }
    shown
}

/// A text fit for one line of a message: what steers a terminal or reorders the line is written as an escape
/// such as `\u{1b}`.
pub fn escaped(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    text.chars().for_each(|c| push_escaped(c, &mut shown));
    shown
}

/// The name of a file for a message, [`escaped`].
pub fn shown_path(path: &Path) -> String {
    escaped(&path.display().to_string())
}

fn push_escaped(c: char, text: &mut String) {
    if is_invisible(c) {
        text.extend(c.escape_default());
    } else {
        text.push(c);
    }
}

/// Characters that are not seen as themselves: control characters, line and paragraph separators, marks that
/// change the direction of the text around them, and those of no width that hide differences.
fn is_invisible(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{AD}' | '\u{61C}' | '\u{180E}' | '\u{200B}'..='\u{200F}' | '\u{2028}'..='\u{202E}'
            | '\u{2060}'..='\u{206F}' | '\u{FEFF}' | '\u{FFF9}'..='\u{FFFB}' | '\u{E0000}'..='\u{E0FFF}')
}
