//! Handles: where they are seen, which is under the pointer, what dragging one means.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DVec2, DVec3, dvec2, dvec3};
use polyscene::scene::{Body, Motion, Shape};
use polyscene::view::{
    Axis, Camera, Freedom, Grip, Guide, Handle, Neighbour, Projection, Pull, Sides, Subject, Tool, Vector,
    VectorKind, Viewport, aligned, features, handle_at, knobs, pull, touching,
};

const SIZE: Viewport = Viewport { width: 600.0, height: 400.0, pixels_per_point: 1.0 };

/// Perspective, the same without, from the top, and far from the origin.
fn cameras() -> [Camera; 4] {
    let perspective = Camera::default();
    let ortho = Camera { projection: Projection::Orthographic, ..perspective };
    let top = Camera { pitch: FRAC_PI_2, yaw: 0.0, ..ortho };
    let far = Camera { target: dvec3(1e5, 1e5, -1e5), ..ortho };
    [perspective, ortho, top, far]
}

fn subject(tool: Tool, pivot: DVec3) -> Subject {
    Subject { tool, pivot, axes: Axis::ALL.map(Axis::unit), sides: None, vector: None }
}

fn seen(camera: &Camera, place: DVec3) -> DVec2 {
    camera.project(place, SIZE.aspect()).unwrap().truncate()
}

/// What a pull gives when the handle is taken at one place of the world and dragged to another.
fn pulled(camera: &Camera, subject: &Subject, handle: Handle, from: DVec3, to: DVec3) -> Option<Pull> {
    let grip = Grip::take(handle, subject.clone(), camera, SIZE, seen(camera, from))?;
    pull(&grip, camera, SIZE, seen(camera, to), None)
}

fn close(a: DVec3, b: DVec3, to: f64) {
    assert!(a.distance(b) < to, "{a} is not {b}");
}

#[test]
fn every_handle_is_found_where_it_is_seen() {
    for camera in cameras() {
        for tool in [Tool::Move, Tool::Turn] {
            let subject = subject(tool, camera.target + dvec3(0.5, -0.3, 0.2));
            let all = knobs(&subject, &camera, SIZE);
            assert!(all.len() >= 2, "{tool:?}: {all:?}");
            for knob in &all {
                assert_eq!(handle_at(&all, knob.grab_point()), Some(knob.handle), "{camera:?}");
            }
        }
        assert_eq!(knobs(&subject(Tool::Select, camera.target), &camera, SIZE), []);
    }
}

#[test]
fn what_points_at_the_viewer_has_no_handle() {
    let [_, _, top, _] = cameras();
    let handles: Vec<Handle> =
        knobs(&subject(Tool::Move, top.target), &top, SIZE).iter().map(|knob| knob.handle).collect();
    assert!(!handles.contains(&Handle::MoveAlong(Axis::Y)), "{handles:?}");
    assert!(handles.contains(&Handle::MoveAlong(Axis::X)) && handles.contains(&Handle::MoveAcross(Axis::Y)));
    assert!(!handles.contains(&Handle::MoveAcross(Axis::X)), "seen edge-on");
    let rings: Vec<Handle> =
        knobs(&subject(Tool::Turn, top.target), &top, SIZE).iter().map(|knob| knob.handle).collect();
    assert_eq!(rings, [Handle::TurnAbout(Axis::Y), Handle::TurnFacing]);
}

#[test]
fn a_move_along_an_axis_follows_the_pointers_part_along_it() {
    for camera in cameras() {
        let pivot = camera.target + dvec3(0.3, 0.2, -0.4);
        for axis in Axis::ALL {
            let to = pivot + axis.unit() * 1.7;
            if seen(&camera, pivot).distance(seen(&camera, to)) < 1e-3 {
                continue;
            }
            let moved = pulled(&camera, &subject(Tool::Move, pivot), Handle::MoveAlong(axis), pivot, to);
            let Some(Pull::Move(offset)) = moved else { panic!("{moved:?}") };
            close(offset, axis.unit() * 1.7, 1e-7);
        }
    }
}

