//! What an SDO channel is at between two frames.

use od_spec::model::EntryId;

/// What a server and its client are at.
#[derive(Debug, Clone, Default)]
pub(super) struct Transfer {
    pub(super) id: Option<EntryId>,
    pub(super) data: Vec<u8>,
    pub(super) phase: Phase,
}

/// Where a transfer is.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) enum Phase {
    /// Nothing is going on, or nothing of which the trace shows the beginning.
    #[default]
    Idle,
    /// A value is written in one frame, which the server has not confirmed.
    Expedited,
    /// A value goes to the server in segments, and this is its last or not.
    Download(Last),
    /// A value comes from the server in segments.
    Upload,
    /// A block goes to the server.
    BlockDownload(Block),
    /// A block comes from the server.
    BlockUpload(Block),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Last {
    No,
    Yes,
}

/// Segments of a block that are not yet confirmed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Block {
    /// They come, up to a number of them.
    Segments { size: u8, open: Vec<[u8; 7]> },
    /// The other side confirms them.
    Confirm { open: Vec<[u8; 7]>, last: Last },
    /// All of them are confirmed.
    End,
}
