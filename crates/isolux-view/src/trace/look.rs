//! One look along a ray.

use super::lamps::{Lamps, MetLamp};
use super::lobes::{self, Arrival, Lobe, Rough};
use super::settings::{SurfacePoint, TraceSettings};
use crate::image::{Reading, Seen, Sight, Surface};
use isolux::engine::{Highlighted, Highlights, Shining};
use isolux::geometry::{Direction, Hit, Normal, Ray};
use isolux::map::Illuminance;
use isolux::sampling::Key;
use isolux::scene::{Body, Dielectric, Finish, Scene};
use isolux::units::Rgb;
use std::f64::consts::PI;

/// Down to this depth all lobes are followed; below, one of them, at random in proportion.
const SPLIT_DEPTH: u32 = 2;
/// Weights below half a step of an eight-bit display are not followed.
const INVISIBLE: f64 = 1.0 / 512.0;
/// What is seen with less weight need not be sharp.
const FAINT: f64 = 0.1;
/// Luminances that differ by less than this share look alike.
const ALIKE: f64 = 0.03;
/// Tells the random numbers of looks at luminaires from those of lobes.
const HIGHLIGHTS: u64 = 1 << 32;
/// Black backs in a row that a camera looks through.
const MAX_BACKS: u32 = 64;

/// Looks along rays.
pub(super) struct Looker<'a> {
    pub(super) scene: &'a Scene,
    pub(super) settings: &'a TraceSettings,
    pub(super) highlights: Option<&'a Highlights<'a>>,
    pub(super) lamps: Option<&'a Lamps<'a>>,
    pub(super) read: &'a (dyn Fn(SurfacePoint) -> Option<Illuminance> + Sync),
}

/// What a look found.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look {
    luminance_cd_m2: Rgb,
    /// The same without what gloss shows: that is smooth over several pixels, but noisy.
    sharp_cd_m2: Rgb,
    pub(super) reading: Option<Reading>,
    /// The illuminance that was read, in its colours.
    light_lx: Rgb,
    sight: Sight,
    pub(super) surface: Option<Surface>,
}

impl Look {
    pub(super) const NOTHING: Self = Self {
        luminance_cd_m2: Rgb::BLACK,
        sharp_cd_m2: Rgb::BLACK,
        reading: None,
        light_lx: Rgb::BLACK,
        sight: Sight::Background,
        surface: None,
    };

    /// Beyond the scene.
    fn beyond(luminance_cd_m2: Rgb) -> Self {
        Self { luminance_cd_m2, sharp_cd_m2: luminance_cd_m2, ..Self::NOTHING }
    }

    /// A luminous area.
    fn at_lamp(lamp: MetLamp) -> Self {
        let luminance_cd_m2 = lamp.luminance_cd_m2;
        Self {
            luminance_cd_m2,
            sharp_cd_m2: luminance_cd_m2,
            sight: Sight::Emitter,
            surface: Some(lamp.surface),
            ..Self::NOTHING
        }
    }

    /// Whether two looks see one surface in the same light, as far as a picture can show.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        let one_surface = is_one_surface(&self.surface, &other.surface);
        let is_alike = are_alike(self.sharp_cd_m2, other.sharp_cd_m2);
        one_surface && self.sight == other.sight && is_alike
    }

    /// Whether two looks see one surface.
    pub(super) fn is_beside(&self, other: &Self) -> bool {
        is_one_surface(&self.surface, &other.surface)
    }

    /// As stored in an image.
    pub(super) fn seen(&self) -> Seen {
        Seen {
            luminance_cd_m2: self.luminance_cd_m2.0.map(|c| c as f32),
            reading: self.reading,
            sight: self.sight,
        }
    }

    /// This look with light of the surface's own and what it shows of others.
    fn shining(self, own_cd_m2: Rgb, specular: &Specular) -> Self {
        Self {
            luminance_cd_m2: own_cd_m2 + specular.luminance_cd_m2,
            sharp_cd_m2: own_cd_m2 + specular.sharp_cd_m2,
            ..self
        }
    }

    /// This look through the `lobe`-th of a specular surface.
    fn through(self, lobe: usize) -> Self {
        let path = |surface: Surface| {
            let path = surface.path.wrapping_mul(4).wrapping_add(lobe as u32 + 1);
            Surface { path, ..surface }
        };
        Self { surface: self.surface.map(path), ..self }
    }
}

