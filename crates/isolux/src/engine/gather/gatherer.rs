//! Gathering: what a receiver sees, as a row of a linear operator over the vertices of the map.
//!
//! From a receiver, cosine-distributed rays are followed to diffuse surfaces. There the direct light
//! is evaluated at once (or read from the map, where luminaires are many), and the indirect light
//! is left open: the ray becomes an entry of a sparse matrix, so that the light of all further
//! reflections is the fixed point of `E = source + A E`, solved without tracing the rays again.

use super::bright_surfaces::BrightSurfaces;
use super::control_variate::{ControlVariate, Stand};
use crate::elements::{Elements, Receiver};
use crate::engine::light::Lighting;
use crate::engine::occlusion::{Barrier, Barriers};
use crate::engine::ray::SurfacePoint;
use crate::map::Standing;
use crate::scene::Scene;
use crate::units::Rgb;
use isolux_geometry::{Normal, Point};

/// A place that gathers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gatherer {
    /// Where rays start.
    pub(crate) origin: Point,
    /// About what they are distributed.
    pub(crate) normal: Normal,
    /// The place for direct light.
    pub(crate) surface: SurfacePoint,
    /// How many rays.
    pub(crate) rays: u32,
    /// Whether it lies in a gap: what its rays meet close by does not lie in the open.
    pub(crate) in_gap: bool,
    /// What it gets from the [`ControlVariate`] with nothing between, lx, if rays are judged by that.
    pub(crate) behind: Option<Rgb>,
}

impl Gatherer {
    /// The receiver of a vertex. Its normal is that of the smooth surface, whose facets meet at it.
    pub(crate) fn at_vertex(scene: &Scene, receiver: &Receiver, rays: u32) -> Self {
        let Receiver { point, normal, triangle, back } = *receiver;
        let flat = SurfacePoint::new(scene, triangle, back, 0.0, 0.0);
        let surface = SurfacePoint { point, shading: normal, geometric: normal, ..flat };
        let origin = SurfacePoint { point, ..flat }.start();
        Self { origin, normal, surface, rays, in_gap: false, behind: None }
    }

    /// The same, in a gap or not.
    pub(crate) const fn in_gap(self, in_gap: bool) -> Self {
        Self { in_gap, ..self }
    }

    /// The same with another number of rays.
    pub(crate) const fn with_rays(self, rays: u32) -> Self {
        Self { rays, ..self }
    }

    /// A place inside a triangle.
    pub(crate) fn on_surface(surface: SurfacePoint, rays: u32) -> Self {
        Self {
            origin: surface.start(),
            normal: surface.shading,
            surface,
            rays,
            in_gap: false,
            behind: None,
        }
    }

    /// Where its rays start, and how.
    pub(crate) const fn stand(&self) -> Stand {
        Stand { origin: self.origin, normal: self.normal, triangle: self.surface.triangle }
    }

    /// Whether it lies where another does.
    pub(super) fn is_at(&self, other: &Self) -> bool {
        self.origin == other.origin && self.surface.triangle == other.surface.triangle
    }

    /// A place in space that faces a way.
    pub(crate) fn in_space(scene: &Scene, point: Point, normal: Normal, rays: u32) -> Self {
        Self {
            origin: point,
            normal,
            surface: SurfacePoint::in_space(point, normal, scene.bvh().offset_m(point)),
            rays,
            in_gap: false,
            behind: None,
        }
    }
}

/// Everything gathering reads.
pub(crate) struct Gathering<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) lighting: &'a Lighting<'a>,
    pub(crate) elements: &'a Elements,
    /// Nodes of the elements from this number on are finer than the level gathered over.
    pub(crate) level: u32,
    /// What vertices stand for; those without have no value to be read.
    pub(crate) standings: &'a [Option<Standing>],
    pub(crate) direct: DirectAtEnds<'a>,
    /// Whether a ray that ends nearer than the element there is long gathers again from there, instead of
    /// reading a map that tells little of places so close to something: a few times.
    pub(crate) regathers: bool,
    /// What is so bright that rays are sent there.
    pub(crate) bright: Option<&'a BrightSurfaces>,
    /// Elements that something stands across, if they were looked for.
    pub(crate) cuts: Option<&'a Barriers>,
    /// Walls that rays are judged by, for gatherers that know them.
    pub(crate) backdrop: Option<&'a ControlVariate>,
}

