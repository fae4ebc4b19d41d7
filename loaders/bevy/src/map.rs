//! A map as Bevy has it.

use crate::mix::Levels;
use bevy_asset::Asset;
use bevy_math::{DVec3, Quat, Vec3};
use bevy_reflect::TypePath;

/// What a standard error says where the light is not known.
pub(crate) const UNKNOWN: f32 = -1.0;
/// What it says where the light is known, but not its error.
pub(crate) const NO_ESTIMATE: f32 = -2.0;

/// A scene with lux at the vertices of its elements.
#[derive(Asset, TypePath, Clone, Debug, Default)]
pub struct IlluminationMap {
    /// Groups of luminaires that can be dimmed; none in files without them.
    pub groups: Vec<String>,
    /// What luminances are multiplied by where nothing else is asked for, m2/cd.
    pub exposure_m2_cd: f32,
    /// Turns the axes of the scene as written into those of Bevy, where y is up.
    pub world_from_scene: Quat,
    /// Sides of shapes that carry light.
    pub surfaces: Vec<Surface>,
}

/// One side of a shape. Positions are metres in the axes of the scene as written.
#[derive(Clone, Debug, Default)]
pub struct Surface {
    /// Name of the shape in the scene.
    pub shape: String,
    /// Name of its material.
    pub material: String,
    /// The picture that multiplies its colours, as the bytes of a PNG coded in sRGB.
    pub texture_png: Option<Vec<u8>>,
    /// Places of vertices.
    pub positions: Vec<[f32; 3]>,
    /// Shading normals of this side.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates; none without a texture.
    pub uvs: Vec<[f32; 2]>,
    /// Corners, counter-clockwise.
    pub triangles: Vec<[u32; 3]>,
    /// All light, as in the file.
    pub whole: Light,
    /// The direct part of it, in channels of linear Rec. 709, lx.
    pub direct_lx: Vec<[f32; 3]>,
    /// The light of each group.
    pub groups: Vec<Light>,
    /// How it reflects, and its own luminance, cd/m2; not known of maps that were not exported with lux.
    pub reflection: Option<[[f32; 3]; 2]>,
    /// Finished colours, which are shown where that is not known.
    pub colours: Vec<[f32; 4]>,
}

/// Light at vertices.
#[derive(Clone, Debug, Default)]
pub struct Light {
    /// Illuminance in channels of linear Rec. 709, lx.
    pub rgb_lx: Vec<[f32; 3]>,
    /// Standard error of the photometric value from replicates, lx; -1 where the light is not known, -2 where the error is not.
    pub errors_lx: Vec<f32>,
}

/// What a map says of a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Photometric illuminance, lx.
    pub illuminance_lx: f64,
    /// Its standard error from replicates, lx; `None` if that is not known.
    pub standard_error_lx: Option<f64>,
    /// Its direct part, lx; `None` while groups are dimmed, as it is not known of each.
    pub direct_lx: Option<f64>,
    /// Illuminance in channels of linear Rec. 709, lx.
    pub rgb_lx: [f64; 3],
}

impl IlluminationMap {
    /// What is read where a ray hits a triangle of a surface; `None` where nothing is known. Weights are barycentric, as `RayMeshHit` has them.
    pub fn read(
        &self,
        levels: &Levels,
        (surface, triangle): (usize, usize),
        weights: Vec3,
    ) -> Option<Reading> {
        let surface = self.surfaces.get(surface)?;
        let corners = surface.triangles.get(triangle)?;
        surface.read(&levels.of(&self.groups), corners, weights.as_dvec3().to_array())
    }

    /// What is read at the nearest place whose normal agrees within 60 degrees, and how far away that is, m. Looks at every triangle.
    /// The place is in the axes of the scene as written, m.
    pub fn read_near(
        &self,
        levels: &Levels,
        place: DVec3,
        normal: DVec3,
    ) -> Option<(Reading, f64)> {
        let near = |surface: &Surface, corners: &[u32; 3]| surface.nearest(corners, place, normal);
        let all = self.surfaces.iter().flat_map(|surface| {
            let found = surface.triangles.iter().filter_map(move |c| Some((c, near(surface, c)?)));
            found.map(move |(corners, (weights, distance))| (surface, corners, weights, distance))
        });
        let (surface, corners, weights, distance) = all.min_by(|a, b| a.3.total_cmp(&b.3))?;
        Some((surface.read(&levels.of(&self.groups), corners, weights)?, distance))
    }
}

