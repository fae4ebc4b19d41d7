//! Luminaires and their images in planar mirrors.

pub(super) mod facets;
pub(super) mod triangle_lamps;
pub(super) mod triangle_tree;

use super::far_sky::FarSky;
use super::mirrors::planar::{MAX_CHAIN_MIRRORS, MAX_CHAINS, Mirrors};
use crate::engine::ray::SurfacePoint;
use crate::photometry::IntensityDistribution;
use crate::scene::{LuminaireKind, LuminousArea, Scene};
use crate::units::Rgb;
use facets::Facets;
use isolux_geometry::{Direction, Normal, Point, Transform, Vector};
use triangle_tree::Clusters;

/// Reflectance of a chain of mirrors below which its image is left out and its light counted as error.
const LEAST_IMAGE_REFLECTANCE: f64 = 1e-3;

/// Samples of all emitting surfaces together in one replicate at a receiver. With 16, a ledge with hidden
/// lamps makes its elements anew, and viewers show the noise of vertices (decision 44).
pub(crate) const AREA_SAMPLES: usize = 64;
/// The fewest samples of one emitting surface.
pub(crate) const FEWEST_AREA_SAMPLES: usize = 4;

/// Number of a luminaire of the scene: one without a surface, or an emitting surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LuminaireId {
    Luminaire(u32),
    Area(u32),
}

/// A luminaire or its image.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    pub(crate) luminaire: LuminaireId,
    /// Planar mirrors that reflect its light, in the order in which the light meets them.
    pub(crate) chain: Vec<u32>,
    /// Colour of the luminaire times the reflectance of the chain.
    pub(crate) colour: Rgb,
    pub(crate) kind: SourceKind,
}

/// Shape of a source as seen from a receiver.
#[derive(Clone, Debug)]
pub(crate) enum SourceKind {
    /// A point or a luminous area about it; `local_from_world` is linear and orthogonal (a mirror image is
    /// left-handed).
    Point { luminaire: u32, position: Point, local_from_world: Transform, area: Option<Luminous> },
    /// Parallel light, or that of a disc, which is seen under twice this angle.
    Directional { towards: Direction, illuminance_lx: f64, half_angle_rad: f64 },
    /// Light from all around.
    Sky(FarSky),
    /// Emitting triangles, reflected by the chain, their emitting side counter-clockwise.
    Area { emitter: Emitter, triangles: Vec<[Point; 3]> },
}

/// A luminous area, with what is often asked of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Luminous {
    pub(crate) area: LuminousArea,
    pub(crate) radius_m: f64,
    /// The highest luminous intensity, cd.
    peak_cd: f64,
}

impl Luminous {
    fn of(area: LuminousArea, intensity: &IntensityDistribution) -> Self {
        Self { area, radius_m: area.radius_m(), peak_cd: intensity.max_intensity_cd() }
    }
}

/// An emitting surface as a whole: its extent, and its triangles prepared for sampling.
#[derive(Clone, Debug)]
pub(crate) struct Emitter {
    pub(crate) indices: Vec<u32>,
    pub(crate) area_m2: f64,
    pub(crate) centre: Point,
    /// Weights of the triangles for one sample.
    pub(crate) facets: Facets,
    /// Tree of the triangles for many samples, where there are many triangles.
    pub(crate) clusters: Clusters,
}

/// Illuminance from a source at a receiver, without obstacles.
pub(crate) struct Arriving {
    pub(crate) illuminance_lx: Rgb,
    pub(crate) target: Target,
}

/// The most triangles a sample with which an emitter is sampled by solid angle, with the exact
/// unoccluded illuminance as control variate. Of larger emitters only the near triangles are sampled so.
pub(crate) const MOST_TRIANGLES_A_SAMPLE: usize = 32;

/// Position of a source.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Target {
    Point(Point),
    Infinity(Direction),
}

impl Target {
    /// Vector from a point to the source; a unit vector if the source is at infinity.
    pub(crate) fn towards(self, from: Point) -> Vector {
        match self {
            Self::Point(place) => place - from,
            Self::Infinity(direction) => direction.to_vector(),
        }
    }
}

