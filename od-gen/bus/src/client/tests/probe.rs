//! What an unknown node has is asked of the node.

use super::*;

/// What a node has at an index: sub-indices, with what came when each was read.
fn probed<B: Bus>(prober: &mut Prober<'_, B>, index: u16) -> Vec<(u8, String)> {
    let reported = |holds| match holds {
        Holds::Bytes(bytes) => format!("{bytes:?}"),
        Holds::WriteOnly => "write only".to_owned(),
        Holds::Unreported(error) => error.to_string(),
    };
    prober
        .object(Index(index))
        .unwrap()
        .into_iter()
        .map(|found| (found.id.sub.0, reported(found.holds)))
        .collect()
}

#[test]
fn a_node_is_asked_what_it_has() {
    with_lamps(|_, client| {
        let mut prober = Prober::new(client, 5).unwrap().unwrap();
        assert_eq!(probed(&mut prober, 0x2000), [(0, "[20, 0]".to_owned())]);
        assert_eq!(
            probed(&mut prober, 0x2003),
            [(0, "[1]".to_owned())],
            "a byte is not a number of elements"
        );
        assert_eq!(probed(&mut prober, 0x20FF), []);
        let identity = probed(&mut prober, 0x1018);
        assert_eq!(identity.iter().map(|(sub, _)| *sub).collect::<Vec<_>>(), [0, 1, 2, 3, 4]);
        assert!(Prober::new(client, 7).is_err(), "nothing answers");
    });
}

/// The first answer to an upload of an index and a sub-index; `None` is what the node answers itself.
type Answered = fn(u16, u8) -> Option<u32>;

/// Abort codes in place of answers.
fn aborting(answered: Answered) -> impl FnMut(usize, Frame) -> Vec<Frame> {
    move |_, frame| {
        let bytes: [u8; 8] = frame.bytes().unwrap().try_into().unwrap();
        let [_, low, high, sub, ..] = bytes;
        let code = answered(u16::from_le_bytes([low, high]), sub);
        vec![code.map_or(frame, |code| {
            let [a, b, c, d] = code.to_le_bytes();
            Frame::full(frame.id(), [0x80, low, high, sub, a, b, c, d])
        })]
    }
}

#[test]
fn what_a_node_refuses_to_report_is_there() {
    let answered: Answered = |index, sub| match (index, sub) {
        (0x2000, 0) => Some(0x0601_0001),
        (0x2001, 0) => Some(0x0800_0022),
        // Elements with gaps.
        (0x2003, 2 | 3 | 5 | 7..) => Some(0x0609_0011),
        (0x2003, 1 | 4) => Some(0x0800_0024),
        (0x2003, 6) => Some(0x0601_0001),
        // Any element at all, without a value.
        (0x2001, 1..) => Some(0x060A_0023),
        // Elements without a value.
        (0x2005, 0) => Some(0x0800_0022),
        (0x2005, 1..=254) => Some(0x0800_0024),
        (0x2004.., _) => Some(0x0602_0000),
        (_, _) => None,
    };
    with_dirt(aborting(answered), |client| {
        let mut prober = Prober::new(client, 5).unwrap().unwrap();
        assert_eq!(probed(&mut prober, 0x2000), [(0, "write only".to_owned())]);
        let state =
            "the node refuses: 0800 0022h: data cannot be transferred because of the present device state";
        assert_eq!(probed(&mut prober, 0x2001), [(0, state.to_owned())]);
        let subs = |prober: &mut Prober<'_, _>| {
            probed(prober, 0x2003).into_iter().map(|(sub, _)| sub).collect::<Vec<_>>()
        };
        assert_eq!(subs(&mut prober), [0, 1], "1 is the number of elements");
        assert_eq!(probed(&mut prober, 0x2005).len(), 255);
        client.write(5, id(0x2003), &[4]).unwrap();
        assert_eq!(
            subs(&mut Prober::new(client, 5).unwrap().unwrap()),
            [0, 1, 4, 6],
            "4 is, and 5 is reserved"
        );
    });
}

#[test]
fn a_node_says_in_its_own_way_that_it_has_no_object() {
    // "General error" for everything that is not there.
    let answered: Answered = |index, _| (index != 0x2000).then_some(0x0800_0000);
    with_dirt(aborting(answered), |client| {
        let mut prober = Prober::new(client, 5).unwrap().unwrap();
        assert_eq!(probed(&mut prober, 0x2000), [(0, "[20, 0]".to_owned())]);
        assert_eq!(probed(&mut prober, 0x2001), []);
    });
    // One that answers always cannot be asked.
    let echo = |_, frame: Frame| {
        let mut bytes: [u8; 8] = frame.bytes().unwrap().try_into().unwrap();
        bytes[0] = 0x43;
        vec![Frame::full(frame.id(), bytes)]
    };
    with_dirt(echo, |client| assert!(Prober::new(client, 5).unwrap().is_none()));
}
