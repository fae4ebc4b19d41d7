//! Scenes of Mitsuba 3: shapes, materials, light, cameras, parameters, and hostile files.

#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

mod spoil;

use isolux::geometry::Vector;
use isolux::scene::{Body, Finish, LuminaireKind, Scene, SceneParts, Shape, UpAxis};
use isolux::units::Rgb;
use isolux_formats::{Loaded, Problems, load, mitsuba, scene_toml};
use spoil::{Dice, spoil};
use std::f64::consts::PI;
use std::path::{Path, PathBuf};

const CORNELL: &str = "../../scenes/cornell_mitsuba/scene.xml";
const RECTANGLE: &str = "<shape type='rectangle'/>";

fn cornell() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(CORNELL)
}

/// Reads `scene.xml`, of which the inside is given, beside other files.
fn read_with(inside: &str, files: &[(&str, &str)]) -> Result<Loaded<SceneParts>, Problems> {
    let dir = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::write(dir.path().join(name), text).unwrap();
    }
    let path = dir.path().join("scene.xml");
    std::fs::write(&path, format!("<scene version='3.0.0'>\n{inside}\n</scene>")).unwrap();
    mitsuba::read(&path)
}

fn read(inside: &str) -> SceneParts {
    read_with(inside, &[]).unwrap_or_else(|p| panic!("{p}")).value
}

fn told(inside: &str) -> String {
    let warnings = read_with(inside, &[]).unwrap_or_else(|p| panic!("{p}")).warnings;
    warnings.iter().map(|w| format!("{w}\n")).collect()
}

#[track_caller]
fn refused(inside: &str, expected: &str) {
    let message = read_with(inside, &[]).unwrap_err().to_string();
    assert!(message.contains(expected), "{message}");
    assert!(message.contains("; "), "no remedy: {message}");
}

#[track_caller]
fn near(a: f64, b: f64, relative: f64) {
    assert!((a - b).abs() <= relative * b.abs().max(1e-300), "{a} {b}");
}

/// The front of a rectangle of a material.
fn body(bsdf: &str) -> Body {
    let parts = read(&format!("<shape type='rectangle'>{bsdf}</shape>"));
    parts.materials[parts.shapes[0].material as usize].body.clone()
}

fn front(bsdf: &str) -> Finish {
    let Body::Opaque { front, .. } = body(bsdf) else { panic!("{bsdf}") };
    front
}

/// The sum of areas with their normals, and the area.
fn areas(shape: &Shape) -> (Vector, f64) {
    let corner = |k: u32| Vector::from(shape.positions[k as usize]);
    shape.triangles.iter().fold((Vector::ZERO, 0.0), |(sum, area), t| {
        let [a, b, c] = t.map(corner);
        let half = (b - a).cross(c - a) * 0.5;
        (sum + half, area + half.length())
    })
}

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
fn diffuse_is_one_sided_and_twosided_is_not() {
    let diffuse = "<bsdf type='diffuse'><rgb name='reflectance' value='.1 .2 .3'/></bsdf>";
    let red = Finish::diffuse(Rgb::new(0.1, 0.2, 0.3));
    assert_eq!(body(diffuse), Body::Opaque { front: red.clone(), back: Finish::BLACK });
    let both = format!("<bsdf type='twosided'>{diffuse}</bsdf>");
    assert_eq!(body(&both), Body::Opaque { front: red.clone(), back: red.clone() });
    let grey = "<bsdf type='diffuse'><spectrum name='reflectance' value='0.25'/></bsdf>";
    let both = format!("<bsdf type='twosided'>{diffuse}{grey}</bsdf>");
    let back = Finish::diffuse(Rgb::grey(0.25));
    assert_eq!(body(&both), Body::Opaque { front: red, back });
    assert_eq!(
        body(""),
        Body::Opaque { front: Finish::diffuse(Rgb::grey(0.5)), back: Finish::BLACK }
    );
    let hex = front("<bsdf type='diffuse'><rgb name='reflectance' value='#ff8000'/></bsdf>");
    near(hex.diffuse.colour.0[1], 0.2158605, 1e-6);
}

