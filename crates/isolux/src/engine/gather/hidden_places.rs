//! Hidden places: places that no light can reach.
//!
//! A receiver in the floor below a cabinet is neither dark nor lit, and no light must be interpolated from there or
//! to there. A place is open if a luminaire shines on it, if it sees out of the scene, or if it sees an open place.
//! All other places are hidden, in solids and in closed boxes that are painted inside. A ray is judged at the very
//! spot where it ends, not by an element that may reach below the wall of a box. Of the element's vertices those
//! count that the spot sees, except those that something stands on.

use super::gatherer::Gatherer;
use crate::elements::{Elements, table_in_order};
use crate::engine::light::Lighting;
use crate::engine::occlusion::{Footprints, nearby};
use crate::engine::ray::{Deadline, Dice, PathEnd, SurfacePoint, follow};
use crate::sampling::{CosineHemisphere, Key, Sequence};
use crate::scene::{Finish, Scene};
use crate::units::Rgb;
use isolux_geometry::{Point, Ray};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// The most rays that look for light. A place that sees it in less than a tenth of its hemisphere is still found with
/// a chance of 19 in 20.
const MOST_RAYS: u32 = 32;

/// The distance beyond a vertex to which rays look at it, as a share of their length. A vertex that lies in a wall is
/// then not seen from behind that wall.
const BEYOND_VERTEX_SHARE: f64 = 1e-3;

/// The inputs of a search for open vertices of a mesh.
pub(crate) struct Sight<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) lighting: &'a Lighting<'a>,
    pub(crate) elements: &'a Elements,
    /// The gatherers of all vertices of the elements.
    pub(crate) gatherers: &'a [Gatherer],
    /// Places that light reaches over specular surfaces.
    pub(crate) reached: &'a [SurfacePoint],
    /// Vertices that something stands on, which are seen from both of its sides.
    pub(crate) footprints: &'a Footprints,
    pub(crate) key: Key,
    /// The end of the time. Vertices whose turn comes after it count as open, unless they see nothing that is.
    pub(crate) end: &'a Deadline,
}

/// An element: the number by which its places are drawn, and the positions of its corners.
pub(crate) type Element = (u32, [[u64; 3]; 3]);

/// The places of each element from which no lit surface was seen. Vertices may be found to be open later, but this
/// stays true, also for later pilots of a run.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Unlit(
    #[serde(serialize_with = "table_in_order")] pub(crate) HashMap<Element, u16>,
);

/// Whether a place is cut off from the light of its element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum CutOff {
    /// Light reaches the place, but it sees no open vertex of its element.
    Yes,
    /// The place sees an open vertex of its element.
    No,
    /// The place sees nothing that is open or lit.
    Unlit,
}

/// The result of looking for light from a place.
enum Seen<P> {
    /// The place sees light or out of the scene.
    Light,
    /// The place sees these reflecting places only; whether they are lit is open.
    Places(P),
}

/// A place that a ray has met. All else of the place follows from it; inside solids many vertices wait with many of these.
struct Met {
    triangle: u32,
    back: bool,
    uv: [f32; 2],
}

impl Met {
    /// The place of a ray's end, whose weights are those of a hit.
    const fn at(place: &SurfacePoint) -> Self {
        let SurfacePoint { triangle, back, u, v, .. } = *place;
        Self { triangle, back, uv: [u as f32, v as f32] }
    }

    fn place(&self, scene: &Scene) -> SurfacePoint {
        let [u, v] = self.uv.map(f64::from);
        SurfacePoint::new(scene, self.triangle, self.back, u, v)
    }
}

