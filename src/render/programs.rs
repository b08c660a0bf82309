//! The shader programs, compiled once per context from `assets/shaders`.

use three_d::{Context, Program};

use super::RenderError;

pub(super) struct Programs {
    pub background: Program,
    pub sphere: Program,
    pub bead: Program,
    pub plate: Program,
    pub stroke: Program,
    pub point: Program,
}

macro_rules! shader {
    ($name:literal) => {
        (
            include_str!(concat!("../../assets/shaders/", $name, ".vert")),
            include_str!(concat!("../../assets/shaders/", $name, ".frag")),
        )
    };
}

impl Programs {
    pub fn new(context: &Context) -> Result<Self, RenderError> {
        let compile = |(vertex, fragment): (&str, &str)| Program::from_source(context, vertex, fragment);
        Ok(Self {
            background: compile(shader!("background"))?,
            sphere: compile(shader!("sphere"))?,
            bead: compile(shader!("bead"))?,
            plate: compile(shader!("plate"))?,
            stroke: compile(shader!("stroke"))?,
            point: compile(shader!("point"))?,
        })
    }
}
