//! The files that a plant or parameter file names: each describes a device.

use crate::compile::is_known;
use crate::diag::{Diagnostic, codes, shorten};
use crate::files::{Loader, add_source, beside, may_be_specification};
use crate::source::{FileId, SourceMap, Spanned};

/// Adds the file that describes a device, which the file `root` names.
pub(crate) fn describing(
    sources: &mut SourceMap,
    root: FileId,
    name: &Spanned<String>,
    loader: &mut dyn Loader,
) -> Result<FileId, Box<Diagnostic>> {
    let refuse = |message: String| {
        let help = "name a specification, EDS or DCF relative to this file";
        Box::new(Diagnostic::new(codes::UNREADABLE, name.span, message).help(help))
    };
    let from = sources.file(root).name().to_owned();
    let bytes = loader
        .load(&name.value, &from)
        .map_err(|reason| refuse(format!("cannot read `{}`: {reason}", shorten(&name.value))))?;
    let is_specification = may_be_specification(&bytes);
    match add_source(sources, &beside(&from, &name.value), bytes) {
        Ok(id) if is_specification || is_known(sources.file(id)) => Ok(id),
        Err(diagnostic) if is_specification || diagnostic.code == codes::TOO_LARGE => {
            Err(Box::new(diagnostic.at(name.span)))
        }
        Ok(_) | Err(_) => Err(refuse(format!("`{}` does not describe a device", shorten(&name.value)))),
    }
}
