//! An emitting surface of many triangles as a receiver sees it. Near triangles have their exact projected solid
//! angle. The others form clusters with an estimate of it; a cluster is searched for a triangle when it is drawn.

use super::super::polygon::{Piece, drawn, pieces};
use super::super::sources::triangle_tree::{Clusters, Outlook};
use crate::engine::ray::SurfacePoint;
use isolux_geometry::Point;
use std::borrow::Cow;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Triangles and clusters examined for every sample.
const EXAMINED_PARTS: usize = 64;
/// Number of samples up to which that grows in proportion.
const MOST_PROPORTIONAL_SAMPLES: usize = 8;

/// A cluster of the partition.
struct Part {
    cluster: u32,
    /// Estimate of its projected solid angle, sr: exact with pieces, zero only if the true value is zero.
    weight: f64,
    pieces: Option<Vec<Piece>>,
}

/// A cluster that may be divided, in the order of its doubt.
struct Doubtful {
    doubt: f64,
    cluster: u32,
}

impl Ord for Doubtful {
    fn cmp(&self, other: &Self) -> Ordering {
        // Ties follow the numbers of the clusters, so that the partition is the same on every machine.
        self.doubt.total_cmp(&other.doubt).then(self.cluster.cmp(&other.cluster))
    }
}

impl PartialOrd for Doubtful {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Doubtful {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Doubtful {}

/// A partition of all triangles that a receiver may see.
pub(crate) struct Parted<'a> {
    at: SurfacePoint,
    clusters: &'a Clusters,
    triangles: &'a [[Point; 3]],
    parts: Vec<Part>,
    /// Sum of the weights, sr.
    pub(crate) whole: f64,
}

impl<'a> Parted<'a> {
    /// The partition for `samples` samples.
    pub(crate) fn new(
        at: &SurfacePoint,
        clusters: &'a Clusters,
        triangles: &'a [[Point; 3]],
        samples: usize,
    ) -> Self {
        let parts = Vec::with_capacity(EXAMINED_PARTS);
        let mut parted = Self { at: *at, clusters, triangles, parts, whole: 0.0 };
        parted.divide(EXAMINED_PARTS * samples.min(MOST_PROPORTIONAL_SAMPLES));
        parted.whole = parted.parts.iter().map(|part| part.weight).sum();
        parted
    }

    /// Divides the clusters whose outlook is unknown, the most doubtful first, until `most` have been examined.
    fn divide(&mut self, most: usize) {
        let (mut waiting, mut looked_at) = (BinaryHeap::with_capacity(EXAMINED_PARTS), 0);
        self.look(0, &mut waiting);
        while looked_at < most {
            let Some(Doubtful { cluster, .. }) = waiting.pop() else { break };
            if let Some(halves) = self.clusters.halves(cluster) {
                looked_at += halves.len();
                halves.into_iter().for_each(|half| self.look(half, &mut waiting));
            } else {
                let pieces = self.pieces(cluster);
                looked_at += self.clusters.triangles(cluster).len();
                self.take(cluster, whole(&pieces), Some(pieces));
            }
        }
        for Doubtful { cluster, .. } in waiting {
            self.take(cluster, self.clusters.steradians(cluster, &self.at), None);
        }
    }

    /// Takes a cluster whose outlook is known; lets others wait in the order of their doubt.
    fn look(&mut self, cluster: u32, waiting: &mut BinaryHeap<Doubtful>) {
        match self.clusters.outlook(cluster, &self.at) {
            Outlook::Dark => {}
            Outlook::Known(weight) => self.take(cluster, weight, None),
            Outlook::Unknown => {
                let doubt = self.clusters.doubt(cluster, &self.at);
                waiting.push(Doubtful { doubt, cluster });
            }
        }
    }

    fn take(&mut self, cluster: u32, weight: f64, pieces: Option<Vec<Piece>>) {
        if weight > 0.0 {
            self.parts.push(Part { cluster, weight, pieces });
        }
    }

    fn pieces(&self, cluster: u32) -> Vec<Piece> {
        let members = self.clusters.triangles(cluster).iter();
        pieces(&self.at, members.map(|&k| (k as usize, self.triangles[k as usize])))
    }

    /// The piece at a place from 0 to 1, and the projected solid angle that each of its directions
    /// stands for, as a share of the whole.
    pub(crate) fn drawn(&self, pick: f64) -> Option<(Cow<'_, Piece>, f64)> {
        let mut left = pick * self.whole;
        let found = self.parts.iter().find(|part| {
            left -= part.weight;
            left < 0.0
        });
        // Rounding may leave a remainder past the last part.
        let part = found.or(self.parts.last())?;
        let place = ((left + part.weight) / part.weight).clamp(0.0, 1.0);
        if let Some(pieces) = &part.pieces {
            return Some((Cow::Borrowed(drawn(pieces, place * part.weight)?), 1.0));
        }
        let (mut cluster, mut place, mut chance) = (part.cluster, place, 1.0);
        while let Some((halves, of_first)) = self.halves(cluster) {
            let is_first = place < of_first;
            let (half, share) = if is_first { (0, of_first) } else { (1, 1.0 - of_first) };
            place = if is_first { place } else { place - of_first } / share;
            chance *= share;
            cluster = halves[half];
        }
        let pieces = self.pieces(cluster);
        let whole = whole(&pieces);
        let share = whole / (part.weight * chance);
        drawn(&pieces, place * whole).map(|piece| (Cow::Owned(piece.clone()), share))
    }

    /// The projected solid angle that each direction to a triangle stands for, as a share of the
    /// whole; `None` where the triangle is never drawn.
    pub(crate) fn share(&self, triangle: usize) -> Option<f64> {
        let part = self.parts.iter().find(|part| self.clusters.has(part.cluster, triangle))?;
        if part.pieces.is_some() {
            return Some(1.0);
        }
        let (mut cluster, mut chance) = (part.cluster, 1.0);
        while let Some((halves, of_first)) = self.halves(cluster) {
            let is_first = self.clusters.has(halves[0], triangle);
            let (half, share) = if is_first { (0, of_first) } else { (1, 1.0 - of_first) };
            chance *= share;
            cluster = halves[half];
        }
        let share = whole(&self.pieces(cluster)) / (part.weight * chance);
        (share > 0.0 && share.is_finite()).then_some(share)
    }

    /// The halves of a cluster and the probability of the first, in proportion to their weights.
    fn halves(&self, cluster: u32) -> Option<([u32; 2], f64)> {
        let halves = self.clusters.halves(cluster)?;
        let [first, second] = halves.map(|half| self.clusters.weight(half, &self.at));
        // Neither half gives light: the choice does not matter.
        let of_first = if first + second > 0.0 { first / (first + second) } else { 0.5 };
        Some((halves, of_first))
    }
}

fn whole(pieces: &[Piece]) -> f64 {
    pieces.iter().map(|piece| piece.steradians).sum()
}
