//! How conditions between entries are written: `0x30FC.2 < 0x30FC.1`, `bit(0x6041, 2) == 0`.
//!
//! ```text
//! condition  = both { "or" both }
//! both       = comparison { "and" comparison }
//! comparison = sum op sum { op sum }            op = "<" | "<=" | "==" | "!=" | ">=" | ">"
//! sum        = product { ("+" | "-") product }
//! product    = factor { ("*" | "/") factor }
//! factor     = number | reference | "bit" "(" reference "," number ")" | "(" sum ")" | "-" factor
//! reference  = [ device ":" ] "0x" hex digits [ "." sub-index ]
//! ```
//!
//! In a specification, an entry, a bit and a value may be written by name; see `without_names`.

mod names;

use std::ops::Range;

use self::names::NO_ENTRY;
pub(crate) use self::names::{AnyName, Lookup, Named, Operand, PLACEHOLDER};
use crate::diag::shorten;
pub use crate::model::{ArithmeticOp, CompareOp, Comparison, EntryRef, Expr, Outcome, Term, Values};
use crate::model::{EntryId, Index, Ratio, SubIndex};
use crate::scalar;

/// A condition in which indices, bits and numbers are written instead of names. Names have spaces and points (`drive
/// data.error mask`), and none of the signs of a condition; a minus has a space after it.
///
/// # Errors
/// As [`Expr::parse`].
pub(crate) fn without_names(text: &str, lookup: &mut dyn Lookup) -> Parsed<String> {
    let mut parser = Parser::new(text, Some(lookup));
    parser.condition()?;
    let mut plain = String::new();
    let mut at = 0;
    for (range, instead) in parser.replaced {
        plain.push_str(&text[at..range.start]);
        plain.push_str(&instead);
        at = range.end;
    }
    plain.push_str(&text[at..]);
    Ok(plain)
}

/// Nesting of parentheses and minus signs that is read.
const MAX_DEPTH: usize = 32;
/// Terms of one condition that are read.
const MAX_TERMS: usize = 500;

/// Why a text is not a condition.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ConditionError {
    /// Bytes of the text.
    pub range: Range<usize>,
    /// What was found there, and what was expected.
    pub message: String,
}

/// What reading a condition gives.
pub type Parsed<T> = Result<T, ConditionError>;

impl Expr {
    /// Reads a condition.
    ///
    /// # Errors
    /// What cannot be read: the place in `text`, what was found there and what was expected.
    pub fn parse(text: &str) -> Parsed<Expr> {
        let mut parser = Parser::new(text, None);
        let alternatives = parser.condition()?;
        Ok(Expr { text: text.to_owned(), alternatives, places: parser.places })
    }

    /// Reads a term alone, such as `0x6092.1 / 0x6092.2`: a condition that compares it with nothing.
    ///
    /// # Errors
    /// As [`Expr::parse`].
    pub fn parse_term(text: &str) -> Parsed<Expr> {
        let mut parser = Parser::new(text, None);
        let first = parser.sum()?;
        parser.blank();
        if parser.at < text.len() {
            return Err(parser.unexpected("an operator or the end"));
        }
        let alternatives = vec![vec![Comparison { first, rest: Vec::new() }]];
        Ok(Expr { text: text.to_owned(), alternatives, places: parser.places })
    }
}

struct Parser<'a, 'l> {
    text: &'a str,
    at: usize,
    depth: usize,
    terms: usize,
    places: Vec<Range<usize>>,
    /// Who knows names; without it, there are none.
    lookup: Option<&'l mut dyn Lookup>,
    /// The entry that is compared with what is read.
    compared: Option<EntryRef>,
    /// What represents names.
    replaced: Vec<(Range<usize>, String)>,
}

impl<'a, 'l> Parser<'a, 'l> {
    const fn new(text: &'a str, lookup: Option<&'l mut dyn Lookup>) -> Self {
        Self {
            text,
            at: 0,
            depth: 0,
            terms: 0,
            places: Vec::new(),
            lookup,
            compared: None,
            replaced: Vec::new(),
        }
    }

    /// The whole text: alternatives of comparisons.
    fn condition(&mut self) -> Parsed<Vec<Vec<Comparison>>> {
        let mut alternatives = vec![self.both()?];
        while self.word("or") {
            alternatives.push(self.both()?);
        }
        self.blank();
        if self.at < self.text.len() {
            return Err(self.unexpected("`and`, `or` or the end"));
        }
        Ok(alternatives)
    }

    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    fn blank(&mut self) {
        self.at = self.text.len() - self.rest().trim_start().len();
    }

