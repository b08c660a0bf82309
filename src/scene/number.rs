//! Numbers as scene files write them: a decimal comma or point, .NET exponents, and nothing else.

use std::borrow::Cow;

/// How a new file writes its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum NumberStyle {
    /// `-9,8`, as the predecessor's tools wrote and read it.
    #[default]
    Comma,
    /// `-9.8`.
    Point,
}

/// Why a text is not a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NumberFault {
    Empty,
    Separators,
    Space,
    Hex,
    NotFinite,
    TooLarge,
    Other,
}

impl NumberFault {
    pub fn hint(self) -> &'static str {
        match self {
            Self::Empty => "write a number such as 0 or 9,8",
            Self::Separators => "write one decimal comma or point and no thousands marks, such as 1234,5",
            Self::Space => "write the digits without spaces, such as 1234,5",
            Self::Hex => "write it in decimal digits",
            Self::NotFinite => "write a finite number",
            Self::TooLarge => "the largest number is about 1,8e308",
            Self::Other => "write a number such as -9,8 or 3E-05",
        }
    }
}

/// Reads a number: `[+-] digits [(,|.) digits] [(e|E) [+-] digits]`, white space around it allowed.
pub(super) fn parse(raw: &str) -> Result<f64, NumberFault> {
    let text = raw.trim_matches(is_space);
    if !is_decimal(text.as_bytes()) {
        return Err(fault_of(text));
    }
    let with_point =
        if text.contains(',') { Cow::Owned(text.replace(',', ".")) } else { Cow::Borrowed(text) };
    match with_point.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(NumberFault::TooLarge),
        Err(_) => Err(NumberFault::Other),
    }
}

/// Writes the shortest text that reads back as the same bits.
pub(super) fn format(value: f64, style: NumberStyle) -> String {
    let mut text = format!("{value:?}");
    if text.ends_with(".0") {
        text.truncate(text.len() - 2);
    }
    match style {
        NumberStyle::Comma => text.replace('.', ","),
        NumberStyle::Point => text,
    }
}

/// The style a number is written in, if it shows one.
pub(super) fn style_of(raw: &str) -> Option<NumberStyle> {
    match raw.bytes().find(|b| matches!(b, b',' | b'.'))? {
        b',' => Some(NumberStyle::Comma),
        _ => Some(NumberStyle::Point),
    }
}

/// The white space of XML.
pub(super) fn is_space(c: char) -> bool {
    matches!(c, ' ' | '\t' | '\r' | '\n')
}

fn is_decimal(text: &[u8]) -> bool {
    let digits = |from: usize| text[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let signed = |from: usize| from + usize::from(matches!(text.get(from), Some(b'+' | b'-')));
    let mut at = signed(0);
    let whole = digits(at);
    at += whole;
    let mut fraction = 0;
    if matches!(text.get(at), Some(b',' | b'.')) {
        fraction = digits(at + 1);
        at += 1 + fraction;
    }
    if whole + fraction == 0 {
        return false;
    }
    if matches!(text.get(at), Some(b'e' | b'E')) {
        let from = signed(at + 1);
        let exponent = digits(from);
        if exponent == 0 {
            return false;
        }
        at = from + exponent;
    }
    at == text.len()
}

fn fault_of(text: &str) -> NumberFault {
    let lower = text.to_ascii_lowercase();
    let unsigned = lower.trim_start_matches(['+', '-']);
    let plain = |c: char| c.is_ascii_digit() || matches!(c, ',' | '.' | '+' | '-' | 'e' | 'E');
    if text.is_empty() {
        NumberFault::Empty
    } else if unsigned.starts_with("nan") || unsigned.starts_with("inf") || unsigned.starts_with('∞') {
        NumberFault::NotFinite
    } else if unsigned.starts_with("0x") || unsigned.starts_with("&h") {
        NumberFault::Hex
    } else if text.chars().all(plain) && text.matches([',', '.']).count() > 1 {
        NumberFault::Separators
    } else if text.chars().any(char::is_whitespace) && text.chars().all(|c| plain(c) || c.is_whitespace()) {
        NumberFault::Space
    } else {
        NumberFault::Other
    }
}
