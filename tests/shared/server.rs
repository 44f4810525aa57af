// A small SDO server: proof that a dictionary offers what a protocol needs. Expedited and segmented transfers, DOMAINs in
// pieces; no blocks, no timeouts.

use firmware_glue::{AbortCode, Application, DataType, Dictionary};

/// The transfer that goes on.
enum Transfer {
    None,
    Upload { index: u16, sub: u8, offset: u32, toggle: u8 },
    Download { index: u16, sub: u8, offset: u32, toggle: u8 },
}

/// A server for one client. `BUFFER` bytes hold the largest value of the dictionary: `LARGEST_VALUE` of generated ones.
pub(crate) struct Server<D, A, const BUFFER: usize> {
    pub(crate) dictionary: D,
    pub(crate) application: A,
    transfer: Transfer,
    buffer: [u8; BUFFER],
}

impl<'t, D: Dictionary<'t>, A: Application<D>, const BUFFER: usize> Server<D, A, BUFFER> {
    /// # Panics
    /// When the dictionary has larger values than the buffer takes.
    pub(crate) fn new(dictionary: D, application: A) -> Self {
        assert!(dictionary.table().largest_value() <= BUFFER, "the buffer is too small for the dictionary");
        Self { dictionary, application, transfer: Transfer::None, buffer: [0; BUFFER] }
    }

    /// Whether an entry is a DOMAIN, which the application has.
    fn is_domain(&self, index: u16, sub: u8) -> Result<bool, AbortCode> {
        let entry = self.dictionary.find(index, sub)?;
        Ok(self.dictionary.info(entry).data_type() == DataType::Domain)
    }

    /// The answer to a request.
    pub(crate) fn answer(&mut self, request: [u8; 8]) -> Option<[u8; 8]> {
        let [command, low, high, sub, data @ ..] = request;
        let index = u16::from_le_bytes([low, high]);
        let outcome = match command >> 5 {
            1 => self.begin_download(command, index, sub, data),
            0 => self.download_segment(request),
            2 => self.begin_upload(index, sub),
            3 => self.upload_segment(command),
            4 => {
                self.transfer = Transfer::None;
                return None;
            }
            _ => Err((index, sub, AbortCode::COMMAND)),
        };
        Some(outcome.unwrap_or_else(|(index, sub, code)| {
            self.transfer = Transfer::None;
            frame(0x80, index, sub, code.0.to_le_bytes())
        }))
    }

    fn begin_download(
        &mut self,
        command: u8,
        index: u16,
        sub: u8,
        data: [u8; 4],
    ) -> Result<[u8; 8], Refusal> {
        if command & 2 != 0 {
            let length = if command & 1 == 0 { 4 } else { 4 - usize::from(command >> 2 & 3) };
            let data = data.get(..length).unwrap_or(&data);
            let written = if self.is_domain(index, sub) == Ok(true) {
                self.dictionary.download_domain(index, sub, 0, data, true, &mut self.application)
            } else {
                self.dictionary.write(index, sub, data, &mut self.application).map(drop)
            };
            written.map_err(|code| (index, sub, code))?;
        } else {
            self.dictionary.find(index, sub).map_err(|code| (index, sub, code))?;
            self.transfer = Transfer::Download { index, sub, offset: 0, toggle: 0 };
        }
        Ok(frame(0x60, index, sub, [0; 4]))
    }

