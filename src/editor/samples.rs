//! The scenes that are built in, so that they open wherever the program was installed.

/// What a sample is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampleGroup {
    /// Shows one thing the simulation does; in `scenes/`.
    Introduction,
    /// A numerical difficulty with a known answer; in `scenes/hard/`, see `docs/accuracy.md`.
    HardCase,
}

/// A built-in scene.
pub struct Sample {
    /// File name in the group's folder, without `.xml`.
    pub id: &'static str,
    pub group: SampleGroup,
    pub title: &'static str,
    /// What to see in it.
    pub shows: &'static str,
    pub bytes: &'static [u8],
}

macro_rules! sample {
    ($id:literal, $title:literal, $shows:literal) => {
        sample!(Introduction, "", $id, $title, $shows)
    };
    ($group:ident, $folder:literal, $id:literal, $title:literal, $shows:literal) => {
        Sample {
            id: $id,
            group: SampleGroup::$group,
            title: $title,
            shows: $shows,
            bytes: include_bytes!(concat!("../../scenes/", $folder, $id, ".xml")),
        }
    };
}

macro_rules! hard {
    ($id:literal, $title:literal, $shows:literal) => {
        sample!(HardCase, "hard/", $id, $title, $shows)
    };
}

/// All samples, in menu order. Every file of `scenes/` and `scenes/hard/` is here.
pub const SAMPLES: &[Sample] = &[
    sample!("thesis-appendix-2", "Thesis scene", "Three spheres in a closed box under two kinds of gravity"),
    sample!("bounce", "Bounce", "A ball that loses nothing comes back to the same height"),
    sample!("rest", "Rest", "Infinitely many bounces end at a finite time"),
    sample!("slide", "Slide", "Bounces die out and the ball slides on"),
    sample!("incline", "Incline", "Balls that roll, slide, and slide until they roll"),
    sample!("dome", "Dome", "A rough, a smooth and a slippery ball run down a fixed one"),
    sample!("billiards", "Billiards", "Follow, stun and draw on a cloth"),
    sample!("bank-shot", "Bank shots", "Side spin turns a ball at the cushions"),
    sample!("jump-shot", "Jump shot", "Struck down, a ball jumps over the one in its way"),
    sample!("break-on-cloth", "Break on cloth", "Fifteen balls roll, rub and come to rest"),
    sample!("bowling", "Bowling", "Side spin lets a ball hook on an oiled lane"),
    sample!("superball", "Superball", "Thrown under a table, it comes back"),
    sample!("bowl", "Bowl", "Balls roll round over the flat faces of a bowl"),
    sample!("cradle", "Newton's cradle", "A row of touching balls, resolved in one instant"),
    sample!("counting-pi", "Counting π", "The number of collisions gives the digits of π"),
    sample!("orbit", "Orbit", "A Kepler ellipse that must not turn"),
    sample!("drag", "Air drag", "Terminal speed; a Version 1.1 file"),
    sample!("bullet", "Bullets", "Nothing tunnels at 1000 m/s"),
    sample!("gas", "Gas", "A hundred balls, thousands of collisions, no energy lost"),
    sample!("bin", "Bin", "Thirty balls drop into a bin and come to rest as a heap"),
    sample!("hopper", "Hopper", "Sixty balls run through a slot into a box"),
    sample!("galton", "Galton's board", "Pegs send balls left or right into bins"),
    sample!(
        "galton-rough",
        "Galton's board, rough",
        "The same with friction: balls turn, and heaps are steeper"
    ),
    sample!("pyramid-hit", "Pyramid hit", "A ball runs into a pyramid of thirty"),
    sample!("masses", "Mixed masses", "From ten grams to ten tonnes in one heap"),
    sample!("heap-in-space", "Heap in space", "Balls pile up around a sphere that attracts them"),
    sample!("pour-1000", "Pour of 1000", "A thousand balls splash into a box and settle"),
    sample!("pour-5000", "Pour of 5000", "The same with five thousand"),
    hard!("throw", "Throw", "A parabola to the last digits, at any step"),
    hard!("cradle-2", "Cradle, two incoming", "Two balls run into a row of five; two must leave it"),
    hard!("cradle-3", "Cradle, three incoming", "Three balls run into a row of five; three must leave it"),
    hard!("billiard-break", "Billiard break", "Keeps its mirror symmetry and its energy"),
    hard!("bullets", "Bullets at edges and angles", "1000 m/s at faces, edges, a corner and flat angles"),
    hard!("counting-pi-1", "Counting π to 2 digits", "31 collisions"),
    hard!("counting-pi-3", "Counting π to 4 digits", "3141 collisions"),
    hard!("counting-pi-4", "Counting π to 5 digits", "31415 collisions, some of them 10 ns apart"),
    hard!("gas-1000", "Gas of 1000 balls", "2000 collisions a second, no energy lost"),
    hard!("kepler-comet", "Comet", "An orbit of eccentricity 0.99"),
    hard!("plunge", "Dead centre", "A fall straight into a point attractor, and back"),
    hard!("grazing", "Grazing passes", "Hits and misses by one part in 10⁹"),
    hard!("corner-two", "Corner of two walls", "Both are hit in the same instant"),
    hard!("corner-three", "Corner of three walls", "All are hit in the same instant"),
    hard!("corner-angles", "Wedges of other angles", "Hit in their middle, they send a ball straight back"),
    hard!("wedge-jam", "Jam in a wedge", "Bounces between converging planes until it lies in both"),
    hard!("v-groove", "Slide in a groove", "Falls into a V and slides along it"),
    hard!("plate-edge", "Over the edge", "Slides off a plate and turns round its edge"),
    hard!("collapse", "Inelastic collapse", "Infinitely many impacts of three balls in a finite time"),
    hard!("stack-2", "Two balls in a stack", "Bounce on each other and come to rest"),
    hard!("stack-3", "Three balls in a stack", "Fall on each other without bouncing"),
    hard!("pyramid-4", "Pyramid of four", "One ball comes to rest on three, without bouncing"),
    hard!("pyramid-4-bouncy", "Pyramid of four, bouncing", "One ball comes to rest on three"),
    hard!("pyramid-6", "Flat pyramid of six", "Rows of three, two and one between two walls"),
    hard!("near", "Twin at the origin", "Compare with the scene far away"),
    hard!("far", "Far from the origin", "The twin's motion, 100 km away"),
    hard!("overlap", "Overlaps at the start", "Approaching, parting and still"),
    hard!("overlap-resting", "Overlaps at rest", "Sunk into each other under gravity"),
    hard!("leaves-map", "Out of the map", "Beyond the tiles everything goes on"),
];
