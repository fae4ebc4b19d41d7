//! Luminous areas as a ray meets them.
//!
//! They are no surfaces: light passes through them. A picture shows their luminance, the intensity towards the eye over
//! the outline as seen from there. Where a luminaire sends no light to the eye, nothing is seen of it.

use crate::image::Surface;
use isolux::geometry::{Bvh, Direction, End, Normal, Point, Ray, Transform, TriangleMesh, Vector};
use isolux::photometry::IntensityDistribution;
use isolux::scene::{LuminaireKind, LuminousArea, Scene};
use isolux::units::Rgb;

/// The sides of a box by the numbers of its corners, of which bits 0, 1 and 2 tell the sides of x, y and z.
const SIDES: [[u32; 4]; 6] =
    [[0, 2, 6, 4], [1, 3, 7, 5], [0, 1, 5, 4], [2, 3, 7, 6], [0, 1, 3, 2], [4, 5, 7, 6]];
/// Triangles of a box.
const OF_A_BOX: u32 = 12;
/// The most boxes that a ray passes without meeting what is in them.
const MOST_MISSES: u32 = 64;

/// The luminous areas of a scene.
pub(super) struct Lamps<'a> {
    /// A box around each.
    boxes: Bvh,
    all: Vec<Lamp<'a>>,
}

/// A luminaire with a luminous area.
struct Lamp<'a> {
    position: Point,
    local_from_world: Transform,
    area: LuminousArea,
    intensity: &'a IntensityDistribution,
    colour: Rgb,
}

/// A luminous area that a ray meets.
#[derive(Clone, Copy)]
pub(super) struct MetLamp {
    pub(super) luminance_cd_m2: Rgb,
    /// The density of the directions of looks that are sent to it, 1/sr.
    pub(super) density: f64,
    pub(super) surface: Surface,
}

impl<'a> Lamps<'a> {
    /// The luminous areas of a scene; `None` if there are none.
    pub(super) fn of(scene: &'a Scene) -> Option<Self> {
        let origin = scene.bvh().mesh().origin;
        let mut mesh = TriangleMesh { origin, positions: Vec::new(), triangles: Vec::new() };
        let mut all = Vec::new();
        for luminaire in scene.luminaires() {
            let LuminaireKind::Point { position, world_from_luminaire, intensity, area } =
                &luminaire.kind
            else {
                continue;
            };
            let Some((area, local_from_world)) = area.zip(world_from_luminaire.inverse()) else {
                continue;
            };
            let first = mesh.positions.len() as u32;
            for corner in 0..8 {
                let side = |k: usize| if corner >> k & 1 == 0 { -1.0 } else { 1.0 };
                let [x, y, z] = [0, 1, 2].map(|k| side(k) * area.half_m[k]);
                let place = *position + world_from_luminaire.vector(Vector::new(x, y, z));
                mesh.positions.push((place - origin).to_f32());
            }
            for side in SIDES {
                let [a, b, c, d] = side.map(|corner| first + corner);
                mesh.triangles.extend([[a, b, c], [a, c, d]]);
            }
            let (position, colour) = (*position, luminaire.colour);
            all.push(Lamp { position, local_from_world, area, intensity, colour });
        }
        (!all.is_empty()).then(|| Self { boxes: Bvh::build(mesh, |_| false), all })
    }

    /// The first that sends light back along a ray, up to a distance in lengths of the direction.
    pub(super) fn met(&self, ray: &Ray, direction: Direction, up_to: f32) -> Option<MetLamp> {
        let mut ray = ray.up_to(up_to);
        for _ in 0..MOST_MISSES {
            let hit = self.boxes.closest_hit(&ray)?;
            let number = hit.triangle / OF_A_BOX;
            if let Some(met) = self.all[number as usize].met(number, ray.origin, direction) {
                return Some(met);
            }
            // Onwards from there: inside of the box, or behind it.
            let place = ray.origin + direction.to_vector() * f64::from(hit.t);
            let onwards = Ray::new(place, direction).skipping(hit.triangle);
            let left = match ray.end {
                End::At(t) => t - hit.t,
                End::Target => f32::INFINITY,
            };
            ray = onwards.up_to(left);
        }
        None
    }
}

impl Lamp<'_> {
    fn met(&self, number: u32, origin: Point, direction: Direction) -> Option<MetLamp> {
        let local = |v: Vector| self.local_from_world.vector(v);
        let (from, along) = (local(origin - self.position), local(direction.to_vector()));
        self.area.crossed(from, along).filter(|range| range[1] >= 0.0)?;
        let back = (-along).direction()?;
        let (candela, seen_m2) = (self.intensity.intensity_cd(back), self.area.seen_m2(back));
        let luminance_cd_m2 = self.colour * (candela / seen_m2);
        let is_seen = candela > 0.0 && luminance_cd_m2.is_finite();
        // No shape of the scene has such a number; one luminaire is one surface.
        let surface = Surface {
            shape: u32::MAX - number,
            back: false,
            path: 0,
            position: self.position,
            normal: Normal::Z,
        };
        let way = self.position - origin;
        let towards = local(way).direction()?;
        let density = way.length_squared() / self.area.seen_m2(towards);
        is_seen.then_some(MetLamp { luminance_cd_m2, density, surface })
    }
}
