//! What differs between two texts, line by line (E. Myers, An O(ND) difference algorithm, Algorithmica 1, 1986).

/// One line of a difference.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DiffLine {
    /// In both.
    Same(String),
    Removed(String),
    Added(String),
    /// So many lines that are in both and far from any change.
    Gap(usize),
}

/// Lines shown around a change.
const AROUND: usize = 2;

/// More changed lines than this are shown as one block removed and another added: their alignment would take time and
/// memory that grow with the square.
const MOST_CHANGES: usize = 1000;

/// Empty if the texts are the same.
pub fn diff(old: &str, new: &str) -> Vec<DiffLine> {
    let (old, new): (Vec<&str>, Vec<&str>) = (old.lines().collect(), new.lines().collect());
    let before = old.iter().zip(&new).take_while(|(a, b)| a == b).count();
    let (old_rest, new_rest) = (&old[before..], &new[before..]);
    let after = old_rest.iter().rev().zip(new_rest.iter().rev()).take_while(|(a, b)| a == b).count();
    let (old_mid, new_mid) = (&old_rest[..old_rest.len() - after], &new_rest[..new_rest.len() - after]);
    if old_mid.is_empty() && new_mid.is_empty() {
        return Vec::new();
    }
    let owned = |lines: &[&str], kind: fn(String) -> DiffLine| -> Vec<DiffLine> {
        lines.iter().map(|line| kind((*line).to_owned())).collect()
    };
    let mut lines = owned(&old[..before], DiffLine::Same);
    match aligned(old_mid, new_mid) {
        Some(middle) => lines.extend(middle),
        None => {
            lines.extend(owned(old_mid, DiffLine::Removed));
            lines.extend(owned(new_mid, DiffLine::Added));
        }
    }
    lines.extend(owned(&old_rest[old_rest.len() - after..], DiffLine::Same));
    with_gaps(lines)
}

/// `None` for more than [`MOST_CHANGES`].
fn aligned(old: &[&str], new: &[&str]) -> Option<Vec<DiffLine>> {
    let offset = MOST_CHANGES + 1;
    // For each diagonal x − y the furthest x reached, after each number of changes.
    let mut furthest = vec![0_usize; 2 * offset + 1];
    let mut history = Vec::new();
    for changes in 0..=MOST_CHANGES {
        history.push(furthest.clone());
        for step in 0..=changes {
            let at = offset + 2 * step - changes;
            let down = step == 0 || (step != changes && furthest[at - 1] < furthest[at + 1]);
            let mut x = if down { furthest[at + 1] } else { furthest[at - 1] + 1 };
            // y = x − (at − offset); one that is off the text ends nowhere.
            let Some(mut y) = (x + offset).checked_sub(at) else { continue };
            while x < old.len() && y < new.len() && old[x] == new[y] {
                (x, y) = (x + 1, y + 1);
            }
            furthest[at] = x;
            if x >= old.len() && y >= new.len() {
                return Some(traced(old, new, &history, offset));
            }
        }
    }
    None
}

/// The way back through the history, as lines in order.
fn traced(old: &[&str], new: &[&str], history: &[Vec<usize>], offset: usize) -> Vec<DiffLine> {
    let (mut x, mut y) = (old.len(), new.len());
    let mut lines = Vec::new();
    for (changes, furthest) in history.iter().enumerate().rev() {
        let at = x + offset - y;
        let lowest = offset - changes;
        let down = at == lowest || (at != offset + changes && furthest[at - 1] < furthest[at + 1]);
        let from = if down { at + 1 } else { at - 1 };
        let (before_x, before_y) = if changes == 0 {
            (0, 0)
        } else {
            (furthest[from], (furthest[from] + offset).saturating_sub(from))
        };
        while x > before_x && y > before_y {
            (x, y) = (x - 1, y - 1);
            lines.push(DiffLine::Same(old[x].to_owned()));
        }
        if changes > 0 && down && y > 0 {
            y -= 1;
            lines.push(DiffLine::Added(new[y].to_owned()));
        } else if changes > 0 && x > 0 {
            x -= 1;
            lines.push(DiffLine::Removed(old[x].to_owned()));
        }
    }
    lines.reverse();
    lines
}

/// Without the lines that are far from any change.
fn with_gaps(lines: Vec<DiffLine>) -> Vec<DiffLine> {
    let changed = |line: &DiffLine| !matches!(line, DiffLine::Same(_));
    let mut near = vec![false; lines.len()];
    for (at, _) in lines.iter().enumerate().filter(|(_, line)| changed(line)) {
        let end = (at + AROUND + 1).min(lines.len());
        near[at.saturating_sub(AROUND)..end].fill(true);
    }
    let mut shown = Vec::new();
    for (line, near) in lines.into_iter().zip(near) {
        match (near, shown.last_mut()) {
            (true, _) => shown.push(line),
            (false, Some(DiffLine::Gap(count))) => *count += 1,
            (false, _) => shown.push(DiffLine::Gap(1)),
        }
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is removed and what is in both is the old text, what is added and in both the new one.
    #[test]
    fn a_difference_leads_from_one_text_to_the_other() {
        let mut state = 7_u64;
        let mut below = |most: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) % most
        };
        for _ in 0..400 {
            let mut text = |most: u64| -> Vec<String> {
                (0..below(most)).map(|_| format!("line {}", below(4))).collect()
            };
            let (old, new) = (text(12), text(12));
            let lines = aligned(
                &old.iter().map(String::as_str).collect::<Vec<_>>(),
                &new.iter().map(String::as_str).collect::<Vec<_>>(),
            )
            .unwrap();
            let (mut before, mut after) = (Vec::new(), Vec::new());
            for line in lines {
                match line {
                    DiffLine::Same(text) => {
                        before.push(text.clone());
                        after.push(text);
                    }
                    DiffLine::Removed(text) => before.push(text),
                    DiffLine::Added(text) => after.push(text),
                    DiffLine::Gap(_) => panic!("no gaps yet"),
                }
            }
            assert_eq!((before, after), (old, new));
        }
    }

    #[test]
    fn changes_are_shown_with_their_neighbours() {
        let old = (0..20).map(|n| n.to_string()).collect::<Vec<_>>().join("\n");
        let new = old.replace("\n7\n", "\nseven\n");
        let lines = diff(&old, &new);
        let same = |n: usize| DiffLine::Same(n.to_string());
        let expected = [
            DiffLine::Gap(5),
            same(5),
            same(6),
            DiffLine::Removed("7".into()),
            DiffLine::Added("seven".into()),
            same(8),
            same(9),
            DiffLine::Gap(10),
        ];
        assert_eq!(lines, expected);
        assert!(diff(&old, &old).is_empty());
    }
}
