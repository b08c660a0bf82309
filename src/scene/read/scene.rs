//! The whole document's meaning, put together from what its elements mean by themselves.

use std::sync::Arc;

use super::feature::FeatureCounts;
use super::item::{Item, ItemReading};
use super::log::{Log, place_in};
use super::problem::{Limited, Problem};
use super::{map, simulation};
use crate::scene::ids::{Label, Labels};
use crate::scene::rules::MAX_ITEMS;
use crate::scene::source::Source;
use crate::scene::tree::{Children, View};
use crate::scene::{BodyList, Diagnostic, NodeKey, Scene, Severity, SimParams, locate, shown};

/// What a document says.
#[derive(Debug, Default)]
pub(in crate::scene) struct Meaning {
    pub scene: Option<Arc<Scene>>,
    pub diagnostics: Vec<Diagnostic>,
    pub features: FeatureCounts,
}

/// Reads a well-formed document.
pub(in crate::scene) fn read(source: &Source, top: &Children) -> Meaning {
    let mut reader = Reader::default();
    let Some(root) = locate::root(top, &source.text) else { return Meaning::default() };
    let scene = reader.root(root, source.contradiction.as_deref()).map(Arc::new);
    let diagnostics = reader.diagnostics(source);
    Meaning { scene, diagnostics, features: reader.features }
}

/// A problem with its full path and the element to select.
struct Placed {
    problem: Problem,
    key: NodeKey,
}

#[derive(Default)]
struct Reader {
    problems: Limited<Placed>,
    features: FeatureCounts,
}

impl Reader {
    fn root(&mut self, root: View<'_>, contradiction: Option<&str>) -> Option<Scene> {
        let mut log = Log::default();
        if root.name() != "PolyPhysicsXml" {
            let message = format!("the root element is {}, not PolyPhysicsXml", shown(root.name()));
            log.error(root.place(), message, "this is not a scene, or its root was renamed");
            self.take(&log.problems, "", root);
            return None;
        }
        if let Some(contradiction) = contradiction {
            log.warn(Some(0), contradiction, "the bytes count; correct the declaration");
        }
        log.check_attributes(root, &["Version"]);
        let version = version(root, &mut log);
        let [map, simulation, primitives] = log.children(root, ["Map", "Simulation", "Primitives"]);
        if map.is_none() {
            let hint =
                "write <Map><Size X=\"10\" Y=\"10\" Z=\"10\" /><Tiles X=\"10\" Y=\"10\" Z=\"10\" /></Map>";
            log.error(root.place(), "there is no Map", hint);
        }
        self.take(&log.problems, "/PolyPhysicsXml", root);
        let map = map.map(|el| self.section(el, |log| map::read(el, log)));
        let mut scene = Scene {
            map: map.unwrap_or(map::FALLBACK),
            time_speed: 1.0,
            params: SimParams::default(),
            forces: Vec::new(),
            bodies: BodyList::new(),
        };
        if let Some(el) = simulation {
            self.simulation(el, &mut scene);
        }
        if let Some(el) = primitives {
            self.bodies(el, &mut scene);
        }
        self.check_version(root, version);
        map.map(|_| scene)
    }

    fn simulation(&mut self, el: View<'_>, scene: &mut Scene) {
        let (speed, params, forces) = self.section(el, |log| {
            log.check_attributes(el, &[]);
            let [speed, forces, solver] = log.children(el, ["TimeSpeed", "Forces", "Solver"]);
            let speed = simulation::time_speed(speed, log);
            (speed, (simulation::params(solver, log), solver), forces)
        });
        scene.time_speed = speed;
        scene.params = params.0;
        if let Some(solver) = params.1 {
            self.features.add(("Solver", solver.place()));
        }
        if let Some(forces) = forces {
            self.forces(forces, scene);
        }
    }

    fn forces(&mut self, el: View<'_>, scene: &mut Scene) {
        let path = "/PolyPhysicsXml/Simulation/Forces";
        self.list(el, path, ItemReading::of_force, |item, label| {
            if let Item::Force(force) = item {
                let (id, label) = (label.id, label.text());
                scene.forces.push(crate::scene::Force { id, label, ..(**force).clone() });
            }
        });
    }

    fn bodies(&mut self, el: View<'_>, scene: &mut Scene) {
        // The other half is white space.
        scene.bodies.reserve(el.node.children(el.source).len() / 2);
        self.list(el, "/PolyPhysicsXml/Primitives", ItemReading::of_body, |item, label| {
            if let Item::Body(body) = item {
                let is_shared = label.repeat == 1 && body.id == label.id && !body.label.is_empty();
                let renamed =
                    || Arc::new(crate::scene::Body { id: label.id, label: label.text(), ..(**body).clone() });
                let body = if is_shared { body.clone() } else { renamed() };
                scene.bodies.push(body);
            }
        });
    }

