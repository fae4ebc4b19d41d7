//! Gathering: what a receiver sees, as a row of a linear operator over the vertices of the map.
//!
//! From a receiver, cosine-distributed rays are followed to diffuse surfaces. There the direct light
//! is evaluated at once (or read from the map, where luminaires are many), and the indirect light
//! is left open: the ray becomes an entry of a sparse matrix, so that the light of all further
//! reflections is the fixed point of `E = source + A E`, solved without tracing the rays again.

use super::anderson::Anderson;
use super::bright::{self, Bright};
use super::carriers::Carriers;
use super::deadline::Deadline;
use super::direct::{About, Lighting};
use super::path::{Dice, PathEnd, follow_counted};
use super::surface::SurfacePoint;
use super::trust;
use crate::elements::{Elements, Place, Receiver};
use crate::map::Standing;
use crate::sampling::{CosineHemisphere, Key, Sequence};
use crate::scene::{Finish, Scene};
use crate::units::Rgb;
use isolux_geometry::{Normal, Point, Ray};
use rayon::prelude::*;

/// Receivers of one task: enough work to be worth handing out, few enough to share evenly.
const CHUNK: usize = 64;

/// A place that gathers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gatherer {
    /// Where rays start.
    pub(super) origin: Point,
    /// About what they are distributed.
    pub(super) normal: Normal,
    /// The place for direct light.
    pub(super) surface: SurfacePoint,
    /// How many rays.
    pub(super) rays: u32,
    /// Whether it lies in a gap: what its rays meet close by does not lie in the open.
    pub(super) in_gap: bool,
}

impl Gatherer {
    /// The receiver of a vertex. Its normal is that of the smooth surface, whose facets meet at it.
    pub(super) fn at_vertex(scene: &Scene, receiver: &Receiver, rays: u32) -> Self {
        let Receiver { point, normal, triangle, back } = *receiver;
        let flat = SurfacePoint::new(scene, triangle, back, 0.0, 0.0);
        let surface = SurfacePoint { point, shading: normal, geometric: normal, ..flat };
        let origin = SurfacePoint { point, ..flat }.start();
        Self { origin, normal, surface, rays, in_gap: false }
    }

    /// The same, in a gap or not.
    pub(super) const fn in_gap(self, in_gap: bool) -> Self {
        Self { in_gap, ..self }
    }

    /// The same with another number of rays.
    pub(super) const fn with_rays(self, rays: u32) -> Self {
        Self { rays, ..self }
    }

    /// A place inside a triangle.
    pub(super) fn on_surface(surface: SurfacePoint, rays: u32) -> Self {
        Self { origin: surface.start(), normal: surface.shading, surface, rays, in_gap: false }
    }

    /// Whether it lies where another does.
    fn is_at(&self, other: &Self) -> bool {
        self.origin == other.origin && self.surface.triangle == other.surface.triangle
    }

    /// A place in space that faces a way.
    pub(super) fn in_space(point: Point, normal: Normal, rays: u32) -> Self {
        Self {
            origin: point,
            normal,
            surface: SurfacePoint::in_space(point, normal),
            rays,
            in_gap: false,
        }
    }
}

/// Everything gathering reads.
pub(super) struct Gathering<'a> {
    pub(super) scene: &'a Scene,
    pub(super) lighting: &'a Lighting<'a>,
    pub(super) elements: &'a Elements,
    /// Nodes of the elements from this number on are finer than the level gathered over.
    pub(super) level: u32,
    /// What vertices stand for; those without have no value to be read.
    pub(super) standings: &'a [Option<Standing>],
    pub(super) direct: DirectAtEnds<'a>,
    /// Whether a ray that ends nearer than the element there is long gathers again from there, instead of
    /// reading a map that tells little of places so close to something: up to [`REGATHERED`] times.
    pub(super) regathers: bool,
    /// What is so bright that rays are sent there.
    pub(super) bright: Option<&'a Bright>,
}

/// Random numbers of rays that are sent to what is bright.
const SENT: u64 = 0x6272_6967_6874;

/// How often a ray goes on from surfaces that are close by. In a corner half of the rays meet the other wall close
/// by, and half of those the first again: with usual reflectances a hundredth of the light is left.
const REGATHERED: u32 = 3;

