//! Bodies: what they start with, and what they do now.

use egui::{Color32, Grid, Response, RichText, Sense, Stroke, StrokeKind, Ui, vec2};

use super::number::{Number, WIDTH, number};
use super::section;
use super::text::{TextFields, user_id};
use crate::editor::{Action, BODY_FIELDS, Field, Shared, shared};
use crate::gui::colors::tones;
use crate::gui::context::{AppContext, Shown};
use crate::gui::numbers::{fitting, significant};
use crate::gui::widgets::mono;
use crate::record::BodyFrame;
use crate::scene::{Body, BodyChange, Edit, NodeKey, Shape};
use crate::sim::ContactState;

/// Width of the names of rows, points: the longest of them with its axis.
const LABEL_WIDTH: f32 = 110.0;

/// The same of rows without fields, whose names may be longer.
const WIDE_LABEL_WIDTH: f32 = 138.0;

/// Digits and characters of what a body does now, so that it fits beside what it starts with; the tooltip has all.
const NOW_DIGITS: usize = 7;
const NOW_LONGEST: usize = 9;

pub fn kind(body: &Body) -> &'static str {
    match (&body.shape, body.is_dynamic()) {
        (Shape::Sphere { .. }, true) => "dynamic sphere",
        (Shape::Sphere { .. }, false) => "static sphere",
        (Shape::Plane { .. }, _) => "static plane",
        (Shape::Unbuilt { .. }, _) => "not simulated yet",
    }
}

pub fn show(ui: &mut Ui, context: &AppContext<'_>, shown: &Shown, keys: &[NodeKey], texts: &mut TextFields) {
    let bodies: Vec<&Body> = keys.iter().filter_map(|key| shown.body(*key)).collect();
    let now = match keys {
        [key] => context.session.frame().bodies.iter().find(|body| body.key == *key),
        _ => None,
    };
    identity(ui, context, shown, &bodies, texts);
    section(ui, "Values");
    if !context.session.shows_start() && bodies.iter().any(|body| body.is_dynamic()) {
        let text = "Edits of position and velocity are for the start; they wait for a reset.";
        ui.label(RichText::new(text).small().color(tones(ui).weak));
    }
    Grid::new("body values").num_columns(4).spacing([6.0, 3.0]).show(ui, |ui| {
        ui.label("");
        ui.label(RichText::new("at the start").small().color(tones(ui).weak));
        ui.label("");
        let heading = if now.is_some() { "now" } else { "" };
        ui.label(RichText::new(heading).small().color(tones(ui).weak));
        ui.end_row();
        for field in BODY_FIELDS {
            rows(ui, context, shown, &bodies, keys, field, now);
        }
    });
    if let Some(now) = now {
        motion(ui, now);
    }
}

/// Name, ID, material, colour, marks.
fn identity(ui: &mut Ui, context: &AppContext<'_>, shown: &Shown, bodies: &[&Body], texts: &mut TextFields) {
    let outbox = context.outbox;
    let [first, ..] = bodies else { return };
    Grid::new("body identity").num_columns(2).spacing([6.0, 4.0]).show(ui, |ui| {
        if let [body] = bodies {
            let key = body.key;
            ui.label("Name");
            texts.show(ui, outbox, "Name", body.name.as_deref().unwrap_or(""), &body.label, |text| {
                let name = (!text.is_empty()).then(|| text.to_owned());
                Ok(Edit::Body { key, change: BodyChange::Name(name) })
            });
            ui.end_row();
            ui.label("User ID");
            texts.show(ui, outbox, "User ID", &body.id.to_string(), "", |text| {
                Ok(Edit::Body { key, change: BodyChange::Id(user_id(text)?) })
            });
            ui.end_row();
        }
        ui.label("Material").on_hover_text("A name that forces of your own may look at");
        let same = bodies.iter().all(|body| body.material == first.material);
        let value = if same { first.material.as_deref().unwrap_or("") } else { "" };
        let hint = if same { "none" } else { "mixed" };
        texts.show(ui, outbox, "Material", value, hint, |text| {
            let material = (!text.is_empty()).then(|| text.to_owned());
            Ok(for_all(bodies, |_| BodyChange::Material(material.clone())))
        });
        ui.end_row();
        ui.label("Colour");
        color(ui, context, shown, bodies);
        ui.end_row();
    });
}

