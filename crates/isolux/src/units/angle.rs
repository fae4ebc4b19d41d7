//! Angles in degrees.

/// The sine and cosine of an angle in degrees, exact at quarter turns.
pub fn sincos_deg(angle_deg: f64) -> (f64, f64) {
    let turned = angle_deg % 360.0;
    let quarters = turned / 90.0;
    if quarters == quarters.trunc() {
        return match quarters as i32 {
            0 => (0.0, 1.0),
            1 | -3 => (1.0, 0.0),
            2 | -2 => (0.0, -1.0),
            _ => (-1.0, 0.0),
        };
    }
    libm::sincos(turned.to_radians())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sines_of_quarter_turns() {
        for (deg, expected) in [
            (0.0, (0.0, 1.0)),
            (90.0, (1.0, 0.0)),
            (180.0, (0.0, -1.0)),
            (270.0, (-1.0, 0.0)),
            (-90.0, (-1.0, 0.0)),
            (-270.0, (1.0, 0.0)),
            (720.0, (0.0, 1.0)),
            (450.0, (1.0, 0.0)),
        ] {
            assert_eq!(sincos_deg(deg), expected, "{deg}");
        }
        assert!((sincos_deg(30.0).0 - 0.5).abs() < 1e-15);
    }
}
