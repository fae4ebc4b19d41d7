//! The light tree: clusters of point luminaires and, where they are many, of triangles of emitting
//! surfaces. Each cluster has a bounding sphere and a table of its directional distribution.

pub(super) mod cut;
mod kind;
pub(super) mod lobe;

use super::sources::triangle_lamps::{Face, middle_and_twice_m2};
use crate::photometry::IntensityDistribution;
use crate::scene::{LuminaireKind, LuminousArea, Scene};
use crate::units::Rgb;
use isolux_geometry::{Direction, Normal, Point, Vector};
use kind::{Kind, Kinds};
use lobe::{Lobe, Lobes, PartOfMixture};

/// The most lamps in a leaf.
const MOST_LEAF_LAMPS: usize = 16;

/// Lamps of a cluster that its weight is estimated from.
const MEMBERS: usize = 4;

/// The most lamps of a cluster that is divided by kind before it is divided in space.
const SMALL_CLUSTER_LAMPS: usize = 128;
/// Such a division requires a share of at least one in this number for the most frequent kind.
const FREQUENT_KIND_DIVISOR: usize = 8;

/// A lamp of the light tree: a point luminaire or a face. It fits in one cache line.
#[derive(Clone, Debug)]
pub(crate) struct Lamp {
    pub(crate) position: Point,
    pub(crate) colour: Rgb,
    /// Number of the luminaire in the scene; faces have the numbers after those of luminaires.
    pub(crate) luminaire: u32,
    pub(crate) kind: u32,
    /// Highest luminous intensity times the luminance of the colour, cd.
    pub(crate) peak_cd: f64,
}

/// A cluster of lamps.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub(crate) centre: Point,
    pub(crate) radius_m: f64,
    pub(crate) lobe: Lobe,
    /// Kind of all its lamps. `None` if they differ; `lobe` is then in the axes of the world.
    pub(crate) kind: Option<u32>,
    pub(crate) peak_cd: f64,
    /// Index of its first lamp.
    pub(crate) first: u32,
    pub(crate) count: u32,
    /// Lamps of the cluster, each representing an equal part of its power.
    pub(crate) members: [u32; MEMBERS],
    /// Number of its second half, `None` for a leaf. The first half follows the node itself.
    pub(crate) second: Option<u32>,
}

/// A bounding sphere of lamps.
struct Sphere {
    centre: Point,
    radius_m: f64,
    /// Axis of the largest extent of the positions of the lamps.
    widest: usize,
}

/// The light tree, with lamps and nodes in its order.
#[derive(Debug, Default)]
pub(crate) struct Tree {
    pub(crate) lamps: Vec<Lamp>,
    pub(crate) kinds: Vec<Kind>,
    /// Running sums of the highest intensities of the lamps, starting with zero.
    pub(crate) peak_sums_cd: Vec<f64>,
    pub(crate) nodes: Vec<Node>,
    pub(crate) lobes: Lobes,
    /// Faces among the lamps, indexed by luminaire number less `first_face`.
    pub(crate) faces: Vec<Face>,
    first_face: u32,
    /// Radii of luminous areas by luminaire, m; empty if there are none.
    radii_m: Vec<f64>,
}

impl Tree {
    /// The light tree of a scene's point luminaires, if `has_points`, and of `faces`. Lamps without light are left out.
    pub(crate) fn of(scene: &Scene, has_points: bool, faces: Vec<Face>) -> Self {
        let first_face = scene.luminaires().len() as u32;
        let mut tree = Self { faces, first_face, ..Self::default() };
        let mut kinds = Kinds::default();
        if has_points {
            if scene.luminaires().iter().any(|luminaire| luminaire.kind.area().is_some()) {
                let areas = scene.luminaires().iter().map(|luminaire| luminaire.kind.area());
                tree.radii_m = areas.map(|area| area.map_or(0.0, LuminousArea::radius_m)).collect();
            }
            tree.add_points(scene, &mut kinds);
        }
        tree.add_faces(scene, &mut kinds);
        tree.kinds = kinds.all;
        if !tree.lamps.is_empty() {
            tree.build(0, tree.lamps.len());
        }
        tree.sum_up();
        tree
    }

    fn add_points(&mut self, scene: &Scene, kinds: &mut Kinds) {
        for (index, luminaire) in scene.luminaires().iter().enumerate() {
            let LuminaireKind::Point { position, world_from_luminaire, intensity, .. } =
                &luminaire.kind
            else {
                continue;
            };
            let peak_cd = intensity.max_intensity_cd() * luminaire.colour.luminance();
            if peak_cd > 0.0 {
                let luminaire_index = index as u32;
                let frame = world_from_luminaire.columns;
                let lobe = kinds.lobe(intensity, &mut self.lobes);
                let kind = kinds.kind(intensity, Kind { frame, lobe, luminaire: luminaire_index });
                self.lamps.push(Lamp {
                    position: *position,
                    colour: luminaire.colour,
                    luminaire: luminaire_index,
                    kind,
                    peak_cd,
                });
            }
        }
    }

