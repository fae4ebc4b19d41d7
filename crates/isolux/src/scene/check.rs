//! All problems of a scene at once.

use super::{
    Body, Camera, Coat, Dielectric, Finish, Luminaire, LuminaireKind, LuminousArea, Material,
    Place, SceneParts, SceneProblem, Shape, Texture,
};
use crate::photometry::IntensityDistribution;
use crate::units::Rgb;
use std::f64::consts::FRAC_PI_2;

/// Reflectances may exceed one by this much: the rounding of decimal fractions and byte colours.
pub(super) const ENERGY_ROUNDING: f64 = 1e-6;

/// Everything that keeps the parts from being a scene.
pub(super) fn problems(parts: &SceneParts) -> Vec<SceneProblem> {
    let mut found = Vec::new();
    if parts.shapes.iter().all(|s| s.triangles.is_empty()) {
        found.push(problem(Place::Scene, "there is no geometry", "add at least one triangle"));
    }
    for (index, shape) in parts.shapes.iter().enumerate() {
        let place = || Place::Shape { index, name: shape.name.clone() };
        check_shape(shape, parts.materials.len(), &mut |what, remedy| {
            found.push(problem(place(), what, remedy));
        });
    }
    for (index, material) in parts.materials.iter().enumerate() {
        let place = || Place::Material { index, name: material.name.clone() };
        check_material(material, parts.textures.len(), &mut |what, remedy| {
            found.push(problem(place(), what, remedy));
        });
    }
    for (index, texture) in parts.textures.iter().enumerate() {
        if !texture_is_whole(texture) {
            let what =
                format!("{} x {} pixels need as many bytes times 3", texture.width, texture.height);
            found.push(problem(Place::Texture { index }, what, "give every pixel three bytes"));
        }
    }
    for (index, luminaire) in parts.luminaires.iter().enumerate() {
        let place = || Place::Luminaire { index, name: luminaire.name.clone() };
        check_luminaire(luminaire, parts.groups.len(), &mut |what, remedy| {
            found.push(problem(place(), what, remedy));
        });
    }
    for (index, camera) in parts.cameras.iter().enumerate() {
        if let Some((what, remedy)) = camera_problem(camera) {
            found.push(problem(Place::Camera { index, name: camera.name.clone() }, what, remedy));
        }
    }
    for (index, grid) in parts.grids.iter().enumerate() {
        if let Some((what, remedy)) = grid.problem() {
            found.push(problem(Place::Grid { index, name: grid.name.clone() }, what, remedy));
        }
    }
    found
}

fn problem(place: Place, what: impl Into<String>, remedy: impl Into<String>) -> SceneProblem {
    SceneProblem { place, what: what.into(), remedy: remedy.into() }
}

type Report<'a> = &'a mut dyn FnMut(String, String);

/// Coordinates that the ray kernel can multiply three times over in `f32`, m: beyond the orbit of
/// the Moon.
const FARTHEST_M: f64 = 1e9;

fn check_shape(shape: &Shape, materials: usize, report: Report) {
    let vertices = shape.positions.len();
    let mut say = |what: String, remedy: &str| report(what, remedy.into());
    let representable = |p: &&[f64; 3]| p.iter().all(|c| c.is_finite());
    let unplaced = vertices - shape.positions.iter().filter(representable).count();
    if unplaced > 0 {
        say(
            format!("{unplaced} vertices have a coordinate that is not a finite number"),
            "remove them or export the geometry again",
        );
    }
    let far = shape.positions.iter().flatten().filter(|c| c.is_finite() && c.abs() > FARTHEST_M);
    if let Some(farthest) = far.copied().reduce(|a, b| if a.abs() > b.abs() { a } else { b }) {
        say(
            format!("a coordinate of {farthest:e} m lies beyond {FARTHEST_M:e} m"),
            "check the unit, and remove stray vertices",
        );
    }
    let stray = shape.triangles.iter().flatten().filter(|&&v| v as usize >= vertices).count();
    if stray > 0 {
        say(
            format!("{stray} corners name a vertex beyond the {vertices} there are"),
            "export the geometry again",
        );
    }
    for (what, count) in [
        ("normals", shape.normals.as_ref().map(Vec::len)),
        ("texture coordinates", shape.uvs.as_ref().map(Vec::len)),
        ("places in a lightmap", shape.lightmap_uvs.as_ref().map(Vec::len)),
    ] {
        if let Some(count) = count.filter(|&count| count != vertices) {
            say(format!("{count} {what} for {vertices} vertices"), "give one a vertex, or none");
        }
    }
    let finite_uv = |uv: &[f64; 2]| uv[0].is_finite() && uv[1].is_finite();
    if !shape.uvs.iter().flatten().all(finite_uv) {
        say("a texture coordinate is not a finite number".into(), "export the geometry again");
    }
    if shape.material as usize >= materials {
        say(format!("its material {} does not exist", shape.material), "name one that does");
    }
}

