//! What a run came to, for programs (JSON) and for people.

use std::fmt::Write as _;

use serde::{Serialize, Serializer};

use super::drive::Ending;
use super::recorder::Overlaps;
use crate::cli::samples::SampleGrid;
use crate::cli::{CliError, output};
use crate::scene::{HEAP_OVERLAP, Map};
use crate::sim::{Energy, EventKind, Method, Plan, Simulation};

/// Overlap that deserves a warning, of the smallest radius: ten times what the bodies of a heap may have.
const DEEP: f64 = 10.0 * HEAP_OVERLAP;

/// The object that `--json` prints. What cannot be computed is `null`.
#[derive(Serialize)]
pub struct Summary<'a> {
    /// How it was stepped.
    method: &'static str,
    /// Model time reached, s.
    t: f64,
    /// Δt asked for, s; `null` if none was.
    dt: Option<f64>,
    /// How many Δt the whole run has.
    steps: u64,
    /// Why the run stopped early; `null` when it reached its end.
    stopped: Option<String>,
    events: ByKind,
    wall_s: f64,
    energy: EnergyReport,
    momentum: MomentumReport,
    /// About the map's origin, kg·m²/s; only where bodies rub.
    #[serde(skip_serializing_if = "Option::is_none")]
    angular_momentum: Option<MomentumReport>,
    /// m, the deepest at any sample that was looked at.
    max_overlap: f64,
    /// Moving bodies whose centres are outside the map at the end.
    outside_map: usize,
    /// FNV-1a of the last state's bits, in hexadecimal.
    hash: String,
    work: WorkReport,
    plan: PlanReport<'a>,
    warnings: &'a [String],
}

/// Events by kind, in the order of [`EventKind::ALL`]; without what no scene has where nothing rubs.
struct ByKind {
    counts: [u64; EventKind::ALL.len()],
    rubs: bool,
}

impl Serialize for ByKind {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let all = EventKind::ALL.iter().zip(self.counts);
        let there = all.filter(|(kind, _)| self.rubs || **kind != EventKind::Roll);
        serializer.collect_map(there.map(|(kind, count)| (kind.name(), count)))
    }
}

/// J.
#[derive(Serialize)]
struct EnergyReport {
    kinetic: f64,
    potential: Option<f64>,
    total: Option<f64>,
    residual: Option<f64>,
}

/// kg·m/s.
#[derive(Serialize)]
struct MomentumReport {
    value: [f64; 3],
    residual: f64,
}

/// What the answer cost.
#[derive(Serialize)]
struct WorkReport {
    pair_tests: u64,
    tile_crossings: u64,
    segments: u64,
    force_evaluations: u64,
    given_up: u64,
    stale_events: u64,
    group_steps: u64,
    group_halvings: u64,
    group_contacts: u64,
    group_sweeps: u64,
}

#[derive(Serialize)]
struct PlanReport<'a> {
    dynamic_bodies: usize,
    static_bodies: usize,
    motion: &'a str,
    pairs: &'a [&'static str],
    lasting_contact: bool,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    spin: bool,
    group_step: f64,
    left_out: &'a [&'static str],
}

impl<'a> Summary<'a> {
    pub fn new(
        sim: &'a Simulation,
        grid: &SampleGrid,
        ending: &Ending,
        (max_overlap, map): (f64, &Map),
        wall_s: f64,
        warnings: &'a [String],
    ) -> Self {
        let counters = sim.counters();
        let momentum = sim.momentum();
        Self {
            method: sim.method().name(),
            t: sim.time(),
            dt: grid.dt,
            steps: grid.steps,
            stopped: match ending {
                Ending::Finished => None,
                Ending::NobodyListens => Some("every reader of the output went away".into()),
                Ending::Interrupted => Some("interrupted".into()),
                Ending::Faulted(fault) => Some(fault.to_string()),
                Ending::Exceeded(why) => Some(format!("early, at t = {} s: {why}", sim.time())),
            },
            events: ByKind { counts: counters.events, rubs: sim.plan().spin },
            wall_s,
            energy: energy_report(sim.energy()),
            angular_momentum: sim.angular_momentum().map(|angular| MomentumReport {
                value: angular.value.to_array(),
                residual: angular.residual,
            }),
            momentum: MomentumReport { value: momentum.value.to_array(), residual: momentum.residual },
            max_overlap,
            outside_map: count_outside(sim, map),
            hash: format!("{:016x}", sim.hash()),
            work: WorkReport {
                pair_tests: counters.pair_tests,
                tile_crossings: counters.tile_crossings,
                segments: counters.segments,
                force_evaluations: counters.force_evaluations,
                given_up: counters.given_up,
                stale_events: counters.stale_events,
                group_steps: counters.steps,
                group_halvings: counters.halvings,
                group_contacts: counters.contacts,
                group_sweeps: counters.sweeps,
            },
            plan: plan_report(sim.plan()),
            warnings,
        }
    }

