//! What a request is answered from.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::Arc;

use lsp_types::{Location, Position, Range, Uri};
use od_spec::model::{Dictionary, System};
use od_spec::names::{Names, SettingOf};
use od_spec::source::{FileId, Span};
use od_spec::yaml::Node;

use super::analysis::{Analysis, Described};
use super::position::{Encoding, Lines};
use super::shift::Shift;

/// What a request is answered from: the text of the document as the editor shows it, the specification that it belongs to,
/// and what was right the last time.
///
/// - [`now`](Self::now) is the analysis of the texts of now: its `sources` (root, parts, libraries), its diagnostics, the
///   syntax tree of each text ([`Analysis::tree`]), and its `system` where nothing is wrong.
/// - [`good`](Self::good) is the last analysis that gave a model; it is `now` itself where that has one. Its spans belong to
///   *its own* sources, which are those of an earlier text: [`location`](Self::location) of the right analysis turns them
///   into places, [`earlier`](Self::earlier) brings a place of the text of now there.
/// - Files and URIs: [`Analysis::uri`] gives the URI of a file of a span. Built-in libraries have the URI of a read-only copy.
#[derive(Debug, Clone)]
pub(super) struct Snapshot {
    /// The analysis of the texts of now.
    pub now: Arc<Analysis>,
    /// The last analysis that gave a model.
    pub good: Option<Arc<Analysis>>,
    /// The document that the request is about, in the sources of `now`.
    pub file: FileId,
    /// What positions are counted in.
    pub encoding: Encoding,
    /// Which of the specifications that the document names is meant.
    described: usize,
    /// What changed since in each file of `good`; two texts are compared once.
    shifts: RefCell<BTreeMap<FileId, Shift>>,
}

impl Snapshot {
    /// What a request about a document of an analysis is answered from.
    pub(super) const fn of(
        now: Arc<Analysis>,
        good: Option<Arc<Analysis>>,
        file: FileId,
        encoding: Encoding,
    ) -> Self {
        Self { now, good, file, encoding, described: 0, shifts: RefCell::new(BTreeMap::new()) }
    }

    /// The text of the document.
    pub(super) fn text(&self) -> &str {
        self.now.sources.file(self.file).text()
    }

    /// The lines of the document.
    pub(super) fn lines(&self) -> &Lines {
        self.now.lines(self.file)
    }

    /// The URI of the document.
    pub(super) fn uri(&self) -> Option<&Uri> {
        self.now.uri(self.file)
    }

    /// The syntax tree of the document, if it is YAML.
    pub(super) fn tree(&self) -> Option<&Node> {
        self.now.tree(self.file)
    }

    /// The same, about the specification that the place at a position of a parameter file or plant refers to.
    pub(super) fn about(mut self, position: Position) -> Self {
        let offset = u32::try_from(self.offset(position)).unwrap_or(u32::MAX);
        let refers = |at: &usize| self.now.names_of(*at).at(self.file, offset).is_some();
        self.described = (0..self.now.described.len()).find(refers).unwrap_or(0);
        self
    }

    /// What the specification defines, and what refers to it.
    pub(super) fn names(&self) -> &Names {
        self.now.names_of(self.described)
    }

    /// The file that describes the devices.
    pub(super) fn root(&self) -> Option<FileId> {
        self.now.described.get(self.described).map(|one| one.root).or(self.now.root)
    }

    /// The last model without errors.
    pub(super) fn system(&self) -> Option<&System> {
        let good = self.good.as_ref()?;
        let place = self.now.described.get(self.described).and_then(|one| self.now.place(one.root));
        let is_same = |one: &&Described| good.place(one.root) == place;
        let one = good.described.iter().find(is_same).or_else(|| good.described.first())?;
        one.system.as_deref()
    }

    /// The device of a setting, with the model that it is of.
    pub(super) fn device_of(&self, setting: &SettingOf<'_>) -> Option<(&System, &Dictionary)> {
        self.device_called(setting.device)
    }