fn check_material(material: &Material, textures: usize, report: Report) {
    match &material.body {
        Body::Opaque { front, back } => {
            for (side, finish) in [("front", front), ("back", back)] {
                check_finish(finish, side, textures, report);
            }
        }
        Body::Dielectric(Dielectric { ior, transmittance, .. }) => {
            if !(*ior > 0.0 && ior.is_finite()) {
                report(
                    format!("refractive index {ior}"),
                    "give a positive number, 1.5 for window glass".into(),
                );
            }
            if !is_share(*transmittance) {
                report(
                    format!("transmittance {:?} is not between 0 and 1", transmittance.0),
                    "give the share of light that passes".into(),
                );
            }
        }
    }
}

fn check_finish(finish: &Finish, side: &str, textures: usize, report: Report) {
    let f0 = finish.gloss.map_or(Rgb::BLACK, |g| g.f0);
    check_coat(finish, side, report);
    for (what, value) in [
        ("diffuse reflectance", finish.diffuse.colour),
        ("mirror reflectance", finish.mirror),
        ("reflectance at normal incidence", f0),
    ] {
        if !is_share(value) {
            report(
                format!("{side} {what} {:?} is not between 0 and 1", value.0),
                "reflectances are shares of the incident light; write 50 % as 0.5".into(),
            );
        }
    }
    let sum = finish.diffuse.colour + finish.mirror + finish.glossy_f0();
    if is_share(finish.diffuse.colour) && sum.max_channel() > 1.0 + ENERGY_ROUNDING {
        report(
            format!("{side} reflects more light than it receives ({:.4})", sum.max_channel()),
            "lower diffuse, mirror or specular reflectance until they sum to at most 1".into(),
        );
    }
    if let Some(alpha) = finish.gloss.map(|g| g.alpha).filter(|a| !(*a > 0.0 && *a <= 1.0)) {
        report(format!("{side} roughness {alpha} is not in (0, 1]"), "use a mirror for 0".into());
    }
    if finish.luminance_cd_m2.min_channel() < 0.0 || !finish.luminance_cd_m2.is_finite() {
        report(
            format!("{side} luminance {:?} cd/m2", finish.luminance_cd_m2.0),
            "give numbers of zero or more".into(),
        );
    }
    if finish.diffuse.texture.is_some_and(|t| t as usize >= textures) {
        report(format!("{side} names a texture that does not exist"), "name one that does".into());
    }
}

fn check_coat(finish: &Finish, side: &str, report: Report) {
    let Some(Coat { cover, alpha }) = finish.coat else { return };
    if !(cover > 0.0 && cover <= 1.0) {
        let what = format!("{side} coat covers {cover} of the surface");
        report(what, "give a share above 0 to 1, or leave the coat out".into());
    }
    if !(alpha > 0.0 && alpha <= 1.0) {
        let what = format!("{side} coat has an alpha of {alpha}, not in (0, 1]");
        report(what, "give a roughness above 0 to 1; its square is alpha".into());
    }
    if !finish.mirror.is_black() {
        let what = format!("{side} has a coat over a mirror");
        report(what, "use gloss of a small roughness in place of the mirror".into());
    }
}