#[test]
fn metals_glass_and_plastic() {
    let none = "<bsdf type='conductor'><string name='material' value='none'/></bsdf>";
    assert_eq!(front(none), Finish::mirror(Rgb::WHITE));
    let own = "<bsdf type='roughconductor'><float name='alpha' value='0.2'/><rgb name='eta' value='0.2'/>\
               <rgb name='k' value='3.9'/><rgb name='specular_reflectance' value='.5'/></bsdf>";
    let gloss = front(own).gloss.unwrap();
    near(gloss.f0.0[0], 0.5 * (0.8_f64.powi(2) + 3.9 * 3.9) / (1.2_f64.powi(2) + 3.9 * 3.9), 1e-12);
    assert_eq!(gloss.alpha, 0.2);
    let copper = front("<bsdf type='conductor'/>").mirror;
    assert!(copper.0[0] > 0.9 && copper.0[2] < 0.6, "{copper:?}");
    let Body::Dielectric(glass) = body("<bsdf type='dielectric'/>") else { panic!() };
    assert_eq!((glass.ior, glass.thin), (1.5046 / 1.000_277, false));
    let pane = "<bsdf type='thindielectric'><float name='intIOR' value='1.5'/><string name='ext_ior' value='water'/>\
                <rgb name='specular_transmittance' value='.9'/></bsdf>";
    let Body::Dielectric(glass) = body(pane) else { panic!() };
    assert_eq!((glass.ior, glass.thin, glass.transmittance), (1.5 / 1.333, true, Rgb::grey(0.9)));
    let plastic = "<bsdf type='plastic'><rgb name='diffuse_reflectance' value='.6'/>\
                   <float name='int_ior' value='1.5'/><float name='ext_ior' value='1'/>";
    let linear = front(&format!("{plastic}</bsdf>"));
    // Of light from everywhere the surface of index 1.5 reflects 0.0918.
    near(linear.mirror.0[0], 0.0918, 1e-3);
    near(linear.diffuse.colour.0[0], 0.6 * (1.0 - 0.0918), 1e-4);
    let nonlinear = front(&format!("{plastic}<boolean name='nonlinear' value='true'/></bsdf>"));
    let inside = 0.5963;
    let due = (1.0 - 0.0918) * (1.0 - inside) * 0.6 / (1.0 - 0.6 * inside);
    near(nonlinear.diffuse.colour.0[0], due, 1e-3);
    let rough =
        front("<bsdf type='roughplastic'><float name='ext_ior' value='1'/></bsdf>").gloss.unwrap();
    near(rough.f0.0[0], (0.49_f64 / 2.49).powi(2), 1e-12);
    assert_eq!(rough.alpha, 0.1);
}

#[test]
fn what_is_only_nearly_read_is_told() {
    let with = |bsdf: &str| told(&format!("<shape type='rectangle'>{bsdf}</shape>"));
    let inner = "<bsdf type='diffuse'/>";
    assert!(
        with(&format!("<bsdf type='bumpmap'><texture type='noise'/>{inner}</bsdf>"))
            .contains("bumpmap` is left out")
    );
    let mask = format!("<bsdf type='mask'><float name='opacity' value='.5'/>{inner}</bsdf>");
    assert!(with(&mask).contains("lets light through its gaps"));
    assert!(
        with("<bsdf type='principled'><float name='sheen' value='1'/></bsdf>")
            .contains("`sheen` is not used")
    );
    let brushed = "<bsdf type='roughconductor'><float name='alpha_u' value='.1'/><float name='alpha_v' value='.4'/></bsdf>";
    assert!(with(brushed).contains("line 2: bsdf `roughconductor` is brushed"));
    near(front(brushed).gloss.unwrap().alpha, 0.2, 1e-12);
    let above = "<bsdf type='diffuse'><rgb name='reflectance' value='2'/></bsdf>";
    assert!(with(above).contains("a `reflectance` above 1, which is cut"));
    let other = "<float name='frobnicate' value='1'/>";
    assert!(with(other).contains("line 2: shape `rectangle`: `frobnicate` is not used"));
    assert!(told(&format!("{RECTANGLE}<path value='.'/>")).contains("line 2: path is not used"));
    assert!(
        read_with("<shape type='rectangle'><bsdf type='null'/></shape>", &[])
            .unwrap_err()
            .to_string()
            .contains("no surfaces")
    );
}

