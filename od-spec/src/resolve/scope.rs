//! Units and named types of a specification and its libraries.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::types;
use crate::ast::{Name, Spec, UnitDecl};
use crate::check::codes as rule_codes;
use crate::diag::shorten;
use crate::diag::{Code, Diagnostic, Diagnostics, codes};
use crate::model::{Base, NamedType, Ratio, Statement, Unit};
use crate::source::{FileId, Span};

/// What names mean.
pub(super) struct Scope {
    pub units: BTreeMap<String, Arc<Unit>>,
    pub types: BTreeMap<String, Arc<NamedType>>,
    /// The first unit of each symbol, by name.
    symbols: BTreeMap<String, Arc<Unit>>,
    /// Declared names whose declaration was broken: a use of them says nothing new.
    broken: BTreeSet<String>,
}

impl Scope {
    pub(super) fn new(root: &Spec, libraries: &[Arc<Spec>], diagnostics: &mut Diagnostics) -> Self {
        let mut scope = Self {
            units: BTreeMap::new(),
            types: BTreeMap::new(),
            broken: BTreeSet::new(),
            symbols: BTreeMap::new(),
        };
        let mut places: BTreeMap<String, Span> = BTreeMap::new();
        for spec in libraries.iter().map(Arc::as_ref).chain([root]) {
            for decl in &spec.units {
                match unit(decl, root.file) {
                    Some(unit) => {
                        let unit = Arc::new(unit);
                        let before = scope.units.insert(decl.name.value.clone(), Arc::clone(&unit));
                        let same = before.is_none_or(|before| {
                            Unit { about: unit.about.clone(), stated: unit.stated, ..(*before).clone() }
                                == *unit
                        });
                        check_unique(&decl.name, "unit", same, &mut places, diagnostics);
                    }
                    None => drop(scope.broken.insert(decl.name.value.clone())),
                }
            }
        }
        for unit in scope.units.values() {
            scope.symbols.entry(unit.symbol.clone()).or_insert_with(|| Arc::clone(unit));
        }
        places.clear();
        for spec in libraries.iter().map(Arc::as_ref).chain([root]) {
            for decl in &spec.types {
                match types::resolve(decl, root.file, diagnostics) {
                    Some(named) => {
                        let before = scope.types.insert(decl.name.value.clone(), Arc::new(named));
                        check_unique(&decl.name, "type", before.is_none(), &mut places, diagnostics);
                    }
                    None => drop(scope.broken.insert(decl.name.value.clone())),
                }
            }
        }
        scope
    }

    /// Whether a name was declared, but not well enough to be used.
    pub(super) fn is_broken(&self, name: &str) -> bool {
        self.broken.contains(name)
    }

    pub(super) fn unit(&self, name: &Name, diagnostics: &mut Diagnostics) -> Option<Arc<Unit>> {
        let unit = self.units.get(&name.value);
        if unit.is_none() && !self.is_broken(&name.value) {
            let known = self.units.keys().map(String::as_str);
            let otherwise = |diagnostic: Diagnostic| match self.symbols.get(&name.value) {
                Some(unit) => diagnostic
                    .help(format!("that is the symbol of `{}`; write the unit's name", unit.name))
                    .meant(&unit.name),
                None => diagnostic.help("define it under `units:`"),
            };
            unknown_or(codes::UNKNOWN_UNIT, name, "unit", known, otherwise, diagnostics);
        }
        unit.cloned()
    }
}

/// Reports a name that means nothing, once where it is written.
pub(super) fn unknown<'a>(
    code: &'static Code,
    name: &Name,
    what: &str,
    known: impl IntoIterator<Item = &'a str>,
    otherwise: &str,
    diagnostics: &mut Diagnostics,
) {
    unknown_or(code, name, what, known, |diagnostic| diagnostic.help(otherwise), diagnostics);
}

/// [`unknown`], with more to say where no known name is near.
pub(super) fn unknown_or<'a>(
    code: &'static Code,
    name: &Name,
    what: &str,
    known: impl IntoIterator<Item = &'a str>,
    otherwise: impl FnOnce(Diagnostic) -> Diagnostic,
    diagnostics: &mut Diagnostics,
) {
    if !diagnostics.is_new(code, name.span) {
        return;
    }
    let diagnostic =
        Diagnostic::new(code, name.span, format!("there is no {what} `{}`", shorten(&name.value)));
    let meant = diagnostics.suggestions.nearest(&name.value, known);
    diagnostics.push(match meant {
        Some(word) => diagnostic.did_you_mean(word),
        None => otherwise(diagnostic),
    });
}

fn check_unique(
    name: &Name,
    what: &str,
    is_repeated: bool,
    places: &mut BTreeMap<String, Span>,
    diagnostics: &mut Diagnostics,
) {
    let before = places.insert(name.value.clone(), name.span);
    if let (false, Some(before)) = (is_repeated, before) {
        diagnostics.push(
            Diagnostic::new(
                rule_codes::DUPLICATE_NAME,
                name.span,
                format!("{what} `{}` has two meanings", shorten(&name.value)),
            )
            .label("defined otherwise here")
            .with(before, "first here")
            .help("give one of the two another name"),
        );
    }
}

fn unit(decl: &UnitDecl, maker: FileId) -> Option<Unit> {
    Some(Unit {
        name: decl.name.value.clone(),
        symbol: decl.symbol.as_ref()?.value.clone(),
        scale: decl.scale.as_ref().map_or(Ratio::ONE, |scale| scale.value),
        offset: decl.offset.as_ref().map_or(Ratio::ZERO, |offset| offset.value.0),
        base: decl
            .base
            .as_ref()
            .map(|base| Base { symbol: base.value.symbol.clone(), factor: base.value.factor }),
        formula: decl.formula.as_ref().map(|formula| formula.value.0.clone()),
        about: decl.about.as_ref().map(|about| about.value.clone()).unwrap_or_default(),
        stated: Statement::written(decl.name.span, maker),
    })
}
