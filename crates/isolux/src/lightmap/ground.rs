//! Covered texels and their neighbours.

use super::cover::Fragment;
use super::layout::Layout;

/// Number of a texel that covers nothing, among those that do.
const NOTHING: u32 = u32::MAX;

/// Texels that cover something, in their order.
pub(super) struct Ground<'a> {
    /// What each of them covers.
    pub(super) texels: Vec<&'a [Fragment]>,
    numbers: Vec<u32>,
    width: usize,
    height: usize,
}

impl<'a> Ground<'a> {
    /// From all fragments.
    pub(super) fn of(layout: &Layout, fragments: &'a [Fragment]) -> Self {
        let texels: Vec<&[Fragment]> = fragments.chunk_by(|a, b| a.texel == b.texel).collect();
        let mut numbers = vec![NOTHING; layout.texel_count()];
        for (number, of_texel) in texels.iter().enumerate() {
            numbers[of_texel[0].texel as usize] = number as u32;
        }
        let (width, height) = (layout.width as usize, layout.height as usize);
        Self { texels, numbers, width, height }
    }

    /// Column of a texel, and its row among those of all pages.
    pub(super) fn place(&self, number: usize) -> [usize; 2] {
        let texel = self.texels[number][0].texel as usize;
        [texel % self.width, texel / self.width]
    }

    /// Numbers of the texels around one, on its page. Charts lie apart, so that these are of its chart.
    pub(super) fn around(&self, number: usize) -> impl Iterator<Item = usize> + '_ {
        let [x, row] = self.place(number);
        let first = row - row % self.height;
        let near =
            |at: usize, low: usize, high: usize| at.saturating_sub(1).max(low)..(at + 2).min(high);
        near(row, first, first + self.height)
            .flat_map(move |row| near(x, 0, self.width).map(move |x| row * self.width + x))
            .map(|texel| self.numbers[texel])
            .filter(move |&found| found != NOTHING && found as usize != number)
            .map(|found| found as usize)
    }

    /// The chart of every texel, or the part of a chart that hangs together, by the number of its first texel.
    pub(super) fn charts(&self) -> Vec<u32> {
        let mut charts = vec![NOTHING; self.texels.len()];
        let mut waiting = Vec::new();
        for first in 0..charts.len() {
            if charts[first] != NOTHING {
                continue;
            }
            charts[first] = first as u32;
            waiting.push(first);
            while let Some(at) = waiting.pop() {
                for next in self.around(at) {
                    if charts[next] == NOTHING {
                        charts[next] = first as u32;
                        waiting.push(next);
                    }
                }
            }
        }
        charts
    }
}
