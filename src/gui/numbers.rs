//! Numbers for people, with as many digits as help, in columns that stay in place.

/// `value` with at most `digits` significant digits, without trailing zeros; very large and very small
/// ones as `1.2e-7`.
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return "–".to_owned();
    }
    let exponent = libm::log10(value.abs()).floor() as i32;
    if !(-5..9).contains(&exponent) {
        let text = format!("{value:.*e}", digits.saturating_sub(1));
        let (mantissa, power) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{power}", trimmed(mantissa));
    }
    let decimals = (digits as i32 - 1 - exponent).clamp(0, 15) as usize;
    trimmed(&format!("{value:.decimals$}")).to_owned()
}

/// As [`significant`], with fewer digits where it would be longer than so many characters.
pub fn fitting(value: f64, digits: usize, longest: usize) -> String {
    let mut texts = (1..=digits).rev().map(|digits| significant(value, digits));
    texts.find(|text| text.chars().count() <= longest).unwrap_or_else(|| significant(value, 1))
}

/// A residual or another small number: `0`, `3e-16`; one that is not small as it is, `0.163`.
pub fn tiny(value: f64) -> String {
    if value.abs() >= 1e-3 || value == 0.0 { significant(value, 3) } else { format!("{value:.0e}") }
}

/// Wall-clock seconds in the unit that keeps them short.
pub fn duration(seconds: f64) -> String {
    match seconds {
        s if !s.is_finite() || s <= 0.0 => "–".to_owned(),
        s if s < 1e-3 => format!("{:.0} µs", s * 1e6),
        s if s < 1.0 => format!("{:.1} ms", s * 1e3),
        s => format!("{s:.2} s"),
    }
}

/// `12 345 678`, with thin spaces.
pub fn count(value: u64) -> String {
    let digits = value.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push('\u{2009}');
        }
        text.push(digit);
    }
    text
}

fn trimmed(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[allow(clippy::approx_constant, reason = "the old tools wrote angles with these digits")]
    fn digits_are_kept_where_they_help() {
        let cases = [
            (0.0, "0"),
            (1.0, "1"),
            (-1.570_796, "-1.5708"),
            (123_456.7, "123457"),
            (1e-7, "1e-7"),
            (2.5e12, "2.5e12"),
            (0.000_123_456, "0.000123456"),
        ];
        for (value, text) in cases {
            assert_eq!(significant(value, 6), text);
        }
        let cases = [
            (1.0 / 3.0, "0.3333333"),
            (-1.713_907e-16, "-1.71e-16"),
            (-0.000_123_456_7, "-0.000123"),
            (-1.5e-300, "-1.5e-300"),
        ];
        for (value, text) in cases {
            assert_eq!(fitting(value, 7, 9), text);
        }
        assert_eq!(count(1_234_567), "1\u{2009}234\u{2009}567");
    }
}
