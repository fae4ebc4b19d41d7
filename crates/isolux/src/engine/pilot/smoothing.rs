//! Quadratic functions between the vertices that carry light, where it is smooth.

use super::Pilot;
use crate::engine::detail::bisect_twice;
use crate::engine::look::Look;
use crate::map::Standing;

impl Pilot<'_> {
    /// Bisects elements that readers interpolate twice once more; the light of the new vertices is that of the quadratic function
    /// that fits the vertices about them best. Costs no rays, and leaves half of the error of interpolation or less.
    pub(super) fn smooth(&mut self, look: &mut Look) {
        let first = self.subdivision.vertex_count();
        let is_open = |of: &Option<Standing>| *of == Some(Standing::Open);
        let mut open: Vec<bool> = self.standings.iter().map(is_open).collect();
        let leaves = self.subdivision.leaves();
        let corners: Vec<[u32; 3]> = leaves.map(|n| self.subdivision.node(n).0.vertices).collect();
        for error in look.errors.iter().filter(|e| !e.is_beset) {
            bisect_twice(&mut self.subdivision, error.node);
        }
        for vertex in &self.subdivision.vertices()[first..] {
            let ends = vertex.parents.expect("made by bisection");
            let within = ends.iter().all(|&end| open[end as usize]);
            open.push(within);
            self.standings.push(within.then_some(Standing::Open));
            self.known.push(ends.iter().any(|&end| self.known[end as usize]));
        }
        self.carriers.smooth(&self.subdivision, first, &corners, &open);
        self.gathered.resize(open.len(), false);
        look.elements = self.subdivision.elements();
        self.complete_rays();
        let gatherers = self.gatherers();
        self.complete_direct(&look.elements, &gatherers);
        self.complete_standings(&gatherers);
        self.indirect.resize(open.len(), crate::units::Rgb::BLACK);
        self.carriers.fill(&mut self.indirect);
        self.is_smoothed = true;
    }
}
