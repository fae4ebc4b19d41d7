//! Luminaires that light nothing.

use super::around::{all_around, extent_m};
use super::finding::Finding;
use super::outside::is_outside;
use isolux::geometry::{Direction, Point, Ray, Vector};
use isolux::scene::{Body, Finish, Luminaire, LuminaireKind, Material, Scene};
use isolux_formats::counted;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Findings shown one by one; more are counted.
const MAX_SHOWN: usize = 10;

/// How long luminaires are looked at: a hundred thousand of them take less.
const PATIENCE: Duration = Duration::from_secs(2);

/// A luminaire that sees nothing beyond this share of the scene is shut in, and nothing beyond so many metres: rooms are larger,
/// however large what is around them.
const SHUT_IN_SHARE: f64 = 0.02;
const SHUT_IN_M: f64 = 0.3;

/// One that sees backs alone, none beyond this share of the scene, and so many metres, is inside a solid.
const INSIDE_SHARE: f64 = 0.1;
const INSIDE_M: f64 = 1.5;

/// The share of its light that may go farther all the same.
const LEAKS: f64 = 0.05;

/// Rays of parallel light each way.
const PARALLEL: usize = 48;

/// Reflections from mirror to mirror that are followed.
const REFLECTIONS: usize = 64;

/// What is the matter with a luminaire.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Trouble {
    NoFlux,
    LightsNothing,
    LightsBlackBacks,
    LightsMirrorsAlone,
    ShutIn,
    ShutOut,
    Outside,
}

/// What a luminaire sees in one direction.
struct Seen {
    back: bool,
    black_back: bool,
    /// It comes to no other surface, as far as it was followed.
    mirrors_alone: bool,
    clear: bool,
    distance_m: f64,
}

pub(super) fn findings(scene: &Scene) -> Vec<Finding> {
    let (started, unseen) = (Instant::now(), AtomicUsize::new(0));
    let look = |luminaire| {
        if started.elapsed() > PATIENCE {
            unseen.fetch_add(1, Ordering::Relaxed);
            return None;
        }
        Some((luminaire, trouble(scene, luminaire)?))
    };
    let troubled: Vec<(&Luminaire, Trouble)> =
        scene.luminaires().par_iter().filter_map(look).collect();
    let mut found: Vec<Finding> =
        troubled.iter().take(MAX_SHOWN).map(|(l, trouble)| finding(l, *trouble)).collect();
    if troubled.len() > MAX_SHOWN {
        let more = format!("{} more luminaires in trouble", troubled.len() - MAX_SHOWN);
        found.push(Finding::warning("luminaires", more, "mend the first ones and check again"));
    }
    let unseen = unseen.into_inner();
    if unseen > 0 {
        let what =
            counted(unseen as u64, "luminaire was not looked at", "luminaires were not looked at");
        found.push(Finding::note("luminaires", what, "there are too many for a quick look"));
    }
    found
}

