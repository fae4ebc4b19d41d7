//! Normals in two bytes.

/// An octahedral normal (Meyer et al. 2010, "On floating-point normal vectors"; Cigolle et al. 2014): two bytes.
pub(super) fn octahedral(normal: [f64; 3]) -> [i8; 2] {
    let sum: f64 = normal.iter().map(|c| c.abs()).sum();
    if sum == 0.0 || !sum.is_finite() {
        return [0, 0];
    }
    let [x, y, z] = normal.map(|c| c / sum);
    let signed = |value: f64, like: f64| if like >= 0.0 { value } else { -value };
    let [u, v] =
        if z >= 0.0 { [x, y] } else { [signed(1.0 - y.abs(), x), signed(1.0 - x.abs(), y)] };
    [u, v].map(|c| libm::round(c * 127.0) as i8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_come_back() {
        for normal in [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.6, -0.8, 0.0], [-0.48, 0.6, -0.64]] {
            let [u, v] = octahedral(normal).map(|c| f64::from(c) / 127.0);
            let z = 1.0 - u.abs() - v.abs();
            let fold = (-z).max(0.0);
            let back = [u, v].map(|c| c - c.signum() * fold);
            let length = (back[0] * back[0] + back[1] * back[1] + z * z).sqrt();
            let cos = (back[0] * normal[0] + back[1] * normal[1] + z * normal[2]) / length;
            // A step is a 127th: a degree.
            assert!(cos > 0.9998, "{normal:?}: {cos}");
        }
    }
}
