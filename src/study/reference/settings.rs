//! How the reference works, and where it has to give up.

/// How the reference works. Two runs with different settings show how far it can be trusted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceSettings {
    /// Longest way of a body in one step, over its radius. Pairs are looked at four times on that way.
    pub stride: f64,
    /// Change of the last two columns of the extrapolation over the size of the step's own change.
    pub tolerance: f64,
    /// Impacts of the same instant are taken in the order of the file, or in the opposite one. Where that
    /// changes what follows, the scene asks for a rule that the reference does not know.
    pub last_first: bool,
}

impl Default for ReferenceSettings {
    fn default() -> Self {
        Self { stride: 0.2, tolerance: 1e-14, last_first: false }
    }
}

impl ReferenceSettings {
    /// Another way to the same result, to compare with: what differs is the reference's own error.
    pub fn check() -> Self {
        Self { stride: 0.13, tolerance: 2e-14, last_first: true }
    }
}

/// Why the reference cannot go on. What it has found until then stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum End {
    /// Bounces are about to end in rest or in a slide along the surface.
    #[error("two bodies stay in contact")]
    LastingContact,
    /// A ball that lies on a face meets another body: what the three exchange at once is laid down by a rule, such as that of
    /// the core, which this one must not share.
    #[error("a ball that lies on a face meets another body, for which it has no rule")]
    MetOnFace,
    /// A ball on a face is lifted from it, or comes to its edge.
    #[error("a ball leaves the face that it lay on")]
    LeftFace,
    /// A ball that rolls begins to slip.
    #[error("a ball that rolled on a face begins to slip")]
    SlippedAnew,
    /// A force or a speed became infinite.
    #[error("a number is no longer finite")]
    NotFinite,
}

/// A scene that the reference cannot simulate.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the reference does not know {what} (body {label})")]
pub struct Unsupported {
    pub label: String,
    pub what: String,
}
