//! A generated dictionary with an SDO server, for clients that others wrote: `sdo-server fullmo|pmc|pmm NODE`.
//!
//! Every line of standard input is one request of eight bytes in hexadecimal; for each, standard output has the frames that it is
//! answered with, one a line, and an empty line.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a command talks to its user")]

use std::io::BufRead as _;
use std::process::ExitCode;

use firmware_glue::Dictionary;
use od_generated::{fullmo::Fullmo, pmc::Pmc, pmm::Pmm};

#[path = "../../shared/server.rs"]
mod server;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let node = arguments.get(1).and_then(|node| node.parse().ok());
    match (arguments.first().map(String::as_str), node) {
        (Some("fullmo"), Some(node)) => serve::<{ Fullmo::LARGEST_VALUE }>(Fullmo::new(node)),
        (Some("pmc"), Some(node)) => serve::<{ Pmc::LARGEST_VALUE }>(Pmc::new(node)),
        (Some("pmm"), Some(node)) => serve::<{ Pmm::LARGEST_VALUE }>(Pmm::new(node)),
        _ => {
            eprintln!("usage: sdo-server fullmo|pmc|pmm NODE");
            return ExitCode::from(2);
        }
    }
    ExitCode::SUCCESS
}

fn serve<const BUFFER: usize>(dictionary: impl Dictionary<'static>) {
    let mut server = server::Server::<_, _, BUFFER>::new(dictionary, ());
    for line in std::io::stdin().lock().lines().map_while(Result::ok) {
        let Some(request) = parse(line.trim()) else {
            eprintln!("not eight bytes: {line}");
            continue;
        };
        let mut answer = server.answer(request);
        while let Some(bytes) = answer {
            println!("{}", bytes.map(|byte| format!("{byte:02x}")).concat());
            answer = server.next();
        }
        println!();
    }
}

fn parse(line: &str) -> Option<[u8; 8]> {
    let mut bytes = [0; 8];
    for (at, byte) in bytes.iter_mut().enumerate() {
        *byte = u8::from_str_radix(line.get(2 * at..2 * at + 2)?, 16).ok()?;
    }
    (line.len() == 16).then_some(bytes)
}