#[test]
fn a_move_in_a_plane_stays_under_the_pointer() {
    for camera in cameras() {
        let pivot = camera.target + dvec3(1.0, -0.5, 0.5);
        let to = pivot + dvec3(0.8, 0.0, -1.1);
        let moved = pulled(&camera, &subject(Tool::Move, pivot), Handle::MoveAcross(Axis::Y), pivot, to);
        let Some(Pull::Move(offset)) = moved else { panic!("{moved:?}") };
        close(offset, to - pivot, 1e-7);
        assert_eq!(offset.y, 0.0, "the height stays to the bit");
    }
}

#[test]
fn a_body_is_dragged_over_the_ground_or_in_the_drawings_plane() {
    let [perspective, _, top, _] = cameras();
    assert_eq!(Freedom::natural(&perspective), Freedom::Plane(DVec3::X, DVec3::Z));
    assert_eq!(Freedom::natural(&top), Freedom::Plane(DVec3::X, DVec3::NEG_Z));
    let level = Camera { pitch: 0.05, ..perspective };
    assert_eq!(Freedom::natural(&level), Freedom::facing(&level));
    // above the horizon the pointer has no place on the ground
    let sky = Freedom::natural(&perspective).offset(
        &perspective,
        SIZE.aspect(),
        perspective.target,
        (DVec2::ZERO, dvec2(0.0, 5.0)),
    );
    assert_eq!(sky, None);
}

#[test]
fn a_ring_turns_as_far_as_the_pointer_goes_round_it() {
    let camera = Camera { pitch: FRAC_PI_2, yaw: 0.0, ..cameras()[1] };
    let subject = subject(Tool::Turn, camera.target);
    let at = |angle: f64| camera.target + dvec3(angle.cos(), 0.0, -angle.sin());
    let grip =
        Grip::take(Handle::TurnAbout(Axis::Y), subject, &camera, SIZE, seen(&camera, at(0.0))).unwrap();
    let mut before: Option<Pull> = None;
    for step in 1..=30 {
        let angle = 0.3 * f64::from(step);
        before = pull(&grip, &camera, SIZE, seen(&camera, at(angle)), before.as_ref());
        let Some(Pull::Turn { axis, angle: turned }) = before else { panic!("{before:?}") };
        assert_eq!(axis, DVec3::Y);
        assert!((turned - angle).abs() < 1e-9, "{turned} instead of {angle}, more than one turn");
    }
    let snapped = grip.snapped(Pull::Turn { axis: DVec3::Y, angle: 0.5 }, &camera, DVec3::ZERO, 1.0);
    assert_eq!(snapped, Pull::Turn { axis: DVec3::Y, angle: PI / 6.0 });
}

#[test]
fn a_corner_of_the_frame_scales_by_its_way_from_the_pivot() {
    for camera in cameras() {
        let several = Subject { sides: Some(Sides::Several), ..subject(Tool::Size, camera.target) };
        let all = knobs(&several, &camera, SIZE);
        assert_eq!(all.len(), 5, "four corners and the frame: {all:?}");
        assert!(
            all.iter().all(|knob| handle_at(&all, knob.grab_point()) == Some(Handle::Scale) || !knob.closed)
        );
        let corner = (camera.right() + camera.up()) * (0.1 * camera.height);
        let at = |factor: f64| camera.target + corner * factor;
        for factor in [0.25, 1.0, 1.75] {
            let Some(Pull::Scale(found)) = pulled(&camera, &several, Handle::Scale, at(1.0), at(factor))
            else {
                panic!("no scale")
            };
            assert!((found - factor).abs() < 1e-6, "{found} is not {factor}");
        }
        let grip = Grip::take(Handle::Scale, several, &camera, SIZE, seen(&camera, at(1.0))).unwrap();
        let snapped = grip.snapped(Pull::Scale(1.23), &camera, DVec3::ZERO, 0.5);
        assert_eq!(snapped, Pull::Scale(1.2));
    }
}