/// All sources of a scene.
#[derive(Debug, Default)]
pub(crate) struct Sources {
    pub(crate) all: Vec<Source>,
    /// Index of the first source of every luminaire, and the total number at the end.
    pub(crate) starts: Vec<usize>,
    /// Whether a chain of mirrors goes on beyond the last image.
    pub(crate) leaves_chains: bool,
    /// Bound of the share of all light that is left out because mirrors dim it too much. Light that leaves
    /// a luminaire in one direction follows one chain, so the bound is the largest share of any chain.
    pub(crate) left_out: f64,
}

impl Sources {
    /// The luminaires of a scene and their images.
    pub(crate) fn of(scene: &Scene, mirrors: &Mirrors) -> Self {
        let mut found = Self::default();
        for real in real_sources(scene) {
            let first = found.all.len();
            found.starts.push(first);
            found.all.push(real);
            let mut next = first;
            // Breadth first: each image is appended, and reflected in turn.
            while next < found.all.len() {
                let full = found.all.len() - first >= MAX_CHAINS;
                found.reflect(next, mirrors, full);
                next += 1;
            }
        }
        found.starts.push(found.all.len());
        found
    }

    fn reflect(&mut self, source: usize, mirrors: &Mirrors, full: bool) {
        for plane in 0..mirrors.planes.len() as u32 {
            let source = &self.all[source];
            let Some(image) = image(source, plane, mirrors) else { continue };
            let kept = chain_reflectance(&image, mirrors);
            if kept < LEAST_IMAGE_REFLECTANCE {
                self.left_out = self.left_out.max(kept);
            } else if full || image.chain.len() > MAX_CHAIN_MIRRORS {
                self.leaves_chains = true;
            } else {
                self.all.push(image);
            }
        }
    }
}

impl Source {
    /// Its mean luminance, photometric, cd/m2: for emitting surfaces and skies.
    pub(crate) fn mean_cd_m2(&self) -> f64 {
        match &self.kind {
            SourceKind::Sky(sky) => self.colour.luminance() * sky.mean_cd_m2(),
            _ => self.colour.luminance(),
        }
    }

    /// Whether the source is an emitting surface.
    pub(crate) const fn is_area(&self) -> bool {
        matches!(self.kind, SourceKind::Area { .. })
    }

    /// Whether the source has an extent: one shadow ray does not tell how much of it is hidden.
    pub(crate) const fn has_extent(&self) -> bool {
        match &self.kind {
            SourceKind::Area { .. } | SourceKind::Point { area: Some(_), .. } => true,
            SourceKind::Directional { half_angle_rad, .. } => *half_angle_rad > 0.0,
            SourceKind::Sky(_) => true,
            SourceKind::Point { area: None, .. } => false,
        }
    }

    /// Whether the source has an extent and is infinitely far away.
    pub(crate) const fn is_far_extent(&self) -> bool {
        let is_far = matches!(self.kind, SourceKind::Directional { .. } | SourceKind::Sky(_));
        is_far && self.has_extent()
    }
}

/// Corners of a side of a triangle, counter-clockwise as seen from that side.
pub(crate) fn corners_seen(scene: &Scene, triangle: u32, back: bool) -> [Point; 3] {
    let [a, b, c] = scene.triangle(triangle).corners;
    if back { [a, c, b] } else { [a, b, c] }
}

fn real_sources(scene: &Scene) -> impl Iterator<Item = Source> + '_ {
    let points = scene.luminaires().iter().enumerate().map(|(index, luminaire)| {
        let kind = match &luminaire.kind {
            LuminaireKind::Point { position, world_from_luminaire, intensity, area } => {
                SourceKind::Point {
                    luminaire: index as u32,
                    position: *position,
                    local_from_world: inverse_of_rotation(world_from_luminaire),
                    area: area.map(|area| Luminous::of(area, intensity)),
                }
            }
            LuminaireKind::Directional { direction, illuminance_lx, half_angle_rad } => {
                let (illuminance_lx, half_angle_rad) = (*illuminance_lx, *half_angle_rad);
                SourceKind::Directional { towards: -*direction, illuminance_lx, half_angle_rad }
            }
            LuminaireKind::Sky { world_from_sky, sky } => {
                SourceKind::Sky(FarSky::new(sky, inverse_of_rotation(world_from_sky)))
            }
        };
        let luminaire_id = LuminaireId::Luminaire(index as u32);
        Source { luminaire: luminaire_id, chain: Vec::new(), colour: luminaire.colour, kind }
    });
    let areas = scene.area_luminaires().iter().enumerate().map(|(index, area)| {
        let triangles = area.triangles.iter().map(|&t| corners_seen(scene, t, area.back));
        Source {
            luminaire: LuminaireId::Area(index as u32),
            chain: Vec::new(),
            colour: area.luminance_cd_m2,
            kind: area_kind(area.triangles.clone(), triangles.collect()),
        }
    });
    points.chain(areas)
}

