//! Luminaires as they show on glossy surfaces.
//!
//! Rays drawn along the facets of a rough surface meet a small bright luminaire once in hundreds of
//! samples, and then give far too much light. So directions are also drawn to luminaires, and both
//! kinds of samples are weighted by the balance heuristic (Veach and Guibas 1995). Luminaires
//! without surface only show by the second kind: all of them are evaluated, as long as they are few.

use super::lighting::Lighting;
use super::sample::area::Shape;
use super::sample::luminous::LuminousLook;
use crate::engine::ray::{Dice, SurfacePoint};
use crate::sampling::{Key, Sequence};
use crate::scene::{Material, Scene};
use crate::units::Rgb;
use isolux_geometry::{Direction, Hit};
use std::collections::HashMap;

/// Samples at a place for all emitting surfaces together, with at least one for each.
const EMITTER_SAMPLES: usize = 16;

/// The luminaires of a scene as they show on glossy surfaces.
pub struct Highlights<'s> {
    scene: &'s Scene,
    lighting: Lighting<'s>,
    /// For each emitting triangle and side, the number of the emitting surface and the index of the triangle in it.
    emitters: HashMap<(u32, bool), (u32, usize)>,
    has_points: bool,
}

/// The luminaires as seen from a place on a surface.
pub struct Highlighted<'h> {
    highlights: &'h Highlights<'h>,
    at: SurfacePoint,
    shapes: Vec<Option<Shape<'h>>>,
    samples: usize,
}

/// Light that comes to a place from a direction.
#[derive(Clone, Copy, Debug)]
pub enum Shining {
    /// Light of an emitting surface or of a luminous area.
    Surface {
        /// Luminance, cd/m2.
        luminance_cd_m2: Rgb,
        /// Density of the directions drawn to it, over all samples together, 1/sr.
        density: f64,
    },
    /// Light of a luminaire without surface: illuminance of a surface that faces it, lx.
    Point(Rgb),
}

impl<'s> Highlights<'s> {
    /// The luminaires of a scene; `None` where no glossy surface shows any.
    pub fn new(scene: &'s Scene) -> Option<Self> {
        if !scene.materials().iter().any(Material::is_glossy) {
            return None;
        }
        let emitters = scene.area_luminaires().iter().zip(0..).flat_map(|(area, number)| {
            let triangles = area.triangles.iter().enumerate();
            triangles.map(move |(index, &triangle)| ((triangle, area.back), (number, index)))
        });
        let emitters: HashMap<_, _> = emitters.collect();
        let lighting = Lighting::new(scene);
        let has_points = lighting.shows_points();
        (has_points || !emitters.is_empty()).then_some(Self {
            scene,
            lighting,
            emitters,
            has_points,
        })
    }

    /// The luminaires as seen from the place that a ray hits, with up to `looks` samples of every emitting surface.
    pub fn at(&self, hit: &Hit, looks: u32) -> Highlighted<'_> {
        let at = SurfacePoint::from_hit(self.scene, hit);
        let count = self.scene.area_luminaires().len();
        let shapes = (0..count).map(|number| self.lighting.shape(number, &at)).collect();
        let luminous = if self.has_points { self.lighting.luminous().count() } else { 0 };
        let sources = (count + luminous).max(1);
        let samples = (EMITTER_SAMPLES / sources).clamp(1, looks.max(1) as usize);
        Highlighted { highlights: self, at, shapes, samples }
    }
}

impl Highlighted<'_> {
    /// Samples the luminaires. `found` receives the direction and the light of each that is met. Emitting surfaces
    /// are met in proportion to the density of their directions; those behind panes are left to rays along facets.
    pub fn look(&self, key: Key, mut found: impl FnMut(Direction, Shining)) {
        let Highlights { scene, lighting, has_points, .. } = self.highlights;
        let areas = scene.area_luminaires();
        for (number, shape) in self.shapes.iter().enumerate() {
            let Some(shape) = shape else { continue };
            let sequence = Sequence::new(key.with(number as u64));
            for sample in 0..self.samples {
                let drawn = shape.draw(&mut Dice::new(sequence, sample as u32));
                let Some((direction, density)) = drawn else { continue };
                let hit = scene.bvh().closest_hit(&self.at.leave(direction));
                if hit.and_then(|hit| self.emitter(&hit)).is_some_and(|(met, _)| met == number) {
                    let luminance_cd_m2 = areas[number].luminance_cd_m2;
                    let density = density * self.samples as f64;
                    found(direction, Shining::Surface { luminance_cd_m2, density });
                }
            }
        }
        if *has_points {
            for (number, luminous) in lighting.luminous().enumerate() {
                let sequence = Sequence::new(key.with((areas.len() + number) as u64));
                for sample in 0..self.samples {
                    let dice = &mut Dice::new(sequence, sample as u32);
                    let Some(look) = lighting.look_at_area(luminous, &self.at, dice) else {
                        continue;
                    };
                    let LuminousLook { direction, luminance_cd_m2, density } = look;
                    let density = self.density_of_looks(density);
                    found(direction, Shining::Surface { luminance_cd_m2, density });
                }
            }
            let dice = &mut Dice::new(Sequence::new(key.with(u64::MAX)), 0);
            lighting
                .points_at(&self.at, dice, |direction, lx| found(direction, Shining::Point(lx)));
        }
    }

    /// Whether looks are sent to luminaires without surface.
    pub fn looks_at_luminaires(&self) -> bool {
        self.highlights.has_points
    }

    /// Density of the directions to a source over all samples together, for that of one, 1/sr.
    pub fn density_of_looks(&self, of_one: f64) -> f64 {
        of_one * self.samples as f64
    }

    /// Density of the direction to a hit among those drawn to its emitting surface, over all
    /// samples together, 1/sr; zero if nothing emits there.
    pub fn density(&self, hit: &Hit, direction: Direction) -> f64 {
        let met = self.emitter(hit);
        let density = met.and_then(|(number, index)| {
            let shape = self.shapes[number].as_ref()?;
            shape.density(index, direction * f64::from(hit.t))
        });
        density.unwrap_or(0.0) * self.samples as f64
    }

    fn emitter(&self, hit: &Hit) -> Option<(usize, usize)> {
        let met = self.highlights.emitters.get(&(hit.triangle, hit.back));
        met.map(|&(number, index)| (number as usize, index))
    }
}
