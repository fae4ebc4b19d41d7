//! Search for the openings in front of emitting surfaces and of skies, by trial rays.

mod planes;
mod seen;

use super::far_sky::FarSky;
use super::lighting::Lighting;
use super::openings::{Before, Opening, Openings};
use super::sample::area::Shape;
use super::sources::{Emitter, LuminaireId, Source, SourceKind, Target};
use crate::ablation::without;
use crate::elements::carries_map;
use crate::engine::ray::{Deadline, Dice, SurfacePoint};
use crate::sampling::{CosineHemisphere, Key, Sequence};
use isolux_geometry::Point;
use planes::{MOST_OPENINGS, Plane, Way, planes};
use rayon::prelude::*;
use seen::{Looked, ThroughOpenings};
use std::f64::consts::PI;

/// Rounds of the search, until enough is seen: number of places, and trial rays of each. The first one takes
/// less than 0.2 ms (decision 47).
const SEARCH_ROUNDS: [(usize, usize); 4] = [(64, 8), (512, 8), (4096, 8), (4096, 24)];

/// The most triangles from which places are drawn; of more, every n-th triangle is used.
const MOST_TRIANGLES: u32 = 1 << 20;

/// Keeps the numbers of skies apart from those of surfaces.
const SKIES: u64 = u64::MAX;

/// The most trial rays for all emitters of a scene together.
const MOST_TRIAL_RAYS: usize = 1 << 20;

/// The smallest share of dark places with which openings are searched for.
const LEAST_DARK_SHARE: f64 = 0.2;
/// The smallest unoccluded projected solid angle of an emitter for a search, sr: rays to smaller
/// ones make little noise.
const LEAST_UNOCCLUDED_SR: f64 = 0.2;

/// Share of the hemisphere that an unoccluded emitter must fill to count as all around.
const SURROUNDING_SHARE: f64 = 0.99;

/// Number of free paths from dark places to the emitter that suffices to find openings.
const ENOUGH_FREE_PATHS: usize = 512;
/// The fewest free paths with which openings are searched for.
const FEWEST_FREE_PATHS: usize = 16;

/// The most blocked paths that are traced to the surface that blocks them.
const MOST_TRACED_PATHS: usize = 4096;

/// The smallest share of the free paths that a further opening must explain.
const LEAST_EXPLAINED_SHARE: f64 = 0.02;

/// The most free, and the most blocked, paths from which the openings in a plane are found.
const MOST_TELLING_PATHS: usize = 1024;

/// The smallest share of the paths through an opening that reach the emitter.
const LEAST_FREE_SHARE: f64 = 0.1;

impl Lighting<'_> {
    /// The openings in front of all emitting surfaces and skies. They depend on the scene alone, if there is time to look for them.
    pub(crate) fn look_out(&self, end: &Deadline) -> Openings {
        let skies: Vec<(u32, &FarSky)> = self.skies().collect();
        let areas = self.scene.area_luminaires();
        if areas.is_empty() && skies.is_empty() {
            return Openings::default();
        }
        let surface = Surface::of(self);
        let mut left = if without("opening-search") { 0 } else { MOST_TRIAL_RAYS };
        let of_sky = |&(number, sky): &(u32, &FarSky)| {
            let key = Key::new(u64::from(number)).with(SKIES);
            let finder = Finder { lighting: self, sought: Sought::Sky(sky), key, end };
            (number, finder.before_sky(&surface, sky, &mut left))
        };
        let of_skies = skies.iter().map(of_sky).collect();
        if left == 0 {
            return Openings::new(Vec::new(), of_skies);
        }
        let of_surface = |number: usize| {
            let source = &self.sources[self.starts[self.scene.luminaires().len() + number]];
            let SourceKind::Area { emitter, triangles } = &source.kind else { return None };
            let key = Key::new(number as u64);
            let sought = Sought::Surface { emitter, triangles };
            let finder = Finder { lighting: self, sought, key, end };
            finder.before(emitter, &surface, areas[number].back, &mut left)
        };
        Openings::new((0..areas.len()).map(of_surface).collect(), of_skies)
    }

    /// The skies of the scene, without their images, by the number of the luminaire.
    fn skies(&self) -> impl Iterator<Item = (u32, &FarSky)> {
        let of = |source: &Source| source.chain.is_empty();
        self.sources.iter().filter(move |source| of(source)).filter_map(|source| {
            match (&source.kind, source.luminaire) {
                (SourceKind::Sky(sky), LuminaireId::Luminaire(number)) => Some((number, sky)),
                _ => None,
            }
        })
    }
}