/// Where rays get the direct light of the surfaces that they end on.
#[derive(Clone, Copy)]
pub(super) enum DirectAtEnds<'a> {
    /// Evaluated there: no bias, but a source is drawn where there are many.
    Evaluated,
    /// Read from these values of vertices, nodes from number `level` on left out.
    Read {
        /// A value a vertex, lx.
        values: &'a [Rgb],
        /// As for indirect light, or finer.
        level: u32,
    },
    /// Read, but evaluated where a ray that regathers ends nearer than the element there is long: what stands that
    /// close may throw shadows that the map does not resolve.
    ReadFarOff {
        /// A value a vertex, lx.
        values: &'a [Rgb],
    },
}

/// From the light at receivers to what rays read at them.
pub(super) type Fitting<'a> = dyn Fn(&[Rgb]) -> Vec<Rgb> + 'a;

/// What a ray reads from the map: the light of three vertices.
#[derive(Clone, Copy, Debug)]
struct Entry {
    vertices: [u32; 3],
    weights: [f32; 3],
}

/// Entries of one row, one after the other, that reflect alike: rays end on few materials.
#[derive(Clone, Copy, Debug)]
struct Run {
    /// Where they end among all entries.
    end: u32,
    /// The share of what is read there that arrives at the receiver.
    share: [f32; 3],
}

/// Rows of the operator for consecutive receivers.
#[derive(Debug, Default)]
struct Rows {
    entries: Vec<Entry>,
    runs: Vec<Run>,
    /// End of the runs of every row.
    ends: Vec<usize>,
    /// Light that needs no further reflection, lx.
    sources: Vec<Rgb>,
    /// Whether some ray left the scene or came to a surface that could be lit.
    open: Vec<bool>,
    /// Of every row, the share of a unit of light that is read close by.
    close: Vec<f64>,
    /// Sum of the shares of rays that were given up on their way over specular surfaces.
    given_up: f64,
    /// Rays beside those of the receivers.
    further_rays: u64,
}

/// A row while it is made.
#[derive(Default)]
struct Row {
    source: Rgb,
    open: bool,
    close: f64,
    /// Surfaces that rays have come to and what they reflect, the latest last: kept, as to ask for memory at
    /// every ray takes its time.
    ends: Vec<Met>,
    /// What is seen from about the receiver, once it was asked for.
    about: Option<Option<About>>,
}

/// A surface that a ray has come to, and what it reflects along it.
#[derive(Clone, Copy)]
struct Met {
    surface: SurfacePoint,
    reflectance: Rgb,
    /// Whether nothing specular was between.
    straight: bool,
}

/// A ray of a row.
struct Leg<'a> {
    /// Where it starts, and the triangle there.
    origin: Point,
    triangle: u32,
    /// About what its direction is distributed.
    normal: Normal,
    /// What of the light there arrives at the receiver.
    share: Rgb,
    /// Whether it starts in a gap.
    in_gap: bool,
    /// How many rays came before it.
    number: u32,
    /// The place that gathers.
    receiver: &'a SurfacePoint,
    /// What is bright, as seen from there, if rays are sent to it, too.
    bright: Option<&'a bright::Seen<'a>>,
}

/// The operator of all receivers: one noisy sample of light transport.
pub(super) struct Operator {
    chunks: Vec<Rows>,
    /// Rows that have rays.
    receivers: usize,
    pub(super) rays: u64,
}

/// A place on the level gathered over, and the vertices and weights there.
#[derive(Clone, Copy)]
struct Located {
    place: Place,
    corners: [(u32, f64); 3],
}

/// A diffuse surface that a ray has come to.
struct LegEnd {
    surface: SurfacePoint,
    located: Option<Located>,
    /// Whether the map tells little there, so close to where the ray starts.
    is_close: bool,
    /// How far the ray has come if it starts in a gap.
    out_of_gap_m: Option<f64>,
}

