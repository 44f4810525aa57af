//! `parse-eds FILE`: reads the file and prints how many entries it has.

use std::process::ExitCode;

use canopen_host::eds::Eds;

fn main() -> ExitCode {
    let Some(path) = std::env::args().nth(1) else {
        eprintln!("usage: parse-eds FILE");
        return ExitCode::FAILURE;
    };
    match Eds::from_file(path) {
        Ok(eds) => {
            println!("{} entries", eds.objects.len());
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
