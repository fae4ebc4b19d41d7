//! A closed room with furniture, all of it welded closed surfaces, and random rays in it.

use isolux_geometry::bvh::{InstructionSet, Preset};
use isolux_geometry::{Bvh, End, Ray, TriangleMesh};
use std::collections::HashMap;

/// Numbers in [0, 1) from a counter (SplitMix64).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub(crate) fn unit(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / (1_u64 << 24) as f32
    }

    pub(crate) fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.bits() % count as u64) as usize
    }

    /// Uniform in the cube, hence not of length one.
    pub(crate) fn direction(&mut self) -> [f32; 3] {
        [0; 3].map(|_| self.between(-1.0, 1.0))
    }
}

/// Adds a box with `cells` squares along each axis, welded; the front is outside unless `inward`.
fn add_box(
    mesh: &mut TriangleMesh,
    cells: [usize; 3],
    inward: bool,
    place: impl Fn([f32; 3]) -> [f32; 3],
) {
    let mut vertices = HashMap::new();
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for (side, i, j) in
            (0..2 * cells[u] * cells[v]).map(|k| (k % 2, k / 2 % cells[u], k / 2 / cells[u]))
        {
            let mut corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(di, dj)| {
                let mut grid = [0; 3];
                (grid[axis], grid[u], grid[v]) = (side * cells[axis], i + di, j + dj);
                *vertices.entry(grid).or_insert_with(|| {
                    let unit = |axis: usize| grid[axis] as f32 / cells[axis] as f32;
                    mesh.positions.push(place([unit(0), unit(1), unit(2)]));
                    mesh.positions.len() as u32 - 1
                })
            });
            if (side == 0) != inward {
                corners.reverse();
            }
            let [a, b, c, d] = corners;
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
}

/// Where a box of furniture stands: turned about the vertical through its middle.
fn turned(low: [f32; 3], size: [f32; 3], angle_rad: f32) -> impl Fn([f32; 3]) -> [f32; 3] {
    move |unit| {
        let (x, y) = ((unit[0] - 0.5) * size[0], (unit[1] - 0.5) * size[1]);
        let (sin, cos) = angle_rad.sin_cos();
        [
            low[0] + 0.5 * size[0] + cos * x - sin * y,
            low[1] + 0.5 * size[1] + sin * x + cos * y,
            low[2] + unit[2] * size[2],
        ]
    }
}

/// A ball out of a box.
fn ball(centre: [f32; 3], radius: f32) -> impl Fn([f32; 3]) -> [f32; 3] {
    move |unit| {
        let v = unit.map(|x| 2.0 * x - 1.0);
        let scale = radius / (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
        [0, 1, 2].map(|axis| centre[axis] + v[axis] * scale)
    }
}

pub(crate) const ROOM: [f32; 3] = [16.0, 12.0, 3.2];

/// A cube of 12 triangles seen from inside, from -1 to 1.
pub(crate) fn cube() -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    add_box(&mut mesh, [1; 3], true, |unit| unit.map(|x| 2.0 * x - 1.0));
    mesh
}

/// 11,592 triangles: a hall with rows of desks and chairs, luminaires, columns and balls. Parts
/// that stand on the floor reach a little below it.
pub(crate) fn hall() -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    let mut random = Random(1);
    add_box(&mut mesh, [16, 12, 3], true, |unit| [0, 1, 2].map(|axis| unit[axis] * ROOM[axis]));
    for k in 0..60 {
        let (x, y) = (1.0 + (k % 10) as f32 * 1.5, 1.0 + (k / 10) as f32 * 1.9);
        let angle_rad = random.between(-0.4, 0.4);
        let mut part = |low: [f32; 3], size: [f32; 3]| {
            add_box(&mut mesh, [1; 3], false, turned(low, size, angle_rad));
        };
        part([x - 0.6, y - 0.4, 0.72], [1.2, 0.8, 0.03]);
        for (dx, dy) in [(-0.55, -0.35), (0.5, -0.35), (-0.55, 0.3), (0.5, 0.3)] {
            part([x + dx, y + dy, -0.01], [0.05, 0.05, 0.74]);
        }
        part([x - 0.25, y + 0.1, 0.8], [0.5, 0.03, 0.35]);
        part([x - 0.22, y - 0.7, 0.42], [0.44, 0.44, 0.05]);
        part([x - 0.22, y - 0.75, 0.46], [0.44, 0.03, 0.5]);
        part([x - 0.05, y - 0.53, -0.01], [0.1, 0.1, 0.44]);
    }
    for k in 0..40 {
        let (x, y) = (1.0 + (k % 8) as f32 * 1.9, 1.0 + (k / 8) as f32 * 2.4);
        add_box(&mut mesh, [1; 3], false, turned([x, y, 3.0], [1.2, 0.2, 0.06], 0.0));
    }
    for k in 0..8 {
        let centre = [1.8 + (k % 4) as f32 * 4.1, 1.95 + (k / 4) as f32 * 7.6, 1.3];
        add_box(&mut mesh, [6; 3], false, ball(centre, 0.3));
    }
    for k in 0..6 {
        let low = [3.3 + (k % 3) as f32 * 4.5, 3.9 + (k / 3) as f32 * 3.8, -0.01];
        add_box(&mut mesh, [1, 1, 1], false, turned(low, [0.3, 0.3, 3.3], 0.6));
    }
    mesh
}

/// A ray without end.
pub(crate) fn ray(origin: [f32; 3], direction: [f32; 3]) -> Ray {
    Ray { origin: origin.into(), direction, end: End::At(f32::INFINITY), skip: None }
}

/// A ray from inside the hall, above the furniture, in any direction.
pub(crate) fn random_ray(random: &mut Random) -> Ray {
    let origin = [
        random.between(0.1, ROOM[0] - 0.1),
        random.between(0.1, ROOM[1] - 0.1),
        random.between(1.7, 2.9),
    ];
    ray(origin, random.direction())
}

/// A point on an edge of the mesh, in one case of four a corner.
pub(crate) fn edge_point(mesh: &TriangleMesh, random: &mut Random) -> [f32; 3] {
    let corners = mesh.triangles[random.below(mesh.len())];
    let k = random.below(3);
    let (a, b) = (corners[k] as usize, corners[(k + 1) % 3] as usize);
    let weight = if random.below(4) == 0 { 0.0 } else { random.unit() };
    [0, 1, 2].map(|axis| {
        let (a, b) = (mesh.positions[a][axis], mesh.positions[b][axis]);
        a + (b - a) * weight
    })
}

/// The same ray towards a point.
pub(crate) fn aimed(ray: Ray, target: [f32; 3]) -> Ray {
    let origin = ray.origin.to_f32();
    Ray { direction: [0, 1, 2].map(|axis| target[axis] - origin[axis]), ..ray }
}

/// A hierarchy for every preset and every set of instructions that this processor has.
pub(crate) fn kernels(
    mesh: &TriangleMesh,
    is_transparent: impl Fn(u32) -> bool + Sync,
) -> Vec<Bvh> {
    let available = InstructionSet::ALL.into_iter().filter(|set| set.is_available());
    available
        .flat_map(|set| Preset::ALL.map(|preset| (preset, set)))
        .map(|(preset, set)| Bvh::build_with(preset, set, mesh.clone(), &is_transparent))
        .collect()
}
