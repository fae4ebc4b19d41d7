//! Views from a map whose indirect light is gathered where the map is not to be trusted, as readings have it: on a net of
//! pixels, so that few of them take rays.

use crate::camera::View;
use crate::error::ViewError;
use crate::image::{LuminanceImage, Size, Surface};
use crate::trace::{SurfacePoint, TraceSettings, trace, trace_watched};
use isolux::elements::PlaceOnSide;
use isolux::engine::net::{Filled, Fineness, Net, Wanted};
use isolux::engine::{Allowance, IndirectReading, MapReader, Told};
use isolux::map::{Illuminance, IlluminationMap};
use isolux::scene::Scene;
use isolux::units::Rgb;
use rayon::prelude::*;
use std::convert::Infallible;
use std::sync::{Mutex, PoisonError};

/// Numbers of pixels at a time whose light is gathered.
const BLOCK: usize = 64;
/// Pixels that are gathered between two words to whoever watches.
const WATCHED: usize = 1024;
/// Noise of what is gathered, as a share of it, before it is smoothed; and what elements may be expected to err by, which is seen as
/// their pattern.
const ALLOWANCE: Allowance = Allowance { noise: 0.05, interpolation: 0.03 };
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
    /// Indirect light is gathered.
    Gathering(f64),
    /// Pixels are looked at.
    Looking(f64),
}

/// Looks at a scene with the light of its map: direct light evaluated afresh, indirect light as [`MapReader::at`] reads it,
/// gathered where the map is not to be trusted and interpolated elsewhere, and in what gloss and faint panes show. Where it is
/// wanted, light is gathered in the middles of few pixels and continued to those about on the same piece of surface, within
/// half of the error of a reading or 2 % of the light (best effort: pieces that no middle of a pixel nearby shows are
/// interpolated). `watch` is told how far that is.
pub fn trace_map(
    (scene, map): (&Scene, &IlluminationMap),
    view: impl Into<View>,
    size: Size,
    (settings, watch): (&TraceSettings, &mut dyn FnMut(ViewProgress)),
) -> Result<(LuminanceImage, Gathered), ViewError> {
    let view = view.into();
    let reader = MapReader::new(scene, map);
    let places = asked(scene, view, size, settings)?;
    let (light, report) = PixelLight::new((scene, map), &reader, (size, places), watch);
    let read = |at: SurfacePoint| -> Option<Illuminance> {
        let SurfacePoint { triangle, back, u, v, blurred, .. } = at;
        let of_map = || map.interpolate(triangle, back, u, v);
        if blurred {
            return of_map();
        }
        let known = match light.at((scene, &reader), &at) {
            Light::OfMap => None,
            Light::Gathered(reading) => Some(reading),
            Light::Beside(more) => of_map().map(|stored| IndirectReading {
                lx: (stored.indirect_lx + more).map(|c| c.max(0.0)),
                error_lx: stored.indirect_standard_error_lx,
                noise_lx: stored.indirect_standard_error_lx,
            }),
        };
        reader.glance(on_side(&at), 0, known)
    };
    let watch = &mut |share| watch(ViewProgress::Looking(share));
    let image = trace_watched(scene, view, size, settings, (&read, watch))?;
    Ok((image, report))
}

/// A look in the dark: what is to be seen sharply in the middles of pixels, in their order.
fn asked(
    scene: &Scene,
    view: View,
    size: Size,
    settings: &TraceSettings,
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
    trace(scene, view, size, &middles, &ask)?;
    let mut all = all.into_inner().unwrap_or_else(PoisonError::into_inner);
    let key = |at: &SurfacePoint| (at.pixel, at.path);
    all.sort_unstable_by(|a, b| {
        let place = |at: &SurfacePoint| (at.triangle, at.back, at.u.to_bits(), at.v.to_bits());
        key(a).cmp(&key(b)).then(place(a).cmp(&place(b)))
    });
    all.dedup_by_key(|at| key(at));
    Ok(all)
}

