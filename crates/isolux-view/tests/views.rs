//! Whole pictures of rooms whose luminance is known.

use isolux::elements::{ElementArrays, Elements};
use isolux::geometry::{Direction, Point, Transform, Vector};
use isolux::map::{Illuminance, IlluminationMap, Method, Provenance, VertexLight};
use isolux::photometry::IntensityDistribution;
use isolux::scene::{
    Body, Camera, Coat, Dielectric, Finish, Gloss, Luminaire, LuminaireKind, Material, Scene,
    SceneParts, Shape,
};
use isolux::units::Rgb;
use isolux_view::*;
use std::f64::consts::{FRAC_PI_2, PI};

/// A luminance is stored in `f32` after a few dozen roundings in `f64`.
const STORED: f64 = 2.0 * f32::EPSILON as f64;

fn stored(total: f64) -> VertexLight {
    VertexLight { direct_lx: Rgb::grey(total), samples: 1, ..VertexLight::NOTHING }
}

fn lux(total: f64) -> Option<Illuminance> {
    Some(stored(total).into())
}

/// A rectangle from a corner along two edges; its front is towards their vector product.
fn rectangle(material: u32, corner: [f64; 3], along: [f64; 3], up: [f64; 3]) -> Shape {
    let [p, a, b] = [corner, along, up].map(Vector::from);
    Shape {
        positions: [p, p + a, p + a + b, p + b].map(<[f64; 3]>::from).to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        material,
        ..Shape::default()
    }
}

/// The six inner faces of the cube with corners at +-1, materials 0 to 5 in the order -x +x -y +y -z +z.
fn room(materials: [u32; 6]) -> Vec<Shape> {
    let (x, y, z) = ([2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]);
    let low = [-1.0; 3];
    let faces = [
        (low, y, z),
        ([1.0, -1.0, -1.0], z, y),
        (low, z, x),
        ([-1.0, 1.0, -1.0], x, z),
        (low, x, y),
        ([-1.0, -1.0, 1.0], y, x),
    ];
    let face = |(k, (corner, a, b)): (usize, _)| rectangle(materials[k], corner, a, b);
    faces.into_iter().enumerate().map(face).collect()
}

fn scene(shapes: Vec<Shape>, materials: Vec<Material>) -> Scene {
    Scene::assemble(SceneParts { shapes, materials, ..SceneParts::default() })
        .expect("a valid scene")
}

fn diffuse(reflectance: f64) -> Material {
    Material::one_sided("diffuse", Finish::diffuse(Rgb::grey(reflectance)))
}

/// From the centre towards +y, 90 degrees: only the face +y is in a square picture.
fn towards_y(position: Point) -> Camera {
    Camera {
        name: "camera".into(),
        position,
        direction: Direction::Y,
        up: Direction::Z,
        vertical_fov_rad: FRAC_PI_2,
    }
}

fn look(scene: &Scene, settings: &TraceSettings, total_lx: f64) -> LuminanceImage {
    let size = Size::new(16, 16).expect("a size");
    let camera = towards_y(Point::ORIGIN);
    trace(scene, &camera, size, settings, &|_| lux(total_lx)).expect("a view")
}

fn assert_luminance(image: &LuminanceImage, expected: f64) {
    for pixel in 0..image.size().pixels() {
        let got = image.luminance_cd_m2(pixel).luminance();
        assert!((got - expected).abs() <= STORED * expected, "{got} for {expected}");
    }
}

#[test]
fn a_diffuse_wall_shows_its_illuminance_over_pi() {
    let scene = scene(room([0; 6]), vec![diffuse(0.5)]);
    let image = look(&scene, &TraceSettings::FINE, 1000.0);
    assert_luminance(&image, 500.0 / PI);
    assert_eq!(image.reading(0).map(|r| r.illuminance_lx), Some(1000.0));
}

