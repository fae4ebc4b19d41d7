//! The tree that rays walk: nodes with 8 or 16 children and leaves of up to 16 triangles, both laid
//! out component by component, so that one vector instruction treats many of them.
//!
//! A leaf takes no more room than its triangles: row after row of as many numbers as it has triangles.
//! Nodes lie apart from leaves: they are few, and rays go through the same ones over and over, so
//! they should share cache lines and pages with each other only.

use super::bounds::Bounds;
use super::memory::{LINE, Line, with_capacity, words_mut};
use std::marker::PhantomData;

/// A node: the boxes of `W` children and what is in them.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Node<const W: usize> {
    /// Low and high `x`, low and high `y`, low and high `z`; low > high where there is no child.
    pub(super) planes: [[f32; W]; 6],
    pub(super) children: [Reference; W],
}

impl<const W: usize> Node<W> {
    /// No children.
    pub(super) const EMPTY: Self = {
        let (low, high) = ([f32::INFINITY; W], [f32::NEG_INFINITY; W]);
        Self { planes: [low, high, low, high, low, high], children: [Reference(0); W] }
    };

    /// The child in a lane.
    #[inline(always)]
    pub(super) fn child(&self, lane: u32) -> Reference {
        self.children[lane as usize % W]
    }

    /// Cache lines of a node.
    pub(super) const LINES: usize = size_of::<Self>() / size_of::<Line>();
}

/// Greatest number of children of a node.
pub(super) const MAX_WIDTH: usize = 16;

/// Greatest number of triangles of a leaf.
pub(super) const MAX_LEAF: usize = 16;

/// Rows of a leaf: nine of coordinates, by corner and axis, and the labels.
const ROWS: usize = 10;

/// Marks the label of a triangle that `any_hit` does not see; the rest is the index of the triangle.
pub(super) const TRANSPARENT: u32 = 1 << 31;

/// 1 to [`MAX_LEAF`] triangles of a tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leaf<'a> {
    /// The first row. Behind the last one there are at least [`MAX_LEAF`] words more.
    words: *const u32,
    /// Number of triangles, and the words from row to row.
    pub(super) count: usize,
    tree: PhantomData<&'a [Line]>,
}

impl Leaf<'_> {
    /// Cache lines of a leaf.
    const fn lines(count: usize) -> usize {
        (ROWS * count).div_ceil(LINE)
    }

    /// Three coordinates of the first corners of the triangles from `first` on; those of the next
    /// corners follow after [`Leaf::corner_stride`]. [`MAX_LEAF`] numbers can be read, of which those
    /// behind the last triangle have no meaning.
    #[inline(always)]
    pub(super) fn first_corners(&self, axes: [usize; 3], first: usize) -> [*const f32; 3] {
        axes.map(|axis| self.row(axis, first))
    }

    /// Numbers from the coordinates of one corner to those of the next.
    #[inline(always)]
    pub(super) fn corner_stride(&self) -> usize {
        3 * self.count
    }

    #[inline(always)]
    fn row(&self, row: usize, first: usize) -> *const f32 {
        debug_assert!(row < ROWS && first < self.count);
        self.words.wrapping_add(row * self.count + first).cast()
    }

    #[inline(always)]
    pub(super) fn coordinate(&self, corner: usize, axis: usize, triangle: usize) -> f32 {
        // SAFETY: within the leaf, where the row is.
        #[allow(unsafe_code, reason = "a number of a tree that cannot change, without a check")]
        unsafe {
            *self.row(3 * corner + axis, triangle)
        }
    }

    #[inline(always)]
    pub(super) fn label(&self, triangle: usize) -> u32 {
        // SAFETY: the last row of the leaf.
        #[allow(unsafe_code, reason = "a number of a tree that cannot change, without a check")]
        unsafe {
            *self.row(ROWS - 1, triangle).cast()
        }
    }
}

/// A triangle as a leaf holds it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Labelled {
    pub(super) corners: [[f32; 3]; 3],
    pub(super) label: u32,
}

/// What stands below: a node or a leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub(super) struct Reference(pub(super) u32);

impl Reference {
    const LEAF: u32 = 1 << 31;
    const COUNT_SHIFT: u32 = 27;

    /// Lines that a reference reaches.
    const LINES: usize = 1 << Self::COUNT_SHIFT;

    #[inline(always)]
    pub(super) fn is_leaf(self) -> bool {
        self.0 & Self::LEAF != 0
    }

    /// The first line of a node.
    #[inline(always)]
    fn node(self) -> usize {
        self.0 as usize
    }

    /// The first line of a leaf, and its number of triangles.
    #[inline(always)]
    fn leaf(self) -> (usize, usize) {
        let line = self.0 as usize & (Self::LINES - 1);
        (line, ((self.0 & !Self::LEAF) >> Self::COUNT_SHIFT) as usize + 1)
    }
}

