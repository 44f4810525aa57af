//! Pictures of the HTML pages, read back.

use od_documents::Format;
use od_tests::documents;

/// An element of a picture with its text.
#[derive(Debug, Clone)]
pub(super) struct Element {
    pub name: String,
    attributes: Vec<(String, String)>,
    pub text: String,
}

impl Element {
    pub(super) fn get(&self, name: &str) -> &str {
        let found = self.attributes.iter().find(|(key, _)| key == name);
        found.map_or("", |(_, value)| value)
    }

    pub(super) fn number(&self, name: &str) -> i64 {
        self.get(name).parse().unwrap_or_else(|_| panic!("{name} of {self:?}"))
    }

    pub(super) fn is(&self, class: &str) -> bool {
        self.get("class").split(' ').any(|one| one == class)
    }
}

/// The elements of a picture, in order.
fn elements(svg: &str) -> Vec<Element> {
    let tags = svg.split('<').skip(1).filter(|tag| !tag.starts_with('/'));
    tags.map(|tag| {
        let (head, text) = tag.split_once('>').unwrap();
        let (name, rest) = head.split_once(' ').unwrap_or((head, ""));
        let mut attributes = Vec::new();
        let mut rest = rest.trim_end_matches('/');
        while let Some((key, behind)) = rest.split_once("=\"") {
            let (value, behind) = behind.split_once('"').unwrap();
            attributes.push((key.trim().to_owned(), unescaped(value)));
            rest = behind;
        }
        Element { name: name.to_owned(), attributes, text: unescaped(text.trim()) }
    })
    .collect()
}

fn unescaped(text: &str) -> String {
    let signs =
        [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&#x27;", "'"), ("&#x2f;", "/"), ("&amp;", "&")];
    signs.into_iter().fold(text.to_owned(), |text, (escaped, sign)| text.replace(escaped, sign))
}

/// The pictures of a kind in the pages of a specification: elements of each.
pub(super) fn pictures(spec: &str, language: &str, kind: &str) -> Vec<Vec<Element>> {
    let page = &documents::pages(spec, Format::Html, language).unwrap()["index.html"];
    let begin = format!("<svg class=\"picture {kind}\"");
    let svgs = page.split(begin.as_str()).skip(1);
    svgs.map(|svg| elements(&format!("<svg {}", svg.split("</svg>").next().unwrap()))).collect()
}
