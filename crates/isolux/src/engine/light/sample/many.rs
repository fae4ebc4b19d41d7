//! Direct light of many luminaires by few shadow rays.
//!
//! All luminaires and images lie along a line, each with a width equal to its expected light. Their order is
//! that of the light tree, so neighbours in space are neighbours on the line. A comb of evenly spaced teeth,
//! shifted at random, is laid over the line. A luminaire under a tooth is evaluated exactly, with a shadow
//! ray; of a cluster under a tooth, one luminaire of a few is. The result is divided by the probability of
//! the choice (Hansen and Hurwitz 1943). So it has no bias for any widths, and no noise where the widths are
//! right and nothing is hidden. For a triangle of an emitting surface, one point is sampled, by projected
//! solid angle where the triangle is near. Then only occlusion of the triangle makes noise.

use super::super::lighting::{Lighting, RAYS_TO_MANY_POINTS, drawn};
use super::super::polygon::{Place, pieces, target};
use super::super::sources::Target;
use super::super::sources::triangle_lamps::{Face, middle_and_twice_m2};
use super::super::tree::Node;
use super::super::tree::cut::{Cut, Part, Parts, Seen, View};
use super::super::{polygon, sources};
use super::patches::Patches;
use crate::engine::ray::{Dice, SurfacePoint};
use crate::units::Rgb;
use isolux_geometry::{Point, Vector};

/// Number of point sources for every ray up to which all of them are evaluated, without noise.
const MOST_POINTS_A_RAY: usize = 4;

/// Luminaires of a cluster among which one is chosen.
const CANDIDATES: usize = 8;

/// Radius of a face over its distance, up to which it is sampled by area. That takes a third of the time.
const FAR_RADIUS_RATIO: f64 = 0.25;

/// The teeth of a comb: whole numbers plus a shift.
#[derive(Clone, Copy)]
struct Comb(f64);

impl Comb {
    /// The number of the first tooth at or after a place of zero or more.
    fn tooth_from(self, place: f64) -> u32 {
        let teeth = place - self.0;
        let whole = teeth as u32;
        whole + u32::from(teeth > f64::from(whole))
    }
}

