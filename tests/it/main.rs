//! One binary with all integration tests: it links once. Each module holds one contract.

#![allow(
    clippy::approx_constant,
    clippy::disallowed_methods,
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    reason = "a test fails by stopping; expected values need not be the same bits everywhere; files round pi"
)]

// The rules of the source tree: layers, file sizes, function sizes.
mod layering;

// The reader: values, defaults, labels, places.
mod scene_read;
