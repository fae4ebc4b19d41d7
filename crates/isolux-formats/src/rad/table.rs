//! `brightdata` of lights, as `ies2rad` writes it.

use super::limits;
use super::luminaires::Middle;
use super::modifiers::Definition;
use super::words::number;
use super::xform;
use crate::source::read_text;
use isolux::geometry::Transform;
use isolux::photometry::{IntensityDistribution, PhotometricWeb, Symmetry};
use std::f64::consts::PI;
use std::path::Path;
use std::sync::Arc;

/// What a table is divided by to be a radiance (`source.cal`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shape {
    /// `flatcorr`: by the projected area of a flat surface.
    Flat,
    /// `corr`: by that of a ball.
    Ball,
    /// `boxcorr`, `cylcorr`: by that of a body with so much surface, m2, given as numbers.
    Body {
        /// Surface of the whole body.
        area_m2: f64,
    },
}

/// A `brightdata` as written.
#[derive(Debug)]
pub(super) struct Table {
    pub(super) shape: Shape,
    pub(super) file: String,
    /// Takes the axes of the table to the world.
    pub(super) world_from_table: Transform,
    factor: f64,
    symmetry: Symmetry,
}

/// Reads the arguments `function file source.cal coordinates [transform]`.
pub(super) fn parse(definition: &Definition) -> Result<Table, String> {
    let object = &definition.object;
    let [function, file, source, rest @ ..] = &object.strings[..] else {
        return Err("does not have the arguments that ies2rad writes".into());
    };
    if source != "source.cal" {
        return Err(format!("uses the functions of `{source}`, not of source.cal"));
    }
    let numbers = &object.numbers[..];
    let shape = match (function.as_str(), numbers) {
        ("flatcorr", [] | [_]) => Shape::Flat,
        ("corr", [] | [_]) => Shape::Ball,
        ("boxcorr" | "lboxcorr", &[_, x, y, z]) => {
            Shape::Body { area_m2: 2.0 * (x * y + y * z + z * x) }
        }
        ("cylcorr", &[_, diameter, height]) => {
            Shape::Body { area_m2: PI * diameter * (height + 0.5 * diameter) }
        }
        _ => return Err(format!("uses the function `{function}` with {} numbers", numbers.len())),
    };
    let coordinates = rest.iter().take_while(|word| !word.starts_with('-')).count();
    let (coordinates, transform) = rest.split_at(coordinates);
    let coordinates: Vec<&str> = coordinates.iter().map(String::as_str).collect();
    let symmetry = match coordinates[..] {
        ["src_theta"] => Symmetry::Axial,
        ["src_phi4", "src_theta"] => Symmetry::AboutBoth,
        ["src_phi2", "src_theta"] => Symmetry::AboutC0C180,
        ["src_phi", "src_theta"] => Symmetry::None,
        _ => return Err(format!("uses the coordinates `{}`", coordinates.join(" "))),
    };
    let xform = xform::parse(transform)?;
    let [own] = &xform.copies[..] else { return Err("has an array in its transform".into()) };
    let factor = numbers.first().copied().unwrap_or(1.0);
    if factor < 0.0 {
        return Err(format!("has a factor of {factor}"));
    }
    Ok(Table {
        shape,
        file: file.clone(),
        world_from_table: definition.world_from_file.then_from(&own.map),
        factor,
        symmetry,
    })
}

/// The part of a distribution that a flat surface lets out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Half {
    Lower,
    Upper,
    Both,
}

impl Table {
    /// The distribution of a light of some luminance: the table times projected area over the
    /// function's own, as the formulas of `source.cal` leave it. `None` if all of it is kept in.
    pub(super) fn distribution(
        &self,
        path: &Path,
        half: Half,
        luminance_cd_m2: f64,
        area_m2: f64,
    ) -> Result<Option<IntensityDistribution>, String> {
        let text = read_text(path, limits::TABLE_BYTES)
            .map_err(|p| format!("{}: {}", self.file, p.what))?;
        let grid = Grid::parse(&text, self.symmetry == Symmetry::Axial)?;
        let Some(grid) = grid.cut(half) else { return Ok(None) };
        let scale = match self.shape {
            Shape::Flat => area_m2,
            Shape::Ball => 0.25 * area_m2,
            Shape::Body { area_m2: due } => area_m2 / due,
        };
        let factor = scale * self.factor * luminance_cd_m2;
        let candela = grid.values.iter().map(|v| v * factor).collect();
        let web = PhotometricWeb::with_symmetry(grid.planes, grid.gammas, candela, self.symmetry);
        let web = web.map_err(|error| format!("{}: {error}", self.file))?;
        Ok(Some(IntensityDistribution::Web(Arc::new(web))))
    }
}

