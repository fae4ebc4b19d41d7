//! What an affine map does to a luminaire.

use isolux::geometry::{Transform, Vector};

/// The rotation (or reflection) in an affine map, without its scale: its axes made orthonormal in
/// order. `None` for a singular map.
pub(super) fn without_scale(map: &Transform) -> Option<Transform> {
    let [a, b, _] = map.columns;
    let x = a.direction()?;
    let y = (b - x * b.dot(x.to_vector())).direction()?;
    let z = x.to_vector().cross(y.to_vector()) * 1.0_f64.copysign(map.determinant());
    Some(Transform { columns: [x.to_vector(), y.to_vector(), z], translation: Vector::ZERO })
}

/// What a matrix written in four decimals may be off a turn.
const ROUNDED: f64 = 1e-3;

/// Whether a map is more than a turn, a mirror image and a scale, the same for all axes.
pub(super) fn is_distorting(map: &Transform) -> bool {
    let [a, b, c] = map.columns;
    let scale = a.dot(a).max(b.dot(b)).max(c.dot(c));
    let uneven = [a, b, c].iter().any(|v| (v.dot(*v) / scale - 1.0).abs() > ROUNDED);
    let oblique = [a.dot(b), b.dot(c), c.dot(a)].iter().any(|d| d.abs() > ROUNDED * scale);
    uneven || oblique
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::scene::{UpAxis, world_from_luminaire};

    #[test]
    fn scale_is_taken_out() {
        let aim = Vector::new(1.0, 2.0, 3.0).direction().unwrap();
        let turn = world_from_luminaire(UpAxis::Z, aim, 20.0);
        let scaled = turn.then_from(&Transform::scale(2.0, 3.0, -4.0));
        let rigid = without_scale(&scaled).unwrap();
        assert!((rigid.determinant() + 1.0).abs() < 1e-14);
        assert!((rigid.columns[0] - turn.columns[0]).length() < 1e-14);
        assert_eq!(without_scale(&Transform::scale(0.0, 1.0, 1.0)), None);
        assert!(is_distorting(&scaled) && !is_distorting(&turn));
        assert!(!is_distorting(&Transform::scale(-2.0, 2.0, 2.0).then_from(&turn)));
    }
}