impl Lighting<'_> {
    /// [`Lighting::sampled`] for a receiver on a surface with many close receivers.
    pub(crate) fn sampled_on(
        &self,
        patches: &Patches,
        at: &SurfacePoint,
        samples: usize,
        dice: &mut Dice,
    ) -> Rgb {
        if !self.has_many() {
            return self.by_all(at, samples, dice);
        }
        self.lit_by_cut(&self.cut_on(patches, at), at, (RAYS_TO_MANY_POINTS, samples), dice)
    }

    /// An unbiased estimate by about `rays` shadow rays, for a receiver on a surface with many
    /// close receivers. Point sources that are not many more than `rays` get one ray each.
    pub(crate) fn by_rays_on(
        &self,
        patches: &Patches,
        at: &SurfacePoint,
        rays: usize,
        dice: &mut Dice,
    ) -> Rgb {
        let samples = (rays / self.area_sources.max(1)).max(1);
        let is_exact = !self.tree.has_extents() && self.points <= MOST_POINTS_A_RAY * rays;
        if self.tree.lamps.is_empty() || is_exact {
            return self.by_all(at, samples, dice);
        }
        self.lit_by_cut(&self.cut_on(patches, at), at, (rays, samples), dice)
    }

    /// Direct illuminance from the lamps of the light tree and their images, by about `rays` shadow
    /// rays. `cut` is the cut of the receiver.
    pub(crate) fn lit_by_many(
        &self,
        cut: &Cut,
        at: &SurfacePoint,
        rays: usize,
        dice: &mut Dice,
    ) -> Rgb {
        let mut sum = Rgb::BLACK;
        self.look(cut, at, rays, dice, |found| sum += found);
        sum / rays as f64
    }

    /// Direct illuminance by `rays` shadow rays to the lamps of a cut, and `samples` to every other emitting surface.
    pub(crate) fn lit_by_cut(
        &self,
        cut: &Cut,
        at: &SurfacePoint,
        (rays, samples): (usize, usize),
        dice: &mut Dice,
    ) -> Rgb {
        let points = self.lit_by_many(cut, at, rays, dice);
        self.others().fold(points, |sum, source| sum + self.lit_by(source, at, samples, dice))
    }

    /// Evaluates the lamps under a comb of about `rays` teeth. Each call of `found` receives the
    /// light of all lamps as estimated from one tooth.
    pub(crate) fn look(
        &self,
        cut: &Cut,
        at: &SurfacePoint,
        rays: usize,
        dice: &mut Dice,
        mut found: impl FnMut(Rgb),
    ) {
        let comb = Comb(dice.pair()[0]);
        let choices = dice.fork();
        let Parts { seen, total } = &*cut.parts;
        let scale = rays as f64 / total;
        let mut place = 0.0;
        let mut next = comb.tooth_from(0.0);
        for seen in seen {
            place += seen.weight * scale;
            let teeth = next..comb.tooth_from(place);
            if teeth.is_empty() {
                continue;
            }
            next = teeth.end;
            let Some(view) = &cut.views[seen.chain] else { continue };
            let of_all = total / seen.weight;
            let dice = |tooth: u32| Dice::new(choices, tooth);
            match seen.part {
                Part::Lamp(lamp) if self.is_exact(lamp) => {
                    let lit = self.lit_by_lamp(view, lamp, at, &mut dice(next)) * of_all;
                    teeth.for_each(|_| found(lit));
                }
                Part::Lamp(lamp) => teeth.for_each(|tooth| {
                    found(self.lit_by_lamp(view, lamp, at, &mut dice(tooth)) * of_all);
                }),
                Part::Node(node) => teeth.for_each(|tooth| {
                    found(self.lit_by_one_of(node, view, at, &mut dice(tooth)) * of_all);
                }),
            }
        }
    }

    /// Whether one shadow ray determines all light of a lamp.
    fn is_exact(&self, lamp: u32) -> bool {
        self.tree.radius_m(&self.tree.lamps[lamp as usize]) == 0.0
    }

    /// Direct illuminance from all lamps of a cut, each evaluated. Lamps with an extent share `rays` in proportion
    /// to their expected light.
    pub(crate) fn lit_by_each(
        &self,
        cut: &Cut,
        at: &SurfacePoint,
        rays: usize,
        dice: &mut Dice,
    ) -> Rgb {
        let looks = dice.fork();
        let scale = rays as f64 / cut.parts.total;
        let lit = |seen: &Seen, lamps: std::ops::Range<u32>| -> Rgb {
            let Some(view) = cut.views[seen.chain].as_ref() else { return Rgb::BLACK };
            let rays = ((seen.weight * scale / lamps.len() as f64).round() as u32).max(1);
            lamps
                .map(|k| {
                    let rays = if self.is_exact(k) { 1 } else { rays };
                    let sequence = looks.fork(k, 0);
                    let one = |ray| self.lit_by_lamp(view, k, at, &mut Dice::new(sequence, ray));
                    (0..rays).map(one).sum::<Rgb>() / f64::from(rays)
                })
                .sum()
        };
        let parts = cut.parts.seen.iter().map(|seen| match seen.part {
            Part::Lamp(lamp) => lit(seen, lamp..lamp + 1),
            Part::Node(number) => {
                let node = &self.tree.nodes[number as usize];
                lit(seen, node.first..node.first + node.count)
            }
        });
        parts.sum()
    }

    /// Number of luminaires and images in a cut.
    pub(crate) fn count(&self, cut: &Cut) -> usize {
        let count = |part| match part {
            Part::Lamp(_) => 1,
            Part::Node(number) => self.tree.nodes[number as usize].count as usize,
        };
        cut.parts.seen.iter().map(|seen| count(seen.part)).sum()
    }

    /// An unbiased estimate of the light of a cluster, from one of its lamps. A comb over their
    /// power brings some candidates; one is chosen in proportion to its expected light.
    fn lit_by_one_of(&self, node: u32, view: &View, at: &SurfacePoint, dice: &mut Dice) -> Rgb {
        let [shift, pick] = dice.pair();
        let node: &Node = &self.tree.nodes[node as usize];
        let lamps: [u32; CANDIDATES] =
            std::array::from_fn(|k| self.tree.member(node, (k as f64 + shift) / CANDIDATES as f64));
        let share = |lamp: u32| {
            let lamp = &self.tree.lamps[lamp as usize];
            view.lamp_weight(lamp) / lamp.peak_cd
        };
        let shares = lamps.map(share);
        let total: f64 = shares.iter().sum();
        let Some(k) = drawn(&shares, pick * total) else { return Rgb::BLACK };
        let peak_cd = self.tree.lamps[lamps[k] as usize].peak_cd;
        let chance = CANDIDATES as f64 * (peak_cd / node.peak_cd) * (shares[k] / total);
        self.lit_by_lamp(view, lamps[k], at, dice) / chance
    }

    /// Direct illuminance from one lamp in a view; from a face or a luminous area by one shadow ray.
    pub(crate) fn lit_by_lamp(
        &self,
        view: &View,
        lamp: u32,
        at: &SurfacePoint,
        dice: &mut Dice,
    ) -> Rgb {
        let chain: &[u32] = &self.chains[view.chain];
        if !chain.is_empty() && !self.images.has(lamp, view.chain) {
            return Rgb::BLACK;
        }
        let lamp = &self.tree.lamps[lamp as usize];
        if let Some(face) = self.tree.face(lamp) {
            return self.lit_by_face(view.chain, (face, lamp.colour), at, dice);
        }
        let kind = &self.tree.kinds[lamp.kind as usize];
        let place = self.tree.area(self.scene, lamp).map_or(lamp.position, |area| {
            let ([a, b], [c, _], [x, y, z]) = (dice.pair(), dice.pair(), kind.frame);
            let local = area.place([a, b, c]);
            lamp.position + x * local.x + y * local.y + z * local.z
        });
        let Some(reaching) = view.reaching(place, &kind.frame) else {
            return Rgb::BLACK;
        };
        let planes = chain.iter().map(|&p| &self.mirrors.planes[p as usize]);
        let target = Target::Point(planes.clone().fold(place, |p, plane| plane.image(p)));
        let share = self.visibility(chain, at, target, None);
        if share.is_black() {
            return Rgb::BLACK;
        }
        let candela = sources::intensity(self.scene, kind.luminaire).intensity_cd(reaching.local);
        let colour = planes.fold(lamp.colour, |colour, plane| colour * plane.reflectance);
        colour * share * (candela * reaching.per_cd)
    }

    /// An unbiased estimate of the direct illuminance from a face by a chain of mirrors, with one shadow ray.
    pub(crate) fn lit_by_face(
        &self,
        chain: usize,
        (face, colour): (&Face, Rgb),
        at: &SurfacePoint,
        dice: &mut Dice,
    ) -> Rgb {
        let chain: &[u32] = &self.chains[chain];
        let mut corners = face.corners(self.scene);
        let mut colour = colour;
        for &plane in chain {
            let plane = &self.mirrors.planes[plane as usize];
            corners = plane.image_of_triangle(corners);
            colour = colour * plane.reflectance;
        }
        let (middle, twice_m2) = middle_and_twice_m2(corners);
        let is_far = face.radius_m <= FAR_RADIUS_RATIO * (middle - at.point).length();
        let drawn = if is_far {
            by_area(corners, twice_m2, at, dice)
        } else {
            by_direction(corners, at, dice)
        };
        let Some((point, steradians)) = drawn else { return Rgb::BLACK };
        let seen = self.visibility(chain, at, Target::Point(point), Some(face.triangle));
        colour * seen * steradians
    }
}

