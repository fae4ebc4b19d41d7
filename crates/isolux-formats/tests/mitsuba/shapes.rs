//! Shapes, cameras, parameters and files in files.

use super::*;

#[test]
fn the_cornell_box_of_mitsuba() {
    let loaded = load(&cornell()).unwrap_or_else(|p| panic!("{p}"));
    let told: Vec<_> = loaded.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(told.len(), 2, "{told:?}");
    assert!(told[0].contains("179 (0.2126 red + 0.7152 green + 0.0722 blue) cd/m2"), "{told:?}");
    assert!(told[1].contains("integrator `path`: not used"), "{told:?}");
    let parts = loaded.value;
    assert_eq!((parts.shapes.len(), parts.up), (8, UpAxis::Y));
    let names: Vec<_> = parts.materials.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(names, ["white", "white", "green", "red"]);
    let large = parts.shapes.iter().find(|shape| shape.name == "large-box").unwrap();
    // Sides 0.6, 1.22, 0.6, the matrix in six digits.
    near(areas(large).1, 2.0 * (0.6 * 0.6 + 2.0 * 0.6 * 1.22), 1e-5);
    let camera = &parts.cameras[0];
    near(camera.vertical_fov_rad, 39.3077_f64.to_radians(), 1e-12);
    assert_eq!(<[f64; 3]>::from(camera.direction.to_vector()), [0.0, 0.0, -1.0]);
    let scene = Scene::assemble(parts).unwrap();
    let [light] = scene.area_luminaires() else { panic!() };
    assert_eq!(light.luminance_cd_m2, Rgb::new(18.387, 13.9873, 6.75357) * 179.0);
    // In single precision.
    near(light.area_m2, 0.46 * 0.38, 1e-6);
    assert!(!light.back);
}

#[test]
fn shapes_have_mitsubas_places_and_fronts() {
    let shape = |inside: &str| read(inside).shapes.remove(0);
    let (sum, area) = areas(&shape(RECTANGLE));
    assert_eq!((<[f64; 3]>::from(sum), area), ([0.0, 0.0, 4.0], 4.0));
    let flipped = "<shape type='rectangle'><boolean name='flip_normals' value='true'/></shape>";
    assert_eq!(<[f64; 3]>::from(areas(&shape(flipped)).0), [0.0, 0.0, -4.0]);
    let ball = shape(
        "<shape type='sphere'><point name='center' x='1' y='2' z='3'/><float name='radius' value='.5'/></shape>",
    );
    let normals = ball.normals.as_ref().unwrap();
    for (p, n) in ball.positions.iter().zip(normals) {
        (0..3).for_each(|k| assert!((p[k] - [1.0, 2.0, 3.0][k] - 0.5 * n[k]).abs() < 1e-15));
    }
    let pipe = shape(
        "<shape type='cylinder'><point name='p0' value='0 0 1'/><point name='p1' value='0 4 1'/>\
         <float name='radius' value='0.25'/></shape>",
    );
    let far = |p: &[f64; 3]| ((p[0] * p[0] + (p[2] - 1.0).powi(2)).sqrt() - 0.25).abs() < 1e-14;
    assert!(pipe.positions.iter().all(|p| far(p) && (p[1] == 0.0 || p[1] == 4.0)));
    let moved = shape(
        "<shape type='disk' id='d'><transform name='toWorld'><scale value='2'/><rotate y='1' angle='90'/>\
         <translate x='1'/></transform></shape>",
    );
    let (sum, _) = areas(&moved);
    // A polygon of 32 corners.
    near(sum.x, 4.0 * 16.0 * (PI / 16.0).sin(), 1e-12);
    assert!(
        sum.y.abs() + sum.z.abs() < 1e-12
            && moved.positions.iter().all(|p| (p[0] - 1.0).abs() < 1e-12)
    );
}

#[test]
fn meshes_groups_and_files_in_files() {
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1\n";
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
               property float u\nproperty float v\nelement face 1\nproperty list uchar int vertex_index\n\
               end_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n";
    let part = "<scene version='3.0.0'><shape type='ply' id='$id'><string name='filename' value='a.ply'/>\
                <boolean name='face_normals' value='true'/></shape></scene>";
    let files = [("a.obj", obj), ("a.ply", ply), ("part.xml", part)];
    let inside = "<default name='id' value='included'/><default name='id' value='second'/>\n\
        <include filename='part.xml'/>\n\
        <shape type='shapegroup' id='group'><shape type='obj'><string name='filename' value='a.obj'/></shape></shape>\n\
        <shape type='instance'><ref id='group'/><transform name='to_world'><translate z='1'/></transform></shape>\n\
        <alias id='group' as='other'/>\n\
        <shape type='instance' id='i'><ref id='other'/><transform name='to_world'><scale z='-1'/></transform></shape>";
    let loaded = read_with(inside, &files).unwrap_or_else(|p| panic!("{p}"));
    assert_eq!(loaded.warnings, []);
    let shapes = loaded.value.shapes;
    let names: Vec<_> = shapes.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(names, ["included", "obj line 4", "obj line 4"]);
    // Mitsuba turns `v` of OBJ and not of PLY.
    assert_eq!(shapes[0].uvs.as_ref().unwrap()[2], [0.0, 1.0]);
    assert_eq!(shapes[1].uvs.as_ref().unwrap()[2], [0.0, 0.0]);
    assert_eq!(shapes[1].positions[0], [0.0, 0.0, 1.0]);
    // The front of meshes with normals is where these point.
    assert_eq!(areas(&shapes[2]).0.z, -0.5);
    assert_eq!(shapes[2].normals.as_ref().unwrap()[0], [0.0, 0.0, -1.0]);
    let without = files.map(|(name, text)| (name, text.replace("/1 2/2/1 3/3/1", "/ 2/2/ 3/3/")));
    let without: Vec<_> = without.iter().map(|(name, text)| (*name, text.as_str())).collect();
    let loaded = read_with(inside, &without).unwrap();
    assert!(
        loaded.warnings[0].what.contains("read as flat, where Mitsuba smooths"),
        "{:?}",
        loaded.warnings
    );
    assert_eq!(areas(&loaded.value.shapes[2]).0.z, 0.5, "turned by its corners");
}

