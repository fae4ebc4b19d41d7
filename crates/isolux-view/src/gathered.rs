//! Views from a map whose indirect light is gathered where the map is not to be trusted, as readings have it: on a net of
//! pixels, so that few of them take rays.

use crate::camera::View;
use crate::direct::DirectField;
use crate::error::ViewError;
use crate::image::{LuminanceImage, Size, Surface};
use crate::middles::{Middles, on_side, surface};
use crate::trace::{SurfacePoint, TraceSettings, trace_watched};
use isolux::engine::net::{Filled, Fineness, Net, Wanted};
use isolux::engine::{Allowance, IndirectReading, MapReader, PictureLight, ShadowRays, Told};
use isolux::map::{Illuminance, IlluminationMap};
use isolux::scene::Scene;
use isolux::units::Rgb;
use rayon::prelude::*;
use std::collections::HashMap;
use std::convert::Infallible;
use std::sync::{Mutex, PoisonError};

/// The net over blocks of pixels: as for pixels, in half of the numbers.
const FINENESS: Fineness = Fineness {
    widest: Fineness::PIXELS.widest / BLOCK_WIDTH,
    finest: Fineness::PIXELS.finest / BLOCK_WIDTH,
    ..Fineness::PIXELS
};
/// Pixels across the blocks that share their indirect light.
const BLOCK_WIDTH: usize = 2;
/// Numbers of pixels at a time whose light is gathered.
const BLOCK: usize = 64;
/// Pixels that are gathered between two words to whoever watches.
const WATCHED: usize = 1024;
/// Noise of what is gathered, as a share of all light, before it is smoothed; and what elements may be expected to err by, which is seen as
/// their pattern.
const ALLOWANCE: Allowance = Allowance { noise: 0.08, interpolation: 0.02, number: 0 };
/// Shadow rays of a place in a pixel across the edge of a shadow. The cells of the pixel share its noise.
const CELL_RAYS: ShadowRays = ShadowRays { fewest: 8, most: 16 };
/// Pixels over which the difference that gathering made fades out.
const FADE: u32 = 32;
/// Times that what fades out is evened along the way.
const SMOOTHINGS: u32 = 3;
/// What the map tells is changed by no more than so many of its standard errors.
const MOST_ERRORS: f64 = 2.0;

/// Where a view has its indirect light from, by places of surfaces: one of each in a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Gathered {
    /// The map is to be trusted: interpolated.
    pub interpolated: usize,
    /// Gathered over the map, by rays of their own.
    pub gathered: usize,
    /// Continued from those by planes.
    pub continued: usize,
}

/// What is being done for a view, and the share of it that is done, as far as that can be foreseen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ViewProgress {
    /// Direct light is evaluated.
    Lighting(f64),
    /// Indirect light is gathered.
    Gathering(f64),
    /// Pixels are looked at.
    Looking(f64),
}

/// A map to be looked at.
pub struct MapViewer<'a> {
    scene: &'a Scene,
    map: &'a IlluminationMap,
    reader: MapReader<'a>,
}

impl<'a> MapViewer<'a> {
    /// Prepares the luminaires of the scene of a map.
    pub fn new(scene: &'a Scene, map: &'a IlluminationMap) -> Self {
        Self { scene, map, reader: MapReader::new(scene, map) }
    }

