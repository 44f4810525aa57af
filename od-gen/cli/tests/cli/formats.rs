//! Findings for programs: JSON, SARIF, workflow commands of GitHub.

use serde_json::Value;

use crate::{FAN, LAMP, MIXER, Scratch, code, odgen, stderr, stdout};

#[test]
fn json_has_the_edits() {
    let scratch = Scratch::new("json-edits");
    scratch.file("fan.eds", FAN);
    let output = odgen(&scratch.0, &["check", "fan.eds", "--format", "json"]);
    let said = stderr(&output);
    let messages: Vec<Value> = said.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let codes: Vec<&str> = messages.iter().map(|message| message["code"].as_str().unwrap()).collect();
    assert_eq!(codes, ["EDS406", "EDS506"]);
    assert!(messages[0].get("edits").is_none());
    assert_eq!(messages[0]["severity"], "error");
    let edit = serde_json::json!(
        [{"file": "fan.eds", "line": 148, "column": 14, "end-line": 148, "end-column": 19, "text": "0"}]
    );
    assert_eq!(messages[1]["edits"], edit);
}

#[test]
fn sarif_is_one_document_of_all_files() {
    let scratch = Scratch::new("sarif");
    std::fs::create_dir(scratch.0.join("our files")).unwrap();
    let mixer = scratch.file("our files/mixer.eds", MIXER);
    scratch.file("bad.od.yaml", LAMP.replace("access: rw", "acess: rw"));
    // Services know a file by its path in the repository, however it is named here.
    let files = [mixer.to_str().unwrap(), "bad.od.yaml", "missing.eds"];
    let output = odgen(&scratch.0, &[&["check", "--notes", "--format", "sarif"], files.as_slice()].concat());
    assert_eq!((code(&output), stderr(&output)), (1, String::new()));
    let document: Value = serde_json::from_str(&stdout(&output)).unwrap();
    let schema = serde_json::from_str(include_str!("sarif.schema.json")).unwrap();
    let validator = jsonschema::validator_for(&schema).unwrap();
    let faults: Vec<String> = validator.iter_errors(&document).map(|fault| fault.to_string()).collect();
    assert!(faults.is_empty(), "{faults:#?}");

    let run = &document["runs"][0];
    let (rules, results) =
        (run["tool"]["driver"]["rules"].as_array().unwrap(), run["results"].as_array().unwrap());
    for result in results {
        let index = usize::try_from(result["ruleIndex"].as_u64().unwrap()).unwrap();
        assert_eq!(rules[index]["id"], result["ruleId"]);
    }
    let of = |code: &str| results.iter().find(|result| result["ruleId"] == code).unwrap();
    let place = |result: &Value| result["locations"][0]["physicalLocation"].clone();
    assert_eq!(place(of("EDS406"))["artifactLocation"]["uri"], "our%20files/mixer.eds");
    // The place is where the text says it is.
    let region = &place(of("EDS406"))["region"];
    let line = MIXER.lines().position(|line| line == "AccessType=maybe").unwrap() + 1;
    let expected =
        serde_json::json!({"startLine": line, "startColumn": 12, "endLine": line, "endColumn": 17});
    assert_eq!(*region, expected);
    assert_eq!((&of("EDS406")["level"], &of("EDS503")["level"]), (&"error".into(), &"note".into()));
    assert!(of("OD0303")["relatedLocations"][0]["message"]["text"].is_string());
    let replacement = &of("EDS506")["fixes"][0]["artifactChanges"][0]["replacements"][0];
    assert_eq!(replacement["insertedContent"]["text"], "0");
    assert_eq!(replacement["deletedRegion"], place(of("EDS506"))["region"]);
    // A file that cannot be read has a place all the same: services refuse results without.
    assert_eq!(place(of("OD0101"))["artifactLocation"]["uri"], "missing.eds");
    assert_eq!(results.iter().filter(|result| result["ruleId"] == "EDS506").count(), 4, "all places");
}

#[test]
fn sarif_without_findings_is_a_document_too() {
    let scratch = Scratch::new("sarif-empty");
    scratch.file("lamp.od.yaml", LAMP);
    let output = odgen(&scratch.0, &["check", "lamp.od.yaml", "--format", "sarif"]);
    assert_eq!(code(&output), 0);
    let document: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(document["runs"][0]["results"], serde_json::json!([]));
}

#[test]
fn github_gets_a_command_for_each_finding() {
    let scratch = Scratch::new("github");
    let path = scratch.file("50%,fan.eds", FAN);
    let output = odgen(&scratch.0, &["check", path.to_str().unwrap(), "--format", "github", "--notes"]);
    assert_eq!((code(&output), stderr(&output)), (1, String::new()));
    let said = stdout(&output);
    let lines: Vec<&str> = said.lines().collect();
    assert_eq!(lines.len(), 4, "{said}");
    let lines = &lines[1..];
    assert!(lines[0].starts_with("::notice file=50%25%2Cfan.eds,line=137,col=10,title=EDS503%3A "), "{said}");
    assert!(lines[1].starts_with("::error file=50%25%2Cfan.eds,line=147,col=12,title=EDS406%3A "), "{said}");
    assert!(
        lines[1].contains("::2001h: there is no access type `internal`; it is taken as ro%0Ahelp: "),
        "{said}"
    );
    assert!(
        lines[2].starts_with("::warning file=50%25%2Cfan.eds,line=148,col=14,title=EDS506%3A "),
        "{said}"
    );
}