    fn download_segment(&mut self, [command, data @ ..]: [u8; 8]) -> Result<[u8; 8], Refusal> {
        let Transfer::Download { index, sub, offset, toggle } = self.transfer else {
            return Err((0, 0, AbortCode::COMMAND));
        };
        let refuse = |code| (index, sub, code);
        if command >> 4 & 1 != toggle {
            return Err(refuse(AbortCode::TOGGLE_BIT));
        }
        let (last, length) = (command & 1 != 0, 7 - usize::from(command >> 1 & 7));
        let data = data.get(..length).unwrap_or(&data);
        let next = offset + u32::try_from(data.len()).unwrap_or_default();
        if self.is_domain(index, sub).map_err(refuse)? {
            self.dictionary
                .download_domain(index, sub, offset, data, last, &mut self.application)
                .map_err(refuse)?;
        } else {
            let at = usize::try_from(offset).unwrap_or(usize::MAX);
            // What the buffer does not hold is longer than every value.
            let place =
                self.buffer.get_mut(at..at.saturating_add(data.len())).ok_or(refuse(AbortCode::TOO_LONG))?;
            place.copy_from_slice(data);
            if last {
                let whole = self.buffer.get(..at + data.len()).unwrap_or_default();
                self.dictionary.write(index, sub, whole, &mut self.application).map_err(refuse)?;
            }
        }
        self.transfer = if last {
            Transfer::None
        } else {
            Transfer::Download { index, sub, offset: next, toggle: toggle ^ 1 }
        };
        Ok([0x20 | toggle << 4, 0, 0, 0, 0, 0, 0, 0])
    }

    fn begin_upload(&mut self, index: u16, sub: u8) -> Result<[u8; 8], Refusal> {
        let refuse = |code| (index, sub, code);
        let (command, data) = if self.is_domain(index, sub).map_err(refuse)? {
            (0x40, [0; 4])
        } else {
            let value = self.dictionary.upload(index, sub, &mut self.application).map_err(refuse)?;
            let length = u32::try_from(value.len()).unwrap_or(u32::MAX).to_le_bytes();
            let mut data = [0; 4];
            data.iter_mut().zip(value.iter()).for_each(|(byte, new)| *byte = *new);
            match length {
                [bytes @ 1..=4, 0, 0, 0] => return Ok(frame(0x43 | (4 - bytes) << 2, index, sub, data)),
                _ => (0x41, length),
            }
        };
        self.transfer = Transfer::Upload { index, sub, offset: 0, toggle: 0 };
        Ok(frame(command, index, sub, data))
    }

    fn upload_segment(&mut self, command: u8) -> Result<[u8; 8], Refusal> {
        let Transfer::Upload { index, sub, offset, toggle } = self.transfer else {
            return Err((0, 0, AbortCode::COMMAND));
        };
        let refuse = |code| (index, sub, code);
        if command >> 4 & 1 != toggle {
            return Err(refuse(AbortCode::TOGGLE_BIT));
        }
        let (mut segment, at) = ([0; 7], usize::try_from(offset).unwrap_or(usize::MAX));
        let (length, last) = if self.is_domain(index, sub).map_err(refuse)? {
            let length = self
                .dictionary
                .upload_domain(index, sub, offset, &mut segment, &mut self.application)
                .map_err(refuse)?;
            (length, length < 7)
        } else {
            let value = self.dictionary.read(index, sub).map_err(refuse)?;
            let rest = value.get(at..).unwrap_or_default();
            segment.iter_mut().zip(rest).for_each(|(byte, new)| *byte = *new);
            (rest.len().min(7), rest.len() <= 7)
        };
        let unused = u8::try_from(7 - length.min(7)).unwrap_or_default();
        let next = offset + u32::try_from(length).unwrap_or_default();
        self.transfer = if last {
            Transfer::None
        } else {
            Transfer::Upload { index, sub, offset: next, toggle: toggle ^ 1 }
        };
        let mut answer = [toggle << 4 | unused << 1 | u8::from(last); 8];
        answer.iter_mut().skip(1).zip(segment).for_each(|(byte, new)| *byte = new);
        Ok(answer)
    }
}

/// Index, sub-index and code of an abort.
type Refusal = (u16, u8, AbortCode);

fn frame(command: u8, index: u16, sub: u8, data: [u8; 4]) -> [u8; 8] {
    let ([low, high], [a, b, c, d]) = (index.to_le_bytes(), data);
    [command, low, high, sub, a, b, c, d]
}
