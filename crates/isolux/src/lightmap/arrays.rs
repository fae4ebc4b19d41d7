//! A lightmap as plain arrays, for files, and back.

use super::layout::Layout;
use super::seam_report::SeamReport;
use super::texels::{Cover, Lightmap};
use crate::scene::Scene;

/// All of a lightmap; nothing is said of texels that have nothing to say.
#[derive(Clone, Debug, PartialEq)]
pub struct LightmapArrays {
    /// Where surfaces lie.
    pub layout: Layout,
    /// What every texel stands for.
    pub covers: Vec<Cover>,
    /// Illuminance of those that are not empty, lx.
    pub shown_lx: Vec<[f32; 3]>,
    /// Sides of the same.
    pub owners: Vec<u32>,
    /// Standard errors of those that are known, lx.
    pub standard_errors_lx: Vec<f32>,
    /// Shares of the same that known surface covers.
    pub coverage: Vec<f32>,
    /// How well both sides of seams agree.
    pub seams: SeamReport,
    /// Readings of the map behind all texels.
    pub readings: u64,
    /// Texels read in a cheaper way than the map allows.
    pub coarse: u64,
}

/// Why arrays are no lightmap of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LightmapArraysError {
    /// Pages without texels, or more than arrays hold.
    #[error("pages and texels do not fit together")]
    Size,
    /// An array is longer or shorter than what the texels stand for asks.
    #[error("texels have more or fewer values than they stand for")]
    Length,
    /// A side that is not there, or a place off the pages.
    #[error("a side lies nowhere")]
    Side,
    /// A number that is not finite, or below zero where none can be.
    #[error("a value is no value of a texel")]
    Value,
}

impl Lightmap {
    /// As arrays.
    pub fn to_arrays(&self) -> LightmapArrays {
        let of = |is_wanted: fn(Cover) -> bool| {
            (0..self.covers.len()).filter(move |&texel| is_wanted(self.covers[texel]))
        };
        let (filled, known) = (|| of(|c| c != Cover::Empty), || of(|c| c == Cover::Known));
        LightmapArrays {
            layout: self.layout.clone(),
            covers: self.covers.clone(),
            shown_lx: filled().map(|texel| self.shown_lx[texel]).collect(),
            owners: filled().map(|texel| self.owners[texel]).collect(),
            standard_errors_lx: known().map(|texel| self.standard_errors_lx[texel]).collect(),
            coverage: known().map(|texel| self.coverage[texel]).collect(),
            seams: self.seams,
            readings: self.readings,
            coarse: self.coarse,
        }
    }

    /// From arrays of any origin, over a scene.
    pub fn from_arrays(arrays: LightmapArrays, scene: &Scene) -> Result<Self, LightmapArraysError> {
        check(&arrays, scene)?;
        let LightmapArrays { layout, covers, seams, readings, coarse, .. } = arrays;
        let count = covers.len();
        let mut made = Self {
            shown_lx: vec![[0.0; 3]; count],
            owners: vec![0; count],
            standard_errors_lx: vec![0.0; count],
            coverage: vec![0.0; count],
            layout,
            covers,
            seams,
            readings,
            coarse,
        };
        let mut filled = arrays.shown_lx.into_iter().zip(arrays.owners);
        let mut known = arrays.standard_errors_lx.into_iter().zip(arrays.coverage);
        for (texel, cover) in made.covers.iter().enumerate() {
            if *cover != Cover::Empty {
                (made.shown_lx[texel], made.owners[texel]) = filled.next().unwrap_or_default();
            }
            if *cover == Cover::Known {
                (made.standard_errors_lx[texel], made.coverage[texel]) =
                    known.next().unwrap_or_default();
            }
        }
        Ok(made)
    }
}

fn check(arrays: &LightmapArrays, scene: &Scene) -> Result<(), LightmapArraysError> {
    let layout = &arrays.layout;
    let sizes = [layout.width, layout.height, layout.pages].map(|size| size as usize);
    let texels = sizes.into_iter().try_fold(1_usize, usize::checked_mul);
    if texels.is_none_or(|count| count == 0 || count != arrays.covers.len()) {
        return Err(LightmapArraysError::Size);
    }
    let count = |is: fn(&Cover) -> bool| arrays.covers.iter().filter(|cover| is(cover)).count();
    let (filled, known) = (count(|c| *c != Cover::Empty), count(|c| *c == Cover::Known));
    let lengths = [arrays.shown_lx.len(), arrays.owners.len()];
    if lengths != [filled; 2]
        || [arrays.standard_errors_lx.len(), arrays.coverage.len()] != [known; 2]
    {
        return Err(LightmapArraysError::Length);
    }
    let is_placed = |side: &super::Side| {
        let is_there = side.triangle < scene.triangle_count() && side.page < layout.pages;
        is_there && side.uvs.iter().flatten().all(|c| c.is_finite())
    };
    let is_owned = |owner: &u32| (*owner as usize) < layout.sides.len();
    if !(layout.sides.iter().all(is_placed) && arrays.owners.iter().all(is_owned)) {
        return Err(LightmapArraysError::Side);
    }
    let numbers = arrays.standard_errors_lx.iter().chain(&arrays.coverage);
    let is_value = |c: &f32| c.is_finite() && *c >= 0.0;
    let is_density = |d: f64| d.is_finite() && d > 0.0;
    let are_densities = is_density(layout.texels_per_m) && is_density(layout.asked_texels_per_m);
    let are_values = arrays.shown_lx.iter().flatten().chain(numbers).all(is_value);
    if are_densities && are_values { Ok(()) } else { Err(LightmapArraysError::Value) }
}
