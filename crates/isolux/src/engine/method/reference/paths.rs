//! Single paths of the path tracer.

use crate::engine::gather::Gatherer;
use crate::engine::light::{Emission, Emitted, Lighting, LuminaireId, MirrorChain, Particle};
use crate::engine::ray::{
    Dice, MAX_SPECULAR, Places, SurfacePoint, luminance_ratio, specular_step,
};
use crate::sampling::{CosineHemisphere, Key, Sequence};
use crate::scene::{Body, Finish, LuminaireKind, Scene};
use crate::units::Rgb;
use isolux_geometry::{Direction, Ray};
use std::collections::HashMap;
use std::f64::consts::PI;
use std::ops::AddAssign;
use std::sync::Arc;

/// The largest probability of a further reflection, so that paths end between surfaces that absorb nothing.
const MOST_LIKELY: f64 = 0.99;

/// The number of brightest paths that a place reports.
pub(super) const BRIGHTEST: usize = 8;

/// A path tracer: it estimates the illuminance at places of a scene without a map.
pub struct PathTracer<'a> {
    pub(super) scene: &'a Scene,
    pub(super) lighting: Arc<Lighting<'a>>,
    pub(super) places: Places<'a>,
    /// The luminaires that also send out light directly; `None` if they do not.
    pub(super) senders: Option<Emission<'a>>,
    /// All luminaires, if some without surface send light over specular surfaces without virtual luminaires.
    pub(super) over_specular: Option<Emission<'a>>,
    /// The emitting surfaces that paths may meet over such specular surfaces, by triangle and side.
    pub(super) emitters: HashMap<(u32, bool), LuminaireId>,
}

/// The light that paths bring to a place, lx.
#[derive(Clone, Copy, Default)]
pub(super) struct Brought {
    /// Light without diffuse reflection, over specular surfaces without virtual luminaires.
    pub(super) caustic: Rgb,
    /// Light after at least one diffuse reflection.
    pub(super) indirect: Rgb,
}

impl Brought {
    fn indirect(lx: Rgb) -> Self {
        Self { indirect: lx, caustic: Rgb::BLACK }
    }

    fn caustic(lx: Rgb) -> Self {
        Self { indirect: Rgb::BLACK, caustic: lx }
    }
}

impl AddAssign for Brought {
    fn add_assign(&mut self, other: Self) {
        self.caustic += other.caustic;
        self.indirect += other.indirect;
    }
}

/// What a path remembers of the diffuse surfaces that have reflected its light.
pub(super) trait Trail: Clone {
    /// The same after one more reflection, at a triangle.
    fn reflected(&self, triangle: u32) -> Self;
}

/// Most paths remember nothing.
impl Trail for () {
    fn reflected(&self, _triangle: u32) {}
}

/// The sum of the paths of a replicate.
#[derive(Default)]
pub(super) struct Paths {
    pub(super) sum: Brought,
    /// The brightest paths, photometric, lx.
    pub(super) brightest: Vec<f64>,
    pub(super) rays: u64,
}

/// A diffuse surface at the end of a ray.
struct End {
    surface: SurfacePoint,
    /// The share of its illuminance that comes back along the ray.
    share: Rgb,
    /// The density of random hits there, 1/m2; `None` if it is met by way of specular surfaces.
    density: Option<f64>,
}

/// An opaque surface that a ray met.
struct Met<'a> {
    surface: SurfacePoint,
    finish: &'a Finish,
    /// The density of random hits there, 1/m2; `None` if it is met by way of specular surfaces.
    density: Option<f64>,
}

/// The result of following a ray.
#[derive(Default)]
struct Found {
    ends: Vec<End>,
    /// The light of emitting surfaces without virtual luminaires, as illuminance at the start of the ray, lx.
    shining: Rgb,
    /// Where the path has left the scene over specular surfaces.
    left: Option<Left>,
    rays: u64,
}

/// A path that leaves the scene over specular surfaces.
struct Left {
    direction: Direction,
    /// The illuminance at the start of the ray for every cd/m2 in that direction, lx.
    share: Rgb,
    chain: MirrorChain,
}

