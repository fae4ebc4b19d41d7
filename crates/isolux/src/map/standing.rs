//! What a vertex says about the light on the elements around it.

use serde::{Deserialize, Serialize};

/// What a vertex stands for. Between vertices of different standing light is not interpolated: an
/// element takes the highest that it has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Standing {
    /// In a gap and on the border of its surface, where light comes in that does not reach far: the
    /// rim of the back of a cupboard.
    Rim,
    /// In a gap: something stands closer before it than elements are long.
    Gap,
    /// In the open.
    Open,
}

impl Standing {
    /// All of them, by rank from 1.
    pub const ALL: [Self; 3] = [Self::Rim, Self::Gap, Self::Open];

    /// The highest of those that are known.
    pub fn highest<const N: usize>(of: [Option<Self>; N]) -> Option<Self> {
        of.into_iter().max().flatten()
    }
}