/// The tree, `W` children to a node.
#[derive(Clone, Debug)]
pub(super) struct WideTree<const W: usize> {
    nodes: Vec<Line>,
    leaves: Vec<Line>,
    /// `None` over no triangles.
    pub(super) root: Option<Reference>,
    /// The box around everything.
    pub(super) bounds: Bounds,
}

impl<const W: usize> WideTree<W> {
    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        (self.nodes.capacity() + self.leaves.capacity()) * size_of::<Line>()
    }

    #[inline(always)]
    pub(super) fn node(&self, reference: Reference) -> &Node<W> {
        debug_assert!(
            !reference.is_leaf() && reference.node() + Node::<W>::LINES <= self.nodes.len()
        );
        // SAFETY: a reference to a node comes from `Builder::add_node`, which appended all its
        // lines. Lines are never taken away and are aligned as nodes are, and any bits are a node.
        #[allow(unsafe_code, reason = "bits of lines seen as a node, without a check per step")]
        unsafe {
            &*self.nodes.as_ptr().add(reference.node()).cast()
        }
    }

    #[inline(always)]
    pub(super) fn leaf(&self, reference: Reference) -> Leaf<'_> {
        debug_assert!(reference.is_leaf());
        let (line, count) = reference.leaf();
        let words = self.leaves.as_ptr().wrapping_add(line).cast();
        Leaf { words, count, tree: PhantomData }
    }

    /// The first line of what stands at a reference, and the number of its lines.
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    pub(super) fn lines_of(&self, reference: Reference) -> (*const Line, usize) {
        if reference.is_leaf() {
            let (line, count) = reference.leaf();
            (self.leaves.as_ptr().wrapping_add(line), Leaf::lines(count))
        } else {
            (self.nodes.as_ptr().wrapping_add(reference.node()), Node::<W>::LINES)
        }
    }
}

/// More lines than references can tell apart.
#[derive(Clone, Copy, Debug)]
pub(super) struct TooLarge;

/// A tree that grows.
#[derive(Debug, Default)]
pub(super) struct Builder<const W: usize> {
    nodes: Vec<Line>,
    leaves: Vec<Line>,
}

impl<const W: usize> Builder<W> {
    /// Lines behind the last leaf, which vector loads of its last rows may touch.
    const BEHIND: usize = MAX_LEAF.div_ceil(LINE);

    /// Appends room for a node.
    pub(super) fn add_node(&mut self) -> Result<Reference, TooLarge> {
        Ok(Reference(add_lines(&mut self.nodes, Node::<W>::LINES)?))
    }

    /// Fills the room of a node.
    pub(super) fn set_node(&mut self, reference: Reference, node: &Node<W>) {
        let place = words_mut(&mut self.nodes[reference.node()..]);
        let rows = node.planes.iter().flatten().map(|x| x.to_bits());
        let children = node.children.iter().map(|child| child.0);
        place.iter_mut().zip(rows.chain(children)).for_each(|(word, bits)| *word = bits);
    }

    /// Appends a leaf of 1 to [`MAX_LEAF`] triangles.
    pub(super) fn add_leaf(&mut self, triangles: &[Labelled]) -> Result<Reference, TooLarge> {
        let count = triangles.len();
        let line = add_lines(&mut self.leaves, Leaf::lines(count))?;
        let words = words_mut(&mut self.leaves[line as usize..]);
        for (place, triangle) in triangles.iter().enumerate() {
            for (row, x) in triangle.corners.iter().flatten().enumerate() {
                words[row * count + place] = x.to_bits();
            }
            words[(ROWS - 1) * count + place] = triangle.label;
        }
        Ok(Reference(Reference::LEAF | (count as u32 - 1) << Reference::COUNT_SHIFT | line))
    }

    /// The tree, in no more memory than it needs.
    pub(super) fn finish(self, root: Option<Reference>, bounds: Bounds) -> WideTree<W> {
        let Self { nodes, leaves } = self;
        WideTree { nodes: packed(&nodes, 0), leaves: packed(&leaves, Self::BEHIND), root, bounds }
    }
}

/// Appends lines of zeros and returns the number of the first.
fn add_lines(to: &mut Vec<Line>, lines: usize) -> Result<u32, TooLarge> {
    let first = to.len();
    to.resize(first + lines, Line::default());
    if first < Reference::LINES { Ok(first as u32) } else { Err(TooLarge) }
}

/// The same lines, and so many of zeros, in memory of just that size.
fn packed(lines: &[Line], behind: usize) -> Vec<Line> {
    let mut packed = with_capacity(lines.len() + behind);
    packed.extend_from_slice(lines);
    packed.resize(lines.len() + behind, Line::default());
    packed
}
