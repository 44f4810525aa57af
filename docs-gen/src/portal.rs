//! The start page of several documents, with a search in all of them.

use std::collections::BTreeMap;

use od_spec::wording;
use serde::Serialize;

use crate::view::{self, Context, DeviceView, SearchWords, SystemView};

/// What the template of the start page sees.
#[derive(Debug, Clone, Serialize)]
pub struct Portal {
    /// Version of the format, as in [`Context`].
    pub format: u32,
    /// Code of the language, that of the first document.
    pub language: String,
    /// Fixed words by name, in that language.
    pub words: BTreeMap<&'static str, &'static str>,
    /// Version of odgen.
    pub version: &'static str,
    /// Phrases that a search takes for one another.
    pub synonyms: Vec<Vec<&'static str>>,
    /// The documents, in the order of their specifications.
    pub documents: Vec<Document>,
}

/// A document in its languages.
#[derive(Debug, Clone, Serialize)]
pub struct Document {
    /// Its editions; the page lists it by the first.
    pub editions: Vec<Edition>,
}

/// A document in one language.
#[derive(Debug, Clone, Serialize)]
pub struct Edition {
    /// The folder of its pages.
    pub folder: String,
    /// Code of its language.
    pub language: String,
    /// What its language calls itself.
    pub language_name: String,
    /// Its title page.
    pub system: SystemView,
    /// Its pages: that of the system, then those of the devices.
    pub pages: Vec<PageOfDocument>,
}

/// A page of a document.
#[derive(Debug, Clone, Serialize)]
pub struct PageOfDocument {
    /// Name of the file.
    pub path: String,
    /// Name of the device, or title of the system.
    pub name: String,
    /// What a search finds on it.
    pub places: Vec<PlaceOnPage>,
    /// Words by which readers look for something and which its texts do not have.
    pub search: Vec<SearchWords>,
}

/// A place that a search finds.
#[derive(Debug, Clone, Serialize)]
pub struct PlaceOnPage {
    /// Where links lead.
    pub anchor: String,
    /// Index and name of an object; number and title of a section or table.
    pub title: String,
    /// What else it is found by: names of entries, bits and values.
    pub words: String,
}

/// What a language calls itself; the code of one whose name is not known.
pub fn language_name(code: &str) -> String {
    let language = wording::Language::of(code);
    let is_known = code.split('-').next() == Some(language.code());
    if is_known { language.text("language", "name").to_owned() } else { code.to_owned() }
}

impl Edition {
    /// The edition in a folder.
    pub fn of(folder: &str, context: &Context) -> Self {
        Self {
            folder: folder.to_owned(),
            language: context.language.clone(),
            language_name: language_name(&context.language),
            system: context.system.clone(),
            pages: std::iter::once(system_page(context))
                .chain(context.devices.iter().map(device_page))
                .collect(),
        }
    }
}

impl Portal {
    /// The start page of these documents, in the language of the first, whose context this is.
    pub fn new(first: &Context, documents: Vec<Document>) -> Self {
        Self {
            format: view::FORMAT,
            language: first.language.clone(),
            words: first.words.clone(),
            version: first.version,
            synonyms: first.synonyms.clone(),
            documents,
        }
    }
}

fn system_page(context: &Context) -> PageOfDocument {
    let mut places = Vec::new();
    for section in context.chapters.iter().flat_map(|chapter| &chapter.sections) {
        places.push(place(&section.anchor, &[&section.number, &section.title.text]));
        for table in &section.tables {
            if let Some(number) = table.number {
                let word = context.words.get("table").copied().unwrap_or_default();
                places.push(place(&table.anchor, &[word, &number.to_string(), &table.title.text]));
            }
        }
    }
    places.extend(context.appendices.iter().map(|appendix| place(appendix.page, &[&appendix.title])));
    let name = context.system.title.clone();
    PageOfDocument { path: "index.html".to_owned(), name, places, search: context.search.clone() }
}

fn device_page(device: &DeviceView) -> PageOfDocument {
    let places = device.objects.iter().map(|object| PlaceOnPage {
        words: object.names.clone(),
        ..place(&object.anchor, &[&object.index, &object.name])
    });
    PageOfDocument {
        path: format!("{}.html", device.key),
        name: device.name.clone(),
        places: places.collect(),
        search: device.search.clone(),
    }
}

fn place(anchor: &str, title: &[&str]) -> PlaceOnPage {
    let parts: Vec<&str> = title.iter().copied().filter(|part| !part.is_empty()).collect();
    PlaceOnPage { anchor: anchor.to_owned(), title: parts.join(" "), words: String::new() }
}
