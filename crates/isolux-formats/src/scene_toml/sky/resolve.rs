//! From the table as written to the luminaires `sky` and `sun`.

use super::kind::Kind;
use super::luminances::{self, Light};
use crate::scene_toml::chromaticity;
use crate::scene_toml::context::Context;
use crate::scene_toml::groups::Grouped;
use crate::scene_toml::record::LightRecord;
use crate::scene_toml::sky_record::SkyRecord;
use crate::scene_toml::spans::{At, Span};
use crate::sun::HALF_ANGLE_DEG;
use isolux::geometry::Direction;
use isolux::photometry::Sky;
use isolux::scene::{Luminaire, LuminaireKind, world_from_sky};
use isolux::units::Rgb;

/// The luminaires `sky` and `sun` that a table means, those that give light; nothing after a problem.
pub(in crate::scene_toml) fn luminaires(
    entry: &At<SkyRecord>,
    context: &mut Context,
) -> Vec<Grouped> {
    made(entry, context).unwrap_or_default()
}

fn made(entry: &At<SkyRecord>, context: &mut Context) -> Option<Vec<Grouped>> {
    let (record, at) = (entry.get_ref(), entry.span());
    let kind = Kind::of(record, &at, context)?;
    kind.refuse_others(record, context);
    let [sky_colour, sun_colour] = colours(record, context);
    let light = luminances::of(kind, record, &at, context)?;
    let world_from_sky =
        world_from_sky(context.up, record.north_deg.as_ref().map_or(0.0, |n| n.get_ref().0));
    let [sky_group, sun_group] = record.groups().map(|name| name.map(str::to_owned));
    let mut made = Vec::new();
    if let Some(sun) = sunlight(&light, &at, context) {
        let direction = -world_from_sky.vector(sun.to_vector()).direction()?;
        let kind = LuminaireKind::Directional {
            direction,
            illuminance_lx: light.sun_normal_lx,
            half_angle_rad: HALF_ANGLE_DEG.to_radians(),
        };
        made.push((sun_group, luminaire("sun", sun_colour?, kind)));
    }
    if shines(&light.sky) {
        let kind = LuminaireKind::Sky { world_from_sky, sky: light.sky };
        made.push((sky_group, luminaire("sky", sky_colour?, kind)));
    }
    if made.is_empty() {
        let what = "neither sky nor sun give light";
        context.warning(&at, what, "remove the sky, or choose another time");
    }
    context.take_luminaires(&at, made.len(), 1).then_some(made)
}

/// Of sky and sun; `None` after a problem.
fn colours(record: &SkyRecord, context: &mut Context) -> [Option<Rgb>; 2] {
    let of = |colour, cct_k| LightRecord { colour, cct_k, ..LightRecord::default() };
    let sky = of(record.colour.as_ref(), record.cct_k.as_ref());
    let sun = of(record.sun_colour.as_ref(), record.sun_cct_k.as_ref());
    [sky, sun]
        .map(|light| chromaticity::given(&light, context).map(|given| given.unwrap_or(Rgb::WHITE)))
}

fn luminaire(name: &str, colour: Rgb, kind: LuminaireKind) -> Luminaire {
    Luminaire { name: name.to_owned(), group: 0, colour, kind }
}

fn shines(sky: &Sky) -> bool {
    sky.most_cd_m2() > 0.0 || sky.mean_cd_m2() > 0.0
}

/// Towards the sun, if it gives light.
fn sunlight(light: &Light, at: &Span, context: &mut Context) -> Option<Direction> {
    let Some(sun) = light.sun else {
        if light.sun_normal_lx > 0.0 {
            let remedy =
                "give `sun = { azimuth_deg = ..., elevation_deg = ... }`, or `place` and `time`";
            context.problem(at, "`sun_normal_lx` of a sun that stands nowhere", remedy);
        }
        return None;
    };
    if sun.position.elevation_deg <= 0.0 {
        let what = format!(
            "the sun is {:.1} degrees below the horizon and gives no light of its own",
            -sun.position.elevation_deg
        );
        context.warning(at, what, "nothing needs to be done if night or twilight is meant");
        return None;
    }
    (light.sun_normal_lx > 0.0).then(|| sun.position.direction())
}
