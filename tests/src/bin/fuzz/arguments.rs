//! The command line of the fuzzer.

use std::path::PathBuf;
use std::time::Duration;

/// What is to be done.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Options {
    pub(crate) time: Duration,
    pub(crate) seed: u64,
    pub(crate) mutants: u64,
    pub(crate) failures: usize,
    pub(crate) paths: Vec<PathBuf>,
}

/// Reads the arguments, or says what is wrong with them.
pub(crate) fn parse(arguments: &[String]) -> Result<Options, String> {
    let mut options =
        Options { time: Duration::from_secs(60), seed: 1, mutants: u64::MAX, failures: 1, paths: Vec::new() };
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        let mut number = || {
            let value = rest.next().ok_or_else(|| format!("`{argument}` wants a number"))?;
            value.parse::<u64>().map_err(|_| format!("`{argument}` wants a number, not `{value}`"))
        };
        match argument.as_str() {
            "--seconds" => options.time = Duration::from_secs(number()?),
            "--seed" => options.seed = number()?,
            "--mutants" => options.mutants = number()?,
            "--failures" => options.failures = usize::try_from(number()?).unwrap_or(usize::MAX).max(1),
            option if option.starts_with('-') => return Err(format!("`fuzz` does not take `{option}`")),
            path => options.paths.push(PathBuf::from(path)),
        }
    }
    Ok(options)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(arguments: &[&str]) -> Result<Options, String> {
        parse(&arguments.iter().map(ToString::to_string).collect::<Vec<_>>())
    }

    #[test]
    fn options_and_paths_are_understood() {
        let options =
            parsed(&["--seconds", "5", "a.eds", "--seed", "7", "--mutants", "3", "--failures", "9", "b"]);
        let expected = Options {
            time: Duration::from_secs(5),
            seed: 7,
            mutants: 3,
            failures: 9,
            paths: vec!["a.eds".into(), "b".into()],
        };
        assert_eq!(options, Ok(expected));
        assert_eq!(parsed(&["--sed", "7"]).unwrap_err(), "`fuzz` does not take `--sed`");
        assert_eq!(parsed(&["--seed"]).unwrap_err(), "`--seed` wants a number");
        assert_eq!(parsed(&["--seed", "x"]).unwrap_err(), "`--seed` wants a number, not `x`");
    }
}
