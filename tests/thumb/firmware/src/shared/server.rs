// The same server for every dictionary that is measured: an endless loop over requests that come from outside, as an SDO
// server gets them. What it answers with leaves it through `black_box`, so that nothing is left out.

use core::hint::black_box;

use firmware_glue::{AbortCode, Application, Dictionary};

/// A request. The optimiser does not see what is in it.
struct Request {
    index: u16,
    sub: u8,
    kind: u8,
    length: u8,
    data: [u8; 16],
}

const UPLOAD: u8 = 0;
const DOWNLOAD: u8 = 1;

static REQUEST: Request = Request { index: 0, sub: 0, kind: 0, length: 0, data: [0; 16] };

pub(crate) fn serve<D: Dictionary, A: Application<D>>(dictionary: &mut D, application: &mut A) -> ! {
    loop {
        let request = black_box(&REQUEST);
        let outcome = match request.kind {
            UPLOAD => upload(dictionary, request, application),
            DOWNLOAD => download(dictionary, request, application),
            _ => info::<D>(request),
        };
        black_box(outcome.map_or_else(|abort| abort.0, |()| 0));
    }
}

fn upload<D: Dictionary, A: Application<D>>(
    dictionary: &mut D,
    request: &Request,
    application: &mut A,
) -> Result<(), AbortCode> {
    let value = dictionary.upload(request.index, request.sub, application)?;
    black_box(value.bytes());
    Ok(())
}

fn download<D: Dictionary, A: Application<D>>(
    dictionary: &mut D,
    request: &Request,
    application: &mut A,
) -> Result<(), AbortCode> {
    let data = request.data.get(..request.length.into()).ok_or(AbortCode::TOO_LONG)?;
    dictionary.write(request.index, request.sub, data, application)?;
    Ok(())
}

fn info<D: Dictionary>(request: &Request) -> Result<(), AbortCode> {
    let info = D::info(D::find(request.index, request.sub)?);
    black_box((info.data_type(), info.size(), info.is_readable(), info.is_writable()));
    Ok(())
}
