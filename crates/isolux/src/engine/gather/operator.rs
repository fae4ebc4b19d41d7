//! The operator of gathering: a sparse matrix, the light that needs no further reflection, and the fixed point of
//! both.

use crate::engine::mesh::{Fit, Waiting, corrected};
use crate::engine::ray::{Anderson, Deadline, UNITS_OF_REFERENCE};
use crate::units::Rgb;
use rayon::prelude::*;

/// The light of three vertices that a ray reads from the map.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entry {
    pub(crate) vertices: [u32; 3],
    pub(crate) weights: [f32; 3],
}

/// Consecutive entries of one row with equal reflectance. Runs are long, since rays end on few materials.
#[derive(Clone, Copy, Debug)]
struct Run {
    /// The index after its last entry among all entries.
    end: u32,
    /// The share of the light read that arrives at the receiver.
    share: [f32; 3],
}

/// Rows of the operator for consecutive receivers.
#[derive(Debug, Default)]
pub(crate) struct Rows {
    pub(crate) entries: Vec<Entry>,
    runs: Vec<Run>,
    /// The index after the last run of each row.
    ends: Vec<usize>,
    /// The light of each row that needs no further reflection, lx.
    sources: Vec<Rgb>,
    /// The correction of each row by the control variate of walls, lx (see [`corrected`]).
    lacking: Vec<Rgb>,
    /// Whether some ray of each row left the scene or met a surface that could be lit.
    open: Vec<bool>,
    /// The share of a unit of light that each row reads close by.
    close: Vec<f64>,
    /// The summed shares of rays that were given up on their way over specular surfaces.
    pub(crate) given_up: f64,
    /// The number of rays beside those of the receivers.
    pub(crate) further_rays: u64,
}

/// A row given by a test: its light, and the vertices and weights of each of its rays.
#[cfg(test)]
pub(crate) type GivenRow = (Rgb, Vec<([u32; 3], [f32; 3])>);

/// The operator of all receivers: one noisy sample of light transport.
pub(crate) struct Operator {
    pub(crate) chunks: Vec<Rows>,
    /// The number of rows that have rays.
    pub(crate) receivers: usize,
    pub(crate) rays: u64,
}

impl Operator {
    /// The operator of given rows, all of one reflectance.
    #[cfg(test)]
    pub(crate) fn of_rows(rows: &[GivenRow], reflectance: f64) -> Self {
        let mut all = Rows::default();
        for (source, rays) in rows {
            let share = [(reflectance / rays.len() as f64) as f32; 3];
            rays.iter()
                .for_each(|&(vertices, weights)| all.push(Entry { vertices, weights }, share));
            all.end_row([*source, Rgb::BLACK], true, 0.0);
        }
        Self { chunks: vec![all], receivers: rows.len(), rays: 0 }
    }

    /// `source + A light`, one value per receiver, lx.
    pub(crate) fn apply(&self, light: &[Rgb]) -> Vec<Rgb> {
        let count = self.chunks.iter().map(|rows| rows.ends.len()).sum();
        let mut values = vec![Rgb::BLACK; count];
        let parts = parts(&self.chunks, &mut values);
        parts.into_par_iter().for_each(|(rows, part)| rows.apply(light, part));
        values
    }

    /// `A light`, one value per receiver, lx.
    pub(crate) fn reflected(&self, light: &[Rgb]) -> Vec<Rgb> {
        let reflected = |rows: &Rows| {
            let mut values = vec![Rgb::BLACK; rows.ends.len()];
            rows.add(light, &mut values);
            values
        };
        self.chunks.par_iter().flat_map_iter(reflected).collect()
    }

    /// `A` transposed, for white light, applied to values of receivers: the weight with which each of so many vertices is read.
    pub(crate) fn read_by(&self, receivers: &[f64], vertices: usize) -> Vec<f64> {
        let mut read = vec![0.0; vertices];
        let mut left = receivers;
        for rows in &self.chunks {
            let (part, others) = left.split_at(rows.ends.len());
            rows.add_read_by(part, &mut read);
            left = others;
        }
        read
    }