impl Gathering<'_> {
    /// Traces the rays of all receivers; `key_of` gives each its random numbers.
    pub(super) fn operator(
        &self,
        gatherers: &[Gatherer],
        key_of: impl Fn(usize) -> Key + Sync,
    ) -> Operator {
        let whole = self.operator_until(Deadline::NEVER, gatherers, key_of);
        whole.expect("without a deadline nothing is given up")
    }

    /// The same; `None` if the deadline passes meanwhile.
    pub(super) fn operator_until(
        &self,
        deadline: Deadline,
        gatherers: &[Gatherer],
        key_of: impl Fn(usize) -> Key + Sync,
    ) -> Option<Operator> {
        let chunk = |(index, part): (usize, &[Gatherer])| {
            if deadline.has_passed() {
                return None;
            }
            let mut rows = Rows::default();
            rows.entries.reserve(part.iter().map(|g| g.rays as usize).sum());
            let mut row = Row::default();
            for (k, gatherer) in part.iter().enumerate() {
                // Readers have many rows of one place.
                let before = k.checked_sub(1).map(|k| &part[k]);
                let about = row.about.filter(|_| before.is_some_and(|b| b.is_at(gatherer)));
                row = Row { about, ..Row::default() };
                self.row(gatherer, key_of(index * CHUNK + k), &mut row, &mut rows);
            }
            Some(rows)
        };
        let chunks: Option<Vec<Rows>> =
            gatherers.par_chunks(CHUNK).enumerate().map(chunk).collect();
        let chunks = chunks?;
        let further: u64 = chunks.iter().map(|rows| rows.further_rays).sum();
        let rays = gatherers.iter().map(|g| u64::from(g.rays)).sum::<u64>() + further;
        let receivers = gatherers.iter().filter(|g| g.rays > 0).count();
        Some(Operator { chunks, receivers, rays })
    }

    fn row(&self, gatherer: &Gatherer, key: Key, row: &mut Row, rows: &mut Rows) {
        let sequence = Sequence::new(key);
        let Gatherer { origin, normal, rays, .. } = *gatherer;
        let bright = self.bright.and_then(|bright| bright.seen_from(origin, normal, rays));
        let first = Leg {
            origin,
            triangle: gatherer.surface.triangle,
            normal,
            share: Rgb::WHITE / f64::from(rays.max(1)),
            in_gap: gatherer.in_gap,
            number: 0,
            receiver: &gatherer.surface,
            bright: bright.as_ref(),
        };
        for index in 0..rays {
            self.leg(&first, &mut Dice::new(sequence, index), row, rows);
        }
        if let Some(bright) = &bright {
            let sequence = Sequence::new(key.with(SENT));
            for index in 0..bright.sent {
                self.send(&first, bright, &mut Dice::new(sequence, index), row);
            }
            rows.further_rays += u64::from(bright.sent);
        }
        rows.ends.push(rows.runs.len());
        rows.sources.push(row.source);
        rows.open.push(row.open);
        rows.close.push(row.close);
    }

    fn leg(&self, leg: &Leg<'_>, dice: &mut Dice, row: &mut Row, rows: &mut Rows) {
        let axis = leg.normal.to_direction();
        let direction = axis.from_local(CosineHemisphere::sample(dice.pair()));
        let ray = Ray::new(leg.origin, direction).skipping(leg.triangle);
        let first = row.ends.len();
        let met = |number: u32, surface: &SurfacePoint, finish: &Finish, throughput: Rgb| match self
            .end(surface, finish, throughput)
        {
            End::Lit(reflectance) => {
                let straight = number == 0;
                row.ends.push(Met { surface: *surface, reflectance, straight });
            }
            End::Black => row.open = true,
            End::Closed => {}
        };
        let end = follow_counted(self.scene, (ray, direction), dice, met);
        match end {
            PathEnd::Left => row.open = true,
            PathEnd::Absorbed => {}
            PathEnd::GivenUp(share) => rows.given_up += share * leg.share.luminance(),
        }
        for k in first..row.ends.len() {
            let Met { surface, reflectance, straight } = row.ends[k];
            let share = reflectance * leg.share;
            let distance_m = (surface.point - leg.origin).length();
            let end = self.leg_end(leg, surface, distance_m);
            let LegEnd { located, is_close, out_of_gap_m: out_of, .. } = end;
            let of_direct = match leg.bright.filter(|_| straight) {
                Some(bright) => reflectance * bright.share(self.elements, &surface),
                None => share,
            };
            row.source += of_direct * self.direct_at(&end, leg.receiver, &mut row.about, dice);
            if is_close && leg.number < REGATHERED {
                rows.further_rays += 1;
                let further = Leg {
                    origin: surface.start(),
                    triangle: surface.triangle,
                    normal: surface.shading,
                    share,
                    in_gap: leg.in_gap && self.is_in_gap(&surface, distance_m),
                    number: leg.number + 1,
                    receiver: leg.receiver,
                    bright: None,
                };
                self.leg(&further, dice, row, rows);
            } else if let Some(entry) = located.and_then(|l| self.entry(l.corners, out_of)) {
                row.close += if is_close { share.luminance() } else { 0.0 };
                rows.push(entry, share.0.map(|c| c as f32));
            }
        }
        row.ends.truncate(first);
    }

    /// A ray to what is bright: of the light there, what comes straight from luminaires alone.
    fn send(&self, leg: &Leg<'_>, bright: &bright::Seen<'_>, dice: &mut Dice, row: &mut Row) {
        let [pick, within] = [dice.pair(), dice.pair()];
        let Some((to, direction)) = bright.draw(self.scene, pick, within) else { return };
        let ray = Ray::new(leg.origin, direction).skipping(leg.triangle);
        let hit = self.scene.bvh().closest_hit(&ray);
        if hit.is_none_or(|hit| hit.triangle != to.triangle || hit.back != to.back) {
            return;
        }
        let Some(finish) = self.scene.material(to.triangle).finish(to.back) else { return };
        if let End::Lit(reflectance) = self.end(&to, finish, Rgb::WHITE) {
            let share = reflectance * bright.share(self.elements, &to);
            let end = self.leg_end(leg, to, (to.point - leg.origin).length());
            row.source += share * self.direct_at(&end, leg.receiver, &mut row.about, dice);
        }
    }

    /// Where a ray has ended.
    fn leg_end(&self, leg: &Leg<'_>, surface: SurfacePoint, distance_m: f64) -> LegEnd {
        // Once for all.
        let located = self.located(&surface);
        let is_near =
            |located: Located| distance_m <= self.edge_m(self.corners(&located, u32::MAX));
        let is_close = self.regathers && located.is_some_and(is_near);
        LegEnd { surface, located, is_close, out_of_gap_m: leg.in_gap.then_some(distance_m) }
    }

    /// A place on the level gathered over.
    fn located(&self, at: &SurfacePoint) -> Option<Located> {
        let SurfacePoint { triangle, back, u, v, .. } = *at;
        let place = self.elements.place(self.level, triangle, back, [u, v])?;
        Some(Located { place, corners: self.elements.corners(place) })
    }

    /// Vertices and weights of a place on that level or a finer one.
    fn corners(&self, of: &Located, level: u32) -> [(u32, f64); 3] {
        if level == self.level {
            return of.corners;
        }
        self.elements.corners(self.elements.below(of.place, level))
    }

    /// Whether a ray from within a gap may still be in it.
    fn is_in_gap(&self, at: &SurfacePoint, distance_m: f64) -> bool {
        distance_m < trust::NEAR * trust::edge_at_m(self.elements, at)
    }

    fn direct_at(
        &self,
        end: &LegEnd,
        receiver: &SurfacePoint,
        about: &mut Option<Option<About>>,
        dice: &mut Dice,
    ) -> Rgb {
        let read = |values: &[Rgb], level: u32| {
            let corners = end.located.map(|located| self.corners(&located, level));
            let known = corners.and_then(|corners| self.known(corners, end.out_of_gap_m));
            known.map_or(Rgb::BLACK, |corners| {
                corners.iter().map(|&(vertex, weight)| values[vertex as usize] * weight).sum()
            })
        };
        match self.direct {
            DirectAtEnds::Read { values, level } => read(values, level),
            DirectAtEnds::ReadFarOff { values } if !end.is_close => read(values, u32::MAX),
            DirectAtEnds::ReadFarOff { .. } => {
                let about = about.get_or_insert_with(|| {
                    self.lighting.about(receiver.point, trust::edge_at_m(self.elements, receiver))
                });
                match about {
                    Some(about) => self.lighting.estimate_by(about, &end.surface, dice),
                    None => self.lighting.estimate(&end.surface, dice),
                }
            }
            DirectAtEnds::Evaluated => self.lighting.estimate(&end.surface, dice),
        }
    }

    fn end(&self, surface: &SurfacePoint, finish: &Finish, throughput: Rgb) -> End {
        if surface.back && *finish == Finish::BLACK {
            return End::Closed;
        }
        let SurfacePoint { triangle, u, v, .. } = *surface;
        let reflectance = throughput * self.scene.diffuse_reflectance(finish, triangle, u, v);
        if reflectance.is_black() { End::Black } else { End::Lit(reflectance) }
    }

    /// The entry for an end, over the known vertices of its element; `None` if there is none.
    fn entry(&self, corners: [(u32, f64); 3], out_of_gap_m: Option<f64>) -> Option<Entry> {
        let corners = self.known(corners, out_of_gap_m)?;
        Some(Entry {
            vertices: corners.map(|(vertex, _)| vertex),
            weights: corners.map(|(_, weight)| weight as f32),
        })
    }

    /// Vertices and weights of a place, over the known ones; for a ray that has come so far from within a
    /// gap, over those in gaps as long as it may still be there.
    fn known(
        &self,
        corners: [(u32, f64); 3],
        out_of_gap_m: Option<f64>,
    ) -> Option<[(u32, f64); 3]> {
        let weights = if out_of_gap_m.is_some_and(|m| m < trust::NEAR * self.edge_m(corners)) {
            weights_in_gap(corners, self.standings)?
        } else {
            known_weights(corners, self.standings)?
        };
        Some([0, 1, 2].map(|k| (corners[k].0, weights[k])))
    }

    /// Longest edge of the element of some corners, m.
    fn edge_m(&self, corners: [(u32, f64); 3]) -> f64 {
        trust::longest_edge_m(self.elements, corners.map(|(vertex, _)| vertex))
    }
}

