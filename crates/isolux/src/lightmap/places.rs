//! Places within a texel, and what the map says there.

use super::cover::{self, Fragment};
use super::layout::Layout;
use crate::elements::PlaceOnSide;
use crate::engine::{Allowance, IndirectReading, MapReader, Told};
use crate::sampling::{Key, Sequence};
use crate::units::Rgb;

/// Where the map is to be trusted indirect light is smooth: it is read in the middle of the largest parts of a texel, those of at least this share.
const LARGE: f32 = 0.1;
const MOST_MIDDLES: usize = 3;
/// Places that are asked beside the middles.
const SPOTS: u32 = 4;

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
    /// Light is to be gathered; and a place that stands for the texel.
    Wanted(Setting, Place),
}

/// What the places of a texel have before them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Setting {
    /// Nothing so close that they would lie in a gap.
    Open,
    /// They lie in a gap.
    Gap,
    /// Some lie in a gap, or the map is to be trusted with some.
    Mixed,
    /// Something stands across the texel: its light is a mean that is due on neither side.
    Parted,
}

impl Setting {
    /// Of places of which some are not to be trusted, those by whether they lie in a gap.
    fn of(places: &[Option<bool>]) -> Self {
        match places {
            all if all.iter().all(|place| *place == Some(false)) => Self::Open,
            all if all.iter().all(|place| *place == Some(true)) => Self::Gap,
            _ => Self::Mixed,
        }
    }
}

impl Places<'_> {
    /// Random numbers of a texel.
    pub(super) fn key(&self, texel: u32) -> Key {
        Key::new(self.seed).with(11).with(u64::from(texel))
    }

    /// Asks the map in the middles of the largest parts, and at a few places more: what stands near a texel, or a gap,
    /// may reach over a part of it. It tells the light only if it is to be trusted at all of them.
    pub(super) fn survey(&self, fragments: &[Fragment]) -> (Survey, u64) {
        let whole: f32 = fragments.iter().map(|f| f.area_m2).sum();
        let mut largest: Vec<&Fragment> =
            fragments.iter().filter(|f| f.area_m2 >= LARGE * whole).collect();
        largest.sort_by(|a, b| b.area_m2.total_cmp(&a.area_m2));
        largest.truncate(MOST_MIDDLES);
        let middle = |fragment: &&Fragment| {
            let at = cover::polygon(self.layout, fragment).centroid();
            (f64::from(fragment.area_m2), Place { side: fragment.side, at })
        };
        let spots = self.spread(fragments, (SPOTS, 2)).map(|place| (1.0, place));
        let asked: Vec<(f64, Place)> = largest.iter().map(middle).chain(spots).collect();
        let told: Vec<Option<Told>> = asked.iter().map(|(_, place)| self.told(*place)).collect();
        let in_gap = |told: &Told| match told {
            Told::Light(_) => None,
            Told::Little { in_gap } => Some(*in_gap),
        };
        let all: Vec<Option<bool>> = told.iter().flatten().map(in_gap).collect();
        let mut known = asked.iter().zip(&told).filter(|(_, told)| told.is_some());
        let survey = if all.iter().any(Option::is_some)
            && let Some(((_, place), _)) = known.next()
        {
            let is_parted = known.any(|((_, other), _)| !self.sees(*place, *other));
            let setting = if is_parted { Setting::Parted } else { Setting::of(&all) };
            Survey::Wanted(setting, *place)
        } else {
            let light = |(&(weight, _), told): (&(f64, Place), &Option<Told>)| match told {
                Some(Told::Light(reading)) => Some((weight, *reading)),
                _ => None,
            };
            let light: Vec<_> = asked.iter().zip(&told).map(light).collect();
            let (middles, spots) = light.split_at(largest.len());
            let mean_of =
                |all: &[Option<_>]| mean(&all.iter().flatten().copied().collect::<Vec<_>>());
            mean_of(middles).or_else(|| mean_of(spots)).map_or(Survey::Unknown, Survey::Told)
        };
        (survey, asked.len() as u64)
    }

    /// Whether nothing parts the light of two places.
    pub(super) fn sees(&self, from: Place, to: Place) -> bool {
        self.reader.sees(self.on_side(from), self.on_side(to))
    }

    /// As the map interpolates it in the middle of the largest part that it knows, be it to be trusted there or not.
    pub(super) fn interpolated(&self, fragments: &[Fragment]) -> Option<IndirectReading> {
        self.amid_the_largest(fragments, |place| self.reader.interpolated_at(place))
    }

    /// Direct light as the map interpolates it there.
    pub(super) fn interpolated_direct(&self, fragments: &[Fragment]) -> Option<Rgb> {
        self.amid_the_largest(fragments, |place| self.reader.interpolated_direct_at(place))
    }

    /// What is found in the middle of the largest part that anything is found in.
    fn amid_the_largest<R>(
        &self,
        fragments: &[Fragment],
        find: impl Fn(PlaceOnSide) -> Option<R>,
    ) -> Option<R> {
        let mut largest: Vec<&Fragment> = fragments.iter().collect();
        largest.sort_by(|a, b| b.area_m2.total_cmp(&a.area_m2));
        largest.into_iter().find_map(|fragment| {
            let at = cover::polygon(self.layout, fragment).centroid();
            find(self.on_side(Place { side: fragment.side, at }))
        })
    }

    /// So many places, evenly over the area on the surface, by random numbers of their own.
    fn spread(
        &self,
        fragments: &[Fragment],
        (count, key): (u32, u64),
    ) -> impl Iterator<Item = Place> {
        let sequence = Sequence::new(self.key(fragments[0].texel).with(key));
        (0..count).map(move |index| self.place(fragments, sequence.pair(index, 0)))
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
        self.reader.told_at(self.on_side(place), Allowance::ANY)
    }

    /// The mean of what readings would be all over a texel.
    pub(super) fn gathered(&self, fragments: &[Fragment]) -> Option<IndirectReading> {
        let places = self.spread(fragments, (MapReader::PLACES, 4));
        self.reader.indirect_over(places.map(|place| self.on_side(place)))
    }

    /// One estimate of direct light.
    pub(super) fn direct(&self, place: Place, rays: usize, of: (Sequence, u32)) -> Option<Rgb> {
        self.reader.direct_once(self.on_side(place), rays, of)
    }

    fn on_side(&self, place: Place) -> PlaceOnSide {
        let side = &self.layout.sides[place.side as usize];
        let uv = cover::weights(self.layout, place.side, place.at);
        PlaceOnSide { triangle: side.triangle, back: side.back, uv }
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
