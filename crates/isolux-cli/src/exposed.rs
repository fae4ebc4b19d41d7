//! Views in which nothing is to be seen: no light, or too little or too much of it for their exposure.

use crate::failure::Failure;
use crate::notes::{Note, note};
use crate::quantity::{show_share, significant};
use crate::shown::name;
use isolux_view::{Development, Exposure, LuminanceImage, Picture, Sight, ToneOperator};

/// Shares of the lit pixels that are black or burnt out from which on nothing is to be seen.
const NEARLY_ALL: f64 = 0.99;
/// The brightest channel of a pixel that is told from black by nobody: a thousandth of white.
const BLACK_UP_TO: u8 = 3;

/// From this share of backs on the eye is taken to be inside of a solid.
const MOSTLY_BACKS: f64 = 0.9;

/// Refuses a view that would be a black picture: without light, or with next to nothing of what it sees in any. A chart shows 0 lx of
/// what is known to be dark.
pub(crate) fn check(
    view: &LuminanceImage,
    camera: &str,
    charts_alone: bool,
) -> Result<(), Failure> {
    let pixels = 0..view.size().pixels();
    let is_seen =
        |&pixel: &usize| view.samples(pixel).iter().any(|seen| seen.sight != Sight::Background);
    let shines = |pixel| view.luminance_cd_m2(pixel).luminance() > 0.0;
    // Black surfaces in light are lit, too.
    let is_lit = |pixel| match view.reading(pixel) {
        Some(reading) => charts_alone || reading.illuminance_lx > 0.0 || shines(pixel),
        None => shines(pixel),
    };
    let seen: Vec<usize> = pixels.filter(is_seen).collect();
    let share = |count: usize| count as f64 / seen.len().max(1) as f64;
    let lit = share(seen.iter().filter(|&&pixel| is_lit(pixel)).count());
    let has_light = charts_alone || seen.iter().any(|&pixel| shines(pixel));
    if lit > 1.0 - NEARLY_ALL && has_light {
        return Ok(());
    }
    let is_back = |&&pixel: &&usize| view.surface(pixel).is_some_and(|surface| surface.back);
    let (what, remedy) = match () {
        () if seen.is_empty() => {
            ("sees no surface", "look towards the scene, or leave the view out for one inside")
        }
        () if share(seen.iter().filter(is_back).count()) >= MOSTLY_BACKS => (
            "sees nothing but unlit backs of surfaces: it is inside of a solid, or behind a wall",
            "move it into the room",
        ),
        () => (
            "sees no light on any surface: it is inside of a solid, behind a wall, or in the dark",
            "check where it is and where it looks",
        ),
    };
    Err(Failure::bad_input(format!(
        "camera `{}` {what}; the picture would be black and is not written; {remedy}",
        name(camera)
    )))
}

/// Tells of a view that is developed to a picture without anything to be seen.
pub(crate) fn warn(view: &LuminanceImage, picture: &Picture, how: &Development) {
    if let Some(text) = problem(view, picture, how) {
        note(Note::Warning, text);
    }
}

fn problem(view: &LuminanceImage, picture: &Picture, how: &Development) -> Option<String> {
    let is_lit = |&pixel: &usize| view.luminance_cd_m2(pixel).luminance() > 0.0;
    let brightest = |pixel: usize| picture.rgb[pixel].into_iter().max();
    let lit: Vec<u8> = (0..view.size().pixels()).filter(is_lit).filter_map(brightest).collect();
    if lit.is_empty() {
        return None;
    }
    let share = |of: &dyn Fn(u8) -> bool| {
        lit.iter().filter(|&&value| of(value)).count() as f64 / lit.len() as f64
    };
    let black = share(&|value| value <= BLACK_UP_TO);
    let burnt = share(&|value| value == u8::MAX);
    let (share, what) = match () {
        () if black >= NEARLY_ALL => (black, "black"),
        () if burnt >= NEARLY_ALL => (burnt, "burnt out"),
        () => return None,
    };
    let ev = automatic_ev(view).map_or(String::new(), |ev| format!(" (here about ev{ev})"));
    let remedy = match (how.tone, how.exposure) {
        // They show the dark as dark and the dazzling as dazzling, however exposed.
        (ToneOperator::Ward | ToneOperator::TumblinRushmeier, _) => {
            "; --tone reinhard shows it".into()
        }
        (_, Exposure::Automatic) => String::new(),
        _ => format!("; --exposure auto{ev} shows it"),
    };
    Some(format!("{} of what is lit in the picture is {what}{remedy}", show_share(share)))
}

/// The exposure value that the automatic exposure comes to.
fn automatic_ev(view: &LuminanceImage) -> Option<String> {
    let white_cd_m2 = Exposure::Automatic.white_cd_m2(view).ok()?;
    Some(significant(Exposure::ev100_of(white_cd_m2), 2))
}
