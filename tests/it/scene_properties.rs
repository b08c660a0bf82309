//! What holds for any input: no panic, the bytes come back, edits are undone, numbers keep their bits.

use glam::DVec3;
use polyscene::scene::{
    Body, BodyChange, Document, Edit, ForceChange, Motion, NodeKey, Roughness, Shape, Side, SimParams,
};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::Index;

use crate::scene_edit::same_meaning;
use crate::scene_read::{BALL, FORCES, WALL, read, scene_with};

fn plain() -> String {
    scene_with(FORCES, &format!("{BALL}{WALL}{BALL}"))
}

/// Pieces that break things when they land in the wrong place.
const SHARDS: [&str; 24] = [
    "<",
    ">",
    "/>",
    "</",
    "\"",
    "'",
    "&",
    "&lt;",
    "&#x41;",
    "<!--",
    "-->",
    "<![CDATA[",
    "]]>",
    "<?",
    "?>",
    "<!DOCTYPE a>",
    "<a>",
    "</a>",
    "<?polyscene",
    "NaN",
    ",",
    "\u{FEFF}",
    "\u{0}",
    "é",
];

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes_come_back_and_end_in_a_list_of_problems(bytes in vec(any::<u8>(), 0..200)) {
        let document = Document::from_bytes(&bytes);
        prop_assert!(document.has_errors());
        prop_assert_eq!(document.to_bytes(), bytes);
    }

    #[test]
    fn a_damaged_scene_comes_back_too(
        damage in vec((any::<Index>(), 0..30_usize, 0..SHARDS.len()), 1..4),
    ) {
        let mut text = plain();
        for (at, cut, shard) in damage {
            let boundary = |at: usize| (0..=at).rev().find(|at| text.is_char_boundary(*at)).unwrap();
            let start = boundary(at.index(text.len()));
            let end = boundary((start + cut).min(text.len()));
            text.replace_range(start..end, SHARDS[shard]);
        }
        let document = read(&text);
        prop_assert_eq!(document.to_bytes(), text.as_bytes());
        for key in (0..80).map(NodeKey) {
            document.place_of(key);
            for edit in [Edit::Delete { keys: vec![key] }, Edit::Duplicate { keys: vec![key], offset: DVec3::ONE }] {
                if let Ok(edited) = document.apply(&edit) {
                    prop_assert!(same_meaning(&edited.document, &Document::from_bytes(&edited.document.to_bytes())));
                }
            }
        }
    }

    #[test]
    fn numbers_keep_their_bits(bits in any::<u64>(), comma in any::<bool>()) {
        let value = f64::from_bits(bits);
        prop_assume!(value.is_finite());
        let text = if comma { plain() } else { plain().replace(',', ".") };
        let document = read(&text);
        let key = document.scene().unwrap().bodies[0].key;
        let position = DVec3::new(value, -value, value / 3.0);
        let edit = Edit::Body { key, change: BodyChange::Position(position) };
        let bytes = document.apply(&edit).unwrap().document.to_bytes();
        let again = Document::from_bytes(&bytes);
        let read = again.scene().unwrap().bodies[0].position;
        prop_assert_eq!(read.to_array().map(f64::to_bits), position.to_array().map(f64::to_bits));
        let other = if comma { b'.' } else { b',' };
        prop_assert_eq!(bytes.contains(&other), comma && text.contains("1.0"));
    }

    #[test]
    fn what_is_read_as_a_number_is_what_rust_reads(text in "[-+]?[0-9]{0,4}[.,]?[0-9]{0,3}([eE][-+]?[0-9]{0,2})?") {
        let scene = plain().replace("F32=\"0,5\"", &format!("F32=\"{text}\""));
        let document = read(&scene);
        let body = &document.scene().unwrap().bodies[0];
        match text.replace(',', ".").parse::<f64>() {
            Ok(value) if value.is_finite() && value >= 0.0 => prop_assert_eq!(body.bounce, value),
            _ => prop_assert!(document.has_errors()),
        }
    }

    #[test]
    fn edits_agree_with_reading_their_bytes_and_are_undone(steps in vec(step(), 1..12), style in 0..4_usize) {
        let text = match style {
            0 => plain(),
            1 => plain().replace('\n', "\r\n").replace("  ", "\t"),
            2 => plain().lines().map(str::trim).collect(),
            _ => plain().replace('"', "'").replace(" />", "/>").replace(',', "."),
        };
        let mut history = vec![read(&text)];
        let mut seen = keys(&history[0]);
        for step in steps {
            let now = history.last().unwrap();
            let edit = step.edit(now);
            let Ok(edited) = now.apply(&edit) else { continue };
            let again = Document::from_bytes(&edited.document.to_bytes());
            prop_assert!(same_meaning(&edited.document, &again), "{edit:?}");
            for key in &edited.added {
                prop_assert!(!seen.contains(key), "{key:?} is given twice");
            }
            seen.extend(keys(&edited.document));
            history.push(edited.document);
        }
        prop_assert_eq!(history[0].to_bytes(), text.as_bytes());
    }
}