    /// Adds the faces, with intensities in proportion to the cosine of the angle from the normal.
    fn add_faces(&mut self, scene: &Scene, kinds: &mut Kinds) {
        let cosine = IntensityDistribution::CosinePower { peak_cd: 1.0, exponent: 1.0 };
        for (index, face) in self.faces.iter().enumerate() {
            let colour = scene.area_luminaires()[face.surface as usize].luminance_cd_m2;
            let (position, twice_m2) = middle_and_twice_m2(face.corners(scene));
            let peak_cd = 0.5 * twice_m2.length() * colour.luminance();
            let Some(normal) = twice_m2.normal().filter(|_| peak_cd > 0.0) else { continue };
            let lobe = kinds.lobe(&cosine, &mut self.lobes);
            let luminaire = self.first_face + index as u32;
            let kind = kinds.kind(&cosine, Kind { frame: shining_along(normal), lobe, luminaire });
            self.lamps.push(Lamp { position, colour, luminaire, kind, peak_cd });
        }
    }

    /// The face of a lamp; `None` for a point luminaire.
    pub(crate) fn face(&self, lamp: &Lamp) -> Option<&Face> {
        let index = lamp.luminaire.checked_sub(self.first_face)?;
        Some(&self.faces[index as usize])
    }

    /// Radius of a sphere about the position of a lamp that contains all of it, m.
    pub(crate) fn radius_m(&self, lamp: &Lamp) -> f64 {
        match self.face(lamp) {
            Some(face) => face.radius_m,
            None => self.radii_m.get(lamp.luminaire as usize).copied().unwrap_or(0.0),
        }
    }

    /// Whether some lamps are faces or have a luminous area.
    pub(crate) fn has_extents(&self) -> bool {
        !self.faces.is_empty() || !self.radii_m.is_empty()
    }

    /// The luminous area of a lamp; `None` for a point and for a face.
    pub(crate) fn area<'s>(&self, scene: &'s Scene, lamp: &Lamp) -> Option<&'s LuminousArea> {
        let some = !self.radii_m.is_empty() && self.face(lamp).is_none();
        some.then(|| scene.luminaires()[lamp.luminaire as usize].kind.area())?
    }

    /// Computes the running sums, and the members of clusters from them.
    fn sum_up(&mut self) {
        let mut sum_cd = 0.0;
        let sums_cd = self.lamps.iter().map(|l| {
            sum_cd += l.peak_cd;
            sum_cd
        });
        self.peak_sums_cd = std::iter::once(0.0).chain(sums_cd).collect();
        for index in 0..self.nodes.len() {
            let node = &self.nodes[index];
            let places = std::array::from_fn(|k| (k as f64 + 0.5) / MEMBERS as f64);
            self.nodes[index].members = places.map(|place| self.member(node, place));
        }
    }

    /// Index of the lamp at a place from 0 to 1 on the power of a cluster.
    pub(crate) fn member(&self, node: &Node, place: f64) -> u32 {
        let (first, end) = (node.first as usize, (node.first + node.count) as usize);
        let sums_cd = &self.peak_sums_cd[first..=end];
        let (from_cd, to_cd) = (sums_cd[0], sums_cd[sums_cd.len() - 1]);
        (first + place_in(sums_cd, from_cd + (to_cd - from_cd) * place)) as u32
    }

    /// Appends the cluster of a range of lamps and its descendants.
    fn build(&mut self, first: usize, end: usize) -> u32 {
        let index = self.nodes.len();
        let Sphere { centre, radius_m, widest } = self.sphere(&self.lamps[first..end]);
        self.nodes.push(Node {
            centre,
            radius_m,
            lobe: self.kinds[self.lamps[first].kind as usize].lobe,
            kind: None,
            peak_cd: 0.0,
            first: first as u32,
            count: (end - first) as u32,
            members: [first as u32; MEMBERS],
            second: None,
        });
        if end - first > MOST_LEAF_LAMPS {
            let lamps = &mut self.lamps[first..end];
            let middle = first + divide_by_kind(lamps).unwrap_or_else(|| halve(lamps, widest));
            self.build(first, middle);
            self.nodes[index].second = Some(self.build(middle, end));
        } else {
            // The division is the same on every machine, the order inside a half is not.
            self.lamps[first..end].sort_unstable_by_key(|l| l.luminaire);
        }
        self.find_lobe(index);
        index as u32
    }

    /// A bounding sphere of lamps.
    fn sphere(&self, lamps: &[Lamp]) -> Sphere {
        let first = lamps[0].position;
        let (low, high) = lamps.iter().fold((first, first), |(low, high), l| {
            (low.lesser(l.position), high.greater(l.position))
        });
        let centre = low.lerp(high, 0.5);
        let reach_m = |l: &Lamp| (l.position - centre).length() + self.radius_m(l);
        let radius_m = lamps.iter().map(reach_m).fold(0.0, f64::max);
        let size = high - low;
        let widest = if size.x >= size.y && size.x >= size.z {
            0
        } else if size.y >= size.z {
            1
        } else {
            2
        };
        // Allowance for the rounding of a length and of the steps after it.
        Sphere { centre, radius_m: radius_m * (1.0 + 1e-12), widest }
    }

    /// Sets the table of a cluster whose parts have theirs: the common one if all kinds are equal, else a mixture.
    fn find_lobe(&mut self, index: usize) {
        let node = &self.nodes[index];
        let lamps = &self.lamps[node.first as usize..][..node.count as usize];
        let peak_cd = lamps.iter().map(|l| l.peak_cd).sum();
        let kind_of = |kind: u32| &self.kinds[kind as usize];
        let kind = lamps[0].kind;
        let (lobe, kind) = if lamps.iter().all(|l| l.kind == kind) {
            (kind_of(kind).lobe, Some(kind))
        } else {
            let mixed = match node.second {
                None => self.lobes.mix(lamps.iter().map(|l| {
                    let kind = kind_of(l.kind);
                    let weight = l.peak_cd / peak_cd;
                    PartOfMixture { lobe: kind.lobe, frame: Some(&kind.frame), weight }
                })),
                Some(second) => {
                    let halves = [&self.nodes[index + 1], &self.nodes[second as usize]];
                    self.lobes.mix(halves.into_iter().map(|half| {
                        let frame = half.kind.map(|kind| &kind_of(kind).frame);
                        let weight = half.peak_cd / peak_cd;
                        PartOfMixture { lobe: half.lobe, frame, weight }
                    }))
                }
            };
            (mixed, None)
        };
        let node = &mut self.nodes[index];
        (node.lobe, node.kind, node.peak_cd) = (lobe, kind, peak_cd);
    }
}