fn area_kind(indices: Vec<u32>, triangles: Vec<[Point; 3]>) -> SourceKind {
    let area = |&[a, b, c]: &[Point; 3]| 0.5 * (b - a).cross(c - a).length();
    let (mut sum_m2, mut moment) = (0.0, Vector::ZERO);
    for triangle in &triangles {
        let m2 = area(triangle);
        sum_m2 += m2;
        let [a, b, c] = triangle.map(Point::to_vector);
        moment += (a + b + c) * (m2 / 3.0);
    }
    let centre = Point::ORIGIN + moment / sum_m2;
    // Emitters of few triangles need no tree: they are sampled triangle by triangle.
    let is_large = triangles.len() > MOST_TRIANGLES_A_SAMPLE;
    let clusters = if is_large { Clusters::of(&triangles) } else { Clusters::default() };
    let facets = Facets::of(&triangles);
    let emitter = Emitter { indices, area_m2: sum_m2, centre, facets, clusters };
    SourceKind::Area { emitter, triangles }
}

/// Image of a source in a plane; `None` where its light cannot reach the reflecting side.
fn image(source: &Source, plane: u32, mirrors: &Mirrors) -> Option<Source> {
    let mirror = &mirrors.planes[plane as usize];
    let colour = source.colour * mirror.reflectance;
    let meets = source.chain.last().is_none_or(|&last| {
        last != plane && mirrors.planes[last as usize].can_light(mirror, mirrors.tolerance_m)
    });
    if !meets {
        return None;
    }
    let kind = match &source.kind {
        SourceKind::Point { luminaire, position, local_from_world, area } => {
            (mirror.height(*position) > 0.0).then(|| SourceKind::Point {
                luminaire: *luminaire,
                position: mirror.image(*position),
                local_from_world: Transform {
                    columns: Transform::IDENTITY
                        .columns
                        .map(|axis| local_from_world.vector(mirror.image_vector(axis))),
                    translation: Vector::ZERO,
                },
                area: *area,
            })
        }
        SourceKind::Directional { towards, illuminance_lx, half_angle_rad } => {
            // A disc shines on the mirror until it has set.
            let is_up = towards.cos(mirror.normal) > -libm::sin(*half_angle_rad);
            is_up.then(|| SourceKind::Directional {
                towards: towards.reflect(mirror.normal),
                illuminance_lx: *illuminance_lx,
                half_angle_rad: *half_angle_rad,
            })
        }
        SourceKind::Sky(sky) => Some(SourceKind::Sky(sky.image(|axis| mirror.image_vector(axis)))),
        SourceKind::Area { emitter, triangles } => {
            // Triangles behind the mirror have no image. Those that cross its plane are kept whole:
            // a ray to the part behind does not meet the mirror before the image.
            let in_front =
                |t: &[Point; 3]| t.iter().any(|&p| mirror.height(p) > mirrors.tolerance_m);
            let kept = || emitter.indices.iter().zip(triangles).filter(|(_, t)| in_front(t));
            let indices: Vec<u32> = kept().map(|(&index, _)| index).collect();
            (!indices.is_empty()).then(|| {
                area_kind(indices, kept().map(|(_, &t)| mirror.image_of_triangle(t)).collect())
            })
        }
    }?;
    let chain = source.chain.iter().copied().chain([plane]).collect();
    Some(Source { luminaire: source.luminaire, chain, colour, kind })
}

fn chain_reflectance(source: &Source, mirrors: &Mirrors) -> f64 {
    source.chain.iter().map(|&p| mirrors.planes[p as usize].reflectance.max_channel()).product()
}

/// Inverse of a rotation: its linear part transposed.
pub(crate) fn inverse_of_rotation(rotation: &Transform) -> Transform {
    let [a, b, c] = rotation.columns;
    let row = |k: usize| Vector::new(a.component(k), b.component(k), c.component(k));
    Transform { columns: [row(0), row(1), row(2)], translation: Vector::ZERO }
}

