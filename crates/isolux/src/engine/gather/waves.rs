//! The rays of a row, traced as waves: all rays take one step before any takes the next.
//!
//! While one ray waits for memory or for the result of an instruction, others go on. Rays are traced together, their
//! ends are located together, and the data of the ends is in the cache when it is read.

use super::gatherer::{
    DirectAtEnds, Gatherer, Gathering, known_on_side, known_weights, weights_in_gap,
};
use super::operator::{Entry, Operator, Rows};
use super::{bright_surfaces, control_variate};
use crate::elements::Place;
use crate::engine::light::{NearbyLuminaires, Shadows};
use crate::engine::occlusion::nearby;
use crate::engine::ray::{Deadline, Dice, NEVER, PathEnd, SurfacePoint, follow_on};
use crate::sampling::{CosineHemisphere, Key, Sequence};
use crate::scene::Finish;
use crate::units::Rgb;
use isolux_geometry::{Direction, Hit, Normal, Point, Ray};
use rayon::prelude::*;

/// The number of receivers of one task: enough work to hand out, few enough to share evenly.
const MOST_TASK_RECEIVERS: usize = 64;
/// The least number of tasks where receivers are few.
const FEWEST_TASKS: usize = 16;
/// The least number of receivers of a task.
const FEWEST_TASK_RECEIVERS: usize = 4;

/// The number of rays of a row that are followed together.
const WAVE_RAYS: u32 = 64;

/// The key of the random numbers of rays sent to bright surfaces.
const SENT_RAYS_KEY: u64 = 0x6272_6967_6874;

/// The number of times a ray goes on from surfaces close by. In a corner half of the rays meet the other wall close
/// by, and half of those the first again: with usual reflectances a hundredth of the light is left.
const MOST_REGATHERINGS: u32 = 3;
/// The number of times a ray goes on where nothing is known in the gap that it may still be in. Russian roulette ends
/// most of them before.
const MOST_LOST_LEGS: u32 = 32;

/// The relative difference of light between the vertices of an element above which a shadow is taken to end
/// on it. Reading the light there errs by about as much. A half and a tenth are as good below shelves; with a
/// tenth, the places of the hall take half as long again (decision 49).
const UNEVEN_LIGHT_SHARE: f64 = 0.25;
/// The distance, in longest edges of the element, within which such elements are not read. Farther away many are
/// seen, and their errors balance. Without this limit, a picture of a room with 60 coloured lamps close to its
/// walls takes 88 s in place of 73 s and is patchy (decision 49).
const NEARBY_EDGES: f64 = 4.0;

/// A row under construction.
#[derive(Default)]
struct Row {
    source: Rgb,
    /// The correction by the control variate, lx: its exact value minus its estimate by these rays.
    lacking: Rgb,
    open: bool,
    close: f64,
    /// Luminaires near the receiver; the outer option is `None` until they are asked for.
    about: Option<Option<NearbyLuminaires>>,
}

/// What a gatherer sees of the walls and of bright surfaces, whatever its rays.
struct View<'a> {
    bright: Option<bright_surfaces::Seen<'a>>,
    walls: Vec<control_variate::Seen<'a>>,
}

/// Buffers of rays that are followed together. They are kept from row to row, since allocation takes time.
#[derive(Default)]
struct Wave {
    /// The random numbers of the rays begun, one for each.
    dice: Vec<Dice>,
    legs: Vec<Leg>,
    directions: Vec<Direction>,
    rays: Vec<Ray>,
    hits: Vec<Option<Hit>>,
    /// Diffuse surfaces that rays have met.
    met: Vec<Met>,
    /// The places of these surfaces on the level gathered over.
    places: Vec<Option<Place>>,
    /// These places with vertices and weights.
    located: Vec<Option<Located>>,
    /// Shadow rays that direct light there waits for.
    shadows: Shadows,
    /// Rays that go on from there.
    next: Vec<Leg>,
}

