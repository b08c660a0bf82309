//! PolyScene: design 3D rigid body scenes, step their simulation event by event, and see how
//! accurate every step is. This file is the list of layers; ARCHITECTURE.md tells what each is for.

pub mod cli;
pub mod design;
#[cfg(feature = "gui")]
pub mod editor;
pub mod export;
#[cfg(feature = "gui")]
pub mod gui;
pub mod import;
pub mod random;
pub mod record;
#[cfg(feature = "render")]
pub mod render;
pub mod scene;
pub mod sim;
pub mod study;
pub mod view;

/// The examples of the README, as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