#[test]
fn specular_chains_have_their_closed_form() {
    let glossy = Gloss { f0: Rgb::grey(0.2), alpha: 1e-4 };
    let finish = Finish { gloss: Some(glossy), ..Finish::BLACK };
    let coat = Some(Coat { cover: 1.0, alpha: 1e-4 });
    let coated = Finish { coat, ..finish.clone() };
    let wall = 500.0 / PI;
    let lamp = Finish { luminance_cd_m2: Rgb::grey(40.0), ..Finish::diffuse(Rgb::grey(0.5)) };
    for (name, material, expected) in [
        ("mirror", Material::one_sided("m", Finish::mirror(Rgb::grey(0.8))), 0.8 * wall),
        ("emitter", Material::one_sided("m", lamp), wall + 40.0),
        ("black", Material::one_sided("m", Finish::BLACK), 0.0),
        // Seen within a degree of the normal, where Schlick's term adds less than rounding.
        ("narrow gloss", Material::one_sided("m", finish), 0.2 * wall),
        ("coat", Material::one_sided("m", Finish { coat, ..Finish::BLACK }), 0.04 * wall),
        // Twice through the coat, which reflects 0.04.
        ("both", Material::one_sided("m", coated), (0.04 + 0.96 * 0.96 * 0.2) * wall),
    ] {
        let scene = scene(room([0, 0, 0, 1, 0, 0]), vec![diffuse(0.5), material]);
        let camera = Camera { vertical_fov_rad: 0.01, ..towards_y(Point::ORIGIN) };
        let size = Size::new(4, 4).unwrap();
        let image = trace(&scene, &camera, size, &TraceSettings::FINE, &|_| lux(1000.0)).unwrap();
        let got = image.luminance_cd_m2(5).luminance();
        assert!((got - expected).abs() <= STORED * expected, "{name}: {got} for {expected}");
    }
}

#[test]
fn a_white_room_stays_white_behind_glass_and_gloss() {
    // In a room of one luminance everything that loses no light shows that luminance.
    let pane = Dielectric { ior: 1.5, transmittance: Rgb::WHITE, thin: true };
    let materials = vec![
        diffuse(0.5),
        Material { name: "pane".into(), body: Body::Dielectric(pane) },
        Material {
            name: "block".into(),
            body: Body::Dielectric(Dielectric { thin: false, ..pane }),
        },
    ];
    let mut shapes = room([0; 6]);
    shapes.push(rectangle(1, [-0.9, 0.5, -0.9], [1.8, 0.0, 0.0], [0.0, 0.0, 1.8]));
    let windowed = scene(shapes.clone(), materials.clone());
    // Branches below half a display step are left out.
    let image = look(&windowed, &TraceSettings { depth: 16, ..TraceSettings::FINE }, 1000.0);
    for pixel in 0..image.size().pixels() {
        let got = image.luminance_cd_m2(pixel).luminance() / (500.0 / PI);
        assert!((got - 1.0).abs() < 2.0 / 512.0, "{got}");
    }
    let reading = image.reading(120).map(|r| r.illuminance_lx);
    assert_eq!(reading, Some(1000.0), "lux are read through the pane");
}

#[test]
fn unknown_is_black_in_pictures_and_grey_in_charts() {
    let scene = scene(
        vec![rectangle(0, [-1.0, 1.0, -1.0], [1.0, 0.0, 0.0], [0.0, 0.0, 2.0])],
        vec![diffuse(0.5)],
    );
    let size = Size::new(16, 16).unwrap();
    let camera = towards_y(Point::ORIGIN);
    let image = trace(&scene, &camera, size, &TraceSettings::FINE, &|_| None).unwrap();
    let picture = develop(&image, &Development::default()).unwrap();
    assert_eq!((picture.pixel(2, 8), picture.pixel(12, 8)), (Some([0; 3]), Some([0; 3])));
    let chart = FalseColour { limits: Some((0.0, 1.0)), legend: None, ..FalseColour::default() };
    let chart = false_colour(&image, &chart).unwrap();
    assert_eq!((chart.pixel(2, 8), chart.pixel(12, 8)), (Some(UNKNOWN), Some([0; 3])));
    assert_eq!(
        false_colour(&image, &FalseColour::default()),
        Err(ViewError::NothingKnown),
        "limits cannot be chosen"
    );
}

