//! What the columns of a table hold, which its titles say.

use crate::sheet::{Row, RowKind};
use crate::spelling::{Base, Language, plain};

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Column {
    Index,
    Sub,
    Name,
    Kind,
    Type,
    List,
    Access,
    Mapping,
    Default,
    Low,
    High,
    Range,
    Unit,
    Scale,
    Offset,
    Base,
    Symbol,
    Storage,
    Capacity,
    Special,
    Category,
    Since,
    Condition,
    Identifier,
    Warning,
    Description,
    Bit,
    Value,
    Supported,
    Register,
    Priority,
    Reaction,
    Reset,
    ErrorCode,
    Property,
    Pdo,
}

impl Column {
    /// How messages call it: its first title.
    pub(crate) fn title(self) -> &'static str {
        TITLES.iter().find(|titles| titles.column == self).map_or("", |titles| titles.shown)
    }
}

/// The titles of a column.
struct Titles {
    column: Column,
    /// As an export writes it.
    shown: &'static str,
    /// In lower case without spaces and signs.
    english: &'static [&'static str],
    german: &'static [&'static str],
}

macro_rules! titles {
    ($($column:ident $shown:literal [$($english:literal)*] [$($german:literal)*];)+) => {
        const TITLES: &[Titles] = &[$(Titles {
            column: Column::$column, shown: $shown, english: &[$($english),*], german: &[$($german),*],
        },)+];
    };
}

titles! {
    Index "Index" ["index" "idx" "objectindex" "indexhex" "indexdec" "odindex"]
        ["objektindex" "indexdez" "indexhexadezimal"];
    Sub "Sub-index" ["subindex" "sub" "subidx" "subindexhex" "subindexdec" "subhex" "si" "sidx" "subi"]
        ["unterindex" "subindexdez" "subindizes"];
    Name "Name" ["name" "objectname" "parametername" "parameter" "entry"]
        ["bezeichnung" "objektname" "benennung" "bezeichner"];
    Kind "Object" ["object" "objectcode" "objecttype" "kind" "objcode"] ["objekt" "objektcode" "objekttyp" "objektart"];
    Type "Type" ["type" "datatype" "format"] ["typ" "datentyp" "datenformat"];
    List "Type name" ["typename" "valuelist" "bitlist"] ["typname" "werteliste"];
    Access "Access" ["access" "attr" "attribute" "accesstype" "accessright" "accessrights" "accessattribute" "rw"]
        ["zugriff" "zugriffsart" "zugriffsrecht" "zugriffsrechte" "attribut" "zugriffstyp"];
    Mapping "PDO" ["pdo" "map" "mapping" "pdomapping" "pdomap" "pdomappable" "mappable"]
        ["mapbar" "pdofähig" "pdozuordnung" "pdoabbildung"];
    Default "Default" ["default" "defaultvalue" "factorysetting" "factorydefault" "initialvalue" "factoryvalue"]
        ["vorgabe" "vorgabewert" "defaultwert" "standardwert" "standard" "werkseinstellung" "grundeinstellung"];
    Low "Min" ["min" "minimum" "minvalue" "lowlimit" "lowerlimit"] ["minwert" "kleinsterwert" "minimalwert"];
    High "Max" ["max" "maximum" "maxvalue" "highlimit" "upperlimit"] ["maxwert" "größterwert" "maximalwert"];
    Range "Range" ["range" "valuerange" "limits"] ["wertebereich" "bereich" "grenzwerte"];
    Unit "Unit" ["unit" "units" "physicalunit"] ["einheit" "einheiten"];
    Scale "Scale" ["scale" "scaling" "resolution" "factor"] ["auflösung" "skalierung" "faktor"];
    Offset "Offset" ["offset"] [];
    Base "Base" ["base" "baseunit"] ["basiseinheit"];
    Symbol "Symbol" ["symbol"] [];
    Storage "Stored" ["stored" "mem" "memory" "save" "saved" "nv" "nonvolatile" "persistent"]
        ["speicherbar" "gespeichert" "speicherung"];
    Capacity "Capacity" ["capacity" "length"] ["länge"];
    Special "Special values" ["specialvalues"] ["sonderwerte"];
    Category "Category" ["category"] ["kategorie"];
    Since "Since" ["since"] ["seit" "abversion"];
    Condition "Writable when" ["writablewhen"] ["schreibbarwenn"];
    Identifier "Identifier" ["identifier"] [];
    Warning "Warning" ["warning" "danger"] ["warnung" "gefahr"];
    Description "Description" ["description" "comment" "comments" "remark" "remarks" "note" "notes" "meaning" "function"]
        ["beschreibung" "bedeutung" "kommentar" "bemerkung" "anmerkung" "hinweis" "funktion"];
    Bit "Bit" ["bit" "bits" "bitno" "bitnumber"] ["bitnr"];
    Value "Value" ["value" "val" "values"] ["wert" "werte"];
    Supported "Supported" ["supported"] ["unterstützt"];
    Register "Register" ["register"] [];
    Priority "Priority" ["priority"] ["priorität"];
    Reaction "Reaction" ["reaction"] ["reaktion"];
    Reset "Reset" ["reset"] ["quittierung"];
    ErrorCode "Error code" ["errorcode" "emcycode" "emergencycode" "errorcodes"] ["fehlercode" "fehlernummer"];
    Property "Property" ["property"] ["eigenschaft"];
    Pdo "PDO number" ["pdonumber"] ["pdonummer"];
}