    pub fn print_json(&self) -> Result<(), CliError> {
        let text =
            serde_json::to_string(self).map_err(|error| CliError::unprintable("--json", &error.into()))?;
        output::print(format!("{text}\n").as_bytes())
    }

    pub fn print_for_people(&self, scene: &str) -> Result<(), CliError> {
        output::print(self.for_people(scene).as_bytes())
    }

    fn for_people(&self, scene: &str) -> String {
        let steps = match self.dt {
            Some(dt) => format!("{} steps of {} s", self.steps, short(dt)),
            None => "event by event".into(),
        };
        let mut text = format!("{scene}: {} s, {steps}, method {}\n", short(self.t), self.method);
        if let Some(stopped) = &self.stopped {
            line(&mut text, "stopped", stopped);
        }
        let total: u64 = self.events.counts.iter().sum();
        line(&mut text, "events", &format!("{total}{}", self.kinds()));
        line(&mut text, "energy", &self.energy.for_people());
        let [x, y, z] = self.momentum.value.map(short);
        let residual = small(self.momentum.residual);
        line(&mut text, "momentum", &format!("({x}, {y}, {z}) kg·m/s; residual {residual}"));
        if let Some(MomentumReport { value, residual }) = &self.angular_momentum {
            let [x, y, z] = value.map(short);
            line(&mut text, "spin", &format!("L = ({x}, {y}, {z}) kg·m²/s; residual {}", small(*residual)));
        }
        line(&mut text, "overlap", &format!("at most {} m at a sample", small(self.max_overlap)));
        if self.outside_map > 0 {
            let bodies = self.plan.dynamic_bodies;
            line(&mut text, "outside", &format!("the map: {} of {bodies} moving bodies", self.outside_map));
        }
        if self.work.given_up > 0 {
            let what = if self.method == Method::Exact.name() {
                "the search for motions that all contacts allow ran into its limit of rounds"
            } else {
                "a Δt ran into its limit of collisions"
            };
            line(&mut text, "given up", &format!("{} times: {what}", self.work.given_up));
        }
        line(&mut text, "plan", &self.plan.for_people());
        for (nth, what) in self.plan.left_out.iter().enumerate() {
            line(&mut text, if nth == 0 { "left out" } else { "" }, what);
        }
        let (speed, rate) = (rounded(self.t / self.wall_s, 3), rounded(total as f64 / self.wall_s, 3));
        line(&mut text, "speed", &format!("{:.3} s, {speed} times real time, {rate} events/s", self.wall_s));
        line(&mut text, "hash", &self.hash);
        text
    }

    /// ` (240 impact, 2 rest)`, without the kinds that did not happen.
    fn kinds(&self) -> String {
        let kinds = EventKind::ALL.iter().zip(self.events.counts).filter(|(_, count)| *count > 0);
        let kinds: Vec<_> = kinds.map(|(kind, count)| format!("{count} {}", kind.name())).collect();
        if kinds.is_empty() { String::new() } else { format!(" ({})", kinds.join(", ")) }
    }
}

impl EnergyReport {
    fn for_people(&self) -> String {
        let Self { kinetic, potential, total, residual } = *self;
        let (Some(potential), Some(total)) = (potential, total) else {
            return format!("{} J kinetic; a force has no potential, so there is no total", short(kinetic));
        };
        let residual = residual.map_or("unknown: a force without a potential was removed".into(), small);
        let (total, kinetic, potential) = (short(total), short(kinetic), short(potential));
        format!("{total} J: {kinetic} kinetic, {potential} potential; residual {residual}")
    }
}

