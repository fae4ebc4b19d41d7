//! Tables by a few numbers: edges by their ends, places by their coordinates.

use serde::{Serialize, Serializer};
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::hash::{BuildHasher, Hasher, RandomState};

/// Serializes a table in the order of its keys.
pub(crate) fn table_in_order<K: Ord + Serialize, V: Serialize, H, S: Serializer>(
    table: &HashMap<K, V, H>,
    to: S,
) -> Result<S::Ok, S::Error> {
    to.collect_map(table.iter().collect::<BTreeMap<_, _>>())
}

/// Serializes a set in the order of its members.
pub(crate) fn set_in_order<K: Ord + Serialize, S: Serializer>(
    set: &HashSet<K, FewNumbers>,
    to: S,
) -> Result<S::Ok, S::Error> {
    to.collect_seq(set.iter().collect::<BTreeSet<_>>())
}

/// Hashes a few numbers: the usual hash would take most of the time of a subdivision. It starts from a secret of its
/// own, so that no file can make keys collide; the order of a table is random, therefore, and nothing may depend on it.
#[derive(Clone, Debug)]
pub struct FewNumbers(u64);

impl Default for FewNumbers {
    fn default() -> Self {
        Self(RandomState::new().hash_one(0_u8))
    }
}

impl BuildHasher for FewNumbers {
    type Hasher = Folding;

    fn build_hasher(&self) -> Folding {
        Folding(self.0)
    }
}

/// Folds products with a number that has no pattern.
#[derive(Clone, Debug)]
pub struct Folding(u64);

impl Hasher for Folding {
    fn write(&mut self, bytes: &[u8]) {
        for part in bytes.chunks(8) {
            let mut word = [0; 8];
            word[..part.len()].copy_from_slice(part);
            let product = u128::from(self.0 ^ u64::from_le_bytes(word)) * 0x9e37_79b9_7f4a_7c15;
            self.0 = (product >> 64) as u64 ^ product as u64;
        }
    }

    fn finish(&self) -> u64 {
        self.0
    }
}
