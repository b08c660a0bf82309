//! Numbers for people: short, with SI prefixes where the unit is metres.

/// `value` with at most `digits` digits after the point and no trailing zeros; never `-0`.
pub fn number(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// `value` with at most three significant digits, or with all before the point: as `1.5e300` where these would be many, or
/// the value too small to be written without one.
pub(super) fn short(value: f64) -> String {
    if value.is_normal() && !(1e-9..1e6).contains(&value.abs()) {
        let text = format!("{value:.2e}");
        let (mantissa, power) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{power}", mantissa.trim_end_matches('0').trim_end_matches('.'));
    }
    let exponent = if value.is_normal() { libm::log10(value.abs()).floor() } else { 0.0 };
    number(value, (2.0 - exponent).clamp(0.0, 12.0) as usize)
}

/// A value of one digit, such as a scale of 1, 2, 5 × 10^k, without what its rounding adds: `0.05`, `20`, `1e21`.
pub(super) fn one_digit(value: f64) -> String {
    let power = format!("{value:.0e}");
    match power.parse() {
        Ok(rounded) if (1e-4..1e6).contains(&rounded) => number(rounded, 4),
        _ => power,
    }
}

/// A length in the unit that keeps it short: `20 cm`, `1 m`, `5 km`.
pub fn with_unit(metres: f64) -> String {
    const UNITS: [(f64, &str); 5] = [(1e3, "km"), (1.0, "m"), (1e-2, "cm"), (1e-3, "mm"), (1e-6, "µm")];
    let (scale, unit) = UNITS
        .into_iter()
        .find(|(scale, _)| metres.abs() >= scale * (1.0 - 1e-9))
        .unwrap_or(UNITS[UNITS.len() - 1]);
    format!("{} {unit}", number(metres / scale, 3))
}

/// The largest of 1, 2, 5 × 10^k that is not above `value`; 1 for values that have none.
pub(super) fn round_down_125(value: f64) -> f64 {
    if !(value.is_normal() && value > 0.0) {
        return 1.0;
    }
    let power = libm::exp10((libm::log10(value) + 1e-12).floor());
    let mantissa = value / power * (1.0 + 1e-12);
    power * [5.0, 2.0].into_iter().find(|step| mantissa >= *step).unwrap_or(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    // Symptom: a force of 1e300 N was written with 300 digits. Expected: three, and the power of ten.
    #[test]
    fn short_numbers_are_short() {
        let written =
            [0.0, -0.0, 1e300, -1.5e300, 1.234e6, 123_456.7, 12.345, 0.001_234, 1e-9, 1.5e-12].map(short);
        let expected =
            ["0", "0", "1e300", "-1.5e300", "1.23e6", "123457", "12.3", "0.00123", "0.000000001", "1.5e-12"];
        assert_eq!(written, expected);
    }

    #[test]
    fn scales_are_written_with_their_one_digit() {
        let written = [1e-20, 1e-4, 0.05, 1.0 / 0.2, 2e5, 1.0 / 5e-10, 1.0 / 1e-21].map(one_digit);
        assert_eq!(written, ["1e-20", "0.0001", "0.05", "5", "200000", "2e9", "1e21"]);
    }
}