    /// The device that a parameter file or plant calls so, with the model that it is of.
    pub(super) fn device_called(&self, key: &str) -> Option<(&System, &Dictionary)> {
        self.good.as_ref()?.described.iter().find_map(|one| {
            let system = one.system.as_deref()?;
            Some((system, system.device(one.devices.get(key)?)?))
        })
    }

    /// The syntax tree of the document; while it is not YAML, that of the last text that gave a model.
    pub(super) fn last_tree(&self) -> Option<Tree<'_>> {
        if let Some(root) = self.tree() {
            return Some(Tree { root, snapshot: self, shift: None });
        }
        let (good, file, _) = self.earlier(0)?;
        let shift = self.shift(good, file, self.file);
        Some(Tree { root: good.tree(file)?, snapshot: self, shift: Some(shift) })
    }

    /// The byte of the document at a position.
    pub(super) fn offset(&self, position: Position) -> usize {
        self.lines().offset(self.text(), position, self.encoding)
    }

    /// The range of a place of the document.
    pub(super) fn range(&self, span: Span) -> Range {
        self.now.range(span, self.encoding)
    }

    /// Where a span of an analysis, `now` or `good`, is. Of an earlier text, where the place is now, if nothing in it changed; of a
    /// file that is not read while the text is broken, where it was.
    pub(super) fn location(&self, analysis: &Arc<Analysis>, span: Span) -> Option<Location> {
        let is_read = |place| self.now.file(place).is_some();
        let (analysis, span) = if Arc::ptr_eq(analysis, &self.now) || !is_read(analysis.place(span.file)?) {
            (analysis, span)
        } else {
            (&self.now, self.span_now(analysis, span)?)
        };
        let uri = analysis.uri(span.file)?.clone();
        Some(Location { uri, range: analysis.range(span, self.encoding) })
    }

    /// The document in the last analysis that gave a model, and where a byte of its present text was in that one.
    pub(super) fn earlier(&self, offset: usize) -> Option<(&Arc<Analysis>, FileId, usize)> {
        let good = self.good.as_ref()?;
        let file = good.file(self.now.place(self.file)?)?;
        let shift = self.shift(good, file, self.file);
        Some((good, file, shift.earlier(offset)))
    }

    /// What changed between the text of a file of an earlier analysis and its text of now.
    fn shift(&self, earlier: &Analysis, file: FileId, now: FileId) -> Shift {
        let between = || Shift::between(earlier.sources.file(file).text(), self.now.sources.file(now).text());
        *self.shifts.borrow_mut().entry(file).or_insert_with(between)
    }

    /// Where a span of an earlier analysis is in the texts of now.
    pub(super) fn span_now(&self, earlier: &Analysis, span: Span) -> Option<Span> {
        let file = self.now.file(earlier.place(span.file)?)?;
        let shift = self.shift(earlier, span.file, file);
        let range = shift.now(span.start as usize..span.end as usize)?;
        let byte = |at| u32::try_from(at).ok();
        Some(Span { file, start: byte(range.start)?, end: byte(range.end)? })
    }
}

/// The syntax tree of a document, of now or of an earlier text.
pub(super) struct Tree<'a> {
    /// Its root; spans are those of its own text.
    pub root: &'a Node,
    snapshot: &'a Snapshot,
    /// What changed since, of an earlier text.
    shift: Option<Shift>,
}

impl Tree<'_> {
    /// Where a place of the tree is in the text of now; of what changed, what is there now.
    pub(super) fn range(&self, span: Span) -> Range {
        let Some(shift) = self.shift else { return self.snapshot.range(span) };
        let (start, end) = shift.around(span.start as usize..span.end as usize);
        let (lines, text) = (self.snapshot.lines(), self.snapshot.text());
        let position = |at| lines.position(text, at, self.snapshot.encoding);
        Range { start: position(start), end: position(end) }
    }
}
