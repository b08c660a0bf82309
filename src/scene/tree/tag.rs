//! The attributes inside one raw tag: finding, checking and changing them without touching the rest.

use std::borrow::Cow;
use std::ops::Range;

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

impl<'a> Attr<'a> {
    /// The value with its references resolved; as it stands if one is wrong, which the parser excludes.
    pub fn resolved(&self) -> Cow<'a, str> {
        let raw = self.raw;
        if raw.contains('&') { quick_xml::escape::unescape(raw).unwrap_or(raw.into()) } else { raw.into() }
    }
}

/// What is wrong inside a tag, and where in it.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::scene) struct TagFault {
    pub at: usize,
    pub fault: AttributeFault,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::scene) enum AttributeFault {
    NoSpaceBefore,
    NoValue,
    NoQuotes,
    Unclosed,
}

impl AttributeFault {
    pub fn message(self) -> &'static str {
        match self {
            Self::NoSpaceBefore => "white space is missing before an attribute",
            Self::NoValue => "an attribute has no value",
            Self::NoQuotes => "an attribute value is not in quotes",
            Self::Unclosed => "the quote of an attribute value is not closed",
        }
    }

    pub fn hint(self) -> &'static str {
        match self {
            Self::NoSpaceBefore => "put a space between the attributes; a tag ends with > or />",
            Self::NoValue => "write Name=\"value\", or remove what stands there",
            Self::NoQuotes => "write the value in quotes, such as X=\"1\"",
            Self::Unclosed => "close the quote",
        }
    }
}

/// The name of a start tag, such as `<Map>`, or of an instruction, such as `<?xml?>`, then with its `?`.
pub(in crate::scene) fn name(tag: &str) -> &str {
    let rest = tag.strip_prefix('<').unwrap_or(tag);
    let begins = usize::from(rest.starts_with('?'));
    let last = if begins > 0 { b'?' } else { b'/' };
    let is_end = |b: &u8| matches!(b, b' ' | b'\t' | b'\r' | b'\n' | b'>') || *b == last;
    let len = rest.as_bytes()[begins..].iter().position(is_end);
    len.map_or(rest, |len| &rest[..begins + len])
}

/// The attributes of a start tag, or the like in a processing instruction.
pub(in crate::scene) fn attributes(tag: &str) -> Attributes<'_> {
    let ending = if tag.starts_with("<?") { "?>" } else { "/>" };
    let end = tag.len() - if tag.ends_with(ending) { 2 } else { usize::from(tag.ends_with('>')) };
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
        let start = self.after_spaces(self.at);
        if start == self.end {
            return None;
        }
        let found = self.read(self.at, start);
        self.at = found.as_ref().map_or(self.end, |attr| attr.whole.end);
        Some(found)
    }
}

impl<'a> Attributes<'a> {
    fn read(&self, before: usize, start: usize) -> Result<Attr<'a>, TagFault> {
        let fault = |at, fault| TagFault { at, fault };
        if before == start {
            return Err(fault(start, AttributeFault::NoSpaceBefore));
        }
        let bytes = &self.text.as_bytes()[..self.end];
        let name = bytes[start..].iter().take_while(|&&b| b != b'=' && !is_space(b)).count();
        let name_end = start + name;
        let equals = self.after_spaces(name_end);
        if bytes.get(equals) != Some(&b'=') {
            return Err(fault(start, AttributeFault::NoValue));
        }
        let open = self.after_spaces(equals + 1);
        let Some(quote @ (b'"' | b'\'')) = bytes.get(open) else {
            return Err(fault(open, AttributeFault::NoQuotes));
        };
        let from = open + 1;
        let Some(len) = bytes[from..].iter().position(|b| b == quote) else {
            return Err(fault(open, AttributeFault::Unclosed));
        };
        let value = from..from + len;
        Ok(Attr {
            name: &self.text[start..name_end],
            raw: &self.text[value.clone()],
            whole: before..value.end + 1,
            value,
        })
    }

    fn after_spaces(&self, from: usize) -> usize {
        let bytes = &self.text.as_bytes()[from..self.end];
        from + bytes.iter().take_while(|&&b| is_space(b)).count()
    }
}

fn is_space(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\r' | b'\n')
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