/// A ray of a row, or its continuation from where it has ended.
#[derive(Clone, Copy)]
struct Leg {
    /// The point where it starts.
    origin: Point,
    /// The triangle where it starts.
    triangle: u32,
    /// The axis of the distribution of its direction.
    normal: Normal,
    /// The share of the light at its end that arrives at the receiver.
    share: Rgb,
    /// Whether it starts in a gap.
    in_gap: bool,
    /// The number of the ray in the wave that it is part of.
    ray: u32,
}

/// The data that all rays of a row share.
struct Receiver<'a> {
    place: &'a SurfacePoint,
    /// Bright surfaces as seen from the receiver, if rays are sent to them.
    bright: Option<&'a bright_surfaces::Seen<'a>>,
}

/// A diffuse surface that a ray has met, with the reflectance along the ray.
#[derive(Clone, Copy)]
struct Met {
    leg: u32,
    surface: SurfacePoint,
    reflectance: Rgb,
    /// Whether the ray met no specular surface before.
    straight: bool,
}

/// A place on the level gathered over, with vertices and weights.
#[derive(Clone, Copy)]
struct Located {
    place: Place,
    corners: [(u32, f64); 3],
}

/// The end of a ray.
struct End {
    surface: SurfacePoint,
    located: Option<Located>,
    distance_m: f64,
    /// Whether the end is so close to the start of the ray that the map tells little there.
    is_close: bool,
    /// The length of the ray, m, if it starts in a gap.
    out_of_gap_m: Option<f64>,
}

/// The kind of surface that a gathering ray meets.
enum Side {
    /// A surface that reflects, with its reflectance.
    Lit(Rgb),
    /// A surface that could be lit, but reflects nothing diffusely.
    Black,
    /// The black back of an object, where nothing is ever lit.
    Closed,
}

impl Row {
    /// An empty row with the luminaires known near its receiver.
    fn after(about: Option<Option<NearbyLuminaires>>) -> Self {
        Self { about, ..Self::default() }
    }
}

