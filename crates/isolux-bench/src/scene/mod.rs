//! The scenes: rooms that stay the same from run to run.

mod hall;
mod office;
mod solids;

use isolux_compare::hall::Variant;
use isolux_geometry::TriangleMesh;
use solids::Fronts;

/// A room and the name it goes by.
pub(crate) struct Scene {
    pub(crate) name: &'static str,
    pub(crate) mesh: TriangleMesh,
}

/// All scenes: 12, 10,000 and 1,000,000 triangles in closed rooms, and the practical scene.
pub(crate) fn all() -> [fn() -> Scene; 7] {
    let [cube, office, hall, fine_office, fine_hall] = CLOSED;
    [cube, office, hall, practical, fine_office, fine_hall, fine_practical]
}

/// Rooms that no ray can leave.
const CLOSED: [fn() -> Scene; 5] = [cube, office, hall, fine_office, fine_hall];

/// The scene `builtin:hall`, without its luminaires.
fn practical() -> Scene {
    Scene { name: "builtin:hall", mesh: surfaces_of(Variant::STANDARD) }
}

/// The same surfaces divided into a hundred times as many triangles.
fn fine_practical() -> Scene {
    let fine = Variant { triangles: 1_000_000, ..Variant::STANDARD };
    Scene { name: "builtin:hall,triangles=1e6", mesh: surfaces_of(fine) }
}

fn surfaces_of(variant: Variant) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    for shape in isolux_compare::hall::parts(variant).shapes {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(shape.positions.iter().map(|p| p.map(|x| x as f32)));
        mesh.triangles.extend(shape.triangles.iter().map(|t| t.map(|k| k + first)));
    }
    mesh
}

/// A room of 10 m seen from inside.
fn cube() -> Scene {
    let mut mesh = TriangleMesh::default();
    solids::add_box(&mut mesh, [1; 3], Fronts::Inside, |unit| unit.map(|x| 10.0 * x - 5.0));
    Scene { name: "cube", mesh }
}

fn office() -> Scene {
    Scene { name: "office", mesh: office::furnished(&office::COARSE) }
}

fn fine_office() -> Scene {
    Scene { name: "fine office", mesh: office::furnished(&office::FINE) }
}

fn hall() -> Scene {
    Scene { name: "hall", mesh: hall::furnished(10_000, &hall::COARSE) }
}

fn fine_hall() -> Scene {
    Scene { name: "fine hall", mesh: hall::furnished(1_000_000, &hall::FINE) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashMap;

    /// Edges in their direction, less those in the opposite one.
    fn open_edges(mesh: &TriangleMesh) -> usize {
        let mut balance = HashMap::new();
        for [a, b, c] in &mesh.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                *balance.entry((from.min(to), from.max(to))).or_insert(0) +=
                    (from > to) as i32 * 2 - 1;
            }
        }
        balance.values().filter(|&&sum| sum != 0).count()
    }

    #[test]
    fn scenes_are_closed_deterministic_and_of_their_size() {
        for (make, triangles) in CLOSED.into_iter().zip([12, 10_008, 10_000, 1_023_716, 1_000_000])
        {
            let scene = make();
            assert_eq!(scene.mesh.len(), triangles, "{}", scene.name);
            assert_eq!(open_edges(&scene.mesh), 0, "{}", scene.name);
            assert_eq!(scene.mesh, make().mesh, "{}", scene.name);
        }
    }

    /// What touches or crosses the shell could let a ray start outside.
    #[test]
    fn the_furniture_stands_inside_the_shell() {
        for make in CLOSED {
            let mesh = make().mesh;
            let (low, high) = mesh.bounds().unwrap();
            let on_shell = |p: [f32; 3]| {
                (0..3).any(|k| {
                    f64::from(p[k]) == low.to_vector().component(k)
                        || f64::from(p[k]) == high.to_vector().component(k)
                })
            };
            let shell = mesh.positions.iter().take_while(|p| on_shell(**p)).count();
            assert!(shell >= 8);
            assert!(!mesh.positions[shell..].iter().any(|p| on_shell(*p)));
        }
    }
}
