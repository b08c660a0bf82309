//! The attributes inside one raw tag: finding, checking and changing them without touching the rest.

use std::ops::Range;

use crate::scene::number::is_space;

/// One attribute of a tag, as written.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::scene) struct Attr<'a> {
    pub name: &'a str,
    /// The value between the quotes, references not resolved.
    pub raw: &'a str,
    /// Place of `raw` in the tag, in bytes.
    pub value: Range<usize>,
    /// Place of the whole attribute with the white space before it.
    pub whole: Range<usize>,
}

/// What is wrong inside a tag, and where in it.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::scene) struct TagFault {
    pub at: usize,
    pub message: &'static str,
}

/// The name of a start tag, such as `<Map>`, or of an instruction, such as `<?xml?>`, then with its `?`.
pub(in crate::scene) fn name(tag: &str) -> &str {
    let rest = tag.strip_prefix('<').unwrap_or(tag);
    let begins = usize::from(rest.starts_with('?'));
    let len = rest[begins..].find(|c: char| is_space(c) || matches!(c, '/' | '>' | '?'));
    len.map_or(rest, |len| &rest[..begins + len])
}

/// The attributes of a start tag, or the like in a processing instruction.
pub(in crate::scene) fn attributes(tag: &str) -> Attributes<'_> {
    let closed = tag.ends_with("/>") || tag.ends_with("?>");
    let end = tag.len() - if closed { 2 } else { usize::from(tag.ends_with('>')) };
    Attributes { text: tag, at: (1 + name(tag).len()).min(end), end }
}

/// Iterator over attributes; ends after the first fault.
pub(in crate::scene) struct Attributes<'a> {
    text: &'a str,
    at: usize,
    end: usize,
}

impl<'a> Iterator for Attributes<'a> {
    type Item = Result<Attr<'a>, TagFault>;

    fn next(&mut self) -> Option<Self::Item> {
        let rest = &self.text[self.at..self.end];
        let spaces = spaces(rest);
        if spaces == rest.len() {
            return None;
        }
        let found = self.read(self.at, self.at + spaces);
        self.at = found.as_ref().map_or(self.end, |attr| attr.whole.end);
        Some(found)
    }
}

impl<'a> Attributes<'a> {
    fn read(&self, before: usize, start: usize) -> Result<Attr<'a>, TagFault> {
        let fault = |at, message| TagFault { at, message };
        if before == start {
            return Err(fault(start, "white space is missing before an attribute"));
        }
        let text = &self.text[..self.end];
        let len = text[start..].find(|c: char| is_space(c) || c == '=').unwrap_or(text.len() - start);
        let name_end = start + len;
        let equals = name_end + spaces(&text[name_end..]);
        if !text[equals..].starts_with('=') {
            return Err(fault(start, "an attribute has no value"));
        }
        let open = equals + 1 + spaces(&text[equals + 1..]);
        let quote = match text[open..].chars().next() {
            Some(quote @ ('"' | '\'')) => quote,
            _ => return Err(fault(open.min(text.len()), "an attribute value is not in quotes")),
        };
        let from = open + 1;
        let Some(len) = text[from..].find(quote) else {
            return Err(fault(open, "the quote of an attribute value is not closed"));
        };
        let value = from..from + len;
        Ok(Attr {
            name: &self.text[start..name_end],
            raw: &self.text[value.clone()],
            whole: before..value.end + 1,
            value,
        })
    }
}

fn spaces(text: &str) -> usize {
    text.len() - text.trim_start_matches(is_space).len()
}

/// The named attribute of a tag.
pub(in crate::scene) fn find<'a>(tag: &'a str, name: &str) -> Option<Attr<'a>> {
    attributes(tag).flatten().find(|attr| attr.name == name)
}

/// The tag with an attribute's raw value replaced, or the attribute added as the last one.
pub(in crate::scene) fn with_raw(tag: &str, name: &str, raw: &str, quote: char) -> String {
    match find(tag, name) {
        Some(attr) => splice(tag, attr.value, raw),
        None => {
            let last = attributes(tag).flatten().last();
            let at = last.map_or(1 + self::name(tag).len(), |attr| attr.whole.end);
            splice(tag, at..at, &format!(" {name}={quote}{raw}{quote}"))
        }
    }
}

/// The tag without an attribute.
pub(in crate::scene) fn without(tag: &str, name: &str) -> String {
    match find(tag, name) {
        Some(attr) => splice(tag, attr.whole, ""),
        None => tag.to_owned(),
    }
}

/// `text` with the bytes of `range` replaced.
pub(in crate::scene) fn splice(text: &str, range: Range<usize>, replacement: &str) -> String {
    [&text[..range.start], replacement, &text[range.end..]].concat()
}