/// What the middle of a pixel shows, straight or by some way over mirrors and panes.
struct Entry {
    at: SurfacePoint,
    surface: Surface,
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
struct PixelLight {
    size: Size,
    entries: Vec<Entry>,
    /// First entry of each pixel, and their number.
    firsts: Vec<usize>,
}

impl PixelLight {
    fn new(
        (scene, map): (&Scene, &IlluminationMap),
        reader: &MapReader<'_>,
        (size, asked): (Size, Vec<SurfacePoint>),
        watch: &mut dyn FnMut(ViewProgress),
    ) -> (Self, Gathered) {
        let entries = asked.into_par_iter().map(|at| Entry::new(scene, reader, at)).collect();
        let mut pixels = Self { size, entries, firsts: Vec::new() };
        pixels.firsts = (0..=size.pixels())
            .map(|pixel| pixels.entries.partition_point(|entry| entry.at.pixel < pixel))
            .collect();
        let mut report = Gathered::default();
        let place = |number: usize| on_side(&pixels.entries[number].at);
        let sight = |from: usize, to: usize| reader.sees(place(from), place(to));
        let mut net = Net::new(pixels.wanted(), Fineness::PIXELS, Box::new(sight));
        let mut done = 0.0;
        let gather = |numbers: &[usize], more: f64| -> Result<Vec<_>, Infallible> {
            let one = |&number: &usize| reader.indirect_at(place(number), ALLOWANCE);
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
        for filled in filled {
            let light = filled.reading.map_or(Light::OfMap, Light::Gathered);
            pixels.entries[filled.number].light = light;
            match filled.is_gathered {
                true => report.gathered += 1,
                false => report.continued += 1,
            }
        }
        report.interpolated = pixels.entries.len() - report.gathered - report.continued;
        pixels.fade(map);
        (pixels, report)
    }

    /// Pixels whose light is to be gathered, each with the piece of surface that it hangs together with.
    fn wanted(&self) -> Vec<Wanted> {
        let width = self.size.width() as usize;
        let mut pieces: Vec<usize> = (0..self.entries.len()).collect();
        for (number, entry) in self.entries.iter().enumerate() {
            let pixel = entry.at.pixel;
            let right = (pixel % width + 1 < width).then_some(pixel + 1);
            let below = (pixel + width < self.size.pixels()).then_some(pixel + width);
            for other in right.into_iter().chain(below).flat_map(|pixel| self.of(pixel)) {
                let is_alike = entry.wanted.is_some() && entry.wanted == self.entries[other].wanted;
                if is_alike && entry.is_one_piece_with(&self.entries[other]) {
                    let [a, b] = [number, other].map(|number| root(&mut pieces, number));
                    pieces[a.max(b)] = a.min(b);
                }
            }
        }
        let wanted =
            (0..self.entries.len()).filter(|&number| self.entries[number].wanted.is_some());
        wanted
            .map(|number| {
                let pixel = self.entries[number].at.pixel;
                let kind = root(&mut pieces, number) as u64;
                Wanted { number, at: [pixel % width, pixel / width], kind }
            })
            .collect()
    }

    /// Lets what gathering changed fade out next to where light is gathered, within the interval that the map states there: it
    /// may err by as much as the limit of its trust, which would be seen as a line.
    fn fade(&mut self, map: &IlluminationMap) {
        let mut more: Vec<Option<Rgb>> =
            self.entries.iter().map(|entry| entry.changed(map)).collect();
        let mut front: Vec<usize> =
            (0..more.len()).filter(|&number| more[number].is_some()).collect();
        for step in 1..=FADE {
            let is_left =
                |&next: &usize| more[next].is_none() && self.entries[next].wanted.is_none();
            let mut next: Vec<usize> =
                front.iter().flat_map(|&number| self.beside(number)).filter(is_left).collect();
            next.sort_unstable();
            next.dedup();
            // Once to go on, and then along the front: what differs there is noise.
            for _ in 0..=SMOOTHINGS {
                let found: Vec<Option<Rgb>> =
                    next.iter().map(|&number| self.mean_about(number, &more)).collect();
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
        let about = std::iter::once(number).chain(self.beside(number));
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

    /// Entries of the pixels to the four sides of one that show the same piece of surface.
    fn beside(&self, number: usize) -> impl Iterator<Item = usize> + '_ {
        let entry = &self.entries[number];
        let (pixel, width) = (entry.at.pixel, self.size.width() as usize);
        let sides = [
            (pixel % width > 0).then(|| pixel - 1),
            (pixel % width + 1 < width).then_some(pixel + 1),
            pixel.checked_sub(width),
            (pixel + width < self.size.pixels()).then_some(pixel + width),
        ];
        let near = sides.into_iter().flatten().flat_map(|pixel| self.of(pixel));
        near.filter(|&other| entry.is_one_piece_with(&self.entries[other]))
    }

    /// Numbers of the entries of a pixel.
    fn of(&self, pixel: usize) -> std::ops::Range<usize> {
        self.firsts[pixel]..self.firsts[pixel + 1]
    }

    /// The light of a place that a pixel shows, where it is gathered: that of the middle of the pixel, or, if that shows
    /// another surface, of the nearest place of the same that the middle of one of the pixels around shows. A place in a gap
    /// stands for no place outside of it.
    fn at(&self, (scene, reader): (&Scene, &MapReader<'_>), at: &SurfacePoint) -> Light {
        let surface = surface(scene, at);
        let shows = |entry: &&Entry| entry.at.path == at.path && entry.surface.continues(&surface);
        let own = self.of(at.pixel).map(|number| &self.entries[number]).find(shows);
        let away = |entry: &&Entry| (entry.surface.position - surface.position).length_squared();
        let around = || {
            let around = self.around(at.pixel).flat_map(|pixel| self.of(pixel));
            around.map(|number| &self.entries[number]).filter(shows)
        };
        let nearest = |like: &dyn Fn(&&Entry) -> bool| {
            around().filter(like).min_by(|a, b| away(a).total_cmp(&away(b)))
        };
        let Some(standing) = own.or_else(|| nearest(&|_| true)) else { return Light::OfMap };
        if !standing.is_in_gap() || around().all(|entry| entry.is_in_gap()) {
            return standing.light;
        }
        let (wanted, _) = wanted(reader, at);
        if wanted == standing.wanted {
            return standing.light;
        }
        nearest(&|entry| entry.wanted == wanted).map_or(Light::OfMap, |entry| entry.light)
    }

    fn around(&self, pixel: usize) -> impl Iterator<Item = usize> + use<> {
        let (width, height) = (self.size.width() as usize, self.size.height() as usize);
        let near = |at: usize, size: usize| at.saturating_sub(1)..(at + 2).min(size);
        let columns = near(pixel % width, width);
        near(pixel / width, height).flat_map(move |y| columns.clone().map(move |x| y * width + x))
    }
}

impl Entry {
    fn new(scene: &Scene, reader: &MapReader<'_>, at: SurfacePoint) -> Self {
        let (wanted, error_lx) = wanted(reader, &at);
        Self { at, surface: surface(scene, &at), wanted, error_lx, light: Light::OfMap }
    }

    fn is_in_gap(&self) -> bool {
        self.wanted == Some(true)
    }

    /// What gathering in the open has changed, lx.
    fn changed(&self, map: &IlluminationMap) -> Option<Rgb> {
        let SurfacePoint { triangle, back, u, v, .. } = self.at;
        match (self.light, self.wanted) {
            (Light::Gathered(reading), Some(false)) => {
                let stored = map.interpolate(triangle, back, u, v)?;
                Some(reading.lx - stored.indirect_lx)
            }
            _ => None,
        }
    }

    /// Whether light may be continued from here to a pixel beside it.
    fn is_one_piece_with(&self, other: &Self) -> bool {
        self.at.path == other.at.path && self.surface.continues(&other.surface)
    }
}

fn on_side(at: &SurfacePoint) -> PlaceOnSide {
    PlaceOnSide { triangle: at.triangle, back: at.back, uv: [at.u, at.v] }
}

/// Whether light is to be gathered at a place, and whether that lies in a gap; else the standard error of what the map tells, lx.
fn wanted(reader: &MapReader<'_>, at: &SurfacePoint) -> (Option<bool>, f64) {
    match reader.told_at(on_side(at), ALLOWANCE) {
        Some(Told::Little { in_gap }) => (Some(in_gap), 0.0),
        Some(Told::Light(reading)) => (None, reading.error_lx),
        None => (None, 0.0),
    }
}

fn surface(scene: &Scene, at: &SurfacePoint) -> Surface {
    let SurfacePoint { triangle, back, u, v, path, .. } = *at;
    let front = scene.shading_normal(triangle, u, v);
    Surface {
        shape: scene.shape_of(triangle),
        back,
        path,
        position: scene.triangle(triangle).point(u, v),
        normal: if back { (-front.to_direction()).to_normal() } else { front },
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
