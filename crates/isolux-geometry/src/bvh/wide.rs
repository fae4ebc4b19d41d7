//! The tree that rays walk: nodes with eight children, leaves of blocks with eight triangles, both
//! laid out component by component, so that one vector instruction treats eight of them.

/// Children of a node, and triangles of a block.
pub(super) const WIDTH: usize = 8;

/// Eight boxes and what is in them.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(super) struct Node {
    /// Low and high `x`, low and high `y`, low and high `z`; low > high where there is no child.
    pub(super) planes: [[f32; WIDTH]; 6],
    pub(super) children: [Reference; WIDTH],
}

/// Up to eight triangles of a leaf.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(super) struct Block {
    /// By corner and axis; NaN where there is no triangle.
    pub(super) corners: [[[f32; WIDTH]; 3]; 3],
    /// Index of the triangle, with [`Block::TRANSPARENT`] added where rays of `any_hit` pass.
    pub(super) labels: [u32; WIDTH],
}

/// What stands below: a node or the blocks of a leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub(super) struct Reference(pub(super) u32);

/// The tree.
#[derive(Clone, Debug, Default)]
pub(super) struct WideTree {
    pub(super) nodes: Vec<Node>,
    pub(super) blocks: Vec<Block>,
    /// `None` over no triangles.
    pub(super) root: Option<Reference>,
    /// Largest coordinate without its sign, metres.
    pub(super) reach: f32,
}

impl Node {
    /// No children.
    pub(super) const EMPTY: Self = {
        let (low, high) = ([f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]);
        Self { planes: [low, high, low, high, low, high], children: [Reference(0); WIDTH] }
    };
}

impl Block {
    /// No triangles.
    pub(super) const EMPTY: Self =
        Self { corners: [[[f32::NAN; WIDTH]; 3]; 3], labels: [u32::MAX; WIDTH] };

    /// Marks triangles that `any_hit` does not see.
    pub(super) const TRANSPARENT: u32 = 1 << 31;
}

impl Reference {
    const LEAF: u32 = 1 << 31;
    const COUNT_SHIFT: u32 = 28;

    /// Greatest number of blocks of a leaf.
    pub(super) const MAX_BLOCKS: usize = 4;

    pub(super) fn node(index: usize) -> Self {
        Self(index as u32)
    }

    pub(super) fn leaf(first_block: usize, blocks: usize) -> Self {
        Self(Self::LEAF | ((blocks as u32 - 1) << Self::COUNT_SHIFT) | first_block as u32)
    }

    /// The index of a node, or the first block and the number of blocks of a leaf.
    #[inline(always)]
    pub(super) fn target(self) -> Result<usize, (usize, usize)> {
        if self.0 & Self::LEAF == 0 {
            return Ok(self.0 as usize);
        }
        let count = (self.0 & !Self::LEAF) >> Self::COUNT_SHIFT;
        Err(((self.0 & ((1 << Self::COUNT_SHIFT) - 1)) as usize, count as usize + 1))
    }
}
