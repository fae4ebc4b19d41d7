//! Repeated runs: on any number of threads, and from a cache.

use super::room;
use crate::engine::{
    CACHE_REPLICATES, CacheReader, CacheSettings, CachedPlace, IrradianceCache, SampleKind,
    SolveRequest, Watch, solve,
};
use crate::map::Method;
use std::cell::Cell;

/// Places on every triangle of a scene.
fn places(triangles: u32) -> Vec<CachedPlace> {
    let squares = (0..25).map(|k| [0.05 + 0.09 * f64::from(k % 5), 0.05 + 0.09 * f64::from(k / 5)]);
    squares
        .flat_map(|[u, v]| {
            (0..triangles).map(move |triangle| CachedPlace { triangle, back: false, u, v })
        })
        .collect()
}

fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(work)
}

#[test]
fn views_make_the_same_samples_on_any_number_of_threads_and_none_twice() {
    let scene = room();
    let asked = places(scene.triangle_count());
    let settings = CacheSettings::for_accuracy(0.02);
    let made = |threads: usize| {
        on_threads(threads, || {
            let empty = IrradianceCache::default();
            let mut reader = CacheReader::new(&scene, &empty, settings).unwrap();
            let served = reader.serve(&asked);
            let glance = reader.glance(&asked[7], 0).unwrap();
            (served.made, glance)
        })
    };
    let (first, glance) = made(1);
    assert_eq!((first.clone(), glance), made(3));
    assert!(first.count(SampleKind::Near) > 20 && first.count(SampleKind::Far) > 20);
    let mut again = CacheReader::new(&scene, &first, settings).unwrap();
    assert_eq!(again.glance(&asked[7], 0), Some(glance));
    let more = again.serve(&asked).made.samples.len();
    // These are places whose sample has shrunk beside a later one.
    assert!(more * 5 < first.samples.len(), "{more} of {}", first.samples.len());
}

#[test]
fn serving_cut_short_makes_the_first_of_the_same_samples() {
    let scene = room();
    let asked = places(scene.triangle_count());
    let settings = CacheSettings::for_accuracy(0.02);
    let served_until = |most: u32| {
        let mut reader = CacheReader::new(&scene, &IrradianceCache::default(), settings).unwrap();
        let times = Cell::new(0);
        let served = reader.serve_until(&asked, &|| times.replace(times.get() + 1) >= most);
        assert_eq!(served.is_whole, reader.glance(&asked[7], 0).is_some());
        served
    };
    let whole = served_until(u32::MAX);
    assert!(whole.is_whole);
    // It is asked before each replicate of the far samples, then before parts of the near samples.
    let replicates = CACHE_REPLICATES as u32;
    assert_eq!(served_until(replicates - 1).made, IrradianceCache::default());
    let short = served_until(replicates);
    assert!(!short.is_whole && short.made.count(SampleKind::Far) > 20);
    assert_eq!(short.made.samples[..], whole.made.samples[..short.made.samples.len()]);
    let mut again = CacheReader::new(&scene, &short.made, settings).unwrap();
    let rest = again.serve(&asked);
    assert!(rest.is_whole && rest.made.count(SampleKind::Near) > 20);
}

#[test]
fn maps_are_the_same_on_any_number_of_threads() {
    let scene = room();
    let request =
        SolveRequest { method: Method::Cache, accuracy: Some(0.05), ..SolveRequest::default() };
    let solution =
        |threads| on_threads(threads, || solve(&scene, &request, None, &mut |_| Watch::Continue));
    let (one, three) = (solution(1).unwrap(), solution(3).unwrap());
    assert_eq!(one.map, three.map);
    assert_eq!(one.cache, three.cache);
    assert!(one.map.provenance.complete && !one.cache.samples.is_empty());
}

#[test]
fn a_map_from_its_own_cache_costs_little_and_says_the_same() {
    let scene = room();
    let request =
        SolveRequest { method: Method::Cache, accuracy: Some(0.05), ..SolveRequest::default() };
    let cold = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap();
    let warm = SolveRequest { cache: cold.cache.clone(), ..request };
    let warm = solve(&scene, &warm, None, &mut |_| Watch::Continue).unwrap();
    assert!(warm.cache.samples.len() * 5 < cold.cache.samples.len());
    let pairs = warm.map.values.iter().flatten().zip(cold.map.values.iter().flatten());
    let (mut squares, mut differences) = (0.0, 0.0);
    for (a, b) in pairs {
        let (a, b) = (a.illuminance_lx(), b.illuminance_lx());
        squares += b * b;
        differences += (a - b) * (a - b);
    }
    // The values agree within the accuracy goal.
    assert!((differences / squares).sqrt() < 0.05);
}
