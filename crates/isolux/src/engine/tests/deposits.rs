//! Particles on vertices: flux kept, even and linear light given back.

use super::errors::{room, small_plan};
use super::*;
use crate::engine::gather::Unlit;
use crate::engine::light::{Emission, Lighting};
use crate::engine::method::{Forward, Tally};
use crate::engine::pilot::{PilotRequest, pilot};
use crate::engine::plan::Plan;
use crate::engine::ray::{Accumulator, NEVER, SurfacePoint};

/// Deposits an illuminance over all elements, on a fine lattice of each.
fn light_up(plan: &Plan, tally: &Tally, lux: impl Fn(Point) -> f64) -> f64 {
    let n = 24;
    let mut flux_lm = 0.0;
    for leaf in plan.mesh.subdivision.leaves() {
        let (_, origin) = plan.mesh.subdivision.node(leaf);
        let triangle = plan.mesh.subdivision.triangle(leaf);
        let root = plan.scene.triangle(origin.triangle);
        let share_m2 = triangle.area() / f64::from(n * n);
        for (i, j) in (0..n).flat_map(|i| (0..n - i).map(move |j| (i, j))) {
            // The centroids of the two halves of a lattice cell.
            for third in [1.0 / 3.0, 2.0 / 3.0] {
                let (u, v) =
                    ((f64::from(i) + third) / f64::from(n), (f64::from(j) + third) / f64::from(n));
                if u + v > 1.0 {
                    continue;
                }
                let point = triangle.point(u, v);
                let [u, v] = root.barycentric(point);
                let at = SurfacePoint::new(plan.scene, origin.triangle, origin.back, u, v);
                let lm = lux(point) * share_m2;
                flux_lm += lm;
                tally.add(0, &at, Rgb::grey(lm));
            }
        }
    }
    flux_lm
}

/// The largest error at a vertex for an illuminance given as a function, lx.
fn worst(lux: impl Fn(Point) -> f64, found: impl Fn(&Tally) -> Vec<Rgb>) -> f64 {
    let scene = room();
    let lighting = Lighting::new(&scene);
    let plan = small_plan(&scene, &lighting);
    let tally = Tally::new(&plan, 1e4, 1);
    light_up(&plan, &tally, &lux);
    let error = |(v, e): (&crate::elements::Vertex, &Rgb)| (e.luminance() - lux(v.position)).abs();
    plan.mesh.elements.vertices().iter().zip(&found(&tally)).map(error).fold(0.0, f64::max)
}

#[test]
fn even_light_is_given_back() {
    // The lattice integrates a hat to a few parts in ten thousand.
    assert!(worst(|_| 100.0, |t| t.means(0)) < 0.1);
    assert!(worst(|_| 100.0, |t| t.illuminance(0)) < 0.1);
}

#[test]
fn the_correction_brings_linear_light_closer_at_borders() {
    let slope = |p: Point| 100.0 + 10.0 * p.x + 5.0 * p.y;
    let (plain, corrected) = (worst(slope, |t| t.means(0)), worst(slope, |t| t.illuminance(0)));
    assert!(corrected < 0.7 * plain, "{corrected} {plain}");
}

#[test]
fn flux_is_kept() {
    let scene = room();
    let lighting = Lighting::new(&scene);
    let plan = small_plan(&scene, &lighting);
    let tally = Tally::new(&plan, 1e4, 1);
    let flux_lm = light_up(&plan, &tally, |p| 10.0 + p.x * p.y + 3.0 * p.z);
    let vertices = plan.mesh.elements.vertices();
    let kept: f64 =
        tally.means(0).iter().zip(vertices).map(|(e, v)| e.luminance() * v.area_m2).sum();
    // Each of a million deposits is rounded by half of 1e4 lm over 2^48, at random.
    assert!((kept - flux_lm).abs() < 1e-6, "{kept} {flux_lm}");
}

/// Mean of an increment of the forward engine, by vertex.
fn forward(scene: &Scene, request: &PilotRequest) -> (Vec<f64>, Vec<f64>) {
    let lighting = Lighting::new(scene);
    let plan = pilot(scene, &lighting, request, &Unlit::default(), &mut |_| true);
    let mut lacking = Accumulator::new(plan.errors.parts.count(), plan.light.reference_lx);
    let engine = Forward::new(&plan, Emission::new(scene).unwrap(), 0.05, 1);
    let mut sums = Accumulator::new(plan.mesh.elements.vertices().len(), plan.light.reference_lx);
    for k in 0..4 {
        engine.increment(k, &mut sums, &mut lacking, &NEVER).unwrap();
    }
    let lx = |k: usize| {
        let mean = sums.estimate(k).mean;
        (mean.direct + mean.caustic + mean.indirect).luminance()
    };
    let areas_m2: Vec<f64> = plan.mesh.elements.vertices().iter().map(|v| v.area_m2).collect();
    ((0..areas_m2.len()).map(lx).collect(), areas_m2)
}

#[test]
fn particles_carry_the_flux_and_what_is_reflected() {
    // All walls reflect one half: as much again arrives as leaves the luminaire.
    let request = PilotRequest {
        target: 1.0,
        goal: 1.0,
        mesh_target: 1.0,
        seed: 1,
        is_fitted: false,
        is_hybrid: false,
        refines_caustics: true,
        max_vertices: 150,
        most_for_indirect_light: None,
        least_edge_m: None,
        deadline: NEVER.clone(),
        end: NEVER.clone(),
    };
    let (lx, areas_m2) = forward(&room(), &request);
    let arriving_lm: f64 = lx.iter().zip(&areas_m2).map(|(e, a)| e * a).sum();
    let expected_lm = 4.0 * std::f64::consts::PI * 100.0 / (1.0 - 0.5);
    // A path reflects once in the mean with variance two; 4 x 16384 of them. The correction of
    // borders moves flux without keeping it to more than a per cent.
    let sigma = (2.0_f64 / 65_536.0).sqrt() / 2.0;
    let allowed = (SIGMAS * sigma + 0.01) * expected_lm;
    assert!((arriving_lm - expected_lm).abs() < allowed, "{arriving_lm} {expected_lm}");
}

#[test]
fn particles_light_all_vertices() {
    let request = PilotRequest {
        target: 0.2,
        goal: 0.2,
        mesh_target: 0.005,
        seed: 1,
        is_fitted: false,
        is_hybrid: false,
        refines_caustics: true,
        max_vertices: 3000,
        most_for_indirect_light: None,
        least_edge_m: None,
        deadline: NEVER.clone(),
        end: NEVER.clone(),
    };
    let (lx, _) = forward(&room(), &request);
    let dark = lx.iter().filter(|&&e| e == 0.0).count();
    assert_eq!(dark, 0, "of {} vertices", lx.len());
}
