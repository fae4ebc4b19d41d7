//! The direct light expected of every case, against a textbook evaluation on its triangles: images
//! of luminaires in all sequences of mirrors, every leg of the way traced by brute force or hierarchy.
//! A case whose scene is not what its closed form speaks of fails here, before any engine is blamed.

use isolux::engine::ProbePoint;
use isolux::geometry::{Normal, Point, Ray, Vector};
use isolux::scene::{Luminaire, LuminaireKind, Scene};
use isolux::units::Rgb;
use isolux_compare::case::cases;
use isolux_compare::lambert::polygon_illuminance_lx;
use isolux_compare::tolerance::RAY_KERNEL_POSITION;
use isolux_compare::{Case, Quantity};

/// Three mirrors at right angles show images of third order at most.
const MOST_REFLECTIONS: usize = 3;

/// A plane mirror: one shape.
struct Mirror {
    shape: u32,
    on: Point,
    normal: Normal,
    reflectance: Rgb,
}

impl Mirror {
    fn all(scene: &Scene) -> Vec<Self> {
        let mut found: Vec<Self> = Vec::new();
        for triangle in 0..scene.triangle_count() {
            let shape = scene.shape_of(triangle);
            let Some(finish) = scene.material(triangle).finish(false) else { continue };
            if finish.is_pure_mirror() && found.iter().all(|m| m.shape != shape) {
                let on = scene.triangle(triangle).corners[0];
                let normal = scene.geometric_normal(triangle);
                found.push(Self { shape, on, normal, reflectance: finish.mirror });
            }
        }
        found
    }

    fn image(&self, p: Point) -> Point {
        p - self.normal * (2.0 * (p - self.on).dot(self.normal.to_vector()))
    }
}

/// All sequences of mirrors without the same one twice running, the empty one first.
fn sequences(mirrors: usize) -> Vec<Vec<usize>> {
    let mut all = vec![Vec::new()];
    let mut longest = vec![Vec::new()];
    for _ in 0..MOST_REFLECTIONS {
        longest = longest
            .iter()
            .flat_map(|sequence: &Vec<usize>| {
                (0..mirrors).filter(|m| sequence.last() != Some(m)).map(|m| {
                    let mut longer = sequence.clone();
                    longer.push(m);
                    longer
                })
            })
            .collect();
        all.extend(longest.iter().cloned());
    }
    all
}

/// Light of one luminaire by way of these mirrors, in the order in which light meets them.
fn by_way_of(scene: &Scene, luminaire: &Luminaire, way: &[&Mirror], at: ProbePoint) -> Rgb {
    let LuminaireKind::Point { position, world_from_luminaire, intensity, .. } = &luminaire.kind
    else {
        return if way.is_empty() { parallel(scene, luminaire, at) } else { Rgb::BLACK };
    };
    let mut target = way.iter().fold(*position, |p, mirror| mirror.image(p));
    let d = target - at.position;
    let cos = d.dot(at.normal.to_vector()) / d.length();
    if cos <= 0.0 {
        return Rgb::BLACK;
    }
    let (mut from, mut normal, mut share) = (at.position, at.normal, Rgb::WHITE);
    for mirror in way.iter().rev() {
        let start = scene.bvh().offset_origin(from, normal);
        let ray = Ray::between(start, target).up_to(f32::INFINITY);
        let Some(hit) = scene.bvh().closest_hit(&ray) else { return Rgb::BLACK };
        if scene.shape_of(hit.triangle) != mirror.shape || hit.back {
            return Rgb::BLACK;
        }
        (from, normal) = (scene.hit_point(&hit), mirror.normal);
        target = mirror.image(target);
        share = share * mirror.reflectance;
    }
    if scene.bvh().any_hit(&Ray::between(scene.bvh().offset_origin(from, normal), target)) {
        return Rgb::BLACK;
    }
    let local = world_from_luminaire.inverse().expect("a rotation").vector(from - target);
    let cd = intensity.intensity_cd(local.direction().expect("apart"));
    luminaire.colour * share * (cd * cos / d.length_squared())
}

fn parallel(scene: &Scene, luminaire: &Luminaire, at: ProbePoint) -> Rgb {
    let LuminaireKind::Directional { direction, illuminance_lx, .. } = luminaire.kind else {
        return Rgb::BLACK;
    };
    let ray = Ray::new(scene.bvh().offset_origin(at.position, at.normal), -direction);
    let cos = -direction.cos(at.normal);
    let lit = cos > 0.0 && !scene.bvh().any_hit(&ray);
    if lit { luminaire.colour * (illuminance_lx * cos) } else { Rgb::BLACK }
}

/// Emitting triangles that face the place, all of them in full view.
fn from_surfaces(scene: &Scene, at: ProbePoint) -> Rgb {
    let lit_by = |triangle: u32, luminance: Rgb| {
        let corners = scene.triangle(triangle).corners;
        let faces = (at.position - corners[0]).dot(scene.geometric_normal(triangle).to_vector());
        let shape = if faces > 0.0 { 1.0 } else { 0.0 };
        luminance * (shape * polygon_illuminance_lx(1.0, &corners, at.position, at.normal))
    };
    scene
        .area_luminaires()
        .iter()
        .flat_map(|area| area.triangles.iter().map(|&t| lit_by(t, area.luminance_cd_m2)))
        .sum()
}

fn direct_lx(scene: &Scene, at: ProbePoint) -> Rgb {
    let mirrors = Mirror::all(scene);
    let ways = sequences(mirrors.len());
    let points = scene.luminaires().iter().flat_map(|luminaire| {
        ways.iter().map(|way| {
            let way: Vec<&Mirror> = way.iter().map(|&m| &mirrors[m]).collect();
            by_way_of(scene, luminaire, &way, at)
        })
    });
    points.sum::<Rgb>() + from_surfaces(scene, at)
}

fn check(case: &Case) {
    let scene = Scene::assemble((case.parts)()).expect("a scene");
    for e in (case.expectations)().iter().filter(|e| e.quantity == Quantity::Direct) {
        // A place on an edge is on two faces; its own is meant. Rays start a hair inside.
        let inside = e.at.position + inwards(&scene, e.at.position) * 1e-7;
        let found = direct_lx(&scene, ProbePoint { position: inside, ..e.at });
        let off = (found - e.expected_lx).map(f64::abs).max_channel();
        let allowed = e.bound.lx + RAY_KERNEL_POSITION * e.expected_lx.max_channel();
        assert!(off <= allowed, "{} {:?}: {found:?}, not {:?}", case.name, e.at, e.expected_lx);
    }
}

/// Towards the middle of the scene, where that matters.
fn inwards(scene: &Scene, from: Point) -> Vector {
    let (low, high) = scene.bvh().mesh().bounds().expect("triangles");
    low.lerp(high, 0.5) - from
}

#[test]
fn direct_light_is_what_rays_find() {
    // Glass is not traced here, in furnaces everything hides everything, and most of a sky is hidden by the
    // room that has an opening to it: that is tested beside those cases, and by the path tracer.
    let traced = |case: &&Case| {
        let has_glass = (case.parts)().materials.iter().any(|m| m.finish(false).is_none());
        let is_sky = |l: &Luminaire| matches!(l.kind, LuminaireKind::Sky { .. });
        let has_sky = (case.parts)().shapes.iter().any(|s| s.name == "sky")
            || (case.parts)().luminaires.iter().any(is_sky);
        !has_glass && !has_sky && !case.name.starts_with("furnace")
    };
    let all = cases();
    assert!(all.iter().filter(traced).count() >= 18);
    all.iter().filter(traced).for_each(check);
}
