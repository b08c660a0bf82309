//! How well views are drawn: those that take long, as where the processor draws, as drafts while they change, and in full
//! as soon as they rest.

use std::collections::BTreeMap;

use crate::render::Quality;

/// A view that takes longer than this in full makes a hand wait, s: two of them and the panels are a frame.
const SLOW_S: f64 = 0.012;

/// A view that has not changed for so long rests, s: longer than from one move of a hand to the next.
const REST_S: f64 = 0.15;

/// What is known of the views drawn so far.
#[derive(Default)]
pub(super) struct Drafts {
    views: BTreeMap<usize, Drawn>,
    /// The turn of the window, by its time, in which a view that takes long was drawn in full last, s.
    refined_s: Option<f64>,
    /// Whether there are no drafts: for scripts, which wait for what they have asked for.
    pub in_full: bool,
}

#[derive(Clone, Copy, Debug, Default)]
struct Drawn {
    /// What the last picture in full took, s.
    full_s: f64,
    /// What is to be seen, and since when, s.
    revision: u64,
    since_s: f64,
    /// Whether that was drawn in full, and whether it was to be.
    is_full: bool,
    had_turn: bool,
}

impl Drafts {
    /// How to draw a view's picture of that revision at a time, s; with a draft, in how many seconds to look again. One that
    /// waits for its turn to show what is now does not rest, however long that takes. Of those that rest one a turn is drawn in full:
    /// all at once would be felt by the hand that goes on.
    pub fn quality(
        &mut self,
        view: usize,
        (revision, waits): (u64, bool),
        now_s: f64,
    ) -> (Quality, Option<f64>) {
        let drawn = self.views.entry(view).or_default();
        if waits {
            drawn.since_s = now_s;
        }
        if drawn.revision != revision || revision == 0 {
            *drawn = Drawn { revision, since_s: now_s, is_full: false, had_turn: false, ..*drawn };
        }
        if self.in_full || drawn.is_full || drawn.full_s <= SLOW_S {
            return (Quality::Full, None);
        }
        let left = REST_S - (now_s - drawn.since_s);
        if left > 0.0 {
            return (Quality::Draft, Some(left));
        }
        // One that had its turn and was not drawn, for nothing of it is seen, keeps nobody waiting.
        if !drawn.had_turn && self.refined_s.replace(now_s) == Some(now_s) {
            return (Quality::Draft, Some(0.0));
        }
        drawn.had_turn = true;
        (Quality::Full, None)
    }

    /// Notes that a view was drawn, and how long that took, s.
    pub fn note(&mut self, view: usize, quality: Quality, took_s: f64) {
        let drawn = self.views.entry(view).or_default();
        if quality == Quality::Full {
            (drawn.full_s, drawn.is_full) = (took_s, true);
        }
    }

