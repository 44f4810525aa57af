//! canopen-rs: its `SdoClient` and `SdoServer`.

use canopen_rs::{Address, DataType, NodeId, ObjectDictionary, SdoClient, SdoEvent, SdoServer, Value};

use crate::RoundTrip;

pub struct CanopenRs<const N: usize> {
    client: SdoClient,
    server: SdoServer,
    od: Box<ObjectDictionary<N>>,
}

pub fn pair<const N: usize>(od: ObjectDictionary<N>) -> CanopenRs<N> {
    let node = NodeId::new(5).expect("1 to 127");
    CanopenRs { client: SdoClient::new(node), server: SdoServer::new(node), od: Box::new(od) }
}

impl<const N: usize> RoundTrip for CanopenRs<N> {
    const NAME: &str = "canopen-rs";

    fn read(&mut self, index: u16) -> Option<u16> {
        let request = self.client.read(Address::new(index, 0), DataType::Unsigned16);
        let answer = self.server.handle(&mut self.od, &request)?;
        match self.client.on_response(&answer) {
            SdoEvent::Complete(Some(Value::Unsigned16(value))) => Some(value),
            _ => None,
        }
    }

    fn write(&mut self, index: u16, value: u16) -> bool {
        let request = self.client.write(Address::new(index, 0), Value::Unsigned16(value));
        let answer = self.server.handle(&mut self.od, &request);
        answer.is_some_and(|answer| matches!(self.client.on_response(&answer), SdoEvent::Complete(_)))
    }
}
