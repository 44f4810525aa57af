//! Characters of texts: how bytes stand for them, what is ASCII of them, and which nobody sees.

pub mod ascii;
pub mod encoding;
mod fit;
pub mod markdown;
pub mod visible;
