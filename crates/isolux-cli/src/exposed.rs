//! Pictures in which nothing is to be seen: too little or too much light for their exposure.

use crate::notes::{Note, note};
use crate::quantity::{show_share, significant};
use isolux_view::{Development, Exposure, LuminanceImage, Picture, ToneOperator};

/// Shares of the lit pixels that are black or burnt out from which on nothing is to be seen.
const NEARLY_ALL: f64 = 0.99;
/// The brightest channel of a pixel that is told from black by nobody: a thousandth of white.
const BLACK_UP_TO: u8 = 3;

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
        return Some(
            "nothing that the camera sees is lit: the picture is black; check where it looks"
                .into(),
        );
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
