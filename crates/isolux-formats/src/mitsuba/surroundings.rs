//! Light that comes from everywhere alike, `constant`: a luminous box around the scene gives exactly
//! the same at every place within it, whatever its size, because luminance does not fall with distance.

use isolux::scene::{Finish, LuminaireKind, Material, SceneParts, Shape};
use isolux::units::Rgb;

/// How far its faces stay away, in sizes of the scene: the nearer, the less of their light is lost
/// to luminaires chosen by flux.
const MARGIN: f64 = 0.01;
const NAME: &str = "constant emitter";

/// Puts the box around all surfaces, luminaires and cameras.
pub(super) fn add(parts: &mut SceneParts, luminance_cd_m2: Rgb) {
    let eyes = parts.cameras.iter().map(|camera| <[f64; 3]>::from(camera.position));
    let lamps = parts.luminaires.iter().filter_map(|luminaire| match luminaire.kind {
        LuminaireKind::Point { position, .. } => Some(<[f64; 3]>::from(position)),
        LuminaireKind::Directional { .. } => None,
    });
    let surfaces = parts.shapes.iter().flat_map(|shape| shape.positions.iter().copied());
    let places = surfaces.chain(eyes).chain(lamps);
    let (mut low, mut high) = ([f64::MAX; 3], [f64::MIN; 3]);
    for place in places {
        for axis in 0..3 {
            low[axis] = low[axis].min(place[axis]);
            high[axis] = high[axis].max(place[axis]);
        }
    }
    let size = (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
    // Nothing, or places that the scene will refuse.
    if !(size > 0.0 && size.is_finite()) {
        return;
    }
    let corner = |k: usize| {
        std::array::from_fn(|axis| {
            if k >> axis & 1 == 1 { high[axis] + MARGIN * size } else { low[axis] - MARGIN * size }
        })
    };
    // Seen from within, corners turn counter-clockwise.
    let faces: [[u32; 4]; 6] =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let finish = Finish { luminance_cd_m2, ..Finish::BLACK };
    parts.shapes.push(Shape {
        name: NAME.into(),
        positions: (0..8).map(corner).collect(),
        triangles: faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect(),
        material: parts.materials.len() as u32,
        ..Shape::default()
    });
    parts.materials.push(Material::one_sided(NAME, finish));
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::geometry::Vector;

    #[test]
    fn the_box_faces_inwards() {
        let mut parts = SceneParts::default();
        let positions = vec![[1.0, 2.0, 3.0], [2.0, 4.0, 3.5]];
        parts.shapes.push(Shape { positions, ..Shape::default() });
        add(&mut parts, Rgb::WHITE);
        let shape = &parts.shapes[1];
        assert_eq!(
            (shape.positions[0], shape.positions[7]),
            ([0.98, 1.98, 2.98], [2.02, 4.02, 3.52])
        );
        let middle = Vector::new(1.5, 3.0, 3.25);
        for t in &shape.triangles {
            let [a, b, c] = t.map(|k| Vector::from(shape.positions[k as usize]));
            assert!((b - a).cross(c - a).dot(middle - a) > 0.0);
        }
        assert_eq!(shape.triangles.len(), 12);
    }
}
