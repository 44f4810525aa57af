//! Plant files.

use super::lexical;
use super::parameters::{reader, settings, within, words};
use super::read::{Reader, owned};
use crate::ast::plant::{
    DeviceDecl, LevelDecl, MachineDecl, MasterDecl, NodeDecl, PlantDecl, PositionDecl, SiteDecl, TypeDecl,
};
use crate::source::Spanned;
use crate::yaml::{Node, NodeKind};

/// Reads a plant whose shape was checked.
pub(crate) fn plant(root: &Node) -> PlantDecl {
    let reader = reader(root);
    PlantDecl {
        title: reader.text("title"),
        about: words(reader, "about"),
        devices: reader.entries("devices").filter_map(|(key, r)| device(key, r)).collect(),
        types: reader.entries("types").map(|(name, r)| type_of_machines(name, r)).collect(),
        sites: reader.entries("sites").map(|(name, r)| site(name, r)).collect(),
    }
}

fn device(key: Spanned<&str>, reader: Reader<'_>) -> Option<DeviceDecl> {
    Some(DeviceDecl { key: owned(key), from: reader.short("from")?, device: reader.text("device") })
}

fn type_of_machines(name: Spanned<&str>, reader: Reader<'_>) -> TypeDecl {
    TypeDecl {
        name: owned(name),
        about: words(reader, "about"),
        bit_rate: reader.text("bit-rate"),
        master: reader.child("master").map(master),
        level: level(reader),
    }
}

fn master(reader: Reader<'_>) -> MasterDecl {
    MasterDecl {
        node: reader.integer("node").and_then(within),
        sends: reader.integers("sends").into_iter().filter_map(within).collect(),
        receives: reader.integers("receives").into_iter().filter_map(within).collect(),
    }
}

fn site(name: Spanned<&str>, reader: Reader<'_>) -> SiteDecl {
    SiteDecl {
        name: owned(name),
        title: reader.text("title"),
        comment: reader.text("comment"),
        of_type: reader.text("type"),
        machines: reader.entries("machines").filter_map(|(key, r)| machine(key, r)).collect(),
        level: level(reader),
    }
}

fn machine(key: Spanned<&str>, reader: Reader<'_>) -> Option<MachineDecl> {
    Some(MachineDecl {
        key: Spanned::new(lexical::machines(key.value)?, key.span),
        of_type: reader.text("type"),
        serial: reader.text("serial"),
        comment: reader.text("comment"),
        bit_rate: reader.text("bit-rate"),
        net_number: reader.integer("net-number").and_then(within),
        net_name: reader.text("net-name"),
        level: level(reader),
    })
}

fn level(reader: Reader<'_>) -> LevelDecl {
    LevelDecl {
        parameters: reader.entries("parameters").map(|(key, r)| (owned(key), settings(r.node))).collect(),
        unlock: reader.entries("unlock").map(|(key, r)| (owned(key), texts(r))).collect(),
        positions: reader
            .entries("positions")
            .map(|(name, r)| PositionDecl { name: owned(name), nodes: r.pairs().map(node).collect() })
            .collect(),
    }
}

fn node((device, reader): (Spanned<&str>, Reader<'_>)) -> NodeDecl {
    let short = |text: &str| crate::scalar::integer(text).ok();
    NodeDecl {
        device: owned(device),
        node: reader.scalar(short).or_else(|| reader.integer("node")).and_then(within),
        node_name: reader.text("node-name"),
        serial: reader.integer("serial").and_then(within),
        comment: reader.text("comment"),
        settings: reader.child("parameters").map(|r| settings(r.node)).unwrap_or_default(),
        unlock: reader.child("unlock").map(texts).unwrap_or_default(),
        span: device.span,
    }
}

/// The texts of a list.
fn texts(reader: Reader<'_>) -> Vec<Spanned<String>> {
    let NodeKind::List(items) = &reader.node.kind else { return Vec::new() };
    items.iter().filter_map(Node::text).map(|text| text.map(ToOwned::to_owned)).collect()
}