#[test]
fn textures_lie_where_mitsuba_lays_them() {
    let board = "<texture type='checkerboard' name='reflectance'><rgb name='color0' value='1 0 0'/>\
                 <rgb name='color1' value='0 1 0'/><transform name='to_uv'><scale x='2' y='1'/></transform></texture>";
    let parts =
        read(&format!("<shape type='rectangle'><bsdf type='diffuse'>{board}</bsdf></shape>"));
    let shape = &parts.shapes[0];
    assert_eq!(shape.uvs.as_ref().unwrap()[2], [2.0, 1.0]);
    let texture = &parts.textures[0];
    assert_eq!(texture.value(0.25, 0.25).0, [1.0, 0.0, 0.0]);
    assert_eq!(texture.value(0.75, 0.25).0, [0.0, 1.0, 0.0]);
    let disk = told(&format!("<shape type='disk'><bsdf type='diffuse'>{board}</bsdf></shape>"));
    assert!(disk.contains("its texture counts by its mean"), "{disk}");
    let picture = |inside: &str| {
        let texture = format!("<texture type='bitmap' name='reflectance'>{inside}</texture>");
        format!("<shape type='rectangle'><bsdf type='diffuse'>{texture}</bsdf></shape>")
    };
    refused(
        &picture("<string name='filename' value='none.png'/>"),
        "line 2: file `none.png` does not exist",
    );
    refused(
        &picture("<string name='filename' value='/etc/hostname'/>"),
        "lies outside the directory",
    );
}

#[test]
fn luminaires_shine_as_mitsubas_do() {
    let parts = read(&format!(
        "{RECTANGLE}<emitter type='point' id='bulb'><point name='position' value='1 2 3'/>\
         <rgb name='intensity' value='4 0 0'/></emitter>\
         <emitter type='spot'><spectrum name='intensity' value='2'/><float name='cutoff_angle' value='20'/>\
         <float name='beam_width' value='12'/><transform name='to_world'>\
         <lookat origin='0 0 5' target='0 0 0' up='0 1 0'/></transform></emitter>\
         <emitter type='directional'><vector name='direction' x='0' y='-2' z='0'/>\
         <float name='irradiance' value='3'/></emitter>"
    ));
    let LuminaireKind::Point { position, intensity, .. } = &parts.luminaires[0].kind else {
        panic!()
    };
    assert_eq!(
        (parts.luminaires[0].name.as_str(), <[f64; 3]>::from(*position)),
        ("bulb", [1.0, 2.0, 3.0])
    );
    near(intensity.max_intensity_cd(), 179.0 * 4.0 * 0.2126, 1e-12);
    near(parts.luminaires[0].colour.luminance(), 1.0, 1e-12);
    let LuminaireKind::Point { world_from_luminaire, intensity, .. } = &parts.luminaires[1].kind
    else {
        panic!()
    };
    assert_eq!(world_from_luminaire.columns[2].z, 1.0, "down -z");
    // Full, linear in the angle, nothing: what Mitsuba gives at these angles.
    for (angle, due) in
        [(0.0, 1.0), (12.0, 1.0), (16.0, 0.5), (18.0, 0.25), (20.001, 0.0), (90.0, 0.0)]
    {
        let (s, c) = f64::to_radians(angle).sin_cos();
        let found = intensity.intensity_cd(Vector::new(s, 0.0, -c).direction().unwrap());
        assert!((found / (2.0 * 179.0) - due).abs() < 1e-4, "{angle}: {found}");
    }
    // Light of equal energy is reddish beside the white of Rec. 709, of the same luminance.
    near(parts.luminaires[1].colour.0[0], 1.2048, 1e-3);
    let LuminaireKind::Directional { direction, illuminance_lx } = &parts.luminaires[2].kind else {
        panic!()
    };
    assert_eq!((direction.to_vector().y, *illuminance_lx), (-1.0, 537.0));
}

#[test]
fn round_lights_keep_their_flux() {
    let light = "<emitter type='area'><rgb name='radiance' value='2'/></emitter>";
    let inside = format!(
        "<shape type='sphere'><float name='radius' value='.2'/>{light}</shape>\
         <shape type='disk'>{light}</shape>\
         <shape type='cylinder'><point name='p1' value='0 0 3'/>{light}</shape>"
    );
    let scene = Scene::assemble(read(&inside)).unwrap();
    let areas: Vec<f64> = scene.area_luminaires().iter().map(|l| l.area_m2).collect();
    // The kernel keeps coordinates in single precision.
    areas.iter().zip([0.16 * PI, PI, 6.0 * PI]).for_each(|(a, b)| near(*a, b, 1e-5));
    assert_eq!(scene.area_luminaires()[0].luminance_cd_m2, Rgb::grey(358.0));
}

