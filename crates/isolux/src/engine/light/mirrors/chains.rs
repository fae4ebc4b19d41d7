//! Chains of planar mirrors for light that does not come from a luminaire.

use super::super::lighting::Lighting;
use super::planar::{MAX_CHAIN_MIRRORS, MAX_CHAINS};
use crate::engine::ray::SurfacePoint;
use crate::units::Rgb;
use isolux_geometry::{Point, Vector};

/// Reflectance of a chain below which it is left to rays.
const LEAST_CHAIN_REFLECTANCE: f64 = 1e-2;

/// Planar mirrors that light meets one after the other; empty for straight light.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Chain {
    /// Indices of the planes, in the order in which the light meets them.
    pub(crate) planes: Vec<u32>,
    /// Product of their reflectances.
    pub(crate) reflectance: Rgb,
}

impl Lighting<'_> {
    /// The chains that form images, the empty one first, and whether there are others.
    pub(crate) fn chains(&self) -> (Vec<Chain>, bool) {
        let mut found = vec![Chain { planes: Vec::new(), reflectance: Rgb::WHITE }];
        // The box of the scene after the reflections of each chain, by its corners.
        let mut boxes = vec![self.corners_of_scene()];
        let mut leaves_some_out = self.mirrors.leaves_some_out;
        let mut next = 0;
        // Breadth first: each longer chain is appended, and extended in turn.
        while next < found.len() {
            let (before, corners) = (found[next].clone(), boxes[next]);
            next += 1;
            for (plane, mirror) in (0..).zip(&self.mirrors.planes) {
                let meets = before.planes.last().is_none_or(|&last| {
                    let from = &self.mirrors.planes[last as usize];
                    last != plane && from.can_light(mirror, self.mirrors.tolerance_m)
                });
                let reflectance = before.reflectance * mirror.reflectance;
                let is_before = |&corner: &Point| mirror.height(corner) > self.mirrors.tolerance_m;
                if !(meets && corners.iter().any(is_before)) {
                    continue;
                }
                let is_short = before.planes.len() < MAX_CHAIN_MIRRORS && found.len() < MAX_CHAINS;
                if is_short && reflectance.max_channel() >= LEAST_CHAIN_REFLECTANCE {
                    let planes = before.planes.iter().copied().chain([plane]).collect();
                    found.push(Chain { planes, reflectance });
                    boxes.push(corners.map(|corner| mirror.image(corner)));
                } else {
                    leaves_some_out = true;
                }
            }
        }
        (found, leaves_some_out)
    }

    fn corners_of_scene(&self) -> [Point; 8] {
        let bounds = self.scene.bvh().mesh().bounds();
        let (low, high) = bounds.unwrap_or((Point::ORIGIN, Point::ORIGIN));
        let pick =
            |bit: usize, k: usize, low: f64, high: f64| if k & bit == 0 { low } else { high };
        std::array::from_fn(|k| {
            let (x, y) = (pick(1, k, low.x, high.x), pick(2, k, low.y, high.y));
            Point::new(x, y, pick(4, k, low.z, high.z))
        })
    }

    /// Position and normal of a receiver's image by a chain: without mirrors, the image sees what the
    /// receiver sees by the chain. `None` where the receiver is behind a mirror of the chain.
    pub(crate) fn image_of_receiver(
        &self,
        chain: &Chain,
        at: &SurfacePoint,
    ) -> Option<(Point, Vector)> {
        let (mut point, mut normal) = (at.point, at.shading.to_vector());
        for &plane in chain.planes.iter().rev() {
            let mirror = &self.mirrors.planes[plane as usize];
            if mirror.height(point) <= 0.0 {
                return None;
            }
            (point, normal) = (mirror.image(point), mirror.image_vector(normal));
        }
        Some((point, normal))
    }
}
