//! The parameters of a node as the text of a file.

use std::path::Path;

use od_bus::client::{Bus, Client, kept};
use od_import::parameters::{About, ParameterText, write_all};
use od_spec::Commissioning;
use od_spec::source::SourceMap;

use super::Target;
use super::args::NodeBackupArgs;
use super::had::{had, values};
use super::reach::SERIAL_NUMBER;
use crate::interrupt::Interrupt;
use crate::report::{Report, shown};

/// `  kept.yaml  24 values of valve (node 5)`.
pub(super) fn kept_line(file: &Path, count: usize, target: Target<'_>) -> String {
    format!("  {}  {} of {}\n", shown(file), values(count), target.name())
}

/// The parameter file of a node; what it cannot say is noted.
pub(super) fn parameters_of<B: Bus>(
    client: &mut Client<B>,
    args: &NodeBackupArgs,
    target: Target<'_>,
    sources: &SourceMap,
    interrupt: &Interrupt,
    report: &Report,
) -> Result<ParameterText, u8> {
    let had = had(client, target, kept(target.device), Some(interrupt), report)?;
    let mut node = Commissioning::of_node(target.device, target.id);
    // The adapter was not asked.
    node.bit_rate = args.node.link.bit_rate.unwrap_or(0);
    node.values = had.values;
    node.serial_number = serial_number(client, target, report)?;
    let unreported = had.unreported.iter().map(|(id, why)| format!("{}: {why}", target.words().entry(*id)));
    let about = About {
        system: target.system,
        sources,
        device: target.device,
        names_device: true,
        node_id: Some(target.id),
    };
    let written = write_all(about, node, unreported.collect());
    for (lines, what) in [(&written.left_out, "left out"), (&written.findings, "wrong")] {
        for line in lines {
            report.note(&format!("{}{what}: {line}", target.mark()));
        }
    }
    Ok(written)
}

/// The serial number by which a backup knows its node again; 0 says that there is none.
fn serial_number<B: Bus>(
    client: &mut Client<B>,
    target: Target<'_>,
    report: &Report,
) -> Result<Option<u32>, u8> {
    if target.device.entry(SERIAL_NUMBER).is_none() {
        return Ok(None);
    }
    match client.read(target.id, SERIAL_NUMBER) {
        Ok(bytes) => Ok(bytes.try_into().map(u32::from_le_bytes).ok().filter(|number| *number != 0)),
        Err(error) if error.is_of_entry() => Ok(None),
        Err(error) => Err(report.refuse(target.failed("read", SERIAL_NUMBER, &error))),
    }
}
