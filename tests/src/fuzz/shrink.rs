//! The smallest text that still shows a fault: lines are taken out as long as it does.

use std::time::{Duration, Instant};

/// How long a text is made smaller at most.
const LONGEST: Duration = Duration::from_secs(60);

/// Takes lines out of a text as long as `fails` says that it still fails: half of them at a time, then fewer (a simple form of
/// delta debugging).
pub fn shrink(bytes: &[u8], fails: impl Fn(&[u8]) -> bool) -> Vec<u8> {
    let end = Instant::now() + LONGEST;
    let ending = if bytes.contains(&b'\n') { b'\n' } else { b'\r' };
    let mut lines: Vec<&[u8]> = bytes.split_inclusive(|byte| *byte == ending).collect();
    let mut size = lines.len().div_ceil(2);
    while size > 0 && Instant::now() < end {
        let mut at = 0;
        let before = lines.len();
        while at < lines.len() && Instant::now() < end {
            let mut fewer = lines.clone();
            fewer.drain(at..(at + size).min(lines.len()));
            if fails(&fewer.concat()) {
                lines = fewer;
            } else {
                at += size;
            }
        }
        // What a later line kept may have become free.
        if size > 1 {
            size = size.div_ceil(2);
        } else if lines.len() == before {
            break;
        }
    }
    lines.concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_lines_that_matter_are_left() {
        let text = (0..500).map(|number| format!("{number}\n")).collect::<Vec<_>>().concat();
        let has =
            |bytes: &[u8], line: &str| std::str::from_utf8(bytes).unwrap().lines().any(|one| one == line);
        let smallest =
            shrink(text.as_bytes(), |bytes| has(bytes, "3") && has(bytes, "77") && has(bytes, "499"));
        assert_eq!(smallest, b"3\n77\n499\n");
        assert_eq!(shrink(b"a\rb\rc", |bytes| bytes.contains(&b'b')), b"b\r");
        assert_eq!(shrink(b"", |_| true), b"");
    }
}
