//! Trial particles for caustics, in independent batches, and the flux that they bring to elements.

use crate::elements::Elements;
use crate::engine::gather::known_weights;
use crate::engine::mesh::{HatFunctions, NO_INDEX};
use crate::engine::particle::{Flights, PARTS, part_of};
use crate::engine::pilot::state::Pilot;
use crate::map::Standing;
use crate::sampling::Key;
use rayon::prelude::*;
use std::cell::RefCell;

/// The number of batches.
pub(super) const BATCHES: usize = 8;

/// The flux that a particle has left at a place, as if it carried all light.
#[derive(Clone, Copy, Debug)]
pub(super) struct Deposit {
    triangle: u32,
    back: bool,
    place: [f64; 2],
    flux_lm: f64,
}

/// Batches of particles; the particles of each share all light.
#[derive(Debug)]
pub(super) struct Batches {
    /// The deposits that are kept, by batch.
    deposits: [Vec<Deposit>; BATCHES],
    /// The number of particles of each batch whose deposits are kept.
    kept: u32,
    /// The number of particles of each batch so far, kept or not.
    flown: u64,
}

/// The flux of a batch, by element and vertex.
pub(super) struct Brought {
    pub(super) particles: f64,
    /// The light at the vertices in a map of this batch, lx.
    pub(super) light: Vec<f64>,
    /// By node, its number among the elements with deposits, or [`NO_INDEX`].
    of_node: Vec<u32>,
    elements: Vec<ToElement>,
    /// The flux of the vertices, as if each particle carried all light, lm.
    fluxes_lm: Vec<f64>,
}

/// The flux that comes to an element.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ToElement {
    pub(super) deposits: usize,
    /// The flux of each part of the element, as if each particle carried all light, lm.
    pub(super) fluxes_lm: [f64; PARTS],
}

impl Batches {
    pub(super) fn new() -> Self {
        Self { deposits: Default::default(), kept: 0, flown: 0 }
    }

    /// The number of particles of each batch whose deposits are kept.
    pub(super) const fn kept(&self) -> u32 {
        self.kept
    }
}

impl Brought {
    fn nothing(elements: &Elements) -> Self {
        Self {
            particles: 0.0,
            light: Vec::new(),
            of_node: vec![NO_INDEX; elements.node_count()],
            elements: Vec::new(),
            fluxes_lm: vec![0.0; elements.vertices().len()],
        }
    }

    /// Adds the deposits of a number of particles.
    fn add(
        &mut self,
        deposits: &[Deposit],
        particles: u32,
        (elements, standings): (&Elements, &[Option<Standing>]),
    ) {
        self.particles += f64::from(particles);
        for Deposit { triangle, back, place, flux_lm } in deposits {
            let Some(place) = elements.place(u32::MAX, *triangle, *back, *place) else { continue };
            let corners = elements.corners(place);
            let Some(weights) = known_weights(corners, standings) else { continue };
            for ((vertex, _), weight) in corners.iter().zip(weights) {
                self.fluxes_lm[*vertex as usize] += weight * flux_lm;
            }
            let of_node = &mut self.of_node[place.node() as usize];
            if *of_node == NO_INDEX {
                *of_node = self.elements.len() as u32;
                self.elements.push(ToElement::default());
            }
            let element = &mut self.elements[*of_node as usize];
            element.deposits += 1;
            element.fluxes_lm[part_of(corners.map(|(_, weight)| weight))] += flux_lm;
        }
    }

    /// Adds the map that an increment would make of these fluxes.
    fn into_map(mut self, hats: &HatFunctions) -> Self {
        let each = 1.0 / self.particles;
        self.light = hats.corrected(&hats.means(self.fluxes_lm.drain(..).map(|lm| lm * each)));
        self
    }

    /// The flux that came to an element.
    pub(super) fn to(&self, node: u32) -> ToElement {
        self.elements.get(self.of_node[node as usize] as usize).copied().unwrap_or_default()
    }
}