    /// The weight with which the mean of all rows reads each of so many vertices, for white light.
    pub(crate) fn weights(&self, vertices: usize) -> Vec<f64> {
        let count: usize = self.chunks.iter().map(|rows| rows.ends.len()).sum();
        self.read_by(&vec![1.0 / count as f64; count], vertices)
    }

    /// Appends the receivers of another operator.
    pub(crate) fn append(&mut self, other: Self) {
        self.chunks.extend(other.chunks);
        self.receivers += other.receivers;
        self.rays += other.rays;
    }

    /// Whether each receiver is open, that is, not closed in by black backs.
    pub(crate) fn open(&self) -> Vec<bool> {
        self.chunks.iter().flat_map(|rows| rows.open.iter().copied()).collect()
    }

    /// The share of a unit of light everywhere that each receiver still reads close by.
    pub(crate) fn close(&self) -> impl Iterator<Item = f64> + '_ {
        self.chunks.iter().flat_map(|rows| rows.close.iter().copied())
    }

    /// The share of all gathered light whose rays were given up.
    pub(crate) fn given_up(&self) -> f64 {
        self.chunks.iter().map(|rows| rows.given_up).sum::<f64>() / self.receivers.max(1) as f64
    }

    /// The fixed point `E = source + A (E + given)` over the first `given.len()` receivers, followed by one
    /// application for all receivers. The iteration starts from `guess`. It ends when a sweep changes nothing beyond
    /// `tolerance`, relative to the root mean square, or at the end of the time.
    pub(crate) fn solve(
        &self,
        guess: &[Rgb],
        given: &[Rgb],
        waiting: &Waiting,
        (tolerance, end): (f64, &Deadline),
    ) -> Vec<Rgb> {
        self.solve_or_give_up(guess, given, (waiting, None), (tolerance, end)).0
    }

    /// The fixed point as from [`Operator::solve`], and the root mean square change of the last sweep, lx. Vertices
    /// that do not carry light are interpolated. The operator is applied to the light of best fit, if a fit is given.
    ///
    /// Changes shrink from sweep to sweep, in the end all by one factor, the greatest eigenvalue of the operator.
    /// [`Anderson`] acceleration uses this. Rows, interpolation and fit have weights that are not negative, and rows
    /// sum to no more than the reflectance of surfaces. So no sweep returns more than it receives. The weights of
    /// interpolation and fit depend on the light. If [`FREE_SWEEPS`] sweeps have not settled, these weights stay
    /// fixed ([`Bounded`](crate::engine::mesh::Bounded)), and the rest shrinks in every sweep.
    pub(crate) fn solve_or_give_up(
        &self,
        guess: &[Rgb],
        given: &[Rgb],
        (waiting, fit): (&Waiting, Option<&Fit>),
        (tolerance, end): (f64, &Deadline),
    ) -> (Vec<Rgb>, f64) {
        let with_given = |mut light: Vec<Rgb>| -> Vec<Rgb> {
            light.iter_mut().zip(given).for_each(|(e, &g)| *e += g);
            light
        };
        let read = |light: &[Rgb]| {
            let light = &light[..given.len()];
            with_given(fit.map_or_else(|| light.to_vec(), |fit| fit.apply(light)))
        };
        let fill = |light: &mut [Rgb]| waiting.fill(light);
        let mut light = guess.to_vec();
        let lit = self.lit(given);
        light.iter_mut().zip(&lit).filter(|&(_, lit)| !lit).for_each(|(e, _)| *e = Rgb::BLACK);
        if let Some(rough) = Rough::of(self, guess.len(), waiting) {
            match self.settle_roughly(&rough, (light, waiting), read, (tolerance, end)) {
                Ok(settled) => return settled,
                Err(nearer) => light = nearer,
            }
        }
        let light = match self.settle(light, (&read, &fill), (FREE_SWEEPS, tolerance), end) {
            Ok(settled) => return settled,
            Err(nearer) => nearer,
        };
        let (fit, waiting) = (fit.map(|fit| fit.held(&light)), waiting.held(&light));
        let read = |light: &[Rgb]| {
            let light = &light[..given.len()];
            with_given(fit.as_ref().map_or_else(|| light.to_vec(), |fit| fit.apply(light)))
        };
        let fill = |light: &mut [Rgb]| waiting.fill(light);
        match self.settle(light, (&read, &fill), (MAX_SWEEPS, tolerance), end) {
            Ok(settled) => settled,
            Err(light) => {
                let next = self.swept(&light, (&read, &fill));
                let unsettled_lx = Settling::of(&next, &light).rms();
                (next, unsettled_lx)
            }
        }
    }

    /// Whether any light reaches each receiver after any number of reflections, with `given` light. It is true for
    /// receivers without rays.
    fn lit(&self, given: &[Rgb]) -> Vec<bool> {
        let mut lit: Vec<bool> = self.chunks.iter().flat_map(Rows::lit_by_themselves).collect();
        loop {
            let (mut first, mut has_changed) = (0, false);
            for rows in &self.chunks {
                has_changed |= rows.light(first, given, &mut lit);
                first += rows.ends.len();
            }
            if !has_changed {
                return lit;
            }
        }
    }

    /// The light after one sweep.
    fn swept(&self, light: &[Rgb], (read, fill): Rules<'_>) -> Vec<Rgb> {
        let mut next = self.apply(&read(light));
        fill(&mut next);
        next
    }

    /// Sweeps until the light settles, at most `most` times. The error is the light reached without success.
    fn settle(
        &self,
        mut light: Vec<Rgb>,
        rules: Rules<'_>,
        (most, tolerance): (usize, f64),
        end: &Deadline,
    ) -> Result<(Vec<Rgb>, f64), Vec<Rgb>> {
        let mut mixing = Anderson::new();
        for _ in 0..most {
            let mut next = self.swept(&light, rules);
            let settling = Settling::of(&next, &light);
            if settling.is_within(tolerance) || end.has_passed() {
                return Ok((next, settling.rms()));
            }
            next.truncate(light.len());
            let weights = weights(&next, &light);
            light = mixing.next(&light, next, &weights);
        }
        Err(light)
    }

    /// Sweeps until the light settles, where few vertices carry light. The further reflections of the change of a
    /// sweep are followed over a rough operator, whose rays read the nearest carrier. The error is the light reached
    /// without success.
    fn settle_roughly(
        &self,
        rough: &Rough,
        (mut light, waiting): (Vec<Rgb>, &Waiting),
        with_given: impl Fn(&[Rgb]) -> Vec<Rgb>,
        (tolerance, end): (f64, &Deadline),
    ) -> Result<(Vec<Rgb>, f64), Vec<Rgb>> {
        let carried = |light: &[Rgb]| -> Vec<Rgb> {
            rough.carriers.iter().map(|&v| light[v as usize]).collect()
        };
        let mut before = f64::INFINITY;
        for _ in 0..MAX_SWEEPS {
            let mut next = self.apply(&with_given(&light));
            let [now, then] = [carried(&next), carried(&light)];
            let settling = Settling::of(&now, &then);
            if settling.is_within(tolerance) || end.has_passed() {
                waiting.fill(&mut next);
                return Ok((next, settling.rms()));
            }
            if settling.relative > before * ROUGH_CHANGE_RATIO * ROUGH_CHANGE_RATIO {
                break;
            }
            before = settling.relative;
            let change: Vec<Rgb> = now.iter().zip(&then).map(|(&a, &b)| a - b).collect();
            let whole = rough.followed(change, &weights(&now, &then));
            let of = rough.carriers.iter().zip(then).zip(whole);
            of.zip(now).for_each(|(((&vertex, then), whole), now)| {
                // Light is not negative.
                let whole = then + whole;
                light[vertex as usize] = if whole.min_channel() < 0.0 { now } else { whole };
            });
            waiting.fill(&mut light);
        }
        Err(light)
    }
}

