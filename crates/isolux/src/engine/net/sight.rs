//! Which of the texels that were gathered may lend their light to one: a thin wall that stands on a floor parts two rooms, and what is
//! gathered in one tells nothing of the other.

use super::{IndirectReading, Node};

/// Light that differs by no more than this share of the greater is alike: it may come from behind something, like the leg of a table.
const UNEVEN: f64 = 0.2;
/// Where that is noisy it may differ by so many standard deviations, but by no more than this share.
const DEVIATIONS: f64 = 2.0;
const MOST_UNEVEN: f64 = 0.5;
/// Where none of so many of the nearest is seen nothing is lent.
const MOST_TRIED: usize = 16;

/// Keeps those that are seen, or have light like the nearest of these. Where all is alike nobody looks.
pub(super) fn keep_seen(nodes: &mut Vec<Node>, is_seen: impl Fn(&Node) -> bool) {
    let Some(first) = nodes.first() else { return };
    if nodes.iter().all(|node| are_alike(&node.reading, &first.reading)) {
        return;
    }
    let Some(first) = nearest_seen(nodes, &is_seen) else {
        nodes.clear();
        return;
    };
    nodes.retain(|node| are_alike(&node.reading, &first) || is_seen(node));
}

/// What the nearest tells that is seen.
pub(super) fn nearest_seen(
    nodes: &[Node],
    is_seen: impl Fn(&Node) -> bool,
) -> Option<IndirectReading> {
    let mut nearest: Vec<&Node> = nodes.iter().collect();
    let by_distance = |a: &&Node, b: &&Node| {
        a.away_squared().total_cmp(&b.away_squared()).then(a.number.cmp(&b.number))
    };
    if nearest.len() > MOST_TRIED {
        nearest.select_nth_unstable_by(MOST_TRIED - 1, by_distance);
        nearest.truncate(MOST_TRIED);
    }
    nearest.sort_unstable_by(by_distance);
    nearest.into_iter().find(|node| is_seen(node)).map(|node| node.reading)
}

fn are_alike(a: &IndirectReading, b: &IndirectReading) -> bool {
    let [a_lx, b_lx] = [a, b].map(|reading| reading.lx.luminance());
    let most_lx = a_lx.max(b_lx);
    let noise_lx = DEVIATIONS * libm::hypot(a.noise_lx, b.noise_lx);
    (a_lx - b_lx).abs() <= noise_lx.clamp(UNEVEN * most_lx, MOST_UNEVEN * most_lx)
}
