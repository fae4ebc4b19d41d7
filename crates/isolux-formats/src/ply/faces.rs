//! The elements `face` and `tristrips`.

use super::body::{Body, Row};
use super::header::{Element, Wrong};
use crate::findings::Findings;
use crate::polygon::MOST_CORNERS;

/// Polygons and strips of triangles.
#[derive(Default)]
pub(super) struct Faces {
    /// Indices of vertices of all polygons, one after the other.
    corners: Vec<u32>,
    /// Where each polygon begins.
    starts: Vec<usize>,
    /// Triangles of strips.
    pub(super) triangles: Vec<[u32; 3]>,
    /// The largest index, and where it stands.
    pub(super) largest: Option<(u32, String)>,
}

impl Faces {
    /// All polygons.
    pub(super) fn polygons(&self) -> impl Iterator<Item = &[u32]> {
        (0..self.starts.len()).map(|k| {
            let end = self.starts.get(k + 1).copied().unwrap_or(self.corners.len());
            &self.corners[self.starts[k]..end]
        })
    }

    pub(super) fn read(
        &mut self,
        element: &Element,
        body: &mut Body,
        row: &mut Row,
        as_strips: bool,
        findings: &mut Findings,
    ) -> Result<(), Wrong> {
        let column = element.find(&["vertex_indices", "vertex_index"]);
        let Some(column) = column.filter(|&k| element.properties[k].length.is_some()) else {
            let what = format!("`{}` without a list `vertex_indices`", element.name);
            return Err(Wrong::at_line(element.line, what));
        };
        if element.properties.len() > 1 {
            let others = element.properties.iter().enumerate().filter(|(k, _)| *k != column);
            let names: Vec<&str> = others.map(|(_, p)| p.name.as_str()).collect();
            let what = format!("properties `{}` of faces are not used", names.join("`, `"));
            findings.warning(format!("line {}", element.line), what, "nothing needs to be done");
        }
        for _ in 0..element.count {
            body.row(element, row)?;
            let list = row.list(column);
            let taken = if as_strips { self.strip(list) } else { self.polygon(list) };
            let largest = taken.map_err(|what| Wrong { place: body.place(), what })?;
            if self.largest.as_ref().is_none_or(|(known, _)| largest > *known) {
                self.largest = Some((largest, body.place()));
            }
        }
        Ok(())
    }

    /// Adds a polygon; its largest index.
    fn polygon(&mut self, list: &[f64]) -> Result<u32, String> {
        if list.len() < 3 {
            return Err(format!("a face of {} corners", list.len()));
        }
        if list.len() > MOST_CORNERS {
            return Err(format!("a face of more than {MOST_CORNERS} corners"));
        }
        self.starts.push(self.corners.len());
        let mut largest = 0;
        for &value in list {
            let vertex = index(value)?;
            largest = largest.max(vertex);
            self.corners.push(vertex);
        }
        Ok(largest)
    }

    /// Adds strips, which -1 separates; the triangles of each turn one way and the other.
    fn strip(&mut self, list: &[f64]) -> Result<u32, String> {
        let mut largest = 0;
        for strip in list.split(|&value| value == -1.0) {
            for (k, corners) in strip.windows(3).enumerate() {
                let [a, b, c] = [index(corners[0])?, index(corners[1])?, index(corners[2])?];
                largest = largest.max(a).max(b).max(c);
                self.triangles.push(if k % 2 == 0 { [a, b, c] } else { [b, a, c] });
            }
        }
        Ok(largest)
    }
}

fn index(value: f64) -> Result<u32, String> {
    let is_index = value >= 0.0 && value <= f64::from(u32::MAX) && value.fract() == 0.0;
    is_index.then_some(value as u32).ok_or_else(|| format!("{value} is not the index of a vertex"))
}