/// The column of a title and the language of the title, if only one has it.
fn column(title: &str) -> Option<(Column, Option<Language>)> {
    let title = plain(title);
    TITLES.iter().find_map(|titles| {
        if titles.english.contains(&title.as_str()) {
            Some((titles.column, (!is_of_both(titles.column)).then_some(Language::English)))
        } else if titles.german.contains(&title.as_str()) {
            Some((titles.column, Some(Language::German)))
        } else {
            None
        }
    })
}

/// Whether the title is one in both languages.
fn is_of_both(column: Column) -> bool {
    matches!(
        column,
        Column::Index
            | Column::Sub
            | Column::Name
            | Column::Mapping
            | Column::Low
            | Column::High
            | Column::Bit
            | Column::Symbol
            | Column::Offset
    )
}

/// What a table is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum TableKind {
    /// Objects and their entries.
    Objects,
    /// The bits of an entry or of a type.
    Bits,
    /// The named values of an entry or of a type.
    Values,
    /// What types of bits or values are for.
    Types,
    /// Units.
    Units,
    /// Error codes.
    Errors,
    /// The device and its maker.
    Device,
    /// What PDOs carry, which the objects say, too.
    Pdos,
}

/// The title row of a table.
#[derive(Debug, Clone)]
pub(crate) struct Header {
    pub kind: TableKind,
    /// Columns by position; `None` for one whose title is unknown.
    pub columns: Vec<Option<Column>>,
    /// The languages of descriptions, by position, where titles name them: `Description (de)`.
    pub languages: Vec<Option<String>>,
    /// The language of its titles, if they are of one.
    pub language: Option<Language>,
    /// How numbers without a mark are read in the columns of indices and sub-indices.
    pub index_base: Base,
    pub sub_base: Base,
}

impl Header {
    /// Where a column is.
    pub(crate) fn position(&self, column: Column) -> Option<usize> {
        self.columns.iter().position(|one| *one == Some(column))
    }

    /// The cell of a column in a row.
    pub(crate) fn cell<'r>(&self, row: &'r Row, column: Column) -> Option<&'r crate::sheet::Cell> {
        row.cells.get(self.position(column)?).filter(|cell| !cell.text.is_empty())
    }

    fn of(columns: Vec<Option<Column>>) -> Option<Self> {
        let kind = kind(&columns)?;
        let languages = vec![None; columns.len()];
        let (index_base, sub_base) = (Base::Hexadecimal, Base::Decimal);
        Some(Self { kind, columns, languages, language: None, index_base, sub_base })
    }
}

/// What a table of these columns is about; `None` if they are not those of a table that is read.
fn kind(columns: &[Option<Column>]) -> Option<TableKind> {
    use Column as C;
    let has = |column: C| columns.contains(&Some(column));
    let is_named = has(C::Name) || has(C::Description);
    Some(match () {
        () if has(C::Pdo) => TableKind::Pdos,
        () if (has(C::Index) || has(C::Sub)) && (has(C::Name) || has(C::Type)) => TableKind::Objects,
        () if has(C::Property) && has(C::Value) => TableKind::Device,
        () if has(C::Unit) && has(C::Symbol) => TableKind::Units,
        () if has(C::List) && !has(C::Bit) && !has(C::Value) && !has(C::Index) => TableKind::Types,
        () if has(C::Bit) && is_named => TableKind::Bits,
        () if has(C::Value) && is_named && !has(C::Index) && !has(C::Sub) => TableKind::Values,
        () if has(C::ErrorCode) && is_named => TableKind::Errors,
        () => return None,
    })
}

