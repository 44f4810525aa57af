//! Words and turns that no text of the project uses: a native technical writer would replace each of them.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use od_tests::{Failure, root};

use crate::runner::Runner;

/// Words in lower case, separated by `|`, and what to write instead.
const WORDS: [(&str, &str); 12] = [
    ("stand|stands|stood|standing", "is, is written"),
    ("tell|tells|told|telling", "reports, prints, shows, states"),
    ("tell apart|tells apart|told apart", "distinguishes"),
    ("nobody|somebody|anybody|everybody|whoever", "a user, a caller, a tool, or the passive"),
    ("foretell|foretells|foretold|foretelling", "predicts"),
    ("but for|save for", "except, except for"),
    ("put right|puts right|putting right", "fixes, corrects"),
    ("behind", "after, in brackets after"),
    ("beside", "next to, in addition to, together with, other than"),
    ("is none|are none|was none|be none", "is not a valid …"),
    ("no less than", "at least"),
    ("blank|blanks|capital|capitals", "space, upper case"),
];

/// Phrases in which a listed word is right.
const ALLOWED: [(&str, &str); 8] = [
    ("there is none", "says that something does not exist"),
    ("there are none", "says that something does not exist"),
    ("blank line", "a line without characters"),
    ("left blank", "a form without an entry"),
    ("figure is none", "a test of a template"),
    ("stand des", "German"),
    ("welchen stand", "German"),
    ("stand‸by", "a word with the cursor of a test in it"),
];

/// What is not looked at: copies, German texts, and texts that transcribe the manuals of their devices.
const OTHERS: [&str; 4] =
    ["generated", "od-spec/devices", "od-spec/languages/de.txt", "tests/src/bin/xtask/english.rs"];

/// Where a file has text for people.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Notation {
    /// In comments and string literals.
    Rust,
    /// In comments: the beginning of one up to the end of its line, and the brackets of one over lines.
    Comments { line: &'static str, block: [&'static str; 2] },
    /// Everywhere.
    Text,
}

impl Notation {
    /// `None` for files without text, and for data of tests.
    fn of(path: &str) -> Option<Self> {
        let is_text = !path.starts_with("tests/") && !path.contains("/tests/");
        Some(match path.rsplit('.').next()? {
            "rs" => Self::Rust,
            "c" | "h" | "js" | "mjs" => Self::Comments { line: "//", block: ["/*", "*/"] },
            "css" => Self::Comments { line: "/*", block: ["/*", "*/"] },
            "py" => Self::Comments { line: "#", block: ["\"\"\"", "\"\"\""] },
            "toml" => Self::Comments { line: "#", block: ["\0", "\0"] },
            "yaml" if is_text => Self::Text,
            "yaml" => Self::Comments { line: "#", block: ["\0", "\0"] },
            "md" | "html" | "adoc" | "txt" => Self::Text,
            _ => return None,
        })
    }
}

/// Reports every listed word in the texts of the workspace.
pub(crate) fn check(_: &mut Runner) -> Result<(), Failure> {
    let mut found = String::new();
    let mut count = 0;
    for path in files("")? {
        let Some(notation) = Notation::of(&path) else { continue };
        let text = fs::read_to_string(root().join(&path))?;
        for (line, word, better) in findings(notation, &text) {
            count += 1;
            let _ = write!(found, "\n{path}:{line}: `{word}`; write: {better}");
        }
    }
    if count == 0 {
        Ok(())
    } else {
        Err(format!("{count} words of tests/src/bin/xtask/english.rs:{found}").into())
    }
}

