//! What we write ourselves gives no rule a reason, not even for a note, except what the manuals say.

use od_spec::fix;
use od_tests::is_said_by_manuals;

use crate::format_rules::{files, said};

#[test]
fn our_own_files_are_without_a_remark() {
    for path in files("generated/eds", &["eds", "dcf"]) {
        let name = path.to_str().unwrap();
        let bytes = std::fs::read(&path).unwrap();
        let (diagnostics, _) = said(name, &bytes);
        for one in &diagnostics {
            assert!(is_said_by_manuals(one), "{name}: {one:?}");
        }
        let fixed = fix(name, &bytes).unwrap();
        assert!(fixed.changes.is_empty() && fixed.to_bytes() == bytes, "{name}: {:?}", fixed.changes);
    }
}
