//! A dictionary in C as a program of the host.

use std::io::{Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::compilers::Compiler;
use super::trial::Exchange;
use crate::{Failure, root};

/// A program that answers requests to a dictionary.
#[derive(Debug)]
pub struct Host {
    program: PathBuf,
}

impl Host {
    /// Compiles the program of a device whose C lies below a directory.
    ///
    /// # Errors
    /// The compiler does not run, or has something to say.
    pub fn build(compiler: &Compiler, directory: &Path, device: &str) -> Result<Self, Failure> {
        Self::build_with(compiler, directory, device, &super::DICTIONARY)
    }

    /// The same, with other sources that answer.
    ///
    /// # Errors
    /// As [`build`](Self::build).
    pub fn build_with(
        compiler: &Compiler,
        directory: &Path,
        device: &str,
        answering: &[&str],
    ) -> Result<Self, Failure> {
        let mut objects = compiler.objects(directory, device)?;
        for source in answering.iter().chain(&["tests/c/host.c"]) {
            objects.push(compiler.object(
                &root().join(source),
                directory,
                device,
                &Compiler::about(device),
            )?);
        }
        let program = directory.join(format!("{device}-{}", compiler.program));
        compiler.link(&objects, &program)?;
        Ok(Self { program })
    }

    /// Its answers to requests.
    ///
    /// # Errors
    /// The program does not run, or ends before its last answer.
    pub fn ask(&self, exchange: &[Exchange]) -> Result<Vec<Vec<u8>>, Failure> {
        let mut child = Command::new(&self.program).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn()?;
        let (Some(mut input), Some(mut output)) = (child.stdin.take(), child.stdout.take()) else {
            return Err("the program has no input".into());
        };
        let answers = std::thread::scope(|scope| {
            let sender = scope.spawn(move || {
                for Exchange { request, .. } in exchange {
                    input.write_all(&u32::try_from(request.len()).unwrap_or(u32::MAX).to_le_bytes())?;
                    input.write_all(request)?;
                }
                input.flush()
            });
            let mut answers = Vec::with_capacity(exchange.len());
            for _ in exchange {
                let mut length = [0; 4];
                output.read_exact(&mut length)?;
                let mut answer = vec![0; usize::try_from(u32::from_le_bytes(length)).unwrap_or_default()];
                output.read_exact(&mut answer)?;
                answers.push(answer);
            }
            sender.join().map_err(|_| std::io::Error::other("nothing was sent"))??;
            Ok::<_, std::io::Error>(answers)
        })?;
        let status = child.wait()?;
        if status.success() {
            Ok(answers)
        } else {
            Err(format!("{}: {status}", self.program.display()).into())
        }
    }
}

/// Compares answers with those that were expected.
///
/// # Errors
/// The first that differs, with its request.
pub fn compare(exchange: &[Exchange], answers: &[Vec<u8>]) -> Result<(), Failure> {
    let differs = exchange.iter().zip(answers).enumerate().find(|(_, (one, answer))| one.answer != **answer);
    match differs {
        None => Ok(()),
        Some((number, (Exchange { request, answer }, found))) => Err(format!(
            "request {number}, {}{:02X?}: C answers {}, Rust {}",
            char::from(request.first().copied().unwrap_or_default()),
            request.get(1..).unwrap_or_default(),
            shown(found),
            shown(answer)
        )
        .into()),
    }
}

fn shown(answer: &[u8]) -> String {
    format!("{:02X?} ({} bytes)", answer.get(..answer.len().min(40)).unwrap_or_default(), answer.len())
}
