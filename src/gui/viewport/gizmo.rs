//! The handles in a view: what they belong to, and how they are drawn.

use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, vec2};
use glam::{DVec2, DVec3};

use super::gestures::Handles;
use super::manipulate::Manipulation;
use super::{Scenery, look_name};
use crate::editor::Place;
use crate::gui::colors::color32;
use crate::gui::numbers::significant;
use crate::scene::{Body, ForceKind, Motion, Shape as BodyShape, rotation_matrix};
use crate::view::{
    Axis, Camera, Freedom, Handle, Knob, Pivot, Pull, Sides, Subject, Tool, Vector, VectorKind, Viewport,
    velocity_scale,
};

/// What the handles belong to: the map, or what of the selection can be changed now. `None` without handles.
pub(super) fn subject(scenery: &Scenery<'_>, camera: &Camera, viewport: Viewport) -> Option<Subject> {
    let session = scenery.context.session;
    let world = Axis::ALL.map(Axis::unit);
    if scenery.tool == Tool::Select {
        return None;
    }
    if session.selection().place() == Some(Place::Map) {
        let size = scenery.shown.scene.map.size;
        let sides = Some(Sides::Map(size));
        return Some(Subject { tool: scenery.tool, pivot: size / 2.0, axes: world, sides, vector: None });
    }
    let chosen = Chosen::of(scenery)?;
    let only = match (chosen.bodies.as_slice(), chosen.count) {
        ([body], 1) => Some(*body),
        _ => None,
    };
    if scenery.tool == Tool::Turn && only.is_some_and(looks_the_same_turned) {
        return None;
    }
    let axes = match scenery.local_axes.then(|| chosen.bodies.last()).flatten() {
        Some(body) => {
            let turn = rotation_matrix(body.rotation);
            [turn.x_axis, turn.y_axis, turn.z_axis]
        }
        None => world,
    };
    let vector = match (only, chosen.field) {
        (Some(body), _) => velocity(body, scenery, camera, viewport),
        (None, Some(acceleration)) if chosen.count == 1 => {
            Some(field(acceleration, chosen.middle(), camera, viewport))
        }
        _ => None,
    };
    let several = (chosen.count > 1 && !chosen.bodies.is_empty()).then_some(Sides::Several);
    let sides = only.and_then(sides).or(several);
    let pivot = match scenery.pivot {
        Pivot::Last => chosen.last,
        Pivot::Middle | Pivot::Each => chosen.middle(),
    };
    Some(Subject { tool: scenery.tool, pivot, axes, sides, vector })
}

/// What of the selection can be dragged.
struct Chosen<'s> {
    bodies: Vec<&'s Body>,
    count: usize,
    /// Of the centres, m.
    sum: DVec3,
    last: DVec3,
    /// Of the last uniform gravity.
    field: Option<DVec3>,
}

impl<'s> Chosen<'s> {
    /// `None` when there is nothing, or a moving body that is not where the document has it.
    fn of(scenery: &'s Scenery<'_>) -> Option<Self> {
        let session = scenery.context.session;
        let (sum, last) = (DVec3::ZERO, DVec3::ZERO);
        let mut chosen = Self { bodies: Vec::new(), count: 0, sum, last, field: None };
        for key in session.selection().keys() {
            if let Some(body) = scenery.shown.body(*key).filter(|body| !body.locked && !body.hidden) {
                if body.is_dynamic() && !session.shows_start() {
                    return None;
                }
                chosen.bodies.push(body);
                chosen.include(body.position);
            } else if let Some(force) = scenery.shown.force(*key).filter(|f| !f.locked && !f.hidden) {
                if let ForceKind::GravityPlane { acceleration, .. } = force.kind {
                    chosen.field = Some(acceleration);
                }
                force.kind.position().into_iter().for_each(|place| chosen.include(place));
            }
        }
        (chosen.count > 0).then_some(chosen)
    }

    fn include(&mut self, place: DVec3) {
        self.count += 1;
        self.sum += place;
        self.last = place;
    }

    fn middle(&self) -> DVec3 {
        self.sum / self.count.max(1) as f64
    }
}

