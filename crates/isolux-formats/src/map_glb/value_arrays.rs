//! Elements and values of a map as arrays, and back.

use super::Fault;
use super::arrays::{Arrays, Table, write_floats, write_integers};
use super::bytes::Bytes;
use isolux::elements::{ElementArrays, Elements};
use isolux::map::{IlluminationMap, Standing, VertexLight};
use isolux::units::Rgb;

const POSITIONS: &str = "vertex_positions";
const NORMALS: &str = "vertex_normals";
const PARENTS: &str = "vertex_parents";
const AREAS: &str = "vertex_areas_m2";
const NODES: &str = "nodes";
const SPLITS: &str = "splits";
const ROOTS: &str = "roots";
const KNOWN: &str = "known";
const SAMPLES: &str = "samples";
const DIRECT: &str = "direct_lx";
const CAUSTIC: &str = "caustic_lx";
const INDIRECT: &str = "indirect_lx";
const ERRORS: &str = "standard_errors_lx";
const COMMON: &str = "common_errors_lx";
const INTERPOLATION: &str = "interpolation_errors_lx";

/// Writes elements and values.
pub(super) fn write(map: &IlluminationMap, bytes: &mut Bytes, table: &mut Table) {
    let elements = map.elements.to_arrays();
    let mut floats = |name, columns, values: &[f64]| {
        write_floats((bytes, table), name, columns, values);
    };
    floats(POSITIONS, 3, elements.positions.as_flattened());
    floats(NORMALS, 3, elements.normals.as_flattened());
    floats(AREAS, 1, &elements.areas_m2);
    let values: Vec<Option<VertexLight>> =
        map.values.iter().map(|v| v.and_then(storable)).collect();
    let colours = |f: fn(&VertexLight) -> Rgb| -> Vec<f64> {
        values.iter().flat_map(|v| v.as_ref().map_or([0.0; 3], |v| f(v).0)).collect()
    };
    floats(DIRECT, 3, &colours(|v| v.direct_lx));
    floats(CAUSTIC, 3, &colours(|v| v.caustic_lx));
    floats(INDIRECT, 3, &colours(|v| v.indirect_lx));
    let errors = |v: &VertexLight| [v.standard_error_lx, v.indirect_standard_error_lx];
    let errors = values.iter().flat_map(|v| v.as_ref().map_or([0.0; 2], errors));
    floats(ERRORS, 2, &errors.collect::<Vec<_>>());
    let common = values.iter().map(|v| v.map_or(0.0, |v| v.common_error_lx));
    floats(COMMON, 1, &common.collect::<Vec<_>>());
    let interpolation = values.iter().map(|v| v.map_or(0.0, |v| v.interpolation_error_lx));
    floats(INTERPOLATION, 1, &interpolation.collect::<Vec<_>>());
    let mut integers = |name, columns, values: Vec<u64>| {
        write_integers((bytes, table), name, columns, &values);
    };
    let wide = |rows: &[u32]| rows.iter().map(|&v| u64::from(v)).collect();
    integers(PARENTS, 2, wide(elements.parents.as_flattened()));
    integers(NODES, 3, wide(elements.nodes.as_flattened()));
    integers(SPLITS, 2, wide(elements.splits.as_flattened()));
    integers(ROOTS, 2, wide(elements.roots.as_flattened()));
    integers(KNOWN, 1, values.iter().map(|v| v.map_or(0, |v| rank(v.standing))).collect());
    integers(SAMPLES, 1, values.iter().map(|v| v.map_or(0, |v| v.samples)).collect());
}

/// Of a standing in files; 0 is that of an unknown value.
fn rank(standing: Standing) -> u64 {
    Standing::ALL.iter().position(|&s| s == standing).map_or(0, |index| index as u64 + 1)
}

fn standing(rank: u64) -> Option<Standing> {
    let index = usize::try_from(rank).ok()?.checked_sub(1)?;
    Standing::ALL.get(index).copied()
}

