//! Characters of texts: how bytes represent them, which are ASCII, which are invisible, and which names no file can
//! have.

pub mod ascii;
pub mod encoding;
pub mod file_name;
mod fit;
pub(crate) mod look_alike;
pub mod markdown;
pub mod visible;
