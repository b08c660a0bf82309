//! What values a scene may hold: one place for the reader, which reports, and for edits, which refuse.

use super::ParamInfo;

/// Tiles along one axis: more would not help any search and would overflow its indices.
pub(super) const MAX_TILES: u32 = 65_536;

/// Depth of nested elements; the format needs 6.
pub(super) const MAX_DEPTH: usize = 64;

/// Largest file that is read. Offsets into it are kept in 32 bits.
pub(super) const MAX_FILE_BYTES: u64 = 256 * 1024 * 1024;

/// Elements of one document, and pieces between them: what 256 MiB of bodies have, and a limit to what
/// 256 MiB of `<a/>` make of the memory.
pub(super) const MAX_NODES: usize = 24_000_000;

/// Pieces and elements that any document may have, however short it is.
pub(super) const FREE_PIECES: usize = 100_000;

/// Bytes per piece of XML, tags and the spaces between them, in a longer document. The shortest body there is,
/// each tag on its line, has 8.8; what is denser is no scene and would take a hundred times its size of memory.
pub(super) const LEAST_BYTES_PER_PIECE: usize = 6;

/// Bytes per element, likewise: `<Radius F32="1"/>` has 17.
pub(super) const LEAST_BYTES_PER_ELEMENT: usize = 12;

/// Bodies, or forces, of one document: what 256 MiB hold.
pub(super) const MAX_ITEMS: usize = 1_000_000;

/// Problems of one severity that are listed; the rest are counted. A list is for people.
pub(super) const MAX_DIAGNOSTICS: usize = 1000;

/// The range a number must lie in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Range {
    Any,
    Positive,
    NotNegative,
    Between(f64, f64),
}

impl Range {
    pub fn of_param(info: &ParamInfo) -> Self {
        Self::Between(info.range.0, info.range.1)
    }

    /// What the value must be, if it is not.
    pub fn refusal(self, value: f64) -> Option<String> {
        if !value.is_finite() {
            return Some("must be a finite number".into());
        }
        let (fine, must) = match self {
            Self::Any => (true, String::new()),
            Self::Positive => (value > 0.0, "must be greater than 0".into()),
            Self::NotNegative => (value >= 0.0, "must not be negative".into()),
            Self::Between(low, high) => {
                ((low..=high).contains(&value), format!("must lie between {low:?} and {high:?}"))
            }
        };
        (!fine).then_some(must)
    }
}

/// Why a number of tiles is refused.
pub(super) fn tiles_refusal(value: f64) -> Option<String> {
    let fine = value.fract() == 0.0 && (1.0..=f64::from(MAX_TILES)).contains(&value);
    (!fine).then(|| format!("must be a whole number from 1 to {MAX_TILES}"))
}

/// Whether XML 1.0 can hold the character at all.
pub(super) fn is_xml_char(c: char) -> bool {
    matches!(c, '\t' | '\n' | '\r' | ' '..='\u{D7FF}' | '\u{E000}'..='\u{FFFD}' | '\u{10000}'..)
}

fn is_name_start(c: char) -> bool {
    matches!(c, ':' | '_' | 'A'..='Z' | 'a'..='z' | '\u{C0}'..='\u{D6}' | '\u{D8}'..='\u{F6}'
        | '\u{F8}'..='\u{2FF}' | '\u{370}'..='\u{37D}' | '\u{37F}'..='\u{1FFF}' | '\u{200C}'..='\u{200D}'
        | '\u{2070}'..='\u{218F}' | '\u{2C00}'..='\u{2FEF}' | '\u{3001}'..='\u{D7FF}'
        | '\u{F900}'..='\u{FDCF}' | '\u{FDF0}'..='\u{FFFD}' | '\u{10000}'..='\u{EFFFF}')
}

fn is_name_part(c: char) -> bool {
    is_name_start(c)
        || matches!(c, '-' | '.' | '0'..='9' | '\u{B7}' | '\u{300}'..='\u{36F}' | '\u{203F}'..='\u{2040}')
}

/// Whether a text is a name of XML.
pub(super) fn is_name(text: &str) -> bool {
    text.starts_with(is_name_start) && text.chars().all(is_name_part)
}
