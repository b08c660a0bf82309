//! One binary with all integration tests: it links once. Each module holds one contract.

// The rules of the source tree: layers, file sizes, function sizes.
mod layering;
