//! Lettering.

use crate::picture::Picture;
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

/// Lines of a legend in the height of a picture: letters of about 10 points where the picture is as high as a hand is long.
const LINES_BESIDE: f64 = 30.0;
/// The same of numbers within the picture, which should not hide it.
const LINES_WITHIN: f64 = 45.0;
/// Heights that there are, pixels; others are multiples of them.
const HEIGHTS: [RasterHeight; 4] =
    [RasterHeight::Size16, RasterHeight::Size20, RasterHeight::Size24, RasterHeight::Size32];

/// Lettering of one size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Font {
    raster: RasterHeight,
    /// Pixels along a side of what is one pixel of the raster.
    scale: usize,
}

impl Font {
    /// Lines of this height, pixels, or the next smaller one that there is; at least of 16.
    pub(crate) fn of_height(height: f64) -> Self {
        let largest = RasterHeight::Size32.val() as f64;
        let scale = (height / largest).round().max(1.0);
        let fits = |raster: &&RasterHeight| raster.val() as f64 * scale <= height;
        let raster = *HEIGHTS.iter().rev().find(fits).unwrap_or(&RasterHeight::Size16);
        Self { raster, scale: scale as usize }
    }

    /// The size that can be read in a picture of this height, in pixels.
    pub(crate) fn for_picture(height: u32) -> Self {
        Self::of_height(f64::from(height) / LINES_BESIDE)
    }

    /// The size of numbers within a picture of this height.
    pub(crate) fn for_labels(height: u32) -> Self {
        Self::of_height(f64::from(height) / LINES_WITHIN)
    }

    /// Height of a line, pixels.
    pub(crate) fn height(self) -> i64 {
        (self.raster.val() * self.scale) as i64
    }

    /// Width of a text, pixels.
    pub(crate) fn width(self, text: &str) -> i64 {
        let letter = get_raster_width(FontWeight::Regular, self.raster) * self.scale;
        (text.chars().count() * letter) as i64
    }

    /// Writes a line from its top left corner. Letters beyond Latin-1 become question marks.
    pub(crate) fn write(self, on: &mut Picture, (x, y): (i64, i64), text: &str, colour: [u8; 3]) {
        let raster = |letter| get_raster(letter, FontWeight::Regular, self.raster);
        let mut left = x;
        for letter in text.chars() {
            let Some(glyph) = raster(letter).or_else(|| raster('?')) else { continue };
            let (width, height) = (glyph.width() * self.scale, glyph.height() * self.scale);
            for (dy, dx) in (0..height).flat_map(|dy| (0..width).map(move |dx| (dy, dx))) {
                let ink = glyph.pixel(dx / self.scale, dy / self.scale).unwrap_or(0);
                let opacity = f64::from(ink) / 255.0;
                on.blend(left + dx as i64, y + dy as i64, colour, opacity);
            }
            left += width as i64;
        }
    }
}

/// Breaks a text into lines of at most `letters` letters, between words where it can, and ends it
/// with an ellipsis where it is longer than `lines` lines.
pub(crate) fn wrapped(text: &str, letters: usize, lines: usize) -> Vec<String> {
    let mut done: Vec<String> = vec![String::new()];
    for word in text.split_whitespace() {
        for piece in word.chars().collect::<Vec<_>>().chunks(letters.max(1)) {
            let line = done.last_mut().map(|line| (line.chars().count(), line));
            match line {
                Some((0, line)) => line.extend(piece),
                Some((used, line)) if used + 1 + piece.len() <= letters => {
                    line.push(' ');
                    line.extend(piece);
                }
                _ => done.push(piece.iter().collect()),
            }
        }
    }
    if done.len() > lines {
        done.truncate(lines);
        if let Some(last) = done.last_mut() {
            let kept: String = last.chars().take(letters.saturating_sub(3)).collect();
            *last = kept + "...";
        }
    }
    done.retain(|line| !line.is_empty());
    done
}

/// A text within XML.
pub(crate) fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            c if c.is_control() => safe.push(' '),
            c => safe.push(c),
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_are_as_high_as_a_picture_calls_for() {
        for (picture, letters) in
            [(120, 16), (720, 24), (1080, 32), (1440, 48), (2160, 64), (4320, 120)]
        {
            assert_eq!(Font::for_picture(picture).height(), letters, "{picture}");
        }
    }

    #[test]
    fn lines_break_between_words() {
        for (text, letters, lines, expected) in [
            ("", 10, 2, vec![]),
            ("one", 10, 2, vec!["one"]),
            ("meeting room two", 8, 3, vec!["meeting", "room two"]),
            ("illuminance", 5, 3, vec!["illum", "inanc", "e"]),
            ("a long name of a scene", 6, 2, vec!["a long", "nam..."]),
        ] {
            assert_eq!(wrapped(text, letters, lines), expected, "{text}");
        }
    }
}
