//! The mean of a picture over the triangles that show it.

use isolux::geometry::{Point, Triangle};
use isolux::scene::Texture;
use isolux::units::Rgb;

/// Places at which the triangles of a primitive are looked at, in all; and of one triangle, along a side of it.
const MOST_PLACES: f64 = 4e6;
const FEWEST_OF_SIDE: f64 = 64.0;
const MOST_OF_SIDE: f64 = 256.0;
/// The same of a pixel.
const OF_PIXEL: f64 = 4.0;

/// Pictures that differ by less than this share of their mean are of one colour, as compression leaves it.
const EVEN: f64 = 0.05;

/// What is seen of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shown {
    /// Linear light.
    pub(super) mean: Rgb,
    /// Whether it is the same all over.
    pub(super) is_even: bool,
}

/// Of a picture on triangles, by area, every pixel a square; of triangles without area, their plain mean.
pub(super) fn shown(
    picture: &Texture,
    positions: &[[f64; 3]],
    uvs: &[[f64; 2]],
    triangles: &[[u32; 3]],
) -> Shown {
    let most = (MOST_PLACES / triangles.len().max(1) as f64).sqrt().clamp(1.0, MOST_OF_SIDE);
    let (mut sum, mut area) = (Rgb::BLACK, 0.0);
    let (mut plain, mut low, mut high) = (Rgb::BLACK, Rgb::grey(1.0), Rgb::BLACK);
    for corners in triangles {
        let corners = corners.map(|v| v as usize);
        let weight = Triangle { corners: corners.map(|v| Point::from(positions[v])) }.area();
        let corners = corners.map(|v| uvs[v]);
        let side = OF_PIXEL * longest_side(picture, corners);
        let side = side.max(FEWEST_OF_SIDE).min(most) as u32;
        let places = places(side);
        let mut own = Rgb::BLACK;
        for &[b, c] in &places {
            let colour = pixel(picture, corners, [b, c]);
            own += colour;
            low = Rgb(std::array::from_fn(|k| low.0[k].min(colour.0[k])));
            high = Rgb(std::array::from_fn(|k| high.0[k].max(colour.0[k])));
        }
        let own = own / places.len() as f64;
        (sum, area, plain) = (sum + own * weight, area + weight, plain + own);
    }
    let mean = if area > 0.0 { sum / area } else { plain / triangles.len().max(1) as f64 };
    let is_even = (high - low).max_channel() <= EVEN * mean.max_channel();
    Shown { mean, is_even }
}

/// Longest side of a triangle, pixels.
fn longest_side(picture: &Texture, corners: [[f64; 2]; 3]) -> f64 {
    let pixels = [f64::from(picture.width), f64::from(picture.height)];
    let side = |k: usize| {
        let [from, to] = [corners[k], corners[(k + 1) % 3]];
        libm::hypot((to[0] - from[0]) * pixels[0], (to[1] - from[1]) * pixels[1])
    };
    side(0).max(side(1)).max(side(2))
}

/// The middles of the equal triangles that one is cut into, so many along a side: weights of its second and
/// third corner.
fn places(side: u32) -> Vec<[f64; 2]> {
    let at = |k: u32, third: f64| (f64::from(k) + third / 3.0) / f64::from(side);
    let rows = (0..side).flat_map(|b| (0..side - b).map(move |c| [b, c]));
    rows.flat_map(|[b, c]| {
        let upright = [at(b, 1.0), at(c, 1.0)];
        let turned = (b + c + 1 < side).then(|| [at(b, 2.0), at(c, 2.0)]);
        [Some(upright), turned].into_iter().flatten()
    })
    .collect()
}

/// The pixel at a place, the picture repeating.
fn pixel(picture: &Texture, corners: [[f64; 2]; 3], [b, c]: [f64; 2]) -> Rgb {
    let at = |k: usize| corners[0][k] * (1.0 - b - c) + corners[1][k] * b + corners[2][k] * c;
    let middle = |x: f64, pixels: u32| ((x * f64::from(pixels)).floor() + 0.5) / f64::from(pixels);
    picture.value(middle(at(0), picture.width), middle(at(1), picture.height))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two by two pixels: white, black; black, grey.
    fn picture() -> Texture {
        let codes = [255, 0, 0, 188].map(|code| [code; 3]);
        Texture { width: 2, height: 2, srgb: codes.concat() }
    }

    fn check(uvs: [[f64; 2]; 4], expected: f64, is_even: bool) {
        let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let found = shown(&picture(), &positions, &uvs, &[[0, 1, 2], [0, 2, 3]]);
        // Triangles of 256 places a side against squares, and the code of grey for one half.
        assert!((found.mean.0[0] - expected).abs() < 0.01, "{uvs:?}: {found:?}");
        assert_eq!(found.is_even, is_even, "{uvs:?}: {found:?}");
    }

    #[test]
    fn only_what_is_shown_counts() {
        let square = |[u, v]: [f64; 2], side: f64| {
            [[u, v], [u + side, v], [u + side, v + side], [u, v + side]]
        };
        check(square([0.0, 0.0], 0.5), 1.0, true);
        check(square([0.5, 0.5], 0.5), 0.5, true);
        check(square([3.5, -1.0], 0.5), 0.0, true);
        check(square([0.0, 0.0], 1.0), 0.375, false);
        check(square([0.1, 0.1], 0.0), 1.0, true);
    }
}
