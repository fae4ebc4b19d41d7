//! The choice of gathered texels that a texel may be interpolated from. A thin wall on a floor separates two
//! rooms, and readings in one say nothing of the other.

use super::plane::Node;
use crate::engine::IndirectReading;
use std::collections::HashSet;

/// The relative difference up to which light counts as alike. It may come from behind something thin, like
/// the leg of a table.
const UNEVEN: f64 = 0.2;
/// The difference up to which noisy light counts as alike, in standard deviations.
const DEVIATIONS: f64 = 2.0;
/// The largest relative difference of noisy light that counts as alike.
const MOST_UNEVEN: f64 = 0.5;
/// The number of nearest texels tested for visibility. If the texel sees none of them, it is not
/// interpolated.
const MOST_TRIED: usize = 16;

/// Pairs of gathered texels, the lower first, that differ in light and do not see each other.
#[derive(Debug, Default)]
pub(super) struct Parted(HashSet<[usize; 2]>);

impl Parted {
    /// Adds the pairs of a gathered texel.
    pub(super) fn add(&mut self, one: usize, others: impl Iterator<Item = usize>) {
        self.0.extend(others.map(|other| [one.min(other), one.max(other)]));
    }

    /// Keeps the nodes whose light is like that of the nearest visible one, or that it sees. Few rays
    /// decide for all. If all light is alike, no ray is traced. Visibility from the nearest was tested only
    /// close to it; nodes farther off must be visible from the texel itself.
    pub(super) fn keep_seen(
        &self,
        nodes: &mut Vec<Node>,
        is_seen: impl Fn(&Node) -> bool,
        are_near: impl Fn(usize, usize) -> bool,
    ) {
        let Some(first) = nodes.first() else { return };
        if self.0.is_empty() || nodes.iter().all(|node| are_alike(&node.reading, &first.reading)) {
            return;
        }
        let Some(&Node { index: first, reading, .. }) = nearest_seen(nodes, &is_seen) else {
            nodes.clear();
            return;
        };
        let sees = |node: &Node| match are_near(first, node.index) {
            true => !self.0.contains(&[first.min(node.index), first.max(node.index)]),
            false => is_seen(node),
        };
        nodes.retain(|node| are_alike(&node.reading, &reading) || sees(node));
    }
}

/// The nearest visible node.
pub(super) fn nearest_seen(nodes: &[Node], is_seen: impl Fn(&Node) -> bool) -> Option<&Node> {
    let mut nearest: Vec<&Node> = nodes.iter().collect();
    let by_distance = |a: &&Node, b: &&Node| {
        a.away_squared().total_cmp(&b.away_squared()).then(a.index.cmp(&b.index))
    };
    if nearest.len() > MOST_TRIED {
        nearest.select_nth_unstable_by(MOST_TRIED - 1, by_distance);
        nearest.truncate(MOST_TRIED);
    }
    nearest.sort_unstable_by(by_distance);
    nearest.into_iter().find(|node| is_seen(node))
}

/// Whether light is alike, noise aside.
pub(super) fn are_alike(a: &IndirectReading, b: &IndirectReading) -> bool {
    let [a_lx, b_lx] = [a, b].map(|reading| reading.lx.luminance());
    let most_lx = a_lx.max(b_lx);
    let noise_lx = DEVIATIONS * libm::hypot(a.noise_lx, b.noise_lx);
    (a_lx - b_lx).abs() <= noise_lx.clamp(UNEVEN * most_lx, MOST_UNEVEN * most_lx)
}
