//! The files of `tests/eds`, each with a fault that the world's files have: what is said, and what is mended.

use std::fmt::Write as _;

use od_spec::diag::Diagnostics;
use od_spec::diag::render::{Format, render};
use od_spec::fix;

use crate::format_rules::{codes, errors, files, said};

/// What is said about the text; these files describe next to nothing, and the rules about dictionaries say so.
fn about_text(found: &Diagnostics) -> Diagnostics {
    let mut about_text = Diagnostics::new();
    found.iter().filter(|one| one.code.id.starts_with("EDS")).for_each(|one| about_text.push(one.clone()));
    about_text
}

#[test]
fn messy_files_say_what_was_reviewed() {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../../eds/snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| {
        for path in files("tests/eds", &["eds", "dcf"]) {
            let name = path.file_name().unwrap().to_str().unwrap();
            let bytes = std::fs::read(&path).unwrap();
            let (found, sources) = said(name, &bytes);
            let code = name.split('_').next().unwrap().to_uppercase();
            assert!(codes(&found).contains(code.as_str()), "{name}: {:?}", codes(&found));

            let fixed = fix(name, &bytes).unwrap();
            assert!(errors(&fixed.left) <= errors(&found), "{name}");
            let left = render(&about_text(&fixed.left), &fixed.sources, Format::Short, false);
            let found = render(&about_text(&found), &sources, Format::Short, false);
            // Breaks and what cannot be seen are seen.
            let text: String = fixed.text().split_inclusive('\n').fold(String::new(), |mut text, line| {
                let _ = writeln!(text, "{line:?}");
                text
            });
            insta::assert_snapshot!(
                name,
                format!("found:\n{found}\nmended, in {}:\n{text}\nleft:\n{left}", fixed.encoding)
            );
            let again = fix(name, &fixed.to_bytes()).unwrap();
            assert!(again.changes.is_empty() && again.to_bytes() == fixed.to_bytes(), "{name}");
        }
    });
}