/// A point of a triangle, uniform by area, and the projected solid angle that it stands for, sr;
/// `None` where the point is not seen.
pub(super) fn by_area(
    [a, b, c]: [Point; 3],
    twice_m2: Vector,
    at: &SurfacePoint,
    dice: &mut Dice,
) -> Option<(Point, f64)> {
    let [along, across] = dice.pair();
    let along = along.sqrt();
    let point = a + (b - a) * (along * (1.0 - across)) + (c - a) * (along * across);
    let to = point - at.point;
    let (height, depth) = (to.dot(at.shading.to_vector()), -to.dot(twice_m2));
    let is_seen = height > 0.0 && depth > 0.0 && to.dot(at.geometric.to_vector()) > 0.0;
    let distance2 = to.length_squared();
    is_seen.then(|| (point, 0.5 * height * depth / (distance2 * distance2)))
}

/// A point of a triangle with a density by direction in proportion to the cosine at the receiver,
/// and the projected solid angle that it stands for, sr.
fn by_direction(corners: [Point; 3], at: &SurfacePoint, dice: &mut Dice) -> Option<(Point, f64)> {
    let pieces = pieces(at, std::iter::once((0, corners)));
    let steradians: f64 = pieces.iter().map(|piece| piece.steradians).sum();
    let [pick, accept] = dice.pair();
    let piece = polygon::drawn(&pieces, pick * steradians)?;
    let point = target(piece, corners, at, accept, dice);
    Place::seen(at, 0, point, steradians).map(|place| (place.point, place.share))
}
