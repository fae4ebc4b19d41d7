//! How much light a luminaire gives, and where to.

use super::context::Context;
use super::quantity::NonNegative;
use super::record::{CosineRecord, IsotropicRecord, LuminaireRecord, SpotRecord};
use super::spans::{At, Span};
use crate::{Loaded, Problems, ies, ldt};
use isolux::photometry::IntensityDistribution;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// Distributions from files, each read once.
#[derive(Default)]
pub(super) struct Files {
    read: HashMap<PathBuf, Option<IntensityDistribution>>,
}

/// The distribution of a luminaire that is not directional; `None` after a problem.
pub(super) fn intensity(
    record: &LuminaireRecord,
    files: &mut Files,
    context: &mut Context,
) -> Option<IntensityDistribution> {
    if let Some(file) = record.ies.as_ref().or(record.ldt.as_ref()) {
        let distribution = files.get(file, record.ies.is_some(), context)?;
        return match &record.flux_lm {
            None => Some(distribution),
            Some(flux) => with_flux(&distribution, flux.get_ref().0, &flux.span(), context),
        };
    }
    if let Some(flux) = &record.flux_lm {
        let what = "`flux_lm` of a luminaire without a photometric file";
        context.problem(&flux.span(), what, "write it inside `isotropic`, `cosine` or `spot`");
    }
    record
        .isotropic
        .as_ref()
        .map(|r| isotropic(r, context))
        .or_else(|| record.cosine.as_ref().map(|r| cosine(r, context)))
        .or_else(|| record.spot.as_ref().map(|r| spot(r, context)))
        .flatten()
}

fn isotropic(record: &At<IsotropicRecord>, context: &mut Context) -> Option<IntensityDistribution> {
    let IsotropicRecord { intensity_cd, flux_lm } = record.get_ref();
    let unit = IntensityDistribution::Isotropic { intensity_cd: 1.0 };
    let amount = Amount { name: "intensity_cd", candela: *intensity_cd, flux_lm: *flux_lm };
    amount.of(&unit, &record.span(), context)
}

fn cosine(record: &At<CosineRecord>, context: &mut Context) -> Option<IntensityDistribution> {
    let CosineRecord { peak_cd, flux_lm, exponent } = record.get_ref();
    let exponent = exponent.map_or(1.0, |n| n.0);
    let unit = IntensityDistribution::CosinePower { peak_cd: 1.0, exponent };
    let amount = Amount { name: "peak_cd", candela: *peak_cd, flux_lm: *flux_lm };
    amount.of(&unit, &record.span(), context)
}

fn spot(record: &At<SpotRecord>, context: &mut Context) -> Option<IntensityDistribution> {
    let SpotRecord { peak_cd, flux_lm, inner_deg, outer_deg } = record.get_ref();
    if !(inner_deg.0 < outer_deg.0 && outer_deg.0 <= 180.0) {
        let what = format!("inner angle {} and outer angle {}", inner_deg.0, outer_deg.0);
        let remedy = "give half angles, the inner below the outer, the outer at most 180";
        context.problem(&record.span(), what, remedy);
        return None;
    }
    let unit = IntensityDistribution::Spot {
        peak_cd: 1.0,
        inner_rad: inner_deg.0.to_radians(),
        outer_rad: outer_deg.0.to_radians(),
    };
    let amount = Amount { name: "peak_cd", candela: *peak_cd, flux_lm: *flux_lm };
    amount.of(&unit, &record.span(), context)
}

/// An intensity or a flux.
struct Amount {
    name: &'static str,
    candela: Option<NonNegative>,
    flux_lm: Option<NonNegative>,
}

impl Amount {
    /// A distribution of unit peak, scaled.
    fn of(
        &self,
        unit: &IntensityDistribution,
        at: &Span,
        context: &mut Context,
    ) -> Option<IntensityDistribution> {
        match (self.candela, self.flux_lm) {
            (Some(candela), None) => Some(unit.scaled(candela.0)),
            (None, Some(flux)) => with_flux(unit, flux.0, at, context),
            (given, _) => {
                let how_many = if given.is_some() { "both" } else { "neither" };
                let what = format!("{how_many} of `{}` and `flux_lm`", self.name);
                context.problem(at, what, "give one of them");
                None
            }
        }
    }
}

fn with_flux(
    distribution: &IntensityDistribution,
    flux_lm: f64,
    at: &Span,
    context: &mut Context,
) -> Option<IntensityDistribution> {
    let factor = flux_lm / distribution.luminous_flux_lm();
    if factor.is_finite() {
        return Some(distribution.scaled(factor));
    }
    context.problem(at, "a distribution without light has no flux to scale", "remove `flux_lm`");
    None
}

impl Files {
    fn get(
        &mut self,
        file: &At<String>,
        is_ies: bool,
        context: &mut Context,
    ) -> Option<IntensityDistribution> {
        let path = context.path_of(&file.span(), file.get_ref())?;
        if let Some(known) = self.read.get(&path) {
            return known.clone();
        }
        let read = if is_ies { read_ies(&path) } else { read_ldt(&path) };
        let distribution = context.findings.absorb(read);
        self.read.insert(path, distribution.clone());
        distribution
    }
}

fn read_ies(path: &Path) -> Result<Loaded<IntensityDistribution>, Problems> {
    let Loaded { value, warnings } = ies::read(path)?;
    Ok(Loaded { value: value.resolve()?, warnings })
}

fn read_ldt(path: &Path) -> Result<Loaded<IntensityDistribution>, Problems> {
    let Loaded { value, warnings } = ldt::read(path)?;
    Ok(Loaded { value: value.resolve()?, warnings })
}
