//! The settings in the element `Simulation`: `TimeSpeed` and, since 1.1, `Solver`.

use super::log::Log;
use crate::scene::rules::Range;
use crate::scene::tree::View;
use crate::scene::{PARAMS, SimParams};

/// Reads the time speed.
pub(super) fn time_speed<'a>(el: Option<View<'a>>, log: &mut Log<'a>) -> f64 {
    el.and_then(|el| log.scalar(el, Range::NotNegative)).unwrap_or(1.0)
}

/// Reads the parameters of the core; those not written keep their defaults.
pub(super) fn params<'a>(el: Option<View<'a>>, log: &mut Log<'a>) -> SimParams {
    let mut params = SimParams::default();
    let Some(el) = el else { return params };
    log.within(el, |log| {
        let names = PARAMS.iter().map(|info| info.name).collect::<Vec<_>>();
        log.leaf(el, &names);
        for info in PARAMS.iter().filter(|info| el.attribute(info.name).is_some()) {
            if let Some(value) = log.number(el, info.name, Range::of_param(info)) {
                (info.set)(&mut params, value);
            }
        }
    });
    params
}