/// What a surface is to a gathering ray.
enum End {
    /// It reflects.
    Lit(Rgb),
    /// It could be lit, but reflects nothing diffusely.
    Black,
    /// It is the black back of something: nothing is ever lit there.
    Closed,
}

/// Known vertices and their weights at a place, nodes from number `level` on left out.
pub(super) fn known_at(
    elements: &Elements,
    level: u32,
    standings: &[Option<Standing>],
    at: &SurfacePoint,
) -> Option<[(u32, f64); 3]> {
    let corners = elements.locate_above(level, at.triangle, at.back, at.u, at.v)?;
    let weights = known_weights(corners, standings)?;
    Some([0, 1, 2].map(|k| (corners[k].0, weights[k])))
}

/// Interpolation weights over the known vertices of the highest standing alone.
pub(super) fn known_weights(
    corners: [(u32, f64); 3],
    standings: &[Option<Standing>],
) -> Option<[f64; 3]> {
    weights_of_highest(corners, corners.map(|(vertex, _)| standings[vertex as usize]))
}

/// The same over those in gaps; without any, light there is as little as none.
fn weights_in_gap(corners: [(u32, f64); 3], standings: &[Option<Standing>]) -> Option<[f64; 3]> {
    let in_gap = |standing: &Standing| *standing != Standing::Open;
    weights_of_highest(
        corners,
        corners.map(|(vertex, _)| standings[vertex as usize].filter(in_gap)),
    )
}

