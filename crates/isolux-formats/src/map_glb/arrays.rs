//! Named arrays of numbers in the binary chunk, each in the smallest type that loses nothing.

use super::Fault;
use super::bytes::{Bytes, View};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Type of the numbers, little-endian.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Scalar {
    U8,
    U32,
    U64,
    F32,
    F64,
}

impl Scalar {
    const fn bytes(self) -> usize {
        match self {
            Self::U8 => 1,
            Self::U32 | Self::F32 => 4,
            Self::U64 | Self::F64 => 8,
        }
    }
}

/// Where an array is and how to read it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Entry {
    /// Absent for an array without rows, as glTF knows no empty buffer views.
    #[serde(rename = "bufferView", skip_serializing_if = "Option::is_none", default)]
    pub(super) buffer_view: Option<u32>,
    #[serde(rename = "type")]
    pub(super) scalar: Scalar,
    /// Rows and columns; rows follow one another.
    pub(super) shape: [usize; 2],
}

/// All arrays, by name.
pub(super) type Table = BTreeMap<String, Entry>;

/// Adds an array of numbers, as `f32` where that is exact for every one of them.
pub(super) fn write_floats(
    (bytes, table): (&mut Bytes, &mut Table),
    name: &str,
    columns: usize,
    values: &[f64],
) {
    let exact = values.iter().all(|&v| f64::from(v as f32).to_bits() == v.to_bits());
    let (scalar, encoded): (_, Vec<u8>) = if exact {
        (Scalar::F32, values.iter().flat_map(|&v| (v as f32).to_le_bytes()).collect())
    } else {
        (Scalar::F64, values.iter().flat_map(|v| v.to_le_bytes()).collect())
    };
    add((bytes, table), name, scalar, [values.len() / columns, columns], &encoded);
}

/// Adds an array of whole numbers, in the smallest type that holds the largest.
pub(super) fn write_integers(
    (bytes, table): (&mut Bytes, &mut Table),
    name: &str,
    columns: usize,
    values: &[u64],
) {
    let largest = values.iter().copied().max().unwrap_or(0);
    let (scalar, encoded): (_, Vec<u8>) = if u8::try_from(largest).is_ok() {
        (Scalar::U8, values.iter().map(|&v| v as u8).collect())
    } else if u32::try_from(largest).is_ok() {
        (Scalar::U32, values.iter().flat_map(|&v| (v as u32).to_le_bytes()).collect())
    } else {
        (Scalar::U64, values.iter().flat_map(|v| v.to_le_bytes()).collect())
    };
    add((bytes, table), name, scalar, [values.len() / columns, columns], &encoded);
}

fn add(
    (bytes, table): (&mut Bytes, &mut Table),
    name: &str,
    scalar: Scalar,
    shape: [usize; 2],
    encoded: &[u8],
) {
    let buffer_view = (!encoded.is_empty()).then(|| bytes.view(encoded, None));
    table.insert(name.to_owned(), Entry { buffer_view, scalar, shape });
}

/// The arrays of a file, of any origin.
pub(super) struct Arrays<'a> {
    pub(super) binary: &'a [u8],
    pub(super) views: &'a [View],
    pub(super) table: &'a Table,
}

impl<'a> Arrays<'a> {
    /// An array of finite or infinite numbers; NaN is refused.
    pub(super) fn floats(&self, name: &str, columns: usize) -> Result<Vec<f64>, Fault> {
        let (scalar, bytes) = self.rows(name, columns)?;
        let values: Vec<f64> = match scalar {
            Scalar::F32 => words(bytes).map(|b| f64::from(f32::from_le_bytes(b))).collect(),
            Scalar::F64 => words(bytes).map(f64::from_le_bytes).collect(),
            _ => return Err(fault(name, "holds whole numbers where fractions are expected")),
        };
        if values.iter().any(|v| v.is_nan()) {
            return Err(fault(name, "holds something that is not a number"));
        }
        Ok(values)
    }

    /// An array of finite numbers, in rows.
    pub(super) fn float_rows<const N: usize>(&self, name: &str) -> Result<Vec<[f64; N]>, Fault> {
        let values = self.floats(name, N)?;
        if !values.iter().all(|v| v.is_finite()) {
            return Err(fault(name, "holds a number that is not finite"));
        }
        Ok(values.as_chunks().0.to_vec())
    }

    /// An array of whole numbers.
    pub(super) fn integers(&self, name: &str, columns: usize) -> Result<Vec<u64>, Fault> {
        let (scalar, bytes) = self.rows(name, columns)?;
        Ok(match scalar {
            Scalar::U8 => bytes.iter().map(|&b| u64::from(b)).collect(),
            Scalar::U32 => words(bytes).map(|b| u64::from(u32::from_le_bytes(b))).collect(),
            Scalar::U64 => words(bytes).map(u64::from_le_bytes).collect(),
            _ => return Err(fault(name, "holds fractions where whole numbers are expected")),
        })
    }

    /// An array of indices, in rows.
    pub(super) fn index_rows<const N: usize>(&self, name: &str) -> Result<Vec<[u32; N]>, Fault> {
        let values = self.integers(name, N)?;
        let indices: Vec<u32> = values
            .into_iter()
            .map(|v| u32::try_from(v).map_err(|_| fault(name, "holds an index beyond 32 bits")))
            .collect::<Result<_, _>>()?;
        Ok(indices.as_chunks().0.to_vec())
    }

    /// Type and bytes of an array, as long as its shape says.
    fn rows(&self, name: &str, columns: usize) -> Result<(Scalar, &'a [u8]), Fault> {
        let entry = self.table.get(name).ok_or_else(|| fault(name, "is missing"))?;
        let [rows, found] = entry.shape;
        if found != columns {
            return Err(fault(name, format!("has {found} columns in place of {columns}")));
        }
        let bytes = match entry.buffer_view {
            Some(view) => self.view(view),
            None => Some(&[][..]),
        };
        let bytes = bytes.ok_or_else(|| fault(name, "lies outside of the binary chunk"))?;
        let wanted = rows.checked_mul(columns).and_then(|n| n.checked_mul(entry.scalar.bytes()));
        if wanted != Some(bytes.len()) {
            return Err(fault(name, "is not as long as its shape says"));
        }
        Ok((entry.scalar, bytes))
    }

    /// The bytes of a buffer view.
    pub(super) fn view(&self, index: u32) -> Option<&'a [u8]> {
        self.views.get(index as usize)?.of(self.binary)
    }
}

/// Checksum of all arrays: names, types, shapes and contents in the order of names. `None` where a
/// view is not there.
pub(super) fn checksum<'a>(
    table: &Table,
    view: impl Fn(u32) -> Option<&'a [u8]>,
) -> Option<String> {
    let mut hasher = blake3::Hasher::new();
    for (name, entry) in table {
        let [rows, columns] = entry.shape;
        hasher.update(format!("{name} {:?} {rows} {columns}\n", entry.scalar).as_bytes());
        hasher.update(entry.buffer_view.map_or(Some(&[][..]), &view)?);
    }
    Some(hasher.finalize().to_hex().to_string())
}

fn words<const N: usize>(bytes: &[u8]) -> impl Iterator<Item = [u8; N]> + '_ {
    bytes.as_chunks().0.iter().copied()
}

fn fault(name: &str, what: impl Into<String>) -> Fault {
    Fault::new(format!("extras.isolux.arrays.{name}"), what)
}
