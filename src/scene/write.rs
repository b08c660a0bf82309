//! From the tree back to text, and the text of what is new.

use std::ops::Range;

use super::tree::{Child, Children, Element, Kept};
use super::{NodeKey, NumberStyle};

/// The text of a list of children.
pub(super) fn children(children: &Children, source: &str) -> String {
    let mut out = String::with_capacity(source.len() + 256);
    append(children, source, &mut out);
    out
}

/// The text of a list of children, and in it the place of each body and force, in order.
pub(super) fn children_with_places(
    children: &Children,
    source: &str,
) -> (String, Vec<(NodeKey, Range<usize>)>) {
    let mut out = String::with_capacity(source.len() + 256);
    let mut places = Vec::new();
    append_noting(children, source, &mut out, &mut places);
    (out, places)
}

fn append_noting(
    children: &Children,
    source: &str,
    out: &mut String,
    places: &mut Vec<(NodeKey, Range<usize>)>,
) {
    for child in children.iter() {
        match child {
            // What has been read by itself is a body or a force.
            Child::Element(el) if el.reading.get().is_some() => {
                let start = out.len();
                element(el, source, out);
                places.push((el.key, start..out.len()));
            }
            Child::Element(el) => {
                out.push_str(el.open.get(source));
                append_noting(el.children(source), source, out, places);
                out.push_str(el.close.get(source));
            }
            Child::Raw(text) => out.push_str(text.get(source)),
        }
    }
}

/// Appends the text of one element.
pub(super) fn element(element: &Element, source: &str, out: &mut String) {
    out.push_str(element.open.get(source));
    match element.kept(source) {
        Kept::Listed(children) => append(children, source, out),
        Kept::Piece(piece) => out.push_str(piece),
    }
    out.push_str(element.close.get(source));
}

fn append(children: &Children, source: &str, out: &mut String) {
    for child in children.iter() {
        match child {
            Child::Element(el) => element(el, source, out),
            Child::Raw(text) => out.push_str(text.get(source)),
        }
    }
}

/// A file without bodies and forces. Its time speed shows the number style, so that it survives saving.
pub(super) fn new_file(style: NumberStyle) -> String {
    let time_speed = match style {
        NumberStyle::Comma => "1,0",
        NumberStyle::Point => "1.0",
    };
    format!(
        r#"<?xml version="1.0" encoding="utf-8"?>
<PolyPhysicsXml Version="1.0">
  <Map>
    <Size X="10" Y="10" Z="10" />
    <Tiles X="10" Y="10" Z="10" />
  </Map>
  <Simulation>
    <TimeSpeed F32="{time_speed}" />
    <Forces>
    </Forces>
  </Simulation>
  <Primitives>
  </Primitives>
</PolyPhysicsXml>
"#
    )
}
