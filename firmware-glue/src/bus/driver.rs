//! Frames of CAN drivers, by the traits of `embedded-can`.

use embedded_can::{Id, StandardId};

use crate::bus::frame::{CanId, Frame};

impl Frame {
    /// The frame that a driver received; `None` for one that CANopen does not have: with an identifier of 29 bits, or with more
    /// than eight bytes.
    pub fn of_driver(frame: &impl embedded_can::Frame) -> Option<Self> {
        let Id::Standard(id) = frame.id() else { return None };
        let id = CanId::new(id.as_raw())?;
        if frame.is_remote_frame() {
            return Self::remote(id, u8::try_from(frame.dlc()).ok()?);
        }
        Self::data(id, frame.data())
    }

    /// The frame for a driver to send; `None` if the driver has none like it.
    pub fn for_driver<F: embedded_can::Frame>(&self) -> Option<F> {
        let id = StandardId::new(self.id().get())?;
        match self.bytes() {
            Some(bytes) => F::new(id, bytes),
            None => F::new_remote(id, usize::from(self.length())),
        }
    }
}

#[cfg(test)]
mod tests {
    use embedded_can::{ExtendedId, Frame as _, Id};

    use crate::bus::frame::{CanId, Frame};

    /// A driver's frame.
    struct Raw {
        id: Id,
        bytes: [u8; 8],
        length: usize,
        is_remote: bool,
    }

    impl embedded_can::Frame for Raw {
        fn new(id: impl Into<Id>, data: &[u8]) -> Option<Self> {
            let mut bytes = [0; 8];
            bytes.get_mut(..data.len())?.copy_from_slice(data);
            Some(Self { id: id.into(), bytes, length: data.len(), is_remote: false })
        }

        fn new_remote(id: impl Into<Id>, length: usize) -> Option<Self> {
            (length <= 8).then(|| Self { id: id.into(), bytes: [0; 8], length, is_remote: true })
        }

        fn is_extended(&self) -> bool {
            matches!(self.id, Id::Extended(_))
        }

        fn is_remote_frame(&self) -> bool {
            self.is_remote
        }

        fn id(&self) -> Id {
            self.id
        }

        fn dlc(&self) -> usize {
            self.length
        }

        fn data(&self) -> &[u8] {
            if self.is_remote { &[] } else { &self.bytes[..self.length] }
        }
    }

    #[test]
    fn frames_go_to_a_driver_and_come_back() {
        let id = CanId::new(0x601).expect("11 bits");
        let frames = [Frame::data(id, &[1, 2, 3]), Frame::data(id, &[]), Frame::remote(id, 8)];
        for frame in frames.map(|frame| frame.expect("up to eight bytes")) {
            let raw: Raw = frame.for_driver().expect("the driver has all");
            assert_eq!(Frame::of_driver(&raw), Some(frame));
        }
    }

    #[test]
    fn identifiers_of_29_bits_are_not_canopen() {
        let raw = Raw::new(ExtendedId::new(0x601).expect("29 bits"), &[1]).expect("a byte");
        assert_eq!(Frame::of_driver(&raw), None);
    }
}
