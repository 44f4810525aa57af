//! One line of YAML as it is laid out: its tokens with the spaces that belong between them.

/// What is open at the end of a line, so that the next one continues it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Open {
    /// How many braces and brackets are open.
    pub depth: usize,
    /// The quote of a text that is not at its end.
    pub quote: Option<Quote>,
    /// A text without quotes is at the end; the next line may continue it.
    pub plain: bool,
}

/// How a text is quoted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quote {
    Single,
    Double,
}

/// A line without its indentation.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Line<'a> {
    /// What is there, with the spaces that belong there.
    pub text: String,
    /// The comment at its end, and the signs in front of it.
    pub comment: Option<(usize, &'a str)>,
    /// What it leaves open.
    pub open: Open,
    /// It ends with the header of a block of text (`>-`, `|`).
    pub begins_block: bool,
    /// It has a key and a colon outside of braces and quotes.
    pub has_key: bool,
}

/// Lays out the text of a line, which goes on with what is open; `None` for what specifications do not have.
pub(super) fn line(source: &str, open: Open) -> Option<Line<'_>> {
    let mut scan = Scan {
        source,
        at: 0,
        out: String::new(),
        open: Open { plain: false, ..open },
        in_plain: open.plain,
        begins_block: false,
        has_key: false,
        after: After::Nothing,
    };
    let mut comment = None;
    if scan.open.quote.is_some() {
        scan.quoted_rest();
    }
    while let Some(sign) = scan.rest().chars().next() {
        if sign == ' ' || sign == '\t' {
            scan.at += 1;
            continue;
        }
        let at_blank = scan.at == 0 || source[..scan.at].ends_with([' ', '\t']);
        if sign == '#' && at_blank {
            comment = Some((source[..scan.at].chars().count(), source[scan.at..].trim_end()));
            break;
        }
        scan.token(sign)?;
    }
    let Scan { out, open, begins_block, has_key, .. } = scan;
    // Spaces at the end of a quoted text that goes on may belong to it.
    let text = if open.quote.is_some() { out } else { out.trim_end().to_owned() };
    Some(Line { text, comment, open, begins_block, has_key })
}

/// What was written last, and so what goes before the next token.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum After {
    /// The line begins.
    Nothing,
    /// A brace or bracket was opened.
    Opening,
    /// A value, a key, or a closing brace.
    Value,
    /// A colon, comma or dash.
    Separator,
}

struct Scan<'a> {
    source: &'a str,
    at: usize,
    out: String,
    open: Open,
    /// A text without quotes goes on from the line before.
    in_plain: bool,
    begins_block: bool,
    has_key: bool,
    after: After,
}

