//! What the colours and symbols of a plan mean.

use super::isolines::number;
use super::levels::Levels;
use super::symbols;
use crate::drawing::{Anchor, At, Drawing, Ink, Lettering, Letters, Line, Mark};

const INK: Ink = [20; 3];
const BAR_WIDTH: f64 = 28.0;
/// A band is as high as there is room for, pixels.
const BAND: (f64, f64) = (16.0, 44.0);
const ROW: f64 = 26.0;

type Symbol = fn(&mut Drawing, At);

/// Symbols that stand on the plan.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Shown {
    pub(super) cut: bool,
    pub(super) behind: bool,
    pub(super) openings: bool,
    pub(super) points: bool,
    /// Whether luminaires are dots.
    pub(super) is_crowded: bool,
    /// Whether the grid is level: what lies behind it is below.
    pub(super) is_level: bool,
}

/// Width, pixels.
pub(super) const WIDTH: f64 = 190.0;

/// The height that a legend takes at least, pixels.
pub(super) fn least_height(levels: &Levels) -> f64 {
    30.0 + (levels.lux.len() as f64 + 1.0) * BAND.0 + 20.0 + 6.0 * ROW
}

/// Draws it from its upper left corner; it may be so high.
pub(super) fn draw(
    on: &mut Drawing,
    ([left, top], height): (At, f64),
    title: &str,
    levels: &Levels,
    shown: Shown,
) {
    write(on, [left, top + 8.0], title);
    let inks = levels.inks();
    let band = ((height - 30.0 - 20.0 - 6.0 * ROW) / inks.len() as f64).clamp(BAND.0, BAND.1);
    let bar_top = top + 30.0;
    let at = |below: f64| bar_top + below * band;
    for (k, ink) in inks.iter().rev().enumerate() {
        let rectangle = |low: f64, high: f64| {
            vec![[left, low], [left + BAR_WIDTH, low], [left + BAR_WIDTH, high], [left, high]]
        };
        on.add(Mark::Area { rings: vec![rectangle(at(k as f64), at(k as f64 + 1.0))], ink: *ink });
    }
    let bottom = at(inks.len() as f64);
    let ring = vec![
        [left, bar_top],
        [left + BAR_WIDTH, bar_top],
        [left + BAR_WIDTH, bottom],
        [left, bottom],
    ];
    on.line(Line::around(ring, 1.0, INK));
    for (k, level) in levels.lux.iter().rev().enumerate() {
        let y = at(k as f64 + 1.0);
        on.line(Line::solid(vec![[left, y], [left + BAR_WIDTH + 6.0, y]], 1.0, INK));
        write(on, [left + BAR_WIDTH + 12.0, y], &number(*level));
    }
    let mut y = bottom + 20.0 + 0.5 * ROW;
    let rows: [(bool, Symbol, &str); 6] = [
        (
            shown.cut,
            symbols::cut_sample,
            if shown.is_level { "cut at this height" } else { "cut by this plane" },
        ),
        (
            shown.behind,
            symbols::behind_sample,
            if shown.is_level { "just below" } else { "just behind" },
        ),
        (shown.openings, symbols::opening_sample, "luminaire"),
        (
            shown.points,
            if shown.is_crowded { symbols::dot_sample } else { symbols::round_sample },
            "luminaire",
        ),
        (true, symbols::border_sample, "grid"),
        (true, symbols::point, "grid point"),
    ];
    for (_, symbol, text) in rows.into_iter().filter(|(is_shown, ..)| *is_shown) {
        symbol(on, [left + 0.5 * BAR_WIDTH, y]);
        write(on, [left + BAR_WIDTH + 12.0, y], text);
        y += ROW;
    }
}

fn write(on: &mut Drawing, at: At, text: &str) {
    let (anchor, letters) = (Anchor::Left, Letters::Small);
    on.text(Lettering { at, anchor, letters, ink: INK, halo: None, text: text.to_owned() });
}
