//! Commands that messages recommend, so that a user can copy them.

use std::fmt::Write as _;
use std::path::Path;

use super::Target;
use super::args::OneNodeArgs;
use crate::report::shown;

/// The command that does something with a node, as a user writes it after a command with these arguments.
pub(super) fn command(name: &str, spec: &Path, target: Target<'_>, args: &OneNodeArgs) -> String {
    let mut text = format!("odgen node {name} {}", shown(spec));
    let device = (target.system.devices.len() > 1 && target.position.is_none()).then_some(&target.device.key);
    for (option, value) in
        [("--device", device), ("--site", args.site.as_ref()), ("--machine", args.machine.as_ref())]
    {
        if let Some(value) = value {
            let value = if value.contains(' ') { format!("\"{value}\"") } else { value.clone() };
            let _ = write!(text, " {option} {value}");
        }
    }
    let _ = write!(text, " --node {}", target.id);
    text
}
