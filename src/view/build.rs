//! From a scene and a camera to a draw list, stage by stage.

use super::{DrawList, OVERLAYS, ViewInput, bodies, forces, furniture, overlays, stage::Stage};

/// Everything one view shows.
pub fn build_draw_list(input: &ViewInput<'_>) -> DrawList {
    let stage = Stage::new(input);
    let mut list = empty_list(&stage);
    bodies::add(&stage, &mut list);
    forces::add(&stage, &mut list);
    for overlay in OVERLAYS.iter().filter(|overlay| input.overlays.contains(overlay.id)) {
        (overlay.add)(&stage, &mut list);
    }
    overlays::highlight::add(&stage, &mut list);
    // Of lines in one place the widest, such as the edge of what is selected, is seen.
    list.lines.sort_by(|a, b| a.width.total_cmp(&b.width));
    furniture::axis_triad(&stage, &mut list);
    furniture::scale_bar(&stage, &mut list);
    furniture::legend(&stage, &mut list);
    list
}

fn empty_list(stage: &Stage<'_>) -> DrawList {
    let camera = &stage.camera;
    // The target is in the middle of what is seen, so differences to it are the smallest.
    let origin = camera.target;
    DrawList {
        revision: 0,
        origin,
        viewport: stage.input.viewport,
        view: camera.view_matrix(origin).as_mat4(),
        projection: camera.projection_matrix(stage.input.viewport.aspect()).as_mat4(),
        is_perspective: camera.projection == super::Projection::Perspective,
        background: stage.palette.background,
        spheres: Vec::new(),
        plates: Vec::new(),
        lines: Vec::new(),
        arrows: Vec::new(),
        points: Vec::new(),
        strokes: Vec::new(),
        labels: Vec::new(),
        legend: Vec::new(),
        notes: Vec::new(),
    }
}