    fn take(&mut self, token: &str) -> bool {
        self.blank();
        let found = self.rest().starts_with(token);
        if found {
            self.at += token.len();
        }
        found
    }

    /// Takes a whole word.
    fn word(&mut self, word: &str) -> bool {
        self.blank();
        let found = self.name() == word;
        if found {
            self.at += word.len();
        }
        found
    }

    /// The name that starts here; may be empty.
    fn name(&self) -> &'a str {
        let rest = self.rest();
        let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == '-')).unwrap_or(rest.len());
        if rest.starts_with(|c: char| c.is_alphabetic()) { &rest[..end] } else { "" }
    }

    /// The name of one or several words that starts here.
    fn words(&self) -> &'a str {
        let rest = self.rest();
        let ends = |c: char| c.is_whitespace() || "<>=!()+*/,:&|".contains(c);
        let mut end = 0;
        loop {
            let tail = &rest[end..];
            let next = tail.trim_start();
            let word = next.split(ends).next().unwrap_or_default();
            let is_word = word.starts_with(|c: char| c.is_alphanumeric() || c == '{');
            if !is_word || matches!(word, "and" | "or") {
                return &rest[..end];
            }
            end += tail.len() - next.len() + word.len();
        }
    }

    fn unexpected(&self, expected: &str) -> ConditionError {
        let rest = self.rest();
        let is_word = |c: char| c.is_alphanumeric() || matches!(c, '_' | '.');
        let word = rest.starts_with(is_word);
        let length =
            rest.find(|c: char| if word { !is_word(c) } else { c.is_whitespace() }).unwrap_or(rest.len());
        let found =
            if length == 0 { "the end".to_owned() } else { format!("`{}`", shorten(&rest[..length])) };
        let range = self.at..self.at + length;
        ConditionError { range, message: format!("found {found}, expected {expected}") }
    }

    /// An error about everything from here on.
    fn too_much(&self, message: String) -> ConditionError {
        ConditionError { range: self.at..self.text.len(), message }
    }

    /// The same about a token that began earlier.
    fn unexpected_from(&mut self, start: usize, expected: &str) -> ConditionError {
        self.at = start;
        self.unexpected(expected)
    }

    /// Comparisons that all have to hold.
    fn both(&mut self) -> Parsed<Vec<Comparison>> {
        let mut comparisons = vec![self.comparison()?];
        while self.word("and") {
            comparisons.push(self.comparison()?);
        }
        Ok(comparisons)
    }

    fn comparison(&mut self) -> Parsed<Comparison> {
        self.compared = None;
        let first = self.sum()?;
        let mut rest: Vec<(CompareOp, Term)> = Vec::new();
        while let Some(op) = self.compare_op() {
            self.compared = match rest.last().map_or(&first, |(_, term)| term) {
                Term::Entry(entry) => Some(entry.clone()),
                Term::Number(_) | Term::Bit(..) | Term::Binary(..) => None,
            };
            rest.push((op, self.sum()?));
        }
        if rest.is_empty() {
            self.blank();
            return Err(self.unexpected("a comparison: `<`, `<=`, `==`, `!=`, `>=` or `>`"));
        }
        Ok(Comparison { first, rest })
    }

    fn compare_op(&mut self) -> Option<CompareOp> {
        [
            ("<=", CompareOp::LessOrEqual),
            (">=", CompareOp::GreaterOrEqual),
            ("==", CompareOp::Equal),
            ("!=", CompareOp::NotEqual),
            ("<", CompareOp::Less),
            (">", CompareOp::Greater),
        ]
        .into_iter()
        .find_map(|(sign, op)| self.take(sign).then_some(op))
    }

    fn sum(&mut self) -> Parsed<Term> {
        let mut left = self.product()?;
        loop {
            let op = if self.take("+") {
                ArithmeticOp::Add
            } else if self.take("-") {
                ArithmeticOp::Subtract
            } else {
                return Ok(left);
            };
            left = Term::Binary(Box::new(left), op, Box::new(self.product()?));
        }
    }

    fn product(&mut self) -> Parsed<Term> {
        let mut left = self.factor()?;
        loop {
            let op = if self.take("*") {
                ArithmeticOp::Multiply
            } else if self.take("/") {
                ArithmeticOp::Divide
            } else {
                return Ok(left);
            };
            left = Term::Binary(Box::new(left), op, Box::new(self.factor()?));
        }
    }

    fn factor(&mut self) -> Parsed<Term> {
        self.depth += 1;
        self.terms += 1;
        if self.terms > MAX_TERMS {
            return Err(self.too_much(format!("more than {MAX_TERMS} terms")));
        }
        if self.depth > MAX_DEPTH {
            return Err(self.too_much("too many parentheses".to_owned()));
        }
        let term = self.factor_inner();
        self.depth -= 1;
        term
    }

    fn factor_inner(&mut self) -> Parsed<Term> {
        if self.take("(") {
            let inner = self.sum()?;
            return if self.take(")") { Ok(inner) } else { Err(self.unexpected("`)`")) };
        }
        if self.take("-") {
            let zero = Box::new(Term::Number(Ratio::whole(0)));
            return Ok(Term::Binary(zero, ArithmeticOp::Subtract, Box::new(self.factor()?)));
        }
        self.blank();
        let name = self.name();
        if name == "bit" && self.rest()[3..].trim_start().starts_with('(') {
            self.at += 3;
            self.take("(");
            let entry = self.reference()?;
            if !self.take(",") {
                return Err(self.unexpected("`,` and a bit number"));
            }
            self.blank();
            let start = self.at;
            let word = self.words();
            if self.lookup.is_some()
                && word.starts_with(|first: char| !first.is_ascii_digit() && first != '{')
            {
                self.at += word.len();
                let range = start..self.at;
                let bit = self.lookup.as_mut().and_then(|lookup| {
                    lookup.bit(&entry, &Named { device: None, text: word, range: range.clone() })
                });
                self.replaced.push((range, bit.unwrap_or_default().to_string()));
                return if self.take(")") {
                    Ok(Term::Bit(entry, bit.unwrap_or_default()))
                } else {
                    Err(self.unexpected("`)`"))
                };
            }
            let bit = self.digits(10).and_then(|digits| digits.parse().ok()).filter(|bit| *bit < 64);
            let bit = bit.ok_or_else(|| self.unexpected_from(start, "a bit number below 64"))?;
            return if self.take(")") { Ok(Term::Bit(entry, bit)) } else { Err(self.unexpected("`)`")) };
        }
        if !name.is_empty() || self.rest().starts_with("0x") || self.rest().starts_with("0X") {
            return self.operand();
        }
        if self.placeholder() {
            return Ok(Term::Number(Ratio::ZERO));
        }
        let rest = self.rest();
        let end = rest.find(|c: char| !(c.is_ascii_digit() || c == '.' || c == '_')).unwrap_or(rest.len());
        match scalar::decimal(&rest[..end]) {
            Some(number) => {
                self.at += end;
                Ok(Term::Number(number))
            }
            None => Err(self.unexpected("a number, an entry such as `0x6040` or `0x30FA.1`, or `(`")),
        }
    }

    /// An entry, or the value of one.
    fn operand(&mut self) -> Parsed<Term> {
        // In a sum or in brackets, a value has no meaning.
        let compared = self.compared.clone().filter(|_| self.depth == 1);
        let (start, name) = (self.at, self.words());
        if let Some(compared) = compared
            && !self.name().is_empty()
            && let Some(lookup) = &mut self.lookup
            && !self.text[start + name.len()..].trim_start().starts_with(':')
        {
            self.at += name.len();
            let range = start..self.at;
            let found = lookup.operand(&compared, &Named { device: None, text: name, range: range.clone() });
            return Ok(match found.unwrap_or(Operand::Entry(NO_ENTRY)) {
                Operand::Entry(id) => Term::Entry(self.named(range, None, id)),
                Operand::Number(number) => {
                    self.replaced.push((range, number.to_string()));
                    Term::Number(number)
                }
            });
        }
        self.reference().map(Term::Entry)
    }

    /// An entry that is written there by name.
    fn named(&mut self, range: Range<usize>, device: Option<&str>, id: EntryId) -> EntryRef {
        let sub = if id.sub.0 == 0 { String::new() } else { format!(".{}", id.sub.0) };
        self.replaced.push((range.clone(), format!("0x{:04X}{sub}", id.index.0)));
        self.places.push(range);
        EntryRef { device: device.map(ToOwned::to_owned), id }
    }

    /// Takes what represents the number of a constraint.
    fn placeholder(&mut self) -> bool {
        self.lookup.is_some() && self.take(PLACEHOLDER)
    }

    fn reference(&mut self) -> Parsed<EntryRef> {
        self.blank();
        let start_of_all = self.at;
        let name = self.name();
        let device = if name.is_empty() {
            None
        } else {
            let start = self.at;
            self.at += name.len();
            if self.take(":") {
                Some(name)
            } else {
                self.at = start;
                if self.lookup.is_none() {
                    return Err(self.unexpected("an entry by index, such as `0x6040`, or `device:0x6040`"));
                }
                None
            }
        };
        self.blank();
        let start_of_id = self.at;
        let words = self.words();
        if !self.name().is_empty()
            && let Some(lookup) = &mut self.lookup
        {
            self.at += words.len();
            let range = start_of_id..self.at;
            let id = lookup.entry(&Named { device, text: words, range: range.clone() });
            return Ok(self.named(range, device, id.unwrap_or(NO_ENTRY)));
        }
        if !(self.take("0x") || self.take("0X")) {
            return Err(self.unexpected("an index such as `0x6040`"));
        }
        let index = self.digits(16).and_then(|digits| u16::from_str_radix(digits, 16).ok());
        let index = index.ok_or_else(|| {
            self.unexpected_from(start_of_id, "an index of at most four hexadecimal digits")
        })?;
        let mut sub = 0;
        if self.rest().starts_with('.') {
            self.at += 1;
            let radix = if self.take("0x") { 16 } else { 10 };
            let start = self.at;
            let digits = self.digits(radix).and_then(|digits| u8::from_str_radix(digits, radix).ok());
            sub = digits.ok_or_else(|| self.unexpected_from(start, "a sub-index, 0 to 255"))?;
        }
        let range = start_of_all..self.at;
        self.places.push(range.clone());
        let entry = EntryRef {
            device: device.map(ToOwned::to_owned),
            id: EntryId { index: Index(index), sub: SubIndex(sub) },
        };
        if let Some(lookup) = &mut self.lookup {
            lookup.numbered(&entry, range);
        }
        Ok(entry)
    }

    fn digits(&mut self, radix: u32) -> Option<&'a str> {
        if self.placeholder() {
            return Some("0");
        }
        let rest = self.rest();
        let end = rest.find(|c: char| !c.is_digit(radix)).unwrap_or(rest.len());
        self.at += end;
        (end > 0).then(|| &rest[..end])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Fixed;

    impl Values for Fixed {
        fn value(&self, entry: &EntryRef) -> Option<Ratio> {
            self.raw(entry).map(Ratio::whole)
        }
        fn raw(&self, entry: &EntryRef) -> Option<i128> {
            match (entry.id.index.0, entry.id.sub.0) {
                (0x1000, sub) => Some(i128::from(sub) * 10),
                (0x2000, 0) => Some(0b100),
                _ => None,
            }
        }
    }

    fn outcome(text: &str) -> Outcome {
        Expr::parse(text).unwrap().evaluate(&Fixed)
    }

    #[test]
    fn chains_arithmetic_and_bits() {
        for text in [
            "0x1000.1 < 0x1000.2 <= 20",
            "0x1000.3 == (0x1000.1 + 5) * 2",
            "bit(0x2000, 2) == 1 and bit(0x2000, 1) == 0",
            "0x1000.0x0A == 100",
            "pmc:0x1000.1 / 4 == 2.5",
            "-3 < 0x1000",
        ] {
            assert_eq!(outcome(text), Outcome::Holds, "{text}");
        }
        assert_eq!(outcome("0x3000 < 1"), Outcome::Unknown);
        assert_eq!(outcome("1 / 0 < 1"), Outcome::Unknown);
        assert!(matches!(outcome("0x1000.1 < 20 < 0x1000.1"), Outcome::Fails { op: CompareOp::Less, .. }));
        assert!(matches!(outcome("0x3000 < 1 and 2 < 1"), Outcome::Fails { .. }));
    }

    #[test]
    fn one_of_several_has_to_hold() {
        for text in ["1 < 0 or 0x1000.1 == 10", "1 < 2 and 2 < 1 or 3 < 4 and 4 < 5", "0x3000 < 1 or 1 < 2"] {
            assert_eq!(outcome(text), Outcome::Holds, "{text}");
        }
        // `and` binds more strongly: brackets are those of terms alone.
        assert!(
            matches!(outcome("1 < 2 and 2 < 1 or 4 < 3"), Outcome::Fails { right: (_, value), .. } if value == Ratio::ONE)
        );
        assert_eq!(outcome("2 < 1 or 0x3000 < 1"), Outcome::Unknown);
        assert_eq!(outcome("0x3000 < 1 and 2 < 1 or 1 / 0 < 1"), Outcome::Unknown);
        assert!(matches!(outcome("0x3000 < 1 and 2 < 1 or 4 < 3"), Outcome::Fails { .. }));
    }

    /// Knows a few names of 1000h, of the bit 2 and of the value 7.
    struct Few(Vec<String>);

    impl Lookup for Few {
        fn entry(&mut self, name: &Named<'_>) -> Option<EntryId> {
            self.0.push(format!("{:?} {} {:?}", name.device, name.text, name.range));
            let sub = ["actual speed", "limits.high", "a-b"].iter().position(|known| *known == name.text)?;
            Some(EntryId { index: Index(0x1000), sub: SubIndex(u8::try_from(sub).unwrap()) })
        }
        fn operand(&mut self, compared: &EntryRef, name: &Named<'_>) -> Option<Operand> {
            let value = (compared.id.index.0 == 0x1000 && name.text == "at rest")
                .then(|| Operand::Number(Ratio::whole(7)));
            value.or_else(|| self.entry(name).map(Operand::Entry))
        }
        fn bit(&mut self, _: &EntryRef, name: &Named<'_>) -> Option<u8> {
            (name.text == "fault reset").then_some(2)
        }
    }

    #[test]
    fn names_become_indices_and_numbers() {
        for (text, plain) in [
            ("actual speed <= limits.high", "0x1000 <= 0x1000.1"),
            ("actual speed - 5 < 3 and a-b > -1", "0x1000 - 5 < 3 and 0x1000.2 > -1"),
            ("lamp:limits.high<a-b", "lamp:0x1000.1<0x1000.2"),
            ("actual speed == at rest or 0x2000 == 1", "0x1000 == 7 or 0x2000 == 1"),
            ("bit(limits.high , fault reset) == 1", "bit(0x1000.1 , 2) == 1"),
            ("bit(0x2000, 5) * (actual speed + 1) == 0", "bit(0x2000, 5) * (0x1000 + 1) == 0"),
            ("0x1000 == at rest", "0x1000 == 7"),
            ("0x2000.{n} < {n} + bit(actual speed, {n})", "0x2000.{n} < {n} + bit(0x1000, {n})"),
        ] {
            assert_eq!(without_names(text, &mut Few(Vec::new())).unwrap(), plain, "{text}");
        }
        let mut asked = Few(Vec::new());
        without_names("one two < lamp : three", &mut asked).unwrap();
        assert_eq!(asked.0, ["None one two 0..7", "Some(\"lamp\") three 17..22"]);
        for text in ["and < 1", "one two three", "one <", "bit(one two) == 1", "one, two < 3"] {
            assert!(without_names(text, &mut AnyName).is_err(), "{text}");
        }
        assert!(Expr::parse("actual speed < 1").is_err() && Expr::parse("0x2000.{n} < 1").is_err());
    }

    #[test]
    fn mistakes_have_a_place() {
        for (text, start, expected) in [
            ("0x1000", 6, "a comparison"),
            ("0x1000 <", 8, "a number"),
            ("0x1000 < controlword", 9, "an entry by index"),
            ("0x10000 < 1", 0, "at most four"),
            ("(0x1000 < 1", 8, "`)`"),
            ("1 < 2 xor", 6, "`and`, `or`"),
            ("1 < 2 or", 8, "a number"),
            ("bit(0x1000) == 1", 10, "`,`"),
            ("bit(0x1000, 64) == 1", 12, "below 64"),
        ] {
            let ConditionError { range, message } = Expr::parse(text).unwrap_err();
            assert_eq!(range.start, start, "{text}: {message}");
            assert!(message.contains(expected), "{text}: {message}");
        }
        assert!(Expr::parse(&"(".repeat(1000)).is_err());
        assert!(Expr::parse(&format!("0x2000 < 1{}", "+1".repeat(200_000))).is_err());
    }
}
