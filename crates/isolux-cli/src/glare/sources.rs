//! What shines into an eye: luminous areas of luminaires, and emitting surfaces.

use super::position::{position_index, triangle_sr};
use isolux::geometry::{Point, Ray, Vector};
use isolux::scene::{Camera, Luminaire, LuminaireKind, Scene};

/// Looks at places of a luminous area, which tell how much of it is hidden: along each of three sides.
const LOOKS: [usize; 3] = [4, 4, 1];
/// Parts of emitting triangles are no larger, sr: over one the position index changes by a few per cent. CIE 117:1995 takes sources of up to 0.1
/// sr as a whole.
const LARGEST_PART_SR: f64 = 2e-3;
/// Halvings of a triangle at most.
const MOST_HALVINGS: u32 = 16;

/// What shines into an eye.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Shining {
    /// The sum of L^2 omega / p^2, cd2 sr/m4.
    pub(super) sum: f64,
    /// Its standard error, as far as parts of sources are hidden.
    pub(super) error: f64,
    /// Sources of which some is seen.
    pub(super) seen: usize,
    /// Luminaires without a luminous area, which have no luminance.
    pub(super) points: usize,
}

/// All sources before an eye.
pub(super) fn shining(scene: &Scene, eye: &Camera) -> Shining {
    let mut found = Shining::default();
    let mut variance = 0.0;
    for luminaire in scene.luminaires() {
        match of_luminaire(scene, eye, luminaire) {
            Looked::Light(sum, error) if sum > 0.0 => {
                found.sum += sum;
                found.seen += 1;
                variance += error * error;
            }
            Looked::Light(..) => {}
            Looked::NoArea => found.points += 1,
        }
    }
    for area in scene.area_luminaires() {
        let luminance = area.luminance_cd_m2.luminance();
        let of_one = |&triangle: &u32| {
            let corners = scene.triangle(triangle).corners;
            let normal = scene.geometric_normal(triangle);
            let facing = (eye.position - corners[0]).dot(normal.to_vector()) > 0.0;
            if facing == area.back { 0.0 } else { of_part(scene, eye, (corners, triangle), 0) }
        };
        let sum = luminance * luminance * area.triangles.iter().map(of_one).sum::<f64>();
        found.sum += sum;
        found.seen += usize::from(sum > 0.0);
    }
    Shining { error: variance.sqrt(), ..found }
}

enum Looked {
    /// L^2 omega / p^2 with its standard error.
    Light(f64, f64),
    NoArea,
}

fn of_luminaire(scene: &Scene, eye: &Camera, luminaire: &Luminaire) -> Looked {
    let LuminaireKind::Point { position, world_from_luminaire, intensity, area } = &luminaire.kind
    else {
        return Looked::Light(0.0, 0.0);
    };
    let Some(area) = area else { return Looked::NoArea };
    let middle = *position + world_from_luminaire.vector(Vector::from(area.middle_m));
    let way = middle - eye.position;
    let seen = || {
        let towards = way.direction()?;
        let index = position_index(eye, towards)?;
        let back = world_from_luminaire.inverse()?.vector(-way).direction()?;
        let (candela, seen_m2) = (intensity.intensity_cd(back), area.seen_m2(back));
        let luminance = luminaire.colour.luminance() * candela / seen_m2;
        let steradians = seen_m2 / way.length_squared();
        let whole = luminance * luminance * steradians / (index * index);
        whole.is_finite().then_some(whole)
    };
    let Some(whole) = seen().filter(|whole| *whole > 0.0) else { return Looked::Light(0.0, 0.0) };
    let count = LOOKS.iter().product::<usize>();
    let free = (0..count).filter(|&k| {
        let place = area.place(lattice(k));
        is_free(scene, eye.position, *position + world_from_luminaire.vector(place), None)
    });
    let share = free.count() as f64 / count as f64;
    // Looks spread evenly tell a share to about one of them where the source is partly hidden.
    let error = if share > 0.0 && share < 1.0 { whole / count as f64 } else { 0.0 };
    Looked::Light(whole * share, error)
}

/// The middle of a cell of the unit cube.
fn lattice(k: usize) -> [f64; 3] {
    let [nx, ny, nz] = LOOKS;
    let middle = |k: usize, n: usize| (k as f64 + 0.5) / n as f64;
    [middle(k % nx, nx), middle(k / nx % ny, ny), middle(k / (nx * ny), nz)]
}

/// The sum of omega / p^2 over what is seen of a triangle, by parts.
fn of_part(
    scene: &Scene,
    eye: &Camera,
    (corners, triangle): ([Point; 3], u32),
    halved: u32,
) -> f64 {
    let steradians = triangle_sr(eye.position, corners);
    if steradians > LARGEST_PART_SR && halved < MOST_HALVINGS {
        let halves = halves(corners);
        return halves.map(|half| of_part(scene, eye, (half, triangle), halved + 1)).iter().sum();
    }
    let [a, b, c] = corners.map(Point::to_vector);
    let middle = Point::ORIGIN + (a + b + c) / 3.0;
    let index = (middle - eye.position).direction().and_then(|to| position_index(eye, to));
    match index {
        Some(index) if is_free(scene, eye.position, middle, Some(triangle)) => {
            steradians / (index * index)
        }
        _ => 0.0,
    }
}

/// A triangle cut through the middle of its longest side.
fn halves([a, b, c]: [Point; 3]) -> [[Point; 3]; 2] {
    let sides = [(a, b, c), (b, c, a), (c, a, b)];
    let length = |(a, b, _): &(Point, Point, Point)| (*b - *a).length_squared();
    let longest = sides.into_iter().max_by(|x, y| f64::total_cmp(&length(x), &length(y)));
    let (a, b, c) = longest.unwrap_or((a, b, c));
    let middle = a.lerp(b, 0.5);
    [[a, middle, c], [middle, b, c]]
}

fn is_free(scene: &Scene, from: Point, to: Point, emitter: Option<u32>) -> bool {
    let ray = Ray::between(from, to);
    let ray = emitter.map_or(ray, |triangle| ray.skipping(triangle));
    !scene.bvh().any_hit(&ray)
}
