//! What a specification says about the parameter objects of a PDO: for the PDO itself, for all of its direction, or nothing, which
//! leaves what is usual.

use super::values;
use crate::ast::{
    PdoCommunicationDecl, PdoDecl, PdoMappingDecl, PdoParameterDecl, PdoParametersDecl, PdosDecl,
};
use crate::diag::Diagnostics;
use crate::model::{
    Access, CommunicationParameter, DataType, Direction, Index, Pdo, Storage, usual_pdo_names,
};
use crate::name_pattern::{NamePattern, Numbers};
use crate::source::{Span, Spanned};

/// What keeps the values of parameters that can be written.
#[derive(Clone, Copy)]
pub(super) struct Kept {
    /// What is said.
    pub said: Option<Spanned<Storage>>,
    /// Where nothing is said.
    pub usual: Storage,
}

/// What is said about the parameters of a PDO, the nearest first.
pub(super) struct Described<'a> {
    layers: [Option<&'a PdoParametersDecl>; 2],
    pub kept: Kept,
    /// The languages that are shown.
    pub languages: &'a [String],
    direction: Direction,
    number: u16,
}

/// What is said about one of its entries.
#[derive(Default)]
pub(super) struct Said {
    /// The name, and where it is given.
    pub name: (String, Option<Span>),
    /// The identifier, where one is given, and where.
    pub identifier: Option<Spanned<String>>,
    pub access: Option<Spanned<Access>>,
    pub default: Option<Spanned<i128>>,
    pub min: Option<Spanned<i128>>,
    pub max: Option<Spanned<i128>>,
}

impl<'a> Described<'a> {
    pub(super) fn new(all: &'a PdosDecl, decl: &'a PdoDecl, usual: Storage, languages: &'a [String]) -> Self {
        Self {
            layers: [decl.parameters.as_deref(), all.parameters(decl.direction)],
            kept: Kept { said: all.stored, usual },
            languages,
            direction: decl.direction,
            number: decl.number.value,
        }
    }

