//! What many tests share: scenes built in code or loaded from `scenes/`, ways of driving a simulation,
//! and the naive reference.

pub mod build;
pub mod contact_scenes;
pub mod drive;
pub mod heaps;
pub mod load;
pub mod reference;
