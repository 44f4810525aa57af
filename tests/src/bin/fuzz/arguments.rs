//! The command line of the fuzzer.

use std::path::PathBuf;
use std::time::Duration;

/// The texts of which mutants are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Texts {
    Eds,
    Xdd,
    Specifications,
    Settings,
    Templates,
}

impl Texts {
    pub(crate) const ALL: [Texts; 5] =
        [Texts::Eds, Texts::Xdd, Texts::Specifications, Texts::Settings, Texts::Templates];

    pub(crate) const fn word(self) -> &'static str {
        match self {
            Texts::Eds => "eds",
            Texts::Xdd => "xdd",
            Texts::Specifications => "specifications",
            Texts::Settings => "settings",
            Texts::Templates => "templates",
        }
    }

    /// Of all the time, so many hundredths are for these: there is more to break in some than in others.
    pub(crate) const fn share(self) -> u32 {
        match self {
            Texts::Eds => 40,
            Texts::Specifications => 30,
            Texts::Xdd | Texts::Settings | Texts::Templates => 10,
        }
    }
}

/// What is to be done.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Options {
    /// `None` for all, one after the other.
    pub(crate) texts: Option<Texts>,
    pub(crate) time: Duration,
    pub(crate) seed: u64,
    pub(crate) mutants: u64,
    pub(crate) failures: usize,
    pub(crate) paths: Vec<PathBuf>,
}

/// Reads the arguments, or says what is wrong with them.
pub(crate) fn parse(arguments: &[String]) -> Result<Options, String> {
    let mut options = Options {
        texts: None,
        time: Duration::from_secs(60),
        seed: 1,
        mutants: u64::MAX,
        failures: 1,
        paths: Vec::new(),
    };
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        if argument == "--of" {
            options.texts = Some(texts(rest.next())?);
            continue;
        }
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
    match options.texts {
        Some(Texts::Eds | Texts::Xdd | Texts::Specifications) => Ok(options),
        _ if options.paths.is_empty() => Ok(options),
        _ => Err("files go with `--of eds`, `--of xdd` or `--of specifications`".to_owned()),
    }
}

fn texts(word: Option<&String>) -> Result<Texts, String> {
    let known = Texts::ALL.into_iter().find(|texts| word.is_some_and(|word| word == texts.word()));
    known.ok_or_else(|| {
        let words = Texts::ALL.map(|texts| format!("`{}`", texts.word())).join(", ");
        format!("`--of` wants one of {words}")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(arguments: &[&str]) -> Result<Options, String> {
        parse(&arguments.iter().map(ToString::to_string).collect::<Vec<_>>())
    }

    #[test]
    fn options_and_paths_are_understood() {
        let options = parsed(&[
            "--of",
            "eds",
            "--seconds",
            "5",
            "a.eds",
            "--seed",
            "7",
            "--mutants",
            "3",
            "--failures",
            "9",
            "b",
        ]);
        let expected = Options {
            texts: Some(Texts::Eds),
            time: Duration::from_secs(5),
            seed: 7,
            mutants: 3,
            failures: 9,
            paths: vec!["a.eds".into(), "b".into()],
        };
        assert_eq!(options, Ok(expected));
        assert_eq!(parsed(&["--sed", "7"]).unwrap_err(), "`fuzz` does not take `--sed`");
        assert_eq!(parsed(&["--seed"]).unwrap_err(), "`--seed` wants a number");
        assert_eq!(
            parsed(&["a.eds"]).unwrap_err(),
            "files go with `--of eds`, `--of xdd` or `--of specifications`"
        );
        assert!(parsed(&["--of", "xml"]).unwrap_err().ends_with("`settings`, `templates`"));
        assert_eq!(Texts::ALL.map(Texts::share).iter().sum::<u32>(), 100);
        assert_eq!(parsed(&["--seed", "x"]).unwrap_err(), "`--seed` wants a number, not `x`");
    }
}