fn are_alike(one: Rgb, other: Rgb) -> bool {
    let (a, b) = (one.luminance(), other.luminance());
    (a - b).abs() <= ALIKE * a.max(b)
}

/// What was read beside a place of a surface, where it is the same on all sides: at least two looks.
fn lent(surface: &Surface, near: &[Look]) -> Option<(Reading, Rgb)> {
    let is_here = |look: &&Look| look.surface.is_some_and(|other| surface.continues(&other));
    let mut here = near.iter().filter(is_here);
    let first = here.next()?;
    let rest = here.try_fold(0, |count: u32, look| {
        let agrees = look.reading.is_some() && are_alike(first.light_lx, look.light_lx);
        agrees.then_some(count + 1)
    });
    let reading = first.reading.filter(|_| rest.is_some_and(|count| count > 0))?;
    Some((reading, first.light_lx))
}

/// Whether two looks, of which each may have met nothing, see one smooth piece of surface.
fn is_one_surface(one: &Option<Surface>, other: &Option<Surface>) -> bool {
    match (one, other) {
        (Some(a), Some(b)) => a.continues(b),
        (None, None) => true,
        _ => false,
    }
}

/// What a ray of the camera meets first.
#[derive(Clone, Copy)]
pub(super) struct Meeting {
    hit: Option<Hit>,
    lamp: Option<MetLamp>,
    direction: Direction,
    surface: Option<Surface>,
    /// Whether the picture of another place is sharp in it.
    is_clear: bool,
    /// Whether there is a ray at all.
    is_aimed: bool,
}

impl Meeting {
    /// Beside the round picture of a fisheye.
    pub(super) const NOTHING: Self = Self {
        hit: None,
        lamp: None,
        direction: Direction::X,
        surface: None,
        is_clear: false,
        is_aimed: false,
    };

    /// Whether both meet one smooth piece of surface that shows nothing else sharply.
    pub(super) fn continues(&self, other: &Self) -> bool {
        !self.is_clear && !other.is_clear && is_one_surface(&self.surface, &other.surface)
    }
}

/// How far a look has come.
#[derive(Clone, Copy)]
struct Progress<'a> {
    depth: u32,
    /// Other looks of the camera near this one.
    near: &'a [Look],
    /// Facets of a glossy surface to look along.
    facets: u32,
    /// What one cd/m2 from here adds to the picture.
    weight: Rgb,
    /// The share of what the surface emits that this look is to tell: the rest is told by looks at luminaires.
    of_emitter: f64,
    /// Whether a glossy surface lies on the way, or a faint mirror.
    blurred: bool,
    /// Whether a glossy surface lies on the way.
    is_glossy: bool,
    /// The pixel that is looked through.
    pixel: usize,
    /// Mirrors and panes on the way.
    path: u32,
    key: Key,
}

/// The weighted sum over the lobes of a surface, and the look along the strongest of them.
#[derive(Default)]
struct Specular {
    luminance_cd_m2: Rgb,
    sharp_cd_m2: Rgb,
    strongest: Option<Look>,
}

