//! Luminaires as entries.

use super::arrays::{Run, next_run};
use super::lamps::Catalogue;
use super::numbers::shortest;
use super::skies;
use super::text::{colour, number, quoted, triple};
use isolux::geometry::{Direction, Transform, Vector};
use isolux::photometry::IntensityDistribution;
use isolux::scene::{
    AreaShape, Fitting, LuminaireKind, LuminousArea, SceneParts, UpAxis, world_from_luminaire,
};
use isolux::units::Rgb;

pub(super) fn text(parts: &SceneParts, catalogue: &Catalogue) -> String {
    let mut toml = String::new();
    for group in &parts.groups {
        toml += &format!("\n[[group]]\nname = {}\n", quoted(group));
    }
    let mut rest = &parts.luminaires[..];
    let mut fittings = &parts.fittings[..];
    while let Some((run, length)) = next_run(rest, fittings) {
        let fitting = fittings.first().copied().unwrap_or_default();
        toml += &entry(parts, &run, fitting, catalogue);
        rest = &rest[length..];
        fittings = &fittings[length.min(fittings.len())..];
    }
    toml
}

fn entry(parts: &SceneParts, run: &Run, fitting: Fitting, catalogue: &Catalogue) -> String {
    let mut toml = String::from("\n[[luminaire]]\n");
    let mut line = |key: &str, value: String| toml += &format!("{key} = {value}\n");
    line("name", quoted(run.name));
    if let Some(group) = parts.groups.get(run.first.group as usize) {
        line("group", quoted(group));
    }
    if run.first.colour != Rgb::WHITE {
        line("colour", colour(run.first.colour));
    }
    if let Some(power_w) = fitting.power_w {
        line("power_w", number(power_w));
    }
    if let Some(share) = fitting.emergency_share {
        line("emergency_flux_share", number(share));
    }
    match &run.first.kind {
        LuminaireKind::Directional { direction, illuminance_lx, half_angle_rad } => {
            line("direction", triple((*direction).to_vector().into()));
            let lx = number(*illuminance_lx);
            let makes = |deg: f64| (0.5 * deg).to_radians() == *half_angle_rad;
            let angle = match *half_angle_rad > 0.0 {
                true => {
                    let angle_deg = shortest(2.0 * half_angle_rad.to_degrees(), makes);
                    format!(", angle_deg = {}", number(angle_deg))
                }
                false => String::new(),
            };
            line("directional", format!("{{ illuminance_lx = {lx}{angle} }}"));
        }
        LuminaireKind::Sky { world_from_sky, sky } => {
            line("sky", skies::value(parts, world_from_sky, sky));
        }
        LuminaireKind::Point { position, world_from_luminaire, intensity, area } => {
            let (key, value, dimming) = light(intensity, catalogue);
            line(key, value);
            if let Some(area) = luminous_area(*area, intensity) {
                line("luminous_area", area);
            }
            if dimming != 1.0 {
                line("dimming", number(dimming));
            }
            line("position", triple((*position).into()));
            let (aim, rotate_deg) = stand(parts.up, world_from_luminaire);
            if aim != -parts.up.direction() {
                line("direction", triple(aim.to_vector().into()));
            }
            if rotate_deg != 0.0 {
                line("rotate_deg", number(rotate_deg));
            }
        }
    }
    if let Some((counts, steps)) = run.array {
        line("array", format!("{{ count = {counts:?}, step = {} }}", triple(steps)));
    }
    toml
}

/// Key and value of a distribution, and how far it is dimmed.
fn light(intensity: &IntensityDistribution, catalogue: &Catalogue) -> (&'static str, String, f64) {
    match intensity {
        IntensityDistribution::Isotropic { intensity_cd } => {
            ("isotropic", format!("{{ intensity_cd = {} }}", number(*intensity_cd)), 1.0)
        }
        IntensityDistribution::CosinePower { peak_cd, exponent } => {
            let (peak, exponent) = (number(*peak_cd), number(*exponent));
            ("cosine", format!("{{ peak_cd = {peak}, exponent = {exponent} }}"), 1.0)
        }
        IntensityDistribution::Spot { peak_cd, inner_rad, outer_rad } => {
            let degrees =
                |rad: f64| number(shortest(rad.to_degrees(), |deg| deg.to_radians() == rad));
            let [inner, outer] = [*inner_rad, *outer_rad].map(degrees);
            let peak = number(*peak_cd);
            let value = format!("{{ peak_cd = {peak}, inner_deg = {inner}, outer_deg = {outer} }}");
            ("spot", value, 1.0)
        }
        IntensityDistribution::Web(web) => {
            let (name, dimming) = catalogue.find(web).unwrap_or_default();
            ("ies", quoted(name), dimming)
        }
    }
}

/// The luminous area as a value; `None` where it follows from the distribution.
fn luminous_area(area: Option<LuminousArea>, intensity: &IntensityDistribution) -> Option<String> {
    let Some(LuminousArea { shape, half_m, middle_m }) = area else {
        return matches!(intensity, IntensityDistribution::Web(_)).then(|| "\"point\"".to_owned());
    };
    let shape = match shape {
        AreaShape::Box => "box",
        AreaShape::CylinderX => "cylinder_x",
        AreaShape::CylinderY => "cylinder_y",
        AreaShape::CylinderZ => "cylinder_z",
        AreaShape::Ellipsoid => "ellipsoid",
    };
    let size_m = triple(half_m.map(|half| 2.0 * half));
    let middle = match middle_m == [0.0; 3] {
        true => String::new(),
        false => format!(", middle_m = {}", triple(middle_m)),
    };
    Some(format!("{{ shape = {}, size_m = {size_m}{middle} }}", quoted(shape)))
}

/// Aim and turn (degrees) of which [`world_from_luminaire`] makes a rotation.
fn stand(up: UpAxis, rotation: &Transform) -> (Direction, f64) {
    let down = -up.direction();
    let aim = rotation.vector(Vector::new(0.0, 0.0, -1.0)).direction().unwrap_or(down);
    // Without the sign of a zero, straight down is straight down.
    let aim = if aim.to_vector() == down.to_vector() { down } else { aim };
    let [x, y, _] = world_from_luminaire(up, aim, 0.0).columns;
    let c0 = rotation.columns[0];
    let turn_deg = libm::atan2(c0.dot(y), c0.dot(x)).to_degrees();
    let makes = |deg: f64| world_from_luminaire(up, aim, deg) == *rotation;
    let found = [turn_deg, turn_deg + 360.0].map(|deg| shortest(deg, makes));
    (aim, found.into_iter().find(|&deg| makes(deg)).unwrap_or(turn_deg))
}
