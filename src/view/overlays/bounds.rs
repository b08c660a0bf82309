//! (to come)

use crate::view::DrawList;
use crate::view::stage::Stage;

pub(in crate::view) fn add(_stage: &Stage<'_>, _list: &mut DrawList) {}
