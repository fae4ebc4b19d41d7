//! Single paths.

use crate::engine::gather::Gatherer;
use crate::engine::light::{Emission, Lighting, LuminaireId, MirrorChain, Particle};
use crate::engine::ray::{
    Dice, MAX_SPECULAR, Places, SurfacePoint, luminance_ratio, specular_step,
};
use crate::sampling::{CosineHemisphere, Key, Sequence};
use crate::scene::{Body, Finish, Scene};
use crate::units::Rgb;
use isolux_geometry::Ray;
use std::collections::HashMap;
use std::f64::consts::PI;
use std::ops::AddAssign;
use std::sync::Arc;

/// Greatest chance of a further reflection, so that paths end between surfaces that absorb nothing.
const MOST_LIKELY: f64 = 0.99;

/// The brightest paths of a place that are told.
pub(super) const BRIGHTEST: usize = 8;

/// Estimates illuminance at places of a scene, without a map.
pub struct PathTracer<'a> {
    pub(super) scene: &'a Scene,
    pub(super) lighting: Arc<Lighting<'a>>,
    pub(super) places: Places<'a>,
    /// Luminaires that send out light straight, if they do.
    pub(super) senders: Option<Emission<'a>>,
    /// All luminaires, where some without surface send light over specular surfaces that no virtual luminaires stand for.
    pub(super) over_specular: Option<Emission<'a>>,
    /// Emitting surfaces by triangle and side, where paths may meet them over such surfaces.
    pub(super) emitters: HashMap<(u32, bool), LuminaireId>,
}

/// Light that paths bring to a place, lx.
#[derive(Clone, Copy, Default)]
pub(super) struct Brought {
    /// Without diffuse reflection, over specular surfaces that no virtual luminaires stand for.
    pub(super) caustic: Rgb,
    /// After at least one diffuse reflection.
    pub(super) indirect: Rgb,
}

impl AddAssign for Brought {
    fn add_assign(&mut self, other: Self) {
        self.caustic += other.caustic;
        self.indirect += other.indirect;
    }
}

/// What the paths of a replicate have found together.
#[derive(Default)]
pub(super) struct Paths {
    pub(super) sum: Brought,
    /// The brightest of them, photometric, lx.
    pub(super) brightest: Vec<f64>,
    pub(super) rays: u64,
}

/// A diffuse surface at the end of a ray.
struct End {
    surface: SurfacePoint,
    /// What of its illuminance comes back along the ray.
    share: Rgb,
    /// How likely it was to be met, 1/m2; none of one that is met by way of mirrors.
    density: Option<f64>,
}

/// What a ray finds.
#[derive(Default)]
struct Found {
    ends: Vec<End>,
    /// The light of emitting surfaces that no virtual luminaires stand for, lx at its start.
    shining: Rgb,
    rays: u64,
}

