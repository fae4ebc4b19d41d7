//! Sums of maps of the same surfaces in different light: luminaires are dimmed anew without another run.
//!
//! Light is additive, so the map of several groups of luminaires is the sum of the maps of each, times its
//! dimming. The sum uses the coarsest elements that refine those of all parts: bisection trees over the same
//! triangles with united splits. Noise of parts with different seeds is independent and adds in squares.
//! Interpolation errors and bias may agree in sign and are added as they are: by the triangle inequality the
//! error of the sum is no larger.

use super::trees::{bisected_like, own_vertices, places_of_vertices};
use crate::elements::{Elements, PlaceOnSide};
use crate::engine::read::{MapReader, reference_lx};
use crate::map::{
    Accuracy, FilterReport, Fresh, IlluminationMap, Method, MixedPart, Provenance, Standing,
    Unshot, VertexLight,
};
use crate::scene::Scene;
use crate::units::Rgb;
use rayon::prelude::*;

/// A map to add, with its scene.
#[derive(Clone, Copy, Debug)]
pub struct MixPart<'a> {
    /// The scene that was solved.
    pub scene: &'a Scene,
    /// The map of the scene.
    pub map: &'a IlluminationMap,
    /// The factor on all of its light: finite, not negative.
    pub dimming: f64,
}

/// The reason why maps cannot be added; parts are counted from 0.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MixError {
    /// All parts are dimmed to zero.
    #[error("nothing is left of the light: every part is dimmed to 0")]
    Dark,
    /// A dimming is not a valid factor.
    #[error("a dimming of part {0} is negative or not finite")]
    Dimming(usize),
    /// Parts were computed by different methods, whose errors have different meanings.
    #[error("part {0} was computed by another method than the first")]
    Method(usize),
    /// Parts have different surfaces.
    #[error("part {0} has other surfaces or materials than the first")]
    Surfaces(usize),
    /// The map of a part does not belong to its scene.
    #[error("the map of part {0} is not of the scene in it")]
    Stale(usize),
}

