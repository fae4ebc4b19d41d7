//! One look along a ray.

use super::lobes::{self, Arrival, Lobe};
use super::settings::{SurfacePoint, TraceSettings};
use crate::image::{Reading, Seen, Sight, Surface};
use isolux::geometry::{Direction, Hit, Normal, Ray, offset_origin};
use isolux::map::Illuminance;
use isolux::sampling::Key;
use isolux::scene::{Body, Dielectric, Finish, Scene};
use isolux::units::Rgb;
use std::f64::consts::PI;

/// Down to this depth all lobes are followed; below, one of them, at random in proportion.
const SPLIT_DEPTH: u32 = 2;
/// Weights below half a step of an eight-bit display are not followed.
const INVISIBLE: f64 = 1.0 / 512.0;
/// Luminances that differ by less than this share look alike.
const ALIKE: f64 = 0.03;
/// Black backs in a row that a camera looks through.
const MAX_BACKS: u32 = 64;

/// Looks along rays.
pub(super) struct Looker<'a> {
    pub(super) scene: &'a Scene,
    pub(super) settings: &'a TraceSettings,
    pub(super) read: &'a (dyn Fn(SurfacePoint) -> Option<Illuminance> + Sync),
}

/// What a look found.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look {
    luminance_cd_m2: Rgb,
    pub(super) reading: Option<Reading>,
    sight: Sight,
    pub(super) surface: Option<Surface>,
}

impl Look {
    pub(super) const NOTHING: Self = Self {
        luminance_cd_m2: Rgb::BLACK,
        reading: None,
        sight: Sight::Background,
        surface: None,
    };

    /// Whether two looks see one surface in the same light, as far as a picture can show.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        let one_surface = match (&self.surface, &other.surface) {
            (Some(a), Some(b)) => a.continues(b),
            (None, None) => true,
            _ => false,
        };
        let (a, b) = (self.luminance_cd_m2.luminance(), other.luminance_cd_m2.luminance());
        one_surface && self.sight == other.sight && (a - b).abs() <= ALIKE * a.max(b)
    }

    /// As stored in an image.
    pub(super) fn seen(&self) -> Seen {
        Seen {
            luminance_cd_m2: self.luminance_cd_m2.0.map(|c| c as f32),
            reading: self.reading,
            sight: self.sight,
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

/// How far a look has come.
#[derive(Clone, Copy)]
struct Progress {
    depth: u32,
    /// What one cd/m2 from here adds to the picture.
    weight: Rgb,
    /// Whether a glossy surface lies on the way.
    blurred: bool,
    key: Key,
}

impl Looker<'_> {
    /// The look along a ray of the camera.
    pub(super) fn look(&self, ray: &Ray, direction: Direction, key: Key) -> Look {
        let start = Progress { depth: 0, weight: Rgb::WHITE, blurred: false, key };
        match self.camera_hit(*ray, direction) {
            Some(hit) => self.at(&hit, direction, start),
            None => Look::NOTHING,
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
        let origin = offset_origin(self.scene.hit_point(hit), turned(normal, !side));
        Ray::new(origin, direction).skipping(hit.triangle)
    }

    fn at(&self, hit: &Hit, direction: Direction, progress: Progress) -> Look {
        let scene = self.scene;
        let (u, v) = (f64::from(hit.u), f64::from(hit.v));
        let flat = turned(scene.geometric_normal(hit.triangle), hit.back);
        let smooth = turned(scene.shading_normal(hit.triangle, u, v), hit.back);
        // A smoothed normal may turn away from a grazing ray.
        let normal = if direction.cos(smooth) < 0.0 { smooth } else { flat };
        let arrival = Arrival { direction, normal, flat };
        match &scene.material(hit.triangle).body {
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
        let facets = if progress.depth == 0 { self.settings.gloss_samples.max(1) } else { 1 };
        let lobes = lobes::opaque(at, finish, facets, progress.key.with(0));
        let (specular, strongest) = self.follow(hit, lobes, progress);
        if finish.is_pure_mirror() {
            let luminance_cd_m2 = specular + finish.luminance_cd_m2;
            return Look { luminance_cd_m2, ..strongest.unwrap_or(self.bare(hit, at)) };
        }
        let point = SurfacePoint {
            triangle: hit.triangle,
            back: hit.back,
            u,
            v,
            blurred: progress.blurred,
        };
        let read = (self.read)(point);
        let lux = read.map_or(Rgb::BLACK, |e| e.total_lx());
        let sight = if finish.is_emitter() {
            Sight::Emitter
        } else if read.is_none() && !diffuse.is_black() {
            Sight::Unknown
        } else {
            Sight::Surface
        };
        Look {
            luminance_cd_m2: finish.luminance_cd_m2 + diffuse * lux / PI + specular,
            reading: read.map(|e| Reading {
                illuminance_lx: e.illuminance_lx() as f32,
                standard_error_lx: e.standard_error_lx as f32,
            }),
            sight,
            ..self.bare(hit, at)
        }
    }

    fn at_dielectric(&self, hit: &Hit, at: &Arrival, glass: &Dielectric, p: Progress) -> Look {
        let lobes = lobes::dielectric(at, glass, hit.back);
        let (luminance_cd_m2, strongest) = self.follow(hit, lobes, p);
        Look { luminance_cd_m2, ..strongest.unwrap_or(self.bare(hit, at)) }
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

    /// The weighted sum over lobes, and the look along the strongest of them.
    fn follow(&self, hit: &Hit, lobes: Vec<Lobe>, progress: Progress) -> (Rgb, Option<Look>) {
        let mut sum = Rgb::BLACK;
        let mut strongest: Option<(f64, Look)> = None;
        if progress.depth >= self.settings.depth {
            return (sum, None);
        }
        for (index, lobe) in self.chosen(lobes, progress) {
            let weight = progress.weight * lobe.weight;
            if weight.max_channel() < INVISIBLE {
                continue;
            }
            let key = progress.key.with(1 + index as u64);
            let blurred = progress.blurred || lobe.blurred;
            let next = Progress { depth: progress.depth + 1, weight, blurred, key };
            let ray = self.onwards(hit, lobe.direction);
            let found = self.scene.bvh().closest_hit(&ray);
            let look = found.map_or(Look::NOTHING, |hit| self.at(&hit, lobe.direction, next));
            sum += lobe.weight * look.luminance_cd_m2;
            let strength = lobe.weight.luminance();
            if strongest.is_none_or(|(known, _)| strength > known) {
                strongest = Some((strength, look.through(index)));
            }
        }
        (sum, strongest.map(|(_, look)| look))
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

/// The normal on one side of a surface.
fn turned(normal: Normal, back: bool) -> Normal {
    if back { (-normal.to_direction()).to_normal() } else { normal }
}
