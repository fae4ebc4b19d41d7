//! Direct light of texels: few places in each, and more where those disagree, be it for the border of a shadow or for
//! the noise of choosing among luminaires.

use super::cover::Fragment;
use super::places::Places;
use crate::sampling::{Key, Sequence};
use crate::units::Rgb;

/// Places of a first look at a texel, and of as many as one may get.
pub(super) const FEW: u32 = 4;
const MANY: u32 = 64;
/// Places of a texel for which there is no time.
pub(super) const FEWEST: u32 = 2;
/// Shadow rays at a place, and where there is no time.
const RAYS: usize = 16;
const FEWEST_RAYS: usize = 4;

/// Mean over places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Direct {
    /// The mean, lx.
    pub(super) lx: Rgb,
    /// Variance of its photometric value by what places differ by, their noise included, lx2.
    pub(super) variance: f64,
    /// Share of the places that the map knows.
    pub(super) known: f64,
}

/// A first look at a texel; nothing where the map knows none of the places.
pub(super) fn look(places: &Places<'_>, fragments: &[Fragment]) -> Option<Direct> {
    mean(places, fragments, (FEW, RAYS), places.key(fragments[0].texel).with(0))
}

/// The same where there is no time.
pub(super) fn glance(places: &Places<'_>, fragments: &[Fragment]) -> Option<Direct> {
    mean(places, fragments, (FEWEST, FEWEST_RAYS), places.key(fragments[0].texel).with(0))
}

/// Direct light as the map interpolates it, where the time is over. Of shadows nothing is known: as if places spread by
/// its own value.
pub(super) fn told(places: &Places<'_>, fragments: &[Fragment]) -> Option<Direct> {
    let lx = places.interpolated_direct(fragments)?;
    Some(Direct { lx, variance: lx.luminance().powi(2), known: 1.0 })
}

/// How many places it takes for an error of `goal_lx`, where a first look has this variance; nothing if that look does.
/// Places are spread evenly: their mean errs by less than those of as many at random, on which this counts.
pub(super) fn needed(variance: f64, goal_lx: f64) -> Option<u32> {
    let more = variance / (goal_lx * goal_lx);
    // What is not a number, neither light nor goal, is not more.
    (more > 1.0).then(|| ((f64::from(FEW) * more) as u32).next_power_of_two().clamp(2 * FEW, MANY))
}

/// So many places, with numbers of their own: who goes on where the first few disagree must not count them.
pub(super) fn look_closely(
    places: &Places<'_>,
    fragments: &[Fragment],
    count: u32,
) -> Option<Direct> {
    mean(places, fragments, (count, RAYS), places.key(fragments[0].texel).with(1))
}

fn mean(
    places: &Places<'_>,
    fragments: &[Fragment],
    (count, rays): (u32, usize),
    key: Key,
) -> Option<Direct> {
    let (over_area, of_light) = (Sequence::new(key), Sequence::new(key.with(3)));
    let read = |index: u32| {
        let place = places.place(fragments, over_area.pair(index, 0));
        places.direct(place, rays, (of_light, index))
    };
    let found: Vec<Rgb> = (0..count).filter_map(read).collect();
    let n = found.len() as f64;
    if found.is_empty() {
        return None;
    }
    let lx = found.iter().copied().sum::<Rgb>() / n;
    let squared = |found: &Rgb| (found.luminance() - lx.luminance()).powi(2);
    // A single known place says nothing about the others: as if they spread by its own value.
    let variance = match found.len() {
        1 => lx.luminance().powi(2),
        _ => found.iter().map(squared).sum::<f64>() / (n - 1.0) / n,
    };
    Some(Direct { lx, variance, known: n / f64::from(count) })
}