impl PlanReport<'_> {
    fn for_people(&self) -> String {
        let mut text =
            format!("{} dynamic, {} static; {} motion", self.dynamic_bodies, self.static_bodies, self.motion);
        if !self.pairs.is_empty() {
            let _ = write!(text, "; {}", self.pairs.join(", "));
        }
        if self.spin {
            text.push_str("; bodies rub and turn");
        }
        if self.lasting_contact {
            text.push_str("; contacts can last");
        }
        text
    }
}

/// Says that sums of the last state are too large to be numbers, where they are.
pub fn overflow_warning(sim: &Simulation) -> Option<String> {
    let Energy { kinetic, potential, total, .. } = sim.energy();
    let energies = [Some(kinetic), potential, total].into_iter().flatten();
    let what = match (energies.into_iter().all(f64::is_finite), sim.momentum().value.is_finite()) {
        (true, true) => return None,
        (false, true) => "the energy is",
        (true, false) => "the momentum is",
        (false, false) => "energy and momentum are",
    };
    Some(format!(
        "{what} beyond the largest number, about 1.8e308, and reported as null; \
         write the scene with smaller masses or speeds"
    ))
}

/// Says that bodies went far deeper into each other than those of a heap may, which are pressed there. What overlapped so when the
/// run began was told then.
pub fn overlap_warning(overlaps: Overlaps, smallest_radius: Option<f64>, method: Method) -> Option<String> {
    if overlaps.more() <= DEEP * smallest_radius? {
        return None;
    }
    let way_out = match method {
        Method::Exact => "masses that differ less, or a smaller DenseStep, may avoid it",
        Method::Thesis | Method::Fixed => "a smaller --dt or --method exact may avoid it",
    };
    Some(format!(
        "bodies overlapped by {} m at a sample, more than {DEEP} of the smallest radius: since then they may have moved as no rigid \
         bodies do; {way_out}",
        small(overlaps.worst)
    ))
}

fn count_outside(sim: &Simulation, map: &Map) -> usize {
    let states = sim.dynamic_bodies().filter_map(|body| sim.state(body));
    states.filter(|state| !map.contains(state.position)).count()
}

fn energy_report(energy: Energy) -> EnergyReport {
    let Energy { kinetic, potential, total, residual } = energy;
    EnergyReport { kinetic, potential, total, residual }
}

fn plan_report(plan: &Plan) -> PlanReport<'_> {
    PlanReport {
        dynamic_bodies: plan.dynamic_bodies,
        static_bodies: plan.static_bodies,
        motion: plan.motion,
        pairs: &plan.pairs,
        lasting_contact: plan.lasting_contact,
        spin: plan.spin,
        group_step: plan.group_step,
        left_out: &plan.left_out,
    }
}

/// Six significant digits, for people.
fn short(value: f64) -> String {
    rounded(value, 6)
}

fn rounded(value: f64, digits: i32) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value:.0}");
    }
    let exponent = libm::log10(value.abs()).floor() as i32;
    if !(-4..9).contains(&exponent) {
        return format!("{value:.*e}", digits as usize - 1);
    }
    let text = format!("{value:.*}", (digits - 1 - exponent).max(0) as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}

/// Residuals and overlaps: their size is what matters.
fn small(value: f64) -> String {
    if value == 0.0 { "0".into() } else { format!("{value:.1e}") }
}

fn line(text: &mut String, label: &str, value: &str) {
    let _ = writeln!(text, "  {label:<10}{value}");
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(depths: &[f64], radius: f64, method: Method) -> Option<String> {
        let mut overlaps = Overlaps::default();
        depths.iter().for_each(|depth| overlaps.note(*depth));
        overlap_warning(overlaps, Some(radius), method)
    }

    #[test]
    fn bodies_that_went_deep_are_told_of_and_those_of_a_heap_or_the_start_are_not() {
        let deep = told(&[0.0, 0.02, 0.0], 1.0, Method::Exact).unwrap();
        assert!(deep.contains("2.0e-2 m") && deep.contains("DenseStep"), "{deep}");
        assert!(told(&[0.0, 0.02], 1.0, Method::Fixed).unwrap().contains("--method exact"));
        assert_eq!(told(&[0.0, 0.001], 1.0, Method::Exact), None, "as a heap has");
        assert_eq!(told(&[0.02, 0.021, 0.01], 1.0, Method::Exact), None, "told when it was read");
        assert_eq!(told(&[0.0, 0.02], 10.0, Method::Exact), None, "of large balls it is little");
    }
}
