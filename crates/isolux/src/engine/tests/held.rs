//! The maximum principle: no sweep returns more than it receives, whatever the mesh and the light.

use super::*;
use crate::elements::{Elements, Subdivision};
use crate::engine::gather::{GivenRow, Operator};
use crate::engine::mesh::{Carriers, HatFunctions, corrected};
use crate::map::Standing;
use proptest::collection::vec;
use proptest::prelude::*;

/// Lines of the grid each way.
const LINES: usize = 6;

/// A sheet whose triangles are as long and as thin as these steps make them, powers of ten of a metre.
fn sheet(steps: [&[f64]; 2]) -> (Subdivision, Elements) {
    let places = |steps: &[f64]| -> Vec<f64> {
        let mut at = 0.0;
        std::iter::once(0.0)
            .chain(steps.iter().map(|&power| {
                at += libm::pow(10.0, power);
                at
            }))
            .collect()
    };
    let [xs, ys] = steps.map(places);
    let positions = ys.iter().flat_map(|&y| xs.iter().map(move |&x| [x, y, 0.0])).collect();
    let corner = |i: usize, j: usize| (j * LINES + i) as u32;
    let cells = (0..LINES - 1).flat_map(|j| (0..LINES - 1).map(move |i| (i, j)));
    let triangles = cells
        .flat_map(|(i, j)| {
            let [a, b] = [corner(i, j), corner(i + 1, j)];
            let [c, d] = [corner(i + 1, j + 1), corner(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    let shape = Shape { name: "sheet".into(), positions, triangles, ..Shape::default() };
    let scene = scene(vec![shape], vec![painted(Rgb::WHITE)], vec![]);
    let subdivision = Subdivision::new(&scene);
    let elements = subdivision.elements();
    (subdivision, elements)
}

/// Steps from a metre to a tenth of a micrometre: of slivers of 1 to 10 million, and of usual ones.
fn steps() -> impl Strategy<Value = Vec<f64>> {
    vec(prop_oneof![-7.3_f64..0.0, Just(0.0), Just(-0.3)], LINES - 1)
}

fn light() -> impl Strategy<Value = Vec<f64>> {
    vec(prop_oneof![Just(0.0), 0.0_f64..1.0, 0.0_f64..1e6], LINES * LINES)
}

/// Three vertices and barycentric weights of a ray, for every vertex a few.
fn rays() -> impl Strategy<Value = Vec<Vec<([u32; 3], [f64; 2])>>> {
    let vertex = 0..(LINES * LINES) as u32;
    let ray = ([vertex.clone(), vertex.clone(), vertex], [0.0_f64..1.0, 0.0_f64..1.0]);
    vec(vec(ray, 1..6), LINES * LINES)
}

fn greatest(values: &[Rgb]) -> f64 {
    values.iter().map(|value| value.max_channel()).fold(0.0, f64::max)
}

fn least(values: &[Rgb]) -> f64 {
    values.iter().map(|value| value.min_channel()).fold(f64::INFINITY, f64::min)
}

/// Sums of a few products are rounded, and weights of rays stored in `f32`.
const ROUNDED: f64 = 1e-6;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn no_fit_makes_more_light_than_there_is(
        (xs, ys, light, other) in (steps(), steps(), light(), light()),
    ) {
        let (_, elements) = sheet([&xs, &ys]);
        let all = elements.vertices().len();
        let grey = |light: &[f64]| -> Vec<Rgb> {
            (0..all).map(|k| Rgb::grey(light[k % light.len()])).collect()
        };
        let (light, other) = (grey(&light), grey(&other));
        let fit = Fit::new(&elements, all, |_| true, &Carriers::all());
        let fitted = fit.apply(&light);
        prop_assert!(least(&fitted) >= least(&light) && greatest(&fitted) <= greatest(&light));
        let held = fit.held(&light);
        for (a, b) in held.apply(&light).iter().zip(&fitted) {
            prop_assert!((a.0[0] - b.0[0]).abs() <= 1e-12 * greatest(&light));
        }
        let fitted = held.apply(&other);
        let rounding = 1e-12 * greatest(&other);
        prop_assert!(least(&fitted) >= 0.0 && greatest(&fitted) <= greatest(&other) + rounding);
    }

    /// Whatever rays read, and however thin elements are: a fixed point exists, is found, and is bounded by the light put in.
    #[test]
    fn the_fixed_point_is_bounded_by_what_is_put_in(
        (xs, ys, light, rays, reflectance) in (steps(), steps(), light(), rays(), 0.0_f64..=0.99),
    ) {
        let (_, elements) = sheet([&xs, &ys]);
        let all = elements.vertices().len();
        let rows: Vec<GivenRow> = (0..all)
            .map(|k| {
                let of_row = rays[k % rays.len()].iter().map(|&(vertices, [a, b])| {
                    let root = a.sqrt();
                    let weights = [1.0 - root, root * (1.0 - b), root * b].map(|w| w as f32);
                    (vertices.map(|v| v % all as u32), weights)
                });
                (Rgb::grey(light[k % light.len()]), of_row.collect())
            })
            .collect();
        let operator = Operator::of_rows(&rows, reflectance);
        let fit = Fit::new(&elements, all, |_| true, &Carriers::all());
        let black = vec![Rgb::BLACK; all];
        let waiting = Carriers::all().waiting();
        let tolerance = 1e-6;
        let (found, unsettled_lx) =
            operator.solve_or_give_up(&black, &black, (&waiting, Some(&fit)), (tolerance, &NEVER));
        let put_in = light.iter().copied().fold(0.0, f64::max);
        let most = put_in / (1.0 - reflectance);
        prop_assert!(least(&found) >= 0.0);
        // What the last sweep may have changed, reflected again and again, is part of it.
        let allowed = (1.0 + (ROUNDED + 100.0 * tolerance) / (1.0 - reflectance)) * most;
        prop_assert!(greatest(&found) <= allowed, "{} {}", greatest(&found), most);
        prop_assert!(unsettled_lx <= tolerance * greatest(&found), "{}", unsettled_lx);
    }

    /// What is taken off light leaves some, more of more light, and never grows faster than that.
    #[test]
    fn corrections_leave_light(
        (light, more, by) in (0.0_f64..1e3, 0.0_f64..1e3, -1e4_f64..1e4),
    ) {
        let of = |light: f64| corrected(Rgb::grey(light), Rgb::grey(by)).0[0];
        let (less, more_of_it) = (of(light), of(light + more));
        prop_assert!(less >= 0.0 && more_of_it - less >= -1e-9);
        prop_assert!(more_of_it - less <= more + 1e-9);
        prop_assert!(by < -15.0 / 16.0 * light || less == light + by);
    }

    /// Deposits that overshoot are held above zero, and no light is lost or made.
    #[test]
    fn deposits_are_held_without_loss((xs, ys, light) in (steps(), steps(), light())) {
        let (subdivision, elements) = sheet([&xs, &ys]);
        let all = elements.vertices().len();
        let standings = vec![Some(Standing::Open); all];
        let hats = HatFunctions::new(&subdivision, &standings);
        let means: Vec<Rgb> = (0..all).map(|k| Rgb::grey(light[k % light.len()])).collect();
        let values = hats.corrected(&means);
        let held = hats.held(&values);
        prop_assert!(least(&held) >= 0.0);
        let flux = |values: &[Rgb]| -> f64 {
            values.iter().zip(hats.areas_m2()).map(|(value, m2)| value.0[0] * m2).sum()
        };
        // Powers of half of the blur end with the 32nd.
        prop_assert!((flux(&held) - flux(&values)).abs() <= 1e-8 * flux(&means).max(f64::MIN_POSITIVE));
    }
}
