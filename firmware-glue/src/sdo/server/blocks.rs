//! The server's side of block transfers (CiA 301 7.2.4.2.9 to 7.2.4.2.16).

use super::download::Download;
use super::upload::Upload;
use super::{Phase, SdoServer, Transfer, find_to_upload};
use crate::abort::AbortCode;
use crate::access::application::Application;
use crate::access::dictionary::{Dictionary, value};
use crate::sdo::block::{Receiver, Sender};
use crate::sdo::codec::{Answer, BlockSegment, Received, Request};
use crate::table::entry::EntryId;

impl<B: AsRef<[u8]> + AsMut<[u8]>> SdoServer<B> {
    /// Whether there is a segment of a block to be sent.
    pub(super) fn is_sending_blocks(&self) -> bool {
        matches!(&self.transfer, Transfer::BlockUpload { sender, phase: Phase::Sending, .. } if sender.offset().is_some())
    }

    /// The answer to a segment of a block: at the end of the block, or when something is wrong.
    #[inline(never)]
    pub(super) fn take_segment<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        bytes: [u8; 8],
        dictionary: &mut D,
        application: &mut A,
    ) -> Option<[u8; 8]> {
        let Transfer::BlockDownload { download, receiver, .. } = &mut self.transfer else { return None };
        let id = download.id;
        let Ok(segment) = BlockSegment::decode(bytes) else {
            self.transfer = Transfer::None;
            return None;
        };
        let taken = receiver.take(segment).and_then(|taken| {
            if let Some(bytes) = taken.bytes {
                download.put(&bytes, false, self.buffer.as_mut(), dictionary, application)?;
            }
            Ok(taken.received)
        });
        match taken {
            Ok(received) => Some(Answer::BlockDownloadReceived(received?).encode()),
            Err(code) => Some(self.abort(id, code)),
        }
    }

    /// The answer to a request about blocks.
    #[inline(never)]
    pub(super) fn take_block<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        request: Request,
        dictionary: &mut D,
        application: &mut A,
    ) -> Option<[u8; 8]> {
        let mut id = self.transfer.id();
        match self.answer_block(request, &mut id, dictionary, application) {
            Ok(answer) => answer,
            Err(code) => Some(self.abort(id, code)),
        }
    }

    /// The same; the entry is changed to the one that a request names.
    fn answer_block<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        request: Request,
        id: &mut EntryId,
        dictionary: &mut D,
        application: &mut A,
    ) -> Result<Option<[u8; 8]>, AbortCode> {
        match request {
            Request::BlockDownload { id: begun, crc, size } => {
                *id = begun;
                let download = Download::begin(begun, size, self.buffer.as_ref(), dictionary, application)?;
                let receiver = Receiver::new(self.block_size);
                self.transfer = Transfer::BlockDownload { download, receiver, crc };
                Ok(Some(Answer::BlockDownload { id: begun, crc: true, block_size: self.block_size }.encode()))
            }
            Request::BlockDownloadEnd { unused, crc: sum } => {
                let Transfer::BlockDownload { download, receiver, crc } = &mut self.transfer else {
                    return Err(AbortCode::COMMAND);
                };
                let piece = receiver.finish(unused, crc.then_some(sum))?;
                download.put(piece.bytes(), true, self.buffer.as_mut(), dictionary, application)?;
                self.transfer = Transfer::None;
                Ok(Some(Answer::BlockDownloadEnd.encode()))
            }
            Request::BlockUpload { id: begun, crc, block_size, threshold } => {
                *id = begun;
                self.begin_block_upload(begun, crc, block_size, threshold, dictionary, application).map(Some)
            }
            Request::BlockUploadStart => {
                let Transfer::BlockUpload { phase: phase @ Phase::Announced, .. } = &mut self.transfer else {
                    return Err(AbortCode::COMMAND);
                };
                *phase = Phase::Sending;
                Ok(self.next_of_block(dictionary, application))
            }
            Request::BlockUploadReceived(received) => self.block_received(received, dictionary, application),
            Request::BlockUploadEnd => {
                let Transfer::BlockUpload { phase: Phase::Ended, .. } = self.transfer else {
                    return Err(AbortCode::COMMAND);
                };
                self.transfer = Transfer::None;
                Ok(None)
            }
            Request::DownloadExpedited { .. }
            | Request::Download { .. }
            | Request::DownloadSegment(_)
            | Request::Upload { .. }
            | Request::UploadSegment { .. }
            | Request::Abort(_) => Err(AbortCode::INTERNAL),
        }
    }

    fn begin_block_upload<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        id: EntryId,
        crc: bool,
        block_size: u8,
        threshold: u8,
        dictionary: &mut D,
        application: &mut A,
    ) -> Result<[u8; 8], AbortCode> {
        let sender = Sender::new(block_size)?;
        self.transfer = Transfer::None;
        let found = find_to_upload(id, dictionary, application)?;
        let is_short = value(dictionary, found).is_ok_and(|value| value.len() <= usize::from(threshold));
        if threshold > 0 && is_short {
            return Ok(self.begin_longer_upload(id, found, dictionary, application));
        }
        let upload = Upload::begin(id, found, self.buffer.as_mut(), dictionary, application)?;
        self.transfer = Transfer::BlockUpload { upload, sender, crc, phase: Phase::Announced };
        Ok(Answer::BlockUpload { id, crc: true, size: upload.size() }.encode())
    }

    fn block_received<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        received: Received,
        dictionary: &mut D,
        application: &mut A,
    ) -> Result<Option<[u8; 8]>, AbortCode> {
        let Transfer::BlockUpload { sender, crc, phase: phase @ Phase::Sending, .. } = &mut self.transfer
        else {
            return Err(AbortCode::COMMAND);
        };
        match sender.received(received)? {
            Some(end) => {
                *phase = Phase::Ended;
                let sum = if *crc { end.crc } else { 0 };
                Ok(Some(Answer::BlockUploadEnd { unused: end.unused, crc: sum }.encode()))
            }
            None => Ok(self.next_of_block(dictionary, application)),
        }
    }

    /// The next segment of the block that is being sent, or what went wrong with it.
    pub(super) fn next_of_block<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        dictionary: &mut D,
        application: &mut A,
    ) -> Option<[u8; 8]> {
        let Transfer::BlockUpload { upload, sender, phase: Phase::Sending, .. } = &mut self.transfer else {
            return None;
        };
        match upload.piece(sender.offset()?, self.buffer.as_ref(), dictionary, application) {
            Ok(piece) => Some(sender.segment(piece).encode()),
            Err(code) => {
                let id = upload.id;
                Some(self.abort(id, code))
            }
        }
    }
}
