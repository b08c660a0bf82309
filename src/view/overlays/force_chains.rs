//! What presses on what in a heap: a line through each contact, the thicker and brighter the larger its force.

use crate::record::ContactFrame;
use crate::view::camera::is_drawable;
use crate::view::format::short;
use crate::view::stage::{Pen, Stage};
use crate::view::{Color, DrawList};

const MOST: usize = 5000;

/// Share of the largest force below which a contact carries nothing that could be seen.
const LEAST: f64 = 1e-3;

/// Widths of lines of no force and of the largest, points; and how opaque they are.
const WIDTHS: (f64, f64) = (0.75, 7.0);
const ALPHAS: (f64, f64) = (70.0, 255.0);

pub(in crate::view) fn add(stage: &Stage<'_>, list: &mut DrawList) {
    let Some(frame) = stage.input.frame else { return };
    let largest = frame.contacts.iter().map(|contact| contact.force).fold(0.0, f64::max);
    let is_shown = |contact: &&ContactFrame| {
        contact.force > LEAST * largest && contact.ends.into_iter().all(is_drawable)
    };
    let mut shown: Vec<&ContactFrame> = frame.contacts.iter().filter(is_shown).collect();
    // The strongest last, over the others.
    shown.sort_by(|one, other| one.force.total_cmp(&other.force));
    let left_out = shown.len().saturating_sub(MOST);
    for contact in &shown[left_out..] {
        stage.add_line(list, contact.ends, pen(stage.palette.chain, contact.force / largest));
    }
    if !shown.is_empty() {
        list.legend.push((stage.palette.chain, format!("force chains: thickest = {} N", short(largest))));
    }
    if left_out > 0 || frame.contacts_truncated {
        list.notes.push(format!("Force chains: only the {} strongest contacts.", shown.len() - left_out));
    }
}

fn pen(color: Color, share: f64) -> Pen {
    let between = |(low, high): (f64, f64), share: f64| low + (high - low) * share;
    // Forces in a heap spread over decades; their roots do not, so that weak ones are seen too.
    let alpha = between(ALPHAS, share.sqrt());
    Pen::over_bodies(color.with_alpha(alpha as u8), between(WIDTHS, share) as f32)
}
