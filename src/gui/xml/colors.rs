//! The colours of XML: tags, names, values and comments told apart.

use egui::Color32;

use crate::gui::colors::Tones;

/// The first piece of a text that is not empty: its length in bytes and its colour. `in_comment` says that it begins inside
/// a comment.
pub(super) fn piece(rest: &str, in_comment: bool, tones: &Tones) -> (usize, Color32) {
    let first = rest.chars().next().unwrap_or(' ');
    if in_comment {
        (rest.find("-->").map_or(rest.len(), |end| end + 3), tones.weak)
    } else if first == '"' {
        let end = rest.get(1..).and_then(|rest| rest.find('"')).map_or(rest.len(), |end| end + 2);
        (end, tones.good)
    } else if first == '<' {
        let end = rest.find([' ', '>', '\n']).unwrap_or(rest.len());
        (end.max(1), tones.accent)
    } else {
        let end = rest.get(first.len_utf8()..).and_then(|rest| rest.find(['"', '<']));
        (end.map_or(rest.len(), |end| end + first.len_utf8()), tones.strong)
    }
}
