//! From a map to the values of texels.

use super::cover::{self, Fragment};
use super::layout::Layout;
use super::plan::LightmapError;
use super::seam_report::SeamReport;
use super::texels::{Cover, Lightmap};
use super::{dilate, stitch};
use crate::engine::{MapReader, Watch};
use crate::map::IlluminationMap;
use crate::sampling::{Key, Sequence};
use crate::scene::Scene;
use crate::units::Rgb;
use rayon::prelude::*;

/// Places at which the direct light of a texel is evaluated.
const PLACES: u32 = 4;
/// The same where these disagree: at the borders of shadows.
const MANY_PLACES: u32 = 32;
/// They disagree if their mean is less certain than this share of the error of indirect light, and than this
/// share of itself.
const OF_INDIRECT: f64 = 0.5;
const OF_VALUE: f64 = 0.002;
/// Indirect light is smooth: it is read in the middle of the largest parts of a texel, those of at least this share.
const LARGE: f32 = 0.1;
const MOST_MIDDLES: usize = 3;
/// Texels between two looks at whether to go on.
const BLOCK: usize = 2048;

/// Reads the map over the part of the surface that each texel covers: direct light at places spread evenly over it,
/// indirect light in its middle, each as [`MapReader`] has it. Then fills the borders of charts and makes the two
/// sides of seams agree. `watch` is told the share of the work that is done.
pub fn bake(
    scene: &Scene,
    map: &IlluminationMap,
    layout: &Layout,
    watch: &mut dyn FnMut(f64) -> Watch,
) -> Result<Lightmap, LightmapError> {
    let fragments = cover::fragments(scene, layout);
    let texels: Vec<&[Fragment]> = fragments.chunk_by(|a, b| a.texel == b.texel).collect();
    let baker = Baker { reader: MapReader::new(scene, map), layout, seed: map.provenance.seed };
    let mut baked = empty(layout);
    for (done, block) in texels.chunks(BLOCK).enumerate() {
        if watch((done * BLOCK) as f64 / texels.len() as f64) == Watch::Stop {
            return Err(LightmapError::Stopped);
        }
        let values: Vec<Value> = block.par_iter().map(|fragments| baker.texel(fragments)).collect();
        for (fragments, value) in block.iter().zip(values) {
            value.store(fragments, &mut baked);
        }
    }
    drop(texels);
    drop(fragments);
    dilate::fill(&mut baked);
    baked.seams = stitch::stitch(scene, &mut baked);
    Ok(baked)
}

fn empty(layout: &Layout) -> Lightmap {
    let count = layout.texel_count();
    Lightmap {
        layout: layout.clone(),
        shown_lx: vec![[0.0; 3]; count],
        covers: vec![Cover::Empty; count],
        owners: vec![0; count],
        standard_errors_lx: vec![0.0; count],
        coverage: vec![0.0; count],
        seams: SeamReport::default(),
        readings: 0,
    }
}

struct Baker<'a> {
    reader: MapReader<'a>,
    layout: &'a Layout,
    seed: u64,
}

/// A place on a side.
#[derive(Clone, Copy)]
struct Place {
    side: u32,
    at: [f64; 2],
}

/// What the map says over a texel.
struct Value {
    /// Illuminance, and the standard error of its photometric value, lx.
    known: Option<(Rgb, f64)>,
    coverage: f64,
    readings: u64,
}

impl Value {
    fn store(&self, fragments: &[Fragment], into: &mut Lightmap) {
        let texel = fragments[0].texel as usize;
        let largest = fragments.iter().max_by(|a, b| a.share.total_cmp(&b.share));
        into.owners[texel] = largest.map_or(0, |fragment| fragment.side);
        into.readings += self.readings;
        into.covers[texel] = Cover::Unknown;
        if let Some((lx, error_lx)) = self
            .known
            .filter(|(lx, error)| lx.0.iter().chain([error]).all(|c| (*c as f32).is_finite()))
        {
            into.covers[texel] = Cover::Known;
            into.shown_lx[texel] = lx.0.map(|c| c as f32);
            into.standard_errors_lx[texel] = error_lx as f32;
            into.coverage[texel] = self.coverage as f32;
        }
    }
}

/// Means over places.
struct Direct {
    lx: Rgb,
    /// Variance of the mean of the photometric value: of the places chosen, and of the readings.
    spread: f64,
    noise: f64,
    known: f64,
    /// One of the places that the map knows.
    place: Place,
}

