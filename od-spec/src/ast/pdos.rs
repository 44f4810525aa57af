//! PDOs as written.

use std::collections::BTreeMap;

use super::{Name, Words, declaration};
use crate::keys::{pdo_communication_keys, pdo_keys, pdo_mapping_keys, pdo_parameters_keys};
use crate::model::{Access, Direction, Storage};
use crate::name_pattern::NamePattern;
use crate::source::{Span, Spanned};

/// `pdos:` of a device.
#[derive(Debug, Default)]
pub(crate) struct PdosDecl {
    pub stored: Option<Spanned<Storage>>,
    /// Boxed: it is large, and most devices have none.
    pub receive: Option<Box<PdoParametersDecl>>,
    pub transmit: Option<Box<PdoParametersDecl>>,
    pub list: Vec<PdoDecl>,
}

impl PdosDecl {
    /// What is said about the parameters of all PDOs of a direction.
    pub(crate) fn parameters(&self, direction: Direction) -> Option<&PdoParametersDecl> {
        match direction {
            Direction::Receive => self.receive.as_deref(),
            Direction::Transmit => self.transmit.as_deref(),
        }
    }
}

pdo_parameters_keys! { declaration
    #[derive(Debug, Default)]
    PdoParametersDecl {}
}

pdo_communication_keys! { declaration
    #[derive(Debug, Default)]
    PdoCommunicationDecl {}
}

pdo_mapping_keys! { declaration
    #[derive(Debug, Default)]
    PdoMappingDecl {}
}

/// What is said about one entry of parameter objects.
#[derive(Debug)]
pub(crate) struct PdoParameterDecl {
    pub name: Option<Spanned<NamePattern>>,
    pub identifier: Option<Spanned<NamePattern>>,
    pub access: Option<Spanned<Access>>,
    pub default: Option<Spanned<i128>>,
    pub min: Option<Spanned<i128>>,
    pub max: Option<Spanned<i128>>,
}

pdo_keys! { declaration
    #[derive(Debug)]
    PdoDecl {
        direction: Direction,
        number: Spanned<u16>,
        span: Span,
    }
}

impl PdoDecl {
    /// Whether the mapping cannot be changed over the bus.
    pub(crate) fn is_fixed(&self) -> bool {
        self.mapping.is_some_and(|mapping| mapping.value == MappingKind::Fixed)
    }
}

/// Whether the mapping of a PDO can be changed over the bus.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum MappingKind {
    Variable,
    Fixed,
}

impl MappingKind {
    pub(crate) fn from_word(word: &str) -> Option<Self> {
        match word {
            "variable" => Some(MappingKind::Variable),
            "fixed" => Some(MappingKind::Fixed),
            _ => None,
        }
    }
}
