//! Paths over specular surfaces.

use super::scatter::{Scattered, luminance_ratio, reflect, refract, specular_share};
use super::surface::SurfacePoint;
use crate::sampling::Sequence;
use crate::scene::{Body, Finish, Scene};
use crate::units::Rgb;
use isolux_geometry::{Direction, Hit, Ray};

/// Specular reflections after which a path is given up. Mirrors of a room lose the light long before; only
/// light trapped in lossless glass gets here.
pub(crate) const MAX_SPECULAR: u32 = 128;

/// A stream of random numbers for one path: the dimensions of one point of a low-discrepancy sequence, in
/// order.
pub(crate) struct Dice {
    sequence: Sequence,
    index: u32,
    next_pair: u32,
}

impl Dice {
    /// The numbers of point `index` of a sequence.
    pub(crate) const fn new(sequence: Sequence, index: u32) -> Self {
        Self { sequence, index, next_pair: 0 }
    }

    /// A new sequence, for a part of the path that needs many points.
    pub(crate) const fn fork(&mut self) -> Sequence {
        self.next_pair += 1;
        self.sequence.fork(self.index, self.next_pair - 1)
    }

    /// The next two numbers, each in [0, 1).
    pub(crate) const fn pair(&mut self) -> [f64; 2] {
        self.next_pair += 1;
        self.sequence.pair(self.index, self.next_pair - 1)
    }
}

/// The end of a path over specular surfaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum PathEnd {
    /// The path leaves the scene.
    Left,
    /// The path ends at the last surface that it met.
    Absorbed,
    /// The path still carries this share (luminance) after [`MAX_SPECULAR`] surfaces.
    GivenUp(f64),
}

/// Follows a ray backwards to the sources of its light, over specular reflection and transmission. `met`
/// receives every opaque surface met, with the throughput of luminance from there to the start, before the
/// specular part of that surface is followed.
pub(crate) fn follow(
    scene: &Scene,
    ray: Ray,
    direction: Direction,
    dice: &mut Dice,
    mut met: impl FnMut(&SurfacePoint, &Finish, Rgb),
) -> PathEnd {
    let hit = scene.bvh().closest_hit(&ray);
    follow_on(scene, hit, direction, dice, |_, surface, finish, throughput| {
        met(surface, finish, throughput);
    })
}

/// Follows a path as [`follow`] does, from its first hit on. `met` also receives the number of surfaces met
/// before.
#[inline]
pub(crate) fn follow_on(
    scene: &Scene,
    mut hit: Option<Hit>,
    mut direction: Direction,
    dice: &mut Dice,
    mut met: impl FnMut(u32, &SurfacePoint, &Finish, Rgb),
) -> PathEnd {
    // The throughput leaves out the square of the ratio of refractive indices between here and the start:
    // Russian roulette must not end a path for being in a dense medium, which it may leave again.
    let mut throughput = Rgb::WHITE;
    let mut luminance_of_start = 1.0;
    for number in 0..MAX_SPECULAR {
        let Some(at) = hit else { return PathEnd::Left };
        let surface = SurfacePoint::from_hit(scene, &at);
        let body = &scene.material(at.triangle).body;
        if let Body::Opaque { front, back } = body {
            let finish = if surface.back { back } else { front };
            met(number, &surface, finish, throughput * luminance_of_start);
        }
        let Some(next) = specular_step(body, &surface, direction, throughput, dice) else {
            return PathEnd::Absorbed;
        };
        luminance_of_start *= luminance_ratio(body, &surface, next.direction);
        (direction, throughput) = (next.direction, throughput * next.weight);
        hit = scene.bvh().closest_hit(&next.ray);
    }
    PathEnd::GivenUp(throughput.luminance())
}

/// One sample of the specular part of the light that leaves a surface, with Russian roulette.
pub(crate) fn specular_step(
    body: &Body,
    surface: &SurfacePoint,
    incoming: Direction,
    throughput: Rgb,
    dice: &mut Dice,
) -> Option<Scattered> {
    match body {
        Body::Dielectric(glass) => {
            let [pick, survive] = dice.pair();
            let next = refract(glass, surface, incoming, pick);
            let chance = (throughput * next.weight).max_channel().min(1.0);
            let weight = next.weight * (1.0 / chance.max(f64::MIN_POSITIVE));
            (survive < chance).then_some(Scattered { weight, ..next })
        }
        Body::Opaque { front, back } => {
            let finish = if surface.back { back } else { front };
            let share = specular_share(finish, surface, incoming);
            if share == 0.0 {
                return None;
            }
            // Strong reflections are always followed while the path carries much: roulette on them would cost
            // more in noise than it saves in rays.
            let chance = (2.0 * share * throughput.max_channel()).min(1.0);
            let [survive, pick] = dice.pair();
            if survive >= chance {
                return None;
            }
            let square = if finish.is_glossy() { dice.pair() } else { [0.0; 2] };
            // `reflect` weights its sample as one taken with the probability `share`; the probability here is
            // `chance`.
            let next = reflect(finish, surface, incoming, pick, square)?;
            Some(Scattered { weight: next.weight * (share / chance), ..next })
        }
    }
}