/// A ball at rest: turning it changes nothing.
fn looks_the_same_turned(body: &Body) -> bool {
    let rests = !matches!(body.motion, Motion::Dynamic { velocity, .. } if velocity != DVec3::ZERO);
    rests && matches!(body.shape, BodyShape::Sphere { .. })
}

fn sides(body: &Body) -> Option<Sides> {
    match body.shape {
        BodyShape::Sphere { radius } => Some(Sides::Sphere { radius }),
        BodyShape::Plane { half_x, half_y } => {
            let turn = rotation_matrix(body.rotation);
            Some(Sides::Plate { half: [half_x, half_y], along: [turn.x_axis, turn.y_axis] })
        }
        BodyShape::Unbuilt { .. } => None,
    }
}

/// A moving body's velocity, at the scale of the velocity arrows of the view.
fn velocity(body: &Body, scenery: &Scenery<'_>, camera: &Camera, viewport: Viewport) -> Option<Vector> {
    let Motion::Dynamic { velocity: value, .. } = body.motion else { return None };
    let metres_per_unit = velocity_scale(&scenery.shown.scene, camera, viewport);
    Some(Vector { kind: VectorKind::Velocity, value, metres_per_unit })
}

fn field(value: DVec3, place: DVec3, camera: &Camera, viewport: Viewport) -> Vector {
    /// Length of the arrow, points.
    const LENGTH: f64 = 76.0;
    /// What a field of nothing is drawn as if it had, m/s².
    const USUAL: f64 = 9.81;
    let size = if value.length() > 0.0 { value.length() } else { USUAL };
    let metres_per_unit = LENGTH * camera.world_per_pixel_at(place, viewport.height) / size;
    Vector { kind: VectorKind::Acceleration, value, metres_per_unit }
}

/// Draws the handles and gives each its name.
pub(super) fn show(
    ui: &Ui,
    (id, rect): (egui::Id, Rect),
    Handles { subject, knobs, active }: &Handles,
    seen: (&Camera, Viewport),
    scenery: &Scenery<'_>,
) {
    let painter = ui.painter_at(rect);
    draw_vector(&painter, rect, subject, knobs, seen, scenery);
    for (index, knob) in knobs.iter().enumerate() {
        draw_knob(&painter, rect, knob, color_of(knob.handle, *active == Some(knob.handle), scenery));
        let middle = on_screen(rect, knob.grab_point());
        let spot = Rect::from_center_size(middle, vec2(10.0, 10.0));
        let response = ui.interact(spot, id.with(("knob", index)), Sense::hover());
        let name = format!("{} in {} view", name_of(knob.handle), look_name(seen.0));
        response.widget_info(|| WidgetInfo::labeled(Role::GraphicsSymbol, true, &name));
    }
}

fn draw_knob(painter: &Painter, rect: Rect, knob: &Knob, color: Color32) {
    let points: Vec<Pos2> = knob.outline.iter().map(|at| on_screen(rect, *at)).collect();
    let dark = Color32::from_black_alpha(110);
    match knob.handle {
        Handle::MoveAlong(_) => {
            let (Some(from), Some(to)) = (points.first(), points.last()) else { return };
            arrow(painter, *from, *to, Stroke::new(5.0, dark), 14.0);
            arrow(painter, *from, *to, Stroke::new(3.0, color), 12.0);
        }
        Handle::Scale if !knob.closed => {
            painter.add(Shape::line(points.clone(), Stroke::new(3.5, dark)));
            painter.add(Shape::line(points, Stroke::new(1.5, color)));
        }
        Handle::TurnAbout(_) | Handle::TurnFacing => {
            let width = if matches!(knob.handle, Handle::TurnFacing) { 1.5 } else { 3.0 };
            painter.add(Shape::line(points.clone(), Stroke::new(width + 2.0, dark)));
            painter.add(Shape::line(points, Stroke::new(width, color)));
        }
        Handle::MoveAcross(_) | Handle::MoveFacing => {
            let fill = color.gamma_multiply(0.35);
            painter.add(Shape::convex_polygon(points, fill, Stroke::new(1.5, color)));
        }
        _ => {
            painter.add(Shape::convex_polygon(points, color, Stroke::new(1.5, dark)));
        }
    }
}

