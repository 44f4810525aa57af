//! Characters of texts: how bytes stand for them, what is ASCII of them, which nobody sees, and which names no file can have.

pub mod ascii;
pub mod encoding;
pub mod file_name;
mod fit;
pub mod markdown;
pub mod visible;
