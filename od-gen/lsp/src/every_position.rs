//! Everything that can be asked at a position, asked at positions of the shipped specifications and of broken ones.

use std::path::Path;
use std::str::FromStr as _;

use lsp_types::{Position, Range, TextDocumentItem, Uri};

use super::completion::{Insertion, completion};
use super::definition::{definition, highlights, references};
use super::hover::hover;
use super::inlay::{Hint, hints};
use super::position::Encoding;
use super::rename::prepare;
use super::workspace::Workspace;

/// Asks at every position of a line that is looked at; how often there was something to say.
fn asked(name: &str, text: &str, every: usize) -> [usize; 4] {
    let folder =
        Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../od-spec/devices")).canonicalize().unwrap();
    let uri = Uri::from_str(&format!("file://{}/{name}", folder.display())).unwrap();
    let mut workspace = Workspace::default();
    workspace.open(TextDocumentItem {
        uri: uri.clone(),
        language_id: "yaml".into(),
        version: 1,
        text: text.into(),
    });
    let snapshot = workspace.snapshot(&uri, Encoding::Utf16).unwrap();
    let mut answers = [0; 4];
    for (line, written) in (0_u32..).zip(text.lines()).step_by(every) {
        let end = u32::try_from(written.encode_utf16().count()).unwrap();
        // A few places in each line, another one in each; between the halves of a character, too.
        for character in [0, line % 7 + 2, line % 23 + 5, end / 2, end, end + 3] {
            let at = Position { line, character };
            answers[0] += usize::from(hover(&snapshot, at).is_some());
            answers[1] += definition(&snapshot, at).len();
            answers[2] += references(&snapshot, at, true).len() + highlights(&snapshot, at).len();
            let _ = prepare(&snapshot, at);
            // Each of these reads the whole text.
            if (line as usize).is_multiple_of(every * 8) {
                answers[3] += completion(&snapshot, at, &Insertion { snippets: true, next: None }).len();
            }
        }
    }
    let all = Range { start: Position::default(), end: Position { line: u32::MAX, character: 0 } };
    let _ = hints(&snapshot, all, &Hint::wanted(None));
    answers
}

#[test]
fn every_position_has_an_answer() {
    for name in
        ["pitch-control-system", "fullmo-drive", "fullmo-drive.document", "pitch-control-system.errata"]
    {
        let file = format!("{name}.od.yaml");
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../od-spec/devices");
        let text = std::fs::read_to_string(Path::new(folder).join(&file)).unwrap();
        let answers = asked(&file, &text, 53);
        assert!(answers[0] > 30 && answers[1] > 0 && answers[2] > 0, "{name}: {answers:?}");
        // Cut in the middle, and with something left open.
        let middle = text.char_indices().nth(text.chars().count() / 2).unwrap().0;
        asked(&file, &text[..middle], 509);
        asked(&file, &format!("{}{{ \"x: [{}", &text[..middle], &text[middle..]), 509);
    }
}
