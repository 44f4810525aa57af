//! Mistakes in a user's templates are told with a place.

use docs_gen::{Format, TemplateError, Templates};

/// The parser counts bytes, and stops inside a character.
#[test]
fn a_place_holds_whole_characters() {
    for text in ["{{ li\u{FFFD}ne }}", "{{ ä }}", "{% if ä %}", "ä{{ 'ä"] {
        let user = [("device.md".to_owned(), text.to_owned())];
        let error = Templates::new(Some(Format::Markdown), &user).err();
        let place = match &error {
            Some(TemplateError::InTemplate { source, range, .. }) => source.get(range.clone()),
            Some(TemplateError::NothingIsPrinted | TemplateError::SamePage(_)) | None => None,
        };
        assert!(place.is_some(), "{text}: {error:?}");
    }
}