    /// Looks at a scene with the light of its map: direct light evaluated afresh, indirect light as [`MapReader::at`] reads it,
    /// gathered where the map is not to be trusted and interpolated elsewhere, and in what gloss and faint panes show. Both are
    /// evaluated in the middles of few pixels and continued to those about on the same piece of surface: direct light where it
    /// is smooth, indirect light within half of the error of a reading or 2 % of the light (best effort: pieces that no middle
    /// of a pixel nearby shows are interpolated). `watch` is told how far that is.
    pub fn trace(
        &self,
        view: impl Into<View>,
        size: Size,
        (settings, watch): (&TraceSettings, &mut dyn FnMut(ViewProgress)),
    ) -> Result<(LuminanceImage, Gathered), ViewError> {
        let (scene, map, reader) = (self.scene, self.map, &self.reader);
        let view = view.into();
        let middles = Middles::of(scene, size, asked(scene, view, size, (settings, watch))?);
        let round = settings.round;
        let direct = DirectField::new(&middles, (reader, map), round, |share| {
            watch(ViewProgress::Lighting(share));
        });
        let allowance = Allowance { number: round, ..ALLOWANCE };
        let (light, report) = PixelLight::new((&middles, map), (reader, allowance), watch);
        let read = |at: SurfacePoint| -> Option<Illuminance> {
            let SurfacePoint { triangle, back, u, v, blurred, .. } = at;
            let of_map = || map.interpolate(triangle, back, u, v);
            if blurred {
                return of_map();
            }
            let surface = surface(scene, &at);
            let indirect = match light.at(reader, (&at, &surface)) {
                Light::OfMap => None,
                Light::Gathered(reading) => Some(reading),
                Light::Beside(more) => of_map().map(|stored| IndirectReading {
                    lx: (stored.indirect_lx + more).map(|c| c.max(0.0)),
                    error_lx: stored.indirect_standard_error_lx,
                    noise_lx: stored.indirect_standard_error_lx,
                }),
            };
            let known = PictureLight { direct_lx: direct.at((&at, &surface)), indirect };
            reader.glance(on_side(&at), (round, CELL_RAYS), known)
        };
        let watch = &mut |share| watch(ViewProgress::Looking(share));
        let image = trace_watched(scene, view, size, settings, (&read, watch))?;
        Ok((image, report))
    }
}

/// A look in the dark: what is to be seen sharply in the middles of pixels, in their order.
fn asked(
    scene: &Scene,
    view: View,
    size: Size,
    (settings, watch): (&TraceSettings, &mut dyn FnMut(ViewProgress)),
) -> Result<Vec<SurfacePoint>, ViewError> {
    let middles =
        TraceSettings { samples_per_side: 1, gloss_samples: 1, highlights: false, ..*settings };
    let all = Mutex::new(Vec::new());
    let ask = |at: SurfacePoint| {
        if !at.blurred {
            all.lock().unwrap_or_else(PoisonError::into_inner).push(at);
        }
        None
    };
    // What is to be lit is not known yet.
    let watch = &mut |_| watch(ViewProgress::Lighting(0.0));
    trace_watched(scene, view, size, &middles, (&ask, watch))?;
    let mut all = all.into_inner().unwrap_or_else(PoisonError::into_inner);
    let key = |at: &SurfacePoint| (at.pixel, at.path);
    all.sort_unstable_by(|a, b| {
        let place = |at: &SurfacePoint| (at.triangle, at.back, at.u.to_bits(), at.v.to_bits());
        key(a).cmp(&key(b)).then(place(a).cmp(&place(b)))
    });
    all.dedup_by_key(|at| key(at));
    Ok(all)
}

/// The indirect light of what the middle of a pixel shows.
struct Entry {
    /// Whether it lies in a gap, where light is gathered.
    wanted: Option<bool>,
    /// Standard error of what the map tells elsewhere, lx.
    error_lx: f64,
    light: Light,
}

/// The indirect light of a place.
#[derive(Clone, Copy)]
enum Light {
    /// As the map has it.
    OfMap,
    /// Gathered, or continued from what was.
    Gathered(IndirectReading),
    /// So much more than the map has: next to where it is gathered.
    Beside(Rgb),
}

/// Indirect light of pixels, where it is gathered.
struct PixelLight<'a> {
    middles: &'a Middles,
    /// One for each middle.
    entries: Vec<Entry>,
}