/// A value as files hold it: finite or unknown; an error that is not a number is boundless.
pub(super) fn storable(value: VertexLight) -> Option<VertexLight> {
    let finite =
        [value.direct_lx, value.caustic_lx, value.indirect_lx].iter().all(|c| c.is_finite());
    let bounded = |error: f64| if error.is_nan() { f64::INFINITY } else { error };
    finite.then(|| VertexLight {
        standard_error_lx: bounded(value.standard_error_lx),
        indirect_standard_error_lx: bounded(value.indirect_standard_error_lx),
        common_error_lx: bounded(value.common_error_lx),
        interpolation_error_lx: bounded(value.interpolation_error_lx),
        ..value
    })
}

/// The elements of a file of any origin, over a scene of so many triangles.
pub(super) fn read_elements(arrays: &Arrays<'_>, triangles: usize) -> Result<Elements, Fault> {
    let elements = ElementArrays {
        positions: arrays.float_rows(POSITIONS)?,
        normals: arrays.float_rows(NORMALS)?,
        parents: arrays.index_rows(PARENTS)?,
        areas_m2: arrays.float_rows::<1>(AREAS)?.into_iter().flatten().collect(),
        nodes: arrays.index_rows(NODES)?,
        splits: arrays.index_rows(SPLITS)?,
        roots: arrays.index_rows(ROOTS)?,
    };
    if elements.roots.len() != triangles {
        let what = format!("has {} rows for {triangles} triangles", elements.roots.len());
        return Err(Fault::new(format!("extras.isolux.arrays.{ROOTS}"), what));
    }
    Elements::from_arrays(&elements)
        .map_err(|error| Fault::new("extras.isolux.arrays", error.to_string()))
}

/// The values of a file of any origin, one for each of `count` vertices.
pub(super) fn read_values(
    arrays: &Arrays<'_>,
    count: usize,
) -> Result<Vec<Option<VertexLight>>, Fault> {
    let [direct, caustic, indirect] = [DIRECT, CAUSTIC, INDIRECT].map(|n| arrays.float_rows(n));
    let (direct, caustic, indirect) = (direct?, caustic?, indirect?);
    let errors = arrays.floats(ERRORS, 2)?;
    let (errors, _) = errors.as_chunks::<2>();
    let interpolation = arrays.floats(INTERPOLATION, 1)?;
    // Maps of earlier versions do not tell it.
    let common = if arrays.table.contains_key(COMMON) {
        arrays.floats(COMMON, 1)?
    } else {
        vec![0.0; count]
    };
    let (known, samples) = (arrays.integers(KNOWN, 1)?, arrays.integers(SAMPLES, 1)?);
    let numbers = [errors.len(), common.len(), interpolation.len(), known.len(), samples.len()];
    let colours = [direct.len(), caustic.len(), indirect.len()];
    if numbers != [count; 5] || colours != [count; 3] {
        let lengths = (colours, numbers);
        let what = format!("hold {lengths:?} values for {count} vertices");
        return Err(Fault::new("extras.isolux.arrays", what));
    }
    let all = [(ERRORS, errors.as_flattened()), (COMMON, &common), (INTERPOLATION, &interpolation)];
    for (name, errors) in all {
        if errors.iter().any(|e| *e < 0.0) {
            return Err(Fault::new(
                format!("extras.isolux.arrays.{name}"),
                "holds a negative error",
            ));
        }
    }
    if known.iter().any(|&rank| rank > Standing::ALL.len() as u64) {
        return Err(Fault::new(format!("extras.isolux.arrays.{KNOWN}"), "holds no standing"));
    }
    let value = |k: usize, standing: Standing| VertexLight {
        direct_lx: Rgb(direct[k]),
        caustic_lx: Rgb(caustic[k]),
        indirect_lx: Rgb(indirect[k]),
        standard_error_lx: errors[k][0],
        indirect_standard_error_lx: errors[k][1],
        common_error_lx: common[k],
        interpolation_error_lx: interpolation[k],
        standing,
        samples: samples[k],
    };
    Ok((0..count).map(|k| standing(known[k]).map(|standing| value(k, standing))).collect())
}
