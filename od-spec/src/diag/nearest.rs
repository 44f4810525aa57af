//! "Did you mean": the candidate that is the fewest slips of the keyboard away.

/// What the search for suggestions may cost in one compilation, in letters compared: a few dozen words in a dictionary of the
/// largest size, and a fraction of a second. With more mistakes than that, the first ones are corrected first.
const WORK: u64 = 50_000_000;
/// Longest part of a word that is looked at.
const LONGEST: usize = 80;

/// The nearest candidate, if it is near enough to be what was meant.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    Suggestions::default().nearest(word, candidates)
}

/// Finds what was meant, as long as it does not take too long: thousands of unknown names are compared with thousands of
/// known ones.
#[derive(Debug, Clone)]
pub(crate) struct Suggestions {
    /// Letters that may still be compared.
    left: u64,
}

impl Default for Suggestions {
    fn default() -> Self {
        Self::new()
    }
}

impl Suggestions {
    pub(crate) const fn new() -> Self {
        Self { left: WORK }
    }

    /// The nearest candidate, if it is near enough to be what was meant; none when the search would take too long.
    pub(crate) fn nearest<'a>(
        &mut self,
        word: &str,
        candidates: impl IntoIterator<Item = &'a str>,
    ) -> Option<&'a str> {
        let word: Vec<char> = word.chars().flat_map(char::to_lowercase).take(LONGEST).collect();
        let allowed = 1 + word.len() / 4;
        let (mut letters, mut rows) = (Vec::new(), Rows::default());
        let mut best: Option<(usize, &str)> = None;
        for candidate in candidates {
            if self.left == 0 {
                return None;
            }
            letters.clear();
            // One letter more than fits shows that it is too long.
            letters.extend(candidate.chars().flat_map(char::to_lowercase).take(word.len() + allowed + 1));
            let mut cost = 1 + letters.len();
            if letters.len().abs_diff(word.len()) <= allowed {
                let distance = rows.distance(&word, &letters, allowed);
                cost += rows.compared;
                if let Some(distance) = distance {
                    best = best.into_iter().chain([(distance, candidate)]).min();
                }
            }
            self.left = self.left.saturating_sub(u64::try_from(cost).unwrap_or(u64::MAX));
        }
        best.map(|(_, candidate)| candidate)
    }
}

/// The rows of the table that a distance is worked out in.
#[derive(Default)]
struct Rows {
    before: Vec<usize>,
    row: Vec<usize>,
    next: Vec<usize>,
    /// How many letters were compared.
    compared: usize,
}

impl Rows {
    /// Insertions, deletions, replacements and swaps of neighbours (optimal string alignment), if they are not more than
    /// allowed.
    fn distance(&mut self, a: &[char], b: &[char], allowed: usize) -> Option<usize> {
        let far = allowed + 1;
        self.compared = 0;
        self.row.clear();
        self.row.extend((0..=b.len()).map(|j| j.min(far)));
        self.before.clear();
        self.before.resize(b.len() + 1, far);
        for i in 1..=a.len() {
            // Farther from the diagonal are more insertions or deletions than allowed.
            let (first, last) = (i.saturating_sub(allowed).max(1), b.len().min(i + allowed));
            self.next.clear();
            self.next.resize(b.len() + 1, far);
            if i <= allowed {
                self.next[0] = i;
            }
            let mut least = self.next[0];
            for j in first..=last {
                let replaced = self.row[j - 1] + usize::from(a[i - 1] != b[j - 1]);
                let mut best = replaced.min(self.row[j] + 1).min(self.next[j - 1] + 1);
                if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                    best = best.min(self.before[j - 2] + 1);
                }
                self.next[j] = best.min(far);
                least = least.min(best);
            }
            self.compared += (last + 1).saturating_sub(first);
            // A swap of neighbours reaches over one row.
            if least >= far && self.row.iter().all(|distance| *distance >= far) {
                return None;
            }
            std::mem::swap(&mut self.before, &mut self.row);
            std::mem::swap(&mut self.row, &mut self.next);
        }
        self.row.get(b.len()).copied().filter(|distance| *distance <= allowed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_found_and_strangers_are_not() {
        let words = ["access", "default", "type", "transmit"];
        assert_eq!(nearest("acess", words), Some("access"));
        assert_eq!(nearest("tpye", words), Some("type"));
        assert_eq!(nearest("Defualt", words), Some("default"));
        assert_eq!(nearest("colour", words), None);
        assert_eq!(nearest("", words), None);
    }

    /// Optimal string alignment over the whole table.
    fn whole(a: &[char], b: &[char]) -> usize {
        let mut table = vec![vec![0; b.len() + 1]; a.len() + 1];
        for i in 0..=a.len() {
            for j in 0..=b.len() {
                table[i][j] = match (i, j) {
                    (0, _) => j,
                    (_, 0) => i,
                    _ => {
                        let replaced = table[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
                        let mut best = replaced.min(table[i - 1][j] + 1).min(table[i][j - 1] + 1);
                        if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                            best = best.min(table[i - 2][j - 2] + 1);
                        }
                        best
                    }
                };
            }
        }
        table[a.len()][b.len()]
    }

    #[test]
    fn what_is_near_has_its_distance() {
        let mut words = vec![Vec::new()];
        for _ in 0..5 {
            words = words
                .iter()
                .flat_map(|word: &Vec<char>| {
                    "abc".chars().map(|letter| [word.as_slice(), &[letter]].concat()).chain([word.clone()])
                })
                .collect();
            words.sort();
            words.dedup();
        }
        let mut rows = Rows::default();
        for a in words.iter().step_by(3) {
            for b in &words {
                for allowed in 1..=3 {
                    let expected = Some(whole(a, b)).filter(|distance| *distance <= allowed);
                    assert_eq!(rows.distance(a, b, allowed), expected, "{a:?} {b:?} {allowed}");
                }
            }
        }
    }

    #[test]
    fn many_mistakes_with_many_names_have_an_end() {
        let known: Vec<String> = (0..20_000).map(|at| format!("temperature of channel {at}")).collect();
        let mut suggestions = Suggestions::default();
        let names = || known.iter().map(String::as_str);
        assert!(suggestions.nearest("temprature of channel 19999", names()).is_some());
        let found = (0..2_000).filter(|at| suggestions.nearest(&format!("chanel {at}"), names()).is_some());
        assert_eq!(found.count(), 0);
        let looked = WORK - suggestions.left;
        assert_eq!((looked, suggestions.nearest("type", ["type"])), (WORK, None), "it gives up");
    }
}