impl Surface {
    /// The mean of the known corners, by their weights.
    fn read(&self, levels: &[f32], corners: &[u32; 3], weights: [f64; 3]) -> Option<Reading> {
        let known = corners.iter().zip(weights).filter(|(vertex, weight)| {
            *weight > 0.0 && self.whole.errors_lx[**vertex as usize] != UNKNOWN
        });
        let known: Vec<(usize, f64)> = known.map(|(&v, w)| (v as usize, w)).collect();
        let all: f64 = known.iter().map(|(_, weight)| weight).sum();
        if all <= 0.0 {
            return None;
        }
        let mean = |of: &dyn Fn(usize) -> f64| {
            known.iter().map(|&(vertex, weight)| weight * of(vertex)).sum::<f64>() / all
        };
        let rgb_lx =
            [0, 1, 2].map(|channel| mean(&|vertex| f64::from(self.lit(levels, vertex)[channel])));
        let direct_lx =
            [0, 1, 2].map(|channel| mean(&|vertex| f64::from(self.direct_lx[vertex][channel])));
        let errors: Vec<f32> =
            known.iter().map(|&(vertex, _)| self.error(levels, vertex)).collect();
        let has_error = errors.iter().all(|error| *error >= 0.0);
        Some(Reading {
            illuminance_lx: luminance(rgb_lx),
            standard_error_lx: has_error
                .then(|| mean(&|vertex| f64::from(self.error(levels, vertex)))),
            direct_lx: levels.iter().all(|level| *level == 1.0).then(|| luminance(direct_lx)),
            rgb_lx,
        })
    }

    /// Weights of the place of a triangle that is nearest, and its distance; `None` for triangles that face elsewhere.
    fn nearest(&self, corners: &[u32; 3], place: DVec3, normal: DVec3) -> Option<([f64; 3], f64)> {
        let [a, b, c] = corners.map(|k| Vec3::from(self.positions[k as usize]).as_dvec3());
        let along = (b - a).cross(c - a);
        let faces_alike = along.dot(normal) > 0.5 * along.length() * normal.length();
        faces_alike.then(|| nearest_of_triangle([a, b, c], along, place))
    }
}

/// Weights of the point of a triangle that is nearest to a place, and their distance.
fn nearest_of_triangle([a, b, c]: [DVec3; 3], along: DVec3, place: DVec3) -> ([f64; 3], f64) {
    // Barycentric weights of the foot of the perpendicular are ratios of areas.
    let share =
        |p: DVec3, q: DVec3| (p - place).cross(q - place).dot(along) / along.length_squared();
    let inside = [share(b, c), share(c, a), share(a, b)];
    let point = |w: [f64; 3]| a * w[0] + b * w[1] + c * w[2];
    if inside.iter().all(|weight| *weight >= 0.0) {
        return (inside, point(inside).distance(place));
    }
    // Else it is on an edge.
    let edge = |from: DVec3, to: DVec3| {
        let way = to - from;
        ((place - from).dot(way) / way.length_squared()).clamp(0.0, 1.0)
    };
    let [ab, bc, ca] = [edge(a, b), edge(b, c), edge(c, a)];
    let on_edges = [[1.0 - ab, ab, 0.0], [0.0, 1.0 - bc, bc], [ca, 0.0, 1.0 - ca]];
    let far = |w: [f64; 3]| (w, point(w).distance(place));
    let [first, rest @ ..] = on_edges.map(far);
    rest.into_iter().fold(first, |best, next| if next.1 < best.1 { next } else { best })
}