#[test]
fn sizes_follow_their_sides() {
    let [camera, ..] = cameras();
    let pivot = camera.target;
    let ball = Subject { sides: Some(Sides::Sphere { radius: 1.0 }), ..subject(Tool::Size, pivot) };
    let right = camera.right();
    let grown = pulled(&camera, &ball, Handle::Radius, pivot + right, pivot + right * 1.5);
    assert!(matches!(grown, Some(Pull::Radius(radius)) if (radius - 1.5).abs() < 1e-9), "{grown:?}");
    let through = pulled(&camera, &ball, Handle::Radius, pivot + right * 2.0, pivot + right * 0.1);
    assert!(matches!(through, Some(Pull::Radius(radius)) if radius > 0.0), "{through:?}");

    let sides = Sides::Plate { half: [2.0, 1.0], along: [DVec3::X, DVec3::Z] };
    let plate = Subject { sides: Some(sides), ..subject(Tool::Size, pivot) };
    let handle = Handle::Side { along: Axis::X, positive: true };
    let from = pivot + DVec3::X * 2.0;
    let Some(Pull::Sides { half, shift }) = pulled(&camera, &plate, handle, from, from + DVec3::X) else {
        panic!("no sides")
    };
    assert!((half[0] - 2.5).abs() < 1e-9 && half[1] == 1.0, "{half:?}");
    close(shift, DVec3::X * 0.5, 1e-9);

    let map = Subject { sides: Some(Sides::Map(DVec3::splat(10.0))), ..subject(Tool::Size, pivot) };
    let from = dvec3(5.0, 10.0, 5.0);
    let Some(Pull::Map(size)) = pulled(&camera, &map, Handle::MapSide(Axis::Y), from, from + DVec3::Y * 2.0)
    else {
        panic!("no map")
    };
    close(size, dvec3(10.0, 12.0, 10.0), 1e-8);
}

#[test]
fn the_tip_of_an_arrow_is_a_vector() {
    let [.., top, _] = cameras();
    let pivot = top.target;
    let vector = Vector { kind: VectorKind::Velocity, value: DVec3::ZERO, metres_per_unit: 0.5 };
    let ball = Subject { vector: Some(vector), ..subject(Tool::Move, pivot) };
    let Some(Pull::Vector(value)) = pulled(&top, &ball, Handle::Vector, pivot, pivot + DVec3::X) else {
        panic!("no vector")
    };
    close(value, DVec3::X * 2.0, 1e-9);
}

#[test]
fn typed_numbers_take_the_pointers_place() {
    let [camera, ..] = cameras();
    let mut grip =
        Grip::take(Handle::MoveFacing, subject(Tool::Move, camera.target), &camera, SIZE, DVec2::ZERO)
            .unwrap();
    assert_eq!(grip.typed(&camera, 2.5, 0.0), None, "a number alone is no way in a plane");
    grip.only = Some(Axis::X);
    assert_eq!(grip.typed(&camera, 2.5, 0.0), Some(Pull::Move(dvec3(2.5, 0.0, 0.0))));
    let ring = Grip { handle: Handle::TurnAbout(Axis::Z), only: None, ..grip.clone() };
    assert_eq!(ring.typed(&camera, 30.0, PI / 6.0), Some(Pull::Turn { axis: DVec3::Z, angle: PI / 6.0 }));
    let radius = Grip { handle: Handle::Radius, ..grip };
    assert_eq!(radius.typed(&camera, 0.75, 0.0), Some(Pull::Radius(0.75)));
    assert_eq!(radius.typed(&camera, -1.0, 0.0), None);
    let scale = Grip { handle: Handle::Scale, ..radius };
    assert_eq!(scale.typed(&camera, 0.5, 0.0), Some(Pull::Scale(0.5)));
    assert_eq!(scale.typed(&camera, 0.0, 0.0), None);
}

fn ball(id: i64, position: DVec3, radius: f64) -> Body {
    Body::new(id, position, Motion::Static, Shape::Sphere { radius })
}

fn near(bodies: &[Body]) -> impl Iterator<Item = Neighbour<'_>> {
    bodies.iter().map(|body| Neighbour { body, position: body.position })
}

