//! Quadratic functions between the vertices that carry light, where it is smooth.

use super::look::Survey;
use super::state::Pilot;
use crate::elements::Elements;
use crate::engine::occlusion::barriers;
use crate::map::Standing;
use crate::units::Rgb;
use std::time::Instant;

impl Pilot<'_> {
    /// Bisects elements that readers interpolate twice once more; the light of the new vertices is that of the quadratic function
    /// that fits the vertices about them best. Costs no rays, and leaves half of the error of interpolation or less.
    pub(super) fn smooth(&mut self, look: &mut Survey, max_vertices: usize) {
        let started = Instant::now();
        let first = self.mesh.subdivision.vertex_count();
        let is_open = |of: &Option<Standing>| *of == Some(Standing::Open);
        let mut open: Vec<bool> = self.near.standings.iter().map(is_open).collect();
        let leaves = self.mesh.subdivision.leaves();
        let corners: Vec<[u32; 3]> =
            leaves.map(|n| self.mesh.subdivision.node(n).0.vertices).collect();
        for error in look.errors.iter().filter(|e| !e.is_beset || e.is_at_wall) {
            self.mesh.subdivision.bisect_twice(error.node);
        }
        let mut rows = look.walls.refine(&mut self.mesh.subdivision, max_vertices);
        for vertex in &self.mesh.subdivision.vertices()[first..] {
            let ends = vertex.parents.expect("made by bisection");
            let within = ends.iter().all(|&end| open[end as usize]);
            open.push(within);
            self.near.standings.push(within.then_some(Standing::Open));
            self.near.known.push(ends.iter().any(|&end| self.near.known[end as usize]));
        }
        rows.retain(|row| open[row.vertex as usize]);
        // What stands on a vertex stands close to the elements about it, which are left as they are.
        self.near.footprints.skip(&self.mesh.subdivision);
        self.complete_rays();
        let gatherers = self.gatherers();
        let vertices = self.mesh.subdivision.vertices();
        let of = |v: u32| {
            let lx = self.indirect.lx.get(v as usize).map(|lx| lx.luminance());
            (vertices[v as usize].position, lx)
        };
        let keep_seen = |from: u32, some: &mut Vec<u32>| {
            let above = &gatherers[from as usize].surface;
            barriers::keep_seen(self.scene, (of(from).0, above), of, some);
        };
        let before_walls = (&look.walls, rows.as_slice());
        self.mesh.carriers.smooth(
            &self.mesh.subdivision,
            first,
            &corners,
            &open,
            before_walls,
            keep_seen,
        );
        look.elements = self.mesh.subdivision.elements();
        // Guesses for those that carry light.
        for vertex in &self.mesh.subdivision.vertices()[first..] {
            let ends = vertex.parents.expect("made by bisection");
            let sum: Rgb = ends.into_iter().map(|end| self.indirect.lx[end as usize]).sum();
            self.indirect.lx.push(sum / 2.0);
        }
        for row in &rows {
            self.indirect.lx[row.vertex as usize] = self.indirect.lx[row.of as usize];
        }
        self.settle(&look.elements);
        self.indirect.is_smoothed = true;
        self.costs.smoothing.add(started.elapsed(), self.mesh.subdivision.vertex_count() as f64);
    }

    /// What new vertices that do not gather have: direct light, and indirect light from those that they wait for.
    pub(super) fn settle(&mut self, elements: &Elements) {
        let vertices = self.mesh.subdivision.vertex_count();
        self.indirect.gathered.resize(vertices, false);
        self.complete_rays();
        let gatherers = self.gatherers();
        self.complete_direct(elements, &gatherers);
        self.look_for_torn();
        self.complete_standings(&gatherers);
        self.indirect.lx.resize(vertices, Rgb::BLACK);
        self.mesh.carriers.fill(&mut self.indirect.lx);
    }
}