impl<'a> Scan<'a> {
    fn rest(&self) -> &'a str {
        &self.source[self.at..]
    }

    /// Whether a colon here is between a key and its value.
    fn is_colon(&self, at: usize) -> bool {
        let mut signs = self.source[at..].chars();
        let is_end = |sign: char| matches!(sign, ' ' | '\t');
        let in_flow = |sign: char| self.open.depth > 0 && matches!(sign, ',' | '[' | ']' | '{' | '}');
        signs.next() == Some(':') && signs.next().is_none_or(|next| is_end(next) || in_flow(next))
    }

    fn token(&mut self, sign: char) -> Option<()> {
        self.open.plain = false;
        match sign {
            '{' | '[' if !self.in_plain => self.opening(sign),
            '}' | ']' if self.open.depth > 0 => self.closing(sign),
            ',' if self.open.depth > 0 => self.separator(sign),
            ':' if self.is_colon(self.at) || self.after_quoted_key() => self.separator(sign),
            '-' if self.open.depth == 0 && !self.in_plain && self.is_dash() => {
                self.word("-");
                self.after = After::Separator;
            }
            '"' | '\'' if !self.in_plain => {
                self.quoted(if sign == '"' { Quote::Double } else { Quote::Single });
            }
            '|' | '>' if self.open.depth == 0 && !self.in_plain => self.block_header(),
            // Tags, complex keys and directives are refused elsewhere, or are nothing that a specification has.
            '!' | '%' | '@' | '`' if !self.in_plain => return None,
            '?' if self.rest() == "?" || self.rest().starts_with("? ") => return None,
            '&' | '*' if !self.in_plain => self.name(),
            _ => self.plain(),
        }
        Some(())
    }

    fn is_dash(&self) -> bool {
        self.rest().strip_prefix('-').is_some_and(|rest| rest.is_empty() || rest.starts_with([' ', '\t']))
            && matches!(self.after, After::Nothing | After::Separator)
            && (self.out.is_empty() || self.out.ends_with('-'))
    }

    /// In braces, a quoted key needs no space after its colon.
    fn after_quoted_key(&self) -> bool {
        self.open.depth > 0
            && self.out.ends_with(['"', '\''])
            && self.source[..self.at].ends_with(['"', '\''])
    }

    /// Puts a word where it belongs.
    fn word(&mut self, word: &str) {
        if matches!(self.after, After::Value | After::Separator) {
            self.out.push(' ');
        }
        self.out.push_str(word);
        self.after = After::Value;
        self.at += word.len();
        self.in_plain = false;
    }

    fn opening(&mut self, sign: char) {
        self.word(sign.encode_utf8(&mut [0; 4]));
        self.open.depth += 1;
        self.after = After::Opening;
    }

    fn closing(&mut self, sign: char) {
        // Readers of YAML 1.1 take a colon with a brace after it for a text.
        if self.out.ends_with(':') {
            self.out.push(' ');
        }
        self.out.push(sign);
        self.at += 1;
        self.open.depth -= 1;
        self.after = After::Value;
        self.in_plain = false;
    }

    fn separator(&mut self, sign: char) {
        self.has_key |= sign == ':' && self.open.depth == 0;
        if sign == ',' && self.out.ends_with(':') {
            self.out.push(' ');
        }
        // After an alias, a colon would belong to the name.
        let last = self.out.rsplit([' ', '{', '[']).next().unwrap_or_default();
        if sign == ':' && last.starts_with(['*', '&']) {
            self.out.push(' ');
        }
        self.out.push(sign);
        self.at += 1;
        self.after = After::Separator;
        self.in_plain = false;
    }

    fn quoted(&mut self, quote: Quote) {
        if matches!(self.after, After::Value | After::Separator) {
            self.out.push(' ');
        }
        self.out.push_str(&self.source[self.at..=self.at]);
        self.at += 1;
        self.open.quote = Some(quote);
        self.quoted_rest();
    }

    /// The rest of a quoted text, as far as it is in this line.
    fn quoted_rest(&mut self) {
        let rest = self.rest();
        let mut signs = rest.char_indices().peekable();
        let mut end = rest.len();
        while let Some((at, sign)) = signs.next() {
            match (self.open.quote, sign) {
                (Some(Quote::Double), '\\') => drop(signs.next()),
                (Some(Quote::Single), '\'') if signs.next_if(|(_, next)| *next == '\'').is_some() => {}
                (Some(Quote::Double), '"') | (Some(Quote::Single), '\'') => {
                    end = at + 1;
                    self.open.quote = None;
                    break;
                }
                (Some(_) | None, _) => {}
            }
        }
        self.out.push_str(&rest[..end]);
        self.at += end;
        self.after = After::Value;
        self.in_plain = false;
    }

    /// The header of a block of text: nothing but a comment follows it.
    fn block_header(&mut self) {
        let rest = self.rest();
        let end = rest.find([' ', '\t']).unwrap_or(rest.len());
        self.begins_block = true;
        self.word(&rest[..end]);
    }

    /// An anchor or an alias.
    fn name(&mut self) {
        let rest = self.rest();
        let ends = |sign: char| {
            matches!(sign, ' ' | '\t') || self.open.depth > 0 && matches!(sign, ',' | '[' | ']' | '{' | '}')
        };
        let end = rest.find(ends).unwrap_or(rest.len());
        self.word(&rest[..end]);
    }

    /// A text without quotes: up to a colon, a comment or, in braces, their signs. Spaces in it are its own.
    fn plain(&mut self) {
        let rest = self.rest();
        let mut end = rest.len();
        for (at, sign) in rest.char_indices() {
            let is_comment = sign == '#' && at > 0 && rest[..at].ends_with([' ', '\t']);
            let in_flow = self.open.depth > 0 && matches!(sign, ',' | '[' | ']' | '{' | '}');
            if is_comment || in_flow || sign == ':' && self.is_colon(self.at + at) {
                end = at;
                break;
            }
        }
        let text = rest[..end].trim_end();
        // A sign that means nothing else is a text.
        let text =
            if text.is_empty() { &rest[..rest.chars().next().map_or(0, char::len_utf8)] } else { text };
        self.word(text);
        self.open.plain = self.source[self.at..].trim_start().is_empty();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn laid_out(source: &str) -> String {
        line(source, Open::default()).unwrap().text
    }

    #[test]
    fn spaces_are_where_they_belong() {
        for (source, text) in [
            ("a:    b", "a: b"),
            ("name:   {a:1 ,b:  [ x,y ]  }", "name: {a:1, b: [x, y]}"),
            ("- -  a:  b   c", "- - a: b   c"),
            ("{\"a\":1, 'b'  : 2}", "{\"a\": 1, 'b': 2}"),
            ("0x1000.1:  \"a # b:   c\"", "0x1000.1: \"a # b:   c\""),
            ("about:  'it''s   '  ", "about: 'it''s   '"),
            ("at: &here   {a: *there , *b : 1}", "at: &here {a: *there, *b : 1}"),
            ("when: a: b", "when: a: b"),
            ("- -1", "- -1"),
            ("x: a#b", "x: a#b"),
            ("x:", "x:"),
            ("url: http://a,b", "url: http://a,b"),
            ("x: >-", "x: >-"),
            ("[a: 1,b]", "[a: 1, b]"),
            ("x: -", "x: -"),
            ("{a: , b: }", "{a: , b: }"),
            ("°: ]", "°: ]"),
        ] {
            assert_eq!(laid_out(source), text, "{source}");
        }
        assert!(line("!tag x", Open::default()).is_none());
    }

    #[test]
    fn comments_are_distinguished() {
        let of = |source| line(source, Open::default()).unwrap().comment.map(|(_, comment)| comment);
        assert_eq!(of("a: b   # c "), Some("# c"));
        assert_eq!(of("a: b# c"), None);
        assert_eq!(of("a: \"b # c\""), None);
        assert_eq!(of("# c"), Some("# c"));
    }

    #[test]
    fn what_is_open_is_known() {
        let of = |source| line(source, Open::default()).unwrap().open;
        assert_eq!(of("a: {b: [").depth, 2);
        assert_eq!(of("a: \"b").quote, Some(Quote::Double));
        assert_eq!(of("a: 'b''").quote, Some(Quote::Single));
        assert!(of("a: b").plain && !of("a:").plain && !of("a: b # c").plain);
        let open = Open { depth: 1, quote: Some(Quote::Double), plain: false };
        let line = line("  b\\\" c\", d:  e}", open).unwrap();
        assert_eq!((line.text.as_str(), line.open), ("  b\\\" c\", d: e}", Open::default()));
    }
}
