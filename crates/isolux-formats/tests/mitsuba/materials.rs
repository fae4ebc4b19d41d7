//! Materials and textures.

use super::*;

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
