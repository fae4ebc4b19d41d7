//! Lettering.

use crate::picture::Picture;
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

/// Lettering of one size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Font(RasterHeight);

impl Font {
    /// The size that can be read in a picture of this height, in pixels.
    pub(crate) fn for_picture(height: u32) -> Self {
        Self(match height {
            0..640 => RasterHeight::Size16,
            640..960 => RasterHeight::Size20,
            960..1440 => RasterHeight::Size24,
            _ => RasterHeight::Size32,
        })
    }

    /// The size of numbers within a picture of this height, which should not hide it.
    pub(crate) fn for_labels(height: u32) -> Self {
        Self(match height {
            0..960 => RasterHeight::Size16,
            960..1440 => RasterHeight::Size20,
            _ => RasterHeight::Size24,
        })
    }

    /// Height of a line, pixels.
    pub(crate) fn height(self) -> i64 {
        self.0.val() as i64
    }

    /// Width of a text, pixels.
    pub(crate) fn width(self, text: &str) -> i64 {
        text.chars().count() as i64 * get_raster_width(FontWeight::Regular, self.0) as i64
    }

    /// Writes a line from its top left corner. Letters beyond Latin-1 become question marks.
    pub(crate) fn write(self, on: &mut Picture, (x, y): (i64, i64), text: &str, colour: [u8; 3]) {
        let raster = |letter| get_raster(letter, FontWeight::Regular, self.0);
        let mut left = x;
        for letter in text.chars() {
            let Some(glyph) = raster(letter).or_else(|| raster('?')) else { continue };
            for (dy, row) in glyph.rows().enumerate() {
                for (dx, &ink) in row.iter().enumerate() {
                    let opacity = f64::from(ink) / 255.0;
                    on.blend(left + dx as i64, y + dy as i64, colour, opacity);
                }
            }
            left += glyph.width() as i64;
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
