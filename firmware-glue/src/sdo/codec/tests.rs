use super::{Aborted, Answer, BlockSegment, Expedited, Piece, Received, Request, Segment};
use crate::abort::AbortCode;
use crate::table::entry::EntryId;

const ID: EntryId = EntryId { index: 0x1234, sub: 0x56 };

fn expedited(value: &[u8]) -> Expedited {
    Expedited::new(value).expect("one to four bytes")
}

fn piece(bytes: &[u8], last: bool) -> Piece {
    Piece { last, ..Piece::first_of(bytes) }
}

#[test]
fn every_request_has_its_bytes() {
    let cases: [(Request, [u8; 8]); 20] = [
        (Request::DownloadExpedited { id: ID, value: expedited(&[1]) }, [0x2F, 0x34, 0x12, 0x56, 1, 0, 0, 0]),
        (
            Request::DownloadExpedited { id: ID, value: expedited(&[1, 2]) },
            [0x2B, 0x34, 0x12, 0x56, 1, 2, 0, 0],
        ),
        (
            Request::DownloadExpedited { id: ID, value: expedited(&[1, 2, 3]) },
            [0x27, 0x34, 0x12, 0x56, 1, 2, 3, 0],
        ),
        (
            Request::DownloadExpedited { id: ID, value: expedited(&[1, 2, 3, 4]) },
            [0x23, 0x34, 0x12, 0x56, 1, 2, 3, 4],
        ),
        (
            Request::DownloadExpedited { id: ID, value: Expedited { bytes: [1, 2, 3, 4], length: None } },
            [0x22, 0x34, 0x12, 0x56, 1, 2, 3, 4],
        ),
        (Request::Download { id: ID, size: Some(0x0102) }, [0x21, 0x34, 0x12, 0x56, 2, 1, 0, 0]),
        (Request::Download { id: ID, size: None }, [0x20, 0x34, 0x12, 0x56, 0, 0, 0, 0]),
        (
            Request::DownloadSegment(Segment { toggle: false, piece: piece(&[1, 2, 3, 4, 5, 6, 7], false) }),
            [0x00, 1, 2, 3, 4, 5, 6, 7],
        ),
        (
            Request::DownloadSegment(Segment { toggle: true, piece: piece(&[9], true) }),
            [0x1D, 9, 0, 0, 0, 0, 0, 0],
        ),
        (Request::Upload { id: ID }, [0x40, 0x34, 0x12, 0x56, 0, 0, 0, 0]),
        (Request::UploadSegment { toggle: false }, [0x60, 0, 0, 0, 0, 0, 0, 0]),
        (Request::UploadSegment { toggle: true }, [0x70, 0, 0, 0, 0, 0, 0, 0]),
        (Request::BlockDownload { id: ID, crc: true, size: Some(9) }, [0xC6, 0x34, 0x12, 0x56, 9, 0, 0, 0]),
        (Request::BlockDownload { id: ID, crc: false, size: None }, [0xC0, 0x34, 0x12, 0x56, 0, 0, 0, 0]),
        (Request::BlockDownloadEnd { unused: 5, crc: 0x31C3 }, [0xD5, 0xC3, 0x31, 0, 0, 0, 0, 0]),
        (
            Request::BlockUpload { id: ID, crc: true, block_size: 127, threshold: 8 },
            [0xA4, 0x34, 0x12, 0x56, 127, 8, 0, 0],
        ),
        (Request::BlockUploadStart, [0xA3, 0, 0, 0, 0, 0, 0, 0]),
        (
            Request::BlockUploadReceived(Received { sequence: 3, block_size: 127 }),
            [0xA2, 3, 127, 0, 0, 0, 0, 0],
        ),
        (Request::BlockUploadEnd, [0xA1, 0, 0, 0, 0, 0, 0, 0]),
        (Request::Abort(Aborted { id: ID, code: AbortCode::TIMEOUT }), [0x80, 0x34, 0x12, 0x56, 0, 0, 4, 5]),
    ];
    for (request, bytes) in cases {
        assert_eq!(request.encode(), bytes, "{request:?}");
        assert_eq!(Request::decode(bytes), Some(request));
    }
    assert_eq!(Request::decode([0xE0, 0, 0, 0, 0, 0, 0, 0]), None);
}

