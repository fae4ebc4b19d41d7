//! Gathering: the light that a receiver sees, as a row of a linear operator over the vertices of the map.
//!
//! From a receiver, cosine-distributed rays are followed to diffuse surfaces. Direct light is evaluated there at
//! once, or read from the map where luminaires are many. Indirect light is left open: each ray becomes an entry of a
//! sparse matrix. The light of all further reflections is then the fixed point of `E = source + A E`, solved without
//! tracing rays again.

use super::bright_surfaces::BrightSurfaces;
use super::control_variate::ControlVariate;
use crate::elements::{Elements, Receiver};
use crate::engine::light::Lighting;
use crate::engine::occlusion::{Barrier, Barriers};
use crate::engine::ray::{Stand, SurfacePoint};
use crate::map::Standing;
use crate::scene::Scene;
use crate::units::Rgb;
use isolux_geometry::{Normal, Point};
use serde::{Deserialize, Serialize};

/// A place that gathers.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct Gatherer {
    /// The point where rays start.
    pub(crate) origin: Point,
    /// The axis of the cosine distribution of rays.
    pub(crate) normal: Normal,
    /// The surface point for direct light.
    pub(crate) surface: SurfacePoint,
    /// The number of rays.
    pub(crate) rays: u32,
    /// Whether the place lies in a gap. Surfaces that its rays meet close by are then not in the open.
    pub(crate) in_gap: bool,
    /// The light of the [`ControlVariate`] at the place without obstacles, lx, if rays are corrected by it.
    pub(crate) behind: Option<Rgb>,
}

impl Gatherer {
    /// The gatherer at a vertex. Its normal is that of the smooth surface whose facets meet at the vertex.
    pub(crate) fn at_vertex(scene: &Scene, receiver: &Receiver, rays: u32) -> Self {
        let Receiver { point, normal, triangle, back } = *receiver;
        let flat = SurfacePoint::new(scene, triangle, back, 0.0, 0.0);
        let surface = SurfacePoint { point, shading: normal, geometric: normal, ..flat };
        let origin = SurfacePoint { point, ..flat }.start();
        Self { origin, normal, surface, rays, in_gap: false, behind: None }
    }

    /// This gatherer with the flag `in_gap` set or cleared.
    pub(crate) const fn in_gap(self, in_gap: bool) -> Self {
        Self { in_gap, ..self }
    }

    /// This gatherer with another number of rays.
    pub(crate) const fn with_rays(self, rays: u32) -> Self {
        Self { rays, ..self }
    }

    /// A gatherer at a place inside a triangle.
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

    /// The origin, axis and triangle of its rays.
    pub(crate) const fn stand(&self) -> Stand {
        Stand { origin: self.origin, normal: self.normal, triangle: self.surface.triangle }
    }

    /// Whether two gatherers share their origin and triangle.
    pub(super) fn is_at(&self, other: &Self) -> bool {
        self.origin == other.origin && self.surface.triangle == other.surface.triangle
    }

    /// A gatherer at a point in space that faces a direction.
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

/// All inputs of gathering.
pub(crate) struct Gathering<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) lighting: &'a Lighting<'a>,
    pub(crate) elements: &'a Elements,
    /// The number of the first node that is finer than the level gathered over.
    pub(crate) level: u32,
    /// The standing of each vertex; vertices without one have no value to be read.
    pub(crate) standings: &'a [Option<Standing>],
    pub(crate) direct: DirectAtEnds<'a>,
    /// Whether a ray that ends nearer than the element there is long gathers again from its end, a few times. The map
    /// tells little of places so close to something.
    pub(crate) regathers: bool,
    /// Surfaces so bright that extra rays are sent to them.
    pub(crate) bright: Option<&'a BrightSurfaces>,
    /// Elements that something stands across, if they were looked for.
    pub(crate) cuts: Option<&'a Barriers>,
    /// The control variate of walls, for gatherers that have its value.
    pub(crate) backdrop: Option<&'a ControlVariate>,
}

/// The source of direct light at the ends of rays.
#[derive(Clone, Copy)]
pub(crate) enum DirectAtEnds<'a> {
    /// Direct light is evaluated there. This has no bias; where sources are many, one is drawn.
    Evaluated,
    /// Direct light is interpolated between vertices. Nodes from number `level` on are left out.
    Read {
        /// Direct light of each vertex, lx.
        values: &'a [Rgb],
        /// The first node left out: that of indirect light, or a finer one.
        level: u32,
    },
    /// Direct light is read from vertices, with two exceptions where it is evaluated. One is a ray that regathers and
    /// ends nearer than the element there is long: objects that close may throw shadows that the map does not
    /// resolve. The other is an element that a shadow ends on.
    ReadFarOff {
        /// Direct light of each vertex, lx.
        values: &'a [Rgb],
        /// Elements, by node, that light may vary over even where their vertices agree, such as where all of them lie
        /// in the dark.
        varying: Option<&'a [bool]>,
    },
}

/// Known vertices and their weights at a place. Nodes from number `level` on are left out.
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

/// Interpolation weights over the known vertices of the highest standing.
pub(crate) fn known_weights(
    corners: [(u32, f64); 3],
    standings: &[Option<Standing>],
) -> Option<[f64; 3]> {
    weights_of_highest(corners, corners.map(|(vertex, _)| standings[vertex as usize]))
}

/// Interpolation weights over the known vertices in gaps, of the highest standing among them; `None` if there are
/// none.
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

/// Known vertices and weights on the side of a barrier that a place lies on; `None` if none is known there.
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

/// Interpolation weights over the vertices marked in `read`, at least one.
fn weights_over(corners: [(u32, f64); 3], read: [bool; 3]) -> [f64; 3] {
    if read == [true; 3] {
        return corners.map(|(_, weight)| weight);
    }
    let weights = [0, 1, 2].map(|k| if read[k] { corners[k].1 } else { 0.0 });
    let sum: f64 = weights.iter().sum();
    // On the far side of the element only vertices that are not read have weight.
    if sum < 1e-9 {
        let count = read.iter().filter(|&&read| read).count();
        return read.map(|read| if read { 1.0 / count as f64 } else { 0.0 });
    }
    weights.map(|w| w / sum)
}
