//! Inline geometry and placements.

use super::{area_vector, near, problems, read, triangles};
use isolux::geometry::{Point, Vector};
use isolux::scene::SceneParts;

fn with(geometry: &str) -> String {
    format!("[materials.m]\ndiffuse = 0.5\n[[geometry]]\nmaterial = 'm'\n{geometry}\n")
}

fn bounds(parts: &SceneParts) -> ([f64; 3], [f64; 3]) {
    let all = || parts.shapes.iter().flat_map(|s| &s.positions);
    let fold = |k: usize, f: fn(f64, f64) -> f64, start: f64| all().map(|p| p[k]).fold(start, f);
    ([0, 1, 2].map(|k| fold(k, f64::min, f64::MAX)), [0, 1, 2].map(|k| fold(k, f64::max, f64::MIN)))
}

#[test]
fn concave_polygon() {
    let parts = read(&with("polygon = [[0,0,1], [3,0,1], [3,1,1], [1,1,1], [1,3,1], [0,3,1]]"));
    assert!(near(area_vector(&parts), [0.0, 0.0, 5.0]));
    assert_eq!(parts.shapes[0].name, "polygon 1");
}

#[test]
fn box_faces_have_names_and_materials() {
    let text = "[materials.wall]\ndiffuse = 0.5\n[materials.floor]\ndiffuse = 0.2\n[[geometry]]\n\
                name = 'room'\nbox = { min = [0,0,0], max = [4,3,2], inward = true }\n\
                material = 'wall'\nmaterials = { z_min = 'floor' }\n";
    let parts = read(text);
    assert_eq!(parts.shapes.len(), 6);
    let floor = parts.shapes.iter().find(|s| s.name == "room/z_min").unwrap();
    assert_eq!(parts.materials[floor.material as usize].name, "floor");
    let middle = Point::new(2.0, 1.5, 1.0);
    for t in triangles(&parts) {
        assert!(t.area_vector().dot(middle - t.centroid()) > 0.0, "{t:?} faces inwards");
    }
    assert!((triangles(&parts).iter().map(|t| t.area()).sum::<f64>() - 52.0).abs() < 1e-5);
}

#[test]
fn sphere_octant_disc_and_rectangle() {
    let parts =
        read(&with("sphere = { centre = [1,2,3], radius = 2, octant = true, segments = 8 }"));
    assert_eq!(bounds(&parts), ([1.0, 2.0, 3.0], [3.0, 4.0, 5.0]));
    assert!(parts.shapes[0].normals.is_some());
    let parts = read(&with("disc = { centre = [0,0,1], normal = [0,0,-2], radius = 1 }"));
    // A polygon of 32 corners.
    let expected = 16.0 * libm::sin(std::f64::consts::TAU / 32.0);
    assert!(near(area_vector(&parts), [0.0, 0.0, -expected]));
    let parts = read(&with("rectangle = { corner = [0,0,0], u = [0,2,0], v = [0,0,3] }"));
    assert!(near(area_vector(&parts), [6.0, 0.0, 0.0]));
}

#[test]
fn units_apply_to_every_length() {
    for (unit, metres) in [("m", 1.0), ("cm", 0.01), ("mm", 0.001), ("in", 0.0254), ("ft", 0.3048)]
    {
        let text = format!(
            "units = '{unit}'\n[[camera]]\nposition = [1,2,3]\ndirection = [1,0,0]\n[[luminaire]]\n\
             position = [1,0,0]\nisotropic = {{ intensity_cd = 1 }}\n\
             array = {{ count = [1,1,2], step = [0,0,10] }}\n{}",
            with("box = { min = [0,0,0], max = [1,1,1] }\ntransform = { translate = [0,0,2] }")
        );
        let parts = read(&text);
        let (low, high) = bounds(&parts);
        assert!((low[2] - 2.0 * metres).abs() < 1e-15 && (high[2] - 3.0 * metres).abs() < 1e-15);
        assert_eq!(parts.cameras[0].position, Point::new(metres, 2.0 * metres, 3.0 * metres));
        let isolux::scene::LuminaireKind::Point { position, .. } = &parts.luminaires[1].kind else {
            panic!("a point");
        };
        assert_eq!(*position, Point::new(metres, 0.0, 10.0 * metres));
    }
}

