//! Edits of names, colors and the like, which live in a processing instruction inside the element.

use std::sync::Arc;

use super::pen::{Changed, Pen, Spot, escaped, unit};
use super::style::raw;
use crate::scene::read::is_cosmetic;
use crate::scene::tree::{Child, Element, tag};

/// Sets or removes one attribute of the instruction, which comes and goes with its last attribute.
pub(super) fn set(pen: Pen<'_>, el: &Arc<Element>, lead: &str, name: &str, value: Option<&str>) -> Changed {
    let source = &pen.source.text;
    let instruction = |child: &Child| raw(child, source).filter(|raw| is_cosmetic(raw)).map(str::to_owned);
    let found =
        el.children(source).iter().enumerate().find_map(|(at, child)| Some((at, instruction(child)?)));
    let Some((at, old)) = found else {
        let Some(value) = value else { return Ok(el.clone()) };
        let xml = format!("<?polyscene{}?>", pen.attribute(name, value));
        return pen.with_new(el, lead, Spot::First, "", |_| xml);
    };
    let written = tag::find(&old, name);
    let same = match (&written, value) {
        (Some(written), Some(value)) => {
            quick_xml::escape::unescape(written.raw).is_ok_and(|written| written == value)
        }
        (None, None) => true,
        _ => false,
    };
    if same {
        return Ok(el.clone());
    }
    let new = match value {
        Some(value) => tag::with_raw(&old, name, &escaped(value), pen.style.quote),
        None => tag::without(&old, name),
    };
    let children = if tag::attributes(&new).next().is_some() {
        el.children(source).splice(at..at + 1, vec![Child::Raw(new.into())])
    } else {
        let (start, end) = unit(el.children(source), at, source);
        el.children(source).splice(start..end, Vec::new())
    };
    Ok(Arc::new(el.with_children(children)))
}

/// One attribute of the instruction.
pub(super) fn get(pen: Pen<'_>, el: &Element, name: &str) -> Option<String> {
    let source = &pen.source.text;
    let instruction =
        el.children(source).iter().filter_map(|child| raw(child, source)).find(|raw| is_cosmetic(raw))?;
    let value = quick_xml::escape::unescape(tag::find(instruction, name)?.raw).ok()?;
    Some(value.into_owned())
}

/// The value of a flag: absent means no.
pub(super) fn flag(on: bool) -> Option<&'static str> {
    on.then_some("1")
}

/// The value of a color.
pub(super) fn color([red, green, blue]: [u8; 3]) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}