fn keys(document: &Document) -> Vec<NodeKey> {
    let scene = document.scene().unwrap();
    scene.bodies.iter().map(|body| body.key).chain(scene.forces.iter().map(|force| force.key)).collect()
}

/// A random edit; which body or force it is about is chosen when it is applied.
#[derive(Clone, Debug)]
struct Step {
    which: Index,
    kind: u8,
    number: f64,
    text: String,
}

fn step() -> impl Strategy<Value = Step> {
    let number = prop_oneof![Just(0.0), Just(1.0), Just(0.1), -1e3..1e3, Just(1e-300), Just(f64::NAN)];
    (any::<Index>(), 0..24_u8, number, "[ -~\n\té<&\"']{0,8}").prop_map(|(which, kind, number, text)| Step {
        which,
        kind,
        number,
        text,
    })
}

impl Step {
    fn edit(self, document: &Document) -> Edit {
        let Self { which, kind, number, text } = self;
        let all = keys(document);
        let Some(&key) = all.get(which.index(all.len().max(1))) else { return Edit::TimeSpeed(number) };
        let vector = DVec3::new(number, 1.0, -number);
        let name = (!text.is_empty()).then_some(text);
        let body = |change| Edit::Body { key, change };
        match kind {
            0 => Edit::MapSize(vector.abs()),
            1 => Edit::MapTiles([number.abs() as u32, 1, 2]),
            2 => Edit::TimeSpeed(number),
            3 => Edit::Params(SimParams { rest_time: number, ..SimParams::default() }),
            4 => Edit::Delete { keys: vec![key] },
            5 => Edit::Duplicate { keys: all, offset: vector },
            6 => Edit::MakeIdsUnique,
            7 => Edit::Force { key, change: ForceChange::Name(name) },
            8 => body(BodyChange::Name(name)),
            9 => body(BodyChange::Material(name)),
            10 => body(BodyChange::Position(vector)),
            11 => body(BodyChange::Rotation(vector)),
            12 => body(BodyChange::Bounce(number)),
            13 => body(BodyChange::Mass(number)),
            14 => body(BodyChange::Shape(Shape::Sphere { radius: number })),
            15 => body(BodyChange::Shape(Shape::Plane { half_x: number, half_y: 2.0 })),
            16 => body(BodyChange::Hidden(number > 0.0)),
            17 => body(BodyChange::Id(number as i64)),
            18 => body(BodyChange::Friction(number)),
            19 => body(BodyChange::Tangential(number)),
            20 => body(BodyChange::RollingFriction(number)),
            21 => body(BodyChange::Spin(vector)),
            22 => {
                let side = if number > 0.0 { Side::Before } else { Side::After };
                Edit::Reorder { keys: all.into_iter().step_by(2).collect(), side, anchor: key }
            }
            _ => Edit::AddBody(Box::new(Body {
                key: NodeKey::default(),
                id: 1,
                label: String::new().into(),
                name,
                color: Some([1, 2, 3]),
                group: None,
                hidden: false,
                locked: true,
                position: vector,
                rotation: DVec3::ZERO,
                bounce: 1.0,
                roughness: Roughness { friction: number.abs(), rolling: 0.0, tangential: 0.5 },
                spin: DVec3::ZERO,
                material: None,
                motion: Motion::Static,
                shape: Shape::Plane { half_x: 1.0, half_y: 2.0 },
            })),
        }
    }
}
