//! Block diagrams: whether each block takes from earlier ones, and their entries are those of a device.

use super::figures::{Figures, Named};
use super::types::words;
use crate::ast::{BlockDecl, InflowDecl};
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::limits::{ARROWS, BLOCKS};
use crate::model::{Block, Flow, Inflow};
use crate::source::Spanned;

impl Figures<'_, '_> {
    /// The blocks, if all of them fit.
    pub(super) fn flow(&self, decls: &[Spanned<BlockDecl>], diagnostics: &mut Diagnostics) -> Option<Flow> {
        if is_too_large(decls, diagnostics) {
            return None;
        }
        let names = Named::of("block", decls.iter().map(|decl| decl.value.name.as_ref()), diagnostics)?;
        let blocks: Vec<Option<Block>> = decls
            .iter()
            .enumerate()
            .map(|(at, decl)| self.block(at, &decl.value, &names, diagnostics))
            .collect();
        let flow = Flow { blocks: blocks.into_iter().collect::<Option<_>>()? };
        let entries = decls.iter().flat_map(|decl| &decl.value.entries);
        let is_of_one_device = self.have_a_device(flow.entries().zip(entries), diagnostics);
        let is_sure = !decls.iter().any(|decl| decl.value.unsure);
        (is_sure && are_connected(&flow, &names, diagnostics) && is_of_one_device).then_some(flow)
    }

    fn block(
        &self,
        at: usize,
        decl: &BlockDecl,
        names: &Named<'_>,
        diagnostics: &mut Diagnostics,
    ) -> Option<Block> {
        let BlockDecl { name, entries, named_type, bit, does, from, unsure: _ } = decl;
        let entries = self.entries(entries, diagnostics);
        let bits = match (named_type, bit) {
            (Some(named_type), Some(bit)) => self.named_bits(named_type, bit, diagnostics).map(Some),
            (None, None) => Some(None),
            // Reported by the keys of a block.
            (Some(_), None) | (None, Some(_)) => None,
        };
        let inflows: Vec<Option<Inflow>> =
            from.iter().map(|inflow| earlier(at, &inflow.value, names, diagnostics)).collect();
        let inflows: Vec<Inflow> = inflows.into_iter().collect::<Option<_>>()?;
        for (position, inflow) in inflows.iter().enumerate() {
            if inflows[..position].iter().any(|before| before.block == inflow.block) {
                let message = format!("the block takes twice from `{}`", names.shown(inflow.block));
                diagnostics.push(
                    Diagnostic::new(codes::LOOSE_PART, from[position].span, message)
                        .help("say at one arrow all that comes from there"),
                );
                return None;
            }
        }
        Some(Block { name: words(name), entries: entries?, bits: bits?, does: words(does), from: inflows })
    }
}

fn is_too_large(decls: &[Spanned<BlockDecl>], diagnostics: &mut Diagnostics) -> bool {
    let mut arrows = decls.iter().flat_map(|decl| &decl.value.from);
    let (beyond, what) = match (decls.get(BLOCKS), arrows.nth(ARROWS)) {
        (Some(block), _) => (block.span, format!("more than {BLOCKS} blocks")),
        (None, Some(arrow)) => (arrow.span, format!("more than {ARROWS} arrows")),
        (None, None) => return false,
    };
    diagnostics.push(
        Diagnostic::new(codes::TOO_MUCH, beyond.part(0, 1), format!("a diagram with {what}"))
            .help("describe several diagrams, one after the other"),
    );
    true
}

/// The earlier block that an arrow comes from.
fn earlier(at: usize, decl: &InflowDecl, names: &Named<'_>, diagnostics: &mut Diagnostics) -> Option<Inflow> {
    let name = decl.block.as_ref()?;
    let block = names.find(name, diagnostics)?;
    if block >= at {
        let which = if block == at {
            "itself".to_owned()
        } else {
            format!("the later block `{}`", shorten(&name.value))
        };
        diagnostics.push(
            Diagnostic::new(codes::LOOSE_PART, name.span, format!("a block cannot take from {which}"))
                .help("name an earlier block, or put the blocks in the order of the signals"),
        );
        return None;
    }
    Some(Inflow { block, carries: words(&decl.carries) })
}

/// Whether every block gives something or takes something.
fn are_connected(flow: &Flow, names: &Named<'_>, diagnostics: &mut Diagnostics) -> bool {
    let gives = |at: usize| flow.blocks.iter().flat_map(|block| &block.from).any(|inflow| inflow.block == at);
    let loose: Vec<usize> =
        (0..flow.blocks.len()).filter(|at| flow.blocks[*at].from.is_empty() && !gives(*at)).collect();
    for at in &loose {
        let message = format!("nothing leads to the block `{}`, and nothing from it", names.shown(*at));
        diagnostics.push(
            Diagnostic::new(codes::LOOSE_PART, names.place(*at), message)
                .help("say in `from:` what it takes, or name it in the `from:` of another block"),
        );
    }
    loose.is_empty()
}