#[test]
fn turns_are_about_x_then_y_then_z_after_scaling() {
    let at = |placement: &str| {
        let rod = "rectangle = { corner = [0,0,0], u = [1,0,0], v = [0,0.5,0] }";
        let parts = read(&with(&format!("{rod}\ntransform = {{ {placement} }}")));
        let [a, b, _, d] = parts.shapes[0].positions[..] else { panic!("four corners") };
        let (a, b, d) = (Vector::from(a), Vector::from(b), Vector::from(d));
        (a, b - a, d - a)
    };
    let check = |placement: &str, corner: [f64; 3], u: [f64; 3], v: [f64; 3]| {
        let found = at(placement);
        let same = [(found.0, corner), (found.1, u), (found.2, v)]
            .iter()
            // Exact but for an addition and a subtraction.
            .all(|(a, b)| (*a - Vector::from(*b)).length() < 1e-15);
        assert!(same, "{placement}: {found:?}");
    };
    check("scale = 2", [0.0; 3], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    check("scale = [3, -2, 1]", [0.0; 3], [3.0, 0.0, 0.0], [0.0, -1.0, 0.0]);
    check("rotate_deg = [0, 0, 90]", [0.0; 3], [0.0, 1.0, 0.0], [-0.5, 0.0, 0.0]);
    check("rotate_deg = [90, 0, 0]", [0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, 0.5]);
    check("rotate_deg = [0, 90, 0]", [0.0; 3], [0.0, 0.0, -1.0], [0.0, 0.5, 0.0]);
    check("rotate_deg = [90, 0, 90]", [0.0; 3], [0.0, 1.0, 0.0], [0.0, 0.0, 0.5]);
    check(
        "translate = [1, 2, 3], rotate_deg = [0, 0, 180], scale = [1, 2, 1]",
        [1.0, 2.0, 3.0],
        [-1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0],
    );
    check(
        "matrix = [0,-1,0,5, 1,0,0,6, 0,0,1,7, 0,0,0,1]",
        [5.0, 6.0, 7.0],
        [0.0, 1.0, 0.0],
        [-0.5, 0.0, 0.0],
    );
}

#[test]
fn placements_come_after_the_transform_and_mirrors_keep_the_front() {
    let text = with(
        "name = 'tile'\nrectangle = { corner = [0,0,0], u = [1,0,0], v = [0,1,0] }\n\
         transform = { scale = 2 }\nplacements = [{ translate = [1,0,0] }, { scale = [-1,1,1] }]",
    );
    let parts = read(&text);
    let names: Vec<_> = parts.shapes.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(names, ["tile[0]", "tile[1]"]);
    assert_eq!(bounds(&parts), ([-2.0, 0.0, 0.0], [3.0, 2.0, 0.0]));
    assert!(near(area_vector(&parts), [0.0, 0.0, 8.0]), "the mirrored copy still faces up");
}

#[test]
fn wrong_geometry() {
    for (geometry, expected) in [
        ("polygon = [[0,0,0], [1,0,0]]", "line 5, column 11: a polygon of 2 corners"),
        ("polygon = [[0,0,0], [1,0,0], [2,0,0]]", "without area"),
        ("polygon = [[0,0,0], [1,0,0], [1,1,0.5], [0,1,0]]", "off its plane"),
        ("polygon = [[0,0,0], [2,2,0], [2,0,0], [0,3,0]]", "crosses itself"),
        ("polygon = [[0,0,0], [1,0,nan], [1,1,0]]", "out of range; expected a finite number"),
        ("rectangle = { corner = [0,0,0], u = [1,0,0], v = [2,0,0] }", "without area"),
        ("box = { min = [0,0,0], max = [1,0,1] }", "not above"),
        ("disc = { centre = [0,0,0], normal = [0,0,0], radius = 1 }", "normal of the disc"),
        ("disc = { centre = [0,0,0], normal = [0,0,1], radius = 0 }", "above 0"),
        (
            "disc = { centre = [0,0,0], normal = [0,0,1], radius = 1, segments = 4000000000 }",
            "segments",
        ),
        ("sphere = { centre = [0,0,0], radius = 1, segments = 30 }", "multiple of 4"),
        ("sphere = { centre = [0,0,0], radius = 1, segments = 4294967292 }", "multiple of 4"),
        ("sphere = { centre = [0,0,0], radius = -1 }", "above 0"),
        ("transform = {}", "nothing to say what it is"),
        ("box = { min = [0,0,0], max = [1,1,1] }\npolygon = []", "both `polygon` and `box`"),
        ("box = { min = [0,0,0], max = [1,1,1] }\nunits = 'cm'", "`units` without `file`"),
        (
            "box = { min = [0,0,0], max = [1,1,1] }\nmaterials = { top = 'm' }",
            "it has `x_max`, `x_min`",
        ),
        ("box = { min = [0,0,0], max = [1,1,1] }\ntransform = { scale = 0 }", "flattens"),
        ("box = { min = [0,0,0], max = [1,1,1] }\ntransform = { scale = 1e999 }", "overflowed"),
        ("box = { min = [0,0,0], max = [1,1,1] }\nplacements = []", "stands nowhere"),
        (
            "box = { min = [0,0,0], max = [1,1,1] }\n\
             transform = { matrix = [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1], scale = 2 }",
            "a matrix beside",
        ),
        (
            "box = { min = [0,0,0], max = [1,1,1] }\n\
             transform = { matrix = [1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1] }",
            "last row",
        ),
    ] {
        let found = problems(&with(geometry));
        assert!(found.iter().any(|p| p.contains(expected)), "{geometry}: {found:?}");
    }
}
