//! What can be wrong with packed bytes.

/// Why packed bytes cannot be unpacked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Damage {
    Header,
    CutShort,
    Code,
    Leftover,
}

impl Damage {
    pub(super) const fn what(self) -> &'static str {
        match self {
            Self::Header => "the compressed data starts with an unknown byte",
            Self::CutShort => "the compressed data is cut short",
            Self::Code => "the compressed data holds an impossible code",
            Self::Leftover => "the compressed data is longer than its count says",
        }
    }
}
