//! Defaults of bit fields are reported by the names of their bits.

use super::links::{assert_has, page};
use od_documents::Format;

#[test]
fn a_default_of_bits_is_shown_by_their_names() {
    let text = page("od-spec/devices/pitch-control-system.od.yaml", Format::Markdown, "en", "pmm.md");
    assert_has(text, "Outputs that switch the heater.<br>Set by default: relay X16.1.");
    assert_has(text, "Outputs that switch the cooler. |");
    let text = page("od-spec/devices/pitch-control-system.od.yaml", Format::Markdown, "en", "pmc.md");
    assert_has(
        text,
        "A bit at 0 suppresses the fault of that bit, unless its priority is A.<br>Set by default: all bits.",
    );
}