impl Looker<'_> {
    /// What a ray of the camera meets.
    pub(super) fn meet(&self, ray: &Ray, direction: Direction) -> Meeting {
        let hit = self.camera_hit(*ray, direction);
        if let Some(lamp) = self.lamp(ray, direction, hit.as_ref()) {
            let surface = Some(lamp.surface);
            return Meeting {
                hit: None,
                lamp: Some(lamp),
                direction,
                surface,
                is_clear: false,
                is_aimed: true,
            };
        }
        let is_clear = |hit: &Hit| {
            let finish = self.scene.material(hit.triangle).finish(hit.back);
            finish.is_none_or(|finish| !finish.mirror.is_black())
        };
        let surface = hit.and_then(|hit| self.bare(&hit, &self.arrival(&hit, direction)).surface);
        let is_clear = hit.as_ref().is_some_and(is_clear);
        Meeting { hit, lamp: None, direction, surface, is_clear, is_aimed: true }
    }

    /// A luminous area before what a ray hits.
    fn lamp(&self, ray: &Ray, direction: Direction, hit: Option<&Hit>) -> Option<MetLamp> {
        let away = |hit: &Hit| (self.scene.hit_point(hit) - ray.origin).length() as f32;
        self.lamps?.met(ray, direction, hit.map_or(f32::INFINITY, away))
    }

    /// The look at what a ray of the camera met, along `facets` of a glossy surface. What was seen
    /// near there spares a reading.
    pub(super) fn look(
        &self,
        meeting: &Meeting,
        near: &[Look],
        facets: u32,
        (pixel, key): (usize, Key),
    ) -> Look {
        let (weight, blurred, is_glossy, path) = (Rgb::WHITE, false, false, 0);
        let of_emitter = 1.0;
        let start = Progress {
            depth: 0,
            facets,
            near,
            weight,
            of_emitter,
            blurred,
            is_glossy,
            pixel,
            path,
            key,
        };
        match (&meeting.hit, meeting.lamp) {
            (_, Some(lamp)) => Look::at_lamp(lamp),
            (Some(hit), None) => self.at(hit, meeting.direction, start),
            (None, None) if meeting.is_aimed => {
                Look::beyond(self.scene.beyond_cd_m2(meeting.direction, true))
            }
            (None, None) => Look::NOTHING,
        }
    }

    fn camera_hit(&self, mut ray: Ray, direction: Direction) -> Option<Hit> {
        for _ in 0..MAX_BACKS {
            let hit = self.scene.bvh().closest_hit(&ray)?;
            let finish = self.scene.material(hit.triangle).finish(hit.back);
            let black_back = hit.back && finish == Some(&Finish::BLACK);
            if !(self.settings.through_black_backs && black_back) {
                return Some(hit);
            }
            ray = self.onwards(&hit, direction);
        }
        None
    }

    /// A ray that leaves the place of a hit.
    fn onwards(&self, hit: &Hit, direction: Direction) -> Ray {
        let normal = self.scene.geometric_normal(hit.triangle);
        let side = direction.cos(normal) >= 0.0;
        let point = self.scene.hit_point(hit);
        let origin = self.scene.bvh().offset_origin(point, turned(normal, !side));
        Ray::new(origin, direction).skipping(hit.triangle)
    }

    fn arrival(&self, hit: &Hit, direction: Direction) -> Arrival {
        let scene = self.scene;
        let (u, v) = (f64::from(hit.u), f64::from(hit.v));
        let flat = turned(scene.geometric_normal(hit.triangle), hit.back);
        let smooth = turned(scene.shading_normal(hit.triangle, u, v), hit.back);
        // A smoothed normal may turn away from a grazing ray.
        let normal = if direction.cos(smooth) < 0.0 { smooth } else { flat };
        Arrival { direction, normal, flat }
    }

    fn at(&self, hit: &Hit, direction: Direction, progress: Progress) -> Look {
        let arrival = self.arrival(hit, direction);
        match &self.scene.material(hit.triangle).body {
            Body::Opaque { front, back } => {
                let finish = if hit.back { back } else { front };
                self.at_opaque(hit, &arrival, finish, progress)
            }
            Body::Dielectric(glass) => self.at_dielectric(hit, &arrival, glass, progress),
        }
    }

    fn at_opaque(&self, hit: &Hit, at: &Arrival, finish: &Finish, progress: Progress) -> Look {
        let (u, v) = (f64::from(hit.u), f64::from(hit.v));
        let diffuse = self.scene.diffuse_reflectance(finish, hit.triangle, u, v);
        let lobes = lobes::opaque(at, finish, progress.facets, progress.key.with(0));
        let highlighted = self.highlighted(hit, finish, &progress);
        let mut specular = self.follow(hit, lobes, highlighted.as_ref(), progress);
        if let Some(highlighted) = &highlighted {
            specular.luminance_cd_m2 += highlights(at, finish, highlighted, &progress);
        }
        let emitted_cd_m2 = finish.luminance_cd_m2 * progress.of_emitter;
        if finish.is_pure_mirror() {
            let behind = specular.strongest.unwrap_or(self.bare(hit, at));
            return behind.shining(emitted_cd_m2, &specular);
        }
        let bare = self.bare(hit, at);
        let known = bare.surface.and_then(|surface| lent(&surface, progress.near));
        let read = known.or_else(|| self.reading(hit, &progress));
        let (reading, light_lx) = read.map_or((None, Rgb::BLACK), |(r, lx)| (Some(r), lx));
        let sight = if finish.is_emitter() {
            Sight::Emitter
        } else if read.is_none() && !diffuse.is_black() {
            Sight::Unknown
        } else {
            Sight::Surface
        };
        let own_cd_m2 = emitted_cd_m2 + diffuse * light_lx / PI;
        Look { reading, light_lx, sight, ..bare }.shining(own_cd_m2, &specular)
    }

    /// What is to be seen of luminaires from a place that shows them blurred, unless nobody would notice.
    fn highlighted(&self, hit: &Hit, finish: &Finish, p: &Progress<'_>) -> Option<Highlighted<'_>> {
        let is_followed = p.depth < self.settings.depth && p.weight.max_channel() >= INVISIBLE;
        let highlights = self.highlights.filter(|_| is_followed)?;
        lobes::rough(finish).next().map(|_| highlights.at(hit, p.facets))
    }

    /// What the map says of the place of a hit.
    fn reading(&self, hit: &Hit, progress: &Progress<'_>) -> Option<(Reading, Rgb)> {
        let (u, v) = (f64::from(hit.u), f64::from(hit.v));
        let Progress { blurred, pixel, path, .. } = *progress;
        let Hit { triangle, back, .. } = *hit;
        let read = (self.read)(SurfacePoint { triangle, back, u, v, blurred, pixel, path })?;
        let reading = Reading {
            illuminance_lx: read.illuminance_lx() as f32,
            standard_error_lx: read.standard_error_lx as f32,
        };
        Some((reading, read.total_lx()))
    }

    fn at_dielectric(&self, hit: &Hit, at: &Arrival, glass: &Dielectric, p: Progress) -> Look {
        let lobes = lobes::dielectric(at, glass, hit.back);
        let specular = self.follow(hit, lobes, None, p);
        specular.strongest.unwrap_or(self.bare(hit, at)).shining(Rgb::BLACK, &specular)
    }

    /// A surface of which nothing is known but that it is there.
    fn bare(&self, hit: &Hit, at: &Arrival) -> Look {
        let surface = Surface {
            shape: self.scene.shape_of(hit.triangle),
            back: hit.back,
            path: 0,
            position: self.scene.hit_point(hit),
            normal: at.normal,
        };
        Look { sight: Sight::Surface, surface: Some(surface), ..Look::NOTHING }
    }

    fn follow(
        &self,
        hit: &Hit,
        lobes: Vec<Lobe>,
        highlighted: Option<&Highlighted<'_>>,
        progress: Progress,
    ) -> Specular {
        let mut sum = Specular::default();
        let mut strongest = 0.0;
        if progress.depth >= self.settings.depth {
            return sum;
        }
        for (index, lobe) in self.chosen(lobes, progress) {
            let weight = progress.weight * lobe.weight;
            if weight.max_channel() < INVISIBLE / f64::from(progress.facets) {
                continue;
            }
            let next = Progress { weight, ..progress };
            let look = self.along(hit, (index, &lobe), highlighted, next);
            sum.luminance_cd_m2 += lobe.weight * look.luminance_cd_m2;
            if !lobe.is_blurred() {
                sum.sharp_cd_m2 += lobe.weight * look.sharp_cd_m2;
            }
            let strength = lobe.weight.luminance();
            if sum.strongest.is_none() || strength > strongest {
                strongest = strength;
                sum.strongest = Some(look.through(index));
            }
        }
        sum
    }

    /// The look from a surface along one of its lobes.
    fn along(
        &self,
        hit: &Hit,
        (index, lobe): (usize, &Lobe),
        highlighted: Option<&Highlighted<'_>>,
        progress: Progress,
    ) -> Look {
        let ray = self.onwards(hit, lobe.direction);
        let found = self.scene.bvh().closest_hit(&ray);
        // Behind gloss, looks at luminaires tell of their images.
        let lamp = self.lamp(&ray, lobe.direction, found.as_ref()).filter(|_| !progress.is_glossy);
        if let Some(lamp) = lamp.and_then(|lamp| told(lamp, lobe, highlighted)) {
            return Look::at_lamp(lamp);
        }
        let Some(found) = found else {
            // Blurred images of discs are told by looks at luminaires.
            let with_discs = lobe.density.is_none();
            return Look::beyond(self.scene.beyond_cd_m2(lobe.direction, with_discs));
        };
        let of_emitter = lobe.density.zip(highlighted).map_or(1.0, |(density, highlighted)| {
            density / (density + highlighted.density(&found, lobe.direction))
        });
        let is_faint = progress.weight.max_channel() < FAINT;
        let next = Progress {
            depth: progress.depth + 1,
            facets: 1,
            near: &[],
            of_emitter,
            blurred: progress.blurred || lobe.is_blurred() || is_faint,
            is_glossy: progress.is_glossy || lobe.is_blurred(),
            path: progress.path.wrapping_mul(4).wrapping_add(index as u32 + 1),
            key: progress.key.with(1 + index as u64),
            ..progress
        };
        self.at(&found, lobe.direction, next)
    }

    /// All lobes, or deep down one of them at random, its weight over its probability.
    fn chosen(&self, lobes: Vec<Lobe>, progress: Progress) -> Vec<(usize, Lobe)> {
        let share = |lobe: &Lobe| lobe.weight.max_channel();
        let mut lobes: Vec<(usize, Lobe)> = lobes.into_iter().enumerate().collect();
        lobes.retain(|(_, lobe)| share(lobe) > 0.0);
        if progress.depth < SPLIT_DEPTH || lobes.len() < 2 {
            return lobes;
        }
        let all: f64 = lobes.iter().map(|(_, lobe)| share(lobe)).sum();
        let mut rest = progress.key.with(u64::MAX).uniform() * all;
        let picked = lobes.iter().position(|(_, lobe)| {
            rest -= share(lobe);
            rest < 0.0
        });
        let (index, lobe) = lobes[picked.unwrap_or(lobes.len() - 1)];
        vec![(index, Lobe { weight: lobe.weight * (all / share(&lobe)), ..lobe })]
    }
}

