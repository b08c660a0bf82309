//! Text to tree: quick-xml finds the pieces, this adds the checks of well-formedness that it leaves out
//! and keeps every byte. The first fault ends it.

use std::ops::Range;
use std::sync::Arc;

use quick_xml::Reader;
use quick_xml::errors::IllFormedError;
use quick_xml::events::Event;

use super::declaration;
use super::rules::{
    FREE_PIECES, LEAST_BYTES_PER_ELEMENT, LEAST_BYTES_PER_PIECE, MAX_DEPTH, MAX_NODES, is_name, is_xml_char,
};
use super::tree::{Child, Children, Element, Keys, NO_PLACE, Text, tag};
use super::{NodeKey, shown};

/// Why a text is not well-formed XML that this program reads.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ParseFault {
    /// In bytes.
    pub at: usize,
    /// Names of the open elements, from the root.
    pub path: String,
    pub message: String,
    pub hint: String,
}

/// Parses a whole file, and checks it. Bodies are left folded.
pub(super) fn document(source: &str, keys: &Keys) -> Result<Children, ParseFault> {
    check_characters(source)?;
    let mut parser = Parser::new(source, Some(keys), Kind::File);
    if source.starts_with('\u{FEFF}') {
        return Err(parser.fault(0, "the file has two byte order marks", "remove one"));
    }
    parser.run()?;
    if !parser.has_root {
        let message = if source.trim().is_empty() { "the file is empty" } else { "there is no root element" };
        return Err(parser.fault(0, message, "a scene starts with <PolyPhysicsXml Version=\"1.0\">"));
    }
    Ok(parser.top.into())
}

/// Parses a piece of new XML that this program wrote; its nodes own their text.
pub(super) fn fragment(xml: &str, keys: &Keys) -> Result<Vec<Child>, ParseFault> {
    check_characters(xml)?;
    let mut parser = Parser::new(xml, Some(keys), Kind::New);
    parser.run()?;
    Ok(parser.top)
}

/// What stands inside an element of a file that was checked. Nobody asks for these by a key.
pub(super) fn inside(source: &str, piece: Range<u32>) -> Children {
    let text = source.get(piece.start as usize..piece.end as usize).unwrap_or("");
    // A reader leaves out a byte order mark at its beginning.
    let mark = text.len() - text.trim_start_matches('\u{FEFF}').len();
    let start = piece.start as usize + mark;
    let mut parser = Parser::new(&text[mark..], None, Kind::Piece { start });
    if mark > 0 {
        parser.top.push(Child::Raw(Text::Source { start: piece.start, end: start as u32 }));
    }
    match parser.run() {
        Ok(()) => parser.top.into(),
        // It was checked; should it not divide all the same, it stays as one text.
        Err(_) => vec![Child::Raw(Text::Source { start: piece.start, end: piece.end })].into(),
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// A whole file: texts refer to the source, and what may stand outside the root is checked.
    File,
    /// A piece of a file, which begins there.
    Piece { start: usize },
    /// Text that this program wrote.
    New,
}

/// Elements around a body: the root and the list.
const BODY_LEVEL: usize = 2;

/// An element whose end tag has not come yet.
struct Open<'a> {
    at: usize,
    key: NodeKey,
    tag: &'a str,
    children: Vec<Child>,
}

struct Parser<'a> {
    source: &'a str,
    /// None for what is in a body.
    keys: Option<&'a Keys>,
    kind: Kind,
    has_root: bool,
    /// Whether the list of bodies is open.
    in_bodies: bool,
    open: Vec<Open<'a>>,
    top: Vec<Child>,
    nodes: usize,
    elements: usize,
    /// Of the attributes of one tag.
    names: Vec<&'a str>,
}

impl<'a> Parser<'a> {
    fn new(source: &'a str, keys: Option<&'a Keys>, kind: Kind) -> Self {
        let (open, top, names) = Default::default();
        let (has_root, in_bodies) = (false, false);
        Self { source, keys, kind, has_root, in_bodies, open, top, nodes: 0, elements: 0, names }
    }

