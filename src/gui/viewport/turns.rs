//! Views of a large scene take turns: in each turn of the window the one that is worked in is drawn anew, and one of the
//! others. All of them would take twice as long or more, and one looks at one.

use crate::view::VIEWS;

#[derive(Default)]
pub(super) struct Turns {
    /// Number of the window's turn.
    frame: u64,
    view: usize,
    /// Whether a view shows what was before.
    behind: bool,
}

impl Turns {
    /// In another turn of the window it is the next view's, of those that wait for one.
    pub fn begin(&mut self, frame: u64, waits: impl Fn(usize) -> bool) {
        if self.frame == frame {
            return;
        }
        let after = (1..=VIEWS.len()).map(|step| (self.view + step) % VIEWS.len());
        let view = after.into_iter().find(|view| waits(*view)).unwrap_or(self.view);
        *self = Self { frame, view, behind: false };
    }

    pub fn has(&self, view: usize) -> bool {
        self.view == view
    }

    /// A view waits for a later turn.
    pub fn wait(&mut self) {
        self.behind = true;
    }

    pub fn are_behind(&self) -> bool {
        self.behind
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each view that waits has its turn within as many turns of the window as there are, however often one is shown in
    /// a turn.
    #[test]
    fn every_view_has_its_turn() {
        let mut turns = Turns::default();
        let mut seen = [0; VIEWS.len()];
        for frame in 1..=9 {
            for _ in 0..3 {
                turns.begin(frame, |view| view != 1);
            }
            turns.wait();
            (0..VIEWS.len()).filter(|view| turns.has(*view)).for_each(|view| seen[view] += 1);
            assert!(turns.are_behind());
        }
        assert_eq!(seen, [3, 0, 3, 3]);
        turns.begin(10, |_| false);
        assert!(!turns.are_behind());
    }
}
