//! A dictionary in C on an emulated Cortex-M.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::compilers::Compiler;
use super::trial::Exchange;
use crate::{Failure, root};

const BOARD: [&str; 9] = [
    "-machine",
    "mps2-an386",
    "-nographic",
    "-monitor",
    "none",
    "-serial",
    "none",
    "-semihosting-config",
    "enable=on,target=native",
];
/// How long it may take.
const PATIENCE: Duration = Duration::from_secs(120);

/// Compiles firmware of which some sources answer, and which asks the dictionary of a device whose C lies below a directory, and runs it; what it prints.
///
/// # Errors
/// A tool does not run, or has something to say; an answer is another one; or the firmware does not end.
pub fn emulate(
    compiler: &Compiler,
    linker: &[String],
    directory: &Path,
    device: &str,
    answering: &[&str],
    exchange: &[Exchange],
) -> Result<String, Failure> {
    let tests = root().join("tests/c");
    let data = directory.join(format!("{device}.exchange"));
    fs::write(&data, bytes(exchange))?;
    let mut objects = compiler.objects(directory, device)?;
    for source in answering.iter().chain(&["tests/c/firmware.c"]) {
        objects.push(compiler.object(&root().join(source), directory, device, &Compiler::about(device))?);
    }
    let place = format!("-DEXCHANGE=\"{}\"", data.display());
    objects.push(compiler.object(&tests.join("exchange.S"), directory, device, &[place])?);
    let program = directory.join(format!("{device}.elf"));
    link(linker, &tests.join("firmware.ld"), &objects, &program)?;
    let mut child = Command::new("qemu-system-arm")
        .args(BOARD)
        .arg("-kernel")
        .arg(&program)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()?;
    let end = Instant::now() + PATIENCE;
    while child.try_wait()?.is_none() {
        if Instant::now() > end {
            child.kill()?;
            return Err(format!("{}: did not end, an endless loop or a fault", program.display()).into());
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    let output = child.wait_with_output()?;
    let said = [output.stdout, output.stderr].concat();
    let said = String::from_utf8_lossy(&said).trim().to_owned();
    if output.status.success() {
        Ok(said)
    } else {
        Err(format!("{device}: {said} ({})", output.status).into())
    }
}

fn link(linker: &[String], script: &Path, objects: &[PathBuf], program: &Path) -> Result<(), Failure> {
    let Some((name, arguments)) = linker.split_first() else { return Err("no linker".into()) };
    let mut command = Command::new(name);
    command.args(arguments).arg("-T").arg(script).args(objects).arg("-o").arg(program);
    let output = command.output().map_err(|error| format!("{name}: {error}"))?;
    if output.status.success() {
        return Ok(());
    }
    Err(format!("{command:?}\n{}", String::from_utf8_lossy(&output.stderr)).into())
}

fn bytes(exchange: &[Exchange]) -> Vec<u8> {
    let parts = exchange.iter().flat_map(|one| [&one.request, &one.answer]);
    let with_length = parts.flat_map(|part| {
        let length = u32::try_from(part.len()).unwrap_or(u32::MAX);
        length.to_le_bytes().into_iter().chain(part.iter().copied())
    });
    with_length.collect()
}