/// The largest ratio of changes of successive sweeps, root mean square, for which the rough operator still helps.
const ROUGH_CHANGE_RATIO: f64 = 0.5;
/// The relative change at which the iteration over the rough operator ends.
const ROUGH_TOLERANCE: f64 = 0.01;
/// The most iterations over the rough operator.
const MOST_ROUGH_ITERATIONS: usize = 100;

/// The most sweeps before giving up: at mean reflectance 0.99 the light left is e^-20.
const MAX_SWEEPS: usize = 2000;

/// The number of sweeps after which the weights of interpolation and fit stay fixed. At reflectance 0.9 without any
/// mixing, the light left is e^-10, less than any tolerance.
const FREE_SWEEPS: usize = 100;

/// The light that rays read, and the filling of vertices that do not gather.
type Rules<'a> = (&'a dyn Fn(&[Rgb]) -> Vec<Rgb>, &'a dyn Fn(&mut [Rgb]));

/// The largest relative change of a value, in root mean squares of all, so that a small room beside a bright yard
/// settles, too. Three take half a second more in the hall, of five (decision 42).
const MOST_CHANGE_RATIO: f64 = 10.0;

/// The changes by a sweep.
struct Settling {
    /// The mean square of the change, lx2.
    change: f64,
    /// The mean square of the change relative to the light at each place.
    relative: f64,
    /// The greatest square of that relative change.
    greatest: f64,
}

