//! What can be wrong with the file of a recording.

/// Version of the format that is written and read.
pub(super) const VERSION: u32 = 1;

/// Why a recording cannot be used, and the way out.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RecordingError {
    #[error(
        "this is not a recording: {0}; a recording (.psrec) is what `polyscene record` or the editor saves"
    )]
    Foreign(String),
    #[error("this recording cannot be read: {0}; {DAMAGED}")]
    Malformed(String),
    #[error("it is of version {0}, and this program reads version {VERSION}; a newer program may read it")]
    Version(u32),
    #[error("its scene has errors: {0}; {DAMAGED}")]
    Scene(String),
    #[error("{0}; {DAMAGED}")]
    Content(String),
}

/// A scene is recorded without errors, so that whatever is wrong became so later.
const DAMAGED: &str = "the file is damaged: record again (`polyscene record`), or ask for another copy of it";