/// The scene with all luminaires dimmed, and its map. Parts dimmed to zero are left out with their
/// luminaires.
pub fn mix(parts: &[MixPart<'_>]) -> Result<(Scene, IlluminationMap), MixError> {
    mix_apart(parts).map(|mixed| (mixed.scene, mixed.map))
}

/// A sum of maps, and the light of each part at its vertices.
#[derive(Clone, Debug)]
pub struct Mixed {
    /// The scene with all luminaires dimmed.
    pub scene: Scene,
    /// The map of that scene.
    pub map: IlluminationMap,
    /// The light of each part that is not dimmed to zero, at every vertex before dimming; `None` where it is
    /// unknown.
    pub parts: Vec<Vec<Option<VertexLight>>>,
}

/// The sum of [`mix`] with the light of each part.
pub fn mix_apart(parts: &[MixPart<'_>]) -> Result<Mixed, MixError> {
    check(parts)?;
    let lit: Vec<Part<'_>> = parts.iter().filter(|p| p.dimming > 0.0).map(Part::new).collect();
    let dimmings: Vec<(&Scene, f64)> = lit.iter().map(|p| (p.scene, p.dimming)).collect();
    let scene = Scene::mixed(&dimmings);
    let (elements, own) = unite(&scene, &lit);
    let columns: Vec<Vec<Option<VertexLight>>> = {
        let places = places_of_vertices(&elements);
        let column = |(part, own): (&Part<'_>, &Vec<Option<u32>>)| {
            let rows = places.par_iter().zip(own);
            rows.map(|(place, own)| part.value(*own, *place)).collect()
        };
        lit.iter().zip(&own).map(column).collect()
    };
    let is_independent = have_seeds_of_their_own(&lit);
    let values = (0..elements.vertices().len())
        .map(|vertex| {
            let row: Vec<Option<VertexLight>> =
                columns.iter().map(|column| column[vertex]).collect();
            known(&lit, &row).map(|row| sum(&lit, &row, is_independent))
        })
        .collect();
    let provenance = first_provenance(&scene, &lit);
    let mut map = IlluminationMap { elements, values, provenance };
    map.provenance.accuracy = accuracy(&lit, &map, &columns, is_independent);
    drop(lit);
    Ok(Mixed { scene, map, parts: columns })
}

fn check(parts: &[MixPart<'_>]) -> Result<(), MixError> {
    let Some(first) = parts.first() else { return Err(MixError::Dark) };
    let surfaces = first.scene.surfaces_hash();
    for (k, part) in parts.iter().enumerate() {
        let from = &part.map.provenance;
        if !(part.dimming >= 0.0 && part.dimming.is_finite()) {
            return Err(MixError::Dimming(k));
        }
        if from.method != first.map.provenance.method {
            return Err(MixError::Method(k));
        }
        if part.scene.surfaces_hash() != surfaces {
            return Err(MixError::Surfaces(k));
        }
        if part.scene.hash() != from.scene_hash {
            return Err(MixError::Stale(k));
        }
    }
    match parts.iter().any(|part| part.dimming > 0.0) {
        true => Ok(()),
        false => Err(MixError::Dark),
    }
}

/// A part that is not dimmed to zero.
struct Part<'a> {
    scene: &'a Scene,
    map: &'a IlluminationMap,
    reader: MapReader<'a>,
    dimming: f64,
    reference_lx: f64,
}

impl<'a> Part<'a> {
    fn new(part: &MixPart<'a>) -> Self {
        let MixPart { scene, map, dimming } = *part;
        let reader = MapReader::new(scene, map);
        Self { scene, map, reader, dimming, reference_lx: reference_lx(map) }
    }

    /// The value of the part at a vertex of the sum: its own, or a reading where it has no vertex, with the
    /// errors that its own vertices would have.
    fn value(&self, own: Option<u32>, place: PlaceOnSide) -> Option<VertexLight> {
        if let Some(vertex) = own {
            return self.map.values[vertex as usize];
        }
        let PlaceOnSide { triangle, back, uv: [u, v] } = place;
        let between = self.map.interpolate(triangle, back, u, v)?;
        let read = self.reader.by_replicates(self.reader.at(triangle, back, u, v)?);
        Some(VertexLight {
            // Readers of the sum add the ambient term for unshot light.
            indirect_lx: read.indirect_lx - self.map.ambient_lx(),
            interpolation_error_lx: between.interpolation_error_lx,
            ..read.at_vertex()
        })
    }

    /// A relative error of the whole map, as light in the sum, lx.
    fn dimmed_lx(&self, relative: f64) -> f64 {
        self.dimming * self.reference_lx * relative
    }
}

/// The united elements of all parts, as far as each knows light there; and for each part, its vertex at each
/// vertex of the sum.
fn unite(scene: &Scene, parts: &[Part<'_>]) -> (Elements, Vec<Vec<Option<u32>>>) {
    let likes: Vec<(&Elements, Vec<bool>)> =
        parts.iter().map(|part| (&part.map.elements, known_nodes(part.map))).collect();
    let united = bisected_like(scene, &likes).elements();
    let own = parts.iter().map(|part| own_vertices(&united, &part.map.elements)).collect();
    (united, own)
}

/// Whether a map knows light on each node or a part of it.
fn known_nodes(map: &IlluminationMap) -> Vec<bool> {
    let elements = &map.elements;
    let is_known = |v: u32| map.values[v as usize].is_some();
    let mut known = vec![false; elements.node_count()];
    // Children come after their parents.
    for node in (0..known.len()).rev() {
        let of = elements.node(node as u32);
        let parts = of.split.map(|split| split.first_child as usize);
        let in_part = parts.is_some_and(|first| known[first] || known[first + 1]);
        known[node] = in_part || of.vertices.into_iter().any(is_known);
    }
    known
}

fn have_seeds_of_their_own(parts: &[Part<'_>]) -> bool {
    let mut seeds: Vec<u64> = parts.iter().map(|part| part.map.provenance.seed).collect();
    seeds.sort_unstable();
    seeds.windows(2).all(|pair| pair[0] != pair[1])
}

/// The sum of errors that replicates show: in squares where they are independent.
fn add_noise(parts: impl Iterator<Item = f64>, is_independent: bool) -> f64 {
    match is_independent {
        true => parts.map(|lx| lx * lx).sum::<f64>().sqrt(),
        false => parts.sum(),
    }
}

/// The values of all parts at a vertex; `None` where the sum is unknown. A place that one part knows is not
/// inside something, so parts that do not know it have no light there. The exception is `forward`, whose
/// particles may have missed it.
fn known(parts: &[Part<'_>], row: &[Option<VertexLight>]) -> Option<Vec<VertexLight>> {
    let is_known = row.iter().any(Option::is_some);
    let of_part = |(part, own): (&Part<'_>, &Option<VertexLight>)| {
        let is_dark = is_known && part.map.provenance.method != Method::Forward;
        own.or(is_dark.then_some(VertexLight::NOTHING))
    };
    parts.iter().zip(row).map(of_part).collect()
}

fn sum(parts: &[Part<'_>], row: &[VertexLight], is_independent: bool) -> VertexLight {
    let dimmed = || row.iter().zip(parts.iter().map(|part| part.dimming));
    let rgb = |of: fn(&VertexLight) -> Rgb| dimmed().map(|(v, by)| of(v) * by).sum::<Rgb>();
    let noise =
        |of: fn(&VertexLight) -> f64| add_noise(dimmed().map(|(v, by)| of(v) * by), is_independent);
    VertexLight {
        direct_lx: rgb(|v| v.direct_lx),
        caustic_lx: rgb(|v| v.caustic_lx),
        indirect_lx: rgb(|v| v.indirect_lx),
        standard_error_lx: noise(|v| v.standard_error_lx),
        indirect_standard_error_lx: noise(|v| v.indirect_standard_error_lx),
        common_error_lx: noise(|v| v.common_error_lx),
        interpolation_error_lx: dimmed().map(|(v, by)| v.interpolation_error_lx * by).sum(),
        // A place in a gap for the elements of one part is in a gap in the sum.
        standing: row.iter().map(|v| v.standing).min().unwrap_or(Standing::Open),
        samples: row.iter().map(|v| v.samples).sum(),
    }
}

/// The provenance of the sum, without its accuracy.
fn first_provenance(scene: &Scene, parts: &[Part<'_>]) -> Provenance {
    let from = || parts.iter().map(|part| &part.map.provenance);
    let reference_lx: f64 = parts.iter().map(|part| part.dimmed_lx(1.0)).sum();
    let share = |lx: f64| if reference_lx > 0.0 { lx / reference_lx } else { 0.0 };
    let with = |of: &dyn Fn(&Provenance) -> Option<f64>| {
        parts.iter().filter_map(|part| Some(part.dimmed_lx(of(&part.map.provenance)?))).sum::<f64>()
    };
    let filter = from().any(|p| p.filter.is_some()).then(|| FilterReport {
        share: from().filter_map(|p| p.filter).map(|f| f.share).fold(0.0, f64::max),
        bias: share(with(&|p| p.filter.map(|f| f.bias))),
    });
    let unshot = from().any(|p| p.unshot.is_some()).then(|| Unshot {
        share: share(with(&|p| p.unshot.map(|u| u.share))),
        ambient_lx: parts.iter().map(|part| part.map.ambient_lx() * part.dimming).sum(),
        doubt_lx: parts.iter().map(|part| part.map.ambient_doubt_lx() * part.dimming).sum(),
    });
    let targets: Option<Vec<f64>> = from().map(|p| p.accuracy_target).collect();
    let first = &parts[0].map.provenance;
    Provenance {
        scene_hash: scene.hash(),
        increments: from().map(|p| p.increments).min().unwrap_or(0),
        rays: from().map(|p| p.rays).sum(),
        accuracy_target: targets.map(|all| all.into_iter().fold(0.0, f64::max)),
        complete: from().all(|p| p.complete),
        accuracy: None,
        audit: None,
        fresh: fresh(parts),
        filter,
        unshot,
        diffuse_only: from().any(|p| p.diffuse_only),
        mixed: parts.iter().flat_map(Part::as_mixed).collect(),
        ..first.clone()
    }
}

impl Part<'_> {
    /// The part as listed in the sum; a part that is a sum itself is listed by its parts.
    fn as_mixed(&self) -> Vec<MixedPart> {
        let from = &self.map.provenance;
        if !from.mixed.is_empty() {
            let dimmed =
                |m: &MixedPart| MixedPart { dimming: m.dimming * self.dimming, ..m.clone() };
            return from.mixed.iter().map(dimmed).collect();
        }
        let mut lit: Vec<u32> = self.scene.luminaires().iter().map(|l| l.group).collect();
        if !self.scene.area_luminaires().is_empty() {
            lit.push(0);
        }
        lit.sort_unstable();
        lit.dedup();
        let names = self.scene.groups();
        let groups = lit.iter().filter_map(|&g| names.get(g as usize).cloned()).collect();
        vec![MixedPart {
            groups,
            dimming: self.dimming,
            scene_hash: from.scene_hash.clone(),
            seed: from.seed,
        }]
    }
}

/// The trust of the sum: elements at the limit of error in every part are at the limit of the sum.
fn fresh(parts: &[Part<'_>]) -> Option<Fresh> {
    let all: Option<Vec<(Fresh, f64, f64)>> = parts
        .iter()
        .map(|part| {
            let errors = part.map.values.iter().flatten().map(|v| v.interpolation_error_lx);
            Some((part.map.provenance.fresh?, part.dimming, errors.fold(0.0, f64::max)))
        })
        .collect();
    let all = all?;
    let is_limited = all.iter().any(|(fresh, ..)| fresh.above_lx.is_some());
    let limit = |(fresh, by, worst): &(Fresh, f64, f64)| fresh.above_lx.unwrap_or(*worst) * by;
    Some(Fresh {
        above_lx: is_limited.then(|| all.iter().map(limit).sum()),
        in_gaps_alone: all.iter().all(|(fresh, ..)| fresh.in_gaps_alone),
        lookup_lx: all.iter().map(|(fresh, by, _)| fresh.lookup_lx * by).sum(),
    })
}

/// The error of the sum, relative to its own light.
fn accuracy(
    parts: &[Part<'_>],
    map: &IlluminationMap,
    columns: &[Vec<Option<VertexLight>>],
    is_independent: bool,
) -> Option<Accuracy> {
    let of: Vec<Accuracy> =
        parts.iter().map(|p| p.map.provenance.accuracy).collect::<Option<_>>()?;
    let reference_lx = reference_lx(map);
    if reference_lx <= 0.0 {
        return None;
    }
    let lx = |of_part: fn(&Accuracy) -> f64| {
        parts.iter().zip(&of).map(move |(part, a)| part.dimmed_lx(of_part(a)))
    };
    let squares = |terms: &[f64]| terms.iter().map(|t| t * t).sum::<f64>();
    let statistical = add_noise(lx(|a| a.statistical), is_independent) / reference_lx;
    let beside_caustics = {
        let shape = |v: &VertexLight| v.interpolation_error_lx;
        spread(map, columns, lx(Accuracy::discretization_beside_caustics), shape) / reference_lx
    };
    let caustics = add_noise(lx(|a| a.caustics), true) / reference_lx;
    let discretization = squares(&[beside_caustics, caustics]).sqrt();
    let bias = spread(map, columns, lx(|a| a.bias), VertexLight::illuminance_lx) / reference_lx;
    let reached = squares(&[statistical, discretization, bias]).sqrt();
    let beyond =
        |a: &Accuracy| (squares(&[a.interpolated]) - squares(&[a.reached])).max(0.0).sqrt();
    let direct: f64 = parts.iter().zip(&of).map(|(p, a)| p.dimmed_lx(beyond(a))).sum();
    let interpolated = squares(&[reached, direct / reference_lx]).sqrt();
    Some(Accuracy { reached, statistical, discretization, caustics, bias, interpolated })
}

/// The root mean square of a sum of errors, lx. Each is distributed over the surface like `shape`, scaled to
/// its known root mean square in its part.
fn spread(
    map: &IlluminationMap,
    columns: &[Vec<Option<VertexLight>>],
    errors_lx: impl Iterator<Item = f64>,
    shape: impl Fn(&VertexLight) -> f64,
) -> f64 {
    let known = || map.elements.vertices().iter().zip(&map.values).enumerate();
    let areas =
        || known().filter(|(_, (_, value))| value.is_some()).map(|(k, (v, _))| (k, v.area_m2));
    let area_m2: f64 = areas().map(|(_, area)| area).sum();
    let mut sums = vec![0.0; map.values.len()];
    for (column, error_lx) in columns.iter().zip(errors_lx) {
        let at = |k: usize| column[k].as_ref().map_or(0.0, &shape);
        let squared: f64 = areas().map(|(k, area)| area * at(k) * at(k)).sum();
        let rms = (squared / area_m2.max(f64::MIN_POSITIVE)).sqrt();
        for (k, sum) in sums.iter_mut().enumerate() {
            // Where `shape` is zero everywhere, the error is uniform.
            *sum += error_lx * if rms > 0.0 { at(k) / rms } else { 1.0 };
        }
    }
    let squared: f64 = areas().map(|(k, area)| area * sums[k] * sums[k]).sum();
    (squared / area_m2.max(f64::MIN_POSITIVE)).sqrt()
}