#[test]
fn a_camera_outside_looks_through_black_backs_on_request() {
    let scene = scene(room([0; 6]), vec![diffuse(0.5)]);
    let outside = Camera { vertical_fov_rad: 0.2, ..towards_y(Point::new(0.0, -5.0, 0.0)) };
    let size = Size::new(8, 8).unwrap();
    for (through_black_backs, expected) in [(false, 0.0), (true, 500.0 / PI)] {
        let settings = TraceSettings { through_black_backs, ..TraceSettings::DRAFT };
        let image = trace(&scene, &outside, size, &settings, &|_| lux(1000.0)).unwrap();
        assert_luminance(&image, expected);
    }
}

#[test]
fn the_same_view_has_the_same_bits_on_any_number_of_threads() {
    let gloss = Gloss { f0: Rgb::grey(0.3), alpha: 0.3 };
    let finish = Finish { gloss: Some(gloss), ..Finish::diffuse(Rgb::grey(0.4)) };
    let scene =
        scene(room([0, 0, 0, 1, 0, 0]), vec![diffuse(0.5), Material::one_sided("glossy", finish)]);
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| look(&scene, &TraceSettings::FINE, 700.0))
    };
    assert_eq!(on(1), on(3));
}

/// A map over the face +y that rises from 0 lx at its lower edge to 400 lx at its upper.
fn rising_map(scene: &Scene) -> IlluminationMap {
    const NONE: u32 = u32::MAX;
    let mut arrays = ElementArrays::default();
    for triangle in 0..scene.triangle_count() {
        if scene.shape_of(triangle) != 3 {
            arrays.roots.push([NONE; 2]);
            continue;
        }
        let first = arrays.positions.len() as u32;
        arrays.roots.push([arrays.nodes.len() as u32, NONE]);
        arrays.nodes.push([first, first + 1, first + 2]);
        arrays.splits.push([NONE; 2]);
        for corner in scene.triangle(triangle).corners {
            arrays.positions.push(corner.into());
            arrays.normals.push([0.0, -1.0, 0.0]);
            arrays.parents.push([NONE; 2]);
            arrays.areas_m2.push(1.0);
        }
    }
    let values = arrays.positions.iter().map(|p| Some(stored(200.0 * (p[2] + 1.0)))).collect();
    IlluminationMap {
        elements: Elements::from_arrays(&arrays).expect("elements"),
        values,
        provenance: Provenance {
            scene: "room".into(),
            scene_hash: String::new(),
            version: String::new(),
            method: Method::Hybrid,
            seed: 1,
            increments: 1,
            rays: 0,
            accuracy_target: None,
            fresh: None,
            filter: None,
            unshot: None,
            diffuse_only: false,
            audit: None,
            mixed: Vec::new(),
            complete: true,
            accuracy: None,
        },
    }
}

#[test]
fn a_chart_of_a_rising_map_has_level_bands_and_lines() {
    let scene = scene(room([0; 6]), vec![diffuse(0.5)]);
    let map = rising_map(&scene);
    let read = |p: SurfacePoint| map.interpolate(p.triangle, p.back, p.u, p.v);
    let size = Size::new(64, 64).unwrap();
    let camera = towards_y(Point::ORIGIN);
    let image = trace(&scene, &camera, size, &TraceSettings::DRAFT, &read).unwrap();
    // Row 16 of 64 looks at a quarter of the height from the top, plus half a pixel.
    let expected = 400.0 * (1.0 - 16.5 / 64.0);
    let got = f64::from(image.reading(16 * 64 + 30).unwrap().illuminance_lx);
    assert!((got - expected).abs() < 1e-4 * expected, "{got}");

    // 401 is prime: no pixel lies on the border of two colours.
    let limits = Some((0.0, 401.0));
    let chart = FalseColour { legend: None, limits, ..FalseColour::default() };
    let bands = false_colour(&image, &chart).unwrap();
    let rows_level = bands.rgb.chunks(64).all(|row| row.iter().all(|c| *c == row[0]));
    assert!(rows_level, "a value that depends on height alone is drawn in level bands");
    let step = 256.0 * 400.0 * (32.5 / 64.0) / 401.0;
    assert_eq!(bands.pixel(0, 31), Some(ColourMap::Viridis.table()[step as usize]));

    let lines = FalseColour { contours: Some(Contours::At(vec![200.0])), ..chart };
    let lined = false_colour(&image, &lines).unwrap();
    // The label stands in the middle; left of it there is only the line.
    let changed: Vec<usize> = (0..64 * 64)
        .filter(|p| p % 64 < 16 && lined.rgb[*p] != bands.rgb[*p])
        .map(|p| p / 64)
        .collect();
    assert!(changed.iter().all(|row| (30..=33).contains(row)), "{changed:?}");
    // The first column has no neighbour to its left.
    assert!(changed.len() >= 2 * 15, "the line runs across");
}

