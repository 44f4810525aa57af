//! Languages of documents: each is a file of texts in `languages/`, and a text is found by its section and key.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::{LazyLock, OnceLock};

use crate::model::Date;

/// The languages of the files in `languages/`, one line each.
macro_rules! languages {
    ($($(#[$meta:meta])* $name:ident $code:literal;)+) => {
        impl Language {
            $($(#[$meta])* pub const $name: Self = Self::new($code, || {
                static TEXTS: LazyLock<Texts> =
                    LazyLock::new(|| Texts::read(include_str!(concat!("../../languages/", $code, ".txt"))));
                &TEXTS
            });)+

            /// The languages whose texts are known.
            pub const ALL: &'static [Self] = &[$(Self::$name,)+];
        }
    };
}

languages! {
    /// English, also for languages whose texts are not known.
    ENGLISH "en";
    /// German.
    GERMAN "de";
}

/// A language whose texts are known.
#[derive(Clone, Copy)]
pub struct Language {
    code: &'static str,
    texts: fn() -> &'static Texts,
}

impl Language {
    /// A language with texts of its own. What they lack is English.
    pub const fn new(code: &'static str, texts: fn() -> &'static Texts) -> Self {
        Self { code, texts }
    }

    /// Its code: `de`.
    pub const fn code(self) -> &'static str {
        self.code
    }

    /// The language of a code such as `de` or `de-AT`.
    pub fn of(code: &str) -> Self {
        let is_of = |language: &&Self| {
            code.strip_prefix(language.code).is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
        };
        Self::ALL.iter().find(is_of).copied().unwrap_or(Self::ENGLISH)
    }

    /// A text; the key itself where neither the language nor English has one, as English has none for the words of
    /// specifications.
    pub fn text(self, section: &str, key: &'static str) -> &'static str {
        let own = (self.texts)().get(section, key);
        own.or_else(|| (Self::ENGLISH.texts)().get(section, key)).unwrap_or(key)
    }

    /// Its texts, in the order of the file.
    pub fn lines(self) -> impl Iterator<Item = &'static Line> {
        (self.texts)().sections.iter().flat_map(|section| &section.texts().lines)
    }

    /// The keys and texts of a section, in the order of the file.
    pub fn section(self, section: &str) -> impl Iterator<Item = (&'static str, &'static str)> {
        self.lines().filter(move |line| line.section == section).map(|line| (line.key, &*line.text))
    }

    /// The words that running texts of any language have for something, in lower case.
    pub fn words_of_all(key: &'static str) -> impl Iterator<Item = &'static str> {
        let texts = Self::ALL.iter().filter_map(move |language| (language.texts)().get("running texts", key));
        texts.flat_map(|words| words.split(", ")).filter(|word| !word.is_empty())
    }

    /// A number that was written with a decimal point, as the language writes it.
    pub fn decimal(self, number: &str) -> String {
        number.replace('.', self.text("language", "decimal_sign"))
    }

    /// A date: `2009-05-27`, in German `27.05.2009`.
    pub fn date(self, date: Date) -> String {
        let Date { year, month, day } = date;
        let parts = [format!("{year:04}"), format!("{month:02}"), format!("{day:02}")];
        filled(self.text("language", "date"), &[&parts[0], &parts[1], &parts[2]])
    }
}

impl PartialEq for Language {
    fn eq(&self, other: &Self) -> bool {
        self.code == other.code
    }
}

impl Eq for Language {}

impl fmt::Debug for Language {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.code)
    }
}

/// One text of a language.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Line {
    /// Section of the file.
    pub section: &'static str,
    /// Key in the section.
    pub key: &'static str,
    /// The text.
    pub text: String,
}

/// The texts of a language.
#[derive(Debug)]
pub struct Texts {
    sections: Vec<Section>,
}

/// A section of the file of a language, which is read when one of its texts is asked for: most programs need a few of them.
#[derive(Debug)]
struct Section {
    name: &'static str,
    file: &'static str,
    texts: OnceLock<SectionTexts>,
}

#[derive(Debug)]
struct SectionTexts {
    lines: Vec<Line>,
    /// Positions in `lines`, by key.
    places: BTreeMap<&'static str, usize>,
}

