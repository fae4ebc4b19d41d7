//! Views from a solved map beside readings of it.
#![allow(clippy::unwrap_used, reason = "tests may stop at the first surprise")]

use isolux::elements::PlaceOnSide;
use isolux::engine::{
    ExactSettings, MapReader, PictureLight, ProbePoint, ShadowRays, SolveRequest, Watch, solve,
};
use isolux::geometry::{Direction, Point, Transform, Vector};
use isolux::map::Fresh;
use isolux::photometry::IntensityDistribution;
use isolux::scene::{Camera, Finish, Luminaire, LuminaireKind, Material, Scene, SceneParts, Shape};
use isolux::units::Rgb;
use isolux_view::*;

/// A rectangle from a corner along two edges; its front is towards their vector product.
fn rectangle(corner: [f64; 3], along: [f64; 3], up: [f64; 3]) -> Shape {
    let [p, a, b] = [corner, along, up].map(Vector::from);
    Shape {
        positions: [p, p + a, p + a + b, p + b].map(<[f64; 3]>::from).to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Shape::default()
    }
}

/// The faces of a box, fronts inside, or outside.
fn cuboid(low: [f64; 3], size: [f64; 3], inward: bool) -> Vec<Shape> {
    let [x, y, z] = [0, 1, 2].map(|k| {
        let mut edge = [0.0; 3];
        edge[k] = size[k];
        edge
    });
    let far = |k: usize| {
        let mut corner = low;
        corner[k] += size[k];
        corner
    };
    let faces =
        [(low, x, y), (low, y, z), (low, z, x), (far(0), z, y), (far(1), x, z), (far(2), y, x)];
    let face =
        |(corner, a, b)| if inward { rectangle(corner, a, b) } else { rectangle(corner, b, a) };
    faces.map(face).into()
}

/// A room with a block that turns its back on the lamp, and a camera that looks at its foot.
fn room() -> (Scene, Camera) {
    let direction = Vector::new(0.1, 1.0, -0.6).direction().unwrap();
    room_with(cuboid([1.4, 1.4, 0.0], [1.2, 0.8, 1.6], false), direction)
}

fn room_with(block: Vec<Shape>, direction: Direction) -> (Scene, Camera) {
    let mut shapes = cuboid([0.0; 3], [4.0, 4.0, 3.0], true);
    shapes.extend(block);
    let parts = SceneParts {
        shapes,
        materials: vec![Material::one_sided("grey", Finish::diffuse(Rgb::grey(0.6)))],
        luminaires: vec![Luminaire {
            name: "lamp".into(),
            group: 0,
            colour: Rgb::WHITE,
            kind: LuminaireKind::Point {
                position: Point::new(2.0, 2.9, 2.8),
                world_from_luminaire: Transform::IDENTITY,
                intensity: IntensityDistribution::Isotropic { intensity_cd: 200.0 },
                area: None,
            },
        }],
        ..SceneParts::default()
    };
    let position = Point::new(1.9, 0.05, 1.3);
    let camera = Camera {
        name: "camera".into(),
        position,
        direction,
        up: Direction::Z,
        vertical_fov_rad: 1.2,
    };
    (Scene::assemble(parts).unwrap(), camera)
}

/// The light of the surfaces that pixels show, gathered there with many rays, lx.
fn truth(image: &LuminanceImage, reader: &MapReader<'_>) -> Vec<(usize, f64)> {
    let settings = ExactSettings { rays: 128, ..ExactSettings::default() };
    let pixels = (0..image.size().pixels()).step_by(61);
    pixels
        .filter_map(|pixel| {
            let surface = image.surface(pixel)?;
            let at = ProbePoint { position: surface.position, normal: surface.normal };
            Some((pixel, reader.estimate(at, &settings).illuminance_lx()))
        })
        .collect()
}

/// Root mean square of how far pixels are off, as a share of the light.
fn off(image: &LuminanceImage, truth: &[(usize, f64)], of: impl Fn(usize, f64) -> bool) -> f64 {
    let all = truth.iter().filter(|&&(pixel, lx)| of(pixel, lx));
    let (sum, count) = all.fold((0.0, 0.0), |(sum, count), &(pixel, lx)| {
        (sum + share_off(image, pixel, lx).powi(2), count + 1.0)
    });
    assert!(count >= 20.0, "{count} pixels");
    f64::sqrt(sum / count)
}

fn share_off(image: &LuminanceImage, pixel: usize, lx: f64) -> f64 {
    f64::from(image.reading(pixel).unwrap().illuminance_lx) / lx - 1.0
}

