//! SDO: requests and answers, and the values that go over in several frames.

use firmware_glue::AbortCode;
use od_spec::model::{EntryId, Index, SubIndex};

use super::node::{Node, SdoSide, count, hexadecimal};
use super::transfer::{Block, Last, Phase, Transfer};

/// One frame of an SDO channel, in words.
pub(super) fn frame(node: &mut Node<'_>, channel: u16, side: SdoSide, bytes: &[u8]) -> String {
    let Ok(bytes) = <[u8; 8]>::try_from(bytes) else {
        return format!("{} where an SDO has 8", count(bytes.len()));
    };
    let mut transfer = node.transfers.remove(&channel).unwrap_or_default();
    let text = match side {
        _ if bytes[0] == 0x80 => abort(node, &mut transfer, bytes),
        SdoSide::Client => request(node, &mut transfer, bytes),
        SdoSide::Server => answer(node, &mut transfer, bytes),
    };
    node.transfers.insert(channel, transfer);
    text
}

fn id_of(bytes: [u8; 8]) -> EntryId {
    EntryId { index: Index(u16::from_le_bytes([bytes[1], bytes[2]])), sub: SubIndex(bytes[3]) }
}

fn number(bytes: [u8; 8]) -> u32 {
    u32::from_le_bytes([bytes[4], bytes[5], bytes[6], bytes[7]])
}

fn abort(node: &Node<'_>, transfer: &mut Transfer, bytes: [u8; 8]) -> String {
    *transfer = Transfer::default();
    format!("abort {}: {}", node.entry(id_of(bytes)), AbortCode(number(bytes)))
}

/// The bytes of an expedited transfer; where their number is not stated, as many as the type of the entry has.
fn expedited<'b>(node: &Node<'_>, bytes: &'b [u8; 8]) -> &'b [u8] {
    let described = 4 - usize::from(bytes[0] >> 2 & 3);
    let of_type = || {
        let bits = node.device.entry(id_of(*bytes))?.data_type.bits()?;
        Some(usize::from(bits.div_ceil(8)).min(4))
    };
    let count = if bytes[0] & 1 == 1 { described } else { of_type().unwrap_or(4) };
    &bytes[4..4 + count]
}

/// `12 bytes`, where it is stated.
fn size(bytes: [u8; 8], is_told: bool) -> String {
    if is_told {
        format!(", {}", count(usize::try_from(number(bytes)).unwrap_or(usize::MAX)))
    } else {
        String::new()
    }
}

/// The bytes of a segment of a normal transfer.
fn segment(bytes: &[u8; 8]) -> &[u8] {
    &bytes[1..8 - usize::from(bytes[0] >> 1 & 7)]
}

fn request(node: &mut Node<'_>, transfer: &mut Transfer, bytes: [u8; 8]) -> String {
    if let Phase::BlockDownload(Block::Segments { .. }) = &transfer.phase {
        return block_segment(transfer, bytes);
    }
    let (id, entry) = (id_of(bytes), node.entry(id_of(bytes)));
    let begin = |transfer: &mut Transfer, phase| {
        *transfer = Transfer { id: Some(id), data: Vec::new(), phase };
    };
    match bytes[0] >> 5 {
        1 if bytes[0] & 2 == 2 => {
            begin(transfer, Phase::Expedited);
            transfer.data = expedited(node, &bytes).to_vec();
            format!("write {entry} = {}", written(node, id, &transfer.data))
        }
        1 => {
            begin(transfer, Phase::Download(Last::No));
            format!("write {entry} in segments{}", size(bytes, bytes[0] & 1 == 1))
        }
        0 => {
            let is_last = bytes[0] & 1 == 1;
            transfer.data.extend(segment(&bytes));
            if let Phase::Download(last) = &mut transfer.phase
                && is_last
            {
                *last = Last::Yes;
            }
            let text = format!("segment {}", hexadecimal(segment(&bytes)));
            if is_last { format!("{text}, the last: {}", whole(node, transfer)) } else { text }
        }
        2 => {
            begin(transfer, Phase::Upload);
            format!("read {entry}")
        }
        3 => "next segment".to_owned(),
        5 => match bytes[0] & 3 {
            0 => {
                begin(transfer, Phase::BlockUpload(Block::End));
                transfer.phase = Phase::BlockUpload(Block::Segments { size: bytes[4], open: Vec::new() });
                format!("read {entry} in blocks of {} segments", bytes[4])
            }
            1 => {
                let text = "end of the blocks confirmed".to_owned();
                *transfer = Transfer::default();
                text
            }
            2 => confirm(transfer, bytes),
            _ => "start of the blocks".to_owned(),
        },
        6 if bytes[0] & 1 == 0 => {
            begin(transfer, Phase::BlockDownload(Block::End));
            format!("write {entry} in blocks{}", size(bytes, bytes[0] & 2 == 2))
        }
        6 => block_end(node, transfer, bytes),
        _ => format!("unknown command {:02X}h", bytes[0]),
    }
}