impl Texts {
    /// Reads the texts of a file: a section is `[name]`, a text `key = text`; a line that begins with a space continues the
    /// text before it, and one that begins with `#` is a comment.
    pub fn read(file: &'static str) -> Self {
        let (mut sections, mut name, mut start) = (Vec::new(), "", 0);
        let mut section = |name, file| sections.push(Section { name, file, texts: OnceLock::new() });
        for at in memchr::memchr_iter(b'[', file.as_bytes()) {
            let header = file[at..].lines().next().unwrap_or_default();
            if let Some(next) = header.strip_prefix('[').and_then(|line| line.strip_suffix(']'))
                && (at == 0 || file[..at].ends_with('\n'))
            {
                section(name, &file[start..at]);
                (name, start) = (next, at + header.len());
            }
        }
        section(name, &file[start..]);
        Self { sections }
    }

    fn get(&self, section: &str, key: &str) -> Option<&str> {
        // What is there twice is reported by a test; the last one counts.
        let mut sections = self.sections.iter().rev().filter(|one| one.name == section);
        sections.find_map(|section| section.texts().get(key))
    }
}

impl Section {
    fn texts(&self) -> &SectionTexts {
        self.texts.get_or_init(|| {
            let mut lines: Vec<Line> = Vec::new();
            for line in self.file.lines().filter(|line| !line.trim().is_empty() && !line.starts_with('#')) {
                if line.starts_with(' ')
                    && let Some(last) = lines.last_mut()
                {
                    last.text.push(' ');
                    last.text.push_str(line.trim());
                } else {
                    let (key, text) = line.split_once('=').unwrap_or((line, ""));
                    lines.push(Line { section: self.name, key: key.trim(), text: text.trim().to_owned() });
                }
            }
            let places = lines.iter().enumerate().map(|(at, line)| (line.key, at)).collect();
            SectionTexts { lines, places }
        })
    }
}

impl SectionTexts {
    fn get(&self, key: &str) -> Option<&str> {
        self.places.get(key).map(|at| &*self.lines[*at].text)
    }
}

/// A text with these parts in place of `{1}`, `{2}` and so on.
pub fn filled(text: &str, parts: &[&str]) -> String {
    let mut pieces = text.split('{');
    let mut filled = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let numbered = piece.split_once('}').and_then(|(number, rest)| {
            Some((parts.get(number.parse::<usize>().ok()?.checked_sub(1)?)?, rest))
        });
        match numbered {
            Some((part, rest)) => {
                filled.push_str(part);
                filled.push_str(rest);
            }
            None => {
                filled.push('{');
                filled.push_str(piece);
            }
        }
    }
    filled
}

/// Names for the texts of a section of the language files.
///
/// ```
/// use od_spec::wording::Language;
///
/// od_spec::texts! {
///     /// Which part of an object is meant.
///     enum Part in "departures" {
///         Elements = "elements",
///     }
/// }
/// assert_eq!(Part::Elements.text(Language::GERMAN), "Elemente: {1}");
/// assert_eq!(Part::Elements.filled(Language::ENGLISH, &["unit"]), "elements: unit");
/// ```
#[macro_export]
macro_rules! texts {
    ($(#[$meta:meta])* $vis:vis enum $name:ident in $section:literal { $($variant:ident = $key:literal,)+ }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        $vis enum $name { $(#[doc = concat!("`", $key, "` of `", $section, "`.")] $variant,)+ }

        #[allow(dead_code, reason = "not every section needs each of them")]
        impl $name {
            /// All of them.
            $vis const ALL: &'static [Self] = &[$(Self::$variant,)+];

            /// The key in the language files.
            $vis const fn key(self) -> &'static str {
                match self { $(Self::$variant => $key,)+ }
            }

            /// The text in a language.
            $vis fn text(self, language: $crate::wording::Language) -> &'static str {
                language.text($section, self.key())
            }

            /// The text in a language, with these parts in place of `{1}`, `{2}` and so on.
            $vis fn filled(self, language: $crate::wording::Language, parts: &[&str]) -> String {
                $crate::wording::filled(self.text(language), parts)
            }
        }
    };
}
