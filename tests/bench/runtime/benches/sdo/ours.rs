//! Ours: `SdoClient` and `SdoServer`.

use firmware_glue::clock::Instant;
use firmware_glue::frame::Frame;
use firmware_glue::sdo::{Channel, Filled, SdoClient, SdoServer, Way};
use firmware_glue::table::{Attributes, Block, Directory, EntryRow, Flags, NONE, Parts, Place};
use firmware_glue::{
    AbortCode, Application, DataType, Entries, EntryId, NodeId, Storage, Table, TableDictionary,
};

const NOW: Instant = Instant::ZERO;

fn channel() -> Channel {
    Channel::predefined(NodeId::new(5).expect("1 to 127"))
}

macro_rules! models {
    ($($feature:literal $model:ident),*) => {$(
        #[cfg(feature = $feature)]
        pub mod $model {
            use super::*;
            use crate::RoundTrip;
            use bench_ours::$model::Controller;

            pub struct Ours {
                client: SdoClient,
                server: SdoServer<[u8; Controller::LARGEST_VALUE]>,
                dictionary: Controller,
            }

            pub fn pair() -> Ours {
                let server = SdoServer::new(channel(), [0; Controller::LARGEST_VALUE]);
                Ours { client: SdoClient::new(channel()), server, dictionary: Controller::new(5) }
            }

            impl RoundTrip for Ours {
                const NAME: &str = "ours";

                fn read(&mut self, index: u16) -> Option<u16> {
                    let (mut buffer, id) = ([0; 2], EntryId { index, sub: 0 });
                    let (mut reading, request) = self.client.start_read(id, Filled::new(&mut buffer), NOW);
                    let answer = self.server.handle(&request, &mut self.dictionary, &mut (), NOW)?;
                    reading.handle(&answer, NOW).outcome?.ok()?;
                    Some(u16::from_le_bytes(reading.sink().bytes().try_into().ok()?))
                }

                fn write(&mut self, index: u16, value: u16) -> bool {
                    let (bytes, id) = (value.to_le_bytes(), EntryId { index, sub: 0 });
                    let begun = self.client.start_write(id, &bytes[..], NOW);
                    let Ok((mut writing, request)) = begun else { return false };
                    let answer = self.server.handle(&request, &mut self.dictionary, &mut (), NOW);
                    answer.is_some_and(|answer| matches!(writing.handle(&answer, NOW).outcome, Some(Ok(_))))
                }
            }
        }
    )*};
}

models!("size150" size150, "gappy150" gappy150, "pmc" pmc);

const DOMAIN: EntryId = EntryId { index: 0x2000, sub: 0 };
const ATTRIBUTES: Attributes = Attributes {
    data_type: DataType::Domain,
    flags: Flags::READ.with(Flags::WRITE),
    place: Place::Application,
    storage: Storage::No,
    page: 0,
    size: 0,
    limits: NONE,
    values: NONE,
    condition: NONE,
};

/// An application that gathers what comes.
#[derive(Default)]
struct Program(Vec<u8>);

impl<D: Entries> Application<D> for Program {
    fn write_domain(
        &mut self,
        _: &mut D,
        _: D::Entry,
        offset: u32,
        data: &[u8],
        _: bool,
    ) -> Result<(), AbortCode> {
        if offset == 0 {
            self.0.clear();
        }
        self.0.extend_from_slice(data);
        Ok(())
    }
}

/// A server with a DOMAIN.
pub struct Domain<'t> {
    server: SdoServer<[u8; 0]>,
    dictionary: TableDictionary<'t, [u8; 0]>,
    program: Program,
}

/// Does something with one.
pub fn with_domain(run: impl FnOnce(&mut Domain<'_>)) {
    let (mut blocks, mut seeds, mut order) = ([Block::FREE; 1], [0; 1], [0; 1]);
    let directory = Directory::arrange(&[DOMAIN.index], &mut blocks, &mut seeds, &mut order);
    let parts = Parts {
        directory: directory.expect("room"),
        objects: &[0, 1],
        entries: &[EntryRow { attributes: 0, place: 0 }],
        attributes: &[ATTRIBUTES],
        ..Parts::EMPTY
    };
    let table = Table::checked(parts).expect("right");
    let dictionary = TableDictionary::new(&table, [], 5).expect("no bytes");
    run(&mut Domain { server: SdoServer::new(channel(), []), dictionary, program: Program::default() });
}

impl Domain<'_> {
    /// Writes data in blocks of 127 segments, with a checksum; what came.
    pub fn download(&mut self, data: &[u8]) -> &[u8] {
        let client = SdoClient { way: Way::Blocks, ..SdoClient::new(channel()) };
        let (mut writing, request) = client.start_write(DOMAIN, data, NOW).expect("as long as it says");
        let mut ask = |frame: &Frame| self.server.handle(frame, &mut self.dictionary, &mut self.program, NOW);
        let mut answer = ask(&request);
        loop {
            let step = match answer {
                Some(frame) => writing.handle(&frame, NOW),
                None => writing.poll(NOW),
            };
            answer = step.send.as_ref().and_then(&mut ask);
            if let Some(outcome) = step.outcome {
                assert!(outcome.is_ok(), "{outcome:?}");
                return &self.program.0;
            }
        }
    }
}
