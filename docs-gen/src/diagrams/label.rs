//! Labels in pictures: a name and entries, each in as many lines as it needs, with a place for a finger where it leads somewhere.

use crate::diagrams::timing::room;
use crate::view::{PictureLine, PictureLink, Target};

/// Height of a line.
pub(crate) const LINE: i64 = 14;
/// From the upper edge of a line to the baseline of its letters.
pub(crate) const ASCENT: i64 = 11;
/// Height and width of the smallest thing that a finger hits.
const FINGER: i64 = 24;

/// A line that may lead somewhere.
#[derive(Clone)]
pub(crate) struct DrawnLine {
    /// The text.
    pub text: String,
    /// Where it leads.
    pub target: Option<Target>,
}

/// The lines of a label: the name or one of its entries.
#[derive(Clone)]
pub(crate) struct Lines {
    texts: Vec<String>,
    is_name: bool,
    target: Option<Target>,
}

impl Lines {
    /// A text in lines of at most so many characters.
    fn of(text: &str, limit: usize, is_name: bool, target: Option<Target>) -> Self {
        Self { texts: wrapped(text, limit), is_name, target }
    }

    /// What its lines need.
    fn height(&self) -> i64 {
        i64::try_from(self.texts.len()).unwrap_or_default() * LINE
    }

    /// What has to be free above and below its lines, so that a finger hits no other link.
    fn beside(&self) -> i64 {
        if self.target.is_some() && !self.texts.is_empty() {
            ((FINGER - self.height()) / 2).max(0)
        } else {
            0
        }
    }

    fn width(&self) -> i64 {
        self.texts.iter().map(|text| i64::from(room(text))).max().unwrap_or_default()
    }
}

/// A text in lines of at most so many characters; a word stays whole.
pub(crate) fn wrapped(text: &str, limit: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= limit => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// A name and its entries as the lines of a label, with the width that they need.
pub(crate) fn label(name: &str, lines: &[DrawnLine], limit: usize) -> (Vec<Lines>, i64) {
    let lines = lines.iter().map(|line| Lines::of(&line.text, limit, false, line.target.clone()));
    let all: Vec<Lines> = std::iter::once(Lines::of(name, limit, true, None)).chain(lines).collect();
    let width = all.iter().map(Lines::width).max().unwrap_or_default();
    (all, width)
}

/// The height of a label.
pub(crate) fn height_of(label: &[Lines]) -> i64 {
    label.iter().map(|lines| lines.height() + 2 * lines.beside()).sum()
}

/// The lines of a label around `x`, the first at `y`.
pub(crate) fn placed(label: Vec<Lines>, x: i64, mut y: i64) -> Vec<PictureLine> {
    let mut placed = Vec::new();
    for lines in label {
        let (width, height, beside) = (lines.width().max(FINGER), lines.height(), lines.beside());
        let mut link = lines.target.map(|target| PictureLink {
            target,
            lines: lines.texts.len(),
            x: length(x - width / 2),
            y: length(y - ASCENT),
            width: length(width),
            height: length(height + 2 * beside),
        });
        y += beside;
        for text in lines.texts {
            placed.push(PictureLine {
                text,
                is_name: lines.is_name,
                link: link.take(),
                x: length(x),
                y: length(y),
            });
            y += LINE;
        }
        y += beside;
    }
    placed
}

/// A length of a picture.
pub(crate) fn length(value: i64) -> u32 {
    u32::try_from(value).unwrap_or_default()
}
