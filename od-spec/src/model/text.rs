//! Texts for people, in several languages.

use crate::order::Arrange as _;

/// A text in the languages that the specification has.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Text {
    /// Language code and text, by ascending code. There are thousands of texts, most in one language.
    by_language: Vec<(Box<str>, Box<str>)>,
    /// What the printed manual leaves open about the same.
    gap: Option<Box<Text>>,
}

impl Text {
    /// A text from language codes and texts; of two texts in one language the first counts.
    pub fn new<'a>(texts: impl IntoIterator<Item = (&'a str, &'a str)>) -> Self {
        let mut by_language: Vec<(Box<str>, Box<str>)> =
            texts.into_iter().map(|(language, text)| (language.into(), text.into())).collect();
        by_language.arrange_by(|(one, _), (other, _)| one.cmp(other));
        by_language.dedup_by(|(later, _), (first, _)| later == first);
        Self { by_language, gap: None }
    }

    /// The texts in these languages; all, where there is none in them or no language is named.
    pub(crate) fn among<'a>(
        texts: impl Iterator<Item = (&'a str, &'a str)> + Clone,
        wanted: &[impl AsRef<str>],
    ) -> Self {
        let is_wanted = |language: &str| wanted.iter().any(|one| one.as_ref() == language);
        if texts.clone().any(|(language, _)| is_wanted(language)) {
            return Self::new(texts.filter(|(language, _)| is_wanted(language)));
        }
        Self::new(texts)
    }

    /// The text in a language, or else in any other.
    pub fn get(&self, language: &str) -> Option<&str> {
        self.iter().find(|(code, _)| *code == language).or_else(|| self.iter().next()).map(|(_, text)| text)
    }

    /// What the printed manual leaves open about what the text describes: only documents show it.
    pub fn gap(&self) -> Option<&Text> {
        self.gap.as_deref()
    }

    /// The same with what the printed manual leaves open.
    pub(crate) fn leaving_open(self, gap: Text) -> Self {
        Self { gap: (!gap.is_empty()).then(|| Box::new(gap)), ..self }
    }

    /// Language codes and texts, by ascending code.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &str)> {
        self.by_language.iter().map(|(language, text)| (&**language, &**text))
    }

    /// Whether there is no text; there may be a gap.
    pub fn is_empty(&self) -> bool {
        self.by_language.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::Text;

    #[test]
    fn any_language_is_better_than_none() {
        let text = Text::new([("en", "lamp"), ("de", "Lampe"), ("en", "light")]);
        assert_eq!(text.get("de"), Some("Lampe"));
        assert_eq!(text.get("en"), Some("lamp"));
        assert_eq!(text.get("fr"), Some("Lampe"));
        assert_eq!(Text::default().get("en"), None);
    }
}
