//! What a grid does not say by its figures.

use super::GridResult;
use crate::notes::{Note, note};
use crate::quantity::show_share;
use crate::shown::name;
use isolux::engine::{MapReader, ProbePoint};
use isolux::geometry::{Normal, Point};
use isolux::map::{Illuminance, IlluminationMap};
use rayon::prelude::*;

/// Caustics of less than this share of all light are not worth a word.
const TOLD_FROM: f64 = 1e-3;

/// Points that get no light at all and see nothing that does: as those behind the walls of a room.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Outside {
    /// Within the bounds of the scene.
    within_bounds: usize,
    /// And those beyond.
    beyond_bounds: usize,
}

impl Outside {
    pub(super) fn of(
        (points, values): (&[Point], &[Option<Illuminance>]),
        normal: Normal,
        reader: &MapReader,
    ) -> Self {
        let is_outside = |&(&position, value): &(&Point, &Option<Illuminance>)| {
            let is_dark = value.is_some_and(|value| value.illuminance_lx() == 0.0);
            is_dark && !reader.sees_lit(ProbePoint { position, normal })
        };
        let outside: Vec<_> = points.par_iter().zip(values).filter(is_outside).collect();
        let beyond = outside.iter().filter(|(position, _)| reader.is_beyond_bounds(**position));
        let beyond_bounds = beyond.count();
        Self { within_bounds: outside.len() - beyond_bounds, beyond_bounds }
    }

    const fn count(self) -> usize {
        self.within_bounds + self.beyond_bounds
    }

    /// Where they are.
    fn place(self) -> String {
        match (self.within_bounds, self.beyond_bounds) {
            (_, 0) => "all within the bounds of the scene".into(),
            (0, _) => "all beyond the bounds of the scene".into(),
            (within, beyond) => {
                format!("{beyond} beyond the bounds of the scene, {within} within them")
            }
        }
    }
}

impl GridResult {
    /// Tells what the user should know beside the figures.
    pub(super) fn warn(&self, map: &IlluminationMap) {
        let own = name(&self.grid.name);
        let all = self.points.len();
        let warn = |text: String| note(Note::Warning, format!("grid `{own}`: {text}"));
        let caustics = map.caustic_share();
        if self.in_space && caustics > TOLD_FROM {
            warn(format!(
                "light that glass, gloss and curved mirrors throw is left out, and of the intervals, too, as it is \
                 known on surfaces alone; there it is {} of all light",
                show_share(caustics)
            ));
        }
        let unknown = self.values.iter().filter(|value| value.is_none()).count();
        if unknown > 0 {
            warn(format!("{unknown} of {all} points lie within something and are left out"));
        }
        let is_dark = self.values.iter().flatten().all(|value| value.illuminance_lx() == 0.0);
        let outside = self.outside.count();
        if is_dark && unknown == 0 {
            warn(
                "no light comes to any of its points; check its place, and that its sides `u x v` turn up"
                    .into(),
            );
        } else if outside > 0 {
            warn(format!(
                "{outside} of {all} points get no light and see nothing that is lit, as outside of walls ({}), and count \
                 as 0 lx in all figures; shrink or move the grid so that it lies within its room, or widen its border",
                self.outside.place()
            ));
        }
    }
}
