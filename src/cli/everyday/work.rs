//! Runs the scenes, one after the other or several at a time, with a bar on standard error.

use std::io::IsTerminal as _;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use indicatif::{ProgressBar, ProgressStyle};

use crate::study::everyday::{Effort, Outcome, Setup, judge, misses};

/// What came of each scene, in the order given.
pub fn judge_all(setups: &[Setup], effort: Effort, jobs: u8) -> Vec<(Setup, Outcome)> {
    let bar = bar(setups.len());
    let (next, missed) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let judged = Mutex::new(Vec::new());
    let work = || {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(setup) = setups.get(index) else { return };
            bar.set_message(format!("{setup}; {} missed", missed.load(Ordering::Relaxed)));
            let outcome = judge(setup, effort);
            missed.fetch_add(usize::from(!misses(&outcome).is_empty()), Ordering::Relaxed);
            bar.inc(1);
            if let Ok(mut judged) = judged.lock() {
                judged.push((index, *setup, outcome));
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..jobs {
            scope.spawn(work);
        }
    });
    bar.finish_and_clear();
    let mut judged = judged.into_inner().unwrap_or_default();
    judged.sort_by_key(|(index, ..)| *index);
    judged.into_iter().map(|(_, setup, outcome)| (setup, outcome)).collect()
}

fn bar(length: usize) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:24} {pos}/{len}  {msg}");
    ProgressBar::new(length as u64).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
