//! The map and the simulation: size, tiles, time speed, and every setting of the solver.

use egui::{Grid, RichText, Ui};

use super::bodies::{row_label, speed};
use super::number::{Number, WIDTH, number, single};
use super::section;
use crate::editor::{Action, Field, SCENE_FIELDS, shared};
use crate::gui::colors::tones;
use crate::gui::context::{AppContext, Shown};
use crate::gui::numbers;
use crate::scene::{Edit, PARAMS, ParamInfo, Scene, SimParams};

/// Rows of [`SCENE_FIELDS`] that belong to the simulation; the others are the map's.
const OF_SIMULATION: &str = "Time speed";

pub fn map(ui: &mut Ui, context: &AppContext<'_>, shown: &Shown) {
    section(ui, "Map");
    fields(ui, context, shown, "map values", |field| field.label != OF_SIMULATION);
    let text =
        "The box [0, x] × [0, y] × [0, z] that the tiles divide. It does not collide: bodies may leave it.";
    ui.label(RichText::new(text).small().color(tones(ui).weak));
}

pub fn simulation(ui: &mut Ui, context: &AppContext<'_>, shown: &Shown) {
    section(ui, "Simulation");
    fields(ui, context, shown, "simulation values", |field| field.label == OF_SIMULATION);
    plan(ui, context);
    section(ui, "Solver");
    Grid::new("solver").num_columns(4).spacing([6.0, 3.0]).show(ui, |ui| {
        for param in PARAMS {
            param_row(ui, context, &shown.scene, param);
        }
    });
    let reasons = context.session.document().reasons_for_1_1();
    let text = if reasons.is_empty() {
        let written = context.session.document().written_version().unwrap_or_else(|| "1.0".to_owned());
        format!("The file is Version {written}, and uses nothing that readers of 1.0 do not know.")
    } else {
        format!("The file is Version 1.1 because of {}.", reasons.join(", "))
    };
    ui.add_space(4.0);
    ui.label(RichText::new(text).small().color(tones(ui).weak));
}

fn fields(
    ui: &mut Ui,
    context: &AppContext<'_>,
    shown: &Shown,
    id: &str,
    wanted: impl Fn(&Field<Scene, Edit>) -> bool,
) {
    let scene = &shown.scene;
    Grid::new(id).num_columns(3).spacing([6.0, 3.0]).show(ui, |ui| {
        for field in SCENE_FIELDS.iter().filter(|field| wanted(field)) {
            for (axis, axis_name) in field.axes.iter().enumerate() {
                let value = shared([field.value(scene, axis)]);
                row_label(ui, if axis == 0 { field.label } else { "" }, axis_name);
                let name = field.accessible_name(axis);
                let speed = if field.label == "Tiles" {
                    0.1
                } else {
                    speed(field.unit, value, scene.map.size.max_element())
                };
                let whole = field.label == "Tiles";
                let spec = Number {
                    name: &name,
                    value,
                    range: field.range,
                    speed,
                    width: WIDTH,
                    help: help(field.label),
                    angle: false,
                    whole,
                };
                number(ui, context.outbox, &spec, |typed| {
                    let value = single(typed, field.value(scene, axis).unwrap_or_default())?;
                    Ok(field.change(scene, axis, value).unwrap_or(Edit::All(Vec::new())))
                });
                ui.label(RichText::new(field.unit).color(tones(ui).weak));
                ui.end_row();
            }
        }
    });
}

fn help(label: &str) -> &'static str {
    match label {
        "Tiles" => "How many tiles divide the map; changes the speed, never the result",
        "Time speed" => "Model seconds per second of watching; never scales Δt",
        _ => "",
    }
}

/// What the compiler decided about this scene.
fn plan(ui: &mut Ui, context: &AppContext<'_>) {
    let plan = &context.session.frame().plan;
    if plan.motion.is_empty() {
        return;
    }
    let motion = match plan.motion {
        "ballistic" => "parabolas in closed form",
        _ => "integrated in the force field",
    };
    let pairs = if plan.pairs.is_empty() { "none".to_owned() } else { plan.pairs.join("\n") };
    Grid::new("plan").num_columns(2).spacing([6.0, 3.0]).show(ui, |ui| {
        ui.label("Motion").on_hover_text("How bodies move between events, as this scene needs it");
        ui.label(RichText::new(motion).color(tones(ui).weak));
        ui.end_row();
        ui.label("Pairs").on_hover_text("Shapes that can meet in this scene");
        ui.label(RichText::new(pairs).color(tones(ui).weak));
        ui.end_row();
        if plan.stepped_groups {
            let help = "Bodies of a heap go on by this step, once they touch too often for events; Dense step sets it";
            ui.label("Group step").on_hover_text(help);
            ui.label(RichText::new(group_step(plan.group_step)).color(tones(ui).weak));
            ui.end_row();
        }
    });
    if !plan.left_out.is_empty() {
        ui.label("Left out").on_hover_text("What this scene does not need is neither stored nor computed");
        for reason in &plan.left_out {
            ui.label(RichText::new(format!("• {reason}")).small().color(tones(ui).weak));
        }
    }
}

/// An automatic one is found when bodies meet: before, there is none to tell.
fn group_step(step: f64) -> String {
    if step > 0.0 {
        format!("{} s", numbers::significant(step, 4))
    } else {
        "automatic: not known before something happens".to_owned()
    }
}

fn param_row(ui: &mut Ui, context: &AppContext<'_>, scene: &Scene, param: &ParamInfo) {
    let value = (param.get)(&scene.params);
    let default = (param.get)(&SimParams::default());
    let help = format!("{}\nDefault: {} {}", param.help, numbers::significant(default, 6), param.unit);
    ui.label(param.label).on_hover_text(&help);
    let speed = match 0.01 * value.abs().max(0.1 * default.abs()) {
        // One that stands for an automatic value is dragged away from it.
        0.0 => 1e-4 * param.range.1,
        speed => speed,
    };
    let spec = Number {
        name: param.label,
        value: shared([Some(value)]),
        range: param.range,
        speed,
        width: WIDTH,
        help: &help,
        angle: false,
        whole: is_whole(param),
    };
    number(ui, context.outbox, &spec, |typed| Ok(with(param, scene, single(typed, value)?)));
    ui.label(RichText::new(param.unit).color(tones(ui).weak));
    if value != default {
        let name = format!("Reset {}", param.label);
        let response = ui.small_button("↺").on_hover_text("Back to the default").accessible_name(name);
        if response.clicked() {
            let edit = with(param, scene, default);
            context.outbox.act(Action::Edit { edit, gesture: None });
        }
    }
    ui.end_row();
}

/// Whether a setting is a count: it then keeps no fraction.
fn is_whole(param: &ParamInfo) -> bool {
    let mut params = SimParams::default();
    (param.set)(&mut params, 1.5);
    (param.get)(&params) != 1.5
}

fn with(param: &ParamInfo, scene: &Scene, value: f64) -> Edit {
    let mut params = scene.params;
    (param.set)(&mut params, value);
    Edit::Params(params)
}
