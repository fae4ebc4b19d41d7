//! Subdivision against what it promises.

mod arrays;
mod conformity;
mod places;
mod sides;

use super::{Elements, Subdivision};
use crate::sampling::Key;
use crate::scene::{Finish, Material, Scene, SceneParts, Shape};
use crate::units::Rgb;

fn grey() -> Material {
    Material::one_sided("grey", Finish::diffuse(Rgb::grey(0.5)))
}

fn scene(shapes: Vec<Shape>, materials: Vec<Material>) -> Scene {
    Scene::assemble(SceneParts { shapes, materials, ..SceneParts::default() }).unwrap()
}

/// Triangles over positions, of material 0.
fn mesh(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Shape {
    Shape {
        name: "mesh".into(),
        positions: positions.to_vec(),
        triangles: triangles.to_vec(),
        ..Shape::default()
    }
}

fn square() -> Shape {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    mesh(&corners, &[[0, 1, 2], [0, 2, 3]])
}

/// A cube of edge 2 about the origin, fronts outside, all eight corners shared.
fn cube() -> Shape {
    let corner = |k: u32| [0, 1, 2].map(|axis| if k >> axis & 1 == 1 { 1.0 } else { -1.0 });
    let corners: Vec<[f64; 3]> = (0..8).map(corner).collect();
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let halves = |[a, b, c, d]: [u32; 4]| [[a, b, c], [a, c, d]];
    mesh(&corners, &faces.map(halves).concat())
}

/// The cube with normals from its middle, so that no edge is a crease.
fn smooth_cube() -> Shape {
    let shape = cube();
    Shape { normals: Some(shape.positions.clone()), ..shape }
}

/// An uneven plane patch: a grid whose inner points are moved about.
fn uneven_patch(cells: u32) -> Shape {
    let key = Key::new(11);
    let at = |i: u32, j: u32| {
        let inner = i > 0 && j > 0 && i < cells && j < cells;
        let shift = |n: u64| {
            let moved = 0.8 * (key.with(u64::from(i)).with(u64::from(j)).with(n).uniform() - 0.5);
            if inner { moved } else { 0.0 }
        };
        [f64::from(i) + shift(0), f64::from(j) + shift(1), 0.0]
    };
    let positions: Vec<[f64; 3]> =
        (0..=cells).flat_map(|j| (0..=cells).map(move |i| at(i, j))).collect();
    let corner = |i: u32, j: u32| j * (cells + 1) + i;
    let halves = |i: u32, j: u32| {
        let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    let triangles: Vec<[u32; 3]> =
        (0..cells).flat_map(|j| (0..cells).flat_map(move |i| halves(i, j))).collect();
    mesh(&positions, &triangles)
}

/// Bisects elements drawn at random.
fn bisect_at_random(subdivision: &mut Subdivision, seed: u64, times: u64) {
    for k in 0..times {
        let leaves: Vec<u32> = subdivision.leaves().collect();
        let drawn = (Key::new(seed).with(k).uniform() * leaves.len() as f64) as usize;
        subdivision.bisect(leaves[drawn]);
    }
}

/// Every kind of surface, subdivided at random.
fn every_kind() -> Vec<(&'static str, Scene, Subdivision)> {
    let two_sided = Material::two_sided("grey", Finish::diffuse(Rgb::grey(0.5)));
    let three_on_an_edge = mesh(
        &[[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.4, 0.0], [-1.0, 0.4, 0.0], [-1.2, 0.7, 0.0]],
        &[[0, 2, 1], [0, 1, 3], [0, 1, 4]],
    );
    let sliver = mesh(
        &[[0.0; 3], [1.0, 0.0, 0.0], [0.4, 1e-5, 0.0], [0.6, -1.0, 0.0]],
        &[[0, 1, 2], [0, 3, 1]],
    );
    let twice = mesh(&square().positions, &[[0, 1, 2], [0, 2, 3], [0, 1, 2], [0, 2, 3]]);
    [
        ("square", square(), grey()),
        ("cube", cube(), grey()),
        ("cube without creases", smooth_cube(), grey()),
        ("uneven patch", uneven_patch(4), grey()),
        ("thin sheet", square(), two_sided),
        ("three triangles on an edge", three_on_an_edge, grey()),
        ("coincident triangles", twice, grey()),
        ("sliver and neighbour", sliver, grey()),
    ]
    .into_iter()
    .map(|(name, shape, material)| {
        let scene = scene(vec![shape], vec![material]);
        let mut subdivision = Subdivision::new(&scene);
        bisect_at_random(&mut subdivision, 3, 150);
        (name, scene, subdivision)
    })
    .collect()
}

/// Surface of the elements, m2.
fn area_m2(elements: &Elements) -> f64 {
    let at = |v: u32| elements.vertices()[v as usize].position;
    let area = |e: super::Element| isolux_geometry::Triangle { corners: e.vertices.map(at) }.area();
    elements.elements().into_iter().map(area).sum()
}