impl PathTracer<'_> {
    /// So many paths from a place, of one sequence.
    pub(super) fn replicate(&self, start: Gatherer, key: Key, count: u32) -> Paths {
        let sequence = Sequence::new(key);
        let mut all = Paths::default();
        for index in 0..count {
            let (brought, rays) = self.path(start, &mut Dice::new(sequence, index));
            all.sum += brought;
            all.rays += rays;
            all.keep((brought.caustic + brought.indirect).luminance());
        }
        all
    }

    /// What one path brings, and its rays.
    fn path(&self, start: Gatherer, dice: &mut Dice) -> (Brought, u64) {
        let mut light = Brought::default();
        let mut rays = 0;
        // A surface that is both diffuse and a mirror divides a path.
        let mut waiting = vec![(start, Rgb::WHITE, true)];
        while let Some((from, throughput, is_first)) = waiting.pop() {
            if let Some(senders) = &self.senders {
                light.indirect += throughput * self.sent(senders, &from, dice);
                rays += 2;
            }
            if let Some(senders) = &self.over_specular {
                let (sent, flown) = self.sent_over_specular(senders, &from, dice);
                light.indirect += throughput * sent;
                rays += flown;
            }
            let found = self.follow(&from, dice);
            rays += found.rays;
            match is_first {
                // Beside caustics of luminaires without surface, which paths cannot meet, they are part of what is left out.
                true if self.over_specular.is_some() => {}
                true => light.caustic += found.shining,
                false => light.indirect += throughput * found.shining,
            }
            for End { surface, share, density } in found.ends {
                let throughput = throughput * share;
                let direct_lx = self.lighting.estimate(&surface, dice);
                rays += self.lighting.rays_of_estimate();
                // Where no light lands, a ray may end that could hardly come there, too.
                let lit = self.senders.as_ref().filter(|_| !direct_lx.is_black());
                let met = lit.zip(density).map_or(1.0, |(senders, by_chance)| {
                    by_chance / (by_chance + senders.landing(direct_lx))
                });
                light.indirect += throughput * direct_lx * met;
                let chance = throughput.max_channel().min(MOST_LIKELY);
                let [survive, _] = dice.pair();
                if survive < chance {
                    let next = Gatherer::on_surface(surface, 1);
                    waiting.push((next, throughput / chance, false));
                }
            }
        }
        (light, rays)
    }

    /// What a place gets from where a luminaire has sent some of its light straight, lx.
    fn sent(&self, senders: &Emission, from: &Gatherer, dice: &mut Dice) -> Rgb {
        let landed = senders.emit(dice).and_then(|sent| self.scene.bvh().closest_hit(&sent.ray));
        let Some(surface) = landed.map(|hit| SurfacePoint::from_hit(self.scene, &hit)) else {
            return Rgb::BLACK;
        };
        let by_chance = self.seen(from, &surface);
        if by_chance <= 0.0 {
            return Rgb::BLACK;
        }
        let direct_lx = self.lighting.estimate(&surface, dice);
        let reflectance = surface.reflectance(self.scene);
        reflectance * direct_lx * (by_chance / (by_chance + senders.landing(direct_lx)))
    }

    /// What a place gets from where a luminaire without surface has sent some of its light over specular surfaces that no virtual
    /// luminaires stand for, lx, and the rays that took.
    fn sent_over_specular(
        &self,
        senders: &Emission,
        from: &Gatherer,
        dice: &mut Dice,
    ) -> (Rgb, u64) {
        let own = Dice::new(dice.fork(), 0);
        let mut own = own;
        let Some(emitted) = senders.emit(&mut own).filter(|sent| !sent.is_of_surface()) else {
            return (Rgb::BLACK, 0);
        };
        let mut particle = Particle::sent(&emitted, senders.flux_lm(), own, MAX_SPECULAR);
        let (mut light, mut rays) = (Rgb::BLACK, 1);
        while let Some(at) = particle.advance(self.scene) {
            if !particle.is_covered(&self.lighting) {
                let reflectance = at.reflectance(self.scene);
                if !reflectance.is_black() {
                    light += particle.flux_lm * reflectance * self.seen(from, &at);
                    rays += 1;
                }
            }
            if !particle.scatter_specular(self.scene, &self.lighting) || particle.is_given_up() {
                break;
            }
            rays += 1;
        }
        (light, rays)
    }

    /// How likely a cosine-distributed ray is to end at a place straight, 1/m2. Glass on the way counts as nothing: what is seen through it is not
    /// dimmed, for what it would reflect besides.
    fn seen(&self, from: &Gatherer, surface: &SurfacePoint) -> f64 {
        let by_chance = density(from, surface);
        let way = Ray::between(from.origin, surface.start()).skipping(from.surface.triangle);
        let is_dark = by_chance <= 0.0 || surface.reflectance(self.scene).is_black();
        if is_dark || self.scene.bvh().any_hit(&way) { 0.0 } else { by_chance }
    }

    /// The diffuse surfaces that a cosine-distributed ray meets, and what shines on its way.
    fn follow(&self, from: &Gatherer, dice: &mut Dice) -> Found {
        let axis = from.normal.to_direction();
        let mut direction = axis.from_local(CosineHemisphere::sample(dice.pair()));
        let ray = Ray::new(from.origin, direction).skipping(from.surface.triangle);
        let mut hit = self.scene.bvh().closest_hit(&ray);
        let mut chain = MirrorChain::default();
        let mut found = Found { rays: 1, ..Found::default() };
        // Without the square of the index where the path is over that where it began: roulette must not
        // end paths for being in a dense medium, which they may leave again.
        let (mut throughput, mut luminance_of_start) = (Rgb::WHITE, 1.0);
        for number in 0..MAX_SPECULAR {
            let Some(at) = hit else { break };
            let surface = SurfacePoint::from_hit(self.scene, &at);
            let body = &self.scene.material(at.triangle).body;
            if let Body::Opaque { front, back } = body {
                let finish = if surface.back { back } else { front };
                let throughput = throughput * luminance_of_start;
                let density = (number == 0).then(|| density(from, &surface));
                found.meet(self, (&surface, finish, density), &chain, throughput);
            }
            let next = specular_step(body, &surface, direction, throughput, dice);
            let Some(next) = next else { break };
            luminance_of_start *= luminance_ratio(body, &surface, next.direction);
            chain.pass((&surface, direction), body, &self.lighting, &next);
            (direction, throughput) = (next.direction, throughput * next.weight);
            hit = self.scene.bvh().closest_hit(&next.ray);
            found.rays += 1;
        }
        found
    }
}

impl Found {
    /// An opaque surface on the way, met with the throughput of luminance from there.
    fn meet(
        &mut self,
        tracer: &PathTracer,
        (surface, finish, density): (&SurfacePoint, &Finish, Option<f64>),
        chain: &MirrorChain,
        throughput: Rgb,
    ) {
        let SurfacePoint { triangle, back, u, v, .. } = *surface;
        let luminaire = tracer.emitters.get(&(triangle, back));
        if let Some(&luminaire) = luminaire
            && !chain.is_covered_backwards(&tracer.lighting, luminaire)
        {
            // Illuminance of cosine-distributed rays: pi times their mean luminance.
            self.shining += throughput * finish.luminance_cd_m2 * PI;
        }
        let reflectance = tracer.scene.diffuse_reflectance(finish, triangle, u, v);
        if !reflectance.is_black() {
            let share = throughput * reflectance;
            self.ends.push(End { surface: *surface, share, density });
        }
    }
}

impl Paths {
    /// Keeps a path if it is among the brightest.
    fn keep(&mut self, lx: f64) {
        let place = self.brightest.partition_point(|&kept| kept >= lx);
        if place < BRIGHTEST {
            self.brightest.insert(place, lx);
            self.brightest.truncate(BRIGHTEST);
        }
    }
}

/// How likely a cosine-distributed ray is to end at a place if nothing is between, 1/m2.
fn density(from: &Gatherer, at: &SurfacePoint) -> f64 {
    let way = at.point - from.origin;
    let away = way.dot(from.normal.to_vector());
    let facing = -way.dot(at.geometric.to_vector());
    let squared = way.length_squared();
    if away > 0.0 && facing > 0.0 && squared > 0.0 {
        away * facing / (PI * squared * squared)
    } else {
        0.0
    }
}