    fn is_whole(&self) -> bool {
        self.kind == Kind::File
    }

    /// Whether what comes now is inside a body, which is checked and left folded.
    fn is_in_body(&self) -> bool {
        self.in_bodies && self.open.len() > BODY_LEVEL
    }

    fn run(&mut self) -> Result<(), ParseFault> {
        let mut reader = Reader::from_str(self.source);
        reader.config_mut().check_comments = false;
        loop {
            let start = reader.buffer_position() as usize;
            let event = reader.read_event();
            let end = reader.buffer_position() as usize;
            match event {
                Ok(Event::Eof) => return self.finish(),
                Ok(event) => self.event(&event, start, end)?,
                Err(err) => {
                    let at = reader.error_position() as usize;
                    return Err(self.fault(at, &said(&err), "the file is not well-formed XML"));
                }
            }
        }
    }

    fn event(&mut self, event: &Event<'_>, start: usize, end: usize) -> Result<(), ParseFault> {
        let piece = self.source.get(start..end).unwrap_or("");
        self.nodes += 1;
        self.elements += usize::from(matches!(event, Event::Start(_) | Event::Empty(_)));
        self.check_amount(start)?;
        match event {
            Event::Start(_) => self.start(start, piece)?,
            Event::Empty(_) => {
                self.start(start, piece)?;
                self.end(None);
            }
            Event::End(_) => self.end(Some(start..end)),
            Event::Text(_) => self.plain_text(start, end, piece)?,
            Event::CData(_) => self.inside_only(start, end, "a CDATA section stands outside the root")?,
            Event::GeneralRef(_) => {
                self.check_references(start, piece)?;
                self.inside_only(start, end, "a reference stands outside the root")?;
            }
            Event::Comment(content) => {
                if content.contains("--") || content.ends_with('-') {
                    let hint = "XML forbids it; use single hyphens";
                    return Err(self.fault(start, "a comment contains --", hint));
                }
                self.push(start, end);
            }
            Event::PI(content) => {
                let target = content.target();
                if target.eq_ignore_ascii_case("xml") {
                    let message = format!("a processing instruction is called {target}, which XML reserves");
                    let hint = "the declaration is written <?xml …?> at the very start; remove this one";
                    return Err(self.fault(start, &message, hint));
                }
                if !is_name(target) {
                    let hint = "an instruction is written <?name …?>";
                    return Err(self.fault(start, "a processing instruction has no valid name", hint));
                }
                self.push(start, end);
            }
            Event::Decl(_) => {
                if start > 0 || !self.is_whole() {
                    let hint = "move <?xml …?> to the very start of the file, or remove it";
                    return Err(self.fault(start, "an XML declaration stands inside the file", hint));
                }
                if let Err(bad) = declaration::check(piece) {
                    return Err(self.fault(start + bad.at, &bad.message, bad.hint));
                }
                self.push(start, end);
            }
            Event::DocType(_) => {
                let hint = "remove the DOCTYPE; scenes need none, and it could load or expand anything";
                return Err(self.fault(start, "a DOCTYPE is not allowed", hint));
            }
            Event::Eof => {}
        }
        Ok(())
    }

    /// Refuses what would take too much memory, also in proportion to the file.
    fn check_amount(&self, at: usize) -> Result<(), ParseFault> {
        if matches!(self.kind, Kind::Piece { .. }) {
            return Ok(());
        }
        if self.nodes > MAX_NODES {
            let message = format!("there are more than {MAX_NODES} pieces of XML");
            return Err(self.fault(at, &message, "divide the scene"));
        }
        let most = |least_bytes| FREE_PIECES + at / least_bytes;
        if self.nodes > most(LEAST_BYTES_PER_PIECE) || self.elements > most(LEAST_BYTES_PER_ELEMENT) {
            let message = "the elements up to here are shorter than those of any scene";
            return Err(self.fault(at, message, "remove the elements that are no part of the scene"));
        }
        Ok(())
    }