/// Unoccluded illuminance from a point source, from the middle of a luminous area, or from parallel light; `None`
/// where it faces away, or is not in view.
pub(crate) fn unoccluded_if(
    scene: &Scene,
    source: &Source,
    at: &SurfacePoint,
    is_in_view: impl Fn(Target) -> bool,
) -> Option<Arriving> {
    let middle = match &source.kind {
        SourceKind::Point { position, .. } => *position,
        _ => Point::ORIGIN,
    };
    unoccluded_from(scene, source, middle, at, is_in_view)
}

/// Unoccluded illuminance from a point source as if it were at a place, or from parallel light; `None` where it faces
/// away, or is not in view.
pub(crate) fn unoccluded_from(
    scene: &Scene,
    source: &Source,
    place: Point,
    at: &SurfacePoint,
    is_in_view: impl Fn(Target) -> bool,
) -> Option<Arriving> {
    let (towards, target) = match &source.kind {
        SourceKind::Point { .. } => ((place - at.point).direction()?, Target::Point(place)),
        SourceKind::Directional { towards, .. } => (*towards, Target::Infinity(*towards)),
        SourceKind::Area { .. } | SourceKind::Sky(_) => return None,
    };
    let cos = facing_cos(towards, at.shading, at.geometric)?;
    if !is_in_view(target) {
        return None;
    }
    let lx = match &source.kind {
        SourceKind::Point { luminaire, local_from_world, .. } => {
            let local = local_from_world.vector(-towards.to_vector()).direction()?;
            let candela = intensity(scene, *luminaire).intensity_cd(local);
            candela / (place - at.point).length_squared()
        }
        SourceKind::Directional { illuminance_lx, .. } => *illuminance_lx,
        SourceKind::Area { .. } | SourceKind::Sky(_) => return None,
    };
    let illuminance_lx = source.colour * (lx * cos);
    (!illuminance_lx.is_black()).then_some(Arriving { illuminance_lx, target })
}

/// Cosine at the receiver, if the direction is above the surface by both its normals.
pub(crate) fn facing_cos(towards: Direction, shading: Normal, geometric: Normal) -> Option<f64> {
    let cos = towards.cos(shading);
    (cos > 0.0 && towards.cos(geometric) > 0.0).then_some(cos)
}

/// Luminous intensity distribution of a point luminaire.
pub(crate) fn intensity(scene: &Scene, luminaire: u32) -> &IntensityDistribution {
    match &scene.luminaires()[luminaire as usize].kind {
        LuminaireKind::Point { intensity, .. } => intensity,
        LuminaireKind::Directional { .. } | LuminaireKind::Sky { .. } => {
            unreachable!("sources of points are made from points")
        }
    }
}

/// Weight for drawing a source at a receiver: its unoccluded illuminance, exact for points, approximate (and
/// never zero) for what has an extent. It is zero for images that `is_in_view` does not see through their mirrors.
pub(crate) fn importance(
    scene: &Scene,
    source: &Source,
    at: &SurfacePoint,
    is_in_view: impl Fn(Target) -> bool,
) -> f64 {
    match &source.kind {
        SourceKind::Area { emitter, .. } => {
            let area_m2 = emitter.area_m2;
            let distance_squared = (emitter.centre - at.point).length_squared();
            source.colour.luminance() * area_m2 / (distance_squared + area_m2)
        }
        SourceKind::Sky(sky) => source.colour.luminance() * sky.mean_cd_m2(),
        SourceKind::Directional { towards, illuminance_lx, half_angle_rad }
            if *half_angle_rad > 0.0 =>
        {
            // Where the middle of the disc has set, a part may be up.
            let cos = towards.cos(at.shading) + libm::sin(*half_angle_rad);
            source.colour.luminance() * illuminance_lx * cos.max(0.0)
        }
        SourceKind::Point { position, area: Some(area), .. } => {
            let middle = unoccluded_if(scene, source, at, |_| true)
                .map_or(0.0, |arriving| arriving.illuminance_lx.luminance());
            // Where the middle gives no light, other places may.
            let distance2 = (*position - at.point).length_squared();
            let radius2 = area.radius_m * area.radius_m;
            let nearness = radius2 / (distance2 + radius2);
            middle + nearness * source.colour.luminance() * area.peak_cd / (distance2 + radius2)
        }
        _ => unoccluded_if(scene, source, at, is_in_view)
            .map_or(0.0, |arriving| arriving.illuminance_lx.luminance()),
    }
}
