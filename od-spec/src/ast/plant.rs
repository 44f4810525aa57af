//! A plant as it is written: every leaf has its place.

use super::{Name, SettingDecl};
use crate::source::{Span, Spanned};

/// A plant file.
#[derive(Debug, Clone, Default)]
pub(crate) struct PlantDecl {
    pub title: Option<Name>,
    pub about: Option<Name>,
    pub devices: Vec<DeviceDecl>,
    pub types: Vec<TypeDecl>,
    pub sites: Vec<SiteDecl>,
}

/// A device: where it is described.
#[derive(Debug, Clone)]
pub(crate) struct DeviceDecl {
    pub key: Name,
    /// The file.
    pub from: Name,
    /// Its key there, where another one is stated.
    pub device: Option<Name>,
}

/// A type of machines.
#[derive(Debug, Clone)]
pub(crate) struct TypeDecl {
    pub name: Name,
    pub about: Option<Name>,
    pub bit_rate: Option<Name>,
    pub master: Option<MasterDecl>,
    pub level: LevelDecl,
}

/// The master of a bus.
#[derive(Debug, Clone, Default)]
pub(crate) struct MasterDecl {
    pub node: Option<Spanned<u8>>,
    pub sends: Vec<Spanned<u32>>,
    pub receives: Vec<Spanned<u32>>,
}

/// A site.
#[derive(Debug, Clone)]
pub(crate) struct SiteDecl {
    pub name: Name,
    pub title: Option<Name>,
    pub comment: Option<Name>,
    pub of_type: Option<Name>,
    pub machines: Vec<MachineDecl>,
    pub level: LevelDecl,
}

/// Machines that are declared together.
#[derive(Debug, Clone)]
pub(crate) struct MachineDecl {
    pub key: Spanned<MachineKey>,
    pub of_type: Option<Name>,
    pub serial: Option<Name>,
    pub comment: Option<Name>,
    pub bit_rate: Option<Name>,
    pub net_number: Option<Spanned<u32>>,
    pub net_name: Option<Name>,
    pub level: LevelDecl,
}

/// How machines are named.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum MachineKey {
    /// One, by its name.
    Name(String),
    /// By number, from the first to the last.
    Numbers {
        /// The first.
        first: u32,
        /// The last.
        last: u32,
        /// Whether it is written as a run.
        is_run: bool,
    },
}

/// What one level says: a type, a site, a machine.
#[derive(Debug, Clone, Default)]
pub(crate) struct LevelDecl {
    pub parameters: Vec<(Name, Vec<SettingDecl>)>,
    pub unlock: Vec<(Name, Vec<Name>)>,
    pub positions: Vec<PositionDecl>,
}

/// A position of a machine.
#[derive(Debug, Clone)]
pub(crate) struct PositionDecl {
    pub name: Name,
    pub nodes: Vec<NodeDecl>,
}

/// A device at a position.
#[derive(Debug, Clone)]
pub(crate) struct NodeDecl {
    pub device: Name,
    pub node: Option<Spanned<u8>>,
    pub node_name: Option<Name>,
    pub serial: Option<Spanned<u32>>,
    pub comment: Option<Name>,
    pub settings: Vec<SettingDecl>,
    pub unlock: Vec<Name>,
    pub span: Span,
}