#[test]
fn every_answer_has_its_bytes() {
    let cases: [(Answer, [u8; 8]); 15] = [
        (Answer::Download { id: ID }, [0x60, 0x34, 0x12, 0x56, 0, 0, 0, 0]),
        (Answer::DownloadSegment { toggle: false }, [0x20, 0, 0, 0, 0, 0, 0, 0]),
        (Answer::DownloadSegment { toggle: true }, [0x30, 0, 0, 0, 0, 0, 0, 0]),
        (Answer::UploadExpedited { id: ID, value: expedited(&[1]) }, [0x4F, 0x34, 0x12, 0x56, 1, 0, 0, 0]),
        (
            Answer::UploadExpedited { id: ID, value: Expedited { bytes: [1, 2, 3, 4], length: None } },
            [0x42, 0x34, 0x12, 0x56, 1, 2, 3, 4],
        ),
        (Answer::Upload { id: ID, size: Some(5) }, [0x41, 0x34, 0x12, 0x56, 5, 0, 0, 0]),
        (Answer::Upload { id: ID, size: None }, [0x40, 0x34, 0x12, 0x56, 0, 0, 0, 0]),
        (
            Answer::UploadSegment(Segment { toggle: true, piece: piece(&[], true) }),
            [0x1F, 0, 0, 0, 0, 0, 0, 0],
        ),
        (Answer::BlockDownload { id: ID, crc: true, block_size: 4 }, [0xA4, 0x34, 0x12, 0x56, 4, 0, 0, 0]),
        (Answer::BlockDownloadReceived(Received { sequence: 4, block_size: 5 }), [0xA2, 4, 5, 0, 0, 0, 0, 0]),
        (Answer::BlockDownloadEnd, [0xA1, 0, 0, 0, 0, 0, 0, 0]),
        (Answer::BlockUpload { id: ID, crc: true, size: Some(7) }, [0xC6, 0x34, 0x12, 0x56, 7, 0, 0, 0]),
        (Answer::BlockUpload { id: ID, crc: false, size: None }, [0xC0, 0x34, 0x12, 0x56, 0, 0, 0, 0]),
        (Answer::BlockUploadEnd { unused: 7, crc: 1 }, [0xDD, 1, 0, 0, 0, 0, 0, 0]),
        (Answer::Abort(Aborted { id: ID, code: AbortCode::CRC }), [0x80, 0x34, 0x12, 0x56, 4, 0, 4, 5]),
    ];
    for (answer, bytes) in cases {
        assert_eq!(answer.encode(), bytes, "{answer:?}");
        assert_eq!(Answer::decode(bytes), Some(answer));
    }
    assert_eq!(Answer::decode([0xE0, 0, 0, 0, 0, 0, 0, 0]), None);
}

#[test]
fn reserved_bits_are_not_looked_at() {
    assert_eq!(Request::decode([0x5F, 0x34, 0x12, 0x56, 9, 9, 9, 9]), Some(Request::Upload { id: ID }));
    assert_eq!(Answer::decode([0x7F, 0x34, 0x12, 0x56, 9, 9, 9, 9]), Some(Answer::Download { id: ID }));
    assert_eq!(Request::decode([0xBF, 9, 9, 9, 9, 9, 9, 9]), Some(Request::BlockUploadStart));
}

#[test]
fn a_segment_of_a_block_is_told_from_an_abort() {
    let segment = BlockSegment { sequence: 127, last: true, bytes: [1, 2, 3, 4, 5, 6, 7] };
    assert_eq!(segment.encode(), [0xFF, 1, 2, 3, 4, 5, 6, 7]);
    assert_eq!(BlockSegment::decode(segment.encode()), Ok(segment));
    let aborted = Aborted { id: ID, code: AbortCode::GENERAL };
    assert_eq!(BlockSegment::decode(aborted.encode()), Err(aborted));
}
