//! How much a file may ask for. Each limit is far above scenes that can be solved, and low enough
//! that a small hostile file cannot take the memory of a machine.

/// Bytes of JSON; real scenes have some megabytes.
pub(super) const JSON_BYTES: u64 = 256 << 20;
/// Objects in the JSON; each becomes some hundred bytes.
pub(super) const JSON_OBJECTS: u64 = 1 << 22;
/// Values in the JSON, objects and numbers alike; each becomes up to 32 bytes.
pub(super) const JSON_VALUES: u64 = 1 << 26;
/// Bytes of a whole file and of all its buffers together: what 32 bits of GLB can say.
pub(super) const BUFFER_BYTES: u64 = 1 << 32;
/// Bytes that compressed parts may unpack to together: as much as the largest placed scene holds.
pub(super) const UNPACKED_BYTES: u64 = 1 << 31;
/// Copies of a mesh that one node may place (EXT_mesh_gpu_instancing), and all of them together.
pub(super) const INSTANCES: usize = 1 << 20;
/// Bytes of all pictures together as stored.
pub(super) const PICTURE_BYTES: u64 = 1 << 30;
/// Bytes of one photometric file.
pub(super) const PROFILE_BYTES: u64 = 16 << 20;
/// Elements of an accessor: the corners of all triangles.
pub(super) const ELEMENTS: u64 = 3 * TRIANGLES;
/// Primitives of the placed scene; about half a kilobyte each, however small they are.
pub(super) const SHAPES: u64 = 1 << 21;
/// Vertices of the placed scene; about 2 GiB as positions, normals and texture coordinates.
pub(super) const VERTICES: u64 = 1 << 25;
/// Triangles of the placed scene.
pub(super) const TRIANGLES: u64 = 1 << 25;
/// Pixels of one picture: 8192 x 8192.
pub(super) const PICTURE_PIXELS: u64 = 1 << 26;
/// Pixels of all pictures together.
pub(super) const ALL_PIXELS: u64 = 1 << 28;
/// Levels of nodes below a root.
pub(super) const NODE_DEPTH: usize = 1024;
/// Problems shown of one file.
pub(super) const PROBLEMS: usize = 100;