fn color(ui: &mut Ui, context: &AppContext<'_>, shown: &Shown, bodies: &[&Body]) {
    let Some(first) = bodies.first() else { return };
    let Some(drawn) = shown.color(first.key, context.palette()) else { return };
    let [r, g, b, _] = drawn.0;
    ui.horizontal(|ui| {
        let mut rgb = [r, g, b];
        let response = ui.color_edit_button_srgb(&mut rgb);
        let gesture = crate::editor::Gesture(0x636f_6c6f_7572);
        if response.changed() {
            let edit = for_all(bodies, |_| BodyChange::Color(Some(rgb)));
            context.outbox.act(Action::Edit { edit, gesture: Some(gesture) });
        }
        crate::gui::widgets::name_button(ui, &response, "Colour", false);
        if bodies.iter().any(|body| body.color.is_some()) {
            let reset = ui.small_button("Automatic").on_hover_text("Lets the views choose the colour");
            if reset.clicked() {
                let edit = for_all(bodies, |_| BodyChange::Color(None));
                context.outbox.act(Action::Edit { edit, gesture: None });
            }
        } else {
            ui.label(RichText::new("chosen by the views").small().color(tones(ui).weak));
        }
    });
    ui.end_row();
    ui.label("");
    swatches(ui, context, bodies);
}

/// Colours that a click gives.
fn swatches(ui: &mut Ui, context: &AppContext<'_>, bodies: &[&Body]) {
    const SWATCHES: [(&str, [u8; 3]); 8] = [
        ("red", [0xd6, 0x3c, 0x32]),
        ("orange", [0xe8, 0x8a, 0x1e]),
        ("yellow", [0xe8, 0xcb, 0x34]),
        ("green", [0x3f, 0xa3, 0x52]),
        ("blue", [0x2f, 0x74, 0xd0]),
        ("violet", [0x8a, 0x55, 0xc4]),
        ("white", [0xf2, 0xf2, 0xf2]),
        ("black", [0x28, 0x2a, 0x2e]),
    ];
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        for (name, rgb) in SWATCHES {
            let (rect, response) = ui.allocate_exact_size(vec2(18.0, 18.0), Sense::click());
            let [r, g, b] = rgb;
            let framed = response.hovered() || response.has_focus();
            let line = if framed { tones(ui).strong } else { tones(ui).line };
            ui.painter().rect(
                rect.shrink(1.0),
                3.0,
                Color32::from_rgb(r, g, b),
                Stroke::new(1.0, line),
                StrokeKind::Inside,
            );
            crate::gui::widgets::name_button(ui, &response, &format!("Colour {name}"), false);
            if response.on_hover_text(name).clicked() {
                let edit = for_all(bodies, |_| BodyChange::Color(Some(rgb)));
                context.outbox.act(Action::Edit { edit, gesture: None });
            }
        }
    });
}

fn for_all(bodies: &[&Body], change: impl Fn(&Body) -> BodyChange) -> Edit {
    Edit::All(bodies.iter().map(|body| Edit::Body { key: body.key, change: change(body) }).collect())
}

/// A number, or one row for each component of a vector.
fn rows(
    ui: &mut Ui,
    context: &AppContext<'_>,
    shown: &Shown,
    bodies: &[&Body],
    keys: &[NodeKey],
    field: &Field<Body, BodyChange>,
    now: Option<&BodyFrame>,
) {
    for (axis, axis_name) in field.axes.iter().enumerate() {
        let value = shared(bodies.iter().map(|body| field.value(body, axis)));
        if value == Shared::None {
            return;
        }
        row_label(ui, if axis == 0 { field.label } else { "" }, axis_name);
        let name = field.accessible_name(axis);
        let speed = speed(field.unit, value, shown.scene.map.size.max_element());
        let angle = field.unit == "rad";
        let help = help(field.label);
        let (range, width) = (field.range, WIDTH);
        let spec = Number { name: &name, value, range, speed, width, help, angle, whole: false };
        number(ui, context.outbox, &spec, |typed| field.edit(&shown.scene, keys, axis, typed));
        ui.label(RichText::new(field.unit).color(tones(ui).weak));
        match field.now.zip(now).and_then(|(get, frame)| get(frame)) {
            Some(vector) => {
                let value = vector.to_array().get(axis).copied().unwrap_or(0.0);
                drop(
                    ui.label(mono(fitting(value, NOW_DIGITS, NOW_LONGEST))).on_hover_text(value.to_string()),
                );
            }
            None if angle => drop(ui.label(RichText::new(degrees(value)).color(tones(ui).weak))),
            None => drop(ui.label("")),
        }
        ui.end_row();
    }
}

