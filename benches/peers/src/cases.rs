//! The scenes that are measured: a row each.

use std::path::Path;

use polyscene::scene::{Document, Scene};

use crate::peer::RATES;
use crate::reference::Reference;
use crate::scenes::gas;

pub struct Case {
    pub name: &'static str,
    pub scene: Scene,
    /// Model time that is simulated, s.
    pub until: f64,
    pub reference: Reference,
    /// How many times less time than rapier3d at 1/240 s PolyScene must need; `None` where nothing is promised.
    pub promised: Option<f64>,
    /// Rapier's steps per second.
    pub rates: &'static [f64],
    /// Timings, of which the median counts.
    pub repeats: usize,
}

/// A scene file under `scenes/` and what is asked of it.
struct Row(&'static str, &'static str, f64, Reference);

#[rustfmt::skip]
const FILES: [Row; 6] = [
    Row("ballistic", "hard/throw.xml", 10.0, Reference::Throw),
    Row("bounce", "bounce.xml", 20.0, Reference::Bounce),
    Row("cradle", "cradle.xml", 20.0, Reference::Row),
    Row("cradle, 3 balls", "hard/cradle-3.xml", 20.0, Reference::Row),
    Row("kepler e=0.6", "orbit.xml", 80.0, Reference::Kepler),
    Row("counting pi", "counting-pi.xml", 8.0, Reference::Pi),
];

pub fn all() -> Result<Vec<Case>, String> {
    let mut cases = Vec::new();
    for Row(name, file, until, reference) in FILES {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(file);
        let document = Document::open(&path);
        let scene = document.scene().cloned().ok_or_else(|| format!("{} does not load", path.display()))?;
        cases.push(Case { name, scene, until, reference, promised: Some(10.0), rates: &RATES, repeats: 7 });
    }
    let gases = [
        ("gas 1000, 0.1", 1000, 0.1, 2.0),
        ("gas 1000, 0.3", 1000, 0.3, 1.0),
        ("gas 10000, 0.1", 10_000, 0.1, 0.5),
        ("gas 10000, 0.3", 10_000, 0.3, 0.25),
    ];
    for (name, count, packing, until) in gases {
        cases.push(Case {
            name,
            scene: gas(count, packing),
            until,
            reference: Reference::None,
            promised: None,
            rates: &RATES[..2],
            repeats: 3,
        });
    }
    Ok(cases)
}
