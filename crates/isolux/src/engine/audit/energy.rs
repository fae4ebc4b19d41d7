//! The balance of energy, by particles that know no map.
//!
//! Particles carry all light from the luminaires until it is absorbed or leaves. What arrives at a surface, counted
//! before it is reflected, is the integral of the illuminance there. A map whose error has the root mean square e over
//! an area A may be wrong by e sqrt(A a) in the integral over a part of area a (Cauchy and Schwarz). What lies
//! beyond that and beyond the noise of the particles is light that the map lacks or has invented.
//!
//! The noise on a surface is that of its replicates, and no less than it would be if the map were right: `n` particles of weight `w`
//! bring a flux `n w` with the variance `n w^2` (Poisson). Where few particles or none arrive, their spread alone tells nothing.

use crate::elements::carries_map;
use crate::engine::light::{Emission, Lighting, Particle, scatterings};
use crate::engine::read::reference_lx;
use crate::map::{EnergyBalance, IlluminationMap, MeasuredFlux, SurfaceBalance, VertexLight};
use crate::sampling::{Key, Sequence};
use crate::scene::Scene;
use rayon::prelude::*;

/// The number of independent replicates of the particles.
const REPLICATES: u32 = 16;

/// Where the light of some particles went, lm.
struct Went {
    absorbed: f64,
    escaped: f64,
    given_up: f64,
    /// What arrived, by shape.
    arriving: Vec<f64>,
    rays: u64,
}

/// The light of a map on a shape.
#[derive(Clone, Copy, Default)]
struct Mapped {
    lm: f64,
    area_m2: f64,
}

/// The balance of energy of a scene and of its map, by `particles` particles. `None` where there is no light, or
/// light from infinitely far away, whose flux depends on what is taken for the scene.
pub fn energy_balance(
    scene: &Scene,
    map: &IlluminationMap,
    particles: u32,
    seed: u64,
) -> Option<EnergyBalance> {
    let emission = Emission::new(scene)?;
    if scene.luminaires().iter().any(|luminaire| luminaire.kind.is_infinitely_far()) {
        return None;
    }
    let lighting = Lighting::new(scene);
    let key = Key::new(seed).with(0x0e6e);
    let each = particles.div_ceil(REPLICATES);
    let flown = |replicate: u32| {
        let sequence = Sequence::new(key.with(u64::from(replicate)));
        fly((scene, map), (&emission, &lighting), (sequence, each))
    };
    let went: Vec<Went> = (0..REPLICATES).into_par_iter().map(flown).collect();
    let mapped = mapped(scene, map);
    let flux = |of: &dyn Fn(&Went) -> f64| measured(went.iter().map(of));
    let mapped_lm: f64 = mapped.iter().map(|of| of.lm).sum();
    let area_m2: f64 = mapped.iter().map(|of| of.area_m2).sum();
    let error_lx = map
        .provenance
        .accuracy
        .map_or(f64::INFINITY, |accuracy| accuracy.interpolated * reference_lx(map));
    let weight_lm = emission.flux_lm() / (f64::from(each) * f64::from(REPLICATES));
    let explained_lm = |part_m2: f64, arriving: MeasuredFlux, mapped_lm: f64| {
        let noise_lm = arriving.standard_error_lm.max((mapped_lm * weight_lm).sqrt());
        EnergyBalance::DEVIATIONS * noise_lm + error_lx * (part_m2 * area_m2).sqrt()
    };
    let arriving = flux(&|went| went.arriving.iter().sum());
    let surfaces = mapped.iter().enumerate().filter(|(_, of)| of.area_m2 > 0.0);
    let surfaces = surfaces.map(|(shape, of)| {
        let arriving = flux(&|went| went.arriving[shape]);
        SurfaceBalance {
            shape: scene.shape_names()[shape].clone(),
            arriving,
            mapped_lm: of.lm,
            explained_lm: explained_lm(of.area_m2, arriving, of.lm),
        }
    });
    let excess = |of: &SurfaceBalance| (of.arriving.lm - of.mapped_lm).abs() / of.explained_lm;
    let mut surfaces: Vec<SurfaceBalance> = surfaces.filter(|of| excess(of) > 1.0).collect();
    surfaces.sort_by(|a, b| excess(b).total_cmp(&excess(a)));
    Some(EnergyBalance {
        particles: u64::from(each) * u64::from(REPLICATES),
        rays: went.iter().map(|went| went.rays).sum(),
        emitted_lm: emission.flux_lm(),
        absorbed: flux(&|went| went.absorbed),
        escaped: flux(&|went| went.escaped),
        given_up: flux(&|went| went.given_up),
        arriving,
        mapped_lm,
        explained_lm: explained_lm(area_m2, arriving, mapped_lm),
        surfaces,
    })
}

/// Follows particles that share all light.
fn fly(
    (scene, map): (&Scene, &IlluminationMap),
    (emission, lighting): (&Emission, &Lighting),
    (sequence, count): (Sequence, u32),
) -> Went {
    let shapes = scene.shape_names().len();
    let mut went =
        Went { absorbed: 0.0, escaped: 0.0, given_up: 0.0, arriving: vec![0.0; shapes], rays: 0 };
    let most = scatterings(scene);
    for index in 0..count {
        let Some(mut particle) = Particle::emit(emission, sequence, index, count, most) else {
            continue;
        };
        loop {
            went.rays += 1;
            let lm = particle.flux_lm.luminance();
            let Some(at) = particle.advance(scene) else {
                went.escaped += lm;
                break;
            };
            let is_known = carries_map(scene, at.triangle, at.back)
                && map.interpolate(at.triangle, at.back, at.u, at.v).is_some();
            if is_known {
                went.arriving[scene.shape_of(at.triangle) as usize] += lm;
            }
            if !particle.scatter(scene, lighting) {
                went.absorbed += lm;
                break;
            }
            // Roulette is even in one colour alone; in the mean the rest of the light is absorbed.
            went.absorbed += lm - particle.flux_lm.luminance();
            if particle.is_given_up() {
                went.given_up += particle.flux_lm.luminance();
                break;
            }
        }
    }
    went
}

/// The integral of the illuminance of a map over the known parts of every shape.
fn mapped(scene: &Scene, map: &IlluminationMap) -> Vec<Mapped> {
    let mut found = vec![Mapped::default(); scene.shape_names().len()];
    let vertices = map.elements.vertices();
    for element in map.elements.elements() {
        let [a, b, c] = element.vertices.map(|vertex| vertices[vertex as usize].position);
        let area_m2 = 0.5 * (b - a).cross(c - a).length();
        let corners = element.vertices.map(|vertex| (map.read_at_vertex(vertex), 1.0 / 3.0));
        if let Some(light) = VertexLight::mix(corners) {
            let of = &mut found[scene.shape_of(element.triangle) as usize];
            of.lm += area_m2 * light.illuminance_lx();
            of.area_m2 += area_m2;
        }
    }
    found
}

/// The mean of replicates and its standard error.
fn measured(values: impl Iterator<Item = f64>) -> MeasuredFlux {
    let values: Vec<f64> = values.collect();
    let n = values.len() as f64;
    let lm = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|value| (value - lm) * (value - lm)).sum();
    MeasuredFlux { lm, standard_error_lm: (squares / (n * (n - 1.0))).sqrt() }
}
