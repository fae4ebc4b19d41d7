//! From a map to the values of texels.

use super::cover::{self, Fragment};
use super::ground::Ground;
use super::layout::Layout;
use super::net::{Light, Net, Step, Wanted};
use super::places::{Places, Survey};
use super::plan::LightmapError;
use super::seam_report::SeamReport;
use super::shadow::{self, Direct};
use super::texels::{Cover, Lightmap};
use super::{dilate, stitch};
use crate::engine::{IndirectReading, MapReader, Watch};
use crate::map::IlluminationMap;
use crate::scene::Scene;
use crate::units::Rgb;
use rayon::prelude::*;

/// Direct light is to err by no more than this share of the error of indirect light, or this share of itself.
const OF_INDIRECT: f64 = 0.5;
const OF_VALUE: f64 = 0.002;
/// Pieces of work between two looks at whether to go on.
const BLOCK: usize = 1024;

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
    let ground = Ground::of(layout, &fragments);
    let places = Places { reader: MapReader::new(scene, map), layout, seed: map.provenance.seed };
    let mut baked = empty(layout);
    let mut work = Work { watch, readings: 0 };
    let indirect = indirect(&places, &ground, &mut work)?;
    let direct = direct(&places, (&ground, &indirect), &mut work)?;
    for ((fragments, indirect), direct) in ground.texels.iter().zip(indirect).zip(direct) {
        store(fragments, indirect.zip(direct), &mut baked);
    }
    baked.readings = work.readings;
    drop(ground);
    drop(fragments);
    dilate::fill(&mut baked);
    baked.seams = stitch::stitch(scene, &mut baked);
    Ok(baked)
}

/// Work done so far, and whoever watches it.
struct Work<'a> {
    watch: &'a mut dyn FnMut(f64) -> Watch,
    readings: u64,
}

impl Work<'_> {
    /// Does something to each of many, on all threads; results are in their order.
    fn each<T: Sync, R: Send>(
        &mut self,
        all: &[T],
        one: impl Fn(&T) -> R + Sync,
    ) -> Result<Vec<R>, LightmapError> {
        let mut done = Vec::with_capacity(all.len());
        for block in all.chunks(BLOCK) {
            if (self.watch)(done.len() as f64 / all.len() as f64) == Watch::Stop {
                return Err(LightmapError::Stopped);
            }
            done.par_extend(block.par_iter().map(&one));
        }
        Ok(done)
    }
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

/// Indirect light of all texels: as the map tells it, or gathered on a net.
fn indirect(
    places: &Places<'_>,
    ground: &Ground<'_>,
    work: &mut Work<'_>,
) -> Result<Vec<Option<IndirectReading>>, LightmapError> {
    let surveys = work.each(&ground.texels, |fragments| places.survey(fragments))?;
    let charts = ground.charts();
    let mut found = vec![None; ground.texels.len()];
    let mut wanted = Vec::new();
    for (number, (survey, asked)) in surveys.into_iter().enumerate() {
        work.readings += asked;
        match survey {
            Survey::Unknown => {}
            Survey::Told(reading) => found[number] = Some(reading),
            Survey::Wanted { place, in_gap } => {
                let (at, kind) = (ground.place(number), (charts[number], in_gap));
                wanted.push(Wanted { number, at, kind, place });
            }
        }
    }
    let mut net = Net::new(wanted);
    for step in Step::ALL {
        let chosen = net.chosen(step);
        gather(places, &mut net, &chosen, work)?;
    }
    let left = net.left();
    gather(places, &mut net, &left, work)?;
    net.finish();
    for (wanted, light) in net.wanted.iter().zip(&net.light) {
        if let Light::Gathered(reading, _) | Light::Continued(reading) = light {
            found[wanted.number] = Some(*reading);
        }
    }
    Ok(found)
}

fn gather(
    places: &Places<'_>,
    net: &mut Net,
    chosen: &[usize],
    work: &mut Work<'_>,
) -> Result<(), LightmapError> {
    let gathered = work.each(chosen, |&k| places.gathered(net.wanted[k].place))?;
    work.readings += chosen.len() as u64;
    net.store(chosen, &gathered);
    Ok(())
}

/// Direct light of the texels whose indirect light is known.
fn direct(
    places: &Places<'_>,
    (ground, indirect): (&Ground<'_>, &[Option<IndirectReading>]),
    work: &mut Work<'_>,
) -> Result<Vec<Option<Direct>>, LightmapError> {
    let numbers: Vec<usize> = (0..ground.texels.len()).collect();
    let look = |&number: &usize| {
        indirect[number].and_then(|_| shadow::look(places, ground.texels[number]))
    };
    let mut found = work.each(&numbers, look)?;
    work.readings += u64::from(shadow::FEW) * numbers.len() as u64;
    let close: Vec<(usize, u32)> = numbers
        .into_iter()
        .filter_map(|number| {
            let (direct, indirect) = (found[number]?, indirect[number]?);
            let value = (direct.lx + indirect.lx).luminance();
            let goal_lx = (OF_INDIRECT * indirect.error_lx).max(OF_VALUE * value);
            Some((number, shadow::needed(variance_about(ground, &found, number), goal_lx)?))
        })
        .collect();
    let closely = |&(number, count): &(usize, u32)| {
        shadow::look_closely(places, ground.texels[number], count)
    };
    let seen = work.each(&close, closely)?;
    for ((number, count), seen) in close.into_iter().zip(seen) {
        work.readings += u64::from(count);
        found[number] = seen.or(found[number]);
    }
    Ok(found)
}

/// How much places differ in a texel, or in the mean over those around it, whichever is more: a few may agree by
/// chance where a shadow ends.
fn variance_about(ground: &Ground<'_>, found: &[Option<Direct>], number: usize) -> f64 {
    let own = found[number].map_or(0.0, |direct| direct.variance);
    let (mut sum, mut count) = (own, 1.0);
    for direct in ground.around(number).filter_map(|other| found[other]) {
        sum += direct.variance;
        count += 1.0;
    }
    own.max(sum / count)
}

fn store(fragments: &[Fragment], known: Option<(IndirectReading, Direct)>, into: &mut Lightmap) {
    let texel = fragments[0].texel as usize;
    let largest = fragments.iter().max_by(|a, b| a.share.total_cmp(&b.share));
    into.owners[texel] = largest.map_or(0, |fragment| fragment.side);
    into.covers[texel] = Cover::Unknown;
    let Some((indirect, direct)) = known else { return };
    let Rgb(lx) = direct.lx + indirect.lx;
    let error_lx = (indirect.error_lx * indirect.error_lx + direct.variance).sqrt();
    if !lx.iter().chain([&error_lx]).all(|c| (*c as f32).is_finite()) {
        return;
    }
    let share = fragments.iter().map(|f| f64::from(f.share)).sum::<f64>().min(1.0);
    into.covers[texel] = Cover::Known;
    into.shown_lx[texel] = lx.map(|c| c as f32);
    into.standard_errors_lx[texel] = error_lx as f32;
    into.coverage[texel] = (share * direct.known) as f32;
}