/// The arrow to the tip that can be dragged.
fn draw_vector(
    painter: &Painter,
    rect: Rect,
    subject: &Subject,
    knobs: &[Knob],
    (camera, viewport): (&Camera, Viewport),
    scenery: &Scenery<'_>,
) {
    let Some(knob) = knobs.iter().find(|knob| knob.handle == Handle::Vector) else { return };
    let Some(from) = camera.project(subject.pivot, viewport.aspect()) else { return };
    let from = on_screen(rect, viewport.points(from.truncate()));
    let to = on_screen(rect, knob.middle());
    let color = color_of(Handle::Vector, false, scenery);
    let is_zero = subject.vector.is_some_and(|vector| vector.value == DVec3::ZERO);
    if is_zero {
        painter.add(Shape::dashed_line(&[from, to], Stroke::new(1.5, color), 3.0, 3.0));
    } else {
        painter.line_segment([from, to], Stroke::new(2.5, color));
    }
}

fn arrow(painter: &Painter, from: Pos2, to: Pos2, pen: Stroke, head: f32) {
    let along = (to - from).normalized();
    let across = along.rot90() * (0.38 * head);
    let neck = to - along * head;
    painter.line_segment([from, neck], pen);
    painter.add(Shape::convex_polygon(vec![to, neck + across, neck - across], pen.color, Stroke::NONE));
}

fn color_of(handle: Handle, hovered: bool, scenery: &Scenery<'_>) -> Color32 {
    let palette = scenery.context.palette();
    let color = match handle {
        _ if hovered => palette.hovered,
        Handle::MoveAlong(axis)
        | Handle::MoveAcross(axis)
        | Handle::TurnAbout(axis)
        | Handle::MapSide(axis) => palette.axes[axis as usize],
        Handle::Vector => palette.velocity,
        _ => palette.selected,
    };
    color32(color)
}

fn name_of(handle: Handle) -> String {
    match handle {
        Handle::Body => "Move".to_owned(),
        Handle::MoveAlong(axis) => format!("Move along {}", axis.label()),
        Handle::MoveAcross(axis) => format!("Move across {}", axis.label()),
        Handle::MoveFacing => "Move in the picture".to_owned(),
        Handle::TurnAbout(axis) => format!("Turn about {}", axis.label()),
        Handle::TurnFacing => "Turn in the picture".to_owned(),
        Handle::Radius => "Change radius".to_owned(),
        Handle::Scale => "Scale".to_owned(),
        Handle::Side { along, positive } => {
            format!("Side {}{}", if positive { "+" } else { "−" }, along.label())
        }
        Handle::MapSide(axis) => format!("Map side {}", axis.label()),
        Handle::Vector => "Tip of the arrow".to_owned(),
    }
}

/// What goes on: the way so far, guide lines, an angle as a slice, and the numbers.
pub(super) fn show_pull(
    ui: &Ui,
    rect: Rect,
    (camera, viewport): (&Camera, Viewport),
    going_on: &Manipulation,
    scenery: &Scenery<'_>,
) {
    let painter = ui.painter_at(rect);
    let seen = |place: DVec3| {
        let ndc = camera.project(place, viewport.aspect())?;
        Some(on_screen(rect, viewport.points(ndc.truncate())))
    };
    let palette = scenery.context.palette();
    draw_line_of_freedom(&painter, rect, (camera, viewport), going_on, scenery);
    if let Some(Pull::Turn { axis, angle }) = going_on.pull {
        let pivot = going_on.grip.subject.pivot;
        let arm = (going_on.grip.grabbed - pivot).reject_from_normalized(axis);
        let slice = (0..=48).filter_map(|i| {
            let turned = glam::DQuat::from_axis_angle(axis, angle * f64::from(i) / 48.0) * arm;
            seen(pivot + turned)
        });
        let outline: Vec<Pos2> = seen(pivot).into_iter().chain(slice).collect();
        let color = color32(palette.hovered);
        painter.add(Shape::closed_line(outline, Stroke::new(1.5, color)));
    }
    let pen = Stroke::new(1.5, color32(palette.hovered));
    for guide in &going_on.guides {
        let (Some(from), Some(to)) = (seen(guide.from), seen(guide.to)) else { continue };
        painter.add(Shape::dashed_line(&[from, to], pen, 5.0, 4.0));
        let name = scenery.shown.name(guide.with).unwrap_or_default();
        let text = if guide.touches {
            format!("touches {name}")
        } else {
            format!("level with {name}, {} m", significant(guide.from.distance(guide.to), 5))
        };
        label(&painter, from + (to - from) * 0.5, Align2::CENTER_CENTER, &text, scenery);
    }
    let at = rect.center_bottom() - vec2(0.0, 12.0);
    label(&painter, at, Align2::CENTER_BOTTOM, &words(going_on), scenery);
}

