//! Emitters.

use super::*;

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
    let LuminaireKind::Directional { direction, illuminance_lx, .. } = &parts.luminaires[2].kind
    else {
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
fn a_sky_of_one_luminance_shines_from_everywhere() {
    let parts = read(&format!(
        "{RECTANGLE}<emitter type='constant'><rgb name='radiance' value='1 2 3'/></emitter>"
    ));
    let sky = parts.luminaires.last().unwrap();
    let LuminaireKind::Sky { sky: light, .. } = &sky.kind else { panic!() };
    let due = Rgb::new(1.0, 2.0, 3.0) * 179.0;
    for towards in [Direction::Z, -Direction::Z, Direction::X] {
        let found = sky.colour * light.luminance_cd_m2(towards).luminance();
        found.0.iter().zip(due.0).for_each(|(a, b)| near(*a, b, 1e-12));
    }
}

/// The left border is at -z, a quarter further is +x; turned by a right angle about y, the border is at -x.
#[test]
fn pictures_surround_the_scene() {
    let mut rgb = vec![[0.0_f32; 3]; 8];
    // Above the horizon, from the border on, and below it, from the middle on.
    (rgb[0], rgb[6]) = ([1.0; 3], [2.0; 3]);
    let picture = isolux_formats::luminance::Luminances { width: 4, height: 2, rgb_cd_m2: &rgb };
    let home = tempfile::tempdir().unwrap();
    let bytes = isolux_formats::luminance::encode_exr(&picture).unwrap();
    std::fs::write(home.path().join("sky.exr"), bytes).unwrap();
    let seen = |to_world: &str, towards: [f64; 3]| {
        let text = format!(
            "<scene version='3.0.0'>{RECTANGLE}<emitter type='envmap'><string name='filename' value='sky.exr'/>\
             <float name='scale' value='2'/><transform name='to_world'>{to_world}</transform></emitter></scene>"
        );
        let path = home.path().join("scene.xml");
        std::fs::write(&path, text).unwrap();
        let mut parts = isolux_formats::mitsuba::read(&path).unwrap().value;
        let LuminaireKind::Sky { world_from_sky, sky } = parts.luminaires.remove(0).kind else {
            panic!()
        };
        let sky_from_world = world_from_sky.inverse().unwrap();
        let towards = sky_from_world.vector(Vector::from(towards)).direction().unwrap();
        sky.luminance_cd_m2(towards).luminance() / 179.0
    };
    for (to_world, towards, due) in [
        ("", [0.1, 0.5, -1.0], 2.0),
        ("", [-0.1, 0.5, -1.0], 0.0),
        ("", [-0.1, -0.5, 1.0], 4.0),
        ("<rotate y='1' angle='90'/>", [-1.0, 0.5, -0.1], 2.0),
        ("<rotate y='1' angle='90'/>", [-1.0, 0.5, 0.1], 0.0),
    ] {
        // Pixels are in single precision.
        near(seen(to_world, towards), due, 1e-6);
    }
}

/// Mitsuba's own Cornell box has its lamp so: it was refused.
#[test]
fn an_area_emitter_is_named_by_the_shape_it_is_on() {
    let lamp = "<emitter type='area' id='lamp'><rgb name='radiance' value='2'/></emitter>";
    let shape = "<shape type='rectangle'><ref id='lamp'/></shape>";
    for inside in [format!("{lamp}{shape}{shape}"), format!("{shape}{lamp}{shape}")] {
        let scene = Scene::assemble(read(&inside)).unwrap();
        let luminances = scene.area_luminaires().iter().map(|l| l.luminance_cd_m2);
        assert_eq!(luminances.collect::<Vec<_>>(), [Rgb::grey(358.0); 2]);
    }
    let unused = told(&format!("{lamp}{RECTANGLE}"));
    assert!(unused.contains("lights nothing"), "{unused}");
}

/// `d65` is the usual white of Mitsuba's scenes: it was said to be no number.
#[test]
fn spectra_by_type() {
    let light = |spectrum: &str| {
        let inside = format!("{RECTANGLE}<emitter type='point'>{spectrum}</emitter>");
        let luminaire = read(&inside).luminaires.remove(0);
        let LuminaireKind::Point { intensity, .. } = luminaire.kind else { panic!() };
        (intensity.max_intensity_cd() / 179.0, luminaire.colour)
    };
    let (level, colour) = light("<spectrum name='intensity' type='d65'/>");
    near(level, 1.0, 1e-12);
    colour.0.iter().for_each(|channel| near(*channel, 1.0, 1e-12));
    let scaled = "<spectrum name='intensity' type='d65'><float name='scale' value='3'/></spectrum>";
    near(light(scaled).0, 3.0, 1e-12);
    let flat = "<spectrum name='intensity' type='regular'><float name='wavelength_min' value='360'/>\
                <float name='wavelength_max' value='830'/><string name='values' value='2, 2 2'/></spectrum>";
    near(light(flat).0, 2.0, 1e-12);
    near(light("<spectrum name='intensity' value='360:2, 830:2'/>").0, 2.0, 1e-12);
    let paint =
        |spectrum: &str| front(&format!("<bsdf type='diffuse'>{spectrum}</bsdf>")).diffuse.colour.0;
    let red = "<spectrum name='reflectance' type='irregular'><string name='wavelengths' value='590 600 780'/>\
               <string name='values' value='0 0.7 0.7'/></spectrum>";
    let [r, g, b] = paint(red);
    assert!(r > 0.5 && g < 0.1 && b < 0.05, "{r} {g} {b}");
    near(
        paint(
            "<spectrum name='reflectance' type='uniform'><float name='value' value='0.3'/></spectrum>",
        )[1],
        0.3,
        1e-12,
    );
    let emitter = |spectrum: &str| format!("{RECTANGLE}<emitter type='point'>{spectrum}</emitter>");
    refused(&emitter("<spectrum name='intensity' type='blackbody'/>"), "type `blackbody`");
    refused(&emitter("<spectrum name='intensity' filename='a.spd'/>"), "`a.spd` does not exist");
    refused(&emitter("<spectrum name='intensity' type='regular'/>"), "no regular list");
}

#[test]
fn spectra_in_files() {
    let colour = |spectrum: &str, file: &str| {
        let inside =
            format!("<shape type='rectangle'><bsdf type='diffuse'>{spectrum}</bsdf></shape>");
        read_with(&inside, &[("paint.spd", file)]).map(|read| {
            let parts = read.value;
            let body = &parts.materials[parts.shapes[0].material as usize].body;
            let Body::Opaque { front, .. } = body else { panic!("{body:?}") };
            front.diffuse.colour
        })
    };
    let inside = "<spectrum name='reflectance' value='400:0.1 590:0.2 780:0.7'/>";
    let inside = colour(inside, "").unwrap();
    let file = "# nm, share\n400 0.1\n590\t0.2\n780 0.7 # red\n";
    for of_file in [
        "<spectrum name='reflectance' filename='paint.spd'/>",
        "<spectrum name='reflectance' type='irregular' filename='paint.spd'/>",
    ] {
        assert_eq!(colour(of_file, file).unwrap(), inside, "{of_file}");
        for (bad, told) in [
            ("400 0.1\n590 0.2 3\n", "`paint.spd`: line 2: `590 0.2 3` is not two numbers"),
            ("# none\n", "there are no values"),
            ("500 1\n400 1\n", "wavelength"),
            ("400 one\n500 1\n", "wavelength"),
        ] {
            let message = colour(of_file, bad).unwrap_err().to_string();
            assert!(message.contains(told) && message.contains("line "), "{message}");
        }
    }
}
