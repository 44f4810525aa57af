//! What is said about an EDS or DCF where it is only used: how much `odgen check` finds in it, and no more. A user of
//! it can rarely change it, and it is read whatever is wrong with it.

use std::path::Path;

use od_spec::Compiled;
use od_spec::diag::Diagnostics;
use od_spec::diag::render::summary;
use od_spec::eds::codes::SETTINGS_IN_EDS;
use od_spec::file_name;
use od_spec::model::SystemSource;
use od_spec::visible::visible;

/// Takes the messages about an EDS or DCF away and gives one line for all of them, if there are any: `drive.eds: 3 errors, 14
/// warnings; …`. The messages about a specification, about what could not be read at all, and about values that an EDS has and
/// nothing takes, stay.
pub fn condense(path: &Path, compiled: &mut Compiled) -> Option<String> {
    match compiled.system.as_ref()?.source {
        SystemSource::Specification => None,
        SystemSource::Eds => {
            let is_left_out = compiled.node.is_none();
            let (mut short, mut stay) = (Diagnostics::new(), Diagnostics::new());
            for one in &std::mem::take::<Diagnostics>(&mut compiled.diagnostics) {
                let stays = is_left_out && one.code == SETTINGS_IN_EDS;
                if stays { &mut stay } else { &mut short }.push(one.clone());
            }
            compiled.diagnostics = stay;
            condensed(&file_name::shown(path), CHECK, &short)
        }
    }
}

/// The command that shows all that there is to say of a file.
pub const CHECK: &str = "odgen check";

/// One line for all messages about a file, which a command shows whole, if there are any.
pub fn condensed(path: &str, check: &str, diagnostics: &Diagnostics) -> Option<String> {
    let counts = summary(diagnostics);
    let path = visible(path);
    (!counts.is_empty()).then(|| format!("{path}: {counts}; `{check} {path}` shows them"))
}
