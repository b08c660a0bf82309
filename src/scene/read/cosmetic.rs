//! What does not change the physics: `<?polyscene name="…" group="…" color="#rrggbb" hidden="1" locked="1"?>`,
//! a processing instruction inside a body or force, which other readers skip.

use super::log::Log;
use crate::scene::shown;
use crate::scene::tree::{RawKind, View, raw_kind, tag};

/// What the processing instruction begins with.
pub(in crate::scene) const TARGET: &str = "?polyscene";

#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Cosmetics {
    pub name: Option<String>,
    pub group: Option<String>,
    pub color: Option<[u8; 3]>,
    pub hidden: bool,
    pub locked: bool,
}

/// Reads the element's first such instruction; attributes it does not know are left for later versions.
pub(super) fn read<'a>(el: View<'a>, log: &mut Log<'a>) -> Cosmetics {
    let mut cosmetics = Cosmetics::default();
    let Some(instruction) = el.raws().find(|raw| is_cosmetic(raw)) else { return cosmetics };
    for attr in tag::attributes(instruction) {
        let Ok(attr) = attr else {
            log.warn(el.place(), "the polyscene instruction is not understood", "it is kept as it is");
            break;
        };
        let value = quick_xml::escape::unescape(attr.raw);
        let understood = match (attr.name, value) {
            (_, Err(_)) => false,
            ("name", Ok(value)) => {
                cosmetics.name = Some(value.into_owned()).filter(|name| !name.is_empty());
                true
            }
            ("group", Ok(value)) => {
                cosmetics.group = Some(value.into_owned()).filter(|group| !group.is_empty());
                true
            }
            ("color", Ok(value)) => {
                cosmetics.color = parse_color(&value);
                cosmetics.color.is_some()
            }
            ("hidden", Ok(value)) => flag(&value).map(|flag| cosmetics.hidden = flag).is_some(),
            ("locked", Ok(value)) => flag(&value).map(|flag| cosmetics.locked = flag).is_some(),
            _ => true,
        };
        if !understood {
            let message = format!("{}=\"{}\" is not understood", attr.name, shown(attr.raw));
            log.warn(el.place(), message, "a color is written #rrggbb, hidden and locked 0 or 1");
        }
    }
    cosmetics
}

/// Whether a raw child is such an instruction.
pub(in crate::scene) fn is_cosmetic(raw: &str) -> bool {
    raw_kind(raw) == RawKind::Instruction && tag::name(raw) == TARGET
}

/// Reads `#rrggbb`.
fn parse_color(text: &str) -> Option<[u8; 3]> {
    let digits = text.strip_prefix('#')?;
    if digits.len() != 6 || !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
        return None;
    }
    let [_, red, green, blue] = u32::from_str_radix(digits, 16).ok()?.to_be_bytes();
    Some([red, green, blue])
}

fn flag(text: &str) -> Option<bool> {
    match text {
        "1" | "true" => Some(true),
        "0" | "false" => Some(false),
        _ => None,
    }
}
