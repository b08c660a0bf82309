//! Where in its file a recording says what it says.

use serde::Deserialize;
use serde_json::value::RawValue;

/// The checkpoints as they are written.
#[derive(Deserialize)]
struct Written<'a> {
    #[serde(borrow)]
    checkpoints: Vec<&'a RawValue>,
}

/// The line that each checkpoint begins in, from 1.
pub(super) fn of_checkpoints(bytes: &[u8]) -> serde_json::Result<Vec<usize>> {
    let written: Written<'_> = serde_json::from_slice(bytes)?;
    let (mut line, mut seen) = (1, 0);
    let lines = written.checkpoints.iter().map(|checkpoint| {
        // They are parts of the bytes, one after the other.
        let at = (checkpoint.get().as_ptr() as usize).saturating_sub(bytes.as_ptr() as usize);
        line += bytes.get(seen..at).unwrap_or_default().iter().filter(|byte| **byte == b'\n').count();
        seen = at;
        line
    });
    Ok(lines.collect())
}
