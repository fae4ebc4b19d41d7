//! Direct light for pictures: the light without obstacles exactly, and what obstacles take away by shadow rays.
//!
//! All emitting surfaces and luminous areas share the rays, in proportion to their light without obstacles. So there is no noise
//! where a place sees all of them or none, and only half-shadows need many rays. Where sources are many, the
//! light tree draws some of them, and replicates measure the noise.

use super::super::lighting::Lighting;
use super::super::polygon::steradians;
use super::super::sources::triangle_lamps::middle_and_twice_m2;
use super::super::sources::{Source, Target};
use super::area::AreaSource;
use super::luminous::LuminousSource;
use super::many::by_area;
use super::measured::Measured;
use super::patches::Patches;
use crate::engine::ray::{Dice, SurfacePoint, mean_and_variance};
use crate::sampling::Sequence;
use crate::units::Rgb;
use isolux_geometry::Point;

/// The most triangles of emitting surfaces whose light without obstacles is evaluated exactly. That takes
/// about as long as a shadow ray for every three of them.
const MOST_TRIANGLES: usize = 128;
/// The most point sources that are all evaluated.
const MOST_POINTS: usize = 32;
/// The standard deviation of visible shares up to which rays agree.
const AGREED: f64 = 1e-3;
/// The order of convergence of evenly spread rays across the edge of a shadow: noise falls like this power of
/// 1/n (Mitchell 1996, Consequences of stratified sampling in graphics).
const EDGE_ORDER: f64 = 0.75;
/// The fewest rays whose spread counts for a triangle; of fewer, the spread of all counts.
const FEWEST_LOOKS: f64 = 8.0;
/// The noise of light from sources that the light tree draws from which more rays follow, as a share of it.
const EVEN: f64 = 0.01;
/// The replicates that measure noise where the light tree draws sources.
const DRAWINGS: usize = 4;

/// A triangle of an emitting surface or a luminous area as a place sees it.
struct Part<'a> {
    source: &'a Source,
    outline: Outline<'a>,
    /// Its light without obstacles, lx.
    lx: f64,
}

/// The places of a part.
enum Outline<'a> {
    /// A triangle with its index in the scene.
    Triangle(u32, [Point; 3]),
    Luminous(LuminousSource<'a>),
}

/// The effort for direct light in a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShadowRays {
    /// The shadow rays of a place where they agree.
    pub fewest: usize,
    /// The shadow rays of a place in half-shadow.
    pub most: usize,
}

/// What rays to some triangles found.
#[derive(Clone, Copy, Default)]
struct Looks {
    /// The light without obstacles that they stand for, and the part of it that arrives.
    sums: [Rgb; 2],
    /// The rays, the sum of the visible shares that they found, and that of the squares.
    moments: [f64; 3],
}

