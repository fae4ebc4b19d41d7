//! Kinds of luminaires, which share one table.

use super::lobe::{Lobe, Lobes};
use crate::photometry::IntensityDistribution;
use isolux_geometry::Vector;
use std::collections::HashMap;
use std::sync::Arc;

/// A kind: lamps with the same distribution and orientation.
#[derive(Clone, Debug)]
pub(crate) struct Kind {
    /// Axes of the lamp's frame in the world.
    pub(crate) frame: [Vector; 3],
    pub(crate) lobe: Lobe,
    /// Number of one of these luminaires, whose distribution represents all.
    pub(crate) luminaire: u32,
}

/// Kinds and tables made so far, by distribution.
#[derive(Default)]
pub(crate) struct Kinds {
    by_address: HashMap<usize, Lobe>,
    by_shape: HashMap<blake3::Hash, Lobe>,
    pub(crate) all: Vec<Kind>,
    by_parts: HashMap<(usize, u64, [[u64; 3]; 3]), u32>,
}

impl Kinds {
    /// Index of a kind; a new kind is added.
    pub(crate) fn kind(&mut self, intensity: &IntensityDistribution, kind: Kind) -> u32 {
        let of = match intensity {
            IntensityDistribution::Web(web) => (Arc::as_ptr(web) as usize, 0),
            // Its table and its highest intensity identify such a distribution.
            other => (kind.lobe.number(), other.max_intensity_cd().to_bits()),
        };
        let frame = kind.frame.map(|axis| [axis.x, axis.y, axis.z].map(f64::to_bits));
        *self.by_parts.entry((of.0, of.1, frame)).or_insert_with(|| {
            self.all.push(kind);
            self.all.len() as u32 - 1
        })
    }

    /// Table of a distribution; luminaires that differ only in power share one.
    pub(crate) fn lobe(&mut self, intensity: &IntensityDistribution, lobes: &mut Lobes) -> Lobe {
        let address = match intensity {
            IntensityDistribution::Web(web) => Some(Arc::as_ptr(web) as usize),
            _ => None,
        };
        if let Some(lobe) = address.and_then(|a| self.by_address.get(&a)) {
            return *lobe;
        }
        let made = self.by_shape.entry(shape(intensity));
        let lobe = *made.or_insert_with(|| lobes.add(intensity));
        if let Some(address) = address {
            self.by_address.insert(address, lobe);
        }
        lobe
    }
}

/// Hash of a distribution without its power.
fn shape(intensity: &IntensityDistribution) -> blake3::Hash {
    let mut hasher = blake3::Hasher::new();
    let mut numbers = |numbers: &mut dyn Iterator<Item = f64>| {
        numbers.for_each(|n| {
            hasher.update(&n.to_bits().to_le_bytes());
        });
    };
    match intensity {
        IntensityDistribution::Isotropic { .. } => numbers(&mut [0.0].into_iter()),
        IntensityDistribution::CosinePower { exponent, .. } => {
            numbers(&mut [1.0, *exponent].into_iter());
        }
        IntensityDistribution::Spot { inner_rad, outer_rad, .. } => {
            numbers(&mut [2.0, *inner_rad, *outer_rad].into_iter());
        }
        IntensityDistribution::Web(web) => {
            let most_cd = web.max_intensity_cd().max(f64::MIN_POSITIVE);
            let kind = 3.0 + f64::from(web.system() as u8);
            numbers(&mut [kind, web.planes_deg().len() as f64].into_iter());
            numbers(&mut web.planes_deg().iter().copied());
            numbers(&mut web.gammas_deg().iter().copied());
            // Six digits, so that the rounding of a factor makes no difference; zero stays zero.
            numbers(&mut web.candela().iter().map(|cd| (cd / most_cd * 1e6).ceil()));
        }
    }
    hasher.finalize()
}