impl Settling {
    fn of(next: &[Rgb], light: &[Rgb]) -> Self {
        let count = next.len().min(light.len());
        let next = &next[..count];
        let (mut change, mut relative, mut greatest) = (0.0, 0.0, 0.0_f64);
        for ((a, b), weight) in next.iter().zip(light).zip(weights(next, light)) {
            let difference = (*a - *b).luminance();
            let of_value = (difference * weight) * (difference * weight);
            change += difference * difference;
            relative += of_value;
            greatest = greatest.max(of_value);
        }
        let count = count.max(1) as f64;
        Self { change: change / count, relative: relative / count, greatest }
    }

    fn is_within(&self, tolerance: f64) -> bool {
        let square = tolerance * tolerance;
        self.relative <= square && self.greatest <= MOST_CHANGE_RATIO * MOST_CHANGE_RATIO * square
    }

    fn rms(&self) -> f64 {
        self.change.sqrt()
    }
}

/// One over the light at each place, 1/lx. The light is the greater of before and after a sweep, and at least
/// a unit of the integer sums as a share of the root mean square, so that dim rooms settle by their own light.
fn weights(next: &[Rgb], light: &[Rgb]) -> Vec<f64> {
    let size: f64 = next.iter().map(|a| a.luminance() * a.luminance()).sum();
    let faint =
        ((size / next.len().max(1) as f64).sqrt() / UNITS_OF_REFERENCE).max(f64::MIN_POSITIVE);
    let one = |(a, b): (&Rgb, &Rgb)| 1.0 / a.luminance().abs().max(b.luminance().abs()).max(faint);
    next.iter().zip(light).map(one).collect()
}

/// Whether an iteration over the rough operator has changed light by no more than [`ROUGH_TOLERANCE`], relative.
fn is_followed(next: &[Rgb], whole: &[Rgb], weights: &[f64]) -> bool {
    let (mut change, mut size) = (0.0, 0.0);
    for ((a, b), weight) in next.iter().zip(whole).zip(weights) {
        let (difference, value) = ((*a - *b).luminance() * weight, a.luminance() * weight);
        change += difference * difference;
        size += value * value;
    }
    change <= ROUGH_TOLERANCE * ROUGH_TOLERANCE * size
}

