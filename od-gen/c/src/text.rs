//! The text of C files: lines, comments and guards.
//!
//! Everything is ASCII: what a compiler makes of other bytes is its own affair, also in comments (C99 5.1.1.2).

use std::fmt::Write as _;

use od_spec::ascii::transliterate;
use od_spec::eds::GENERATED;

use super::prefix::Prefix;

/// Characters of a line; what cannot be broken is longer.
pub(super) const WIDTH: usize = 100;

/// Spaces of a level.
const INDENT: usize = 4;

/// A file that is being written.
#[derive(Default)]
pub(super) struct Text {
    written: String,
    level: usize,
    /// What our names begin with in lines of code.
    prefix: Prefix,
}

impl Text {
    /// A file in which no name is made from one of the specification: what begins with `OD` begins with a prefix.
    pub(super) fn with_prefix(prefix: &Prefix) -> Self {
        Self { prefix: prefix.clone(), ..Self::default() }
    }

    pub(super) fn into_bytes(self) -> Vec<u8> {
        self.written.into_bytes()
    }

    /// A line, or an empty one.
    pub(super) fn line(&mut self, line: &str) {
        let line = self.prefix.in_text(line);
        self.plain_line(&line);
    }

    /// A line as it is.
    fn plain_line(&mut self, line: &str) {
        if !line.is_empty() {
            let indent = self.level * INDENT;
            let _ = write!(self.written, "{:indent$}{line}", "");
        }
        self.written.push('\n');
    }

    /// An empty line, unless there is one or the file begins.
    pub(super) fn gap(&mut self) {
        if !self.written.is_empty() && !self.written.ends_with("\n\n") {
            self.written.push('\n');
        }
    }

    /// What is between two lines, one level further in.
    pub(super) fn block(&mut self, open: &str, close: &str, inside: impl FnOnce(&mut Self)) {
        self.line(open);
        self.level += 1;
        inside(self);
        self.level -= 1;
        self.line(close);
    }

    /// A comment that documents what follows.
    pub(super) fn doc(&mut self, text: &str) {
        self.comment_with("/**", text);
    }

    /// A comment of its own.
    pub(super) fn comment(&mut self, text: &str) {
        self.comment_with("/*", text);
    }

    fn comment_with(&mut self, open: &str, text: &str) {
        let lines = comment_lines(text, WIDTH - self.level * INDENT - 3);
        match lines.as_slice() {
            [only] if open.len() + only.len() + 4 + self.level * INDENT <= WIDTH => {
                self.plain_line(&format!("{open} {only} */"));
            }
            lines => {
                self.plain_line(open);
                for line in lines {
                    self.plain_line(format!(" * {line}").trim_end());
                }
                self.plain_line(" */");
            }
        }
    }

    /// A macro for a value.
    pub(super) fn define(&mut self, name: &str, value: &str) {
        self.line(&format!("#define {name} {value}"));
    }

    /// A macro for flags that are joined, or for 0 where there are none.
    pub(super) fn flags(&mut self, name: &str, flags: &[&str]) {
        let Some((last, first)) = flags.split_last() else { return self.define(name, "0") };
        let line = flags.join(" | ");
        if line.len() + name.len() + "#define  ()".len() <= WIDTH {
            return self.define(name, &format!("({line})"));
        }
        self.line(&format!("#define {name} ( \\"));
        for flag in first {
            self.line(&format!("    {flag} | \\"));
        }
        self.line(&format!("    {last})"));
    }

    /// A member of an initialiser: `.name = value,`. The items of a list that is too long for one line fill several.
    pub(super) fn value(&mut self, name: &str, value: &str) {
        let line = format!("{name} = {value},");
        match value.strip_prefix('{').and_then(|value| value.strip_suffix('}')) {
            Some(items) if self.level * INDENT + line.len() > WIDTH => {
                self.block(&format!("{name} = {{"), "},", |text| {
                    text.items(items.split(", ").map(str::to_owned));
                });
            }
            _ => self.line(&line),
        }
    }

    /// The head of a function, its parameters in lines of their own where they are too many for one.
    pub(super) fn signature(&mut self, function: &str, parameters: &[&str]) {
        let line = format!("{function}({})", parameters.join(", "));
        if line.len() <= WIDTH {
            self.line(&line);
            return;
        }
        self.line(&format!("{function}("));
        self.level += 1;
        for (at, parameter) in parameters.iter().enumerate() {
            let end = if at + 1 == parameters.len() { ")" } else { "," };
            self.line(&format!("{parameter}{end}"));
        }
        self.level -= 1;
    }