    fn start(&mut self, at: usize, tag: &'a str) -> Result<(), ParseFault> {
        if self.open.len() == MAX_DEPTH {
            let message = format!("elements are nested more than {MAX_DEPTH} deep");
            return Err(self.fault(at, &message, "a scene needs 6 levels"));
        }
        if self.open.is_empty() && self.is_whole() {
            if self.has_root {
                return Err(self.fault(at, "there is a second root element", "a file holds one scene"));
            }
            self.has_root = true;
        }
        if !is_name(tag::name(tag)) {
            let hint = "a < that starts no tag is written &lt;";
            return Err(self.fault(at, "this is not a valid name of an element", hint));
        }
        // Open already, so that a fault in the tag names its element.
        self.open.push(Open {
            at,
            key: self.keys.map_or(NodeKey::default(), Keys::fresh),
            tag,
            children: Vec::new(),
        });
        if self.open.len() == BODY_LEVEL {
            self.in_bodies = self.is_whole() && tag::name(tag) == "Primitives";
        }
        if matches!(self.kind, Kind::Piece { .. }) { Ok(()) } else { self.check_attributes(at, tag) }
    }

    fn check_attributes(&mut self, at: usize, tag: &'a str) -> Result<(), ParseFault> {
        let mut names = std::mem::take(&mut self.names);
        names.clear();
        for attr in tag::attributes(tag) {
            let attr = attr.map_err(|bad| self.fault(at + bad.at, bad.fault.message(), bad.fault.hint()))?;
            let here = at + attr.whole.start + 1;
            if !is_name(attr.name) {
                let hint = "a name begins with a letter and has letters and digits";
                return Err(self.fault(here, "this is not a valid name of an attribute", hint));
            }
            if attr.raw.contains('<') {
                return Err(self.fault(at + attr.value.start, "a value contains <", "write it as &lt;"));
            }
            self.check_references(at + attr.value.start, attr.raw)?;
            names.push(attr.name);
        }
        names.sort_unstable();
        if let Some(pair) = names.windows(2).find(|pair| pair[0] == pair[1]) {
            let message = format!("the attribute {} appears twice", shown(pair[0]));
            return Err(self.fault(at, &message, "remove one of them"));
        }
        self.names = names;
        Ok(())
    }

    /// Ends an element, which has a tag for it or is one `<tag/>`.
    fn end(&mut self, close: Option<Range<usize>>) {
        // The reader has checked that the names match, so there is an open element.
        let Some(open) = self.open.pop() else { return };
        if self.is_in_body() {
            return;
        }
        let at = match self.kind {
            Kind::File => open.at as u32,
            Kind::Piece { start } => (start + open.at) as u32,
            Kind::New => NO_PLACE,
        };
        let inner = open.at + open.tag.len();
        let closing = close.clone().map_or(Text::empty(), |close| self.text(close.start, close.end));
        let tags = [self.text(open.at, inner), closing];
        let mut element = Element::read(open.key, at, tags, open.children);
        if self.in_bodies
            && self.open.len() == BODY_LEVEL
            && let Some(close) = close
        {
            element = element.folded(inner as u32..close.start as u32);
        }
        self.siblings().push(Child::Element(Arc::new(element)));
    }

    fn plain_text(&mut self, start: usize, end: usize, piece: &str) -> Result<(), ParseFault> {
        let outside = self.open.is_empty() && self.is_whole();
        if outside && !piece.chars().all(super::number::is_space) {
            let blank = piece.len() - piece.trim_start().len();
            let hint = "only comments may stand there";
            return Err(self.fault(start + blank, "text stands outside the root element", hint));
        }
        if let Some(at) = piece.find("]]>") {
            return Err(self.fault(start + at, "text contains ]]>", "write it as ]]&gt;"));
        }
        if start < end {
            self.push(start, end);
        }
        Ok(())
    }

    fn inside_only(&mut self, start: usize, end: usize, message: &str) -> Result<(), ParseFault> {
        if self.open.is_empty() && self.is_whole() {
            return Err(self.fault(start, message, "only comments may stand there"));
        }
        self.push(start, end);
        Ok(())
    }