#[test]
fn cameras_open_as_their_axis_says() {
    let fov = |inside: &str| {
        let film = "<film type='hdrfilm'><integer name='width' value='200'/><integer name='height' value='100'/></film>";
        let sensor = format!("<sensor type='perspective'>{inside}{film}</sensor>");
        read(&format!("{RECTANGLE}{sensor}")).cameras[0].vertical_fov_rad
    };
    let of = |axis: &str| {
        fov(&format!("<float name='fov' value='90'/><string name='fov_axis' value='{axis}'/>"))
    };
    for (axis, half) in
        [("x", 0.5), ("y", 1.0), ("larger", 0.5), ("smaller", 1.0), ("diagonal", 0.2_f64.sqrt())]
    {
        near(of(axis), 2.0 * f64::atan(half), 1e-12);
    }
    near(fov("<float name='fov' value='90'/>"), 2.0 * f64::atan(0.5), 1e-12);
    let diagonal = (36.0_f64.powi(2) + 24.0 * 24.0).sqrt();
    near(
        fov("<string name='focal_length' value='35mm'/>"),
        2.0 * (0.5 * diagonal / 35.0 / 5.0_f64.sqrt()).atan(),
        1e-12,
    );
    let z_up = "<sensor type='thinlens'><transform name='to_world'>\
                <lookat origin='1 1 1' target='0 0 0' up='0 0 1'/></transform></sensor>";
    assert_eq!(read(&format!("{RECTANGLE}{z_up}")).up, UpAxis::Z);
}

#[test]
fn a_scene_toml_chooses_unit_efficacy_and_materials() {
    let dir = tempfile::tempdir().unwrap();
    std::fs::copy(cornell(), dir.path().join("box.xml")).unwrap();
    let path = dir.path().join("scene.toml");
    let read = |more: &str| {
        let text =
            format!("[materials.paint]\ndiffuse = 0.7\n[[geometry]]\nfile = 'box.xml'\n{more}\n");
        std::fs::write(&path, text).unwrap();
        scene_toml::read(&path)
    };
    let loaded = read("units = 'cm'\nefficacy_lm_w = 1\nmaterials = { green = 'paint' }").unwrap();
    let told: Vec<_> = loaded.warnings.iter().map(ToString::to_string).collect();
    assert!(told.len() == 1 && told[0].contains("integrator"), "{told:?}");
    let parts = loaded.value;
    assert_eq!(parts.cameras[0].position.y, -0.039, "turned from y up to z up, in centimetres");
    let wall = parts.shapes.iter().find(|s| s.name == "box/green-wall").unwrap();
    assert_eq!(parts.materials[wall.material as usize].name, "paint");
    let scene = Scene::assemble(parts).unwrap();
    assert_eq!(scene.area_luminaires()[0].luminance_cd_m2, Rgb::new(18.387, 13.9873, 6.75357));
    let no = read("efficacy_lm_w = 0").unwrap_err().to_string();
    assert!(no.contains("out of range"), "{no}");
    std::fs::write(
        dir.path().join("sky.xml"),
        "<scene version='3.0.0'><shape type='cube'/><emitter type='constant'/></scene>",
    )
    .unwrap();
    std::fs::write(&path, "[[geometry]]\nfile = 'sky.xml'\n").unwrap();
    let with_sky = scene_toml::read(&path).unwrap().value;
    assert!(matches!(with_sky.luminaires[0].kind, LuminaireKind::Sky { .. }));
    std::fs::write(dir.path().join("a.ply"), "ply\n").unwrap();
    std::fs::write(&path, "[[geometry]]\nfile = 'a.ply'\nefficacy_lm_w = 1\n").unwrap();
    assert!(
        scene_toml::read(&path)
            .unwrap_err()
            .to_string()
            .contains("`efficacy_lm_w` of a file that is no Mitsuba")
    );
}
