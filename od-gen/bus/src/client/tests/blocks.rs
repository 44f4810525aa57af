//! Long values are read in blocks where the node sends them.

use super::*;

/// Requests that reading a long value takes.
fn reading_takes<F: FnMut(usize, Frame) -> Vec<Frame>>(client: &mut Client<Dirty<'_, F>>) -> usize {
    let before = client.bus().requests;
    let long: Vec<u8> = (0..=255).cycle().take(2000).collect();
    assert!(client.read_as(5, id(0x2007), DataType::Domain).unwrap() == long);
    client.bus().requests - before
}

fn with_picture<F: FnMut(usize, Frame) -> Vec<Frame>>(
    becomes: F,
    test: impl FnOnce(&mut Client<Dirty<'_, F>>),
) {
    with_dirt(becomes, |client| {
        let long: Vec<u8> = (0..=255).cycle().take(2000).collect();
        client.write(5, id(0x2007), &long).unwrap();
        test(client);
    });
}

#[test]
fn a_domain_is_read_in_blocks() {
    with_picture(
        |_, frame| vec![frame],
        |client| {
            // Begin, start, three blocks, end.
            assert_eq!(reading_takes(client), 6);
            assert_eq!(client.read_as(5, id(0x2000), DataType::Unsigned16).unwrap(), [20, 0]);
        },
    );
}

#[test]
fn a_node_without_blocks_is_asked_for_them_once() {
    let becomes = |_, frame: Frame| match frame.bytes() {
        // It knows no command that begins a block.
        Some([0xC0..=0xC7, rest @ ..]) => {
            let [low, high, sub, ..] = *rest else { panic!("8 bytes") };
            let [a, b, c, d] = AbortCode::COMMAND.0.to_le_bytes();
            vec![Frame::full(frame.id(), [0x80, low, high, sub, a, b, c, d])]
        }
        _ => vec![frame],
    };
    with_picture(becomes, |client| {
        let in_segments = 1 + 2000_usize.div_ceil(7);
        assert_eq!(reading_takes(client), 1 + in_segments);
        assert_eq!(reading_takes(client), in_segments);
    });
}

#[test]
fn a_block_that_breaks_is_read_again_in_segments() {
    let mut broken = false;
    let becomes = move |_, frame: Frame| match frame.bytes() {
        // The checksum at the end.
        Some([command, _, crc, ..]) if command & 0xE3 == 0xC1 && *crc != 0 && !broken => {
            broken = true;
            let mut bytes: [u8; 8] = frame.bytes().unwrap().try_into().unwrap();
            bytes[1] ^= 0x55;
            vec![Frame::full(frame.id(), bytes)]
        }
        _ => vec![frame],
    };
    with_picture(becomes, |client| {
        assert!(reading_takes(client) > 2000 / 7);
        assert_eq!(reading_takes(client), 6, "the node has blocks");
    });
}