impl Pilot<'_> {
    /// Adds `count` particles to every batch and keeps their deposits. Returns whether there are any deposits at all.
    pub(super) fn fly_and_keep(&mut self, batches: &mut Batches, count: u32) -> bool {
        for (all, new) in batches.deposits.iter_mut().zip(self.fly(batches.flown, count)) {
            all.extend(new);
        }
        batches.kept += count;
        batches.flown += u64::from(count);
        batches.deposits.iter().any(|deposits| !deposits.is_empty())
    }

    /// The kept deposits of every batch, summed over these elements.
    pub(super) fn kept(
        &self,
        of: &Batches,
        elements: &Elements,
        hats: &HatFunctions,
    ) -> Vec<Brought> {
        let brought = |deposits: &Vec<Deposit>| {
            let mut brought = Brought::nothing(elements);
            brought.add(deposits, of.kept, (elements, &self.near.standings));
            brought.into_map(hats)
        };
        of.deposits.par_iter().map(brought).collect()
    }

    /// The sums of `count` new particles of every batch, `at_once` at a time, whose deposits are not kept. There
    /// are fewer particles if time is short.
    pub(super) fn brought(
        &mut self,
        batches: &mut Batches,
        (count, at_once): (u32, u32),
        (elements, hats): (&Elements, &HatFunctions),
        mut has_time: impl FnMut(&mut Self) -> bool,
    ) -> Vec<Brought> {
        let mut brought: Vec<Brought> = (0..BATCHES).map(|_| Brought::nothing(elements)).collect();
        for _ in 0..count / at_once {
            let new = self.fly(batches.flown, at_once);
            batches.flown += u64::from(at_once);
            let standings = &self.near.standings;
            brought.par_iter_mut().zip(&new).for_each(|(brought, new)| {
                brought.add(new, at_once, (elements, standings));
            });
            if !has_time(self) {
                break;
            }
        }
        brought.into_par_iter().map(|brought| brought.into_map(hats)).collect()
    }

    /// The deposits of `count` new particles of every batch; `flown` is the number of earlier ones.
    fn fly(&mut self, flown: u64, count: u32) -> Vec<Vec<Deposit>> {
        let of = (self.scene, self.lighting);
        let mut traced = 0;
        let of_batch = |batch: u64| {
            let key = Key::with(self.key.with(9).with(batch), flown);
            let Some(flights) = Flights::new(of, self.tried.aim.as_ref(), count, key) else {
                return Vec::new();
            };
            let one = |index: u32| {
                // Nothing reads what comes after the end.
                if self.end.has_passed() {
                    return (Vec::new(), 0);
                }
                let deposits = RefCell::new(Vec::new());
                let (rays, _) = flights.fly(index, |at, flux_lm| {
                    let (triangle, back, place) = (at.triangle, at.back, [at.u, at.v]);
                    let flux_lm = flux_lm.luminance() * f64::from(count);
                    deposits.borrow_mut().push(Deposit { triangle, back, place, flux_lm });
                });
                (deposits.into_inner(), rays)
            };
            let all: Vec<(Vec<Deposit>, u64)> = (0..count).into_par_iter().map(one).collect();
            traced += all.iter().map(|(_, rays)| rays).sum::<u64>();
            all.into_iter().flat_map(|(deposits, _)| deposits).collect()
        };
        let all = (0..BATCHES as u64).map(of_batch).collect();
        self.traced += traced;
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elements::Subdivision;
    use crate::engine::tests::{inward_box, painted, scene};
    use crate::units::Rgb;

    /// Deposits of uniform density: a lattice over every triangle of a box.
    fn deposits(elements: &Elements) -> Vec<Deposit> {
        let lattice = |triangle: u32| {
            let places = (0..30).flat_map(|i| (0..30 - i).map(move |k| (i, k)));
            places.map(move |(i, k)| Deposit {
                triangle,
                back: false,
                place: [i, k].map(|at| (f64::from(at) + 1.0 / 3.0) / 30.0),
                flux_lm: 1.0 + f64::from(triangle),
            })
        };
        (0..elements.roots().len() as u32).flat_map(lattice).collect()
    }

    #[test]
    fn what_is_brought_little_by_little_is_what_is_brought_at_once() {
        let scene = scene(inward_box([3.0, 2.0, 2.5], 0), vec![painted(Rgb::grey(0.5))], vec![]);
        let mut subdivision = Subdivision::new(&scene);
        subdivision.bisect_to(0.7, 10_000);
        let elements = subdivision.elements();
        let standings = vec![Some(Standing::Open); elements.vertices().len()];
        let hats = HatFunctions::new(&subdivision, &standings);
        let all = deposits(&elements);
        let brought = |parts: &[&[Deposit]]| {
            let mut brought = Brought::nothing(&elements);
            parts.iter().for_each(|part| brought.add(part, 50, (&elements, &standings)));
            brought.into_map(&hats)
        };
        let (once, twice) = (brought(&[&all]), brought(&[&all[..2000], &all[2000..]]));
        assert_eq!((once.particles, twice.particles), (50.0, 100.0));
        let (mut whole_lm, mut count) = (0.0, 0);
        for node in subdivision.leaves() {
            assert_eq!(once.to(node).fluxes_lm, twice.to(node).fluxes_lm);
            whole_lm += once.to(node).fluxes_lm.iter().sum::<f64>();
            count += once.to(node).deposits;
        }
        assert_eq!(count, all.len());
        let sent_lm: f64 = all.iter().map(|deposit| deposit.flux_lm).sum();
        assert!((whole_lm - sent_lm).abs() < 1e-9 * sent_lm);
        // With twice as many particles each carries half.
        for (once, twice) in once.light.iter().zip(&twice.light) {
            assert!((once - 2.0 * twice).abs() <= 1e-9 * once.abs());
        }
        // A node that is bisected has nothing of its own.
        assert_eq!(once.to(0).deposits, 0);
    }
}