impl PathTracer<'_> {
    /// The sum of `count` paths from a place, with points of one sequence.
    pub(super) fn replicate(&self, start: Gatherer, key: Key, count: u32) -> Paths {
        let sequence = Sequence::new(key);
        let mut all = Paths::default();
        for index in 0..count {
            let mut brought = Brought::default();
            let rays = self.path((start, ()), &mut Dice::new(sequence, index), &mut |part, ()| {
                brought += part;
            });
            all.sum += brought;
            all.rays += rays;
            all.keep((brought.caustic + brought.indirect).luminance());
        }
        all
    }

    /// The number of rays of one path. `found` receives the parts of its light, each with the trail of the path.
    pub(super) fn path<T: Trail>(
        &self,
        (start, trail): (Gatherer, T),
        dice: &mut Dice,
        found: &mut impl FnMut(Brought, &T),
    ) -> u64 {
        let mut rays = 0;
        // A surface that is both diffuse and a mirror splits a path.
        let mut waiting = vec![(start, Rgb::WHITE, trail, true)];
        while let Some((from, throughput, trail, is_first)) = waiting.pop() {
            let mut sent = |lx: Rgb, triangle: u32| {
                found(Brought::indirect(throughput * lx), &trail.reflected(triangle));
            };
            if let Some(senders) = &self.senders {
                if let Some((lx, triangle)) = self.sent(senders, &from, dice) {
                    sent(lx, triangle);
                }
                rays += 2;
            }
            if let Some(senders) = &self.over_specular {
                rays += self.sent_over_specular(senders, &from, dice, &mut sent);
            }
            let mut met = self.follow(&from, dice);
            rays += met.rays;
            met.shining += met.left.take().map_or(Rgb::BLACK, |left| self.beyond_lx(&left));
            match is_first {
                // Where caustics of luminaires without surface are left out, those of emitting surfaces are
                // left out of the place itself, too.
                true if self.over_specular.is_some() => {}
                true => found(Brought::caustic(met.shining), &trail),
                false => found(Brought::indirect(throughput * met.shining), &trail),
            }
            for End { surface, share, density } in met.ends {
                let throughput = throughput * share;
                let trail = trail.reflected(surface.triangle);
                let direct_lx = self.lighting.estimate(&surface, dice);
                rays += self.lighting.rays_of_estimate();
                // Without direct light the weight is one; both densities may be zero there.
                let lit = self.senders.as_ref().filter(|_| !direct_lx.is_black());
                let met = lit.zip(density).map_or(1.0, |(senders, by_chance)| {
                    by_chance / (by_chance + senders.landing(direct_lx))
                });
                found(Brought::indirect(throughput * direct_lx * met), &trail);
                let chance = throughput.max_channel().min(MOST_LIKELY);
                let [survive, _] = dice.pair();
                if survive < chance {
                    let next = Gatherer::on_surface(surface, 1);
                    waiting.push((next, throughput / chance, trail, false));
                }
            }
        }
        rays
    }

    /// The indirect light at a place from the landing place of light that a luminaire sends out directly, lx, and the triangle
    /// there.
    fn sent(&self, senders: &Emission, from: &Gatherer, dice: &mut Dice) -> Option<(Rgb, u32)> {
        let landed = senders.emit(dice).and_then(|sent| self.scene.bvh().closest_hit(&sent.ray))?;
        let surface = SurfacePoint::from_hit(self.scene, &landed);
        let by_chance = self.seen(from, &surface);
        if by_chance <= 0.0 {
            return None;
        }
        let direct_lx = self.lighting.estimate(&surface, dice);
        let share = by_chance / (by_chance + senders.landing(direct_lx));
        Some((surface.reflectance(self.scene) * direct_lx * share, surface.triangle))
    }

    /// The number of rays of light that a luminaire without surface sends over specular surfaces without virtual luminaires. `found`
    /// receives what diffuse surfaces bring of it to a place, lx, and their triangles.
    fn sent_over_specular(
        &self,
        senders: &Emission,
        from: &Gatherer,
        dice: &mut Dice,
        found: &mut impl FnMut(Rgb, u32),
    ) -> u64 {
        let own = Dice::new(dice.fork(), 0);
        let mut own = own;
        let is_sought = |sent: &Emitted| !sent.is_of_surface() && !self.is_of_sky(sent);
        let Some(emitted) = senders.emit(&mut own).filter(is_sought) else {
            return 0;
        };
        let mut particle = Particle::sent(&emitted, senders.flux_lm(), own, MAX_SPECULAR);
        let mut rays = 1;
        while let Some(at) = particle.advance(self.scene) {
            if !particle.is_covered(&self.lighting) {
                let reflectance = at.reflectance(self.scene);
                if !reflectance.is_black() {
                    let lx = particle.flux_lm * reflectance * self.seen(from, &at);
                    found(lx, at.triangle);
                    rays += 1;
                }
            }
            if !particle.scatter_specular(self.scene, &self.lighting) || particle.is_given_up() {
                break;
            }
            rays += 1;
        }
        rays
    }

    /// The light of skies at the end of a path over specular surfaces, unless that is direct light, lx.
    fn beyond_lx(&self, left: &Left) -> Rgb {
        let skies = (0..).zip(self.scene.luminaires()).filter_map(|(number, luminaire)| {
            let cd_m2 = luminaire.sky_cd_m2(left.direction)?;
            (!self.is_covered(left, number)).then_some(cd_m2)
        });
        left.share * skies.sum::<Rgb>()
    }

    /// Whether the light of a luminaire along such a path is direct light.
    fn is_covered(&self, left: &Left, luminaire: u32) -> bool {
        left.chain.is_covered_backwards(&self.lighting, LuminaireId::Luminaire(luminaire))
    }

    /// One path from a place to a sky. `found` receives directions in the frame of the sky, and the illuminance of the place for
    /// every cd/m2 there, lx. Light that comes straight or by planar mirrors is left out.
    pub(super) fn path_to_sky(
        &self,
        (sky, local): (u32, &impl Fn(Direction) -> Option<Direction>),
        start: Gatherer,
        dice: &mut Dice,
        found: &mut impl FnMut(Direction, Rgb),
    ) {
        let mut waiting = vec![(start, Rgb::WHITE)];
        while let Some((from, throughput)) = waiting.pop() {
            let Found { ends, left, .. } = self.follow(&from, dice);
            let left = left.filter(|left| !self.is_covered(left, sky));
            if let Some((left, towards)) = left.and_then(|l| Some((local(l.direction)?, l.share))) {
                found(left, throughput * towards);
            }
            for End { surface, share, .. } in ends {
                let throughput = throughput * share;
                self.lighting.sky_rays(sky, &surface, 1, dice, |towards, share| {
                    found(towards, throughput * share);
                });
                let chance = throughput.max_channel().min(MOST_LIKELY);
                let [survive, _] = dice.pair();
                if survive < chance {
                    waiting.push((Gatherer::on_surface(surface, 1), throughput / chance));
                }
            }
        }
    }

    /// Whether a particle comes from a sky, which paths meet where they leave the scene.
    fn is_of_sky(&self, sent: &Emitted) -> bool {
        let LuminaireId::Luminaire(number) = sent.luminaire else { return false };
        matches!(self.scene.luminaires()[number as usize].kind, LuminaireKind::Sky { .. })
    }

    /// The density of a cosine-distributed ray at a visible place, 1/m2; zero if the place is hidden or
    /// black. Transparent surfaces on the way are ignored: light is not dimmed there, in place of the light
    /// that they would reflect.
    fn seen(&self, from: &Gatherer, surface: &SurfacePoint) -> f64 {
        let by_chance = density(from, surface);
        let way = Ray::between(from.origin, surface.start()).skipping(from.surface.triangle);
        let is_dark = by_chance <= 0.0 || surface.reflectance(self.scene).is_black();
        if is_dark || self.scene.bvh().any_hit(&way) { 0.0 } else { by_chance }
    }

    /// The diffuse surfaces that a cosine-distributed ray meets, and the emitted light on its way.
    fn follow(&self, from: &Gatherer, dice: &mut Dice) -> Found {
        let axis = from.normal.to_direction();
        let mut direction = axis.from_local(CosineHemisphere::sample(dice.pair()));
        let ray = Ray::new(from.origin, direction).skipping(from.surface.triangle);
        let mut hit = self.scene.bvh().closest_hit(&ray);
        let mut chain = MirrorChain::default();
        let mut found = Found { rays: 1, ..Found::default() };
        // The throughput leaves out the squared ratio of the refractive index to that at the start. Russian
        // roulette must not end paths in a dense medium, which they may leave again.
        let (mut throughput, mut luminance_of_start) = (Rgb::WHITE, 1.0);
        for number in 0..MAX_SPECULAR {
            let Some(at) = hit else {
                let share = throughput * luminance_of_start * PI;
                found.left = (number > 0).then_some(Left { direction, share, chain });
                break;
            };
            let surface = SurfacePoint::from_hit(self.scene, &at);
            let body = &self.scene.material(at.triangle).body;
            if let Body::Opaque { front, back } = body {
                let finish = if surface.back { back } else { front };
                let throughput = throughput * luminance_of_start;
                let density = (number == 0).then(|| density(from, &surface));
                found.meet(self, Met { surface, finish, density }, &chain, throughput);
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
    /// Adds an opaque surface that was met, with the throughput of luminance from there.
    fn meet(&mut self, tracer: &PathTracer, met: Met<'_>, chain: &MirrorChain, throughput: Rgb) {
        let Met { surface, finish, density } = met;
        let SurfacePoint { triangle, back, u, v, .. } = surface;
        let luminaire = tracer.emitters.get(&(triangle, back));
        if let Some(&luminaire) = luminaire
            && !chain.is_covered_backwards(&tracer.lighting, luminaire)
        {
            // The illuminance of cosine-distributed rays is pi times their mean luminance.
            self.shining += throughput * finish.luminance_cd_m2 * PI;
        }
        let reflectance = tracer.scene.diffuse_reflectance(finish, triangle, u, v);
        if !reflectance.is_black() {
            let share = throughput * reflectance;
            self.ends.push(End { surface, share, density });
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

/// The density of a cosine-distributed ray at a place if nothing stands between, 1/m2.
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
