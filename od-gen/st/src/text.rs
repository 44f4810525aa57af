//! The text of a file: lines, how far they are indented, and comments.

use std::fmt::Write as _;

/// What is indented by one level.
const STEP: &str = "    ";

/// The text of a file.
#[derive(Debug, Default)]
pub(super) struct Text {
    text: String,
    depth: usize,
}

impl Text {
    /// A line; an empty one has nothing in front.
    pub(super) fn line(&mut self, line: &str) {
        if !line.is_empty() {
            self.text.extend(std::iter::repeat_n(STEP, self.depth));
        }
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// Lines, one below the other.
    pub(super) fn lines(&mut self, lines: &[String]) {
        for line in lines {
            self.line(line);
        }
    }

    /// Lines that are one level further in, between two others.
    pub(super) fn block(&mut self, first: &str, last: &str, inner: impl FnOnce(&mut Self)) {
        self.line(first);
        self.indented(last, inner);
    }

    /// Lines that are one level further in, and one after them that does not.
    pub(super) fn indented(&mut self, last: &str, inner: impl FnOnce(&mut Self)) {
        self.depth += 1;
        inner(self);
        self.depth -= 1;
        self.line(last);
    }

    /// A comment on lines of its own.
    pub(super) fn comment(&mut self, lines: &[String]) {
        let lines: Vec<String> = lines.iter().flat_map(|line| line.lines()).map(in_comment).collect();
        let Some((last, others)) = lines.split_last() else { return };
        for (at, line) in others.iter().enumerate() {
            self.line(&format!("{}{line}", if at == 0 { "(* " } else { "   " }));
        }
        self.line(&format!("{}{last} *)", if others.is_empty() { "(* " } else { "   " }));
    }

    /// A line with a comment after it, where there is one.
    pub(super) fn noted(&mut self, line: &str, note: &str) {
        if note.is_empty() {
            return self.line(line);
        }
        let mut whole = line.to_owned();
        let _ = write!(whole, " (* {} *)", in_comment(&note.replace('\n', " ")));
        self.line(&whole);
    }

    /// A block of declarations.
    pub(super) fn variables(&mut self, section: &str, declarations: &[Declaration]) {
        if declarations.is_empty() {
            return;
        }
        self.block(section, "END_VAR", |text| text.declarations(declarations));
    }

    /// The declaration of a structure.
    pub(super) fn structure(&mut self, name: &str, members: &[Declaration]) {
        self.line(&format!("TYPE {name} :"));
        self.block("STRUCT", "END_STRUCT;", |text| text.declarations(members));
        self.line("END_TYPE");
    }

    /// Declarations, one below the other.
    pub(super) fn declarations(&mut self, declarations: &[Declaration]) {
        for declaration in declarations {
            self.declaration(declaration);
        }
    }

    /// A declaration.
    fn declaration(&mut self, Declaration { name, of_type, value, note }: &Declaration) {
        let value = value.as_ref().map(|value| format!(" := {value}")).unwrap_or_default();
        self.noted(&format!("{name} : {of_type}{value};"), note);
    }

    pub(super) fn into_bytes(self) -> Vec<u8> {
        self.text.into_bytes()
    }
}

/// The declaration of a variable, a member or a constant.
#[derive(Debug, Clone)]
pub(super) struct Declaration {
    pub name: String,
    pub of_type: String,
    pub value: Option<String>,
    /// Comment; may be empty.
    pub note: String,
}

impl Declaration {
    /// Without a value.
    pub(super) fn new(name: impl Into<String>, of_type: impl Into<String>, note: impl Into<String>) -> Self {
        Self { name: name.into(), of_type: of_type.into(), value: None, note: note.into() }
    }

    pub(super) fn with_value(self, value: Option<String>) -> Self {
        Self { value, ..self }
    }
}

/// A text that neither ends the comment that it is in nor begins another one.
fn in_comment(text: &str) -> String {
    let plain: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    plain.trim_end().replace("(*", "( *").replace("*)", "* )").replace("(*", "( *")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_stays_inside_its_comment() {
        for text in ["a *) b", "(*)", "(**)", "***)", "((**))", "\u{7}"] {
            let inside = in_comment(text);
            assert!(!inside.contains("*)") && !inside.contains("(*"), "{inside}");
        }
    }
}
