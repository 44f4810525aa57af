//! Several keys in one message.

use std::borrow::Borrow;

/// `` `A`, `B` and `C` ``; of many only the first ones.
pub(super) fn enumeration<T: Borrow<str>>(keys: &[T]) -> String {
    const MOST: usize = 4;
    let shown = if keys.len() > MOST + 1 { MOST } else { keys.len() };
    let mut words: Vec<String> = keys[..shown].iter().map(|key| format!("`{}`", key.borrow())).collect();
    if shown < keys.len() {
        words.push(format!("{} more", keys.len() - shown));
    }
    match words.split_last() {
        Some((last, others)) if !others.is_empty() => format!("{} and {last}", others.join(", ")),
        Some((last, _)) => last.clone(),
        None => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::enumeration;

    #[test]
    fn many_keys_are_counted() {
        assert_eq!(enumeration(&["A"]), "`A`");
        assert_eq!(enumeration(&["A", "B", "C"]), "`A`, `B` and `C`");
        assert_eq!(enumeration(&["A", "B", "C", "D", "E"]), "`A`, `B`, `C`, `D` and `E`");
        assert_eq!(enumeration(&["A", "B", "C", "D", "E", "F"]), "`A`, `B`, `C`, `D` and 2 more");
    }
}