fn is_share(value: Rgb) -> bool {
    value.min_channel() >= 0.0 && value.max_channel() <= 1.0 + ENERGY_ROUNDING && value.is_finite()
}

fn texture_is_whole(texture: &Texture) -> bool {
    let pixels = texture.width as usize * texture.height as usize;
    pixels > 0 && texture.srgb.len() == 3 * pixels
}

fn check_luminaire(luminaire: &Luminaire, groups: usize, report: Report) {
    let mut say = |what: String, remedy: &str| report(what, remedy.into());
    if luminaire.group as usize >= groups.max(1) {
        say(format!("group {} does not exist", luminaire.group), "name one that does");
    }
    if luminaire.colour.min_channel() < 0.0 || !luminaire.colour.is_finite() {
        say(format!("colour {:?}", luminaire.colour.0), "give numbers of zero or more");
    }
    match &luminaire.kind {
        LuminaireKind::Point { position, intensity, area, .. } => {
            let is_size = |half: f64| half.is_finite() && half >= 0.0;
            let is_bad = |area: LuminousArea| {
                !area.half_m.into_iter().all(is_size)
                    || !area.middle_m.into_iter().all(f64::is_finite)
            };
            if area.is_some_and(is_bad) {
                say("its luminous area has no size".into(), "give finite sizes of zero or more");
            }
            if !position.is_finite() {
                say("its position is not finite".into(), "give three numbers in metres");
            }
            if let Some(what) = intensity_problem(intensity) {
                say(what, "give finite intensities of zero or more");
            }
        }
        LuminaireKind::Directional { illuminance_lx, half_angle_rad, .. } => {
            if !(*illuminance_lx >= 0.0 && illuminance_lx.is_finite()) {
                say(format!("illuminance {illuminance_lx} lx"), "give a number of zero or more");
            }
            if !(0.0..FRAC_PI_2).contains(half_angle_rad) {
                let what = format!("half angle {half_angle_rad} rad");
                say(what, "give an angle below a quarter circle; the sun's is 0.00465");
            }
        }
        LuminaireKind::Sky { sky, .. } => {
            if !sky.is_sound() {
                say("its luminance is no number".into(), "give finite numbers of zero or more");
            }
        }
    }
}

fn intensity_problem(intensity: &IntensityDistribution) -> Option<String> {
    let bad = |value: f64| !(value >= 0.0 && value.is_finite());
    match *intensity {
        IntensityDistribution::Isotropic { intensity_cd } => {
            bad(intensity_cd).then(|| format!("intensity {intensity_cd} cd"))
        }
        IntensityDistribution::CosinePower { peak_cd, exponent } => (bad(peak_cd) || bad(exponent))
            .then(|| format!("intensity {peak_cd} cd, exponent {exponent}")),
        IntensityDistribution::Spot { peak_cd, inner_rad, outer_rad } => (bad(peak_cd)
            || !(0.0 <= inner_rad && inner_rad < outer_rad && outer_rad <= std::f64::consts::PI))
            .then(|| {
                format!(
                    "intensity {peak_cd} cd, inner angle {inner_rad} rad, outer {outer_rad} rad"
                )
            }),
        // A web was checked when it was made.
        IntensityDistribution::Web(_) => None,
    }
}

fn camera_problem(camera: &Camera) -> Option<(String, &'static str)> {
    if !camera.position.is_finite() {
        return Some(("its position is not finite".into(), "give three numbers in metres"));
    }
    let fov = camera.vertical_fov_rad;
    if !(fov > 0.0 && fov < std::f64::consts::PI) {
        return Some((
            format!("opening angle {fov} rad"),
            "give an angle between 0 and 180 degrees",
        ));
    }
    (camera.up.dot(camera.direction).abs() > 1.0 - 1e-9)
        .then(|| ("it looks along its own up".into(), "choose another up direction"))
}
