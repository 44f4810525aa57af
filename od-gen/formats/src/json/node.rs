//! The node of a DCF: its place in a network, its values, and what else belongs to it.

use std::collections::BTreeMap;

use od_spec::model::Dictionary;
use od_spec::{Commissioning, Denoted, DomainFiles};
use serde::Serialize;

use super::{device, entry_id, index};

#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) struct NodeView<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    node_id: Option<u8>,
    node_name: &'a str,
    bit_rate: u16,
    net_number: u32,
    net_name: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    serial_number: Option<u32>,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    manager: bool,
    #[serde(skip_serializing_if = "str::is_empty")]
    reference: &'a str,
    #[serde(skip_serializing_if = "str::is_empty")]
    net_reference: &'a str,
    values: Vec<ValueView>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    denotations: Vec<DenotationView<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    references: Vec<DenotationView<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    files: Vec<FilesView<'a>>,
}

#[derive(Serialize)]
struct ValueView {
    entry: String,
    value: device::ValueView,
}

#[derive(Serialize)]
struct DenotationView<'a> {
    index: String,
    /// Of an entry of an ARRAY or RECORD.
    #[serde(skip_serializing_if = "Option::is_none")]
    sub: Option<u8>,
    name: &'a str,
}

#[derive(Serialize)]
struct FilesView<'a> {
    entry: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    upload: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    download: Option<&'a str>,
}

impl<'a> NodeView<'a> {
    pub(super) fn new(device: &Dictionary, node: &'a Commissioning, node_id: Option<u8>) -> Self {
        let values = node.values.iter().filter_map(|(id, value)| {
            let entry = device.entry(*id)?;
            Some(ValueView { entry: entry_id(*id), value: device::value(id.index, entry, value) })
        });
        let texts = |texts: &'a BTreeMap<Denoted, String>| {
            let views = texts.iter().map(|(Denoted { index: at, sub }, name)| DenotationView {
                index: index(*at),
                sub: sub.map(|sub| sub.0),
                name,
            });
            views.collect()
        };
        let files = node.files.iter().map(|(id, DomainFiles { upload, download, .. })| FilesView {
            entry: entry_id(*id),
            upload: upload.as_deref(),
            download: download.as_deref(),
        });
        Self {
            node_id,
            node_name: &node.node_name,
            bit_rate: node.bit_rate,
            net_number: node.net_number,
            net_name: &node.net_name,
            serial_number: node.serial_number,
            manager: node.manager,
            reference: &node.reference,
            net_reference: &node.net_reference,
            values: values.collect(),
            denotations: texts(&node.denotations),
            references: texts(&node.references),
            files: files.collect(),
        }
    }
}
