//! Why a picture cannot be drawn.

/// Every failure of this layer.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// No windowless OpenGL.
    #[error(
        "no OpenGL without a window: {0}; install libegl1, libegl-mesa0 and libgl1-mesa-dri \
         (apt-get install libegl1 libegl-mesa0 libgl1-mesa-dri)"
    )]
    NoContext(String),
    /// The driver refused something.
    #[error("OpenGL: {0}")]
    Gl(String),
    /// The font that comes with the program cannot be read.
    #[error("the built-in font cannot be read")]
    Font,
    #[error("a picture of {0}×{1} pixels cannot be drawn; the driver's limit is {2}×{2}")]
    Size(u32, u32, u32),
}

impl From<three_d::CoreError> for RenderError {
    fn from(error: three_d::CoreError) -> Self {
        Self::Gl(error.to_string())
    }
}