/// What looks at luminaires tell of a surface that shows them blurred. Those without surface are left out where the surface itself is
/// seen blurred: hardly a look would meet their images, and all of those would be far too bright.
fn highlights(
    at: &Arrival,
    finish: &Finish,
    highlighted: &Highlighted<'_>,
    progress: &Progress<'_>,
) -> Rgb {
    let facets = f64::from(progress.facets);
    let shown_by = |layer: &Rough<'_>, direction, shining| {
        let (weight, density) = layer.towards(at, direction)?;
        match shining {
            Shining::Point(lx) => {
                let is_shown = layer.shows_points() && !progress.blurred;
                is_shown.then(|| weight * lx * density)
            }
            Shining::Surface { luminance_cd_m2, density: of_looks } => {
                Some(weight * luminance_cd_m2 * (density / (of_looks + facets * density)))
            }
        }
    };
    let mut sum_cd_m2 = Rgb::BLACK;
    highlighted.look(progress.key.with(HIGHLIGHTS), |direction, shining| {
        let shown = lobes::rough(finish).filter_map(|layer| shown_by(&layer, direction, shining));
        sum_cd_m2 += shown.sum();
    });
    sum_cd_m2
}

/// What a look along a lobe tells of a luminous area: all of it in mirrors, the share of the balance heuristic beside
/// looks at luminaires. `None` where lobes are blurred and there are no such looks: hardly one would meet it, and far
/// too brightly.
fn told(lamp: MetLamp, lobe: &Lobe, highlighted: Option<&Highlighted<'_>>) -> Option<MetLamp> {
    let Some(density) = lobe.density else { return Some(lamp) };
    let highlighted = highlighted.filter(|highlighted| highlighted.looks_at_luminaires())?;
    let share = density / (density + highlighted.density_of_looks(lamp.density));
    Some(MetLamp { luminance_cd_m2: lamp.luminance_cd_m2 * share, ..lamp })
}

/// The normal on one side of a surface.
fn turned(normal: Normal, back: bool) -> Normal {
    if back { (-normal.to_direction()).to_normal() } else { normal }
}
