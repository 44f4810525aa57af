// The same server for every dictionary that is measured: an endless loop over requests that come from outside, as an SDO
// server gets them. What it answers with leaves it through `black_box`, so that nothing is left out.

use core::hint::black_box;

use firmware_glue::{AbortCode, Application, Dictionary};

/// A request with up to `BUFFER` bytes, those of the largest value. The optimiser does not see what is in it.
pub(crate) struct Request<const BUFFER: usize> {
    index: u16,
    sub: u8,
    kind: u8,
    length: u8,
    data: [u8; BUFFER],
}

impl<const BUFFER: usize> Request<BUFFER> {
    pub(crate) const fn new() -> Self {
        Self { index: 0, sub: 0, kind: 0, length: 0, data: [0; BUFFER] }
    }
}

const UPLOAD: u8 = 0;
const DOWNLOAD: u8 = 1;

pub(crate) fn serve<D: Dictionary<'static>, A: Application<D>, const BUFFER: usize>(
    dictionary: &mut D,
    application: &mut A,
    request: &'static Request<BUFFER>,
) -> ! {
    loop {
        let request = black_box(request);
        let outcome = match request.kind {
            UPLOAD => upload(dictionary, request, application),
            DOWNLOAD => download(dictionary, request, application),
            _ => info(dictionary, request),
        };
        black_box(outcome.map_or_else(|abort| abort.0, |()| 0));
    }
}

fn upload<D: Dictionary<'static>, A: Application<D>, const BUFFER: usize>(
    dictionary: &mut D,
    request: &Request<BUFFER>,
    application: &mut A,
) -> Result<(), AbortCode> {
    let value = dictionary.upload(request.index, request.sub, application)?;
    black_box(value.bytes());
    Ok(())
}

fn download<D: Dictionary<'static>, A: Application<D>, const BUFFER: usize>(
    dictionary: &mut D,
    request: &Request<BUFFER>,
    application: &mut A,
) -> Result<(), AbortCode> {
    let data = request.data.get(..request.length.into()).ok_or(AbortCode::TOO_LONG)?;
    dictionary.write(request.index, request.sub, data, application)?;
    Ok(())
}

fn info<D: Dictionary<'static>, const BUFFER: usize>(
    dictionary: &D,
    request: &Request<BUFFER>,
) -> Result<(), AbortCode> {
    let info = dictionary.info(dictionary.find(request.index, request.sub)?);
    black_box((info.data_type(), info.size(), info.is_readable(), info.is_writable()));
    Ok(())
}
