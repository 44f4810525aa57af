//! Devices and what their EDS files say about themselves.

use super::read::{Field, Reader, reader};
use crate::ast::{DeviceDecl, FileDecl, Name};
use crate::diag::Diagnostics;
use crate::keys::{device_keys, file_keys};

device_keys! { reader pub(super) fn device(key: Name) -> DeviceDecl }
file_keys! { reader fn file() -> FileDecl }

impl Field for Option<FileDecl> {
    fn read(reader: Reader<'_>, key: &str, diagnostics: &mut Diagnostics) -> Self {
        reader.child(key).map(|child| file(child, diagnostics))
    }
}
