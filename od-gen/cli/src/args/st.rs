//! Arguments of `odgen st`.

use std::path::PathBuf;

use clap::Args;

use super::Messages;

#[derive(Debug, Args)]
pub(crate) struct StArgs {
    /// Specifications, EDS, DCF, XDD or XDC files [default: the `*.od.yaml` of the current directory]
    pub specs: Vec<PathBuf>,

    /// Directory for the files
    #[arg(long, short, default_value = "generated/st", value_name = "DIR")]
    pub out: PathBuf,

    /// Only these devices
    #[arg(long, value_name = "KEY")]
    pub device: Vec<String>,

    /// The node-ID (1 to 127) that COB-IDs and values are for [default: that of a DCF; else such constants have no node-ID in them]
    #[arg(long, value_name = "ID")]
    pub node: Option<String>,

    /// Language of the comments, such as `en` or `de` [default: the first of the specification]
    #[arg(long, visible_alias = "language", value_name = "CODE")]
    pub lang: Option<String>,

    /// Replace files of these names that odgen did not make
    #[arg(long)]
    pub force: bool,

    #[command(flatten)]
    pub messages: Messages,
}