#[test]
fn light_is_gathered_where_the_map_is_not_to_be_trusted() {
    let (scene, camera) = room();
    let request = SolveRequest { accuracy: Some(0.05), ..SolveRequest::default() };
    let mut map = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap().map;
    // One that is as good as this may be trusted; here it is not where its elements err by more than a hundredth of the light.
    let fresh = map.provenance.fresh.unwrap();
    map.provenance.fresh = Some(Fresh { above_lx: Some(1.0), in_gaps_alone: false, ..fresh });
    let reader = MapReader::new(&scene, &map);
    let (size, settings) = (Size::new(320, 240).unwrap(), TraceSettings::DRAFT);
    let (view, gathered) =
        MapViewer::new(&scene, &map).trace(&camera, size, (&settings, &mut |_| {})).unwrap();
    let read = |at: SurfacePoint| {
        let place = PlaceOnSide { triangle: at.triangle, back: at.back, uv: [at.u, at.v] };
        let rays = ShadowRays { fewest: 4, most: 32 };
        reader.glance(place, (0, rays), PictureLight::default())
    };
    let interpolated = trace(&scene, &camera, size, &settings, &read).unwrap();
    let truth = truth(&view, &reader);
    // The foot of the block, and what else interpolation gets wrong: gathered light is twice as near there at least. How far
    // off it is itself goes by the light of the whole room, and these places are dark.
    let is_wrong = |pixel, lx| share_off(&interpolated, pixel, lx).abs() > 0.1;
    let [by_view, by_interpolation] = [&view, &interpolated].map(|i| off(i, &truth, is_wrong));
    assert!(by_interpolation > 0.15);
    assert!(by_view < 0.5 * by_interpolation, "{by_view} and {by_interpolation}");
    let [of_view, of_interpolated] = [&view, &interpolated].map(|i| off(i, &truth, |_, _| true));
    assert!(of_view < of_interpolated, "{of_view} and {of_interpolated}");
    let Gathered { interpolated, gathered, continued } = gathered;
    assert_eq!(interpolated + gathered + continued, size.pixels());
    assert!(continued > 4 * gathered && gathered > 0, "{gathered} and {continued}");
    // A window of it is the same view, by the random numbers of another round.
    let viewer = MapViewer::new(&scene, &map);
    let (left, top) = (96, 64);
    let window = Some(Window { of: size, left, top });
    let own = Size::new(128, 96).unwrap();
    let inside = TraceSettings { window, ..settings };
    let (part, _) = viewer.trace(&camera, own, (&inside, &mut |_| {})).unwrap();
    let next = TraceSettings { round: 1, ..inside };
    let (other, _) = viewer.trace(&camera, own, (&next, &mut |_| {})).unwrap();
    assert!(part != other);
    for y in 0..own.height() {
        for x in 0..own.width() {
            let pixel = ((top + y) * size.width() + left + x) as usize;
            let within = (y * own.width() + x) as usize;
            assert_eq!(part.surface(within), view.surface(pixel));
            assert_eq!(other.surface(within), view.surface(pixel));
        }
    }
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let again =
        || MapViewer::new(&scene, &map).trace(&camera, size, (&settings, &mut |_| {})).unwrap().0;
    assert!(alone.install(again) == view, "the same on any number of threads");
}

#[test]
fn a_gap_in_the_middle_of_a_pixel_does_not_darken_what_the_pixel_shows_before_it() {
    // A beam that ends two millimetres below the ceiling: less than a pixel.
    let beam = cuboid([0.3, 1.9, 2.6], [3.4, 0.3, 0.398], false);
    let (scene, camera) = room_with(beam, Vector::new(0.5, 1.85, 0.6).direction().unwrap());
    let position = Point::new(1.9, 0.05, 2.4);
    let camera = Camera { position, vertical_fov_rad: 0.3, ..camera };
    let request = SolveRequest { accuracy: Some(0.02), ..SolveRequest::default() };
    let map = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap().map;
    let reader = MapReader::new(&scene, &map);
    let (size, settings) = (Size::new(128, 48).unwrap(), TraceSettings::FINE);
    let (view, _) =
        MapViewer::new(&scene, &map).trace(&camera, size, (&settings, &mut |_| {})).unwrap();
    let few = ExactSettings { rays: 16, replicates: 4, ..ExactSettings::default() };
    let read = |at: SurfacePoint| {
        let front = scene.geometric_normal(at.triangle);
        let normal = if at.back { -front } else { front };
        let position = scene.triangle(at.triangle).point(at.u, at.v);
        Some(reader.estimate(ProbePoint { position, normal }, &few))
    };
    let by_readings = trace(&scene, &camera, size, &settings, &read).unwrap();
    let share = |pixel: usize| {
        view.luminance_cd_m2(pixel).luminance() / by_readings.luminance_cd_m2(pixel).luminance()
    };
    // Noise of readings takes up to a tenth; the gap, where it stood for its pixel, took a third.
    let darkened = (0..size.pixels()).filter(|&pixel| share(pixel) < 0.85).count();
    assert_eq!(darkened, 0, "pixels of {}", size.pixels());
}

