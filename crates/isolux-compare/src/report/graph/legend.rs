//! What stands beneath a graph: its lines by name, in as few rows as they fit into.

use super::sheet::{ENTRY_GAP, FONT, MARGIN, ROW, SWATCH, SWATCH_GAP, WIDTH, text_width};

/// An entry: its number among all, and where it begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) entry: usize,
    pub(super) x: i32,
    /// The middle of its row, from the top of the legend.
    pub(super) y: i32,
}

/// Where entries stand, and the height of all rows.
pub(super) fn places(titles: &[String]) -> (Vec<Place>, i32) {
    let (mut x, mut row) = (MARGIN, 0);
    let mut places = Vec::new();
    for (entry, title) in titles.iter().enumerate() {
        let width = SWATCH + SWATCH_GAP + text_width(title, FONT);
        if x > MARGIN && x + width > WIDTH - MARGIN {
            (x, row) = (MARGIN, row + 1);
        }
        places.push(Place { entry, x, y: row * ROW + ROW / 2 });
        x += width + ENTRY_GAP;
    }
    let rows = if titles.is_empty() { 0 } else { row + 1 };
    (places, rows * ROW)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_stay_within_the_sheet() {
        let titles: Vec<String> = (1..9).map(|k| "name ".repeat(k)).collect();
        let (places, height) = places(&titles);
        assert_eq!(places.len(), titles.len());
        for place in places {
            assert!(place.x >= MARGIN && place.y < height);
            let width = SWATCH + SWATCH_GAP + text_width(&titles[place.entry], FONT);
            assert!(place.x == MARGIN || place.x + width <= WIDTH - MARGIN);
        }
        assert_eq!(super::places(&[]), (vec![], 0));
    }
}
