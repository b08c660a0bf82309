//! Numbers of the command line, and complaints that name the way out.

/// Seconds: a finite number above 0, or a fraction such as `1/60`.
pub fn seconds(text: &str) -> Result<f64, String> {
    let value = match text.split_once('/') {
        Some((top, bottom)) => number(top)? / number(bottom)?,
        None => number(text)?,
    };
    if !value.is_finite() {
        Err("must be a finite number of seconds".into())
    } else if value <= 0.0 {
        Err("must be more than 0 seconds".into())
    } else {
        Ok(value)
    }
}

fn number(text: &str) -> Result<f64, String> {
    text.trim().parse().map_err(|_| {
        if text.contains(',') {
            "the command line takes a decimal point, not a comma".into()
        } else {
            "expected seconds, such as 0.01, 1e-3 or 1/60".into()
        }
    })
}

/// A width and a height, such as `1600x1000`.
pub(super) fn size(text: &str) -> Result<[u32; 2], String> {
    const MOST: u32 = 16_384;
    let parsed = text.split_once(['x', 'X', '×']).and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    match parsed {
        Some([width, height]) if (16..=MOST).contains(&width) && (16..=MOST).contains(&height) => {
            Ok([width, height])
        }
        Some(_) => Err(format!("each side must be from 16 to {MOST} pixels")),
        None => Err("expected a width and a height, such as 1600x1000".into()),
    }
}
