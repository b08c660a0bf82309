//! Why the window cannot be opened or a picture of it cannot be taken.

/// Every failure of this layer.
#[derive(Debug, thiserror::Error)]
pub enum GuiError {
    /// There is no display, or no OpenGL on it.
    #[error("{0}")]
    NoWindow(String),
    /// A script asked for something that cannot be done.
    #[error("{0}")]
    Script(String),
    /// The scene of a script cannot be opened or has errors.
    #[error("{0}")]
    Scene(String),
}
