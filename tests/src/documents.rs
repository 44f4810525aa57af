//! The documents of specifications of the workspace, printed once for all tests of a program.

use std::collections::BTreeMap;

use od_documents::{self as docs, Format, Templates};

use crate::memo::Memo;
use crate::{Failure, compile_clean};

/// Texts by the name of their page; `tables.json` is one of them.
pub type Pages = BTreeMap<String, String>;

/// The pages of a specification in a format and a language.
///
/// # Errors
/// The specification is not clean, or cannot be printed.
pub fn pages(spec: &str, format: Format, language: &str) -> Result<&'static Pages, Failure> {
    static PRINTED: Memo<(String, Format, String), Pages> = Memo::empty();
    PRINTED.get((spec.to_owned(), format, language.to_owned()), || {
        let system = compile_clean(spec)?;
        let templates = [Templates::new(Some(format), &[])?];
        let files =
            docs::artifacts(&system, "", "s", &docs::options(&system, &[], Some(language)), &templates)?;
        let name = |path: &str| path.trim_start_matches("s/").to_owned();
        files.into_iter().map(|file| Ok((name(&file.path), String::from_utf8(file.bytes)?))).collect()
    })
}

/// What templates see of a specification in a language.
///
/// # Errors
/// The specification is not clean.
pub fn context(spec: &str, language: &str) -> Result<&'static serde_json::Value, Failure> {
    static SEEN: Memo<(String, String), serde_json::Value> = Memo::empty();
    SEEN.get((spec.to_owned(), language.to_owned()), || {
        let system = compile_clean(spec)?;
        let options = docs::options(&system, &[], Some(language));
        let context = docs::dump_context(&system, &docs::Options { gaps: docs::Gaps::InPlace, ..options });
        Ok(serde_json::from_slice(&context)?)
    })
}
