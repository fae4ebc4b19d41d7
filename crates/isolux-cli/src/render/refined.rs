//! Views in rounds: as many as bring the noise of a picture below what is asked for.

use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::quantity::significant;
use crate::traced::{RoundsState, Watched};
use isolux_view::{
    Development, Gathered, LuminanceImage, Noise, Rounds, Size, View, judged_windows,
};
use serde::Serialize;

/// What is done with a picture that will get better.
pub(super) type Show<'a> = dyn FnMut(&LuminanceImage) -> Result<(), Failure> + 'a;

/// How good a picture is to be.
pub(super) struct Wish<'a> {
    /// The mean noise, CIE94.
    pub(super) goal: f64,
    /// How it is shown: noise counts as it is seen.
    pub(super) how: &'a Development,
}

/// The noise that is left in a picture.
#[derive(Clone, Debug, Serialize)]
pub(super) struct NoiseReport {
    /// Mean over the pixels, CIE94.
    noise_cie94: f64,
    /// What one pixel of a hundred exceeds, CIE94.
    noise_of_few_cie94: f64,
    noise_goal_cie94: f64,
    rounds: u32,
}

impl NoiseReport {
    /// For people.
    pub(super) fn fact(&self) -> (&'static str, String) {
        let [mean, few, goal] =
            [self.noise_cie94, self.noise_of_few_cie94, self.noise_goal_cie94].map(two_digits);
        let rounds = isolux_formats::counted(self.rounds as usize, "round", "rounds");
        (
            "noise",
            format!("{mean} CIE94 in the mean (goal {goal}), {few} in 1 of 100 pixels, {rounds}"),
        )
    }
}

/// The mean of the rounds.
pub(super) struct Refined {
    pub(super) view: LuminanceImage,
    /// Where the indirect light of the first round comes from.
    pub(super) gathered: Gathered,
    pub(super) noise: NoiseReport,
    /// Whether the user stopped it before it was as good as wished.
    pub(super) interrupted: bool,
}

/// Looks until the noise is as wished, or the user stops it. Each picture but the last is shown when it is twice as good in rounds as
/// the one before.
pub(super) fn look(
    watched: &Watched<'_>,
    (from, size): (View, Size),
    wish: &Wish<'_>,
    show: &mut Show<'_>,
) -> Result<Refined, Failure> {
    let (first, gathered) = watched.round((from, size), 0, None)?;
    let mut rounds = Rounds::new(first);
    let mut noise = noise_of_first(watched, (from, size), &mut rounds, wish.how)?;
    let mut interrupted = false;
    let mut shown_at = 0;
    let interrupt = Interrupt::install()?;
    while noise.mean > wish.goal {
        interrupt.has_more_to_keep();
        if rounds.count() >= 2 * shown_at {
            show(rounds.mean())?;
            shown_at = rounds.count();
        }
        if interrupt.is_requested() {
            interrupted = true;
            break;
        }
        let of = noise.rounds_for(wish.goal, rounds.count()).max(rounds.count() + 1);
        let state = RoundsState { noise, goal: wish.goal, of };
        let (more, _) = watched.round((from, size), rounds.count(), Some(&state))?;
        rounds.add(&more);
        noise = rounds.noise(wish.how).map_err(Failure::bad_input)?.unwrap_or(noise);
    }
    interrupt.has_nothing_more_to_keep();
    let report = NoiseReport {
        noise_cie94: noise.mean,
        noise_of_few_cie94: noise.few,
        noise_goal_cie94: wish.goal,
        rounds: rounds.count(),
    };
    Ok(Refined { view: rounds.into_mean(), gathered, noise: report, interrupted })
}

/// The noise of the first round: by windows, or where the picture is small by a second round.
fn noise_of_first(
    watched: &Watched<'_>,
    (from, size): (View, Size),
    rounds: &mut Rounds,
    how: &Development,
) -> Result<Noise, Failure> {
    if let Some((windows, own)) = judged_windows(size) {
        let judged = watched.windows((from, own), windows)?;
        return rounds.noise_by_windows(&judged, how).map_err(Failure::bad_input);
    }
    let (second, _) = watched.round((from, size), 1, None)?;
    rounds.add(&second);
    let noise = rounds.noise(how).map_err(Failure::bad_input)?;
    Ok(noise.expect("there are two rounds"))
}

fn two_digits(value: f64) -> String {
    significant(value, 2)
}