#[test]
fn a_sky_of_one_luminance_is_a_box_around_the_scene() {
    let parts = read(&format!(
        "{RECTANGLE}<emitter type='constant'><rgb name='radiance' value='1 2 3'/></emitter>"
    ));
    let sky = parts.shapes.last().unwrap();
    assert_eq!((sky.name.as_str(), sky.triangles.len()), ("constant emitter", 12));
    let material = &parts.materials[sky.material as usize];
    assert_eq!(material.finish(false).unwrap().luminance_cd_m2, Rgb::new(1.0, 2.0, 3.0) * 179.0);
    assert_eq!(*material.finish(true).unwrap(), Finish::BLACK);
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
fn what_is_not_read_is_refused_by_name_with_its_line() {
    for (inside, due) in [
        ("<shape type='serialized'/>", "line 2: shape `serialized` is not read"),
        ("<shape type='hair' id='h'/>", "line 2: shape `hair` (`h`) is not read"),
        ("<shape type='obj'/>", "line 2: shape `obj` names no file"),
        (
            "\n<shape type='ply'><string name='filename' value='a.ply'/></shape>",
            "line 3: file `a.ply` does not exist",
        ),
        ("<shape type='cube'><bsdf type='measured'/></shape>", "bsdf `measured` is not read"),
        (
            "<shape type='cube'><bsdf type='roughdielectric'/></shape>",
            "`roughdielectric` is not read",
        ),
        ("<shape type='cube'><ref id='gone'/></shape>", "there is no object `gone`"),
        ("<shape type='cube'><ref name='interior' id='x'/></shape>", "holds a medium"),
        (
            "<shape type='cube'><emitter type='area'><blackbody name='radiance' temperature='3000'/></emitter></shape>",
            "black bodies are not read",
        ),
        (
            "<shape type='cube'><emitter type='area'><spectrum name='radiance' value='400:1, 500:2'/></emitter></shape>",
            "spectra by wavelength",
        ),
        (
            "<shape type='cube'><emitter type='area'><rgb name='radiance' value='-1'/></emitter></shape>",
            "is not zero or more",
        ),
        (
            "<shape type='cube'><bsdf type='dielectric'/><emitter type='area'/></shape>",
            "is of glass and gives light",
        ),
        (
            "<shape type='cube'><bsdf type='twosided'><bsdf type='dielectric'/></bsdf></shape>",
            "holds what light passes",
        ),
        (
            "<shape type='cube'><bsdf type='conductor'><string name='material' value='Xx'/></bsdf></shape>",
            "is of `Xx`, which is not known",
        ),
        (
            "<shape type='cube'><bsdf type='dielectric'><string name='int_ior' value='jelly'/></bsdf></shape>",
            "no substance `jelly`",
        ),
        (
            "<shape type='cube'><bsdf type='dielectric'><float name='int_ior' value='0'/></bsdf></shape>",
            "`int_ior` is 0",
        ),
        ("<shape type='sphere'><float name='radius' value='-1'/></shape>", "`radius` is -1"),
        (
            "<shape type='sphere'><float name='radius' value='one'/></shape>",
            "`one` is not one finite number",
        ),
        (
            "<shape type='cube'><transform name='to_world'><scale x='0'/></transform></shape>",
            "flattens",
        ),
        (
            "<shape type='cube'><transform name='to_world'><shear x='1'/></transform></shape>",
            "step `shear`",
        ),
        (
            "<shape type='cube'><transform name='to_world'><matrix value='1 2 3'/></transform></shape>",
            "neither 9 nor 16",
        ),
        (
            "<shape type='cube'><transform name='to_world'><rotate angle='1'/></transform></shape>",
            "without an axis",
        ),
        (
            "<shape type='cube'><transform name='to_world'><lookat origin='0 0 0' target='0 1 0' up='0 1 0'/></transform></shape>",
            "lie on a line",
        ),
        ("<emitter type='envmap'/>", "emitter `envmap` is not read"),
        (
            "<emitter type='spot'><float name='cutoff_angle' value='190'/></emitter>",
            "give angles from the axis",
        ),
        ("<medium type='homogeneous'/>", "line 2: medium `homogeneous` is not read"),
        ("<shape type='$kind'/>", "line 2: parameter `$kind` has no value"),
        ("<default name='x'/>", "default without name and value"),
        ("<include filename='/etc/hostname'/>", "lies outside the directory"),
        ("<include filename='gone.xml'/>", "line 2: file `gone.xml` does not exist"),
        ("<shape type='cube'>", "is no XML that is read here"),
        ("<!DOCTYPE a [<!ENTITY b 'c'>]>&b;", "line 2: is no XML"),
        ("&b;", "is no XML"),
    ] {
        refused(inside, due);
    }
    refused("", "there are no surfaces");
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.xml");
    std::fs::write(&path, "<?xml version='1.0'?>\n<X3D/>").unwrap();
    let message = mitsuba::read(&path).unwrap_err().to_string();
    assert!(message.contains("line 2: `X3D` is not a Mitsuba `scene`"), "{message}");
    std::fs::write(&path, "<!DOCTYPE scene SYSTEM 'http://a/b'>\n<scene version='3.0.0'/>")
        .unwrap();
    assert!(
        mitsuba::read(&path).unwrap_err().to_string().contains("DTDs and entities are not read")
    );
}

#[test]
fn hostile_files_end() {
    let deep = "<bsdf type='twosided'>".repeat(200_000) + &"</bsdf>".repeat(200_000);
    refused(&deep, "elements or files one in the other");
    refused("<include filename='scene.xml'/>", "elements or files one in the other");
    let group = "<shape type='shapegroup' id='g'><shape type='instance'><ref id='g'/></shape>\
                 <shape type='instance'><ref id='g'/></shape></shape><shape type='instance'><ref id='g'/></shape>";
    refused(group, "lies too deep");
    let ring =
        "<bsdf type='twosided' id='a'><ref id='a'/></bsdf><shape type='cube'><ref id='a'/></shape>";
    refused(ring, "lies in too many others");
    let long = format!(
        "<default name='a' value='{}'/><float name='{}' value='1'/>",
        "x".repeat(60_000),
        "$a".repeat(9)
    );
    refused(&long, "parameters make more than 65536 bytes");
    let many = "<a/>".repeat(3_000_000);
    refused(&many, "is no XML that is read here");
    let large = format!("<!-- {} -->", "x".repeat(65 << 20));
    let message = read_with(&large, &[]).unwrap_err().to_string();
    assert!(message.contains("larger than 64 MiB"), "{}", message.len());
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
    std::fs::write(dir.path().join("a.ply"), "ply\n").unwrap();
    std::fs::write(&path, "[[geometry]]\nfile = 'a.ply'\nefficacy_lm_w = 1\n").unwrap();
    assert!(
        scene_toml::read(&path)
            .unwrap_err()
            .to_string()
            .contains("`efficacy_lm_w` of a file that is no Mitsuba")
    );
}

#[test]
fn spoilt_files_are_read_or_refused() {
    const WORDS: [&str; 18] = [
        "<ref",
        "id=\"white\"/>",
        "type=\"sphere\"",
        "type=\"area\">",
        "value=\"1e308\"",
        "value=\"-1\"",
        "value=\"nan\"",
        "/>",
        "",
        "<shape",
        "</shape>",
        "name=\"radius\"",
        "$size",
        "<include",
        "type=\"twosided\">",
        "x=\"0\"",
        "&amp;",
        "<bsdf",
    ];
    let good = std::fs::read(cornell()).unwrap();
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("scene.xml");
    let mut dice = Dice(7);
    let (mut was_read, mut was_refused) = (0, 0);
    for _ in 0..1500 {
        let mut bytes = good.clone();
        spoil(&mut bytes, &mut dice, &WORDS);
        std::fs::write(&path, &bytes).unwrap();
        match mitsuba::read(&path) {
            // What is read is a scene or says why not, far coordinates among the reasons.
            Ok(loaded) => drop(Scene::assemble(loaded.value).map(|_| was_read += 1)),
            Err(Problems(list)) => {
                assert!(!list.is_empty());
                was_refused += 1;
            }
        }
    }
    // Both must happen often, or the changes are too weak or too strong.
    assert!(was_read > 150 && was_refused > 500, "{was_read} read, {was_refused} refused");
}
