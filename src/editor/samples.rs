//! The scenes that are built in, so that they open wherever the program was installed.

/// A built-in scene.
pub struct Sample {
    /// File name in `scenes/`, without `.xml`.
    pub id: &'static str,
    pub title: &'static str,
    /// What to see in it.
    pub shows: &'static str,
    pub bytes: &'static [u8],
}

macro_rules! sample {
    ($id:literal, $title:literal, $shows:literal) => {
        Sample {
            id: $id,
            title: $title,
            shows: $shows,
            bytes: include_bytes!(concat!("../../scenes/", $id, ".xml")),
        }
    };
}

/// All samples, in menu order. Every file of `scenes/` is here.
pub const SAMPLES: &[Sample] = &[
    sample!("thesis-appendix-2", "Thesis scene", "Three spheres in a closed box under two kinds of gravity"),
    sample!("bounce", "Bounce", "A ball that loses nothing comes back to the same height"),
    sample!("rest", "Rest", "Infinitely many bounces end at a finite time"),
    sample!("slide", "Slide", "Bounces die out and the ball slides on"),
    sample!("cradle", "Newton's cradle", "A row of touching balls, resolved in one instant"),
    sample!("counting-pi", "Counting π", "The number of collisions gives the digits of π"),
    sample!("orbit", "Orbit", "A Kepler ellipse that must not turn"),
    sample!("drag", "Air drag", "Terminal speed; a Version 1.1 file"),
    sample!("bullet", "Bullets", "Nothing tunnels at 1000 m/s"),
    sample!("gas", "Gas", "A hundred balls, thousands of collisions, no energy lost"),
];
