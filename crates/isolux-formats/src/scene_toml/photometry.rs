//! How much light a luminaire gives, and where to.

use super::context::Context;
use super::quantity::{NonNegative, plain};
use super::record::{
    CosineRecord, IsotropicRecord, LightRecord, LuminousAreaRecord, LuminousSizes, SpotRecord,
};
use super::spans::{At, Span};
use crate::{Loaded, Problem, Problems, ies, ldt};
use isolux::photometry::IntensityDistribution;
use isolux::scene::LuminousArea;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Light and where it comes from.
#[derive(Clone, Debug)]
pub(super) struct Emission {
    pub(super) intensity: IntensityDistribution,
    /// Where the light leaves from; `None` for a point.
    pub(super) area: Option<LuminousArea>,
    /// Input power that the photometric file says for this flux, W.
    pub(super) power_w: Option<f64>,
}

/// What files hold, each read once.
#[derive(Default)]
pub(super) struct Files {
    /// By path and lamp set.
    read: HashMap<(PathBuf, u32), Option<Known>>,
    /// Tables with their light scaled, beside those themselves: by address and factor, so that luminaires which are alike share one.
    scaled: HashMap<(usize, u64), [IntensityDistribution; 2]>,
}

/// What one of them holds.
#[derive(Clone)]
struct Known {
    emission: Emission,
    /// That its flux is in doubt, until it was said.
    doubt: Option<Problem>,
}

/// The light of a luminaire that is not directional; `None` after a problem.
pub(super) fn emission(
    record: &LightRecord,
    files: &mut Files,
    context: &mut Context,
) -> Option<Emission> {
    if let Some(file) = record.ies.or(record.ldt) {
        if let (Some(set), None) = (record.lamp_set, record.ldt) {
            let what = "`lamp_set` of a luminaire without an EULUMDAT file";
            context.problem(&set.span(), what, "remove it: only `ldt` knows several sets of lamps");
        }
        let read = files.get(file, record, context)?.with_area(record.luminous_area);
        return read.with_flux(record.flux_lm, files, context);
    }
    for (key, span) in
        [("flux_lm", record.flux_lm.map(At::span)), ("lamp_set", record.lamp_set.map(At::span))]
    {
        if let Some(span) = span {
            let what = format!("`{key}` of a luminaire without a photometric file");
            let remedy = match key {
                "flux_lm" => "write it inside `isotropic`, `cosine` or `spot`",
                _ => "remove it: only `ldt` knows several sets of lamps",
            };
            context.problem(&span, what, remedy);
        }
    }
    let intensity = record
        .isotropic
        .map(|r| isotropic(r, context))
        .or_else(|| record.cosine.map(|r| cosine(r, context)))
        .or_else(|| record.spot.map(|r| spot(r, context)))
        .flatten()?;
    Some(Emission { intensity, area: None, power_w: None }.with_area(record.luminous_area))
}

impl Emission {
    /// Rescaled to a flux, where one is given: that of other lamps, whose power is not known.
    pub(super) fn with_flux(
        self,
        flux: Option<&At<NonNegative>>,
        files: &mut Files,
        context: &mut Context,
    ) -> Option<Self> {
        let Some(flux) = flux else { return Some(self) };
        let factor = factor_to(&self.intensity, flux.get_ref().0, &flux.span(), context)?;
        let intensity = files.scaled(&self.intensity, factor);
        Some(Self { intensity, power_w: None, ..self })
    }

    /// From another luminous area, where one is given.
    pub(super) fn with_area(self, area: Option<&At<LuminousAreaRecord>>) -> Self {
        let area = area.map_or(self.area, |area| match *area.get_ref() {
            LuminousAreaRecord::Point(_) => None,
            LuminousAreaRecord::Sizes(LuminousSizes { shape, size_m, middle_m }) => {
                let half_m = size_m.map(|size| 0.5 * size.0);
                let middle_m = middle_m.map_or([0.0; 3], plain);
                (half_m != [0.0; 3]).then_some(LuminousArea { shape, half_m, middle_m })
            }
        });
        Self { area, ..self }
    }
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
            (None, Some(flux)) => {
                factor_to(unit, flux.0, at, context).map(|factor| unit.scaled(factor))
            }
            (given, _) => {
                let how_many = if given.is_some() { "both" } else { "neither" };
                let what = format!("{how_many} of `{}` and `flux_lm`", self.name);
                context.problem(at, what, "give one of them");
                None
            }
        }
    }
}