#[test]
fn a_ball_stops_where_it_touches() {
    let floor = Body {
        rotation: dvec3(-FRAC_PI_2, 0.0, 0.0),
        ..Body::new(1, dvec3(5.0, 0.0, 5.0), Motion::Static, Shape::Plane { half_x: 5.0, half_y: 5.0 })
    };
    let bodies = [floor, ball(2, dvec3(5.0, 0.5, 5.0), 0.5)];
    let line = Freedom::Line(DVec3::Y);
    let (at, guide) = touching(0.3, dvec3(2.0, 0.33, 2.0), line, near(&bodies), 0.1).unwrap();
    assert!((at.y - 0.3).abs() < 1e-15 && guide.touches && guide.with == bodies[0].key, "{at}");
    for freedom in [Freedom::Plane(DVec3::X, DVec3::Z), Freedom::Line(DVec3::X)] {
        let place = dvec3(5.87, 0.4, 5.0);
        let (at, guide) = touching(0.3, place, freedom, near(&bodies), 0.12).unwrap();
        assert_eq!(guide.with, bodies[1].key);
        assert!((at.distance(bodies[1].position) - 0.8).abs() < 1e-15, "the gap is zero: {at}");
        assert_eq!((at.y, at.z), (0.4, 5.0), "only what is free moves");
    }
    assert!(touching(0.3, dvec3(8.0, 3.0, 8.0), line, near(&bodies), 0.1).is_none(), "nothing is near");
}

#[test]
fn a_centre_comes_level_with_its_neighbours() {
    let bodies = [ball(1, dvec3(2.0, 1.0, 3.0), 0.2), ball(2, dvec3(9.0, 1.0, 7.0), 0.2)];
    let freedom = Freedom::Plane(DVec3::X, DVec3::Z);
    let (at, guides) = aligned(dvec3(2.04, 5.0, 6.97), &[DVec3::ZERO], freedom, near(&bodies), 0.05);
    assert_eq!(at, dvec3(2.0, 5.0, 7.0));
    assert_eq!(guides.iter().map(|guide| guide.with).collect::<Vec<_>>(), [bodies[0].key, bodies[1].key]);
    let (at, guides) = aligned(dvec3(4.0, 1.01, 5.0), &[DVec3::ZERO], freedom, near(&bodies), 0.05);
    assert_eq!((at, guides.len()), (dvec3(4.0, 1.01, 5.0), 0), "y is not free");
}

#[test]
fn a_plate_comes_edge_to_edge_with_its_neighbours() {
    let plate = |id, at| {
        let shape = Shape::Plane { half_x: 1.0, half_y: 2.0 };
        Body { rotation: dvec3(-FRAC_PI_2, 0.0, 0.0), ..Body::new(id, at, Motion::Static, shape) }
    };
    let bodies = [plate(1, dvec3(2.0, 0.0, 3.0))];
    let dragged = plate(2, dvec3(4.03, 0.0, 3.04));
    let freedom = Freedom::Plane(DVec3::X, DVec3::Z);
    let (at, guides) = aligned(dragged.position, &features(&dragged), freedom, near(&bodies), 0.05);
    assert!((at - dvec3(4.0, 0.0, 3.0)).length() < 1e-15, "{at}");
    assert_eq!(guides.len(), 2);
    let on_edge = |guide: &Guide| (guide.from.x - 3.0).abs() < 1e-15 && (guide.to.x - 3.0).abs() < 1e-15;
    assert!(guides.iter().any(on_edge), "{guides:?}");
}

#[test]
fn offsets_snap_to_tiles_along_each_axis_by_its_own_side() {
    let freedom = Freedom::Plane(DVec3::X, DVec3::Z);
    let offset = freedom.snapped_to_tiles(dvec3(0.3, 0.4, 0.2), dvec3(0.9, 7.0, 0.9), dvec3(0.5, 1.0, 0.75));
    assert!((offset - dvec3(0.7, 0.0, 0.55)).length() < 1e-15, "{offset}");
}