impl<'a> Baker<'a> {
    fn texel(&self, fragments: &[Fragment]) -> Value {
        let share = fragments.iter().map(|f| f64::from(f.share)).sum::<f64>().min(1.0);
        let key = Key::new(self.seed).with(11).with(u64::from(fragments[0].texel));
        let mut readings = u64::from(PLACES);
        let Some(first) = self.direct(fragments, PLACES, key.with(0)) else {
            return Value { known: None, coverage: 0.0, readings };
        };
        let Some((indirect_lx, error_lx, middles)) = self.indirect(fragments, first.place) else {
            return Value { known: None, coverage: 0.0, readings };
        };
        readings += middles;
        let value = (first.lx + indirect_lx).luminance();
        let goal = (OF_INDIRECT * error_lx).max(OF_VALUE * value);
        let direct = if first.spread <= goal * goal {
            first
        } else {
            // With numbers of its own: who goes on where the first few disagree must not count them.
            readings += u64::from(MANY_PLACES);
            self.direct(fragments, MANY_PLACES, key.with(1)).unwrap_or(first)
        };
        let error_lx = (error_lx * error_lx + direct.spread + direct.noise).sqrt();
        let known = Some((direct.lx + indirect_lx, error_lx));
        Value { known, coverage: share * direct.known, readings }
    }

    /// Direct light at so many places, those that the map knows.
    fn direct(&self, fragments: &[Fragment], count: u32, key: Key) -> Option<Direct> {
        let sequence = Sequence::new(key);
        let area_m2: f64 = fragments.iter().map(|f| f64::from(f.area_m2)).sum();
        let read = |index: u32| {
            let place = self.place(fragments, area_m2, sequence.pair(index, 0));
            let (lx, variance) = self.read(place, MapReader::direct_at)?;
            Some((place, lx, variance))
        };
        let found: Vec<(Place, Rgb, f64)> = (0..count).filter_map(read).collect();
        let n = found.len() as f64;
        let place = found.first()?.0;
        let lx = found.iter().map(|f| f.1).sum::<Rgb>() / n;
        let squared = |f: &(Place, Rgb, f64)| (f.1.luminance() - lx.luminance()).powi(2);
        // A single known place says nothing about the others: as if they spread by its own value.
        let spread = match found.len() {
            1 => lx.luminance().powi(2),
            _ => found.iter().map(squared).sum::<f64>() / (n - 1.0) / n,
        };
        let noise = found.iter().map(|f| f.2).sum::<f64>() / (n * n);
        Some(Direct { lx, spread, noise, known: n / f64::from(count), place })
    }

    /// Indirect light in the middles of the largest parts, its error as if those had all of it in common, and the
    /// number of readings.
    fn indirect(&self, fragments: &[Fragment], known: Place) -> Option<(Rgb, f64, u64)> {
        let whole: f32 = fragments.iter().map(|f| f.area_m2).sum();
        let mut largest: Vec<&Fragment> =
            fragments.iter().filter(|f| f.area_m2 >= LARGE * whole).collect();
        largest.sort_by(|a, b| b.area_m2.total_cmp(&a.area_m2));
        largest.truncate(MOST_MIDDLES);
        let middle = |f: &&Fragment| {
            let at = cover::polygon(self.layout, f).centroid();
            let read = self.read(Place { side: f.side, at }, MapReader::indirect_at)?;
            Some((f64::from(f.area_m2), read))
        };
        let read: Vec<(f64, (Rgb, f64))> = largest.iter().filter_map(middle).collect();
        let area_m2: f64 = read.iter().map(|(area, _)| area).sum();
        if read.is_empty() {
            let (lx, error_lx) = self.read(known, MapReader::indirect_at)?;
            return Some((lx, error_lx, 1));
        }
        let lx = read.iter().map(|(area, (lx, _))| *lx * (area / area_m2)).sum();
        let error_lx = read.iter().map(|(area, (_, error))| error * (area / area_m2)).sum();
        Some((lx, error_lx, read.len() as u64))
    }

    /// The place for a point of the unit square, evenly over the area on the surface.
    fn place(&self, fragments: &[Fragment], area_m2: f64, [a, b]: [f64; 2]) -> Place {
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

    fn read(
        &self,
        place: Place,
        how: impl Fn(&MapReader<'a>, u32, bool, f64, f64) -> Option<(Rgb, f64)>,
    ) -> Option<(Rgb, f64)> {
        let side = &self.layout.sides[place.side as usize];
        let [u, v] = cover::weights(self.layout, place.side, place.at);
        how(&self.reader, side.triangle, side.back, u, v)
    }
}