impl Gathering<'_> {
    /// The operator from tracing the rays of all receivers; `key_of` gives each receiver its random numbers.
    pub(crate) fn operator(
        &self,
        gatherers: &[Gatherer],
        key_of: impl Fn(usize) -> Key + Sync,
    ) -> Operator {
        let of = (gatherers.len(), |k: usize| gatherers[k]);
        let whole = self.operator_until(&NEVER, of, key_of);
        whole.expect("without a deadline nothing is given up")
    }

    /// The operator as from [`Gathering::operator`], of a number of receivers that a function gives; `None` if the
    /// deadline passes meanwhile.
    pub(crate) fn operator_until(
        &self,
        deadline: &Deadline,
        (count, gatherer): (usize, impl Fn(usize) -> Gatherer + Sync),
        key_of: impl Fn(usize) -> Key + Sync,
    ) -> Option<Operator> {
        let size = count.div_ceil(FEWEST_TASKS).clamp(FEWEST_TASK_RECEIVERS, MOST_TASK_RECEIVERS);
        let chunk = |index: usize| {
            if deadline.has_passed() {
                return None;
            }
            let part = index * size..count.min((index + 1) * size);
            let part: Vec<Gatherer> = part.map(&gatherer).collect();
            let mut rows = Rows::default();
            rows.entries.reserve(part.iter().map(|g| g.rays as usize).sum());
            let (mut row, mut wave) = (Row::default(), Wave::default());
            let mut view = None;
            for (k, gatherer) in part.iter().enumerate() {
                // Readers make many rows for one place.
                let before = k.checked_sub(1).map(|k| &part[k]).filter(|b| b.is_at(gatherer));
                let about = row.about.filter(|_| before.is_some());
                row = Row::after(about);
                if before.is_none_or(|b| b.rays != gatherer.rays || b.normal != gatherer.normal) {
                    view = None;
                }
                let view = view.get_or_insert_with(|| self.view(gatherer));
                let key = key_of(index * size + k);
                self.row((gatherer, view), key, (&mut row, &mut wave), &mut rows);
            }
            let traced = part.iter().map(|of| u64::from(of.rays)).sum::<u64>() + rows.further_rays;
            Some((rows, traced, part.iter().filter(|of| of.rays > 0).count()))
        };
        let made: Option<Vec<_>> = (0..count.div_ceil(size)).into_par_iter().map(chunk).collect();
        let made = made?;
        let rays = made.iter().map(|(_, rays, _)| rays).sum();
        let receivers = made.iter().map(|(_, _, receivers)| receivers).sum();
        let chunks = made.into_iter().map(|(rows, ..)| rows).collect();
        Some(Operator { chunks, receivers, rays })
    }

    /// What a gatherer sees of the walls and of bright surfaces.
    fn view(&self, gatherer: &Gatherer) -> View<'_> {
        let Gatherer { origin, normal, rays, .. } = *gatherer;
        let walls = self.backdrop.filter(|_| rays > 0 && gatherer.behind.is_some());
        View {
            bright: self.bright.and_then(|bright| bright.seen_from(origin, normal, rays)),
            walls: walls.map_or(Vec::new(), |walls| walls.seen_from(&gatherer.stand())),
        }
    }

    fn row(
        &self,
        (gatherer, view): (&Gatherer, &View<'_>),
        key: Key,
        (row, wave): (&mut Row, &mut Wave),
        rows: &mut Rows,
    ) {
        let sequence = Sequence::new(key);
        let Gatherer { origin, normal, rays, in_gap, .. } = *gatherer;
        let behind = gatherer.behind.filter(|_| rays > 0 && self.backdrop.is_some());
        let View { bright, walls } = view;
        let receiver = Receiver { place: &gatherer.surface, bright: bright.as_ref() };
        let share = Rgb::WHITE / f64::from(rays.max(1));
        row.lacking = behind.unwrap_or(Rgb::BLACK);
        let triangle = gatherer.surface.triangle;
        let first = Leg { origin, triangle, normal, share, in_gap, ray: 0 };
        for start in (0..rays).step_by(WAVE_RAYS as usize) {
            let some = start..rays.min(start + WAVE_RAYS);
            wave.legs.clear();
            wave.legs.extend((0..some.len() as u32).map(|ray| Leg { ray, ..first }));
            wave.dice.clear();
            wave.dice.extend(some.map(|index| Dice::new(sequence, index)));
            for number in 0..=MOST_LOST_LEGS {
                self.trace(wave, row, rows);
                if number == 0 {
                    row.lacking += control_variate::lacking(walls, &wave.directions) * share;
                }
                self.locate(wave);
                self.read(&receiver, number, (row, wave), rows);
                if wave.legs.is_empty() {
                    break;
                }
            }
        }
        if let Some(bright) = bright {
            let sequence = Sequence::new(key.with(SENT_RAYS_KEY));
            for index in 0..bright.sent {
                row.source += self.sent(&first, bright, &mut Dice::new(sequence, index), rows);
            }
            rows.further_rays += u64::from(bright.sent);
        }
        rows.end_row([row.source, row.lacking], row.open, row.close);
    }

    /// Finds the diffuse surfaces that rays meet.
    fn trace(&self, wave: &mut Wave, row: &mut Row, rows: &mut Rows) {
        let Wave { dice, legs, directions, rays, hits, met, .. } = wave;
        directions.clear();
        directions.extend(legs.iter().map(|leg| {
            let local = CosineHemisphere::sample(dice[leg.ray as usize].pair());
            leg.normal.to_direction().from_local(local)
        }));
        rays.clear();
        let begun = legs.iter().zip(&*directions);
        rays.extend(begun.map(|(l, &d)| Ray::new(l.origin, d).skipping(l.triangle)));
        hits.clear();
        hits.resize(rays.len(), None);
        self.scene.bvh().closest_hits(rays, hits);
        met.clear();
        for (k, leg) in legs.iter().enumerate() {
            let dice = &mut dice[leg.ray as usize];
            let note = |number: u32, at: &SurfacePoint, finish: &Finish, throughput: Rgb| match self
                .side(at, finish, throughput)
            {
                Side::Lit(reflectance) => {
                    let (leg, straight) = (k as u32, number == 0);
                    met.push(Met { leg, surface: *at, reflectance, straight });
                }
                Side::Black => row.open = true,
                Side::Closed => {}
            };
            match follow_on(self.scene, hits[k], directions[k], dice, note) {
                PathEnd::Left => row.open = true,
                PathEnd::Absorbed => {}
                PathEnd::GivenUp(share) => rows.given_up += share * leg.share.luminance(),
            }
        }
    }

    /// Finds the places of these surfaces on the level gathered over.
    fn locate(&self, wave: &mut Wave) {
        let Wave { met, places, located, .. } = wave;
        places.clear();
        places.extend(met.iter().map(|met| {
            let SurfacePoint { triangle, back, u, v, .. } = met.surface;
            self.elements.place(self.level, triangle, back, [u, v])
        }));
        // Their data lies far apart in memory, so all of it is requested at once.
        located.clear();
        located.extend(places.iter().map(|place| place.map(|place| self.located(place))));
    }

    /// Reads the light at the ends of rays, or lets rays go on from there.
    fn read(
        &self,
        receiver: &Receiver<'_>,
        number: u32,
        (row, wave): (&mut Row, &mut Wave),
        rows: &mut Rows,
    ) {
        let Wave { dice, legs, met, located, shadows, next, .. } = wave;
        next.clear();
        for (met, &located) in met.iter().zip(&*located) {
            let leg = &legs[met.leg as usize];
            let share = met.reflectance * leg.share;
            let end = self.end(leg, met.surface, located);
            let dice = &mut dice[leg.ray as usize];
            let spot = self.bright.and_then(|bright| bright.at(&end.surface));
            let is_evaluated = spot.is_some() || matches!(self.direct, DirectAtEnds::Evaluated);
            // Rays sent to the bright surface find this light, too.
            let beside_sent = spot.filter(|_| met.straight).map_or(1.0, |spot| {
                let seen = if number == 0 { None } else { self.bright_from(leg) };
                let seen = if number == 0 { receiver.bright } else { seen.as_ref() };
                seen.map_or(1.0, |seen| seen.share(spot, &end.surface))
            });
            let of_direct = share * beside_sent;
            row.source += if is_evaluated {
                self.lighting.estimate_later(&end.surface, of_direct, dice, shadows)
            } else {
                of_direct * self.direct_at(&end, receiver.place, &mut row.about, dice)
            };
            let goes_on = |share: Rgb, in_gap: bool| Leg {
                origin: end.surface.start(),
                triangle: end.surface.triangle,
                normal: end.surface.shading,
                share,
                in_gap,
                ray: leg.ray,
            };
            if end.is_close && number < MOST_REGATHERINGS {
                let in_gap = leg.in_gap && self.is_in_gap(&end.surface, end.distance_m);
                let leg = goes_on(share, in_gap);
                row.source += self.sent_on(&leg, dice, rows);
                next.push(leg);
            } else if let Some(entry) = located.and_then(|l| self.entry(&l, end.out_of_gap_m)) {
                row.close += if end.is_close { share.luminance() } else { 0.0 };
                if end.is_close || bright_surfaces::sent_alone(beside_sent).is_none() {
                    rows.push(entry, share.0.map(|c| c as f32));
                }
            } else if self.is_lost(&end) && number < MOST_LOST_LEGS {
                let survival = met.reflectance.max_channel().min(1.0);
                if dice.pair()[0] < survival {
                    let leg = goes_on(share / survival, true);
                    row.source += self.sent_on(&leg, dice, rows);
                    next.push(leg);
                }
            }
        }
        row.source += self.lighting.answer(shadows);
        rows.further_rays += next.len() as u64;
        std::mem::swap(legs, next);
    }

    /// Bright surfaces as seen from the start of a ray that goes on.
    fn bright_from(&self, leg: &Leg) -> Option<bright_surfaces::Seen<'_>> {
        self.bright.and_then(|bright| bright.seen_from(leg.origin, leg.normal, 1))
    }

    /// The light that rays sent from there to bright surfaces find, lx.
    fn sent_on(&self, leg: &Leg, dice: &mut Dice, rows: &mut Rows) -> Rgb {
        let Some(bright) = self.bright_from(leg) else { return Rgb::BLACK };
        rows.further_rays += u64::from(bright.sent);
        (0..bright.sent).map(|_| self.sent(leg, &bright, dice, rows)).sum()
    }

    /// The light found by one ray sent to a bright surface, lx: direct light from luminaires. Where other rays seldom
    /// come, the ray also adds an entry to the row, but not close by, where other rays go on.
    fn sent(
        &self,
        leg: &Leg,
        bright: &bright_surfaces::Seen<'_>,
        dice: &mut Dice,
        rows: &mut Rows,
    ) -> Rgb {
        let [pick, within] = [dice.pair(), dice.pair()];
        let Some((to, spot)) = bright.draw((self.scene, leg.triangle), pick, within) else {
            return Rgb::BLACK;
        };
        let Some(finish) = self.scene.material(to.triangle).finish(to.back) else {
            return Rgb::BLACK;
        };
        let Side::Lit(reflectance) = self.side(&to, finish, Rgb::WHITE) else { return Rgb::BLACK };
        let reflected = leg.share * reflectance;
        let beside_others = bright.share(spot, &to);
        let place = self.elements.place(self.level, to.triangle, to.back, [to.u, to.v]);
        let located = place.map(|place| self.located(place));
        let end = self.end(leg, to, located);
        let entry = located.and_then(|l| self.entry(&l, end.out_of_gap_m));
        let alone = bright_surfaces::sent_alone(beside_others).filter(|_| !end.is_close);
        if let Some((entry, alone)) = entry.zip(alone) {
            rows.push(entry, (reflected * alone).0.map(|c| c as f32));
        }
        reflected * beside_others * self.lighting.estimate(&end.surface, dice)
    }

    /// The end of a ray on a surface.
    fn end(&self, leg: &Leg, surface: SurfacePoint, located: Option<Located>) -> End {
        let distance_m = (surface.point - leg.origin).length();
        let is_near =
            |located: Located| distance_m <= self.edge_m(self.corners(&located, u32::MAX));
        let is_close = self.regathers && located.is_some_and(is_near);
        let out_of_gap_m = leg.in_gap.then_some(distance_m);
        End { surface, located, distance_m, is_close, out_of_gap_m }
    }

    fn located(&self, place: Place) -> Located {
        Located { place, corners: self.elements.corners(place) }
    }

    /// Vertices and weights of a place on the level gathered over or a finer one.
    fn corners(&self, of: &Located, level: u32) -> [(u32, f64); 3] {
        if level == self.level {
            return of.corners;
        }
        self.elements.corners(self.elements.below(of.place, level))
    }

    /// Whether a ray from within a gap may still be in it.
    fn is_in_gap(&self, at: &SurfacePoint, distance_m: f64) -> bool {
        distance_m < nearby::NEAR * nearby::edge_at_m(self.elements, at)
    }

    /// Whether nothing is known of the gap that a ray has ended in.
    fn is_lost(&self, end: &End) -> bool {
        let Some((from_m, located)) = end.out_of_gap_m.zip(end.located) else { return false };
        let may_be_in_gap = from_m < nearby::NEAR * self.edge_m(located.corners);
        may_be_in_gap && weights_in_gap(located.corners, self.standings).is_none()
    }

    /// Whether values differ, or may differ, so much over a nearby element that its vertices tell little of the light
    /// between.
    fn is_uneven(&self, end: &End, values: &[Rgb], varying: Option<&[bool]>) -> bool {
        let Some(located) = end.located else { return false };
        let corners = self.corners(&located, u32::MAX);
        if end.distance_m > NEARBY_EDGES * self.edge_m(corners) {
            return false;
        }
        if varying.is_some_and(|varying| varying[located.place.node() as usize]) {
            return true;
        }
        let all = corners.map(|(vertex, _)| values[vertex as usize].luminance());
        let high = all.into_iter().fold(0.0, f64::max);
        let low = all.into_iter().fold(high, f64::min);
        high - low > UNEVEN_LIGHT_SHARE * high
    }

    fn direct_at(
        &self,
        end: &End,
        receiver: &SurfacePoint,
        about: &mut Option<Option<NearbyLuminaires>>,
        dice: &mut Dice,
    ) -> Rgb {
        let read = |values: &[Rgb], level: u32| {
            let corners = end.located.map(|located| self.corners(&located, level));
            let known = corners.and_then(|corners| self.known(corners, end.out_of_gap_m));
            known.map_or(Rgb::BLACK, |corners| {
                corners.iter().map(|&(vertex, weight)| values[vertex as usize] * weight).sum()
            })
        };
        let is_known = !self.is_lost(end);
        match self.direct {
            DirectAtEnds::Evaluated => self.lighting.estimate(&end.surface, dice),
            DirectAtEnds::Read { values, level } if is_known => read(values, level),
            DirectAtEnds::ReadFarOff { values, varying } if is_known && !end.is_close => {
                if self.is_uneven(end, values, varying) {
                    return self.lighting.estimate(&end.surface, dice);
                }
                read(values, u32::MAX)
            }
            DirectAtEnds::Read { .. } | DirectAtEnds::ReadFarOff { .. } => {
                let about = about.get_or_insert_with(|| {
                    self.lighting.about(receiver.point, nearby::edge_at_m(self.elements, receiver))
                });
                match about {
                    Some(about) => self.lighting.estimate_by(about, &end.surface, dice),
                    None => self.lighting.estimate(&end.surface, dice),
                }
            }
        }
    }

    fn side(&self, surface: &SurfacePoint, finish: &Finish, throughput: Rgb) -> Side {
        if surface.back && *finish == Finish::BLACK {
            return Side::Closed;
        }
        let SurfacePoint { triangle, u, v, .. } = *surface;
        let reflectance = throughput * self.scene.diffuse_reflectance(finish, triangle, u, v);
        if reflectance.is_black() { Side::Black } else { Side::Lit(reflectance) }
    }

    /// The entry for an end, over the known vertices of its element; `None` if there is none.
    fn entry(&self, at: &Located, out_of_gap_m: Option<f64>) -> Option<Entry> {
        let cut = self.cuts.and_then(|cuts| cuts.of_node(at.place.node()));
        // Vertices beyond a barrier are not read, even if none is known on this side.
        let corners = match cut {
            Some(cut) => known_on_side(at.corners, self.standings, cut),
            None => self.known(at.corners, out_of_gap_m),
        }?;
        Some(Entry {
            vertices: corners.map(|(vertex, _)| vertex),
            weights: corners.map(|(_, weight)| weight as f32),
        })
    }

    /// Vertices and weights of a place, over the known vertices. For a ray that starts in a gap and may still be in
    /// it, only vertices in gaps count.
    fn known(
        &self,
        corners: [(u32, f64); 3],
        out_of_gap_m: Option<f64>,
    ) -> Option<[(u32, f64); 3]> {
        let weights = if out_of_gap_m.is_some_and(|m| m < nearby::NEAR * self.edge_m(corners)) {
            weights_in_gap(corners, self.standings)?
        } else {
            known_weights(corners, self.standings)?
        };
        Some([0, 1, 2].map(|k| (corners[k].0, weights[k])))
    }

    /// Longest edge of the element of three corners, m.
    fn edge_m(&self, corners: [(u32, f64); 3]) -> f64 {
        nearby::longest_edge_m(self.elements, corners.map(|(vertex, _)| vertex))
    }
}
