//! Which of the texels that were gathered may lend their light to one: a thin wall that stands on a floor parts two rooms, and what is
//! gathered in one tells nothing of the other.

use super::plane::Node;
use crate::engine::IndirectReading;
use std::collections::HashSet;

/// Light that differs by no more than this share of the greater is alike: it may come from behind something, like the leg of a table.
const UNEVEN: f64 = 0.2;
/// Where that is noisy it may differ by so many standard deviations, but by no more than this share.
const DEVIATIONS: f64 = 2.0;
const MOST_UNEVEN: f64 = 0.5;
/// Where none of so many of the nearest is seen nothing is lent.
const MOST_TRIED: usize = 16;

/// Pairs of texels that were gathered, the lower first, whose light is not alike and which do not see each other.
#[derive(Debug, Default)]
pub(super) struct Parted(HashSet<[usize; 2]>);

impl Parted {
    /// Takes in those of a texel that was gathered.
    pub(super) fn add(&mut self, one: usize, others: impl Iterator<Item = usize>) {
        self.0.extend(others.map(|other| [one.min(other), one.max(other)]));
    }

    /// Keeps what the nearest that is seen from a texel sees, or has light like it: few rays tell of all. Where all is alike nobody
    /// looks. What does not lie near to that one was not looked at from there: it is to be seen from the texel itself.
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

/// The nearest that is seen.
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