    /// A statement, broken where its conditions are joined.
    pub(super) fn broken(&mut self, statement: &str) {
        if statement.len() + self.level * INDENT <= WIDTH {
            self.line(statement);
            return;
        }
        let parts = statement.replace(" && ", "\n&& ").replace(" || ", "\n|| ");
        for (at, part) in parts.split('\n').enumerate() {
            self.level += usize::from(at > 0);
            self.line(part);
            self.level -= usize::from(at > 0);
        }
    }

    /// Items of a list, as many in a line as it takes.
    pub(super) fn items(&mut self, items: impl Iterator<Item = String>) {
        let room = WIDTH - self.level * INDENT;
        let mut line = String::new();
        for item in items {
            if !line.is_empty() && line.len() + item.len() + 2 > room {
                self.line(&line);
                line.clear();
            }
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(&item);
            line.push(',');
        }
        if !line.is_empty() {
            self.line(&line);
        }
    }
}

/// The head of a generated file.
pub(super) fn head(text: &mut Text, about: &str) {
    text.comment(&format!("{about}\n{GENERATED}"));
}

/// A header: what it is about, and what is between the lines that keep it from being read twice.
pub(super) fn header(about: &str, guard: &str, inside: &Text) -> Text {
    let mut text = Text::default();
    head(&mut text, about);
    text.line(&format!("#ifndef {guard}"));
    text.line(&format!("#define {guard}"));
    text.gap();
    text.written.push_str(&inside.written);
    text.gap();
    text.line(&format!("#endif /* {guard} */"));
    text
}

/// The lines of a comment: nothing in them ends the comment, begins another one, or joins lines.
fn comment_lines(text: &str, width: usize) -> Vec<String> {
    let mut lines = Vec::new();
    for paragraph in text.trim_end().split('\n') {
        let paragraph = harmless(paragraph);
        let mut line = String::new();
        for word in paragraph.split_whitespace() {
            if !line.is_empty() && line.len() + 1 + word.len() > width {
                lines.push(std::mem::take(&mut line));
            }
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
        lines.push(line);
    }
    for line in &mut lines {
        // Would join the line with the next one.
        if line.ends_with('\\') {
            line.push('.');
        }
    }
    lines
}

/// A text in which `*/`, `/*`, `//` and trigraphs are taken apart.
fn harmless(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in transliterate(text).chars() {
        let mut before = out.chars().rev();
        match (before.next(), c) {
            // `https://` stays.
            (Some('/'), '/') if before.next() == Some(':') => {}
            (Some('*'), '/') | (Some('/'), '*' | '/') | (Some('?'), '?') => out.push(' '),
            _ => {}
        }
        out.push(c);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn comment(text: &str) -> String {
        let mut out = Text::default();
        out.comment(text);
        String::from_utf8(out.into_bytes()).unwrap()
    }

    #[test]
    fn no_text_ends_a_comment_or_begins_one() {
        assert_eq!(comment("a */ b /* c // d"), "/* a * / b / * c / / d */\n");
        assert_eq!(comment("**/"), "/* ** / */\n");
        assert_eq!(comment("*\u{2028}/"), "/* * / */\n");
        assert_eq!(comment("what??/"), "/* what? ?/ */\n");
        assert_eq!(comment("ends with *"), "/* ends with * */\n");
        assert_eq!(comment("/"), "/* / */\n");
        assert_eq!(comment("https://example.org/*"), "/* https://example.org/ * */\n");
    }

    #[test]
    fn a_backslash_joins_no_lines() {
        assert_eq!(comment("path\\\nnext"), "/*\n * path\\.\n * next\n */\n");
    }

    #[test]
    fn comments_are_ascii_and_broken_where_they_are_long() {
        assert_eq!(comment("50 °C, Größe"), "/* 50 degC, Groesse */\n");
        let long = comment(&"word ".repeat(40));
        assert!(long.lines().all(|line| line.len() <= WIDTH) && long.lines().count() == 5, "{long}");
        assert!(comment(&"x".repeat(200)).contains(&"x".repeat(200)));
    }

    #[test]
    fn items_fill_lines() {
        let mut out = Text::default();
        out.block("{", "};", |out| out.items((0..40).map(|number| format!("{number}U"))));
        let text = String::from_utf8(out.into_bytes()).unwrap();
        assert!(text.lines().all(|line| line.len() <= WIDTH) && text.lines().count() == 4, "{text}");
    }
}