#[test]
fn exposure_and_tone_make_the_documented_codes() {
    let scene = scene(room([0; 6]), vec![diffuse(0.5)]);
    let image = look(&scene, &TraceSettings::DRAFT, 1000.0);
    let luminance = 500.0 / PI;
    let linear =
        |exposure| Development { exposure, tone: ToneOperator::LINEAR, ..Development::default() };
    for (exposure, code) in [
        // The log-average of one luminance is that luminance, shown as 0.18.
        (Exposure::Automatic, 118),
        (Exposure::Percentile(1.0), 255),
        (Exposure::WhiteCdM2(luminance / 0.18), 118),
        (Exposure::GreyCdM2(luminance), 118),
        // 1.2 * 2^EV times 0.18 is the luminance.
        (Exposure::Ev100((luminance / 0.18 / 1.2).log2()), 118),
    ] {
        let picture = develop(&image, &linear(exposure)).unwrap();
        assert_eq!(picture.pixel(3, 3), Some([code; 3]), "{exposure:?}");
    }
}

#[test]
fn a_chart_of_the_error_is_in_per_cent() {
    let scene = scene(room([0; 6]), vec![diffuse(0.5)]);
    let size = Size::new(8, 8).unwrap();
    let noisy = |_| lux(200.0).map(|e| Illuminance { standard_error_lx: 5.0, ..e });
    let camera = towards_y(Point::ORIGIN);
    let image = trace(&scene, &camera, size, &TraceSettings::FINE, &noisy).unwrap();
    let chart = FalseColour {
        quantity: Quantity::StandardError,
        limits: Some((0.0, 10.0)),
        legend: None,
        ..FalseColour::default()
    };
    // 5 of 200 lx are 2.5 %, a quarter of the scale.
    let expected = ColourMap::Viridis.table()[64];
    assert!(false_colour(&image, &chart).unwrap().rgb.iter().all(|c| *c == expected));
}

#[test]
fn bad_requests_are_refused() {
    let scene = scene(room([0; 6]), vec![diffuse(0.5)]);
    let image = look(&scene, &TraceSettings::DRAFT, 1000.0);
    for exposure in [
        Exposure::WhiteCdM2(0.0),
        Exposure::WhiteCdM2(f64::NAN),
        Exposure::Ev100(1e6),
        Exposure::Percentile(1.5),
    ] {
        let how = Development { exposure, ..Development::default() };
        assert!(matches!(develop(&image, &how), Err(ViewError::Exposure(_))), "{exposure:?}");
    }
    let how =
        Development { tone: ToneOperator::Reinhard { white: -1.0 }, ..Development::default() };
    assert_eq!(develop(&image, &how), Err(ViewError::ToneWhite(-1.0)));
    assert!(Size::new(0, 5).is_err() && Size::new(1 << 16, 1 << 16).is_err());
    let size = Size::new(4096, 4096).unwrap();
    let settings = TraceSettings { samples_per_side: u32::MAX, ..TraceSettings::DRAFT };
    let refused = trace(&scene, &towards_y(Point::ORIGIN), size, &settings, &|_| None);
    assert!(matches!(refused, Err(ViewError::Samples { .. })));
}