/// An operator among carriers alone.
struct Rough {
    carriers: Vec<u32>,
    chunks: Vec<Rows>,
}

impl Rough {
    /// The rough operator, if rows are vertices and at most half of these carry light.
    fn of(operator: &Operator, vertices: usize, waiting: &Waiting) -> Option<Self> {
        let count: usize = operator.chunks.iter().map(|rows| rows.ends.len()).sum();
        if count != vertices || 2 * waiting.count() < vertices {
            return None;
        }
        let stands_for = waiting.nearest_carriers(vertices);
        let is_carrier = |vertex: usize| stands_for[vertex] == vertex as u32;
        let mut number = vec![u32::MAX; vertices];
        let carriers: Vec<u32> =
            (0..vertices).filter(|&v| is_carrier(v)).map(|v| v as u32).collect();
        carriers.iter().zip(0..).for_each(|(&vertex, k)| number[vertex as usize] = k);
        let read = |vertex: u32| number[stands_for[vertex as usize] as usize];
        let mut chunks = Vec::with_capacity(operator.chunks.len());
        let mut vertex = 0;
        for rows in &operator.chunks {
            let mut own = Rows {
                entries: rows
                    .entries
                    .iter()
                    .map(|entry| Entry { vertices: entry.vertices.map(read), ..*entry })
                    .collect(),
                runs: rows.runs.clone(),
                ..Rows::default()
            };
            // Rows of vertices that wait have no rays.
            for &end in &rows.ends {
                if is_carrier(vertex) {
                    own.ends.push(end);
                    own.sources.push(Rgb::BLACK);
                    own.lacking.push(Rgb::BLACK);
                }
                vertex += 1;
            }
            chunks.push(own);
        }
        Some(Self { carriers, chunks })
    }

    /// The sum of a change and all its further reflections, lx; `weights` are one over the light.
    fn followed(&self, change: Vec<Rgb>, weights: &[f64]) -> Vec<Rgb> {
        let mut whole = change.clone();
        let mut mixing = Anderson::new();
        for _ in 0..MOST_ROUGH_ITERATIONS {
            let mut next = change.clone();
            let parts = parts(&self.chunks, &mut next);
            parts.into_par_iter().for_each(|(rows, part)| rows.add(&whole, part));
            if is_followed(&next, &whole, weights) {
                return next;
            }
            whole = mixing.next(&whole, next, weights);
        }
        whole
    }
}

/// Rows, each with its own part of all values.
fn parts<'a>(chunks: &'a [Rows], mut values: &'a mut [Rgb]) -> Vec<(&'a Rows, &'a mut [Rgb])> {
    let part = |rows: &'a Rows| {
        let (part, others) = std::mem::take(&mut values).split_at_mut(rows.ends.len());
        values = others;
        (rows, part)
    };
    chunks.iter().map(part).collect()
}

/// The tolerance on sums of shares and weights, which are stored in `f32`: each is rounded by a relative 2^-24 at
/// most.
const ROW_SUM_TOLERANCE: f64 = 1e-6;

impl Rows {
    /// Adds an entry to the row under construction.
    pub(crate) fn push(&mut self, entry: Entry, share: [f32; 3]) {
        self.entries.push(entry);
        // As many entries as 32 bits count take 100 GB, more than one part of the receivers is ever given.
        let end = self.entries.len() as u32;
        let first_of_row = self.ends.last().copied().unwrap_or(0);
        match self.runs[first_of_row..].last_mut().filter(|run| run.share == share) {
            Some(run) => run.end = end,
            None => self.runs.push(Run { end, share }),
        }
    }

    /// Ends the row under construction.
    pub(crate) fn end_row(&mut self, [source, lacking]: [Rgb; 2], open: bool, close: f64) {
        self.hold_row();
        self.ends.push(self.runs.len());
        self.sources.push(source);
        self.lacking.push(lacking);
        self.open.push(open);
        self.close.push(close);
    }

