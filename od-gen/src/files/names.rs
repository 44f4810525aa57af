//! Names of files that every system takes, so that what is made on one machine can be made on the next.

use std::collections::BTreeMap;

use od_spec::file_name::is_device;
use od_spec::visible::is_hidden;

/// What is wrong with a path that an output asks for, in words; its parts are separated by `/`.
pub fn name_problem(path: &str) -> Option<String> {
    path.split('/').find_map(part_problem).or_else(|| {
        // A directory like `.cargo` has no ending.
        let file = path.rsplit('/').next().unwrap_or_default();
        let is_only_ending = file.starts_with('.') && !file.trim_start_matches('.').contains('.');
        is_only_ending.then(|| format!("there is nothing before the ending of `{}`", file.escape_debug()))
    })
}

/// Two of these paths that are one file on systems which do not distinguish upper and lower case.
pub fn clash<'a>(paths: impl IntoIterator<Item = &'a str>) -> Option<(&'a str, &'a str)> {
    let mut seen: BTreeMap<String, &str> = BTreeMap::new();
    paths.into_iter().find_map(|path| seen.insert(path.to_lowercase(), path).map(|first| (first, path)))
}

fn part_problem(part: &str) -> Option<String> {
    /// What Windows does not take in a name, in addition to the separators.
    const FORBIDDEN: [char; 8] = ['<', '>', ':', '"', '\\', '|', '?', '*'];
    let shown = part.escape_debug();
    if part.is_empty() {
        return Some("a part of its path has no name".to_owned());
    }
    if part == "." || part == ".." {
        return Some(format!("`{shown}` is a directory, not a file name"));
    }
    if part.contains(is_hidden) {
        return Some(format!("`{shown}` holds an invisible character"));
    }
    if let Some(c) = part.chars().find(|c| FORBIDDEN.contains(c)) {
        return Some(format!("`{shown}` holds `{c}`, which is not allowed on Windows"));
    }
    if part.ends_with(['.', ' ']) {
        return Some(format!("`{shown}` ends with a dot or a space, which Windows leaves out"));
    }
    let before_dot = part.split('.').next().unwrap_or_default().trim_end();
    is_device(before_dot).then(|| format!("Windows keeps the name `{before_dot}` for a device of its own"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_a_system_does_not_take_are_reported() {
        for wrong in [
            "",
            "..",
            "../a",
            "a//b",
            "./a",
            "/etc/a",
            "a/",
            "...json",
            ".json",
            "a/.json",
            "aux",
            "AUX.eds",
            "eds/nul.eds",
            "com1.rs",
            "LPT¹.x",
            "con .eds",
            "a.",
            "a /b",
            "a:b",
            "c:\\x",
            "a\nb",
            "a\u{202e}b",
            "a\u{2028}b",
            "a\u{9b}b",
            "what?.eds",
        ] {
            assert!(name_problem(wrong).is_some(), "{wrong:?}");
        }
        for right in [
            "a",
            "eds/pmc.eds",
            "auxiliary.eds",
            "com10.eds",
            "com.eds",
            ".hidden.json",
            ".cargo/config.toml",
            "größe ².json",
            "a..b",
        ] {
            assert_eq!(name_problem(right), None, "{right:?}");
        }
    }

    #[test]
    fn names_that_differ_by_case_only_clash() {
        assert_eq!(clash(["eds/a.eds", "eds/b.eds", "EDS/A.eds"]), Some(("eds/a.eds", "EDS/A.eds")));
        assert_eq!(clash(["ä", "Ä"]), Some(("ä", "Ä")));
        assert_eq!(clash(["a", "b"]), None);
    }
}