    /// Whether one of the views is still to be drawn in full.
    pub fn has_drafts(&self, is_shown: impl Fn(usize) -> bool) -> bool {
        let waits = |drawn: &Drawn| !drawn.is_full && drawn.full_s > SLOW_S;
        !self.in_full && self.views.iter().any(|(view, drawn)| is_shown(*view) && waits(drawn))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_drawn_quickly_is_drawn_in_full() {
        let mut drafts = Drafts::default();
        for revision in 1..9 {
            assert_eq!(drafts.quality(0, (revision, false), 0.02 * revision as f64), (Quality::Full, None));
            drafts.note(0, Quality::Full, 0.002);
            assert!(!drafts.has_drafts(|_| true));
        }
    }

    #[test]
    fn what_takes_long_is_a_draft_until_it_rests() {
        let mut drafts = Drafts::default();
        assert_eq!(drafts.quality(0, (1, false), 0.0).0, Quality::Full);
        drafts.note(0, Quality::Full, 0.2);
        assert_eq!(drafts.quality(0, (1, false), 0.1), (Quality::Full, None), "it is there");
        for (revision, now_s) in [(2, 1.0), (3, 1.05), (3, 1.15)] {
            let (quality, again_s) = drafts.quality(0, (revision, false), now_s);
            assert_eq!(quality, Quality::Draft);
            assert!(again_s.unwrap() <= REST_S);
            drafts.note(0, quality, 0.03);
            assert!(drafts.has_drafts(|view| view == 0) && !drafts.has_drafts(|view| view == 1));
        }
        assert_eq!(drafts.quality(0, (3, false), 1.3), (Quality::Full, None));
        drafts.note(0, Quality::Full, 0.2);
        assert!(!drafts.has_drafts(|_| true));
        assert_eq!(drafts.quality(0, (3, false), 1.31).0, Quality::Full);
    }

    /// Symptom: when the hand rested, four large views were drawn in full in one frame of 85 ms.
    #[test]
    fn views_that_rest_are_drawn_in_full_one_after_the_other() {
        let mut drafts = Drafts::default();
        for view in 0..3 {
            drafts.note(view, Quality::Full, 0.03);
            assert_eq!(drafts.quality(view, (1, false), 1.0).0, Quality::Draft);
        }
        for (turn, now_s) in [2.0, 2.1, 2.2].into_iter().enumerate() {
            for view in 0..3 {
                let (quality, again_s) = drafts.quality(view, (1, false), now_s);
                let (full, waits) = (view <= turn, view > turn);
                assert_eq!(
                    (quality == Quality::Full, again_s),
                    (full, waits.then_some(0.0)),
                    "{view} in {turn}"
                );
                drafts.note(view, quality, 0.03);
            }
        }
        assert!(!drafts.has_drafts(|_| true));
    }

    /// Nothing of it may be seen, or its drawing fails.
    #[test]
    fn a_view_that_is_not_drawn_keeps_nobody_waiting() {
        let mut drafts = Drafts::default();
        for view in 0..2 {
            drafts.note(view, Quality::Full, 0.03);
            drafts.quality(view, (1, false), 1.0);
        }
        assert_eq!(drafts.quality(0, (1, false), 2.0), (Quality::Full, None));
        assert_eq!(drafts.quality(1, (1, false), 2.0), (Quality::Draft, Some(0.0)));
        assert_eq!(drafts.quality(0, (1, false), 2.1), (Quality::Full, None), "it was not drawn");
        assert_eq!(drafts.quality(1, (1, false), 2.1), (Quality::Full, None));
    }

    /// Symptom: while many bodies were dragged, views that waited for their turn longer than a rest were drawn in full in
    /// between, which took most of the time, and they flickered.
    #[test]
    fn what_waits_for_its_turn_does_not_rest() {
        let mut drafts = Drafts::default();
        drafts.note(0, Quality::Full, 0.2);
        assert_eq!(drafts.quality(0, (1, false), 1.0).0, Quality::Draft);
        for now_s in [1.1, 1.2, 1.3, 5.0] {
            assert_eq!(drafts.quality(0, (1, true), now_s).0, Quality::Draft);
        }
        assert_eq!(drafts.quality(0, (1, false), 5.1).0, Quality::Draft);
        assert_eq!(drafts.quality(0, (1, false), 5.2), (Quality::Full, None));
    }

    #[test]
    fn a_picture_of_the_window_has_no_drafts() {
        let mut drafts = Drafts { in_full: true, ..Drafts::default() };
        drafts.note(0, Quality::Full, 0.2);
        assert_eq!(drafts.quality(0, (1, false), 1.0), (Quality::Full, None));
        assert!(!drafts.has_drafts(|_| true));
    }

    /// The next scene may be a small one.
    #[test]
    fn what_became_quick_is_drawn_in_full_again() {
        let mut drafts = Drafts::default();
        drafts.note(0, Quality::Full, 0.2);
        assert_eq!(drafts.quality(0, (1, false), 1.0).0, Quality::Draft);
        assert_eq!(drafts.quality(0, (1, false), 1.2).0, Quality::Full);
        drafts.note(0, Quality::Full, 0.001);
        assert_eq!(drafts.quality(0, (2, false), 1.3).0, Quality::Full);
    }
}
