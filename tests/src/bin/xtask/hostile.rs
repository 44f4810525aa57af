//! Documents whose texts try to command the browser, each next to the same one with plain texts.

use od_documents::{self as docs, Format, Templates};
use od_formats::json;
use od_gen::Artifact;
use od_gen::files::{Existing, write_set};
use od_spec::model::System;
use od_tests::plant::{TEXTS, accepted, compiled, planted, sites, text_at};
use od_tests::{Failure, root};

use crate::parts::Amount;

/// What is in every place that takes it, with the number of the place; `__hostile` is what the browser looks for.
const PAYLOADS: [(&str, &str); 3] = [
    (
        "elements",
        "</title></style></script><script>window.__hostile=1</script><img src=x onerror=window.__hostile=2><svg onload=alert(1)>",
    ),
    (
        "attributes",
        r#""onmouseover="window.__hostile=3" 'onfocus='window.__hostile=4' autofocus [l](javascript:alert(2)) javascript:window.__hostile=5 &quot; &lt;"#,
    ),
    ("templates", "{{ 7*7 }} {% include '_script.js' %} {# x #} ${window.__hostile=6} \\u003cscript>"),
];
/// Fewer places than this do not show much.
const LEAST: usize = 50;
/// Texts that no page of an English document shows, each with the reason.
const NOT_SHOWN: [(&str, &str); 12] = [
    ("Geschichte", "of another language"),
    ("Allowed text", "of a check, which states it"),
    ("Reason text", "of a check, which states it"),
    ("Receive inhibit", "of an entry that no PDO of the device has"),
    ("Receive timer", "of an entry that no PDO of the device has"),
    ("Receive start", "of an entry that no PDO of the device has"),
    ("Subtitle text", "of the cover of the printed manual"),
    ("Address text", "of the cover of the printed manual"),
    ("Section words", "by which the search finds something"),
    ("Value words", "by which the search finds something"),
    ("Bit words", "by which the search finds something"),
    ("Error words", "by which the search finds something"),
];

/// The directories with the documents, below a directory of the workspace.
pub(crate) fn documents(below: &str, amount: Amount) -> Result<Vec<String>, Failure> {
    let sites = sites(TEXTS);
    let mut directories = Vec::new();
    let payloads = match amount {
        Amount::Sample => &PAYLOADS[..1],
        Amount::All => &PAYLOADS[..],
    };
    for &(name, payload) in payloads {
        let hostile = accepted(TEXTS, &sites, payload, &mut |_, _| ())
            .filter(|accepted| accepted.chosen.len() >= LEAST)
            .ok_or_else(|| format!("too few places take the texts of `{name}`"))?;
        // Plain texts with as many parts: these make a section one of a section.
        let plain = format!("plain{}", ".n".repeat(payload.matches('.').count()));
        let (_, clean) = compiled(&planted(TEXTS, &sites, &hostile.chosen, &plain).0);
        let texts: Vec<serde_json::Value> = hostile
            .chosen
            .iter()
            .map(|at| {
                let original = &sites[*at].text;
                serde_json::json!({
                    "original": original,
                    "plain": text_at(&sites, *at, &plain),
                    "hostile": text_at(&sites, *at, payload),
                    "shown": !NOT_SHOWN.iter().any(|(text, _)| text == original),
                })
            })
            .collect();
        let directory = format!("{below}/hostile-{name}");
        let mut set = vec![Artifact {
            path: "hostile.json".to_owned(),
            bytes: serde_json::to_vec_pretty(&texts)?,
            purpose: String::new(),
        }];
        for (folder, system) in [("hostile", hostile.compiled.system), ("plain", clean.system)] {
            set.extend(pages(folder, &system.ok_or_else(|| format!("`{name}`: refused with plain texts"))?)?);
        }
        write_set(&root().join(&directory), &set, Existing::Any)?;
        directories.push(directory);
    }
    Ok(directories)
}

fn pages(folder: &str, system: &System) -> Result<Vec<Artifact>, Failure> {
    let options = docs::options(system, &[], None);
    let mut pages =
        docs::artifacts(system, "", folder, &options, &[Templates::new(Some(Format::Html), &[])?])?;
    let bytes = json::dump(system, &[]);
    pages.push(Artifact { path: format!("{folder}/dump.json"), bytes, purpose: String::new() });
    Ok(pages)
}
