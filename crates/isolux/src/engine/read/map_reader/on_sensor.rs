//! Readings of sensors with a bent surface, which see all round: cylindrical, semi-cylindrical and hemispherical illuminance.
//!
//! The illuminance of such a sensor is the mean of planar ones over its surface. Rays about normals drawn evenly over that surface
//! are so distributed as the sensor weighs light by its direction: no ray counts more than another. One replicate is the mean over
//! such rays, so the spread of replicates is the noise of the reading as a whole; planar readings, which err together, are not added.

use super::effort::{FRESH_MOST_RAYS, FRESH_REPLICATES, OF_FEW};
use super::state::{MapReader, times_rays};
use crate::engine::gather::Gatherer;
use crate::engine::light::Goal;
use crate::engine::ray::{ProbePoint, Sensor, SurfacePoint, mean_and_variance, place_key};
use crate::map::Illuminance;
use crate::sampling::{Key, Sequence};
use crate::units::Rgb;
use isolux_geometry::Point;

/// The normals of one replicate.
const NORMALS: u32 = 16;
/// The fewest and the most rays about each.
const RAYS: [u32; 2] = [1, FRESH_MOST_RAYS as u32 / NORMALS];
/// Normals at which the view of a sensor is looked at: whether it sees light, and the local part of errors of the map.
const LOOKS: u32 = 4;
/// The height of a sensor above a surface that its place lies on, in roundings of the place.
const ABOVE_ROUNDINGS: f64 = 64.0;

/// Light gathered by the replicates of a sensor.
struct Gathered {
    lx: Rgb,
    variance: f64,
    close: f64,
    common_lx: f64,
}

impl MapReader<'_> {
    /// The illuminance of a small sensor with a bent surface, with its standard error. Direct light is evaluated, indirect light is
    /// gathered over the map until its noise is below the error of the map, and caustics are unknown and left out, on surfaces,
    /// too. A sensor on a surface stands just above it. `None` where only the inside of something is seen.
    pub fn on_sensor(&self, position: Point, sensor: &Sensor) -> Option<Illuminance> {
        let position = self.above_surfaces(position, sensor);
        let key = place_key(position).with(23).with(self.map.provenance.seed);
        let views = self.gatherers(position, sensor, (LOOKS, 1), key);
        if !views.iter().any(|view| self.sees_light(view)) {
            return None;
        }
        let parts = views.iter().map(|view| self.part_of(view));
        let part = parts.sum::<f64>() / f64::from(LOOKS);
        let [fewest, most] = RAYS;
        // The trial is discarded: to stop at a small variance would report too small ones.
        let trial = self.gather_all_round(position, sensor, fewest, key.with(0));
        let rays = f64::from(fewest) * times_rays(trial.variance, self.noise_goal_lx(part));
        let rays = rays.clamp(f64::from(fewest), f64::from(most)) as u32;
        let Gathered { lx, variance, close, common_lx } =
            self.gather_all_round(position, sensor, rays, key.with(1));
        let lookup_lx = self.map.provenance.fresh.map_or(0.0, |fresh| fresh.lookup_lx);
        let noise_lx = OF_FEW * variance.sqrt();
        let indirect = Illuminance {
            indirect_lx: lx,
            indirect_standard_error_lx: [common_lx, self.map.ambient_doubt_lx()]
                .into_iter()
                .fold(noise_lx, libm::hypot),
            common_error_lx: common_lx,
            interpolation_error_lx: close * part * lookup_lx,
            bias_lx: part * self.unseen.bias_lx,
            samples: u64::from(FRESH_REPLICATES * NORMALS * rays),
            ..Illuminance::NOTHING
        };
        Some(self.told(self.with_direct_all_round(indirect, (&views[0].surface, sensor))))
    }

    fn with_direct_all_round(
        &self,
        indirect: Illuminance,
        (at, sensor): (&SurfacePoint, &Sensor),
    ) -> Illuminance {
        let sequence = Sequence::new(place_key(at.point).with(24).with(self.map.provenance.seed));
        let of_direct = self.unseen.of_direct;
        let about_lx = of_direct.share * indirect.illuminance_lx();
        let goal = Goal { lx: of_direct.lx.max(about_lx), ..of_direct };
        let direct = self.lighting.all_round(at, sensor, goal, sequence);
        let error_lx = Self::indirect_error_lx(&indirect);
        Illuminance {
            direct_lx: direct.lx,
            standard_error_lx: (error_lx * error_lx + direct.variance).sqrt(),
            indirect_standard_error_lx: error_lx,
            ..indirect
        }
    }

    /// A place off the surface that it lies on, if any.
    fn above_surfaces(&self, position: Point, sensor: &Sensor) -> Point {
        let normal = sensor.up().to_normal();
        self.places
            .surface_at(ProbePoint { position, normal }, |_| true)
            .map_or(position, |at| at.point + at.geometric * (ABOVE_ROUNDINGS * at.away_m))
    }

    /// Gatherers about normals spread evenly over a sensor.
    fn gatherers(
        &self,
        position: Point,
        sensor: &Sensor,
        (normals, rays): (u32, u32),
        key: Key,
    ) -> Vec<Gatherer> {
        let sequence = Sequence::new(key);
        let about = |k| sensor.normal(sequence.pair(k, 0));
        (0..normals).map(|k| Gatherer::in_space(self.scene, position, about(k), rays)).collect()
    }

    fn gather_all_round(&self, position: Point, sensor: &Sensor, rays: u32, key: Key) -> Gathered {
        let replicate =
            |k: u32| self.gatherers(position, sensor, (NORMALS, rays), key.with(2 * u64::from(k)));
        let rows: Vec<Gatherer> = (0..FRESH_REPLICATES).flat_map(replicate).collect();
        let shadow_rays = self.lighting.rays_of_estimate();
        let of_row = |row: usize| {
            let (k, normal) = (row as u64 / u64::from(NORMALS), row as u64 % u64::from(NORMALS));
            key.with(2 * k + 1).with(normal)
        };
        let operator = self.gathering(self.direct_at_ends()).operator(&rows, of_row);
        self.count(operator.rays * (1 + shadow_rays));
        let lit = operator.apply(&self.light);
        let replicates: Vec<Rgb> = lit
            .chunks(NORMALS as usize)
            .map(|of| of.iter().copied().sum::<Rgb>() / f64::from(NORMALS))
            .collect();
        let (lx, variance) = mean_and_variance(&replicates);
        let close = operator.close().sum::<f64>() / rows.len() as f64;
        let common_lx = self.shared_noise.lx(self.map, &rows[0].surface, &operator);
        Gathered { lx, variance, close, common_lx }
    }
}
