//! What lines look like: each by colour, by marker and by dashes, so that one of them is enough to tell them apart.

/// A marker, as corners about its middle in units of its size; none of a circle.
pub(super) enum Marker {
    Circle,
    Corners(&'static [(f64, f64)]),
}

/// What a line looks like.
pub(super) struct Look {
    /// By day and in the dark, as CSS has it.
    pub(super) colour: [&'static str; 2],
    /// Lengths of dashes and gaps, none of a full line.
    pub(super) dashes: &'static str,
    pub(super) marker: Marker,
    /// Whether the marker is filled.
    pub(super) is_filled: bool,
}

const SQUARE: Marker =
    Marker::Corners(&[(-0.85, -0.85), (0.85, -0.85), (0.85, 0.85), (-0.85, 0.85)]);
const UP: Marker = Marker::Corners(&[(0.0, -1.15), (1.05, 0.75), (-1.05, 0.75)]);
const DOWN: Marker = Marker::Corners(&[(0.0, 1.15), (1.05, -0.75), (-1.05, -0.75)]);
const DIAMOND: Marker = Marker::Corners(&[(0.0, -1.25), (1.1, 0.0), (0.0, 1.25), (-1.1, 0.0)]);
const SANDGLASS: Marker = Marker::Corners(&[(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)]);

/// In the order of [`crate::study::System::ALL`]: colours of Okabe and Ito (2008), some made lighter on dark paper; forward methods are blue, those of
/// radiosity red and yellow.
pub(super) const LOOKS: [Look; 10] = [
    look(["#1a1a1a", "#f2f2f2"], "", Marker::Circle, true),
    look(["#0072b2", "#3f9fdc"], "", SQUARE, true),
    look(["#56b4e9", "#9bd5f7"], "60 35", SQUARE, false),
    look(["#d55e00", "#f07a24"], "", UP, true),
    look(["#e69f00", "#f0b437"], "60 35", UP, false),
    look(["#cc79a7", "#dd97bd"], "15 30", DOWN, true),
    look(["#009e73", "#23bd92"], "110 30 15 30", DIAMOND, true),
    look(["#7a7a00", "#c9c95a"], "110 30", DIAMOND, false),
    look(["#7f5539", "#c49a7c"], "60 35", SANDGLASS, true),
    look(["#5b4b8a", "#a99bd6"], "15 30", Marker::Circle, false),
];

const fn look(
    colour: [&'static str; 2],
    dashes: &'static str,
    marker: Marker,
    is_filled: bool,
) -> Look {
    Look { colour, dashes, marker, is_filled }
}

/// The look of a number; of those beyond the last they begin again.
pub(super) fn of(number: usize) -> &'static Look {
    &LOOKS[number % LOOKS.len()]
}

/// Rules of CSS for graphs: their colours by day and in the dark.
pub(crate) fn css() -> String {
    let colours = |k: usize| -> String {
        let one = |(number, look): (usize, &Look)| format!("--line-{number}:{};", look.colour[k]);
        LOOKS.iter().enumerate().map(one).collect()
    };
    let dashes = |(number, look): (usize, &Look)| match look.dashes {
        "" => String::new(),
        dashes => format!(".graph .l{number}{{stroke-dasharray:{dashes}}}\n"),
    };
    let lines = |number: usize| {
        format!(
            ".graph .l{number},.graph .m{number}{{stroke:var(--line-{number})}}\n\
             .graph .f{number}{{fill:var(--line-{number})}}\n"
        )
    };
    format!(
        ":root{{{}}}\n@media screen and (prefers-color-scheme:dark){{:root{{{}}}}}\n{}{}",
        colours(0),
        colours(1),
        (0..LOOKS.len()).map(lines).collect::<String>(),
        LOOKS.iter().enumerate().map(dashes).collect::<String>(),
    )
}
