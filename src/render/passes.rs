//! One picture, pass by pass, into whatever framebuffer is bound.

use std::sync::Arc;

use three_d::{
    Blend, Context, Cull, DepthTest, Mat4, Program, RenderStates, Viewport, WriteMask, vec2, vec3,
};

use super::RenderError;
use super::batch::Batch;
use super::beads::Beads;
use super::gl::Gl;
use super::programs::Programs;
use super::view_target::Quality;
use crate::view::DrawList;

/// Programs and buffers; the buffers hold one list at a time.
pub(super) struct Passes {
    context: Context,
    programs: Programs,
    background: Batch,
    spheres: Batch,
    /// Those of the spheres that a draft shows as points.
    beads: Beads,
    solid_plates: Batch,
    glass_plates: Batch,
    lines: Batch,
    top_lines: Batch,
    arrows: Batch,
    points: Batch,
    strokes: Batch,
}

/// How far lines are pulled towards the eye, over the distance: more than the depth buffer's steps.
const LINE_PULL: f32 = 2e-3;

impl Passes {
    pub fn new(context: Context) -> Result<Self, RenderError> {
        Ok(Self {
            programs: Programs::new(&context)?,
            background: Batch::background(&context),
            spheres: Batch::spheres(&context),
            beads: Beads::new(&context),
            solid_plates: Batch::plates(&context),
            glass_plates: Batch::plates(&context),
            lines: Batch::strokes(&context),
            top_lines: Batch::strokes(&context),
            arrows: Batch::strokes(&context),
            points: Batch::points(&context),
            strokes: Batch::strokes(&context),
            context,
        })
    }

    pub fn gl(&self) -> Gl {
        Gl(Arc::clone(&self.context))
    }

    /// Draws the whole list for a picture of `size` pixels; the bound framebuffer has as many as its quality wants.
    pub fn draw(&mut self, list: &DrawList, size: [u32; 2], quality: Quality) {
        let drawn = size.map(|side| quality.pixels(side));
        let share = drawn[1] as f32 / size[1].max(1) as f32;
        let scale = share * list.viewport.pixels_per_point as f32;
        self.upload_spheres(list, drawn[1], scale, quality);
        self.upload(list, scale);
        let view = View::new(list, drawn);
        self.clear(&view);
        // Orthographic views have a far limit; bodies beyond it are to be seen.
        self.gl().clamp_depth(!list.is_perspective);
        self.draw_plates(&self.solid_plates, &view, SOLID);
        self.draw_beads(&view);
        self.draw_spheres(&view);
        self.draw_strokes(&self.lines, &view, LINE_PULL, TESTED);
        self.draw_plates(&self.glass_plates, &view, TESTED);
        self.draw_strokes(&self.top_lines, &view, 0.0, ON_TOP);
        self.draw_strokes(&self.arrows, &view, 0.0, ON_TOP);
        self.draw_points(&view);
        self.gl().clamp_depth(false);
        self.draw_strokes(&self.strokes, &view.flat(), 0.0, ON_TOP);
    }

    /// `height` and `scale`, pixels per point, are of the picture that is drawn.
    fn upload_spheres(&mut self, list: &DrawList, height: u32, scale: f32, quality: Quality) {
        let spheres = match quality {
            Quality::Full => {
                self.beads.clear();
                list.spheres.iter().collect()
            }
            Quality::Draft => self.beads.take(list, height, scale),
        };
        self.spheres.fill_spheres(&spheres, scale);
    }

    fn upload(&mut self, list: &DrawList, scale: f32) {
        let (solid, glass): (Vec<_>, Vec<_>) = list.plates.iter().partition(|plate| plate.color.is_opaque());
        self.background.fill_background(list.background);
        self.solid_plates.fill_plates(&solid);
        self.glass_plates.fill_plates(&glass);
        self.lines.fill_lines(list.lines.iter().filter(|line| !line.on_top), scale);
        self.top_lines.fill_lines(list.lines.iter().filter(|line| line.on_top), scale);
        self.arrows.fill_arrows(&list.arrows, scale);
        self.points.fill_points(&list.points, scale);
        self.strokes.fill_strokes(list, scale);
    }