fn trouble(scene: &Scene, luminaire: &Luminaire) -> Option<Trouble> {
    let (position, world_from_luminaire, intensity) = match &luminaire.kind {
        LuminaireKind::Point { position, world_from_luminaire, intensity, .. } => {
            (position, world_from_luminaire, intensity)
        }
        LuminaireKind::Directional { direction, .. } => {
            return is_shut_out(scene, *direction).then_some(Trouble::ShutOut);
        }
        LuminaireKind::Sky { .. } => return None,
    };
    if intensity.luminous_flux_lm() <= 0.0 {
        return Some(Trouble::NoFlux);
    }
    let beam = |local: Direction| {
        let light_cd = intensity.intensity_cd(local);
        let direction = world_from_luminaire.vector(local.to_vector()).direction()?;
        (light_cd > 0.0).then_some((light_cd, direction))
    };
    let beams: Vec<(f64, Direction)> = all_around().into_iter().filter_map(beam).collect();
    let all_cd: f64 = beams.iter().map(|(light_cd, _)| light_cd).sum();
    let extent_m = extent_m(scene);
    let is_close = |s: &Seen| {
        let (share, most_m) =
            if s.back { (INSIDE_SHARE, INSIDE_M) } else { (SHUT_IN_SHARE, SHUT_IN_M) };
        !s.clear && s.distance_m < most_m.min(share * extent_m)
    };
    let mut looks = Vec::new();
    let (mut far_cd, mut lights_some) = (0.0, false);
    for (light_cd, direction) in beams {
        let seen = look(scene, *position, direction);
        far_cd += if seen.as_ref().is_some_and(is_close) { 0.0 } else { light_cd };
        lights_some |= seen.as_ref().is_some_and(|s| !s.back && !s.mirrors_alone);
        // Most luminaires are seen to be right by a few beams.
        if lights_some && far_cd > LEAKS * all_cd {
            return None;
        }
        looks.push(seen);
    }
    let seen = || looks.iter().flatten();
    // What shines down on a desk just below is open above.
    let is_shut_in = || {
        all_around().into_iter().all(|local| {
            let direction = world_from_luminaire.vector(local.to_vector()).direction();
            let seen = direction.and_then(|direction| look(scene, *position, direction));
            seen.as_ref().is_some_and(is_close)
        })
    };
    // A beam narrower than the directions tried is left alone.
    if looks.is_empty() {
        None
    } else if seen().next().is_none() {
        Some(Trouble::LightsNothing)
    } else if seen().all(|s| s.black_back) {
        Some(Trouble::LightsBlackBacks)
    } else if seen().all(|s| s.back) && is_outside(scene, luminaire) {
        Some(Trouble::Outside)
    } else if looks.iter().all(|seen| seen.as_ref().is_some_and(|s| s.mirrors_alone)) {
        Some(Trouble::LightsMirrorsAlone)
    } else if far_cd <= LEAKS * all_cd && is_shut_in() {
        Some(Trouble::ShutIn)
    } else {
        None
    }
}

/// Whether parallel light comes to nothing but black backs and what shines itself, as a box does that stands for the sky.
fn is_shut_out(scene: &Scene, direction: Direction) -> bool {
    let Some((low, high)) = scene.bvh().mesh().bounds() else { return false };
    let (centre, radius_m) = (low + (high - low) * 0.5, 0.5 * (high - low).length());
    let at = |k: usize| ((k as f64 + 0.5) / PARALLEL as f64 * 2.0 - 1.0) * radius_m;
    let [u, v] = [Vector::new(1.0, 0.0, 0.0), Vector::new(0.0, 1.0, 0.0)]
        .map(|local| direction.from_local(local).to_vector());
    let met = |k: usize| {
        let across = u * at(k % PARALLEL) + v * at(k / PARALLEL);
        let from = centre + across - direction.to_vector() * (2.0 * radius_m);
        scene.bvh().closest_hit(&Ray::new(from, direction))
    };
    let shuts_out = |triangle: u32, back: bool| {
        let material = scene.material(triangle);
        let shines =
            [false, true].map(|side| material.finish(side).is_some_and(Finish::is_emitter));
        shines.contains(&true) || back && has_black_back(material)
    };
    let mut hits = (0..PARALLEL * PARALLEL).filter_map(met).peekable();
    hits.peek().is_some() && hits.all(|hit| shuts_out(hit.triangle, hit.back))
}

/// The first surface in a direction.
fn look(scene: &Scene, from: Point, direction: Direction) -> Option<Seen> {
    let hit = scene.bvh().closest_hit(&Ray::new(from, direction))?;
    let material = scene.material(hit.triangle);
    let is_mirror = material.finish(hit.back).is_some_and(Finish::is_pure_mirror);
    let mirrors_alone = is_mirror && ends_among_mirrors(scene, from, direction);
    Some(Seen {
        back: hit.back,
        black_back: hit.back && has_black_back(material),
        mirrors_alone,
        clear: matches!(material.body, Body::Dielectric(_)),
        distance_m: f64::from(hit.t),
    })
}

fn has_black_back(material: &Material) -> bool {
    material.finish(true).is_some_and(|back| *back == Finish::BLACK)
}

/// Whether light that goes that way comes to mirrors again and again.
fn ends_among_mirrors(scene: &Scene, mut from: Point, mut direction: Direction) -> bool {
    for _ in 0..REFLECTIONS {
        let Some(hit) = scene.bvh().closest_hit(&Ray::new(from, direction)) else { return false };
        let finish = scene.material(hit.triangle).finish(hit.back);
        if !finish.is_some_and(Finish::is_pure_mirror) {
            return false;
        }
        let (way, normal) =
            (direction.to_vector(), scene.geometric_normal(hit.triangle).to_vector());
        let Some(reflected) = (way - normal * (2.0 * way.dot(normal))).direction() else {
            return false;
        };
        // A little before the surface.
        from = from + way * (f64::from(hit.t) * (1.0 - 1e-5));
        direction = reflected;
    }
    true
}

