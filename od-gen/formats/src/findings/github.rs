//! Workflow commands of GitHub Actions: `::error file=drive.eds,line=3,col=7,title=…::…`.

use od_spec::diag::{Diagnostic, Diagnostics, Severity};
use od_spec::source::SourceMap;
use od_spec::visible::visible;

use super::written;

/// One workflow command for each message, in a line of its own; it shows the message next to the source line.
pub fn github(diagnostics: &Diagnostics, sources: &SourceMap) -> String {
    written(diagnostics).map(|diagnostic| command(&diagnostic, sources) + "\n").collect()
}

/// A message as one command, in one line.
fn command(diagnostic: &Diagnostic, sources: &SourceMap) -> String {
    let word = match diagnostic.severity() {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "notice",
    };
    let place = diagnostic.labels.first().map(|label| {
        let file = sources.file(label.span.file);
        let start = file.line_col(label.span.start);
        format!("file={},line={},col={},", property(&visible(file.name())), start.line, start.column)
    });
    let title = format!("{}: {}", diagnostic.code.id, diagnostic.code.title);
    let label = diagnostic.labels.first().map(|label| label.text.as_str()).filter(|text| !text.is_empty());
    let first = label.map_or(diagnostic.message.clone(), |label| format!("{}: {label}", diagnostic.message));
    let help = diagnostic.help.iter().map(|help| format!("help: {help}"));
    let notes = diagnostic.all_notes().map(|note| format!("note: {note}"));
    let lines: Vec<String> = [first].into_iter().chain(help).chain(notes).collect();
    format!("::{word} {}title={}::{}", place.unwrap_or_default(), property(&title), data(&lines.join("\n")))
}

/// The text of a command: what would end the line is escaped.
fn data(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// The value of a property: what would end the value is escaped, too.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

#[cfg(test)]
mod tests {
    use super::*;
    use od_spec::diag::codes;

    #[test]
    fn what_ends_a_line_or_a_value_is_escaped() {
        let mut sources = SourceMap::new();
        let file = sources.add("a,b:100%.eds", "[x]\nn=1\n");
        let place = sources.whole(file).part(4, 7);
        let diagnostic =
            Diagnostic::new(codes::UNKNOWN_KEY, place, "100% of `a, b: c`").label("here").help("try::it");
        assert_eq!(
            command(&diagnostic, &sources),
            "::error file=a%2Cb%3A100%25.eds,line=2,col=1,title=OD0201%3A an unknown key::\
             100%25 of `a, b: c`: here%0Ahelp: try::it"
        );
        let without = Diagnostic::without_place(codes::UNREADABLE, "gone").note("really");
        assert_eq!(
            command(&without, &sources),
            "::error title=OD0101%3A a file cannot be read::gone%0Anote: really"
        );
    }
}
