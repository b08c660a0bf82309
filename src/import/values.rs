//! Numbers and words of attributes and texts, with complaints that name the place.

use super::log::Log;
use crate::scene::XmlElement;

/// The finite numbers of a text; `None` if something else stands there.
pub(super) fn numbers(text: &str) -> Option<Vec<f64>> {
    let number = |word: &str| word.parse().ok().filter(|value: &f64| value.is_finite());
    text.split_whitespace().map(number).collect()
}

/// An array of exactly `N` numbers.
pub(super) fn array<const N: usize>(text: &str) -> Option<[f64; N]> {
    numbers(text)?.try_into().ok()
}

/// `N` numbers of the element `el`, which says them in the attribute or child `name`. What is none is an error.
pub(super) fn checked<const N: usize>(
    el: XmlElement<'_>,
    name: &str,
    text: &str,
    log: &mut Log,
) -> Option<[f64; N]> {
    let found = array(text);
    if found.is_none() {
        let wanted = if N == 1 { "a number".to_owned() } else { format!("{N} numbers") };
        log.error(el, format!("{name} “{}” of <{}> is not {wanted}", short(text), el.name()), "");
    }
    found
}

/// A number that must be greater than 0.
pub(super) fn positive(el: XmlElement<'_>, name: &str, text: &str, log: &mut Log) -> Option<f64> {
    let [value] = checked::<1>(el, name, text, log)?;
    if value <= 0.0 {
        log.error(el, format!("{name} {value} of <{}> is not greater than 0", el.name()), "");
        return None;
    }
    Some(value)
}

/// Red, green and blue from 0 to 1 as bytes.
pub(super) fn color(text: &str) -> Option<[u8; 3]> {
    let [r, g, b, ..] = numbers(text)?[..] else { return None };
    Some([r, g, b].map(|share| (255.0 * share.clamp(0.0, 1.0)).round() as u8))
}

/// `true`, `1`.
pub(super) fn is_true(text: &str) -> bool {
    matches!(text.trim(), "true" | "1" | "True")
}

fn short(text: &str) -> String {
    const LONGEST: usize = 40;
    let cut = text.chars().count() > LONGEST;
    text.chars().take(LONGEST).chain(cut.then_some('…')).collect()
}