/// Where rays get the direct light of the surfaces that they end on.
#[derive(Clone, Copy)]
pub(crate) enum DirectAtEnds<'a> {
    /// Evaluated there: no bias, but a source is drawn where there are many.
    Evaluated,
    /// Read from these values of vertices, nodes from number `level` on left out.
    Read {
        /// A value a vertex, lx.
        values: &'a [Rgb],
        /// As for indirect light, or finer.
        level: u32,
    },
    /// Read, but evaluated where a ray that regathers ends nearer than the element there is long, as what stands that
    /// close may throw shadows that the map does not resolve, and on elements that some shadow ends on.
    ReadFarOff {
        /// A value a vertex, lx.
        values: &'a [Rgb],
        /// Elements that light may vary on whatever their vertices tell, by node: who evaluated it only where vertices differ would
        /// read it where all of them lie in the dark.
        varying: Option<&'a [bool]>,
    },
}

/// Known vertices and their weights at a place, nodes from number `level` on left out.
pub(crate) fn known_at(
    elements: &Elements,
    level: u32,
    standings: &[Option<Standing>],
    at: &SurfacePoint,
) -> Option<[(u32, f64); 3]> {
    let corners = elements.locate_above(level, at.triangle, at.back, at.u, at.v)?;
    let weights = known_weights(corners, standings)?;
    Some([0, 1, 2].map(|k| (corners[k].0, weights[k])))
}

/// Interpolation weights over the known vertices of the highest standing alone.
pub(crate) fn known_weights(
    corners: [(u32, f64); 3],
    standings: &[Option<Standing>],
) -> Option<[f64; 3]> {
    weights_of_highest(corners, corners.map(|(vertex, _)| standings[vertex as usize]))
}

/// The same over those in gaps; without any, light there is as little as none.
pub(super) fn weights_in_gap(
    corners: [(u32, f64); 3],
    standings: &[Option<Standing>],
) -> Option<[f64; 3]> {
    let in_gap = |standing: &Standing| *standing != Standing::Open;
    weights_of_highest(
        corners,
        corners.map(|(vertex, _)| standings[vertex as usize].filter(in_gap)),
    )
}

/// Those on the side of a cut that a place lies on; `None` if none is known.
pub(crate) fn known_on_side(
    corners: [(u32, f64); 3],
    standings: &[Option<Standing>],
    cut: &Barrier,
) -> Option<[(u32, f64); 3]> {
    let side = cut.side(corners.map(|(_, weight)| weight));
    let of = [0, 1, 2].map(|k| standings[corners[k].0 as usize].filter(|_| side[k]));
    let weights = weights_of_highest(corners, of)?;
    Some([0, 1, 2].map(|k| (corners[k].0, weights[k])))
}

fn weights_of_highest(corners: [(u32, f64); 3], of: [Option<Standing>; 3]) -> Option<[f64; 3]> {
    let highest = Standing::highest(of)?;
    Some(weights_over(corners, of.map(|standing| standing == Some(highest))))
}

/// Interpolation weights over some of the vertices, at least one, alone.
fn weights_over(corners: [(u32, f64); 3], read: [bool; 3]) -> [f64; 3] {
    if read == [true; 3] {
        return corners.map(|(_, weight)| weight);
    }
    let weights = [0, 1, 2].map(|k| if read[k] { corners[k].1 } else { 0.0 });
    let sum: f64 = weights.iter().sum();
    // On the far side of the element only other vertices have weight.
    if sum < 1e-9 {
        let count = read.iter().filter(|&&read| read).count();
        return read.map(|read| if read { 1.0 / count as f64 } else { 0.0 });
    }
    weights.map(|w| w / sum)
}
