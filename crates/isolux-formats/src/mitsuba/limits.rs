//! How much a file may ask for: far above scenes that can be solved, and low enough that a small
//! hostile file cannot take the memory of a machine.

/// Bytes of all XML files of a scene together.
pub(super) const BYTES: u64 = 1 << 26;
/// Nodes of all of them.
pub(super) const NODES: usize = 1 << 21;
/// Elements, or files, one inside the other.
pub(super) const DEPTH: usize = 64;
/// Bytes of one attribute, parameters filled in.
pub(super) const ATTRIBUTE_BYTES: usize = 1 << 16;
/// Shapes, those of a repeated group counted every time.
pub(super) const SHAPES: usize = 1 << 18;
/// Triangles of the whole scene.
pub(super) const TRIANGLES: usize = 1 << 25;
/// Luminaires of the whole scene.
pub(super) const LUMINAIRES: usize = 1 << 18;