/// The sides that carry a map, for drawing places: half of them uniform by area, half uniform over triangles.
struct Surface {
    sides: Vec<(u32, bool)>,
    sums_m2: Vec<f64>,
}

impl Surface {
    fn of(lighting: &Lighting) -> Self {
        let scene = lighting.scene;
        let step = scene.triangle_count().div_ceil(MOST_TRIANGLES).max(1);
        let all = (0..scene.triangle_count()).step_by(step as usize);
        let all = all.flat_map(|triangle| [(triangle, false), (triangle, true)]);
        let sides: Vec<_> = all.filter(|&(t, back)| carries_map(scene, t, back)).collect();
        let mut sum_m2 = 0.0;
        let sums_m2 = sides.iter().map(|&(triangle, _)| {
            sum_m2 += scene.triangle(triangle).area();
            sum_m2
        });
        let sums_m2 = sums_m2.collect();
        Self { sides, sums_m2 }
    }

    fn place(&self, lighting: &Lighting, k: usize, dice: &mut Dice) -> SurfacePoint {
        let [pick, _] = dice.pair();
        let side = if k.is_multiple_of(2) {
            let at_m2 = pick * self.sums_m2.last().copied().unwrap_or(0.0);
            self.sums_m2.partition_point(|&sum_m2| sum_m2 <= at_m2).min(self.sides.len() - 1)
        } else {
            (pick * self.sides.len() as f64) as usize
        };
        let (triangle, back) = self.sides[side];
        let [a, b] = dice.pair();
        let root = a.sqrt();
        SurfacePoint::new(lighting.scene, triangle, back, root * (1.0 - b), root * b)
    }
}

/// What openings are sought for.
enum Sought<'a> {
    Surface { emitter: &'a Emitter, triangles: &'a [[Point; 3]] },
    Sky(&'a FarSky),
}

/// A search for openings in front of an emitter.
struct Finder<'a> {
    lighting: &'a Lighting<'a>,
    sought: Sought<'a>,
    key: Key,
    /// The end of the time for the search. After that there are no places to look from, and so no openings.
    end: &'a Deadline,
}

