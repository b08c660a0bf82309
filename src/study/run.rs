//! A whole study: the reference, every run compared with it, then every run timed.

use super::timing::{starting, summarise, time_run};
use super::{
    Candidate, Control, HorizonCause, Limits, SettingsError, StudyReport, StudySettings, Truth, measure,
};
use crate::scene::Scene;
use crate::sim::{CompileError, Method, Simulation};

/// Why there is no report at all.
#[derive(Clone, Debug, thiserror::Error)]
pub enum StudyError {
    #[error(transparent)]
    Settings(#[from] SettingsError),
    #[error(transparent)]
    Scene(#[from] CompileError),
}

/// Shares of the work, for the progress: the reference, and the comparisons; the rest is timing.
const REFERENCE: f64 = 0.4;
const COMPARISONS: f64 = 0.3;

/// Carries a study out. Cancelled, it reports what is done so far.
pub fn run(
    scene: &Scene,
    name: &str,
    settings: &StudySettings,
    control: &mut Control,
) -> Result<StudyReport, StudyError> {
    settings.check()?;
    let compiled = Simulation::new(scene)?;
    let mut report = StudyReport::new(name, settings);
    report.dynamic_bodies = compiled.plan().dynamic_bodies;
    report.static_bodies = compiled.plan().static_bodies;
    report.motion = compiled.plan().motion.to_owned();
    let candidates = candidates(&compiled, scene, settings);
    let limits = Limits::of(settings);

    control.begin("reference".into(), 0.0, REFERENCE);
    let times: Vec<f64> = candidates.iter().flat_map(|candidate| limits.sample_times(candidate)).collect();
    let truth = Truth::find(scene, &times, settings, control);
    report.horizon = truth.horizon.clone();
    if report.horizon.cause == HorizonCause::Cancelled {
        report.cancelled = true;
        report.out_of_time = control.is_out_of_time();
        return Ok(report);
    }

    let share = COMPARISONS / candidates.len() as f64;
    for (nth, candidate) in candidates.iter().enumerate() {
        control.begin(format!("comparing {}", candidate.label()), REFERENCE + nth as f64 * share, share);
        match measure(candidate, scene, &truth, &limits, control) {
            Some(point) => report.points.push(point),
            None => {
                report.cancelled = true;
                break;
            }
        }
    }
    report.cancelled |= !time_all(&candidates, scene, settings, &limits, &mut report, control);
    report.out_of_time = report.cancelled && control.is_out_of_time();
    Ok(report)
}

/// Times every point in turn, round after round; false when cancelled.
fn time_all(
    candidates: &[Candidate],
    scene: &Scene,
    settings: &StudySettings,
    limits: &Limits,
    report: &mut StudyReport,
    control: &mut Control,
) -> bool {
    let mut timings = vec![Vec::new(); report.points.len()];
    let starts: Vec<_> =
        candidates.iter().take(report.points.len()).map(|candidate| starting(candidate, scene)).collect();
    let start = REFERENCE + COMPARISONS;
    let share = (1.0 - start) / (f64::from(settings.repeat) * report.points.len().max(1) as f64);
    let mut is_whole = true;
    'rounds: for round in 0..settings.repeat {
        for (nth, point) in report.points.iter().enumerate() {
            let Some(sim) = &starts[nth] else { continue };
            let done = f64::from(round) * report.points.len() as f64 + nth as f64;
            let what = format!("timing {}, {} of {}", candidates[nth].label(), round + 1, settings.repeat);
            control.begin(what, start + done * share, share);
            if control.is_cancelled() {
                is_whole = false;
                break 'rounds;
            }
            timings[nth].extend(time_run(&candidates[nth], sim, point, limits, control));
        }
    }
    for (point, timings) in report.points.iter_mut().zip(&mut timings) {
        summarise(timings, point);
    }
    is_whole
}

/// Every run of a study, in the order of the report.
fn candidates(compiled: &Simulation, scene: &Scene, settings: &StudySettings) -> Vec<Candidate> {
    let mut candidates = Vec::new();
    let mut dts = settings.dts.clone();
    dts.sort_by(|left, right| right.total_cmp(left));
    dts.dedup();
    for method in Method::ALL.into_iter().filter(|method| settings.methods.contains(method)) {
        let plain = Candidate { method, dt: None, tolerance: None, group_step: None };
        if method.depends_on_dt() {
            candidates.extend(dts.iter().map(|&dt| Candidate { dt: Some(dt), ..plain }));
        } else {
            let tolerances = tolerances(compiled, scene, settings);
            candidates.extend(tolerances.into_iter().map(|tolerance| Candidate { tolerance, ..plain }));
            let steps = group_steps(compiled, settings);
            candidates.extend(steps.into_iter().map(|step| Candidate { group_step: Some(step), ..plain }));
        }
    }
    candidates
}

/// The scene's own tolerance and those asked for, where they matter; coarse first.
fn tolerances(compiled: &Simulation, scene: &Scene, settings: &StudySettings) -> Vec<Option<f64>> {
    if compiled.plan().motion == "ballistic" || settings.tolerances.is_empty() {
        return vec![None];
    }
    let mut tolerances = settings.tolerances.clone();
    tolerances.push(scene.params.field_tolerance);
    tolerances.sort_by(|left, right| right.total_cmp(left));
    tolerances.dedup();
    tolerances.into_iter().map(Some).collect()
}

/// The group steps asked for, s, where anything can be stepped; coarse first. The scene's own is that of all other runs.
fn group_steps(compiled: &Simulation, settings: &StudySettings) -> Vec<f64> {
    let own = compiled.plan().group_step;
    let mut parts = settings.group_steps.clone();
    parts.retain(|part| *part != 1.0);
    parts.sort_by(|left, right| right.total_cmp(left));
    parts.dedup();
    let steps = parts.into_iter().map(|part| part * own);
    steps.filter(|step| *step > 0.0 && step.is_finite()).collect()
}
