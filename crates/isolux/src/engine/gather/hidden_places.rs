//! Hidden places: those that no light can reach.
//!
//! A receiver in the floor below a cabinet is neither dark nor lit, and no light must be interpolated
//! from there or to there. A place is open if a luminaire shines on it, if it sees out of the scene, or
//! if it sees a place that is open; the rest is hidden, whether it lies in something solid or in a
//! closed box that is painted inside. What a ray sees is asked of the very spot where it ends, never of
//! an element that may reach below the wall of a box: of its vertices those count that the spot
//! sees, and of these not those that something stands on.

use super::gatherer::Gatherer;
use crate::elements::Elements;
use crate::engine::light::Lighting;
use crate::engine::occlusion::{Footprints, nearby};
use crate::engine::ray::{Dice, PathEnd, SurfacePoint, follow};
use crate::sampling::{CosineHemisphere, Key, Sequence};
use crate::scene::{Finish, Scene};
use crate::units::Rgb;
use isolux_geometry::{Point, Ray};
use rayon::prelude::*;
use std::collections::HashMap;

/// Rays that look for light at most: a place that sees it in less than a tenth of its hemisphere
/// is still found with a chance of 19 in 20.
const RAYS: u32 = 32;

/// A vertex is looked at to this far beyond it, as a share of the distance, so that one that lies in
/// a wall is not seen from behind it.
const BEYOND: f64 = 1e-3;

/// All that is needed to look about on the vertices of a mesh.
pub(crate) struct Sight<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) lighting: &'a Lighting<'a>,
    pub(crate) elements: &'a Elements,
    /// Those of all vertices of the elements.
    pub(crate) gatherers: &'a [Gatherer],
    /// Places that light comes to over specular surfaces.
    pub(crate) reached: &'a [SurfacePoint],
    /// Vertices that something stands on, which are seen from both of its sides.
    pub(crate) footprints: &'a Footprints,
    pub(crate) key: Key,
}

/// An element: its number, which its places are drawn by, and where its corners are.
pub(crate) type Element = (u32, [[u64; 3]; 3]);

/// By element, its places from which nothing was seen that luminaires shine on: vertices are found to be open later, but
/// that stays, for later pilots of a run, too.
#[derive(Debug, Default)]
pub(crate) struct Unlit(pub(crate) HashMap<Element, u16>);

/// Whether a place is cut off from the light of its element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum CutOff {
    /// Light comes there, but it sees no open vertex of its element.
    Yes,
    /// It sees one.
    No,
    /// What is seen from there is neither open nor lit.
    Unlit,
}

/// What a place sees.
enum Seen {
    /// Light, or the open.
    Light,
    /// Places that reflect, whether there is light or not.
    Places(Vec<SurfacePoint>),
}

impl Sight<'_> {
    /// Appends which of the vertices after those of `known` are open; `direct` is the light that
    /// luminaires bring to all of them.
    pub(crate) fn extend_known(&self, direct: &[Rgb], known: &mut Vec<bool>) {
        let first = known.len();
        let mut lit = known.clone();
        lit.extend(direct[first..].iter().map(|lx| !lx.is_black()));
        self.open_reached(first, &mut lit);
        let look = |(k, gatherer): (usize, &Gatherer)| match lit[first + k] {
            true => Seen::Light,
            false => self.look(gatherer, (first + k) as u64, &lit),
        };
        let seen: Vec<Seen> = self.gatherers[first..].par_iter().enumerate().map(look).collect();
        known.extend(seen.iter().map(|s| matches!(s, Seen::Light)));
        let mut waiting: Vec<(usize, Vec<SurfacePoint>)> = Vec::new();
        for (k, seen) in seen.into_iter().enumerate() {
            if let Seen::Places(places) = seen {
                waiting.push((first + k, places));
            }
        }
        // From the light on, reflection by reflection; every round opens some vertex or is the last.
        loop {
            let open: Vec<bool> =
                waiting.par_iter().map(|(_, places)| self.any_open(places, known)).collect();
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

    /// Opens the vertices from number `first` on that are seen from places of their elements that light reaches.
    fn open_reached(&self, first: usize, open: &mut [bool]) {
        for place in self.reached {
            let SurfacePoint { triangle, back, u, v, .. } = *place;
            for (vertex, _) in self.elements.locate(triangle, back, u, v).into_iter().flatten() {
                let vertex = vertex as usize;
                open[vertex] = open[vertex] || vertex >= first && self.sees(place, vertex);
            }
        }
    }

    /// Whether a place is open, but sees no open vertex of its element: what is interpolated there
    /// comes from behind something. `number` tells places apart; of some it is known that what they see is unlit.
    pub(crate) fn cut_off(
        &self,
        (place, number): (&SurfacePoint, u64),
        known: &[bool],
        is_unlit: bool,
    ) -> CutOff {
        if self.sees_open(place, known) {
            return CutOff::No;
        }
        let from = Gatherer::on_surface(*place, RAYS);
        match self.look_for_open(&from, number, known) {
            Seen::Light => CutOff::Yes,
            Seen::Places(places) if !is_unlit && self.any_lit(&from, number, &places) => {
                CutOff::Yes
            }
            Seen::Places(_) => CutOff::Unlit,
        }
    }

    /// Looks for places that see a vertex known to be open, which asks no luminaires, and then for light.
    fn look(&self, from: &Gatherer, number: u64, known: &[bool]) -> Seen {
        match self.look_for_open(from, number, known) {
            Seen::Places(places) if self.any_lit(from, number, &places) => Seen::Light,
            seen => seen,
        }
    }

    /// Looks for places that see a vertex known to be open.
    fn look_for_open(&self, from: &Gatherer, number: u64, known: &[bool]) -> Seen {
        let sequence = Sequence::new(self.key.with(number));
        let axis = from.normal.to_direction();
        let mut places = Vec::new();
        for index in 0..RAYS {
            let mut dice = Dice::new(sequence, index);
            let direction = axis.from_local(CosineHemisphere::sample(dice.pair()));
            let ray = Ray::new(from.origin, direction);
            let before = places.len();
            let end = follow(self.scene, ray, direction, &mut dice, |surface, finish, _| {
                // The black back of something is not part of the scene's space.
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

    /// Whether a luminaire shines on one of the places seen from somewhere.
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

    /// Whether a place sees an open vertex of its element, one that tells of its side alone.
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
    let to = vertex + (vertex - from) * BEYOND;
    !scene.bvh().any_hit(&Ray::between(from, to).skipping(place.triangle))
}
