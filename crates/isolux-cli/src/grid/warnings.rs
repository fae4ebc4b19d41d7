//! What a grid does not say by its figures.

use crate::grid_values::GridValues;
use crate::notes::{Note, note};
use crate::quantity::show_share;
use crate::shown::name;
use crate::unlit::is_dark;
use isolux::engine::MapReader;
use isolux::map::Illuminance;
use isolux_formats::counted;

/// Caustics of less than this share of all light are not worth a word.
const TOLD_FROM: f64 = 1e-3;

/// Points outside of the room.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Outside {
    /// Within the bounds of the scene.
    within_bounds: usize,
    /// And those beyond.
    beyond_bounds: usize,
}

impl Outside {
    pub(super) fn of(read: &GridValues, reader: &MapReader) -> Self {
        let all = read.points.iter().zip(&read.are_outside);
        let outside = || all.clone().filter(|(_, is_outside)| **is_outside);
        let beyond_bounds = outside().filter(|(point, _)| reader.is_beyond_bounds(**point)).count();
        Self { within_bounds: outside().count() - beyond_bounds, beyond_bounds }
    }

    pub(crate) const fn count(&self) -> usize {
        self.within_bounds + self.beyond_bounds
    }

    /// Where they are.
    fn place(&self) -> String {
        match (self.within_bounds, self.beyond_bounds) {
            (_, 0) => "all within the bounds of the scene".into(),
            (0, _) => "all beyond the bounds of the scene".into(),
            (within, beyond) => {
                format!("{beyond} beyond the bounds of the scene, {within} within them")
            }
        }
    }
}

/// Tells what the user should know beside the figures; `caustics` are the share of light that is left out in free space, where
/// points of the grid are.
pub(super) fn warn(
    grid: &str,
    (values, outside): (&[Option<Illuminance>], &Outside),
    caustics: Option<f64>,
) {
    let own = name(grid);
    let all = values.len();
    let warn = |text: String| note(Note::Warning, format!("grid `{own}`: {text}"));
    if let Some(caustics) = caustics.filter(|&share| share > TOLD_FROM) {
        warn(format!(
            "light that glass, gloss and curved mirrors throw is left out, and of the intervals, too, as it is \
             known on surfaces alone; there it is {} of all light",
            show_share(caustics)
        ));
    }
    let unknown = values.iter().filter(|value| value.is_none()).count() - outside.count();
    if unknown > 0 {
        let are = counted(all, "point is", "points are");
        warn(format!("{unknown} of {are} left out, inside an object or where no light reaches"));
    }
    let is_dark = values.iter().flatten().all(is_dark);
    let dark = outside.count();
    if is_dark && unknown == 0 {
        warn(
            "no light reaches any of its points; check its place, and that `u x v` of its sides is the way they are to face"
                .into(),
        );
    } else if dark > 0 {
        warn(format!(
            "{dark} of {all} points get no light and see nothing that is lit, as outside of walls ({}), and are \
             left out of all figures",
            outside.place()
        ));
    }
}