    /// Reads a list of bodies or of forces, each with the label that is unique in the list.
    fn list<'a>(
        &mut self,
        el: View<'a>,
        path: &str,
        read: fn(View<'_>) -> ItemReading,
        mut add: impl FnMut(&Item, Label),
    ) {
        let mut log = Log::default();
        log.check_attributes(el, &[]);
        log.check_text(el);
        if let Some(surplus) = el.elements().nth(MAX_ITEMS) {
            let message = format!("there are more than {MAX_ITEMS} elements; the rest is not read");
            log.error(surplus.place(), message, "divide the scene");
        }
        self.take(&log.problems, path, el);
        let reading_of = |el: View<'a>| {
            el.node.reading.get_or_init(|| {
                let node = &el.node.unfolded(el.source);
                Arc::new(read(View { node, source: el.source }))
            })
        };
        let items = el.elements().take(MAX_ITEMS).map(|el| (el, reading_of(el)));
        let mut labels = Labels::of(&items.clone().map(|(_, reading)| reading.id));
        for (el, reading) in items {
            if matches!(reading.item, Item::Unknown) {
                self.take(reading.problems(), path, el);
                continue;
            }
            let label = labels.next(reading.id);
            reading.uses().iter().for_each(|&used| self.features.add(used));
            let mut log = Log::default();
            self.check_id(&mut log, el, reading, label);
            if !(log.problems.is_empty() && reading.problems().is_empty()) {
                let path = format!("{path}/{}[{}]", el.name(), label.text());
                self.take(reading.problems(), &path, el);
                self.take(&log.problems, &path, el);
            }
            add(&reading.item, label);
        }
    }

    fn check_id<'a>(&self, log: &mut Log<'a>, el: View<'a>, reading: &ItemReading, label: Label) {
        if reading.id.is_none() && el.attribute("UserID").is_none() {
            let message = format!("there is no UserID; {} is used", label.id);
            log.warn(el.place(), message, "write UserID=\"…\" to keep it");
        } else if label.repeat > 1 {
            let at = el.attribute("UserID").and_then(|attr| place_in(el, attr.value.start));
            let message = format!("UserID {} is used before; this one is called {}", label.id, label.text());
            log.warn(at, message, "make the IDs unique");
        }
    }

    /// Reads a direct child of the root.
    fn section<'a, R>(&mut self, el: View<'a>, read: impl FnOnce(&mut Log<'a>) -> R) -> R {
        let mut log = Log::default();
        let result = read(&mut log);
        self.take(&log.problems, &format!("/PolyPhysicsXml/{}", el.name()), el);
        result
    }

    fn check_version(&mut self, root: View<'_>, version: Option<(u32, u32)>) {
        if version != Some((1, 0)) {
            return;
        }
        let mut log = Log::default();
        for (name, count, first) in self.features.used() {
            let times = if count > 1 { format!(" ({count} uses)") } else { String::new() };
            let message = format!("{name} is new in format 1.1, but the file says Version 1.0{times}");
            log.warn(first.or(root.place()), message, "write Version=\"1.1\"");
        }
        self.take(&log.problems, "/PolyPhysicsXml", root);
    }

    fn take(&mut self, problems: &Limited<Problem>, path: &str, el: View<'_>) {
        for problem in &problems.kept {
            self.problems.add(problem.severity, || {
                let path = format!("{path}{}", problem.path);
                Placed { problem: Problem { path, ..problem.clone() }, key: el.node.key }
            });
        }
        self.problems.add_beyond(problems);
    }

    /// All problems by place, the first of each severity in full and the rest as a number.
    fn diagnostics(&mut self, source: &Source) -> Vec<Diagnostic> {
        self.problems.kept.sort_by_key(|placed| placed.problem.at.unwrap_or(u32::MAX));
        let kept = self.problems.kept.drain(..).map(|Placed { problem, key }| Diagnostic {
            severity: problem.severity,
            position: problem.at.map(|at| source.position(at as usize)),
            path: problem.path,
            message: problem.message,
            hint: problem.hint,
            key: Some(key),
        });
        let mut diagnostics = kept.collect::<Vec<_>>();
        for severity in [Severity::Error, Severity::Warning] {
            let more = self.problems.beyond(severity);
            if more > 0 {
                let (message, path, hint) =
                    (format!("and {more} more {severity}s"), String::new(), String::new());
                diagnostics.push(Diagnostic { severity, position: None, path, message, hint, key: None });
            }
        }
        diagnostics
    }
}

/// Reads `Version`; `None` if it is unusable.
fn version<'a>(root: View<'a>, log: &mut Log<'a>) -> Option<(u32, u32)> {
    let Some(attr) = root.attribute("Version") else {
        log.warn(root.place(), "there is no Version; 1.0 is assumed", "write Version=\"1.0\"");
        return Some((1, 0));
    };
    let at = place_in(root, attr.value.start);
    let value = root.value("Version").unwrap_or_default();
    let (major, minor) = value.trim().split_once(['.', ',']).unwrap_or((value.trim(), "0"));
    let (Ok(major), Ok(minor)) = (major.parse(), minor.parse()) else {
        log.error(at, format!("Version=\"{}\" is not a version", shown(&value)), "write 1.0 or 1.1");
        return None;
    };
    if major != 1 {
        let message = format!("version {major}.{minor} of the format is not known");
        log.error(at, message, "this program reads 1.0 and 1.1");
    } else if minor > 1 {
        let message = format!("version {major}.{minor} of the format is newer than this program");
        log.warn(at, message, "what it does not know is kept but has no effect");
    }
    Some((major, minor))
}
