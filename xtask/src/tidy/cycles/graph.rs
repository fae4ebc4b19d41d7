//! Directed graphs.

/// For every set of nodes that reach each other, a shortest cycle through its first node.
pub(super) fn cycle_of_each_knot(nodes: usize, edges: &[(usize, usize)]) -> Vec<Vec<usize>> {
    let mut tied = vec![false; nodes];
    let mut cycles = Vec::new();
    for start in 0..nodes {
        if tied[start] {
            continue;
        }
        let Some(cycle) = shortest_cycle(nodes, edges, start) else { continue };
        let onwards = reached(nodes, edges, start, |(a, b)| (a, b));
        let backwards = reached(nodes, edges, start, |(a, b)| (b, a));
        for node in 0..nodes {
            tied[node] |= onwards[node] && backwards[node];
        }
        cycles.push(cycle);
    }
    cycles
}

/// By breadth-first search from a node back to itself.
fn shortest_cycle(nodes: usize, edges: &[(usize, usize)], start: usize) -> Option<Vec<usize>> {
    let mut from = vec![None; nodes];
    let mut queue = std::collections::VecDeque::from([start]);
    while let Some(node) = queue.pop_front() {
        for &(_, next) in edges.iter().filter(|e| e.0 == node && e.1 != node) {
            if next == start {
                let step = |&n: &usize| if n == start { None } else { from[n] };
                let mut cycle: Vec<usize> = std::iter::successors(Some(node), step).collect();
                cycle.reverse();
                return Some(cycle);
            }
            if from[next].is_none() {
                from[next] = Some(node);
                queue.push_back(next);
            }
        }
    }
    None
}

fn reached(
    nodes: usize,
    edges: &[(usize, usize)],
    start: usize,
    turn: impl Fn((usize, usize)) -> (usize, usize),
) -> Vec<bool> {
    let mut seen = vec![false; nodes];
    let mut open = vec![start];
    while let Some(node) = open.pop() {
        if !std::mem::replace(&mut seen[node], true) {
            open.extend(edges.iter().map(|&e| turn(e)).filter(|e| e.0 == node).map(|e| e.1));
        }
    }
    seen
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_cycle_a_knot() {
        for (edges, expected) in [
            (vec![], vec![]),
            (vec![(0, 1), (1, 2)], vec![]),
            (vec![(0, 0)], vec![]),
            (vec![(0, 1), (1, 0)], vec![vec![0, 1]]),
            (vec![(0, 1), (1, 2), (2, 0), (1, 0)], vec![vec![0, 1]]),
            (vec![(0, 1), (1, 0), (2, 3), (3, 2), (1, 2)], vec![vec![0, 1], vec![2, 3]]),
        ] {
            assert_eq!(cycle_of_each_knot(4, &edges), expected, "{edges:?}");
        }
    }
}