fn weights_of_highest(corners: [(u32, f64); 3], of: [Option<Standing>; 3]) -> Option<[f64; 3]> {
    let highest = Standing::highest(of)?;
    Some(weights_over(corners, of.map(|standing| standing == Some(highest))))
}

/// Interpolation weights over some of the vertices, at least one, alone.
fn weights_over(corners: [(u32, f64); 3], read: [bool; 3]) -> [f64; 3] {
    if read == [true; 3] {
        return corners.map(|(_, weight)| weight);
    }
    let weights = [0, 1, 2].map(|k| if read[k] { corners[k].1 } else { 0.0 });
    let sum: f64 = weights.iter().sum();
    // On the far side of the element only other vertices have weight.
    if sum < 1e-9 {
        let count = read.iter().filter(|&&read| read).count();
        return read.map(|read| if read { 1.0 / count as f64 } else { 0.0 });
    }
    weights.map(|w| w / sum)
}

impl Operator {
    /// `source + A light`, one value a receiver.
    pub(super) fn apply(&self, light: &[Rgb]) -> Vec<Rgb> {
        self.chunks.par_iter().flat_map_iter(|rows| rows.apply(light)).collect()
    }

    /// Adds the receivers of another.
    pub(super) fn append(&mut self, other: Self) {
        self.chunks.extend(other.chunks);
        self.receivers += other.receivers;
        self.rays += other.rays;
    }

    /// Whether each receiver is open: not closed in by black backs.
    pub(super) fn open(&self) -> Vec<bool> {
        self.chunks.iter().flat_map(|rows| rows.open.iter().copied()).collect()
    }