    fn clear(&self, view: &View) {
        self.gl().clear();
        let program = &self.programs.background;
        self.background.bind(program);
        program.draw_arrays_instanced(ON_TOP, view.viewport, 3, self.background.count());
    }

    fn draw_spheres(&self, view: &View) {
        // Silhouettes come from ray casting, which multisampling cannot see: their coverage is in alpha.
        self.gl().cover_by_alpha(true);
        self.draw_instances(&self.programs.sphere, &self.spheres, view, 0.0, SOLID);
        self.gl().cover_by_alpha(false);
    }

    fn draw_beads(&self, view: &View) {
        if self.beads.count() > 0 {
            let program = &self.programs.bead;
            program.use_uniform_if_required("skyward", view.skyward);
            self.beads.bind(program);
            program.draw_with(SOLID, view.viewport, || self.gl().draw_points(self.beads.count()));
        }
    }

    fn draw_plates(&self, batch: &Batch, view: &View, states: RenderStates) {
        self.draw_instances(&self.programs.plate, batch, view, 0.0, states);
    }

    fn draw_strokes(&self, batch: &Batch, view: &View, pull: f32, states: RenderStates) {
        self.draw_instances(&self.programs.stroke, batch, view, pull, states);
    }

    fn draw_points(&self, view: &View) {
        self.draw_instances(&self.programs.point, &self.points, view, 0.0, ON_TOP);
    }

    fn draw_instances(&self, program: &Program, batch: &Batch, view: &View, pull: f32, states: RenderStates) {
        if batch.count() == 0 {
            return;
        }
        program.use_uniform_if_required("viewMatrix", view.view);
        program.use_uniform_if_required("projection", view.projection);
        program.use_uniform_if_required("skyward", view.skyward);
        let size = vec2(view.viewport.width as f32, view.viewport.height as f32);
        program.use_uniform_if_required("viewportPx", size);
        program.use_uniform_if_required("pull", pull);
        batch.bind(program);
        program.draw_arrays_instanced(states, view.viewport, 6, batch.count());
    }
}

/// Colour without alpha: a framebuffer's alpha stays 1, so that a picture is opaque.
const RGB: WriteMask = WriteMask { red: true, green: true, blue: true, alpha: false, depth: false };

const SOLID: RenderStates = RenderStates {
    write_mask: WriteMask { depth: true, ..RGB },
    depth_test: DepthTest::LessOrEqual,
    blend: Blend::Disabled,
    cull: Cull::None,
};

/// Blended, and hidden by what is nearer.
const TESTED: RenderStates = RenderStates { write_mask: RGB, blend: Blend::TRANSPARENCY, ..SOLID };

const ON_TOP: RenderStates = RenderStates { depth_test: DepthTest::Always, ..TESTED };

/// The camera as uniforms.
struct View {
    view: Mat4,
    projection: Mat4,
    skyward: three_d::Vec3,
    viewport: Viewport,
}

impl View {
    fn new(list: &DrawList, [width, height]: [u32; 2]) -> Self {
        let up = list.view.transform_vector3(glam::Vec3::Y);
        Self {
            view: Mat4::from(list.view.to_cols_array_2d()),
            projection: Mat4::from(list.projection.to_cols_array_2d()),
            skyward: vec3(up.x, up.y, up.z),
            viewport: Viewport::new_at_origo(width, height),
        }
    }

    /// Positions are device coordinates already.
    fn flat(&self) -> Self {
        let identity = Mat4::from(glam::Mat4::IDENTITY.to_cols_array_2d());
        Self { view: identity, projection: identity, ..*self }
    }
}
