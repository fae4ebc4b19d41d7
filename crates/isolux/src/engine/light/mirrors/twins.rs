//! Twins: chains of mirrors that form the same image.

use super::planar::Mirrors;
use isolux_geometry::{Point, Vector};
use std::collections::{BTreeSet, HashMap};

/// For each chain, the twins before it.
#[derive(Debug, Default)]
pub(crate) struct Twins(HashMap<Vec<u32>, Vec<Vec<u32>>>);

impl Twins {
    /// The twins among some chains.
    pub(crate) fn of(mirrors: &Mirrors, around: [Point; 2], chains: BTreeSet<Vec<u32>>) -> Self {
        let [low, high] = around;
        let side_m = (high - low).length();
        let axes = [Vector::ZERO, Vector::from([1.0, 0.0, 0.0]), Vector::from([0.0, 1.0, 0.0])];
        // The images of three points determine a motion up to a reflection in their plane, which
        // changes the parity of the chain.
        let marks = axes.map(|axis| low.lerp(high, 0.5) + axis * side_m);
        let image = |p: Point, chain: &[u32]| {
            chain.iter().fold(p, |p, &k| mirrors.planes[k as usize].image(p))
        };
        let mut all: Vec<([Point; 3], Vec<u32>)> =
            chains.into_iter().map(|chain| (marks.map(|p| image(p, &chain)), chain)).collect();
        all.sort_by(|(a, _), (b, _)| a[0].x.total_cmp(&b[0].x));
        let mut twins: HashMap<Vec<u32>, Vec<Vec<u32>>> = HashMap::new();
        for (k, (a, chain)) in all.iter().enumerate() {
            // Every reflection adds twice the error of its plane.
            let tolerance_m = 2.0 * chain.len() as f64 * mirrors.tolerance_m;
            let near = all[k + 1..].iter().take_while(|(b, _)| b[0].x - a[0].x <= tolerance_m);
            for (b, other) in near {
                let is_same = a.iter().zip(b).all(|(a, b)| (*a - *b).length() <= tolerance_m);
                if is_same && (chain.len() + other.len()).is_multiple_of(2) {
                    let key = |c: &Vec<u32>| (c.len(), c.clone());
                    let (first, second) =
                        if key(chain) < key(other) { (chain, other) } else { (other, chain) };
                    twins.entry(second.clone()).or_default().push(first.clone());
                }
            }
        }
        Self(twins)
    }

    /// The twins before a chain.
    pub(crate) fn before(&self, chain: &[u32]) -> &[Vec<u32>] {
        self.0.get(chain).map_or(&[], Vec::as_slice)
    }
}