impl Finder<'_> {
    /// The openings in front of the emitter; `None` where they are of no use.
    fn before(
        &self,
        emitter: &Emitter,
        surface: &Surface,
        back: bool,
        left: &mut usize,
    ) -> Option<Before> {
        if surface.sides.is_empty() {
            return None;
        }
        // Most emitters are small: the search ends for these.
        let places = self.looked_from(surface, (SEARCH_ROUNDS[0].0, 0), self.key);
        let whole: f64 = places.iter().map(|looked| looked.whole).sum();
        if whole <= LEAST_DARK_SHARE * LEAST_UNOCCLUDED_SR * places.len() as f64 {
            return None;
        }
        let first = self.looks(surface, 0, left)?;
        let surrounds = first.len() == SEARCH_ROUNDS[0].0
            && first.iter().all(|l| l.whole >= SURROUNDING_SHARE * PI);
        let before = Before::surface(emitter.indices.clone(), back, surrounds);
        let before = self.with_openings(before, first, surface, left);
        (surrounds || before.zones.are_some()).then_some(before)
    }

    /// The openings in front of a sky, or none where they are of no use.
    fn before_sky(&self, surface: &Surface, sky: &FarSky, left: &mut usize) -> Before {
        let before = Before::sky(sky.clone());
        let first = (!surface.sides.is_empty()).then(|| self.looks(surface, 0, left)).flatten();
        match first {
            Some(first) => self.with_openings(before, first, surface, left),
            None => before,
        }
    }

    /// The emitter with the openings in front of it, if there are any and they are found in time.
    fn with_openings(
        &self,
        mut before: Before,
        first: Vec<Looked>,
        surface: &Surface,
        left: &mut usize,
    ) -> Before {
        if let Some(looked) = self.ways(first, surface, left) {
            before.openings = self.openings(&looked);
            let key = self.key.with(u64::MAX);
            let through = ThroughOpenings::of(self.lighting, &before, &looked, (key, self.end));
            match through {
                Some(through) => before.zones = through.zones(),
                None => before.openings.clear(),
            }
        }
        before
    }

    /// The places of a round with their trial rays. `None` after the last round, or if all emitters
    /// together have used up their trial rays.
    fn looks(&self, surface: &Surface, round: usize, left: &mut usize) -> Option<Vec<Looked>> {
        let &(places, looks) =
            SEARCH_ROUNDS.get(round).filter(|(places, looks)| places * looks <= *left)?;
        *left -= places * looks;
        Some(self.looked_from(surface, (places, looks), self.key.with(round as u64)))
    }

    fn looked_from(
        &self,
        surface: &Surface,
        (places, looks): (usize, usize),
        key: Key,
    ) -> Vec<Looked> {
        let one = |k: usize| self.looked(surface, (k, looks), key);
        (0..places).into_par_iter().filter_map(one).collect()
    }

    /// Places all over the scene with trial rays to the emitter, starting from `first`; `None`
    /// where openings are not worth it.
    fn ways(&self, first: Vec<Looked>, surface: &Surface, left: &mut usize) -> Option<Vec<Looked>> {
        let mut looked = first;
        for round in 1.. {
            let dark = || looked.iter().filter(|looked| looked.is_dark());
            let (count, whole) = (dark().count(), dark().map(|looked| looked.whole).sum::<f64>());
            let is_dark = count > 0 && count as f64 >= LEAST_DARK_SHARE * looked.len() as f64;
            if !is_dark || whole < LEAST_UNOCCLUDED_SR * count as f64 {
                return None;
            }
            let ways: usize = dark().map(|looked| looked.free.len()).sum();
            if ways >= ENOUGH_FREE_PATHS {
                break;
            }
            match self.looks(surface, round, left) {
                Some(more) => looked = more,
                None if ways >= FEWEST_FREE_PATHS => break,
                None => return None,
            }
        }
        Some(looked)
    }

    fn looked(&self, surface: &Surface, (k, looks): (usize, usize), key: Key) -> Option<Looked> {
        if self.end.has_passed() {
            return None;
        }
        let mut dice = Dice::new(Sequence::new(key), k as u32);
        let at = surface.place(self.lighting, k, &mut dice);
        let sequence = dice.fork();
        let dice = (0..looks).map(|k| Dice::new(sequence, k as u32));
        match self.sought {
            Sought::Surface { emitter, triangles } => {
                self.looked_at_surface(&at, (emitter, triangles), looks, dice)
            }
            Sought::Sky(sky) => Some(self.looked_at_sky(&at, sky, looks, dice)),
        }
    }

    fn looked_at_surface(
        &self,
        at: &SurfacePoint,
        (emitter, triangles): (&Emitter, &[[Point; 3]]),
        looks: usize,
        dice: impl Iterator<Item = Dice>,
    ) -> Option<Looked> {
        let shape = Shape::new(at, (emitter, triangles), looks.max(1))?;
        let mut found = Looked::nothing(at, shape.whole(), looks);
        for place in dice.filter_map(|mut dice| shape.place(&mut dice)) {
            let triangle = Some(emitter.indices[place.triangle]);
            let target = Target::Point(place.point);
            let is_free = !self.lighting.visibility(&[], at, target, triangle).is_black();
            if is_free { &mut found.free } else { &mut found.stopped }.push(place.point);
        }
        Some(found)
    }

    /// Looks at the sky over the hemisphere. Where it is dark there is nothing to see, free or not.
    fn looked_at_sky(
        &self,
        at: &SurfacePoint,
        sky: &FarSky,
        looks: usize,
        dice: impl Iterator<Item = Dice>,
    ) -> Looked {
        let bounds = self.lighting.scene.bvh().mesh().bounds();
        let beyond_m = bounds.map_or(1.0, |(low, high)| (high - low).length());
        let mut found = Looked::nothing(at, PI, looks);
        for mut dice in dice {
            let local = CosineHemisphere::sample(dice.pair());
            let towards = at.shading.to_direction().from_local(local);
            if sky.luminance_cd_m2(towards).is_black() {
                continue;
            }
            let target = Target::Infinity(towards);
            let is_free = !self.lighting.visibility(&[], at, target, None).is_black();
            let ways = if is_free { &mut found.free } else { &mut found.stopped };
            ways.push(at.point + towards * beyond_m);
        }
        found
    }

    /// Openings found from free and blocked paths between dark places and the emitter.
    fn openings(&self, looked: &[Looked]) -> Vec<Opening> {
        let dark = || looked.iter().filter(|looked| looked.is_dark());
        let ways = |to: fn(&Looked) -> &Vec<Point>| {
            let all = dark().flat_map(|l| to(l).iter().map(|&to| Way { from: l.at.point, to }));
            all.collect::<Vec<Way>>()
        };
        let (mut free, stopped) = (ways(|l| &l.free), ways(|l| &l.stopped));
        let stopped_at = dark().flat_map(|l| l.stopped.iter().map(|to| (&l.at, *to)));
        let stopped_at = stopped_at.take(MOST_TRACED_PATHS);
        let in_time = stopped_at.take_while(|_| !self.end.has_passed());
        let stopped_at = in_time.filter_map(|(at, to)| {
            let direction = (to - at.point).direction()?;
            self.lighting.first_opaque(at, direction).map(|(_, surface)| surface.triangle)
        });
        let planes = planes(self.lighting.scene, stopped_at);
        let worth = LEAST_EXPLAINED_SHARE * free.len() as f64;
        let mut found = Vec::new();
        while found.len() < MOST_OPENINGS {
            let shares = [free.len() as f64, stopped.len() as f64];
            let spread = |ways: &[Way]| {
                let step = ways.len().div_ceil(MOST_TELLING_PATHS).max(1);
                ways.iter().step_by(step).copied().collect::<Vec<Way>>()
            };
            let tell = [spread(&free), spread(&stopped)];
            let tried = planes.iter().map(|plane| worth_of(plane, &tell, shares));
            let best = tried.max_by(|a, b| a.0.total_cmp(&b.0));
            let Some((_, openings)) = best.filter(|best| best.0 >= worth) else { break };
            free.retain(|way| !openings.iter().any(|opening| way.passes(opening)));
            found.extend(openings);
        }
        found.truncate(MOST_OPENINGS);
        found
    }
}

/// The openings in a plane, and their worth: the number of free paths through them, each weighted by the share of all
/// paths through its opening that are free. `counts` are the numbers of all free and blocked paths; `tell` are samples.
fn worth_of(plane: &Plane, tell: &[Vec<Way>; 2], counts: [f64; 2]) -> (f64, Vec<Opening>) {
    let mut openings = plane.openings(&tell[0]);
    let mut worth = 0.0;
    openings.retain(|opening| {
        let count = |k: usize| {
            let passing = tell[k].iter().filter(|way| way.passes(opening)).count();
            passing as f64 * counts[k] / tell[k].len().max(1) as f64
        };
        let [free, stopped] = [count(0), count(1)];
        let share = free / (free + stopped).max(1.0);
        let is_one = share >= LEAST_FREE_SHARE;
        worth += if is_one { free * share } else { 0.0 };
        is_one
    });
    (worth, openings)
}
