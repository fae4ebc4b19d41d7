//! Corners in the order of the file to triangles (glTF 2.0, section 3.7.2.1).

use super::notes::Flaw;
use gltf_json::mesh::Mode;

/// How many triangles so many corners make; `None` for points and lines.
pub(super) fn triangle_count(mode: Mode, corners: usize) -> Option<usize> {
    match mode {
        Mode::Triangles => Some(corners / 3),
        Mode::TriangleStrip | Mode::TriangleFan => Some(corners.saturating_sub(2)),
        Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => None,
    }
}

/// The triangles, each corner found to name one of `vertices`.
pub(super) fn triangles(
    mode: Mode,
    corners: &[u32],
    vertices: usize,
) -> Result<Vec<[u32; 3]>, Flaw> {
    if let Some(at) = corners.iter().position(|&corner| corner as usize >= vertices) {
        let what = format!("index {at} names vertex {} of {vertices}", corners[at]);
        return Err(Flaw::new(what, "the file is damaged; export it again"));
    }
    let count = triangle_count(mode, corners.len()).unwrap_or(0);
    let order = |k: usize| match mode {
        Mode::TriangleStrip => [k, k + 1 + k % 2, k + 2 - k % 2],
        Mode::TriangleFan => [k + 1, k + 2, 0],
        _ => [3 * k, 3 * k + 1, 3 * k + 2],
    };
    Ok((0..count).map(|k| order(k).map(|corner| corners[corner])).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_of_corners() {
        let corners = [10, 11, 12, 13, 14];
        let make = |mode| triangles(mode, &corners, 20).unwrap();
        assert_eq!(make(Mode::Triangles), [[10, 11, 12]]);
        assert_eq!(make(Mode::TriangleStrip), [[10, 11, 12], [11, 13, 12], [12, 13, 14]]);
        assert_eq!(make(Mode::TriangleFan), [[11, 12, 10], [12, 13, 10], [13, 14, 10]]);
        assert_eq!(make(Mode::Lines), [[0; 3]; 0]);
        for mode in [Mode::Triangles, Mode::TriangleStrip, Mode::TriangleFan] {
            assert_eq!(triangles(mode, &[0, 1], 2).unwrap(), [[0; 3]; 0]);
            assert_eq!(triangles(mode, &[], 0).unwrap(), [[0; 3]; 0]);
            assert!(triangles(mode, &[0, 1, 2], 2).is_err());
        }
    }
}