/// The line along which it moves, across the whole view.
fn draw_line_of_freedom(
    painter: &Painter,
    rect: Rect,
    (camera, viewport): (&Camera, Viewport),
    going_on: &Manipulation,
    scenery: &Scenery<'_>,
) {
    let moves = matches!(going_on.pull, Some(Pull::Move(_) | Pull::Vector(_)));
    let Freedom::Line(unit) = going_on.grip.freedom(camera) else { return };
    if !moves {
        return;
    }
    let (pivot, reach) = (going_on.grip.grabbed, 100.0 * camera.height);
    let ends = camera.clip_segment(pivot - unit * reach, pivot + unit * reach, viewport.aspect());
    let seen =
        |place| Some(on_screen(rect, viewport.points(camera.project(place, viewport.aspect())?.truncate())));
    let Some((Some(from), Some(to))) = ends.map(|(from, to)| (seen(from), seen(to))) else { return };
    let axis = Axis::of_unit(unit)
        .map_or(scenery.context.palette().selected, |axis| scenery.context.palette().axes[axis as usize]);
    painter.line_segment([from, to], Stroke::new(1.0, color32(axis).gamma_multiply(0.7)));
}

/// The drag in numbers, and what the keys do.
fn words(going_on: &Manipulation) -> String {
    let triple = |v: DVec3| {
        let [x, y, z] = v.to_array().map(|value| significant(value, 5));
        format!("({x}, {y}, {z})")
    };
    let what = match going_on.pull {
        None => String::new(),
        Some(Pull::Move(offset)) => {
            format!("to {} m · by {} m", triple(going_on.origin() + offset), triple(offset))
        }
        Some(Pull::Turn { angle, .. }) => format!("{}°", significant(angle.to_degrees(), 4)),
        Some(Pull::Radius(radius)) => format!("radius {} m", significant(radius, 5)),
        Some(Pull::Scale(factor)) => format!("× {}", significant(factor, 5)),
        Some(Pull::Sides { half: [x, y], .. }) => {
            format!("{} × {} m", significant(2.0 * x, 5), significant(2.0 * y, 5))
        }
        Some(Pull::Map(size)) => format!("map {} m", triple(size)),
        Some(Pull::Vector(value)) => {
            let kind = going_on.grip.subject.vector.map(|vector| vector.kind);
            let unit = if kind == Some(VectorKind::Acceleration) { "m/s²" } else { "m/s" };
            format!("{} {unit} · {} {unit}", significant(value.length(), 5), triple(value))
        }
    };
    let only = going_on.grip.only.map_or(String::new(), |axis| format!(" · only {}", axis.label()));
    let snaps = if going_on.snaps { " · snapping" } else { "" };
    let keys = if going_on.typed.is_empty() {
        "Type a number · X, Y, Z: axis · Shift: fine · Ctrl: snap · Esc: cancel".to_owned()
    } else {
        format!("= {}▏ Enter takes it", going_on.typed)
    };
    format!("{what}{only}{snaps}\n{keys}")
}

fn label(painter: &Painter, at: Pos2, align: Align2, text: &str, scenery: &Scenery<'_>) {
    let palette = scenery.context.palette();
    let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(12.0), color32(palette.text));
    let place = align.anchor_size(at, galley.size());
    painter.rect_filled(place.expand(5.0), 3.0, color32(palette.label_back));
    painter.galley(place.min, galley, color32(palette.text));
}

fn on_screen(rect: Rect, at: DVec2) -> Pos2 {
    rect.min + vec2(at.x as f32, at.y as f32)
}