fn finding(luminaire: &Luminaire, trouble: Trouble) -> Finding {
    let (what, remedy) = match trouble {
        Trouble::NoFlux => ("gives no light", "raise its intensity or its dimming, or remove it"),
        Trouble::LightsNothing => ("lights no surface", "check its position and its aim"),
        Trouble::ShutIn => (
            "is shut in on all sides close to it",
            "it is inside a solid: move it out, or open its housing",
        ),
        Trouble::LightsMirrorsAlone => (
            "lights mirrors alone",
            "what reflects light again and again lights nothing else: open the box of mirrors, or give a side of it a \
             diffuse reflectance",
        ),
        Trouble::ShutOut => (
            "reaches only black backs and emitting surfaces",
            "what stands for the sky keeps the sun out: leave it open on that side, or away",
        ),
        Trouble::Outside => (
            "lights only the outside of closed rooms",
            "it lies outside: move it in, or give the room an opening; check `up` and units where it should be inside",
        ),
        Trouble::LightsBlackBacks => (
            "lights only backs of one-sided surfaces",
            "it is inside a solid or outside of the room, or the surfaces around it are turned inside out: move it or \
             flip them",
        ),
    };
    Finding::warning(format!("luminaire `{}`", luminaire.name), what, remedy)
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::geometry::Transform;
    use isolux::photometry::IntensityDistribution;
    use isolux::scene::{SceneParts, Shape};
    use isolux::units::Rgb;

    /// A closed cube around the origin, seen from inside or outside.
    fn cube(half: f64, inwards: bool) -> Shape {
        let corner = |k: u32| [0, 1, 2].map(|axis| if k >> axis & 1 == 1 { half } else { -half });
        let faces =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let turn = |[a, b, c]: [u32; 3]| if inwards { [a, c, b] } else { [a, b, c] };
        Shape {
            positions: (0..8).map(corner).collect(),
            triangles: faces
                .into_iter()
                .flat_map(|[a, b, c, d]| [turn([a, b, c]), turn([a, c, d])])
                .collect(),
            ..Shape::default()
        }
    }

    #[test]
    fn a_sun_outside_of_a_luminous_sky_is_told_of() {
        let sky = Finish { luminance_cd_m2: Rgb::grey(4000.0), ..Finish::BLACK };
        let materials = vec![
            Material::one_sided("ground", Finish::diffuse(Rgb::grey(0.2))),
            Material::one_sided("sky", sky),
        ];
        let shapes =
            |sky_half: f64| vec![cube(1.0, false), Shape { material: 1, ..cube(sky_half, true) }];
        let direction = Vector::new(0.3, 0.2, -0.9).direction().unwrap();
        let kind =
            LuminaireKind::Directional { direction, illuminance_lx: 7e4, half_angle_rad: 0.0 };
        let sun = Luminaire { name: "sun".into(), group: 0, colour: Rgb::WHITE, kind };
        let trouble_of = |sky_half: f64| {
            let (materials, luminaires) = (materials.clone(), vec![sun.clone()]);
            let shapes = shapes(sky_half);
            let parts = SceneParts { shapes, materials, luminaires, ..SceneParts::default() };
            trouble(&Scene::assemble(parts).unwrap(), &sun)
        };
        assert_eq!(trouble_of(5.0), Some(Trouble::ShutOut));
        // A luminous box inside of the other.
        assert_eq!(trouble_of(0.5), None);
    }

    fn trouble_of(shapes: Vec<Shape>, intensity_cd: f64, two_sided: bool) -> Option<Trouble> {
        let finish = Finish::diffuse(Rgb::grey(0.5));
        let material = if two_sided {
            Material::two_sided("wall", finish)
        } else {
            Material::one_sided("wall", finish)
        };
        trouble_among(shapes, material, intensity_cd)
    }

    fn trouble_among(shapes: Vec<Shape>, material: Material, intensity_cd: f64) -> Option<Trouble> {
        trouble_with(shapes, material, IntensityDistribution::Isotropic { intensity_cd })
    }

    fn trouble_with(
        shapes: Vec<Shape>,
        material: Material,
        intensity: IntensityDistribution,
    ) -> Option<Trouble> {
        let luminaire = Luminaire {
            name: "lamp".into(),
            group: 0,
            colour: Rgb::WHITE,
            kind: LuminaireKind::Point {
                position: Point::ORIGIN,
                world_from_luminaire: Transform::IDENTITY,
                intensity,
                area: None,
            },
        };
        let luminaires = vec![luminaire];
        let parts =
            SceneParts { shapes, materials: vec![material], luminaires, ..SceneParts::default() };
        let scene = Scene::assemble(parts).unwrap();
        trouble(&scene, &scene.luminaires()[0])
    }

    #[test]
    fn a_box_of_mirrors_lets_no_light_out() {
        let mirror =
            || Material::two_sided("mirror", Finish { mirror: Rgb::grey(0.9), ..Finish::BLACK });
        let found = trouble_among(vec![cube(5.0, true)], mirror(), 1.0);
        assert_eq!(found, Some(Trouble::LightsMirrorsAlone));
        let mut open = cube(5.0, true);
        open.triangles.truncate(10);
        assert_eq!(trouble_among(vec![open], mirror(), 1.0), None);
    }

    #[test]
    fn what_shines_on_a_desk_just_below_is_not_shut_in() {
        let desk = Shape {
            positions: [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
                .map(|[x, y]| [x, y, -0.1])
                .into(),
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..Shape::default()
        };
        let material = Material::two_sided("wood", Finish::diffuse(Rgb::grey(0.5)));
        let down = IntensityDistribution::CosinePower { peak_cd: 1.0, exponent: 1.0 };
        assert_eq!(trouble_with(vec![cube(5.0, true), desk], material, down), None);
    }

    #[test]
    fn luminaires_in_trouble_are_told_apart() {
        let room = || cube(5.0, true);
        let far = || Shape {
            positions: vec![[9.0, 9.0, 9.0], [9.1, 9.0, 9.0], [9.0, 9.1, 9.0]],
            triangles: vec![[0, 1, 2]],
            ..Shape::default()
        };
        let moved = |mut shape: Shape, x: f64| {
            shape.positions.iter_mut().for_each(|p| p[0] += x);
            shape
        };
        let open = |mut shape: Shape| {
            shape.triangles.truncate(11);
            shape
        };
        let ground = || Shape {
            positions: vec![[-90.0, -90.0, -5.0], [90.0, -90.0, -5.0], [0.0, 180.0, -5.0]],
            triangles: vec![[0, 1, 2]],
            ..Shape::default()
        };
        for (shapes, intensity_cd, two_sided, expected) in [
            (vec![room()], 1.0, false, None),
            (vec![room()], 0.0, false, Some(Trouble::NoFlux)),
            (vec![cube(5.0, false)], 1.0, false, Some(Trouble::LightsBlackBacks)),
            (vec![room(), cube(0.1, false)], 1.0, false, Some(Trouble::LightsBlackBacks)),
            (vec![room(), cube(0.1, false)], 1.0, true, Some(Trouble::ShutIn)),
            (vec![room(), cube(0.7, false)], 1.0, true, Some(Trouble::ShutIn)),
            (vec![room(), cube(0.7, true)], 1.0, true, None),
            (vec![room(), cube(1e4, true)], 1.0, true, None),
            (vec![room(), cube(1e4, false)], 1.0, true, None),
            (vec![far()], 1.0, true, Some(Trouble::LightsNothing)),
            // The luminaire is beside the room.
            (vec![moved(room(), 5.5)], 1.0, true, Some(Trouble::Outside)),
            (vec![moved(room(), 5.5)], 1.0, false, Some(Trouble::LightsBlackBacks)),
            (
                vec![moved(room(), 5.5), moved(cube(1.0, false), 8.0)],
                1.0,
                true,
                Some(Trouble::Outside),
            ),
            // Of a solid it lights what there is to light, and a room with a window it may light inside.
            (vec![moved(cube(5.0, false), 5.5)], 1.0, true, None),
            (vec![moved(open(room()), 5.5)], 1.0, true, None),
            (vec![moved(room(), 5.5), ground()], 1.0, true, None),
        ] {
            assert_eq!(trouble_of(shapes, intensity_cd, two_sided), expected);
        }
    }
}