impl Lighting<'_> {
    /// Whether all sources are evaluated for a place of a picture.
    pub(in super::super) fn can_pool(&self) -> bool {
        let triangles = |source: &Source| AreaSource::of(source).map_or(0, AreaSource::count);
        self.points <= MOST_POINTS
            && !self.openings.exist()
            && !self.sources.iter().any(Source::is_far_extent)
            && self.sources.iter().map(triangles).sum::<usize>() <= MOST_TRIANGLES
    }

    /// Direct light for a picture with its noise (best effort).
    pub(crate) fn pictured(
        &self,
        patches: &Patches,
        at: &SurfacePoint,
        rays: ShadowRays,
        sequence: Sequence,
    ) -> Measured {
        if self.are_pooled {
            self.pooled(at, rays, sequence)
        } else {
            self.drawn(patches, at, rays, sequence)
        }
    }

    fn pooled(&self, at: &SurfacePoint, rays: ShadowRays, sequence: Sequence) -> Measured {
        let beside = self.lit_by_points(self.sources.iter(), at);
        let parts = self.parts(at);
        let total_lx: f64 = parts.iter().map(|part| part.lx).sum();
        if total_lx <= 0.0 {
            return Measured { lx: beside, variance: 0.0 };
        }
        let by = |rays: usize, sequence| self.by_looks((&parts, total_lx), at, rays, sequence);
        let (mut lit, mut agree) = by(rays.fewest, sequence);
        if rays.most > rays.fewest && !agree {
            (lit, agree) = by(rays.most, sequence.fork(u32::MAX, 1));
        }
        let variance = if agree { 0.0 } else { lit.variance };
        Measured { lx: beside + lit.lx, variance }
    }

    /// The triangles and luminous areas that a place may see.
    fn parts(&self, at: &SurfacePoint) -> Vec<Part<'_>> {
        let mut parts = Vec::new();
        for source in &self.sources {
            if let Some(luminous) = LuminousSource::of(source) {
                let lx = self.unhidden(luminous, at).luminance();
                if lx > 0.0 {
                    parts.push(Part { source, outline: Outline::Luminous(luminous), lx });
                }
            }
            let Some((emitter, triangles)) = AreaSource::of(source).map(AreaSource::emitter) else {
                continue;
            };
            let luminance = source.colour.luminance();
            for (&triangle, &corners) in emitter.indices.iter().zip(triangles) {
                let lx = luminance * steradians(at, corners);
                if lx > 0.0 {
                    parts.push(Part { source, outline: Outline::Triangle(triangle, corners), lx });
                }
            }
        }
        parts
    }

    /// The light of some parts, by rays spread evenly over it, and whether all rays found the same. Rays
    /// are spread over the area of a part, and count by their light without obstacles: their ratio has no
    /// noise where all or nothing is visible, and little bias elsewhere.
    fn by_looks(
        &self,
        (parts, total_lx): (&[Part<'_>], f64),
        at: &SurfacePoint,
        rays: usize,
        sequence: Sequence,
    ) -> (Measured, bool) {
        let scale = rays as f64 / total_lx;
        let mut sum = Dice::new(sequence.fork(0, 2), 0).pair()[0];
        let mut first = 0;
        let found: Vec<Looks> = (0..)
            .zip(parts)
            .map(|(number, part)| {
                sum += part.lx * scale;
                let end = sum as usize;
                let looks = self.looks(part, at, end - first, sequence.fork(number, 3));
                first = end;
                looks
            })
            .collect();
        let all = found.iter().fold(Looks::default(), |all, looks| all.and(looks));
        let (mut lx, mut variance) = (Rgb::BLACK, 0.0);
        for (part, looks) in parts.iter().zip(&found) {
            let whole = part.source.colour * (part.lx / part.source.colour.luminance());
            let seen = looks.seen().or_else(|| all.seen()).unwrap_or(Rgb::BLACK);
            lx += whole * seen;
            let few = if looks.moments[0] < FEWEST_LOOKS { &all } else { looks };
            let noise_lx = part.lx * libm::pow(looks.moments[0].max(1.0), -EDGE_ORDER);
            variance += few.variance() * noise_lx * noise_lx;
        }
        (Measured { lx, variance }, all.variance() <= AGREED * AGREED)
    }

    fn looks(&self, part: &Part<'_>, at: &SurfacePoint, rays: usize, sequence: Sequence) -> Looks {
        let mut looks = Looks::default();
        for look in 0..rays as u32 {
            let dice = &mut Dice::new(sequence, look);
            if let Some((light, target, triangle)) = self.look_at(part, at, dice) {
                looks.add(light, self.visibility(&part.source.chain, at, target, triangle));
            }
        }
        looks
    }

    /// A place of a part, with its light without obstacles, and the triangle that it lies on.
    fn look_at(
        &self,
        part: &Part<'_>,
        at: &SurfacePoint,
        dice: &mut Dice,
    ) -> Option<(f64, Target, Option<u32>)> {
        match part.outline {
            Outline::Triangle(triangle, corners) => {
                let (_, twice_m2) = middle_and_twice_m2(corners);
                let (point, steradians) = by_area(corners, twice_m2, at, dice)?;
                Some((steradians, Target::Point(point), Some(triangle)))
            }
            Outline::Luminous(luminous) => {
                let arriving = self.unhidden_from(luminous, luminous.place(dice), at)?;
                Some((arriving.illuminance_lx.luminance(), arriving.target, None))
            }
        }
    }

    /// Direct light from sources drawn by the light tree.
    fn drawn(
        &self,
        patches: &Patches,
        at: &SurfacePoint,
        rays: ShadowRays,
        sequence: Sequence,
    ) -> Measured {
        if self.samples_exactly() {
            let lx = self.by_rays_on(patches, at, rays.most, &mut Dice::new(sequence, 0));
            return Measured { lx, variance: 0.0 };
        }
        let cut = (!self.tree.lamps.is_empty()).then(|| self.cut_on(patches, at));
        let by = |rays: usize, sequence: Sequence| {
            let rays = rays.div_ceil(DRAWINGS);
            let samples = (rays / self.area_sources.max(1)).max(1);
            let one = |k: usize| {
                let dice = &mut Dice::new(sequence, k as u32);
                match &cut {
                    Some(cut) => self.lit_by_cut(cut, at, (rays, samples), dice),
                    None => self.by_all(at, samples, dice),
                }
            };
            let values: [Rgb; DRAWINGS] = std::array::from_fn(one);
            let (lx, variance) = mean_and_variance(&values);
            Measured { lx, variance }
        };
        let first = by(rays.fewest, sequence);
        let is_even = first.variance.sqrt() <= EVEN * first.lx.luminance();
        if is_even || rays.most <= rays.fewest { first } else { by(rays.most, sequence.fork(0, 4)) }
    }
}

impl Looks {
    fn add(&mut self, light: f64, seen: Rgb) {
        self.sums[0] += Rgb::grey(light);
        self.sums[1] += seen * light;
        let seen = seen.luminance();
        let [count, sum, squares] = self.moments;
        self.moments = [count + 1.0, sum + seen, squares + seen * seen];
    }

    fn and(self, other: &Self) -> Self {
        Self {
            sums: [0, 1].map(|k| self.sums[k] + other.sums[k]),
            moments: [0, 1, 2].map(|k| self.moments[k] + other.moments[k]),
        }
    }

    /// The visible share of light.
    fn seen(&self) -> Option<Rgb> {
        let whole = self.sums[0].luminance();
        (whole > 0.0).then(|| self.sums[1] / whole)
    }

    /// The variance of the visible share from ray to ray.
    fn variance(&self) -> f64 {
        let [count, sum, squares] = self.moments;
        if count == 0.0 {
            return 0.0;
        }
        let mean = sum / count;
        (squares / count - mean * mean).max(0.0)
    }
}
