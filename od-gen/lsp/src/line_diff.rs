//! Which lines differ, where most are the same and changes are small: in time that grows with the text.

use similar::{Algorithm, DiffOp, capture_diff_slices};

/// How far ahead two texts are compared before they are left to a thorough comparison, which takes long for long texts.
const WINDOW: usize = 64;

/// How to come from one list of lines to the other.
pub fn line_diff(old: &[&str], new: &[&str]) -> Vec<DiffOp> {
    let (mut i, mut j) = (0, 0);
    let mut ops = Vec::new();
    loop {
        let same = old[i..].iter().zip(&new[j..]).take_while(|(old, new)| old == new).count();
        if same > 0 {
            ops.push(DiffOp::Equal { old_index: i, new_index: j, len: same });
        }
        (i, j) = (i + same, j + same);
        if i == old.len() && j == new.len() {
            return ops;
        }
        let Some((gone, come)) = next_equal(&old[i..], &new[j..]) else {
            let rest = capture_diff_slices(Algorithm::Myers, &old[i..], &new[j..]);
            ops.extend(rest.into_iter().map(|op| moved(op, i, j)));
            return ops;
        };
        ops.push(match (gone, come) {
            (0, _) => DiffOp::Insert { old_index: i, new_index: j, new_len: come },
            (_, 0) => DiffOp::Delete { old_index: i, old_len: gone, new_index: j },
            (_, _) => DiffOp::Replace { old_index: i, old_len: gone, new_index: j, new_len: come },
        });
        (i, j) = (i + gone, j + come);
    }
}

/// How many lines of each are left out until both go on alike, for two lines or to their end.
fn next_equal(old: &[&str], new: &[&str]) -> Option<(usize, usize)> {
    let is_alike = |gone: usize, come: usize| {
        let (old, new) = (old.get(gone..)?, new.get(come..)?);
        let length = 2.min(old.len()).min(new.len());
        let both_end = old.is_empty() && new.is_empty();
        let go_on = length > 0 && old[..length] == new[..length];
        (both_end || (go_on && (length == 2 || old.len() == new.len()))).then_some((gone, come))
    };
    (1..=WINDOW).find_map(|both| (0..=both).find_map(|gone| is_alike(gone, both - gone)))
}

fn moved(op: DiffOp, i: usize, j: usize) -> DiffOp {
    match op {
        DiffOp::Equal { old_index, new_index, len } => {
            DiffOp::Equal { old_index: old_index + i, new_index: new_index + j, len }
        }
        DiffOp::Delete { old_index, old_len, new_index } => {
            DiffOp::Delete { old_index: old_index + i, old_len, new_index: new_index + j }
        }
        DiffOp::Insert { old_index, new_index, new_len } => {
            DiffOp::Insert { old_index: old_index + i, new_index: new_index + j, new_len }
        }
        DiffOp::Replace { old_index, old_len, new_index, new_len } => {
            DiffOp::Replace { old_index: old_index + i, old_len, new_index: new_index + j, new_len }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The second text, from the first and the steps.
    fn applied<'t>(old: &[&'t str], new: &[&'t str], ops: &[DiffOp]) -> Vec<&'t str> {
        let mut result = Vec::new();
        let mut at = 0;
        for op in ops {
            assert_eq!(op.old_range().start, at, "{ops:?}");
            at = op.old_range().end;
            match op {
                DiffOp::Equal { .. } => result.extend(&old[op.old_range()]),
                DiffOp::Delete { .. } => {}
                DiffOp::Insert { .. } | DiffOp::Replace { .. } => result.extend(&new[op.new_range()]),
            }
        }
        assert_eq!(at, old.len());
        result
    }

    #[test]
    fn the_steps_lead_from_one_text_to_the_other() {
        let far: Vec<String> = (0..200).map(|line| line.to_string()).collect();
        let far = far.join(" ");
        for (old, new) in [
            ("", ""),
            ("a b c d", "a b c d"),
            ("a b c d", "a x c d"),
            ("a b c d", "a c d"),
            ("a c d", "a b c d"),
            ("a b c", "a b"),
            ("a b", "a b c"),
            ("", "a"),
            ("a", ""),
            ("a b a b a b", "b a b a"),
            (&far, "x y"),
            ("x y", &far),
        ] {
            let (old, new): (Vec<&str>, Vec<&str>) = (old.split(' ').collect(), new.split(' ').collect());
            assert_eq!(applied(&old, &new, &line_diff(&old, &new)), new);
        }
        assert_eq!(line_diff(&["a", "b", "c", "d"], &["a", "x", "c", "d"]).len(), 3);
    }
}
