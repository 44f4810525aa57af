// The SDO server of firmware-glue with a dictionary and an application of its own, for requests of eight bytes. Time
// does not pass.

use firmware_glue::clock::Instant;
use firmware_glue::frame::{CanId, Frame};
use firmware_glue::sdo::{Channel, SdoServer};
use firmware_glue::{Application, Dictionary};

/// A server for one client. `BUFFER` bytes hold the largest value of the dictionary: `LARGEST_VALUE` of generated ones.
pub(crate) struct Server<D, A, const BUFFER: usize> {
    pub(crate) dictionary: D,
    pub(crate) application: A,
    protocol: SdoServer<[u8; BUFFER]>,
}

impl<'t, D: Dictionary<'t>, A: Application<D>, const BUFFER: usize> Server<D, A, BUFFER> {
    pub(crate) fn new(dictionary: D, application: A) -> Self {
        let channel = Channel { request: CanId::MAX, answer: CanId::MAX };
        Self { dictionary, application, protocol: SdoServer::new(channel, [0; BUFFER]) }
    }

    /// The answer to a request.
    pub(crate) fn answer(&mut self, request: [u8; 8]) -> Option<[u8; 8]> {
        let frame = Frame::full(CanId::MAX, request);
        let answer =
            self.protocol.handle(&frame, &mut self.dictionary, &mut self.application, Instant::ZERO)?;
        answer.bytes()?.try_into().ok()
    }

    /// What follows unasked: the other segments of a block, one in each call.
    #[allow(dead_code, reason = "not every test has blocks")]
    pub(crate) fn next(&mut self) -> Option<[u8; 8]> {
        self.protocol
            .poll(&mut self.dictionary, &mut self.application, Instant::ZERO)?
            .bytes()?
            .try_into()
            .ok()
    }
}