/// What a surface of a table lets out; an error if it stands askew.
pub(super) fn half_of(table: &Table, middle: &Middle) -> Result<Half, String> {
    if table.shape != Shape::Flat {
        return Ok(Half::Both);
    }
    let down = super::luminaires::faces_down(middle.area_vector_m2, &table.world_from_table);
    match down {
        Some(true) => Ok(Half::Lower),
        Some(false) => Ok(Half::Upper),
        None => Err("a flat light that faces neither down nor up in the frame of its table".into()),
    }
}

/// Values over planes and gammas, plane by plane.
struct Grid {
    planes: Vec<f64>,
    gammas: Vec<f64>,
    values: Vec<f64>,
}

impl Grid {
    /// Radiance's data format: the number of dimensions; for each its ends and its count, and where
    /// the ends are the same its coordinates; then the values, the last dimension fastest.
    fn parse(text: &str, axial: bool) -> Result<Self, String> {
        let lines = text.lines().map(|line| line.split('#').next().unwrap_or(""));
        let mut words = lines.flat_map(str::split_whitespace);
        let mut next = move || {
            let word = words.next().ok_or("the table ends too early")?;
            number(word).ok_or_else(|| format!("`{word}` in the table is not a finite number"))
        };
        let dimensions = if axial { 1.0 } else { 2.0 };
        if next()? != dimensions {
            return Err(format!("the table does not have {dimensions} dimensions"));
        }
        let mut axes = vec![vec![0.0]; if axial { 1 } else { 0 }];
        for _ in 0..dimensions as usize {
            axes.push(axis(&mut next)?);
        }
        let [planes, gammas] = <[_; 2]>::try_from(axes).map_err(|_| "not two axes")?;
        let mut values = Vec::new();
        for _ in 0..planes.len() * gammas.len() {
            values.push(next()?);
        }
        Ok(Self { planes, gammas, values })
    }

    /// Without the directions that stay behind the surface.
    fn cut(mut self, half: Half) -> Option<Self> {
        let keep: fn(f64) -> bool = match half {
            Half::Both => return Some(self),
            Half::Lower => |gamma| gamma <= 90.0,
            Half::Upper => |gamma| gamma >= 90.0,
        };
        self.split_at_horizon();
        let count = self.gammas.len();
        let gammas: Vec<f64> = self.gammas.iter().copied().filter(|&g| keep(g)).collect();
        let kept = self.values.iter().enumerate().filter(|(k, _)| keep(self.gammas[k % count]));
        let values: Vec<f64> = kept.map(|(_, &v)| v).collect();
        (gammas.len() > 1).then_some(Self { planes: self.planes, gammas, values })
    }

    /// Makes 90 degrees one of the gammas, where the table goes across it.
    fn split_at_horizon(&mut self) {
        let count = self.gammas.len();
        let above = self.gammas.partition_point(|&g| g < 90.0);
        if above == 0 || above == count || self.gammas[above] == 90.0 {
            return;
        }
        let (g0, g1) = (self.gammas[above - 1], self.gammas[above]);
        let share = (90.0 - g0) / (g1 - g0);
        let with_horizon = |row: &[f64]| {
            let mut row = row.to_vec();
            row.insert(above, row[above - 1] * (1.0 - share) + row[above] * share);
            row
        };
        self.values = self.values.chunks(count).flat_map(with_horizon).collect();
        self.gammas.insert(above, 90.0);
    }
}

fn axis(next: &mut impl FnMut() -> Result<f64, String>) -> Result<Vec<f64>, String> {
    let (from, to, count) = (next()?, next()?, next()?);
    if count.fract() != 0.0 || !(1.0..=1e5).contains(&count) {
        return Err(format!("{count} rows in the table"));
    }
    if from == to {
        return (0..count as usize).map(|_| next()).collect();
    }
    let step = (to - from) / (count - 1.0);
    Ok((0..count as usize).map(|k| from + step * k as f64).collect())
}
