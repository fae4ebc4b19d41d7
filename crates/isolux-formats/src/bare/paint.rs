//! Colours of vertices as a texture: a pixel for every colour that a triangle has.

use crate::srgb::{code, linear};
use isolux::scene::Texture;
use std::collections::HashMap;

/// More colours than this are not kept apart: as many as the largest picture has pixels.
const MOST_COLOURS: usize = 16 << 20;

/// Colours of triangles, and their vertices, which belong to one colour each.
#[derive(Default)]
pub(crate) struct Painter {
    colours: Vec<[u8; 3]>,
    colour_of: HashMap<[u8; 3], u32>,
    vertices: Vec<(u32, u32)>,
    vertex_of: HashMap<(u32, u32), u32>,
}

impl Painter {
    /// The vertices of a triangle painted in the mean of its corners' sRGB colours; `None` where
    /// there are too many colours.
    pub(crate) fn triangle(
        &mut self,
        corners: [u32; 3],
        colours: [[u8; 3]; 3],
    ) -> Option<[u32; 3]> {
        let mean = std::array::from_fn(|channel| {
            let sum: f64 = colours.iter().map(|c| linear(f64::from(c[channel]) / 255.0)).sum();
            code(sum / 3.0)
        });
        let next = self.colours.len() as u32;
        let colour = *self.colour_of.entry(mean).or_insert(next);
        if colour == next {
            if self.colours.len() == MOST_COLOURS {
                return None;
            }
            self.colours.push(mean);
        }
        Some(corners.map(|corner| {
            *self.vertex_of.entry((corner, colour)).or_insert_with(|| {
                self.vertices.push((corner, colour));
                self.vertices.len() as u32 - 1
            })
        }))
    }

    /// For every vertex the corner it was made of and its texture coordinates, and the texture.
    pub(crate) fn finish(self) -> (Vec<u32>, Vec<[f64; 2]>, Texture) {
        let width = (self.colours.len() as f64).sqrt().ceil().max(1.0) as u32;
        let height = (self.colours.len() as u32).div_ceil(width).max(1);
        let mut srgb = self.colours.concat();
        srgb.resize(3 * width as usize * height as usize, 0);
        let middle = |k: u32, count: u32| (f64::from(k) + 0.5) / f64::from(count);
        let uv = |colour: u32| [middle(colour % width, width), middle(colour / width, height)];
        let uvs = self.vertices.iter().map(|&(_, colour)| uv(colour)).collect();
        let corners = self.vertices.iter().map(|&(corner, _)| corner).collect();
        (corners, uvs, Texture { width, height, srgb })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_vertex_sees_its_colour_alone() {
        let mut painter = Painter::default();
        let colours: Vec<[u8; 3]> = (0..7).map(|k| [30 * k, 255 - k, 7 * k]).collect();
        for (k, &colour) in (0..).zip(&colours) {
            assert_eq!(
                painter.triangle([0, 1, 2], [colour; 3]),
                Some([0, 1, 2].map(|c| 3 * k + c))
            );
        }
        assert_eq!(painter.triangle([2, 1, 0], [colours[0]; 3]), Some([2, 1, 0]));
        let (corners, uvs, texture) = painter.finish();
        assert_eq!((corners.len(), texture.width, texture.height), (21, 3, 3));
        for (k, uv) in uvs.iter().enumerate() {
            let seen = texture.value(uv[0], uv[1]).0.map(code);
            assert_eq!(seen, colours[k / 3], "{k}");
        }
    }
}