impl Sight<'_> {
    /// Appends to `known` whether each further vertex is open; `direct` is the light from luminaires at all vertices.
    pub(crate) fn extend_known(&self, direct: &[Rgb], known: &mut Vec<bool>) {
        let first = known.len();
        let mut lit = known.clone();
        lit.extend(direct[first..].iter().map(|lx| !lx.is_black()));
        self.open_reached(first, &mut lit);
        let look = |(k, gatherer): (usize, &Gatherer)| match lit[first + k] {
            true => Seen::Light,
            false if self.end.has_passed() => Seen::Light,
            false => self.look(gatherer, (first + k) as u64, &lit),
        };
        let seen: Vec<Seen<Box<[Met]>>> =
            self.gatherers[first..].par_iter().enumerate().map(look).collect();
        known.extend(seen.iter().map(|s| matches!(s, Seen::Light)));
        let mut waiting: Vec<(usize, Box<[Met]>)> = Vec::new();
        for (k, seen) in seen.into_iter().enumerate() {
            if let Seen::Places(places) = seen {
                waiting.push((first + k, places));
            }
        }
        // Each round adds one reflection; it opens some vertex or is the last.
        loop {
            let is_open = |(_, places): &(usize, Box<[Met]>)| {
                !self.end.has_passed()
                    && places.iter().any(|met| self.sees_open(&met.place(self.scene), known))
            };
            let open: Vec<bool> = waiting.par_iter().map(is_open).collect();
            if !open.contains(&true) {
                break;
            }
            let mut open = open.into_iter();
            waiting.retain(|&(vertex, _)| {
                known[vertex] = open.next().unwrap_or(false);
                !known[vertex]
            });
        }
    }

    /// Opens the vertices from number `first` on that are seen from places of their elements which light reaches.
    fn open_reached(&self, first: usize, open: &mut [bool]) {
        for place in self.reached {
            let SurfacePoint { triangle, back, u, v, .. } = *place;
            for (vertex, _) in self.elements.locate(triangle, back, u, v).into_iter().flatten() {
                let vertex = vertex as usize;
                open[vertex] = open[vertex] || vertex >= first && self.sees(place, vertex);
            }
        }
    }

    /// Whether a place is open, but sees no open vertex of its element. The light interpolated there then comes from
    /// behind something. `number` selects the random numbers; `is_unlit` says that the places seen from there are
    /// known to be unlit.
    pub(crate) fn cut_off(
        &self,
        (place, number): (&SurfacePoint, u64),
        known: &[bool],
        is_unlit: bool,
    ) -> CutOff {
        if self.sees_open(place, known) {
            return CutOff::No;
        }
        let from = Gatherer::on_surface(*place, MOST_RAYS);
        match self.look_for_open(&from, number, known) {
            Seen::Light => CutOff::Yes,
            Seen::Places(places) if !is_unlit && self.any_lit(&from, number, &places) => {
                CutOff::Yes
            }
            Seen::Places(_) => CutOff::Unlit,
        }
    }

    /// Looks for an open vertex, which asks no luminaires, and then for light on the places seen.
    fn look(&self, from: &Gatherer, number: u64, known: &[bool]) -> Seen<Box<[Met]>> {
        match self.look_for_open(from, number, known) {
            Seen::Places(places) if !self.any_lit(from, number, &places) => {
                Seen::Places(places.iter().map(Met::at).collect())
            }
            _ => Seen::Light,
        }
    }

    /// Looks for places that see a vertex known to be open.
    fn look_for_open(
        &self,
        from: &Gatherer,
        number: u64,
        known: &[bool],
    ) -> Seen<Vec<SurfacePoint>> {
        let sequence = Sequence::new(self.key.with(number));
        let axis = from.normal.to_direction();
        let mut places = Vec::new();
        for index in 0..MOST_RAYS {
            let mut dice = Dice::new(sequence, index);
            let direction = axis.from_local(CosineHemisphere::sample(dice.pair()));
            let ray = Ray::new(from.origin, direction);
            let before = places.len();
            let end = follow(self.scene, ray, direction, &mut dice, |surface, finish, _| {
                // The black back of an object is not part of the scene's space.
                if !(surface.back && *finish == Finish::BLACK) {
                    places.push(*surface);
                }
            });
            if end == PathEnd::Left || self.any_open(&places[before..], known) {
                return Seen::Light;
            }
        }
        Seen::Places(places)
    }

    /// Whether a luminaire shines on any of the places seen from a gatherer.
    fn any_lit(&self, from: &Gatherer, number: u64, places: &[SurfacePoint]) -> bool {
        let reach_m = nearby::edge_at_m(self.elements, &from.surface);
        let about = self.lighting.about(from.surface.point, reach_m);
        let sequence = Sequence::new(self.key.with(number).with(1));
        let is_lit = |(k, place): (usize, &SurfacePoint)| {
            let mut dice = Dice::new(sequence, k as u32);
            let light = match &about {
                Some(about) => self.lighting.estimate_by(about, place, &mut dice),
                None => self.lighting.estimate(place, &mut dice),
            };
            !light.is_black()
        };
        places.iter().enumerate().any(is_lit)
    }

    fn any_open(&self, places: &[SurfacePoint], known: &[bool]) -> bool {
        places.iter().any(|place| self.sees_open(place, known))
    }

    /// Whether a place sees an open vertex of its element that nothing stands on.
    fn sees_open(&self, place: &SurfacePoint, known: &[bool]) -> bool {
        let SurfacePoint { triangle, back, u, v, .. } = *place;
        let corners = self.elements.locate(triangle, back, u, v);
        let mut corners = corners.iter().flatten().map(|&(vertex, _)| vertex as usize);
        corners
            .any(|vertex| known[vertex] && !self.footprints.has(vertex) && self.sees(place, vertex))
    }

    /// Whether nothing stands between a place and a vertex of its element.
    fn sees(&self, place: &SurfacePoint, vertex: usize) -> bool {
        sees(self.scene, place, self.gatherers[vertex].origin)
    }
}

/// Whether nothing stands between a place and a point just above a vertex of its element.
pub(crate) fn sees(scene: &Scene, place: &SurfacePoint, vertex: Point) -> bool {
    let from = place.start();
    let to = vertex + (vertex - from) * BEYOND_VERTEX_SHARE;
    !scene.bvh().any_hit(&Ray::between(from, to).skipping(place.triangle))
}