/// Index of the interval of running sums that contains a sum. A linear guess comes before the binary search.
fn place_in(sums: &[f64], sum: f64) -> usize {
    let last = sums.len() - 2;
    let share = (sum - sums[0]) / (sums[last + 1] - sums[0]);
    let guess = ((share * (last + 1) as f64) as usize).min(last);
    if sums[guess] <= sum && sum < sums[guess + 1] {
        return guess;
    }
    sums.partition_point(|&s| s <= sum).clamp(1, last + 1) - 1
}

/// Puts the lower half along an axis first; returns its size.
fn halve(lamps: &mut [Lamp], axis: usize) -> usize {
    let along = |l: &Lamp| l.position.to_vector().component(axis);
    let middle = lamps.len() / 2;
    lamps.select_nth_unstable_by(middle, |a, b| {
        along(a).total_cmp(&along(b)).then(a.luminaire.cmp(&b.luminaire))
    });
    middle
}

/// Puts the lamps of the most frequent kind first and returns their number. `None` if these are all
/// or too few, or if the cluster is too large for its parts to stay close in space.
fn divide_by_kind(lamps: &mut [Lamp]) -> Option<usize> {
    if lamps.len() > SMALL_CLUSTER_LAMPS {
        return None;
    }
    let count = |kind: u32| lamps.iter().filter(|l| l.kind == kind).count();
    let kind = lamps.iter().map(|l| l.kind).max_by_key(|&kind| (count(kind), kind))?;
    let alike = count(kind);
    if alike == lamps.len() || alike * FREQUENT_KIND_DIVISOR < lamps.len() {
        return None;
    }
    lamps.sort_unstable_by_key(|l| (l.kind != kind, l.luminaire));
    Some(alike)
}

/// The axes of a frame whose -z, the main direction of luminaires, is along a normal.
fn shining_along(normal: Normal) -> [Vector; 3] {
    let back = -normal.to_direction();
    let (x, y) = back.frame();
    [x, y, back].map(Direction::to_vector)
}

/// Whether each lamp has an image by each chain of mirrors.
#[derive(Debug, Default)]
pub(crate) struct Images {
    chains: usize,
    exist: Vec<bool>,
}

impl Images {
    /// The images of all lamps of a tree, as told by `exists`.
    pub(crate) fn of(tree: &Tree, chains: usize, exists: impl Fn(&Lamp, usize) -> bool) -> Self {
        let all = tree.lamps.iter().flat_map(|l| (0..chains).map(move |c| (l, c)));
        Self { chains, exist: all.map(|(l, c)| exists(l, c)).collect() }
    }

    /// Whether a lamp has an image by a chain.
    pub(crate) fn has(&self, lamp: u32, chain: usize) -> bool {
        self.exist[lamp as usize * self.chains + chain]
    }
}
