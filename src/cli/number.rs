//! Numbers of the command line, and complaints that name the way out.

use crate::record::LATEST_TIME;

/// A length of time in seconds: above 0, see [`any_seconds`].
pub fn seconds(text: &str) -> Result<f64, String> {
    let value = any_seconds(text)?;
    if value > 0.0 { Ok(value) } else { Err("must be more than 0 seconds".into()) }
}

/// A part of something: a number or a fraction such as `1/2`, of any sign and size.
pub(super) fn part(text: &str) -> Result<f64, String> {
    let of = |text: &str| {
        text.trim()
            .parse::<f64>()
            .map_err(|_| "expected a number or a fraction, such as 0.5 or 1/2".to_owned())
    };
    match text.split_once('/') {
        Some((top, bottom)) => Ok(of(top)? / of(bottom)?),
        None => of(text),
    }
}

/// Seconds: a number of at most [`LATEST_TIME`], or a fraction such as `1/60`.
pub(super) fn any_seconds(text: &str) -> Result<f64, String> {
    let value = match text.split_once('/') {
        Some((top, bottom)) => number(top)? / number(bottom)?,
        None => number(text)?,
    };
    if !value.is_finite() {
        Err("must be a finite number of seconds".into())
    } else if value > LATEST_TIME {
        Err(format!("must be at most {LATEST_TIME:e} seconds, where time is resolved to 1e-7 s"))
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
