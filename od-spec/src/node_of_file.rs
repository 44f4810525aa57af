//! The node of a DCF or XDC, with whichever node-ID a network gives it.

use std::collections::BTreeMap;

use crate::commissioning::Commissioning;
use crate::diag::{Diagnostic, Repeated, codes};
use crate::model::{DataType, Dictionary, EntryId, Fact, Value};
use crate::source::Span;
use crate::traffic::{Message, Traffic, messages, shown};

/// The node that a DCF or XDC configures. [`at`](Self::at) is the only way to its values: it moves them to the node-ID that counts.
#[derive(Debug, Clone)]
pub struct NodeOfFile {
    stated: Option<u8>,
    /// As the file states it.
    commissioning: Commissioning,
    /// Values that the node-ID formula of the default gives on the stated node: what each adds to the node-ID.
    following: BTreeMap<EntryId, u64>,
    /// The stated node, or else the only one whose COB-IDs the values are.
    origin: Option<u8>,
    /// COB-IDs that are fixed in the file, and that CiA 301 reserves for that node.
    fixed: Vec<FixedCobId>,
}

/// A COB-ID that a file gives as a number.
#[derive(Debug, Clone)]
struct FixedCobId {
    message: Message,
    entry: EntryId,
    value: Value,
    span: Span,
}

impl NodeOfFile {
    /// The node of a file: `device` has the defaults, `configured` the values in place of them.
    pub(crate) fn of_dcf(
        stated: Option<u8>,
        device: &Dictionary,
        configured: &Dictionary,
        commissioning: Commissioning,
    ) -> Self {
        let following = stated.map(|node| following(device, &commissioning, node)).unwrap_or_default();
        let origin = stated.or_else(|| only_node(device, &commissioning));
        let mut fixed = origin.map(|node| fixed(configured, node)).unwrap_or_default();
        fixed.retain(|one| !following.contains_key(&one.entry));
        Self { stated, commissioning, following, origin, fixed }
    }

    /// A node whose values are settings, which hold for any node-ID as they are.
    pub const fn of_settings(stated: Option<u8>, commissioning: Commissioning) -> Self {
        Self { stated, commissioning, following: BTreeMap::new(), origin: stated, fixed: Vec::new() }
    }

    /// The node-ID that the file states.
    pub const fn stated_id(&self) -> Option<u8> {
        self.stated
    }

    /// The node as node `id`, or with the node-ID that the file states, or else as node 1. A value that the default's node-ID
    /// formula gives on the stated node becomes the one that it gives on node `id`.
    pub fn at(&self, id: Option<u8>) -> Commissioning {
        let mut node = self.commissioning.clone();
        node.node = id.or(self.stated).unwrap_or(node.node);
        for (entry, offset) in &self.following {
            let moved = Value::NodeId(*offset).integer_for(node.node).map(Value::Integer);
            node.values.extend(moved.map(|value| (*entry, value)));
        }
        node
    }

    /// The node of a file as node `id`, or a node with the defaults of its device where there is no such file.
    pub fn or_defaults(file: Option<&Self>, device: &Dictionary, id: u8) -> Commissioning {
        file.map_or_else(|| Commissioning::of_node(device, id), |file| file.at(Some(id)))
    }

    /// Returns a warning about the COB-IDs of the file's node that a node with another node-ID still has.
    pub fn left_behind(&self, node: &Commissioning) -> Option<Diagnostic> {
        let origin = self.origin.filter(|origin| *origin != node.node)?;
        let mut found = Repeated::new();
        for FixedCobId { message, entry, value, span } in &self.fixed {
            if node.values.get(entry).is_some_and(|now| now != value) {
                continue;
            }
            found.add(*span, [], || {
                let (what, cob_id, id) = (message.traffic.words(), shown(message.id), node.node);
                let base = message.id.saturating_sub(origin.into());
                let text = format!("{entry}: node {id} uses {cob_id}, a COB-ID of node {origin}, for {what}");
                let of_node = shown(base + u32::from(id));
                let help = format!("set {of_node} for node {id}, or write `$NODEID+0x{base:X}` in the file");
                Diagnostic::new(codes::COB_ID_OF_OTHER_NODE, *span, text).help(help)
            });
        }
        found.into_diagnostic("COB-IDs")
    }
}

/// The values that the node-ID formula of the default gives on a node.
fn following(device: &Dictionary, commissioning: &Commissioning, node: u8) -> BTreeMap<EntryId, u64> {
    let of_node = by_formula(device, commissioning).filter(|by| by.node == i128::from(node));
    of_node.filter_map(|by| Some((by.entry, u64::try_from(by.raw - by.node).ok()?))).collect()
}

/// The only node on which the node-ID formulas of the defaults give the values.
fn only_node(device: &Dictionary, commissioning: &Commissioning) -> Option<u8> {
    let mut nodes = by_formula(device, commissioning)
        .filter_map(|by| u8::try_from(by.node).ok())
        .filter(|node| (1..=127).contains(node));
    let node = nodes.next()?;
    nodes.all(|other| other == node).then_some(node)
}

/// A value whose default is a formula.
struct ByFormula {
    entry: EntryId,
    raw: i128,
    /// The node on which the formula gives it.
    node: i128,
}

/// The values whose defaults are formulas; of COB-IDs, the flags do not count.
fn by_formula(device: &Dictionary, commissioning: &Commissioning) -> impl Iterator<Item = ByFormula> {
    /// The bits of a COB-ID that are not flags (CiA 301, 7.5.2).
    const IDENTIFIER: i128 = 0x1FFF_FFFF;
    commissioning.values.iter().filter_map(|(id, value)| {
        let (entry, raw) = (device.entry(*id)?, value.integer()?);
        let Some(Value::NodeId(offset)) = entry.default else { return None };
        let is_cob_id = id.index.is_communication_profile() && entry.data_type == DataType::Unsigned32;
        let counting = if is_cob_id { IDENTIFIER } else { -1 };
        Some(ByFormula { entry: *id, raw, node: (raw & counting) - (i128::from(offset) & counting) })
    })
}

/// The fixed COB-IDs of a configured node that the pre-defined connection set has for it.
fn fixed(configured: &Dictionary, node: u8) -> Vec<FixedCobId> {
    let fixed = messages(configured, node).into_iter().filter_map(|message| {
        let id =
            message.entry.filter(|_| message.traffic != Traffic::Sync && message.traffic != Traffic::Time)?;
        let entry = configured.entry(id)?;
        let value = entry.default.clone().filter(|value| value.integer().is_some())?;
        let is_reserved = message.id <= 0x7FF && message.id & 0x7F == u32::from(node);
        is_reserved.then(|| FixedCobId { message, entry: id, value, span: entry.place(Fact::Default) })
    });
    fixed.collect()
}
