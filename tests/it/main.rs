//! One binary with all integration tests: it links once. Each module holds one contract.

#![allow(
    clippy::approx_constant,
    clippy::disallowed_methods,
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    reason = "a test fails by stopping; expected values need not be the same bits everywhere; files round pi"
)]

// The command table: unique names and keys, reasons for what is disabled.
mod editor_commands;

// Opening, saving, samples and the guards against losing or overwriting work.
mod editor_files;

// What an edit means for a simulation that runs.
mod editor_live;

// Selection, inspector fields, problems, new objects, clipboard, typed numbers.
mod editor_model;

// Unsaved work outlives a crash.
mod editor_recovery;

// A session with a runner that writes down what it is told.
mod editor_support;

// Undo: one point per gesture, the document alone.
mod editor_undo;

// The rules of the source tree: layers, file sizes, function sizes.
mod layering;
// Pictures drawn in software without a window: silhouettes against their areas, depth order, caching.
mod render_pictures;
// The verb `render` through the real program: pictures of every scene, and ways in which it ends badly.
mod render_verb;
// Edits: the bytes each changes, what it refuses, keys.
mod scene_edit;
// The reader: values, defaults, labels, places.
mod scene_read;
// Cameras: rays against projections, framing, zoom to the cursor, the six axis views.
mod view_camera;
// Dragging and snapping, round lengths and short numbers, trails.
mod view_drag;
// Draw lists: what is in them, precision far from the origin, overlays, when they are built anew.
mod view_draw_list;
// Picking against brute force; what is hidden or see-through is passed over.
mod view_pick;
// Scenes that the tests of views and pictures share.
mod view_scenes;
// Which walls of a closed box are glass, from everywhere.
mod view_see_through;

// Runners: the Δt grid, going back, edits with their stamps, playing.
mod record_runner;
