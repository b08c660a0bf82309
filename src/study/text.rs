//! Numbers as a person would write them.

/// Three significant digits, with an exponent where there would be many zeros.
pub fn short(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 {
        return "0".into();
    }
    if !(1e-3..1e5).contains(&size) {
        let text = format!("{value:.2e}");
        // 1.00e-6 says no more than 1e-6.
        return text.replace(".00e", "e").replace("0e", "e");
    }
    let decimals = (2 - libm::floor(libm::log10(size)) as i32).max(0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}

/// A time with its unit: `1/60 s` for a fraction of a second, `0.05 s` else.
pub fn seconds(time: f64) -> String {
    let rate = 1.0 / time;
    let is_fraction = rate >= 2.0 && (rate - rate.round()).abs() < 1e-9 * rate;
    let is_decimal = short(time).parse() == Ok(time);
    if is_fraction && !is_decimal { format!("1/{} s", rate.round()) } else { format!("{} s", short(time)) }
}
