//! The lit part of the surface, and small parts of it with much of the light: the inside of lamps, housings behind
//! floodlights.

use super::IlluminationMap;
use isolux_geometry::Point;

/// The share of all light that may fall on surface that does not count as lit. Wide ground outside of a room has less.
const UNLIT_SHARE: f64 = 1e-4;
/// The brightest part of the lit surface that is looked at.
const BRIGHTEST: f64 = 0.01;
/// The share of all light from which on that part has much of it.
const MUCH: f64 = 1.0 / 3.0;

/// The areas that a map knows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KnownSurface {
    /// Area with a value, m2.
    pub all_m2: f64,
    /// The lit part of it, m2: the brightest surface with all but a ten-thousandth of the light.
    pub lit_m2: f64,
}

/// The brightest hundredth of the lit surface, where it has a third of all light or more: errors are relative to three times
/// the mean of the rest then, or more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HotSpots {
    /// Share of all light on the lit surface.
    pub share: f64,
    /// Mean illuminance of the rest of the lit surface, lx.
    pub others_lx: f64,
    /// The area of that rest, m2.
    pub others_m2: f64,
    /// Where it is brightest, and the illuminance there, lx.
    pub brightest: (Point, f64),
}

/// The light at a vertex.
#[derive(Clone, Copy)]
struct Lit {
    position: Point,
    area_m2: f64,
    lx: f64,
}

impl IlluminationMap {
    /// The known surface and its lit part.
    pub fn known_surface(&self) -> KnownSurface {
        let known = self.known_light();
        let area_m2 = |of: &[Lit]| of.iter().map(|v| v.area_m2).sum();
        KnownSurface { all_m2: area_m2(&known), lit_m2: area_m2(&lit(known)) }
    }

    /// Little surface that decides what errors of the scene are relative to, if there is any.
    pub fn hot_spots(&self) -> Option<HotSpots> {
        let lit = lit(self.known_light());
        let &Lit { position, lx: most_lx, .. } = lit.first()?;
        let all_m2: f64 = lit.iter().map(|of| of.area_m2).sum();
        let all_lm: f64 = lit.iter().map(|of| of.area_m2 * of.lx).sum();
        let (mut left_m2, mut hot_lm) = (BRIGHTEST * all_m2, 0.0);
        for Lit { area_m2, lx, .. } in lit {
            let counted_m2 = area_m2.min(left_m2);
            hot_lm += counted_m2 * lx;
            left_m2 -= counted_m2;
        }
        let share = hot_lm / all_lm;
        let others_m2 = (1.0 - BRIGHTEST) * all_m2;
        let others_lx = (all_lm - hot_lm).max(0.0) / others_m2;
        let brightest = (position, most_lx);
        (share >= MUCH).then_some(HotSpots { share, others_lx, others_m2, brightest })
    }

    fn known_light(&self) -> Vec<Lit> {
        let known = self.elements.vertices().iter().zip(&self.values);
        let of = known.filter_map(|(v, value)| Some((v, value.as_ref()?.illuminance_lx())));
        of.map(|(v, lx)| Lit { position: v.position, area_m2: v.area_m2, lx }).collect()
    }
}

/// The lit part of a surface, the brightest first; nothing where all of it is dark.
fn lit(mut known: Vec<Lit>) -> Vec<Lit> {
    known.retain(|of| of.lx > 0.0);
    known.sort_by(|a, b| b.lx.total_cmp(&a.lx));
    let mut left_lm = (1.0 - UNLIT_SHARE) * known.iter().map(|of| of.area_m2 * of.lx).sum::<f64>();
    let is_lit = |of: &&Lit| {
        let is_lit = left_lm > 0.0;
        left_lm -= of.area_m2 * of.lx;
        is_lit
    };
    known.iter().take_while(is_lit).copied().collect()
}
