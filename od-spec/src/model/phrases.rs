//! Words and phrases that are looked for, by language.

use std::collections::BTreeMap;

/// Words and phrases by which readers look for something that has another name.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Phrases {
    /// The phrases by the code of their language; no list is empty.
    by_language: BTreeMap<String, Vec<String>>,
}

impl Phrases {
    /// Phrases from language codes and lists.
    pub fn new(lists: impl IntoIterator<Item = (String, Vec<String>)>) -> Self {
        Self { by_language: lists.into_iter().filter(|(_, phrases)| !phrases.is_empty()).collect() }
    }

    /// Language codes and phrases, by ascending code.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &[String])> {
        self.by_language.iter().map(|(language, phrases)| (language.as_str(), phrases.as_slice()))
    }

    /// The phrases of all languages.
    pub fn all(&self) -> impl Iterator<Item = &String> {
        self.by_language.values().flatten()
    }

    /// Whether there is no phrase at all.
    pub fn is_empty(&self) -> bool {
        self.by_language.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::Phrases;

    #[test]
    fn phrases_are_in_the_order_of_their_languages() {
        let list = |language: &str, phrases: &[&str]| {
            (language.to_owned(), phrases.iter().map(|phrase| (*phrase).to_owned()).collect())
        };
        let phrases = Phrases::new([list("en", &["lamp", "light"]), list("de", &["Lampe"]), list("fr", &[])]);
        let languages: Vec<&str> = phrases.iter().map(|(language, _)| language).collect();
        assert_eq!(languages, ["de", "en"]);
        assert_eq!(phrases.all().collect::<Vec<_>>(), ["Lampe", "lamp", "light"]);
        assert!(!phrases.is_empty() && Phrases::default().is_empty());
    }
}
