//! How much a file may ask for: far above scenes that can be solved, and low enough that a small
//! hostile file cannot take the memory of a machine.

/// Bytes of all files of a scene together.
pub(super) const BYTES: u64 = 1 << 28;
/// Bytes of one table of intensities.
pub(super) const TABLE_BYTES: u64 = 16 << 20;
/// Files one inside the other.
pub(super) const DEPTH: usize = 64;
/// Objects, modifiers and commands read, those of a repeated file counted every time.
pub(super) const VISITS: usize = 1 << 22;
/// Copies that one command makes.
pub(super) const COPIES: usize = 1 << 20;
/// Modifiers that differ.
pub(super) const MODIFIERS: usize = 1 << 18;
/// Modifiers one upon the other.
pub(super) const CHAIN: usize = 256;
/// Mixtures one in the other, each of which looks at two modifiers.
pub(super) const MIXTURES: usize = 8;
/// Triangles of the whole scene.
pub(super) const TRIANGLES: usize = 1 << 25;
/// Sources so wide that they are part of a sky.
pub(super) const SKIES: usize = 16;
/// Luminaires of the whole scene.
pub(super) const LUMINAIRES: usize = 1 << 18;
