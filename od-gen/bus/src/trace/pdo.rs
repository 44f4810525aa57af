//! PDOs: the entries that they carry, with their values.

use od_spec::model::{DataType, Mapped, Pdo, PdoTarget};

use super::node::{Node, count};

/// What a PDO says, entry by entry.
pub(super) fn fields(node: &Node<'_>, pdo: &Pdo, bytes: &[u8]) -> String {
    let mapping = node.mapping(pdo);
    let (mut first, mut described) = (0, Vec::new());
    for Mapped { target, bits } in &mapping {
        let end = first + usize::from(*bits);
        match (target, bits_of(bytes, first, usize::from(*bits))) {
            (PdoTarget::Dummy(_), Some(_)) => {}
            (PdoTarget::Entry(id), Some(value)) => {
                let width = node.device.entry(*id).and_then(|entry| width(entry.data_type));
                let note = match width {
                    Some(width) if width != *bits => format!(" ({bits} of its {width} bits are mapped)"),
                    Some(_) | None => String::new(),
                };
                described.push(format!("{} = {}{note}", node.entry(*id), node.value(*id, &value)));
            }
            (PdoTarget::Entry(id), None) => described.push(format!("{} is missing", node.entry(*id))),
            (PdoTarget::Dummy(data_type), None) => {
                described.push(format!("a {} is missing", data_type.name()));
            }
        }
        first = end;
    }
    let needed = first.div_ceil(8);
    if mapping.is_empty() {
        described.push("nothing is mapped".to_owned());
    }
    if bytes.len() > needed {
        described.push(format!("{} more than are mapped", count(bytes.len() - needed)));
    }
    described.join("; ")
}

/// Bits of a value on the bus; a BOOLEAN is one.
fn width(data_type: DataType) -> Option<u8> {
    match data_type {
        DataType::Boolean => Some(1),
        sized => sized.bits().and_then(|bits| u8::try_from(bits).ok()),
    }
}

/// Bits of a frame as the bytes of a value; `None` where the frame ends before.
fn bits_of(bytes: &[u8], first: usize, count: usize) -> Option<Vec<u8>> {
    if first + count > 8 * bytes.len() {
        return None;
    }
    let bit = |at: usize| bytes.get(at / 8).is_some_and(|byte| byte >> (at % 8) & 1 == 1);
    let mut value = vec![0; count.div_ceil(8)];
    for at in (0..count).filter(|at| bit(first + at)) {
        if let Some(byte) = value.get_mut(at / 8) {
            *byte |= 1 << (at % 8);
        }
    }
    Some(value)
}

#[cfg(test)]
mod tests {
    use super::bits_of;

    #[test]
    fn bits_lie_across_bytes_the_lowest_first() {
        let bytes = [0b1010_0110, 0b0000_0011];
        assert_eq!(bits_of(&bytes, 0, 1), Some(vec![0]));
        assert_eq!(bits_of(&bytes, 1, 2), Some(vec![0b11]));
        assert_eq!(bits_of(&bytes, 5, 5), Some(vec![0b1_1101]));
        assert_eq!(bits_of(&bytes, 0, 16), Some(bytes.to_vec()));
        assert_eq!(bits_of(&bytes, 9, 8), None);
    }
}