/// A room with a ceiling panel and a pole between it and the floor, and the camera of a visitor.
fn room_with_panel(pole: Vec<Shape>) -> (Scene, Camera) {
    let mut shapes = cuboid([0.0; 3], [4.0, 4.0, 3.0], true);
    shapes.extend(pole);
    let panel = rectangle([1.7, 1.7, 2.9], [0.0, 0.6, 0.0], [0.6, 0.0, 0.0]);
    shapes.push(Shape { material: 1, ..panel });
    let lamp = Finish { luminance_cd_m2: Rgb::grey(2000.0), ..Finish::BLACK };
    let parts = SceneParts {
        shapes,
        materials: vec![
            // Dark, so that nearly all light is direct.
            Material::one_sided("dark", Finish::diffuse(Rgb::grey(0.02))),
            Material::one_sided("panel", lamp),
        ],
        ..SceneParts::default()
    };
    let camera = Camera {
        name: "camera".into(),
        position: Point::new(0.3, 0.3, 1.6),
        direction: Vector::new(1.0, 1.0, -0.7).direction().unwrap(),
        up: Direction::Z,
        vertical_fov_rad: 1.0,
    };
    (Scene::assemble(parts).unwrap(), camera)
}

/// What the light of pixels on the floor is off by, as a share of its mean: root mean square, and what one in 200 exceeds.
/// (The middle of a pixel may miss a shadow that is narrower than the pixel.)
fn direct_off(scene: &Scene, camera: &Camera) -> [f64; 2] {
    let request = SolveRequest { accuracy: Some(0.05), ..SolveRequest::default() };
    let map = solve(scene, &request, None, &mut |_| Watch::Continue).unwrap().map;
    let reader = MapReader::new(scene, &map);
    let (size, settings) = (Size::new(192, 108).unwrap(), TraceSettings::FINE);
    let many = ShadowRays { fewest: 256, most: 256 };
    let read = |at: SurfacePoint| {
        let place = PlaceOnSide { triangle: at.triangle, back: at.back, uv: [at.u, at.v] };
        reader.glance(place, (1, many), PictureLight::default())
    };
    let truth = trace(scene, camera, size, &settings, &read).unwrap();
    let (view, _) =
        MapViewer::new(scene, &map).trace(camera, size, (&settings, &mut |_| {})).unwrap();
    let is_floor =
        |pixel: usize| truth.surface(pixel).is_some_and(|surface| surface.position.z.abs() < 1e-9);
    // A pixel whose middle and most cells show the floor.
    let is_within = |pixel: usize| {
        let width = size.width() as usize;
        [pixel, pixel + 1, pixel.wrapping_sub(1), pixel + width, pixel.wrapping_sub(width)]
            .iter()
            .all(|&near| near < size.pixels() && is_floor(near))
    };
    let lx = |image: &LuminanceImage, pixel: usize| {
        f64::from(image.reading(pixel).unwrap().illuminance_lx)
    };
    let floor: Vec<usize> = (0..size.pixels()).filter(|&pixel| is_within(pixel)).collect();
    assert!(floor.len() > 2000, "{} pixels", floor.len());
    let mean_lx = floor.iter().map(|&pixel| lx(&truth, pixel)).sum::<f64>() / floor.len() as f64;
    let one_off = |&pixel: &usize| (lx(&view, pixel) - lx(&truth, pixel)).abs() / mean_lx;
    let mut off: Vec<f64> = floor.iter().map(one_off).collect();
    let square = off.iter().map(|off| off * off).sum::<f64>() / off.len() as f64;
    off.sort_unstable_by(f64::total_cmp);
    [square.sqrt(), off[off.len() - off.len() / 200]]
}

#[test]
fn half_shadows_are_smooth_with_few_rays() {
    let (scene, camera) = room_with_panel(cuboid([1.5, 1.5, 0.0], [0.5, 0.5, 1.0], false));
    let [off, most] = direct_off(&scene, &camera);
    // Steps of two per cent are just seen; the noise of 32 rays a pixel would be five.
    assert!(off < 0.01, "{off}");
    assert!(most < 0.08, "{most}");
}

#[test]
fn the_narrow_shadow_of_a_pole_is_followed_along_its_length() {
    let pole = cuboid([0.2, 2.4, 0.05], [3.6, 0.03, 0.03], false);
    let (scene, camera) = room_with_panel(pole);
    let [off, most] = direct_off(&scene, &camera);
    assert!(off < 0.015, "{off}");
    // Were a part of the shadow not found, its pixels would be brighter by a third.
    assert!(most < 0.1, "{most}");
}