/// The room with a glossy wall +y and a small panel near the camera that shines on it, otherwise black.
fn room_with_a_panel(alpha: f64) -> Scene {
    let gloss = Gloss { f0: Rgb::grey(0.2), alpha };
    let glossy = Finish { gloss: Some(gloss), ..Finish::BLACK };
    let panel = Finish { luminance_cd_m2: Rgb::grey(1000.0), ..Finish::BLACK };
    let mut shapes = room([0, 0, 0, 1, 0, 0]);
    shapes.push(rectangle(2, [0.3, -0.5, 0.4], [0.0, 0.0, 0.2], [0.2, 0.0, 0.0]));
    let materials = [Finish::BLACK, glossy, panel].map(|finish| Material::one_sided("m", finish));
    scene(shapes, materials.to_vec())
}

/// Mean and standard deviation of the luminance about the mirror image of the panel.
fn shown(scene: &Scene, settings: &TraceSettings) -> [f64; 2] {
    let size = Size::new(32, 32).expect("a size");
    let towards = Vector::new(0.16, 1.0, 0.2).direction().expect("a direction");
    let camera = Camera { direction: towards, vertical_fov_rad: 0.05, ..towards_y(Point::ORIGIN) };
    let image = trace(scene, &camera, size, settings, &|_| lux(0.0)).expect("a view");
    let all: Vec<f64> =
        (0..size.pixels()).map(|pixel| image.luminance_cd_m2(pixel).luminance()).collect();
    let mean = all.iter().sum::<f64>() / all.len() as f64;
    let squares = all.iter().map(|cd| (cd - mean).powi(2)).sum::<f64>();
    [mean, (squares / all.len() as f64).sqrt()]
}

#[test]
fn looks_at_luminaires_add_no_light_and_leave_little_noise() {
    for alpha in [0.02, 0.1, 0.5] {
        let scene = room_with_a_panel(alpha);
        let by_facets = TraceSettings { highlights: false, ..TraceSettings::DRAFT };
        let [_, noise] = shown(&scene, &by_facets);
        let many = TraceSettings { gloss_samples: 4096, ..by_facets };
        let [expected, left] = shown(&scene, &many);
        let [mean, even] = shown(&scene, &TraceSettings::DRAFT);
        // The noise of 32 x 32 pixels of either.
        let error = (left * left + even * even).sqrt() / 32.0;
        assert!((mean - expected).abs() < 4.0 * error, "{alpha}: {mean} for {expected}");
        // What narrow gloss shows differs from pixel to pixel itself.
        let is_wide = alpha > 0.05;
        assert!(!is_wide || even < 0.5 * noise, "{alpha}: {even}, {noise} by facets alone");
    }
}

#[test]
fn a_luminaire_without_surface_shows_on_a_rough_one() {
    let gloss = Gloss { f0: Rgb::grey(0.2), alpha: 0.3 };
    let finish = Finish { gloss: Some(gloss), ..Finish::BLACK };
    let lamp = Luminaire {
        name: "lamp".into(),
        group: 0,
        colour: Rgb::WHITE,
        kind: LuminaireKind::Point {
            position: Point::ORIGIN,
            world_from_luminaire: Transform::IDENTITY,
            intensity: IntensityDistribution::Isotropic { intensity_cd: 100.0 },
            area: None,
        },
    };
    let materials = vec![diffuse(0.5), Material::one_sided("glossy", finish)];
    let parts = SceneParts {
        shapes: room([0, 0, 0, 1, 0, 0]),
        materials,
        luminaires: vec![lamp],
        ..SceneParts::default()
    };
    let scene = Scene::assemble(parts).unwrap();
    let camera = Camera { vertical_fov_rad: 0.001, ..towards_y(Point::ORIGIN) };
    let size = Size::new(1, 1).unwrap();
    let image = trace(&scene, &camera, size, &TraceSettings::DRAFT, &|_| lux(0.0)).unwrap();
    // Seen and lit along the normal from 1 m: reflectance times density of facets over four, times 100 lx.
    let expected = 0.2 / (PI * 0.3 * 0.3) / 4.0 * 100.0;
    let got = image.luminance_cd_m2(0).luminance();
    assert!((got / expected - 1.0).abs() < 1e-5, "{got} for {expected}");
}