    /// Only the five entities of XML and character references exist.
    fn check_references(&self, at: usize, raw: &str) -> Result<(), ParseFault> {
        for (offset, _) in raw.match_indices('&') {
            let rest = &raw[offset + 1..];
            let name = rest.split(';').next().filter(|name| name.len() < rest.len());
            if !name.is_some_and(is_known_reference) {
                let message = match name {
                    Some(name) => format!("the entity &{}; does not exist", shown(name)),
                    None => "a & stands alone".to_owned(),
                };
                return Err(self.fault(at + offset, &message, "write & as &amp;"));
            }
        }
        Ok(())
    }

    fn finish(&mut self) -> Result<(), ParseFault> {
        match self.open.last() {
            Some(open) => {
                let message = format!("<{}> is never closed", shown(tag::name(open.tag)));
                Err(self.fault(open.at, &message, "the file may have been cut off"))
            }
            None => Ok(()),
        }
    }

    fn siblings(&mut self) -> &mut Vec<Child> {
        match self.open.last_mut() {
            Some(open) => &mut open.children,
            None => &mut self.top,
        }
    }

    fn push(&mut self, start: usize, end: usize) {
        if self.is_in_body() {
            return;
        }
        let text = self.text(start, end);
        self.siblings().push(Child::Raw(text));
    }

    fn text(&self, start: usize, end: usize) -> Text {
        // Files are at most 256 MiB.
        let of_source = |from: usize| Text::Source { start: (from + start) as u32, end: (from + end) as u32 };
        match self.kind {
            Kind::File => of_source(0),
            Kind::Piece { start } => of_source(start),
            Kind::New => Text::from(self.source.get(start..end).unwrap_or("")),
        }
    }

    fn fault(&self, at: usize, message: &str, hint: &str) -> ParseFault {
        /// A scene's own elements are 6 deep; more names say nothing more.
        const LONGEST_PATH: usize = 8;
        let names = self.open.iter().take(LONGEST_PATH).map(|open| shown(tag::name(open.tag)));
        let mut path = names.map(|name| format!("/{name}")).collect::<String>();
        if self.open.len() > LONGEST_PATH {
            path.push_str("/…");
        }
        ParseFault { at, path, message: message.to_owned(), hint: hint.to_owned() }
    }
}

/// A fault in the words of quick-xml, but with names from the file made fit to show.
fn said(err: &quick_xml::Error) -> String {
    match err {
        quick_xml::Error::IllFormed(IllFormedError::MismatchedEndTag { expected, found }) => {
            format!("</{}> is expected here, not </{}>", shown(expected), shown(found))
        }
        quick_xml::Error::IllFormed(IllFormedError::UnmatchedEndTag(name)) => {
            format!("</{}> closes nothing", shown(name))
        }
        quick_xml::Error::IllFormed(err) => err.to_string(),
        quick_xml::Error::Syntax(err) => err.to_string(),
        err => err.to_string(),
    }
}

fn is_known_reference(name: &str) -> bool {
    if matches!(name, "amp" | "lt" | "gt" | "apos" | "quot") {
        return true;
    }
    let Some(number) = name.strip_prefix('#') else { return false };
    let code = match number.strip_prefix('x') {
        Some(hex) if hex.bytes().all(|b| b.is_ascii_hexdigit()) => u32::from_str_radix(hex, 16).ok(),
        None if number.bytes().all(|b| b.is_ascii_digit()) => number.parse().ok(),
        _ => None,
    };
    code.and_then(char::from_u32).is_some_and(is_xml_char)
}

fn check_characters(source: &str) -> Result<(), ParseFault> {
    let is_control = |b: u8| b < b' ' && !matches!(b, b'\t' | b'\n' | b'\r');
    let control = source.bytes().position(is_control);
    let others = source.find(['\u{FFFE}', '\u{FFFF}']);
    let Some(at) = control.into_iter().chain(others).min() else { return Ok(()) };
    let c = source[at..].chars().next().unwrap_or_default();
    Err(ParseFault {
        at,
        path: String::new(),
        message: format!("the character U+{:04X} is not allowed in XML", u32::from(c)),
        hint: "is this a text file?".into(),
    })
}