/// A row's name and axis; the response is that of the name.
pub fn row_label(ui: &mut Ui, label: &str, axis: &str) -> Response {
    label_of_width(ui, LABEL_WIDTH, label, axis)
}

fn label_of_width(ui: &mut Ui, width: f32, label: &str, axis: &str) -> Response {
    ui.horizontal(|ui| {
        ui.set_min_width(width);
        let response = ui.label(label);
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            ui.label(RichText::new(axis).color(tones(ui).weak));
        });
        response
    })
    .inner
}

/// What an angle is in degrees.
fn degrees(value: Shared) -> String {
    match value {
        Shared::Same(radians) => format!("= {}°", significant(radians.to_degrees(), 6)),
        _ => String::new(),
    }
}

/// Change per point of dragging: a thousandth of the map, a degree or so, a percent of the value.
pub fn speed(unit: &str, value: Shared, map: f64) -> f64 {
    let value = match value {
        Shared::Same(value) => value.abs(),
        _ => 1.0,
    };
    match unit {
        "m" => (map / 1000.0).min(0.01 * value.max(0.1 * map)),
        "rad" => 0.01,
        _ => 0.01 * value.max(0.1),
    }
}

fn help(label: &str) -> &'static str {
    match label {
        "Position" => "Centre, in the map's coordinates; y is up",
        "Rotation" => {
            "Euler angles about x, y, z: R = Rx(α)·Ry(β)·Rz(γ). At 0 a plane lies in xy, its normal is +z"
        }
        "Bounce" => {
            "Coefficient of restitution: 1 loses nothing, 0 does not bounce. A pair uses the product of both"
        }
        "Angular velocity" => "About the axes of the map, at the start. Only friction makes it matter",
        "Friction" => {
            "Coefficient of Coulomb's friction. A pair uses the geometric mean of both, so against 0 nothing rubs"
        }
        "Rolling friction" => {
            "Share of the load that slows a rolling ball down. A pair uses the geometric mean of both"
        }
        "Tangential" => {
            "Tangential restitution: what part of the slip comes back from an impact that does not slide, 1 for a \
             superball. A pair uses the geometric mean of both"
        }
        "Half side" => "From the middle of the plane to its edge",
        _ => "",
    }
}

/// What only a simulation knows.
fn motion(ui: &mut Ui, now: &BodyFrame) {
    // Contacts of a stepped body act between its steps only.
    let (acceleration, of_what) = match now.contact {
        ContactState::Stepped => ("Applied acceleration", "Of the forces of the scene, without its contacts"),
        _ => ("Acceleration", "Of the motion, so contact forces are included"),
    };
    let vectors = [
        (acceleration, now.acceleration, "m/s²", of_what),
        ("Applied force", now.force, "N", "Sum of the forces of the scene, without its contacts"),
    ];
    section(ui, "Now");
    Grid::new("body motion").num_columns(3).spacing([6.0, 3.0]).show(ui, |ui| {
        row(ui, ["Speed", ""], significant(now.velocity.length(), 8), "m/s", "");
        for (label, vector, unit, help) in vectors {
            for (axis, value) in ["x", "y", "z"].into_iter().zip(vector.to_array()) {
                let label = if axis == "x" { label } else { "" };
                row(ui, [label, axis], significant(value, 8), unit, help);
            }
        }
        row(
            ui,
            ["Kinetic energy", ""],
            significant(now.kinetic, 8),
            "J",
            "½ m v², and ½ I ω² where bodies rub",
        );
        row(ui, ["Contact", ""], now.contact.name().to_owned(), "", now.contact.meaning());
    });
}

pub(super) fn row(ui: &mut Ui, [label, axis]: [&str; 2], value: String, unit: &str, help: &str) {
    label_of_width(ui, WIDE_LABEL_WIDTH, label, axis).on_hover_text(help);
    ui.label(mono(value));
    ui.label(RichText::new(unit).color(tones(ui).weak));
    ui.end_row();
}