/// The factor that gives a distribution a flux.
fn factor_to(
    distribution: &IntensityDistribution,
    flux_lm: f64,
    at: &Span,
    context: &mut Context,
) -> Option<f64> {
    let factor = flux_lm / distribution.luminous_flux_lm();
    if factor.is_finite() {
        return Some(factor);
    }
    context.problem(at, "a distribution without light has no flux to scale", "remove `flux_lm`");
    None
}

impl Files {
    /// A distribution times a factor.
    pub(super) fn scaled(
        &mut self,
        intensity: &IntensityDistribution,
        factor: f64,
    ) -> IntensityDistribution {
        let IntensityDistribution::Web(web) = intensity else { return intensity.scaled(factor) };
        let key = (Arc::as_ptr(web) as usize, factor.to_bits());
        let known = self.scaled.entry(key);
        let [_, scaled] = known.or_insert_with(|| [intensity.clone(), intensity.scaled(factor)]);
        scaled.clone()
    }

    fn get(
        &mut self,
        file: &At<String>,
        record: &LightRecord,
        context: &mut Context,
    ) -> Option<Emission> {
        let path = context.path_of(&file.span(), file.get_ref())?;
        let set = record.lamp_set.map_or(1, |set| *set.get_ref());
        let key = (path, set);
        if !self.read.contains_key(&key) {
            let known = read(file, (&key.0, set), record, context);
            self.read.insert(key.clone(), known);
        }
        let known = self.read.get_mut(&key)?.as_mut()?;
        // A luminaire with a flux of its own takes only the shape of the table.
        if let (Some(doubt), None) = (&known.doubt, record.flux_lm) {
            let warnings = vec![doubt.clone()];
            context.findings.absorb(Ok(Loaded { value: (), warnings }));
            known.doubt = None;
        }
        Some(known.emission.clone())
    }
}

fn read(
    file: &At<String>,
    (path, set): (&Path, u32),
    record: &LightRecord,
    context: &mut Context,
) -> Option<Known> {
    let read = if record.ies.is_some() { read_ies(path) } else { read_ldt(path, set) };
    match read {
        Ok(None) => {
            let at = record.lamp_set.map_or(file.span(), At::span);
            let what = format!("{} has no lamp set {set}", file.get_ref());
            context.problem(&at, what, "count the sets of the file from 1");
            None
        }
        Ok(Some(loaded)) => context.findings.absorb(Ok(loaded)),
        Err(problems) => {
            let what = format!("`{}` cannot be used, for the reason that follows", file.get_ref());
            context.problem(&file.span(), what, "mend it, or name another file");
            context.findings.absorb(Err(problems))
        }
    }
}

fn read_ies(path: &Path) -> Result<Option<Loaded<Known>>, Problems> {
    let Loaded { value, warnings } = ies::read(path)?;
    let (intensity, area) = (value.resolve()?, value.opening.area());
    let emission = Emission { intensity, area, power_w: power_w(value.input_watts) };
    Ok(Some(known(emission, value.doubt_of_flux(), warnings)))
}

/// With a lamp set, counted from 1; nothing if there is none.
fn read_ldt(path: &Path, set: u32) -> Result<Option<Loaded<Known>>, Problems> {
    let Loaded { value, warnings } = ldt::read(path)?;
    let index = (set as usize).checked_sub(1);
    let Some(set) = index.and_then(|k| value.lamp_sets.get(k)) else { return Ok(None) };
    let (intensity, area) = (value.resolve_with(set)?, value.opening().area());
    let emission = Emission { intensity, area, power_w: power_w(set.watts) };
    Ok(Some(known(emission, value.doubt_of_flux(), warnings)))
}

/// Files write zero where the power is not known.
fn power_w(watts: f64) -> Option<f64> {
    Some(watts).filter(|watts| *watts > 0.0)
}

/// What concerns every luminaire with a file is said at once.
fn known(emission: Emission, doubt: Option<Problem>, mut warnings: Vec<Problem>) -> Loaded<Known> {
    warnings.retain(|warning| Some(warning) != doubt.as_ref());
    Loaded { value: Known { emission, doubt }, warnings }
}
