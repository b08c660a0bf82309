//! Colours: a calm palette for dark and light windows, and the colours of bodies that name none.

use crate::scene::{Body, Shape};

/// sRGB with straight alpha.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Color(pub [u8; 4]);

impl Color {
    /// Draws nothing.
    pub const NONE: Self = Self([0, 0, 0, 0]);

    pub const fn rgb(r: u8, g: u8, b: u8) -> Self {
        Self([r, g, b, 255])
    }

    pub const fn with_alpha(self, alpha: u8) -> Self {
        let [r, g, b, _] = self.0;
        Self([r, g, b, alpha])
    }

    /// This colour moved towards `other`: 0 stays, 1 is the other; alpha stays.
    pub fn mix(self, other: Self, amount: f32) -> Self {
        let channel = |i: usize| {
            let (a, b) = (f32::from(self.0[i]), f32::from(other.0[i]));
            (a + (b - a) * amount.clamp(0.0, 1.0)).round() as u8
        };
        Self([channel(0), channel(1), channel(2), self.0[3]])
    }

    pub fn is_opaque(self) -> bool {
        self.0[3] == 255
    }
}

/// Which of the two palettes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Theme {
    #[default]
    Dark,
    Light,
}

/// The colours of everything but the bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Palette {
    pub background: [Color; 2],
    pub text: Color,
    pub text_weak: Color,
    pub label_back: Color,
    pub selected: Color,
    pub hovered: Color,
    pub static_sphere: Color,
    /// Plates with the whole scene on one side of them stand back from plates inside the scene.
    pub wall: Color,
    pub plate: Color,
    pub plate_edge: Color,
    pub glass_edge: Color,
    pub map_box: Color,
    pub grid: Color,
    pub grid_major: Color,
    pub tile: Color,
    pub tile_dynamic: Color,
    pub contact: Color,
    pub velocity: Color,
    pub spin: Color,
    /// Of the circles on balls that turn.
    pub pattern: Color,
    pub force: Color,
    pub bounds: Color,
    pub highlight: Color,
    pub rest: Color,
    pub slide: Color,
    pub roll: Color,
    pub stepped: Color,
    pub chain: Color,
    pub measure: Color,
    pub axes: [Color; 3],
}

const DARK: Palette = Palette {
    background: [Color::rgb(44, 49, 57), Color::rgb(29, 32, 38)],
    text: Color::rgb(226, 230, 236),
    text_weak: Color::rgb(160, 168, 180),
    label_back: Color([24, 27, 32, 190]),
    selected: Color::rgb(255, 176, 46),
    hovered: Color::rgb(255, 255, 255),
    static_sphere: Color::rgb(138, 148, 163),
    wall: Color::rgb(78, 87, 101),
    plate: Color::rgb(150, 163, 184),
    plate_edge: Color::rgb(196, 206, 220),
    glass_edge: Color([140, 152, 172, 120]),
    map_box: Color::rgb(122, 134, 152),
    grid: Color([150, 164, 186, 46]),
    grid_major: Color([150, 164, 186, 100]),
    tile: Color([112, 150, 190, 70]),
    tile_dynamic: Color([120, 220, 232, 235]),
    contact: Color::rgb(255, 96, 92),
    velocity: Color::rgb(96, 214, 142),
    spin: Color::rgb(240, 130, 220),
    pattern: Color::rgb(24, 26, 30),
    force: Color::rgb(236, 130, 222),
    bounds: Color([220, 222, 140, 200]),
    highlight: Color::rgb(255, 235, 90),
    rest: Color::rgb(150, 200, 255),
    slide: Color::rgb(255, 205, 120),
    roll: Color::rgb(120, 205, 245),
    stepped: Color::rgb(190, 150, 255),
    chain: Color::rgb(255, 250, 236),
    measure: Color::rgb(120, 232, 214),
    axes: [Color::rgb(240, 92, 92), Color::rgb(112, 208, 96), Color::rgb(92, 150, 255)],
};

const LIGHT: Palette = Palette {
    background: [Color::rgb(247, 249, 252), Color::rgb(222, 227, 234)],
    text: Color::rgb(28, 32, 38),
    text_weak: Color::rgb(86, 94, 106),
    label_back: Color([250, 251, 253, 205]),
    selected: Color::rgb(214, 108, 0),
    hovered: Color::rgb(20, 24, 30),
    static_sphere: Color::rgb(146, 156, 172),
    wall: Color::rgb(206, 213, 223),
    plate: Color::rgb(150, 164, 186),
    plate_edge: Color::rgb(74, 86, 106),
    glass_edge: Color([90, 102, 122, 120]),
    map_box: Color::rgb(96, 106, 122),
    grid: Color([70, 82, 102, 48]),
    grid_major: Color([70, 82, 102, 105]),
    tile: Color([60, 110, 165, 70]),
    tile_dynamic: Color([0, 120, 150, 235]),
    contact: Color::rgb(208, 32, 36),
    velocity: Color::rgb(16, 132, 66),
    spin: Color::rgb(160, 30, 140),
    pattern: Color::rgb(250, 250, 250),
    force: Color::rgb(166, 40, 150),
    bounds: Color([120, 110, 0, 210]),
    highlight: Color::rgb(190, 120, 0),
    rest: Color::rgb(24, 96, 190),
    slide: Color::rgb(160, 92, 0),
    roll: Color::rgb(0, 104, 160),
    stepped: Color::rgb(110, 60, 190),
    chain: Color::rgb(16, 20, 28),
    measure: Color::rgb(0, 112, 104),
    axes: [Color::rgb(204, 38, 38), Color::rgb(38, 138, 28), Color::rgb(30, 86, 210)],
};

impl Theme {
    pub fn palette(self) -> &'static Palette {
        match self {
            Self::Dark => &DARK,
            Self::Light => &LIGHT,
        }
    }
}

/// Eight colours of like lightness that stay apart in the common kinds of colour blindness.
const BODY_COLORS: [Color; 8] = [
    Color::rgb(86, 156, 224),
    Color::rgb(232, 152, 74),
    Color::rgb(92, 184, 142),
    Color::rgb(206, 112, 168),
    Color::rgb(214, 194, 92),
    Color::rgb(142, 130, 220),
    Color::rgb(222, 108, 100),
    Color::rgb(112, 196, 212),
];

/// A body's colour: its own, else by its place among the dynamic bodies of the file.
pub fn body_color(body: &Body, nth_dynamic: usize, palette: &Palette) -> Color {
    match (body.color, body.is_dynamic(), &body.shape) {
        (Some([r, g, b]), _, _) => Color::rgb(r, g, b),
        (None, true, _) => BODY_COLORS[nth_dynamic % BODY_COLORS.len()],
        (None, false, Shape::Plane { .. }) => palette.plate,
        (None, false, _) => palette.static_sphere,
    }
}
