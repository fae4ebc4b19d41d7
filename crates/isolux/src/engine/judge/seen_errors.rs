//! Errors of the map, as other places see them.
//!
//! Check points measure the error of the map where they lie. Rays do not read all of these errors alike.
//! Surfaces below and behind things are hidden from nearly everywhere, and rays that end close by gather
//! again. An element that reaches from the open to below a cupboard is too bright there and too dark in the
//! open: right in the mean, wrong for every viewer. And different places see different errors. So every check
//! point knows the share of its surroundings that sees it from afar. Some of them also know which others they
//! see, as discs of the area that those stand for.

use crate::ablation::without;
use crate::engine::ray::{ShortRays, SurfacePoint};
use crate::sampling::Key;
use crate::scene::Scene;
use isolux_geometry::Ray;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// The number of rays that estimate the share of its surroundings that sees a place.
const FEELERS: usize = 16;
static DIRECTIONS: LazyLock<ShortRays<FEELERS>> =
    LazyLock::new(|| ShortRays::of(Key::new(0).with(9)));

/// One place in this many records which others it sees. (With 64 in the hall, the result differed from seed
/// to seed by as much as its value.)
const LOOKING: usize = 4;

/// A place where rays read the map.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ReadPlace {
    pub(crate) surface: SurfacePoint,
    /// The longest edge of the element there, m. Rays that have travelled less gather again.
    pub(crate) edge_m: f64,
    /// The area that the place stands for, m2.
    pub(crate) area_m2: f64,
}

/// The exchange of light between a place and others.
#[derive(Clone, Debug, Default)]
pub(crate) struct View {
    /// The light that arrives elsewhere from afar per unit of light at the place, mean over its surroundings.
    pub(crate) shown: f64,
    /// Other places that it sees, and the light that arrives from them per unit of light there; `None` for
    /// most places.
    seen: Option<Vec<(u32, f64)>>,
}

/// The views of some places.
pub(crate) fn views(scene: &Scene, places: &[ReadPlace]) -> Vec<View> {
    let reflected: Vec<f64> =
        places.iter().map(|place| place.surface.reflectance(scene).luminance()).collect();
    let seen = |from: usize| {
        let share = |at: &ReadPlace| share(&places[from], at);
        let of = places.iter().zip(&reflected).map(|(at, reflected)| reflected * share(at));
        let facing: Vec<(u32, f64)> = (0..).zip(of).filter(|(_, share)| *share > 0.0).collect();
        let ray =
            |k: u32| Ray::between(places[from].surface.start(), places[k as usize].surface.start());
        let rays: Vec<Ray> = facing.iter().map(|&(k, _)| ray(k)).collect();
        let mut are_hidden = vec![false; rays.len()];
        scene.bvh().any_hits(&rays, &mut are_hidden);
        let of = facing.into_iter().zip(are_hidden).filter(|(_, is_hidden)| !is_hidden);
        of.map(|(seen, _)| seen).collect()
    };
    let view = |k: usize| View {
        shown: if without("seen-errors") { 0.0 } else { reflected[k] * far(scene, &places[k]) },
        seen: (k.is_multiple_of(LOOKING) && !without("seen-errors")).then(|| seen(k)),
    };
    (0..places.len()).into_par_iter().map(view).collect()
}

/// The variation from place to place of the errors that places see, root mean square. Each view stands for a
/// share of the surface. Errors at different places are independent, so products of two of them estimate the
/// square without noise.
pub(crate) fn spread<'a>(views: impl Iterator<Item = (f64, &'a View)>, errors: &[f64]) -> f64 {
    let mut of_mean = vec![0.0; errors.len()];
    let (mut squared, mut whole) = (0.0, 0.0);
    for (share, seen) in views.filter_map(|(share, view)| Some((share, view.seen.as_ref()?))) {
        let (mut sum, mut own) = (0.0, 0.0);
        for &(k, weight) in seen {
            let error = weight * errors[k as usize];
            sum += error;
            own += error * error;
            of_mean[k as usize] += share * error;
        }
        squared += share * (sum * sum - own);
        whole += share;
    }
    let mean: f64 = of_mean.iter().sum();
    let own: f64 = of_mean.iter().map(|error| error * error).sum();
    let squared = squared - (mean * mean - own) / whole;
    if whole > 0.0 { (squared.max(0.0) / whole).sqrt() } else { 0.0 }
}

/// The share of its surroundings that sees a place from farther away than the longest edge of its element.
fn far(scene: &Scene, place: &ReadPlace) -> f64 {
    let at = &place.surface;
    let axis = at.geometric;
    let rays: [Ray; FEELERS] = std::array::from_fn(|k| {
        DIRECTIONS.ray(k, (at.start(), axis, at.triangle)).up_to(place.edge_m as f32)
    });
    let mut are_hit = [false; FEELERS];
    scene.bvh().any_hits(&rays, &mut are_hit);
    are_hit.iter().filter(|&&is_hit| !is_hit).count() as f64 / FEELERS as f64
}

/// The share of the view of one place that another fills as a disc; zero if it is near or faces away.
/// Occlusion is not tested.
fn share(from: &ReadPlace, at: &ReadPlace) -> f64 {
    let between = at.surface.point - from.surface.point;
    let distance_m = between.length();
    let there = from.surface.geometric.to_vector().dot(between);
    let back = -at.surface.geometric.to_vector().dot(between);
    if distance_m <= at.edge_m || there <= 0.0 || back <= 0.0 {
        return 0.0;
    }
    let cosines = there * back / (distance_m * distance_m);
    at.area_m2 * cosines / (PI * distance_m * distance_m + at.area_m2)
}