impl<'a> PixelLight<'a> {
    fn new(
        (middles, map): (&'a Middles, &IlluminationMap),
        (reader, allowance): (&MapReader<'_>, Allowance),
        watch: &mut dyn FnMut(ViewProgress),
    ) -> (Self, Gathered) {
        let entry = |number: usize| Entry::new(reader, middles.place(number));
        let entries = (0..middles.count()).into_par_iter().map(entry).collect();
        let mut pixels = Self { middles, entries };
        let mut report = Gathered::default();
        let place = |number: usize| on_side(middles.place(number));
        let sight = |from: usize, to: usize| reader.sees(place(from), place(to));
        let wanted = pixels.wanted();
        let (blocks, asked) = Blocks::of(wanted, middles.count());
        let mut net = Net::new(asked, FINENESS, Box::new(sight));
        let mut done = 0.0;
        let gather = |numbers: &[usize], more: f64| -> Result<Vec<_>, Infallible> {
            let one = |&number: &usize| reader.indirect_at(place(number), allowance);
            let mut found = Vec::with_capacity(numbers.len());
            for some in numbers.chunks(WATCHED) {
                let left = (numbers.len() - found.len()) as f64 + more;
                watch(ViewProgress::Gathering(done / (done + left)));
                found.par_extend(some.par_iter().with_max_len(BLOCK).map(one));
                done += some.len() as f64;
            }
            Ok(found)
        };
        let Ok(()) = net.fill(gather);
        let filled: Vec<Filled> = net.filled().collect();
        drop(net);
        report.gathered = filled.iter().filter(|filled| filled.is_gathered).count();
        let light = blocks.spread(&filled, middles);
        report.continued = light.len() - report.gathered;
        for (number, reading) in light {
            pixels.entries[number].light = reading.map_or(Light::OfMap, Light::Gathered);
        }
        report.interpolated = pixels.entries.len() - report.gathered - report.continued;
        pixels.fade(map);
        (pixels, report)
    }

    /// Pixels whose light is to be gathered, each with the piece of surface that it hangs together with.
    fn wanted(&self) -> Vec<Wanted> {
        let middles = self.middles;
        let width = middles.width();
        let mut pieces: Vec<usize> = (0..self.entries.len()).collect();
        for (number, entry) in self.entries.iter().enumerate() {
            if entry.wanted.is_none() {
                continue;
            }
            for other in middles.right_and_below(number) {
                let is_alike = entry.wanted == self.entries[other].wanted;
                if is_alike && middles.are_one_piece(number, other) {
                    let [a, b] = [number, other].map(|number| root(&mut pieces, number));
                    pieces[a.max(b)] = a.min(b);
                }
            }
        }
        let wanted =
            (0..self.entries.len()).filter(|&number| self.entries[number].wanted.is_some());
        wanted
            .map(|number| {
                let pixel = middles.place(number).pixel;
                let kind = root(&mut pieces, number) as u64;
                Wanted { number, at: [pixel % width, pixel / width], kind }
            })
            .collect()
    }

    /// Lets what gathering changed fade out next to where light is gathered, within the interval that the map states there: it
    /// may err by as much as the limit of its trust, which would be seen as a line.
    fn fade(&mut self, map: &IlluminationMap) {
        let mut more: Vec<Option<Rgb>> =
            (0..self.entries.len()).map(|number| self.changed(number, map)).collect();
        let mut front: Vec<usize> =
            (0..more.len()).filter(|&number| more[number].is_some()).collect();
        for step in 1..=FADE {
            let is_left =
                |&next: &usize| more[next].is_none() && self.entries[next].wanted.is_none();
            let mut next: Vec<usize> = front
                .iter()
                .flat_map(|&number| self.middles.beside(number))
                .filter(is_left)
                .collect();
            next.sort_unstable();
            next.dedup();
            // Once to go on, and then along the front: what differs there is noise.
            for _ in 0..=SMOOTHINGS {
                let found: Vec<Option<Rgb>> =
                    next.par_iter().map(|&number| self.mean_about(number, &more)).collect();
                next.iter().zip(found).for_each(|(&number, found)| more[number] = found);
            }
            let share = 1.0 - f64::from(step) / f64::from(FADE + 1);
            for &number in &next {
                if let Some(more) = more[number] {
                    self.entries[number].light = Light::Beside(more * share);
                }
            }
            front = next;
        }
    }

    /// The mean of what is known of an entry and those beside it, within the interval of what the map tells.
    fn mean_about(&self, number: usize, more: &[Option<Rgb>]) -> Option<Rgb> {
        let about = std::iter::once(number).chain(self.middles.beside(number));
        let (mut sum, mut count) = (Rgb::BLACK, 0.0);
        for known in about.filter_map(|other| more[other]) {
            sum += known;
            count += 1.0;
        }
        let mean = sum / f64::max(count, 1.0);
        let most_lx = MOST_ERRORS * self.entries[number].error_lx;
        let mean_lx = mean.luminance().abs();
        (count > 0.0).then(|| if mean_lx > most_lx { mean * (most_lx / mean_lx) } else { mean })
    }

    /// The light of a place that a pixel shows, where it is gathered: that of the middle of the pixel, or, if that shows
    /// another surface, of the nearest place of the same that the middle of one of the pixels around shows. A place in a gap
    /// stands for no place outside of it.
    fn at(&self, reader: &MapReader<'_>, (at, surface): (&SurfacePoint, &Surface)) -> Light {
        let entry = |number: usize| &self.entries[number];
        let Some(standing) = self.middles.standing(at, surface) else { return Light::OfMap };
        let is_in_gap = |number: usize| entry(number).is_in_gap();
        let mut around = self.middles.around(at, surface);
        if !is_in_gap(standing) || around.all(is_in_gap) {
            return entry(standing).light;
        }
        let (wanted, _) = wanted(reader, at);
        if wanted == entry(standing).wanted {
            return entry(standing).light;
        }
        let like = self.middles.around(at, surface).filter(|&k| entry(k).wanted == wanted);
        let nearest = self.middles.nearest(like, surface);
        nearest.map_or(Light::OfMap, |number| entry(number).light)
    }

    /// What gathering in the open has changed at a middle, lx.
    fn changed(&self, number: usize, map: &IlluminationMap) -> Option<Rgb> {
        let SurfacePoint { triangle, back, u, v, .. } = *self.middles.place(number);
        let Entry { light, wanted, .. } = self.entries[number];
        match (light, wanted) {
            (Light::Gathered(reading), Some(false)) => {
                let stored = map.interpolate(triangle, back, u, v)?;
                Some(reading.lx - stored.indirect_lx)
            }
            _ => None,
        }
    }
}

/// Blocks of pixels on one piece of surface. One pixel of each stands for all of them.
struct Blocks {
    wanted: Vec<Wanted>,
    /// Of every middle, if its light is wanted: its piece of surface, and the middle that stands for its block.
    of_middles: Vec<Option<(u64, usize)>>,
}

impl Blocks {
    /// The blocks of wanted pixels, and the pixels that stand for them.
    fn of(wanted: Vec<Wanted>, middles: usize) -> (Self, Vec<Wanted>) {
        let mut first: HashMap<(u64, [usize; 2]), usize> = HashMap::new();
        let (mut of_middles, mut asked) = (vec![None; middles], Vec::new());
        for of in &wanted {
            let at = of.at.map(|at| at / BLOCK_WIDTH);
            let standing = *first.entry((of.kind, at)).or_insert_with(|| {
                asked.push(Wanted { at, ..*of });
                of.number
            });
            of_middles[of.number] = Some((of.kind, standing));
        }
        (Self { wanted, of_middles }, asked)
    }

    /// The light of all pixels: the mean of the blocks of those about on the same piece of surface, so that blocks are not seen.
    fn spread(
        &self,
        filled: &[Filled],
        middles: &Middles,
    ) -> Vec<(usize, Option<IndirectReading>)> {
        let mut light: Vec<Option<IndirectReading>> = vec![None; self.of_middles.len()];
        filled.iter().for_each(|filled| light[filled.number] = filled.reading);
        let of_pixel = |of: &Wanted| {
            let (kind, standing) = self.of_middles[of.number]?;
            let own = light[standing]?;
            let SurfacePoint { pixel, path, .. } = *middles.place(of.number);
            let is_alike = |(other_kind, _): &(u64, usize)| *other_kind == kind;
            let (mut sum, mut count) = (Rgb::BLACK, 0.0);
            for other in middles.within(pixel, 1, path) {
                let block = self.of_middles[other].filter(is_alike);
                if let Some(reading) = block.and_then(|(_, standing)| light[standing]) {
                    sum += reading.lx;
                    count += 1.0;
                }
            }
            Some(IndirectReading { lx: sum / count, ..own })
        };
        self.wanted.par_iter().map(|of| (of.number, of_pixel(of))).collect()
    }
}

impl Entry {
    fn new(reader: &MapReader<'_>, at: &SurfacePoint) -> Self {
        let (wanted, error_lx) = wanted(reader, at);
        Self { wanted, error_lx, light: Light::OfMap }
    }

    fn is_in_gap(&self) -> bool {
        self.wanted == Some(true)
    }
}

/// Whether light is to be gathered at a place, and whether that lies in a gap; else the standard error of what the map tells, lx.
fn wanted(reader: &MapReader<'_>, at: &SurfacePoint) -> (Option<bool>, f64) {
    match reader.told_at(on_side(at), ALLOWANCE) {
        Some(Told::Little { in_gap }) => (Some(in_gap), 0.0),
        Some(Told::Light(reading)) => (None, reading.error_lx),
        None => (None, 0.0),
    }
}

/// The first of the entries that hang together with one.
fn root(pieces: &mut [usize], mut number: usize) -> usize {
    while pieces[number] != number {
        pieces[number] = pieces[pieces[number]];
        number = pieces[number];
    }
    number
}