    /// Of every receiver, the share of a unit of light everywhere that it reads close by all the same.
    pub(super) fn close(&self) -> impl Iterator<Item = f64> + '_ {
        self.chunks.iter().flat_map(|rows| rows.close.iter().copied())
    }

    /// The share of all that is gathered whose rays were given up.
    pub(super) fn given_up(&self) -> f64 {
        self.chunks.iter().map(|rows| rows.given_up).sum::<f64>() / self.receivers.max(1) as f64
    }

    /// The fixed point `E = source + A (E + given)` over the first `given.len()` receivers, then one
    /// application for all of them. Starts from `guess`. Ends when a sweep changes nothing beyond
    /// `tolerance`, relative to the root mean square.
    pub(super) fn solve(
        &self,
        guess: &[Rgb],
        given: &[Rgb],
        carriers: &Carriers,
        tolerance: f64,
    ) -> Vec<Rgb> {
        self.solve_or_give_up(guess, given, (carriers, &<[Rgb]>::to_vec), tolerance).0
    }

    /// The same, and the root mean square of what the last sweep changed. What does not carry light is
    /// interpolated; with a fit, the light that is applied to is that of best fit.
    ///
    /// Changes shrink from sweep to sweep, in the end all by one factor, the greatest eigenvalue of
    /// the operator; [`Anderson`] takes what the sweeps have told of it into account.
    pub(super) fn solve_or_give_up(
        &self,
        guess: &[Rgb],
        given: &[Rgb],
        (carriers, fit): (&Carriers, &Fitting<'_>),
        tolerance: f64,
    ) -> (Vec<Rgb>, f64) {
        let apply = |light: &[Rgb]| {
            let mut gathered = self.apply(light);
            carriers.fill(&mut gathered);
            gathered
        };
        let with_given = |light: &[Rgb]| -> Vec<Rgb> {
            let mut light = fit(light);
            light.iter_mut().zip(given).for_each(|(e, &g)| *e += g);
            light
        };
        let mut light = guess.to_vec();
        let mut unsettled = 0.0;
        let mut mixing = Anderson::default();
        for _ in 0..MAX_SWEEPS {
            let mut next = apply(&with_given(&light));
            let (mut change, mut size) = (0.0, 0.0);
            for (a, b) in next.iter().zip(&light) {
                let (difference, value) = ((*a - *b).luminance(), a.luminance());
                change += difference * difference;
                size += value * value;
            }
            let settled = change <= tolerance * tolerance * size;
            unsettled = (change / light.len().max(1) as f64).sqrt();
            if settled {
                return (next, unsettled);
            }
            next.truncate(guess.len());
            light = mixing.next(&light, next);
        }
        (apply(&with_given(&light)), unsettled)
    }
}

/// Sweeps of the fixed point before giving up: at mean reflectance 0.99 the light left is e^-20.
const MAX_SWEEPS: usize = 2000;

impl Rows {
    /// Adds an entry to the row that is being made.
    fn push(&mut self, entry: Entry, share: [f32; 3]) {
        self.entries.push(entry);
        // As many as 32 bits count are 100 GB, more than a part of the receivers is ever given.
        let end = self.entries.len() as u32;
        let first_of_row = self.ends.last().copied().unwrap_or(0);
        match self.runs[first_of_row..].last_mut().filter(|run| run.share == share) {
            Some(run) => run.end = end,
            None => self.runs.push(Run { end, share }),
        }
    }

    fn apply(&self, light: &[Rgb]) -> Vec<Rgb> {
        let (mut run, mut entry) = (0, 0);
        let mut of_row = |(&end, &source): (&usize, &Rgb)| {
            let mut sum = source;
            for Run { end, share } in &self.runs[run..end] {
                let entries = &self.entries[entry..*end as usize];
                let read: Rgb = entries.iter().map(|entry| entry.light(light)).sum();
                sum += read * Rgb(share.map(f64::from));
                entry = *end as usize;
            }
            run = end;
            sum
        };
        self.ends.iter().zip(&self.sources).map(&mut of_row).collect()
    }
}

impl Entry {
    fn light(&self, light: &[Rgb]) -> Rgb {
        let mut value = Rgb::BLACK;
        for k in 0..3 {
            value += light[self.vertices[k] as usize] * f64::from(self.weights[k]);
        }
        value
    }
}
