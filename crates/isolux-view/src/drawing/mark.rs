//! What a drawing is made of.

use crate::text::Font;

/// A place on the sheet, pixels from the top left.
pub(crate) type At = [f64; 2];

/// An sRGB colour.
pub(crate) type Ink = [u8; 3];

/// One thing drawn; later ones lie over earlier ones.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Mark {
    /// Coloured pixels.
    Pixels(Pixels),
    /// An area between rings, where they wind around it by an odd number.
    Area {
        /// Closed rings.
        rings: Vec<Vec<At>>,
        /// Its colour.
        ink: Ink,
    },
    /// A line from place to place.
    Line(Line),
    /// A line of text.
    Text(Lettering),
}

/// Pixels that have a colour or none.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Pixels {
    /// The left column and the upper row.
    pub(crate) left: i64,
    pub(crate) top: i64,
    /// Pixels in a row.
    pub(crate) width: usize,
    /// Rows from the top.
    pub(crate) inks: Vec<Option<Ink>>,
}

/// A line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Line {
    /// Its places.
    pub(crate) points: Vec<At>,
    /// Its width, pixels.
    pub(crate) width: f64,
    pub(crate) ink: Ink,
    /// Lengths of dashes and of gaps between them; `None` for a line without gaps.
    pub(crate) dash: Option<f64>,
}

impl Line {
    pub(crate) fn solid(points: Vec<At>, width: f64, ink: Ink) -> Self {
        Self { points, width, ink, dash: None }
    }

    /// Around a closed ring.
    pub(crate) fn around(mut ring: Vec<At>, width: f64, ink: Ink) -> Self {
        ring.extend(ring.first().copied());
        Self::solid(ring, width, ink)
    }
}

/// The part of a text that stands at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Anchor {
    Left,
    Middle,
    Right,
}

/// How large letters are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Letters {
    Small,
    Large,
}

impl Letters {
    /// The font of pixels.
    pub(super) fn font(self) -> Font {
        Font::of_height(match self {
            Self::Small => 16.0,
            Self::Large => 24.0,
        })
    }
}

/// Width and height of a text, pixels.
pub(crate) fn extent(letters: Letters, text: &str) -> [f64; 2] {
    let font = letters.font();
    [font.width(text) as f64, font.height() as f64]
}

/// A line of text.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lettering {
    /// Where its anchor lies; of its height the middle.
    pub(crate) at: At,
    pub(crate) anchor: Anchor,
    pub(crate) letters: Letters,
    pub(crate) ink: Ink,
    /// A plate and a rim that set it apart from what it lies on.
    pub(crate) halo: Option<Ink>,
    pub(crate) text: String,
}

impl Lettering {
    /// Where it begins.
    pub(super) fn left(&self) -> f64 {
        let width = extent(self.letters, &self.text)[0];
        match self.anchor {
            Anchor::Left => self.at[0],
            Anchor::Middle => self.at[0] - 0.5 * width,
            Anchor::Right => self.at[0] - width,
        }
    }

    /// The upper left and the lower right corner of the plate of its halo: letters fill about three quarters of their line.
    pub(super) fn plate(&self) -> [At; 2] {
        let [width, height] = extent(self.letters, &self.text);
        let (left, half) = (self.left(), 0.375 * height);
        [[left - 1.0, self.at[1] - half], [left + width + 1.0, self.at[1] + half]]
    }
}