    /// Scales the row under construction so that it returns no more than it receives. Roulette over specular surfaces
    /// may leave a few rays with too large a share. The excess counts as given up.
    fn hold_row(&mut self) {
        let first_of_row = self.ends.last().copied().unwrap_or(0);
        let mut entry = first_of_row.checked_sub(1).map_or(0, |before| self.runs[before].end);
        let mut sum = [0.0; 3];
        for Run { end, share } in &self.runs[first_of_row..] {
            let count = f64::from(end - entry);
            (0..3).for_each(|c| sum[c] += count * f64::from(share[c]));
            entry = *end;
        }
        let most = Rgb(sum).max_channel();
        if most > 1.0 + ROW_SUM_TOLERANCE {
            self.given_up += most - 1.0;
            for Run { share, .. } in &mut self.runs[first_of_row..] {
                *share = share.map(|c| (f64::from(c) / most) as f32);
            }
        }
    }

    /// Whether each row has light that needs no further reflection, or no rays.
    fn lit_by_themselves(&self) -> impl Iterator<Item = bool> + '_ {
        let first = |row: usize| row.checked_sub(1).map_or(0, |before| self.ends[before]);
        self.ends
            .iter()
            .enumerate()
            .map(move |(row, &end)| end == first(row) || !self.sources[row].is_black())
    }

    /// Marks rows that read lit vertices, where `first` is the number of the first row; returns whether any was
    /// marked.
    fn light(&self, first: usize, given: &[Rgb], lit: &mut [bool]) -> bool {
        let (mut run, mut has_changed) = (0_usize, false);
        for (row, &end) in self.ends.iter().enumerate() {
            if !lit[first + row] {
                let entry = run.checked_sub(1).map_or(0, |before: usize| self.runs[before].end);
                let last = self.runs[end - 1].end;
                let is_read = |of: &Entry| {
                    of.vertices.iter().zip(of.weights).any(|(&v, weight)| {
                        weight > 0.0 && (lit[v as usize] || !given[v as usize].is_black())
                    })
                };
                let is_lit = self.entries[entry as usize..last as usize].iter().any(is_read);
                (lit[first + row], has_changed) = (is_lit, has_changed || is_lit);
            }
            run = end;
        }
        has_changed
    }

    fn apply(&self, light: &[Rgb], values: &mut [Rgb]) {
        values.copy_from_slice(&self.sources);
        self.add(light, values);
        values.iter_mut().zip(&self.lacking).for_each(|(value, &lacking)| {
            *value = corrected(*value, lacking);
        });
    }

    /// Adds the weights with which rows of such values read each vertex.
    fn add_read_by(&self, receivers: &[f64], read: &mut [f64]) {
        let (mut run, mut entry) = (0, 0);
        for (value, &end) in receivers.iter().zip(&self.ends) {
            for Run { end, share } in &self.runs[run..end] {
                let value = value * Rgb(share.map(f64::from)).luminance();
                for of in &self.entries[entry..*end as usize] {
                    let weights = of.vertices.iter().zip(of.weights);
                    weights.for_each(|(&v, weight)| read[v as usize] += value * f64::from(weight));
                }
                entry = *end as usize;
            }
            run = end;
        }
    }

    /// Adds the light read to the values of all rows.
    fn add(&self, light: &[Rgb], values: &mut [Rgb]) {
        let (mut run, mut entry) = (0, 0);
        for (value, &end) in values.iter_mut().zip(&self.ends) {
            for Run { end, share } in &self.runs[run..end] {
                let entries = &self.entries[entry..*end as usize];
                let read: Rgb = entries.iter().map(|entry| entry.light(light)).sum();
                *value += read * Rgb(share.map(f64::from));
                entry = *end as usize;
            }
            run = end;
        }
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