/// The photometric value of channels of linear Rec. 709.
pub(crate) fn luminance([r, g, b]: [f64; 3]) -> f64 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A triangle of 1 m with light of two groups, and a corner that is not known.
    fn map(errors: [f32; 3]) -> IlluminationMap {
        let light = |lx: f32, error: f32| Light {
            rgb_lx: vec![[lx; 3], [2.0 * lx; 3], [4.0 * lx; 3]],
            errors_lx: errors.map(|own| if own < 0.0 { own } else { error }).to_vec(),
        };
        let surface = Surface {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            normals: vec![[0.0, 0.0, 1.0]; 3],
            triangles: vec![[0, 1, 2]],
            whole: light(30.0, 5.0),
            direct_lx: vec![[1.0; 3]; 3],
            groups: vec![light(10.0, 3.0), light(20.0, 4.0)],
            ..Surface::default()
        };
        let groups = vec!["a".to_owned(), "b".to_owned()];
        IlluminationMap { groups, surfaces: vec![surface], ..IlluminationMap::default() }
    }

    fn read(map: &IlluminationMap, levels: &Levels, place: [f64; 3]) -> Option<(Reading, f64)> {
        map.read_near(levels, DVec3::from(place), DVec3::Z)
    }

    #[test]
    fn light_is_linear_between_vertices_and_in_levels() {
        let (map, mut levels) = (map([0.0; 3]), Levels::default());
        let (reading, distance) = read(&map, &levels, [0.25, 0.25, 0.5]).unwrap();
        // Weights 1/2, 1/4, 1/4 of 30, 60 and 120 lx; sums of few small numbers, in 64 bits but for the inputs.
        assert!((reading.illuminance_lx - 60.0).abs() < 1e-5, "{reading:?}");
        assert_eq!((reading.standard_error_lx, distance), (Some(5.0), 0.5));
        assert!((reading.direct_lx.unwrap() - 1.0).abs() < 1e-9);
        levels.set("a", 0.5);
        let (reading, _) = read(&map, &levels, [0.0; 3]).unwrap();
        assert!((reading.illuminance_lx - 25.0).abs() < 1e-5, "{reading:?}");
        let error = reading.standard_error_lx.unwrap();
        assert!((error - f64::hypot(1.5, 4.0)).abs() < 1e-6, "{error}");
        assert_eq!(reading.direct_lx, None);
        assert_eq!(map.read(&levels, (0, 0), Vec3::X), Some(reading));
    }

    #[test]
    fn unknown_corners_are_left_out_and_unknown_errors_told() {
        let levels = Levels::default();
        let (reading, _) = read(&map([UNKNOWN, 0.0, 0.0]), &levels, [0.5, 0.25, 0.0]).unwrap();
        assert!((reading.illuminance_lx - (60.0 * 2.0 + 120.0) / 3.0).abs() < 1e-4, "{reading:?}");
        assert!(read(&map([UNKNOWN; 3]), &levels, [0.5, 0.25, 0.0]).is_none());
        let (reading, _) = read(&map([NO_ESTIMATE, 0.0, 0.0]), &levels, [0.1, 0.1, 0.0]).unwrap();
        assert_eq!(reading.standard_error_lx, None);
    }

    #[test]
    fn the_nearest_place_is_found_on_edges_and_corners() {
        let levels = Levels::default();
        let map = map([0.0; 3]);
        for (place, lx, distance) in [
            ([-1.0, 0.0, 0.0], 30.0, 1.0),
            ([0.5, -2.0, 0.0], 45.0, 2.0),
            ([1.0, 1.0, 0.0], 90.0, 0.5_f64.sqrt()),
            ([3.0, 0.0, 0.0], 60.0, 2.0),
        ] {
            let (reading, found) = read(&map, &levels, place).unwrap();
            assert!((reading.illuminance_lx - lx).abs() < 1e-4, "{place:?}: {reading:?}");
            assert!((found - distance).abs() < 1e-9, "{place:?}: {found}");
        }
        assert!(map.read_near(&levels, DVec3::ZERO, -DVec3::Z).is_none());
        assert!(map.read(&levels, (0, 1), Vec3::X).is_none());
        assert!(map.read(&levels, (1, 0), Vec3::X).is_none());
    }
}