/// The files below a folder of the workspace that are looked at, in order.
fn files(folder: &str) -> Result<Vec<String>, Failure> {
    let mut files = Vec::new();
    for entry in fs::read_dir(root().join(folder))? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let path = if folder.is_empty() { name.clone() } else { format!("{folder}/{name}") };
        let is_left_out =
            name.starts_with('.') || ["target", "node_modules", "__pycache__"].contains(&&*name);
        if is_left_out || OTHERS.contains(&&*path) {
            continue;
        }
        if entry.file_type()?.is_dir() {
            files.extend(self::files(&path)?);
        } else if Path::new(&path).extension().is_some() {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

/// The listed words in the prose of a text: line, word, and what to write.
fn findings(notation: Notation, text: &str) -> Vec<(usize, &'static str, &'static str)> {
    let mut found = Vec::new();
    for (at, line) in prose(notation, text).lines().enumerate() {
        let mut line = format!(" {} ", without_code(line).to_lowercase());
        for (phrase, _) in ALLOWED {
            line = line.replace(phrase, "");
        }
        for (words, better) in WORDS {
            found.extend(
                words.split('|').filter(|word| has_word(&line, word)).map(|word| (at + 1, word, better)),
            );
        }
    }
    found
}

/// Whether a word is in a line, and not as a part of a longer one.
fn has_word(line: &str, word: &str) -> bool {
    let is_part = |c: char| c.is_alphanumeric() || "_-".contains(c);
    line.match_indices(word).any(|(at, _)| {
        let (before, after) = (&line[..at], &line[at + word.len()..]);
        !before.ends_with(is_part) && !before.ends_with(':') && !after.starts_with(is_part)
    })
}

/// A line without what is between backticks, and without the names of values in it.
fn without_code(line: &str) -> String {
    let spoken = line.split('`').step_by(2).collect::<Vec<_>>().join("`");
    let mut text = String::new();
    for (at, part) in spoken.split('{').enumerate() {
        let name = part.len() - part.trim_start_matches(|c: char| c.is_alphanumeric() || c == '_').len();
        let is_value = at > 0 && part[name..].starts_with(['}', ':']);
        text.push_str(if is_value { &part[name..] } else { part });
        text.push(' ');
    }
    text
}

/// The prose of a text, each piece on its line.
fn prose(notation: Notation, text: &str) -> String {
    match notation {
        Notation::Rust => rust_prose(text),
        Notation::Comments { line, block } => comments(text, line, block),
        Notation::Text => text.to_owned(),
    }
}

fn comments(text: &str, start: &str, [open, close]: [&str; 2]) -> String {
    let mut prose = String::new();
    let mut is_open = false;
    for line in text.lines() {
        let mut rest = line;
        loop {
            if is_open {
                let end = rest.find(close);
                prose.push_str(&rest[..end.unwrap_or(rest.len())]);
                let Some(end) = end else { break };
                rest = &rest[end + close.len()..];
                is_open = false;
            } else if let Some(at) = rest.find(open) {
                rest = &rest[at + open.len()..];
                is_open = true;
            } else {
                prose.push_str(rest.find(start).map_or("", |at| &rest[at..]));
                break;
            }
        }
        prose.push('\n');
    }
    prose
}

/// Comments and string literals; characters and raw strings are known, so that no quote in them begins a string.
fn rust_prose(text: &str) -> String {
    let mut prose = String::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let hashes = rest.strip_prefix('r').map(|rest| rest.len() - rest.trim_start_matches('#').len());
        let (skipped, length, end) = if rest.starts_with("//") {
            (2, rest.find('\n').unwrap_or(rest.len()), 0)
        } else if let Some(hashes) = hashes
            && rest[1 + hashes..].starts_with('"')
        {
            let close = format!("\"{}", "#".repeat(hashes));
            let begin = 2 + hashes;
            let inner = rest[begin..].find(&close).unwrap_or(rest.len() - begin);
            (begin, begin + inner, close.len())
        } else if first == '"' {
            (1, 1 + string_length(&rest[1..]), 1)
        } else {
            let length = character_length(rest).unwrap_or(first.len_utf8());
            prose.extend(rest[..length].chars().filter(|c| *c == '\n'));
            rest = &rest[length..];
            continue;
        };
        prose.push_str(&rest[skipped..length]);
        prose.push(' ');
        rest = rest.get(length + end..).unwrap_or("");
    }
    prose
}

/// How long a string literal is, up to the quote that ends it.
fn string_length(text: &str) -> usize {
    let mut escaped = false;
    let end = text.char_indices().find(|(_, c)| {
        let is_end = *c == '"' && !escaped;
        escaped = *c == '\\' && !escaped;
        is_end
    });
    end.map_or(text.len(), |(at, _)| at)
}

/// How long a character literal is; `None` for anything else, such as a lifetime.
fn character_length(text: &str) -> Option<usize> {
    let inner = text.strip_prefix('\'')?;
    let escape = inner.strip_prefix('\\').map(|escape| 1 + escape.chars().next().map_or(0, char::len_utf8));
    let least = escape.or_else(|| inner.chars().next().map(char::len_utf8))?;
    let end = least + inner.get(least..)?.find('\'')?;
    (escape.is_some() && end < 12 || end == least).then_some(end + 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(path: &str, text: &str) -> Vec<(usize, &'static str)> {
        let found = findings(Notation::of(path).unwrap(), text);
        found.into_iter().map(|(line, word, _)| (line, word)).collect()
    }

    #[test]
    fn every_word_is_found_in_every_kind_of_text() {
        for word in WORDS.iter().flat_map(|(words, _)| words.split('|')) {
            let sentence = format!("A value {word}, as usual.");
            for (path, text) in [
                ("a/src/b.rs", format!("fn f() {{}}\n/// {sentence}\n")),
                ("a/src/b.rs", format!("\nconst A: &str = \"{sentence}\";\n")),
                ("a/src/b.rs", format!("\nconst A: &str = r#\"{sentence}\"#; // '\"'\n")),
                ("a/src/b.rs", format!("const A: char = '\"';\nfn f<'a>() {{}} // {sentence}\n")),
                ("a/b.c", format!("int a;\n/* {sentence} */\n")),
                ("a/b.py", format!("\"\"\"First.\n{sentence}\"\"\"\n")),
                ("a/tests/b.yaml", format!("a: b\nc: d  # {sentence}\n")),
                ("a/b.yaml", format!("a: b\nabout: {sentence}\n")),
                ("a/b.md", format!("# A\n{}\n", sentence.to_uppercase())),
            ] {
                assert!(words(path, &text).contains(&(2, word)), "{path}: {text}");
            }
        }
    }

    #[test]
    fn code_longer_words_and_allowed_phrases_are_no_findings() {
        for text in [
            "fn tell(told: u8) -> bool { behind }",
            "/// Standard, standstill, stand-alone, intolerable, `behind`, and [`tell`](Self::tell_all).",
            "const A: &str = \"{told} {told:?}\";",
        ] {
            assert_eq!(words("a/src/b.rs", text), [], "{text}");
        }
        for (phrase, reason) in ALLOWED {
            assert_eq!(words("a.md", &format!("Here {phrase}.")), [], "{phrase}: {reason}");
        }
        assert_eq!(words("tests/a.yaml", "name: behind"), []);
    }

    #[test]
    fn what_is_left_out_exists() {
        for path in OTHERS {
            assert!(root().join(path).exists(), "{path}");
        }
    }
}
