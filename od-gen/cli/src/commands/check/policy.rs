//! What counts as an error and what is left out, as the command line wants it.

use od_spec::diag::readers::Readers;
use od_spec::diag::{Code, Diagnostic, Diagnostics, Severity, codes};
use od_spec::{all_codes, nearest};

use super::args::CheckArgs;

/// Which findings an option is about.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Selector {
    /// Those whose code begins so, in upper case; a whole code is the longest beginning.
    Codes(String),
    /// All that are this serious.
    Serious(Severity),
}

/// What is done with findings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Treatment {
    Allow,
    Deny,
}

/// The treatment of findings.
#[derive(Debug, Default)]
pub(super) struct Policy {
    rules: Vec<(Selector, Treatment)>,
    /// Who is to read the EDS or DCF; none: any reader.
    readers: Readers,
}

/// Whether errors can be left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Errors {
    /// In an EDS or DCF, which is read whatever is wrong with it.
    CanBeAllowed,
    /// In a specification, from which nothing can be made, and for what cannot be read.
    Stay,
}

impl Policy {
    /// What the options say.
    pub(super) fn of(args: &CheckArgs) -> Result<Self, Box<Diagnostic>> {
        let mut rules = Vec::new();
        if args.deny_warnings {
            rules.push((Selector::Serious(Severity::Warning), Treatment::Deny));
        }
        let deny = args.deny.iter().map(|text| ("--deny", text, Treatment::Deny));
        let allow = args.allow.iter().map(|text| ("--allow", text, Treatment::Allow));
        for (option, text, treatment) in deny.chain(allow) {
            rules.push((selector(option, text)?, treatment));
        }
        let mut readers = Readers::NONE;
        for name in &args.readers {
            readers.insert((*name).into());
        }
        Ok(Self { rules, readers })
    }

    /// The findings that are left, as serious as they are taken.
    pub(super) fn apply(&self, found: &Diagnostics, errors: Errors) -> Diagnostics {
        let mut left = Diagnostics::new();
        for diagnostic in found {
            let mut diagnostic = diagnostic.clone();
            if !self.readers.is_empty() && errors == Errors::CanBeAllowed {
                let is_minded = diagnostic.minded_by.meet(self.readers);
                diagnostic.severity = if is_minded { Severity::Error } else { Severity::Note };
            }
            let stays = diagnostic.severity == Severity::Error && errors == Errors::Stay;
            match self.treatment(diagnostic.code, diagnostic.severity) {
                Some(Treatment::Allow) if !stays => continue,
                Some(Treatment::Deny) => diagnostic.severity = Severity::Error,
                Some(Treatment::Allow) | None => {}
            }
            left.push(diagnostic);
        }
        left
    }

    /// The most particular word about a finding counts, and of two that are equally particular the stricter one.
    fn treatment(&self, code: &Code, severity: Severity) -> Option<Treatment> {
        let matching = self.rules.iter().filter_map(|(selector, treatment)| match selector {
            Selector::Codes(beginning) => {
                code.id.starts_with(beginning.as_str()).then_some((beginning.len(), *treatment))
            }
            Selector::Serious(serious) => (*serious == severity).then_some((0, *treatment)),
        });
        matching.max().map(|(_, treatment)| treatment)
    }
}

/// What an option names, which has to exist.
fn selector(option: &str, text: &str) -> Result<Selector, Box<Diagnostic>> {
    let beginning = text.trim().to_ascii_uppercase();
    match beginning.as_str() {
        "WARNINGS" => return Ok(Selector::Serious(Severity::Warning)),
        "NOTES" => return Ok(Selector::Serious(Severity::Note)),
        _ => {}
    }
    let known = all_codes();
    if !beginning.is_empty() && known.iter().any(|code| code.id.starts_with(&beginning)) {
        return Ok(Selector::Codes(beginning));
    }
    let ids = known.iter().map(|code| code.id);
    let help = match nearest(&beginning, ids.chain(["WARNINGS", "NOTES"])) {
        Some("WARNINGS") => "did you mean `warnings`?".to_owned(),
        Some("NOTES") => "did you mean `notes`?".to_owned(),
        Some(id) => format!("did you mean `{id}`? `odgen explain all` lists the codes"),
        None => "`odgen explain all` lists the codes".to_owned(),
    };
    Err(Box::new(
        Diagnostic::without_place(codes::UNKNOWN_WORD, format!("{option}: no code begins with `{text}`"))
            .help(help),
    ))
}
