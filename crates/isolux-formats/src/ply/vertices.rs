//! The element `vertex`.

use super::body::{Body, Row};
use super::header::{Element, Property, Scalar, Wrong};
use crate::findings::Findings;

/// All vertices, and of each what the file says.
#[derive(Default)]
pub(super) struct Vertices {
    pub(super) positions: Vec<[f64; 3]>,
    pub(super) normals: Option<Vec<[f64; 3]>>,
    /// `v` upwards, as written.
    pub(super) uvs: Option<Vec<[f64; 2]>>,
    /// sRGB.
    pub(super) colours: Option<Vec<[u8; 3]>>,
}

const NORMAL: [&[&str]; 3] = [&["nx"], &["ny"], &["nz"]];
const UV: [&[&str]; 2] =
    [&["u", "s", "texture_u", "texture_s"], &["v", "t", "texture_v", "texture_t"]];
const COLOUR: [&[&str]; 3] = [
    &["red", "r", "diffuse_red"],
    &["green", "g", "diffuse_green"],
    &["blue", "b", "diffuse_blue"],
];

/// Where properties stand in a row; `None` where one is missing.
fn columns<const N: usize>(element: &Element, names: [&[&str]; N]) -> Option<[usize; N]> {
    let mut found = [0; N];
    for (column, names) in found.iter_mut().zip(names) {
        *column = element.find(names)?;
    }
    Some(found)
}

impl Vertices {
    pub(super) fn read(
        &mut self,
        element: &Element,
        body: &mut Body,
        row: &mut Row,
        findings: &mut Findings,
    ) -> Result<(), Wrong> {
        let Some(place) = columns(element, [&["x"], &["y"], &["z"]]) else {
            return Err(Wrong::at_line(element.line, "vertices without x, y and z"));
        };
        if !self.positions.is_empty() {
            return Err(Wrong::at_line(element.line, "vertices a second time"));
        }
        let (normal, uv) = (columns(element, NORMAL), columns(element, UV));
        let colour = columns(element, COLOUR);
        let whites = colour.map(|columns| columns.map(|c| white(&element.properties[c])));
        warn_of_unused(
            element,
            &[
                &place,
                normal.as_ref().map_or(&[], |c| c),
                uv.as_ref().map_or(&[], |c| c),
                colour.as_ref().map_or(&[], |c| c),
            ],
            findings,
        );
        self.normals = normal.map(|_| Vec::new());
        self.uvs = uv.map(|_| Vec::new());
        self.colours = colour.map(|_| Vec::new());
        for _ in 0..element.count {
            body.row(element, row)?;
            let Some(position) = finite(row, place) else {
                let what = "a coordinate that is not a finite number";
                return Err(Wrong { place: body.place(), what: what.into() });
            };
            self.positions.push(position);
            // Without a usable normal, or texture coordinate, a vertex has none.
            if let (Some(list), Some(columns)) = (&mut self.normals, normal) {
                list.push(finite(row, columns).unwrap_or_default());
            }
            if let (Some(list), Some(columns)) = (&mut self.uvs, uv) {
                list.push(finite(row, columns).unwrap_or_default());
            }
            if let (Some(list), Some(columns), Some(whites)) = (&mut self.colours, colour, whites) {
                list.push(std::array::from_fn(|k| {
                    let share = row.number(columns[k]).unwrap_or(0.0) / whites[k];
                    (255.0 * share.clamp(0.0, 1.0)).round() as u8
                }));
            }
        }
        Ok(())
    }
}

/// The number that stands for the full channel.
fn white(property: &Property) -> f64 {
    match property.scalar {
        Scalar::F32 | Scalar::F64 => 1.0,
        Scalar::I16 | Scalar::U16 => f64::from(u16::MAX),
        _ => f64::from(u8::MAX),
    }
}

fn finite<const N: usize>(row: &Row, columns: [usize; N]) -> Option<[f64; N]> {
    let mut values = [0.0; N];
    for (value, column) in values.iter_mut().zip(columns) {
        *value = row.number(column).filter(|v| v.is_finite())?;
    }
    Some(values)
}

fn warn_of_unused(element: &Element, used: &[&[usize]], findings: &mut Findings) {
    let is_used = |k: usize| used.iter().any(|columns| columns.contains(&k));
    let all = element.properties.iter().enumerate();
    let unused: Vec<&str> =
        all.filter(|(k, _)| !is_used(*k)).map(|(_, p)| p.name.as_str()).collect();
    if !unused.is_empty() {
        let what = format!("properties `{}` of vertices are not used", unused.join("`, `"));
        findings.warning(format!("line {}", element.line), what, "nothing needs to be done");
    }
}
