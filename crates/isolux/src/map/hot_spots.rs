//! Little surface with much of the light: the inside of lamps, housings behind floodlights.

use super::IlluminationMap;
use isolux_geometry::Point;

/// The brightest part of the surface that is looked at, and the share of all light from which on that is much.
const BRIGHTEST: f64 = 0.01;
const MUCH: f64 = 1.0 / 3.0;

/// The brightest hundredth of the known surface, where it has a third of all light or more: errors are relative to three times
/// the mean of all else then, or more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HotSpots {
    /// Share of all light on the known surface.
    pub share: f64,
    /// Mean illuminance of all else, lx.
    pub others_lx: f64,
    /// Where it is brightest, and the illuminance there, lx.
    pub brightest: (Point, f64),
}

impl IlluminationMap {
    /// Little surface that decides what errors of the scene are relative to, if there is any.
    pub fn hot_spots(&self) -> Option<HotSpots> {
        let known = self.elements.vertices().iter().zip(&self.values);
        let known = known.filter_map(|(v, value)| Some((v, value.as_ref()?.illuminance_lx())));
        let mut known: Vec<(Point, f64, f64)> =
            known.map(|(vertex, lx)| (vertex.position, vertex.area_m2, lx)).collect();
        known.sort_by(|a, b| b.2.total_cmp(&a.2));
        let &(position, _, most_lx) = known.first()?;
        let all_m2: f64 = known.iter().map(|of| of.1).sum();
        let all_lm: f64 = known.iter().map(|of| of.1 * of.2).sum();
        let (mut left_m2, mut hot_lm) = (BRIGHTEST * all_m2, 0.0);
        for (_, area_m2, lx) in known {
            let counted_m2 = area_m2.min(left_m2);
            hot_lm += counted_m2 * lx;
            left_m2 -= counted_m2;
        }
        let share = hot_lm / all_lm;
        let others_lx = (all_lm - hot_lm).max(0.0) / ((1.0 - BRIGHTEST) * all_m2);
        (share >= MUCH).then_some(HotSpots { share, others_lx, brightest: (position, most_lx) })
    }
}
