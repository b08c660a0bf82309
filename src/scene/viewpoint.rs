//! Saved viewpoints: `<?polyscene views="…"?>` inside the root, which other readers skip.
//!
//! One is `name|perspective|x y z|yaw pitch|height`, or `parallel`; lengths in m, angles in radians; several
//! are parted by `;`.

use glam::DVec3;

/// From where a scene is looked at, under a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Viewpoint {
    pub name: String,
    pub perspective: bool,
    /// What is in the middle, m.
    pub target: DVec3,
    /// Radians.
    pub yaw: f64,
    pub pitch: f64,
    /// Of what is seen at the target, m.
    pub height: f64,
}

/// The attribute of the instruction.
pub(super) const ATTRIBUTE: &str = "views";

/// What parts the fields of one and the viewpoints; no name has them.
const BETWEEN: [char; 2] = ['|', ';'];

/// Reads what [`write`] wrote. What is not understood is left out.
pub(super) fn read(text: &str) -> Vec<Viewpoint> {
    text.split(';').filter_map(read_one).collect()
}

fn read_one(text: &str) -> Option<Viewpoint> {
    let mut fields = text.split('|');
    let name = fields.next()?.trim().to_owned();
    let perspective = match fields.next()? {
        "perspective" => true,
        "parallel" => false,
        _ => return None,
    };
    let [x, y, z] = numbers(fields.next()?)?;
    let [yaw, pitch] = numbers(fields.next()?)?;
    let [height] = numbers(fields.next()?)?;
    Some(Viewpoint { name, perspective, target: DVec3::new(x, y, z), yaw, pitch, height })
}

fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let values: Option<Vec<f64>> =
        text.split_ascii_whitespace().map(|word| word.parse().ok().filter(|v: &f64| v.is_finite())).collect();
    values?.try_into().ok()
}

/// Writes viewpoints; `None` for none at all.
pub(super) fn write(viewpoints: &[Viewpoint]) -> Option<String> {
    let one = |viewpoint: &Viewpoint| {
        let Viewpoint { name, perspective, target, yaw, pitch, height } = viewpoint;
        let name = name.replace(BETWEEN, "/");
        let projection = if *perspective { "perspective" } else { "parallel" };
        let DVec3 { x, y, z } = target;
        format!("{}|{projection}|{x} {y} {z}|{yaw} {pitch}|{height}", name.trim())
    };
    (!viewpoints.is_empty()).then(|| viewpoints.iter().map(one).collect::<Vec<_>>().join(";"))
}
