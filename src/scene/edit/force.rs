//! Edits of one force.

use std::sync::Arc;

use super::cosmetic;
use super::pen::{Changed, Pen, check, check_text, check_vector};
use super::settings::vector;
use super::{EditError, ForceChange};
use crate::scene::ForceKind;
use crate::scene::rules::Range;
use crate::scene::tree::Element;

const ORDER: [&str; 3] = ["Translation", "Gravity", "Density"];

/// Applies one change to a force's element.
pub(super) fn change(pen: Pen<'_>, el: &Arc<Element>, lead: &str, change: &ForceChange) -> Changed {
    match change {
        ForceChange::Id(id) => Ok(pen.with_text(el, "UserID", &id.to_string())),
        ForceChange::Name(name) => {
            let name = name.as_deref().filter(|name| !name.is_empty());
            name.map_or(Ok(()), check_text)?;
            cosmetic::set(pen, el, lead, "name", name)
        }
        ForceChange::Group(group) => {
            let group = group.as_deref().filter(|group| !group.is_empty());
            group.map_or(Ok(()), check_text)?;
            cosmetic::set(pen, el, lead, "group", group)
        }
        ForceChange::Hidden(on) => cosmetic::set(pen, el, lead, "hidden", cosmetic::flag(*on)),
        ForceChange::Locked(on) => cosmetic::set(pen, el, lead, "locked", cosmetic::flag(*on)),
        ForceChange::Kind(kind) => {
            check_kind(kind)?;
            if pen.view(el).name() != kind_name(kind) {
                return Err(EditError::Invalid("a force keeps its kind; add another and delete this".into()));
            }
            set_kind(pen, el, lead, kind)
        }
    }
}

/// Refuses what the reader would call an error.
pub(super) fn check_kind(kind: &ForceKind) -> Result<(), EditError> {
    match *kind {
        ForceKind::GravityPoint { position, intensity } => {
            check_vector("the position", position, Range::Any)?;
            check("the intensity", intensity, Range::Any)
        }
        ForceKind::GravityPlane { position, acceleration } => {
            check_vector("the position", position, Range::Any)?;
            check_vector("the acceleration", acceleration, Range::Any)
        }
        ForceKind::Drag { density } => check("the density", density, Range::NotNegative),
    }
}

fn set_kind(pen: Pen<'_>, el: &Arc<Element>, lead: &str, kind: &ForceKind) -> Changed {
    let zero = Some(0.0);
    match *kind {
        ForceKind::GravityPoint { position, intensity } => {
            let el = pen.with_leaf(el, lead, ("Translation", &ORDER), &vector(position), zero)?;
            pen.with_leaf(&el, lead, ("Gravity", &ORDER), &[("F32", intensity)], zero)
        }
        ForceKind::GravityPlane { position, acceleration } => {
            let el = pen.with_leaf(el, lead, ("Translation", &ORDER), &vector(position), zero)?;
            pen.with_leaf(&el, lead, ("Gravity", &ORDER), &vector(acceleration), zero)
        }
        ForceKind::Drag { density } => {
            pen.with_leaf(el, lead, ("Density", &ORDER), &[("F32", density)], None)
        }
    }
}

pub(super) fn kind_name(kind: &ForceKind) -> &'static str {
    match kind {
        ForceKind::GravityPoint { .. } => "GravityPoint",
        ForceKind::GravityPlane { .. } => "GravityPlane",
        ForceKind::Drag { .. } => "SpaceAverse",
    }
}
