//! Names that another program takes: unique, and without what it reserves.

use rustc_hash::FxHashSet;

use crate::scene::{Body, Names, Scene, escaped};

/// A name for each body, unique, none of `reserved`.
pub(super) fn unique(scene: &Scene, reserved: &[&str], clean: fn(&str) -> String) -> Vec<String> {
    let mut names = Names::new(reserved.iter().copied());
    scene.bodies.iter().map(|body| names.take(&clean(&escaped(name_of(body))))).collect()
}

/// An identifier for each body: letters, digits and `_`, unique.
pub(super) fn identifiers(scene: &Scene) -> Vec<String> {
    let mut taken = FxHashSet::default();
    let identifier = |(index, name): (usize, &str)| {
        let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
        let mut text: String = name.chars().map(plain).collect();
        if !text.starts_with(|c: char| c.is_ascii_alphabetic()) {
            text.insert_str(0, "body");
        }
        // Only names that were taken end in a number after `_`, and each in one of its own.
        let numbered = text.rsplit_once('_').is_some_and(|(_, end)| end.bytes().all(|b| b.is_ascii_digit()));
        if numbered || !taken.insert(text.clone()) {
            text.push_str(&format!("_{index}"));
        }
        text
    };
    scene.bodies.iter().map(name_of).enumerate().map(identifier).collect()
}

/// A name of blanks is none.
fn name_of(body: &Body) -> &str {
    body.name.as_deref().filter(|name| !name.trim().is_empty()).unwrap_or(&body.label)
}
