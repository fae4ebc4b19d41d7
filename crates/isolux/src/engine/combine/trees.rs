//! Bisection trees over the same triangles: their shared nodes, and the places of their vertices.

use crate::elements::{Elements, PlaceOnSide, Split, Subdivision};
use crate::scene::Scene;

/// Visits the nodes that two trees share. If a node is split at different edges (two of them are equally
/// long), no nodes below it are shared.
pub(crate) fn walk_both(a: &Elements, b: &Elements, visit: &mut impl FnMut(u32, u32)) {
    let roots = a.roots().iter().flatten().zip(b.roots().iter().flatten());
    let mut open: Vec<(u32, u32)> = roots.filter_map(|(&a, &b)| a.zip(b)).collect();
    while let Some((of_a, of_b)) = open.pop() {
        visit(of_a, of_b);
        let splits = a.node(of_a).split.zip(b.node(of_b).split);
        if let Some((a, b)) = splits.filter(|(a, b)| a.edge == b.edge) {
            open.push((a.first_child, b.first_child));
            open.push((a.first_child + 1, b.first_child + 1));
        }
    }
}

/// The vertex of a part, if any, at each vertex of elements that refine the part.
pub(crate) fn own_vertices(united: &Elements, part: &Elements) -> Vec<Option<u32>> {
    let mut own = vec![None; united.vertices().len()];
    walk_both(united, part, &mut |node, of_part| {
        let (here, there) = (united.node(node).vertices, part.node(of_part).vertices);
        for (vertex, of_part) in here.into_iter().zip(there) {
            own[vertex as usize] = Some(of_part);
        }
    });
    own
}

/// A place on a side of a triangle for every vertex.
pub(crate) fn places_of_vertices(elements: &Elements) -> Vec<PlaceOnSide> {
    let none = PlaceOnSide { triangle: 0, back: false, uv: [0.0; 2] };
    let mut places = vec![none; elements.vertices().len()];
    for (triangle, sides) in elements.roots().iter().enumerate() {
        for (root, back) in sides.iter().zip([false, true]) {
            let Some(root) = *root else { continue };
            let mut open = vec![(root, [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])];
            while let Some((node, corners)) = open.pop() {
                let node = elements.node(node);
                for (vertex, uv) in node.vertices.into_iter().zip(corners) {
                    places[vertex as usize] = PlaceOnSide { triangle: triangle as u32, back, uv };
                }
                let Some(Split { edge, first_child }) = node.split else { continue };
                let (a, b) = (usize::from(edge), (usize::from(edge) + 1) % 3);
                let middle = [0, 1].map(|k| 0.5 * (corners[a][k] + corners[b][k]));
                let (mut first, mut second) = (corners, corners);
                first[b] = middle;
                second[a] = middle;
                open.push((first_child, first));
                open.push((first_child + 1, second));
            }
        }
    }
    places
}

/// The triangles of a scene, bisected wherever one of the parts is bisected at a node that counts.
pub(crate) fn bisected_like(scene: &Scene, parts: &[(&Elements, Vec<bool>)]) -> Subdivision {
    let mut subdivision = Subdivision::new(scene);
    loop {
        let so_far = subdivision.elements();
        let mut finer: Vec<u32> = Vec::new();
        for (part, counts) in parts {
            walk_both(&so_far, part, &mut |node, of_part| {
                let is_split = part.node(of_part).split.is_some();
                if counts[of_part as usize] && is_split && so_far.node(node).split.is_none() {
                    finer.push(node);
                }
            });
        }
        if finer.is_empty() {
            return subdivision;
        }
        // Nodes are in their own order, whatever the order of parts.
        finer.sort_unstable();
        finer.iter().for_each(|&node| subdivision.bisect(node));
    }
}