    fn communications(&self) -> impl Iterator<Item = &'a PdoCommunicationDecl> {
        self.layers.into_iter().flatten().filter_map(|layer| layer.communication.as_ref())
    }

    fn mappings(&self) -> impl Iterator<Item = &'a PdoMappingDecl> {
        self.layers.into_iter().flatten().filter_map(|layer| layer.mapping.as_ref())
    }

    /// What the communication parameter object is called.
    pub(super) fn communication_object(&self, pdo: &Pdo) -> Said {
        let index = pdo.communication_index();
        let pattern = self.communications().find_map(|layer| layer.name.as_ref());
        let name = self.fill(pattern, usual_pdo_names::communication(self.direction), index, None);
        let identifier = self.communications().find_map(|layer| layer.identifier.as_ref());
        Said { name, identifier: self.filled(identifier, index, None), ..Said::default() }
    }

    /// What the mapping parameter object is called.
    pub(super) fn mapping_object(&self, pdo: &Pdo) -> Said {
        let index = pdo.mapping_index();
        let pattern = self.mappings().find_map(|layer| layer.name.as_ref());
        let name = self.fill(pattern, usual_pdo_names::mapping(self.direction), index, None);
        let identifier = self.mappings().find_map(|layer| layer.identifier.as_ref());
        Said { name, identifier: self.filled(identifier, index, None), ..Said::default() }
    }

    /// Whether the PDO has the reserved parameter.
    pub(super) fn has_reserved(&self) -> bool {
        self.communications().any(|layer| layer.reserved.is_some())
    }

    /// What is said about a communication parameter.
    pub(super) fn communication(&self, parameter: CommunicationParameter, pdo: &Pdo) -> Said {
        let layers: Vec<&PdoParameterDecl> =
            self.communications().filter_map(|layer| of_parameter(layer, parameter)).collect();
        let pattern = layers.iter().find_map(|layer| layer.name.as_ref());
        let usual = parameter.usual_name(self.direction);
        let name = self.fill(pattern, usual, pdo.communication_index(), None);
        Said { name, ..self.said(&layers, pdo.communication_index(), None) }
    }

    /// What is said about sub-index 0 of the mapping parameter object.
    pub(super) fn mapped(&self, pdo: &Pdo) -> Said {
        let layers: Vec<&PdoParameterDecl> =
            self.mappings().filter_map(|layer| layer.sub0.as_ref()).collect();
        let pattern = layers.iter().find_map(|layer| layer.name.as_ref());
        let name = self.fill(pattern, usual_pdo_names::MAPPED, pdo.mapping_index(), None);
        Said { name, ..self.said(&layers, pdo.mapping_index(), None) }
    }

    /// What is said about a mapped entry.
    pub(super) fn entry(&self, sub: u8, pdo: &Pdo) -> Said {
        let own_name = |layer: &'a PdoMappingDecl| {
            let of_all = || layer.entry.as_ref().and_then(|entry| entry.name.as_ref());
            layer.entries.get(&sub).or_else(of_all)
        };
        let pattern = self.mappings().find_map(own_name);
        let name = self.fill(pattern, usual_pdo_names::ENTRY, pdo.mapping_index(), Some(sub));
        let layers: Vec<&PdoParameterDecl> =
            self.mappings().filter_map(|layer| layer.entry.as_ref()).collect();
        Said { name, ..self.said(&layers, pdo.mapping_index(), Some(sub)) }
    }

    /// What several layers say in addition to the name, the nearest first.
    fn said(&self, layers: &[&PdoParameterDecl], index: u16, entry: Option<u8>) -> Said {
        let identifier = layers.iter().find_map(|layer| layer.identifier.as_ref());
        Said {
            name: (String::new(), None),
            identifier: self.filled(identifier, index, entry),
            access: layers.iter().find_map(|layer| layer.access),
            default: layers.iter().find_map(|layer| layer.default),
            min: layers.iter().find_map(|layer| layer.min),
            max: layers.iter().find_map(|layer| layer.max),
        }
    }

    fn filled(
        &self,
        pattern: Option<&Spanned<NamePattern>>,
        index: u16,
        entry: Option<u8>,
    ) -> Option<Spanned<String>> {
        let numbers = Numbers { pdo: self.number, index: Index(index), entry };
        pattern.map(|pattern| Spanned::new(pattern.value.fill(numbers), pattern.span))
    }

    fn fill(
        &self,
        pattern: Option<&Spanned<NamePattern>>,
        usual: &str,
        index: u16,
        entry: Option<u8>,
    ) -> (String, Option<Span>) {
        let numbers = Numbers { pdo: self.number, index: Index(index), entry };
        match self.filled(pattern, index, entry) {
            Some(name) => (name.value, Some(name.span)),
            None => (NamePattern::parse(usual).map(|usual| usual.fill(numbers)).unwrap_or_default(), None),
        }
    }
}

const fn of_parameter(
    layer: &PdoCommunicationDecl,
    parameter: CommunicationParameter,
) -> Option<&PdoParameterDecl> {
    match parameter {
        CommunicationParameter::Count => layer.sub0.as_ref(),
        CommunicationParameter::CobId => layer.cob_id.as_ref(),
        CommunicationParameter::Transmission => layer.transmission.as_ref(),
        CommunicationParameter::InhibitTime => layer.inhibit_time.as_ref(),
        CommunicationParameter::Reserved => layer.reserved.as_ref(),
        CommunicationParameter::EventTimer => layer.event_timer.as_ref(),
        CommunicationParameter::SyncStart => layer.sync_start.as_ref(),
    }
}

/// Reports limits that no value of their parameter can have.
pub(super) fn check_limits(described: &PdoParametersDecl, diagnostics: &mut Diagnostics) {
    let communication = described.communication.iter().flat_map(|layer| {
        CommunicationParameter::ALL.into_iter().map(|one| (one.data_type(), of_parameter(layer, one)))
    });
    let mapping = described.mapping.iter().flat_map(|layer| {
        [(DataType::Unsigned8, layer.sub0.as_ref()), (DataType::Unsigned32, layer.entry.as_ref())]
    });
    for (data_type, said) in communication.chain(mapping) {
        let limits = said.into_iter().flat_map(|said| [said.min, said.max]).flatten();
        for limit in limits {
            let fits = values::fits(limit.value, limit.span, data_type, limit.value);
            fits.unwrap_or_else(|diagnostic| diagnostics.push(*diagnostic));
        }
    }
}
