//! Places within a texel, and what the map says there.

use super::cover::{self, Fragment};
use super::layout::Layout;
use crate::engine::{IndirectReading, MapReader, Told};
use crate::sampling::{Key, Sequence};
use crate::units::Rgb;

/// Indirect light is smooth: it is read in the middle of the largest parts of a texel, those of at least this share.
const LARGE: f32 = 0.1;
const MOST_MIDDLES: usize = 3;
/// Where the map knows none of the middles, so many more places are asked.
const TRIES: u32 = 4;

/// A place on a side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// Index of the side.
    pub(super) side: u32,
    /// On its page, texels.
    pub(super) at: [f64; 2],
}

/// Reads a map at places of a layout.
pub(super) struct Places<'a> {
    pub(super) reader: MapReader<'a>,
    pub(super) layout: &'a Layout,
    pub(super) seed: u64,
}

/// What the map tells of the indirect light of a texel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Survey {
    /// It knows nothing of the surface.
    Unknown,
    /// The light.
    Told(IndirectReading),
    /// Light is to be gathered at a place.
    Wanted {
        /// The place.
        place: Place,
        /// Whether that lies in a gap.
        in_gap: bool,
    },
}

impl Places<'_> {
    /// Random numbers of a texel.
    pub(super) fn key(&self, texel: u32) -> Key {
        Key::new(self.seed).with(11).with(u64::from(texel))
    }

    /// Asks the map in the middles of the largest parts, the largest first, or else somewhere.
    pub(super) fn survey(&self, fragments: &[Fragment]) -> (Survey, u64) {
        let whole: f32 = fragments.iter().map(|f| f.area_m2).sum();
        let mut largest: Vec<&Fragment> =
            fragments.iter().filter(|f| f.area_m2 >= LARGE * whole).collect();
        largest.sort_by(|a, b| b.area_m2.total_cmp(&a.area_m2));
        largest.truncate(MOST_MIDDLES);
        let mut told: Vec<(f64, IndirectReading)> = Vec::with_capacity(MOST_MIDDLES);
        for (asked, fragment) in (1..).zip(&largest) {
            let at = cover::polygon(self.layout, fragment).centroid();
            let place = Place { side: fragment.side, at };
            match self.told(place) {
                Some(Told::Light(reading)) => told.push((f64::from(fragment.area_m2), reading)),
                Some(Told::Little { in_gap }) => return (Survey::Wanted { place, in_gap }, asked),
                None => {}
            }
        }
        let asked = largest.len() as u64;
        match mean(&told) {
            Some(reading) => (Survey::Told(reading), asked),
            None => (self.survey_elsewhere(fragments), asked + u64::from(TRIES)),
        }
    }

    fn survey_elsewhere(&self, fragments: &[Fragment]) -> Survey {
        let sequence = Sequence::new(self.key(fragments[0].texel).with(2));
        let known = (0..TRIES).find_map(|index| {
            let place = self.place(fragments, sequence.pair(index, 0));
            Some((place, self.told(place)?))
        });
        match known {
            None => Survey::Unknown,
            Some((_, Told::Light(reading))) => Survey::Told(reading),
            Some((place, Told::Little { in_gap })) => Survey::Wanted { place, in_gap },
        }
    }

    /// The place for a point of the unit square, evenly over the area on the surface.
    pub(super) fn place(&self, fragments: &[Fragment], [a, b]: [f64; 2]) -> Place {
        let area_m2: f64 = fragments.iter().map(|f| f64::from(f.area_m2)).sum();
        let mut left = a * area_m2;
        let mut chosen = (&fragments[0], 0.0);
        for fragment in fragments {
            let area = f64::from(fragment.area_m2);
            chosen = (fragment, (left / area).clamp(0.0, 1.0));
            if left < area {
                break;
            }
            left -= area;
        }
        let (fragment, along) = chosen;
        let at = cover::polygon(self.layout, fragment).point([along, b]);
        Place { side: fragment.side, at }
    }

    fn told(&self, place: Place) -> Option<Told> {
        self.reader.told_at(self.on_side(place))
    }

    /// Gathers light at a place.
    pub(super) fn gathered(&self, place: Place) -> Option<IndirectReading> {
        self.reader.indirect_at(self.on_side(place))
    }

    /// One estimate of direct light.
    pub(super) fn direct(&self, place: Place, rays: usize, of: (Sequence, u32)) -> Option<Rgb> {
        self.reader.direct_once(self.on_side(place), rays, of)
    }

    fn on_side(&self, place: Place) -> (u32, bool, [f64; 2]) {
        let side = &self.layout.sides[place.side as usize];
        (side.triangle, side.back, cover::weights(self.layout, place.side, place.at))
    }
}

/// By area, errors as if all had theirs in common.
fn mean(told: &[(f64, IndirectReading)]) -> Option<IndirectReading> {
    let area_m2: f64 = told.iter().map(|(area, _)| area).sum();
    let sum = |of: fn(&IndirectReading) -> f64| {
        told.iter().map(|(area, reading)| of(reading) * (area / area_m2)).sum()
    };
    (!told.is_empty()).then(|| IndirectReading {
        lx: told.iter().map(|(area, reading)| reading.lx * (area / area_m2)).sum(),
        error_lx: sum(|reading| reading.error_lx),
        noise_lx: sum(|reading| reading.noise_lx),
    })
}
