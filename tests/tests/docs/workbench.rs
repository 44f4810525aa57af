//! What the tools of HTML pages show that is written elsewhere, too: names in generated code, abort codes.

use std::collections::BTreeMap;

use firmware_glue::AbortCode;
use od_documents as docs;
use od_gen::{Artifact, Provenance, rust};
use od_spec::diag::Diagnostics;
use od_spec::source::SourceMap;
use od_spec::wording::Language;
use od_tests::compile_clean;

const SPECIFICATIONS: [&str; 3] =
    [super::PITCH, "od-spec/devices/fullmo-drive.od.yaml", "tests/readers/everything.od.yaml"];

fn text(artifacts: &[Artifact]) -> String {
    artifacts.iter().map(|artifact| String::from_utf8_lossy(&artifact.bytes)).collect()
}

#[test]
fn names_to_copy_are_in_generated_code() {
    for path in SPECIFICATIONS {
        let system = compile_clean(path).unwrap();
        let names = docs::options(&system, &[], None).code_names;
        for device in &system.devices {
            let names = &names[&device.key];
            let mut diagnostics = Diagnostics::new();
            let provenance = Provenance::of(&SourceMap::new());
            let c = text(&od_c::artifacts(
                &system,
                [device].into_iter(),
                &provenance,
                &od_c::Kind::Plain.into(),
                &mut diagnostics,
            ));
            let st = text(&od_st::write(&system, device, None, None).artifacts);
            let calls: BTreeMap<_, _> = rust::accessors(&system, device);
            let mut found = 0;
            for (id, _, _) in device.entries() {
                let docs::CodeNames { rust, c: in_c, structured_text } = &names[&id];
                let index = id.index.0;
                assert!(c.contains(&format!("#define {in_c} (0x{index:04X}U)")), "{path} {id}: {in_c}");
                assert!(
                    st.contains(&format!("{structured_text} : UINT := 16#{index:04X};")),
                    "{path} {id}: {structured_text}"
                );
                assert_eq!(calls.get(&id).map_or("", String::as_str), rust, "{path} {id}");
                found += 1;
            }
            assert!(found > 10, "{path}");
        }
    }
}

#[test]
fn abort_codes_are_those_of_the_firmware() {
    let of_firmware: Vec<_> =
        AbortCode::ALL.iter().map(|code| (format!("{:08X}", code.0), code.text())).collect();
    let of_pages: Vec<_> =
        Language::ENGLISH.section("abort codes").map(|(code, text)| (code.to_owned(), text)).collect();
    assert_eq!(of_pages, of_firmware);
}