/// The title row that a row is, if it is one.
pub(crate) fn header(row: &Row) -> Option<Header> {
    if row.kind == RowKind::Text {
        return None;
    }
    let mut columns: Vec<Option<Column>> = Vec::new();
    let mut languages = Vec::new();
    let (mut english, mut german) = (0, 0);
    for cell in &row.cells {
        let (title, language) = with_language(&cell.text);
        let found = column(title);
        // `Description (de)` may follow `Description`.
        let is_free = |column: Column| language.is_some() || !columns.contains(&Some(column));
        let found = found.filter(|(column, _)| is_free(*column));
        english += usize::from(found.is_some_and(|(_, of)| of == Some(Language::English)));
        german += usize::from(found.is_some_and(|(_, of)| of == Some(Language::German)));
        columns.push(found.map(|(column, _)| column));
        languages.push(language.map(str::to_owned));
    }
    // `Object` is VAR, ARRAY or RECORD next to a name, and else the name; `Parameter` next to a name is unknown.
    if !columns.contains(&Some(Column::Name)) {
        for (found, cell) in columns.iter_mut().zip(&row.cells) {
            if *found == Some(Column::Kind) && matches!(plain(&cell.text).as_str(), "object" | "objekt") {
                *found = Some(Column::Name);
            }
        }
    }
    // A table of objects without names has them as descriptions.
    if !columns.contains(&Some(Column::Name)) && kind(&columns) == Some(TableKind::Objects) {
        let described = columns
            .iter_mut()
            .zip(&languages)
            .find(|(column, language)| **column == Some(Column::Description) && language.is_none());
        if let Some((column, _)) = described {
            *column = Some(Column::Name);
        }
    }
    let base = |wanted: Column, otherwise: Base| {
        let at = columns.iter().position(|one| *one == Some(wanted));
        let title = at.and_then(|at| row.cells.get(at)).map(|cell| plain(&cell.text)).unwrap_or_default();
        if title.contains("hex") {
            Base::Hexadecimal
        } else if title.contains("dec") || title.contains("dez") {
            Base::Decimal
        } else {
            otherwise
        }
    };
    let (index_base, sub_base) = (base(Column::Index, Base::Hexadecimal), base(Column::Sub, Base::Decimal));
    let language = match english.cmp(&german) {
        std::cmp::Ordering::Less => Some(Language::German),
        std::cmp::Ordering::Equal => None,
        std::cmp::Ordering::Greater => Some(Language::English),
    };
    Some(Header { languages, language, index_base, sub_base, ..Header::of(columns)? })
}

/// A title, and the language code in brackets after it.
pub(crate) fn with_language(title: &str) -> (&str, Option<&str>) {
    let title = title.trim();
    let code = title.strip_suffix(')').and_then(|title| title.rsplit_once('('));
    match code {
        Some((before, code)) if code.len() == 2 && code.bytes().all(|b| b.is_ascii_lowercase()) => {
            (before.trim(), Some(code))
        }
        Some(_) | None => (title, None),
    }
}

/// How many titles the best title row has.
pub(crate) fn most_titles(rows: &[Row]) -> usize {
    let known = |row: &Row| header(row).map_or(0, |header| header.columns.iter().flatten().count());
    rows.iter().map(known).max().unwrap_or(0)
}

/// Columns that the user assigns.
#[derive(Debug, Clone)]
pub struct Assigned(pub(crate) Header);

/// Reads `Index=A, Name=C`: a title for each column, by its letter or number.
///
/// # Errors
/// The part that is not an assignment.
pub fn assigned(text: &str) -> Result<Assigned, String> {
    let mut columns: Vec<Option<Column>> = Vec::new();
    for part in text.split(',').map(str::trim).filter(|part| !part.is_empty()) {
        let (title, place) = part.split_once('=').ok_or_else(|| part.to_owned())?;
        let (Some((column, _)), Some(at)) = (column(title), position(place.trim())) else {
            return Err(part.to_owned());
        };
        if columns.len() <= at {
            columns.resize(at + 1, None);
        }
        if columns.contains(&Some(column)) || columns[at].is_some() {
            return Err(part.to_owned());
        }
        columns[at] = Some(column);
    }
    Header::of(columns)
        .filter(|header| header.kind == TableKind::Objects)
        .map(Assigned)
        .ok_or_else(|| text.to_owned())
}

/// The position of column `C`, or of column `3`.
fn position(text: &str) -> Option<usize> {
    if let Ok(number) = text.parse::<usize>() {
        return number.checked_sub(1).filter(|at| *at < 1000);
    }
    let is_letters = !text.is_empty() && text.len() <= 2 && text.bytes().all(|b| b.is_ascii_alphabetic());
    let letters = text.bytes().map(|b| usize::from(b.to_ascii_uppercase() - b'A') + 1);
    is_letters.then(|| letters.fold(0, |before, letter| before * 26 + letter) - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_assigned_by_letter_or_number() {
        let Assigned(header) = assigned("Index=A, Name=C, Zugriff=4").unwrap();
        assert_eq!(header.columns, [Some(Column::Index), None, Some(Column::Name), Some(Column::Access)]);
        for wrong in
            ["Name=A", "Index=A, Colour=B", "Index=A, Name=A", "Index=A, Index=B", "Index", "Index=0"]
        {
            assert!(assigned(wrong).is_err(), "{wrong}");
        }
        assert_eq!(position("AB"), Some(27));
    }

    #[test]
    fn every_title_is_of_one_column() {
        for titles in TITLES {
            assert_eq!(
                column(titles.shown).map(|(column, _)| column),
                Some(titles.column),
                "{}",
                titles.shown
            );
            for title in titles.english.iter().chain(titles.german) {
                assert_eq!(column(title).map(|(column, _)| column), Some(titles.column), "{title}");
            }
        }
        assert_eq!(with_language("Description (de)"), ("Description", Some("de")));
    }
}