fn answer(node: &mut Node<'_>, transfer: &mut Transfer, bytes: [u8; 8]) -> String {
    if let Phase::BlockUpload(Block::Segments { .. }) = &transfer.phase
        && (bytes[0] >> 5 != 6 || id_of(bytes) != transfer.id.unwrap_or_else(|| id_of(bytes)))
    {
        return block_segment(transfer, bytes);
    }
    let (id, entry) = (id_of(bytes), node.entry(id_of(bytes)));
    match bytes[0] >> 5 {
        3 => {
            if transfer.phase == Phase::Expedited && transfer.id == Some(id) {
                node.accept(id.index.0, id.sub.0, &transfer.data);
                *transfer = Transfer::default();
            }
            format!("{entry} written")
        }
        1 => {
            if transfer.phase == Phase::Download(Last::Yes) {
                if let Some(id) = transfer.id {
                    node.accept(id.index.0, id.sub.0, &transfer.data);
                }
                *transfer = Transfer::default();
                return "last segment taken".to_owned();
            }
            "segment taken".to_owned()
        }
        2 if bytes[0] & 2 == 2 => {
            *transfer = Transfer::default();
            format!("{entry} = {}", node.value(id, expedited(node, &bytes)))
        }
        2 => {
            *transfer = Transfer { id: Some(id), data: Vec::new(), phase: Phase::Upload };
            format!("{entry} comes in segments{}", size(bytes, bytes[0] & 1 == 1))
        }
        0 => {
            transfer.data.extend(segment(&bytes));
            let text = format!("segment {}", hexadecimal(segment(&bytes)));
            if bytes[0] & 1 == 0 {
                return text;
            }
            let text = format!("{text}, the last: {}", whole(node, transfer));
            *transfer = Transfer::default();
            text
        }
        5 => match bytes[0] & 3 {
            0 => {
                transfer.phase = Phase::BlockDownload(Block::Segments { size: bytes[4], open: Vec::new() });
                format!("{entry} comes in blocks of {} segments", bytes[4])
            }
            1 => {
                if let Some(id) = transfer.id {
                    node.accept(id.index.0, id.sub.0, &transfer.data);
                }
                *transfer = Transfer::default();
                "end of the blocks confirmed".to_owned()
            }
            _ => confirm(transfer, bytes),
        },
        6 if bytes[0] & 1 == 0 => format!("{entry} comes in blocks{}", size(bytes, bytes[0] & 2 == 2)),
        6 => block_end(node, transfer, bytes),
        _ => format!("unknown command {:02X}h", bytes[0]),
    }
}

/// A value that a client writes. What is written to 1010h and 1011h is a command.
fn written(node: &Node<'_>, id: EntryId, bytes: &[u8]) -> String {
    match (id.index.0, bytes) {
        (0x1010, b"save") | (0x1011, b"load") => format!("\"{}\"", String::from_utf8_lossy(bytes)),
        _ => node.value(id, bytes),
    }
}

/// What came in segments, as a value.
fn whole(node: &Node<'_>, transfer: &Transfer) -> String {
    match (&transfer.phase, transfer.id) {
        (Phase::Idle, _) | (_, None) => "of a transfer that began before".to_owned(),
        (_, Some(id)) => format!("{} = {}", node.entry(id), node.value(id, &transfer.data)),
    }
}

/// A segment of a block: its number, and seven bytes.
fn block_segment(transfer: &mut Transfer, bytes: [u8; 8]) -> String {
    let (Phase::BlockDownload(block) | Phase::BlockUpload(block)) = &mut transfer.phase else {
        return String::new();
    };
    let Block::Segments { size, open } = block else { return String::new() };
    let number = bytes[0] & 0x7F;
    let is_last = bytes[0] & 0x80 != 0;
    // One that does not follow the one before is not taken; the other side will ask for it again.
    if usize::from(number) == open.len() + 1 {
        let [_, data @ ..] = bytes;
        open.push(data);
    }
    if is_last || number >= *size {
        let last = if is_last { Last::Yes } else { Last::No };
        *block = Block::Confirm { open: std::mem::take(open), last };
    }
    let last = if is_last { ", the last" } else { "" };
    format!("segment {number} of a block: {}{last}", hexadecimal(&bytes[1..]))
}

/// The other side has so many segments of the block.
fn confirm(transfer: &mut Transfer, bytes: [u8; 8]) -> String {
    let (taken, next) = (usize::from(bytes[1]), bytes[2]);
    let segments = if taken == 1 { "1 segment" } else { &format!("{taken} segments") };
    let text = format!("{segments} of the block taken, the next has {next}");
    let (Phase::BlockDownload(block) | Phase::BlockUpload(block)) = &mut transfer.phase else { return text };
    let (Block::Segments { open, .. } | Block::Confirm { open, .. }) = &mut *block else { return text };
    transfer.data.extend(open.iter().take(taken).flatten());
    let is_whole = taken >= open.len();
    *block = match block {
        Block::Confirm { last: Last::Yes, .. } if is_whole => Block::End,
        _ => Block::Segments { size: next, open: Vec::new() },
    };
    text
}

/// No more blocks; so many bytes of the last segment are not used.
fn block_end(node: &Node<'_>, transfer: &mut Transfer, bytes: [u8; 8]) -> String {
    let unused = usize::from(bytes[0] >> 2 & 7);
    transfer.data.truncate(transfer.data.len().saturating_sub(unused));
    format!("end of the blocks: {}", whole(node, transfer))
}
