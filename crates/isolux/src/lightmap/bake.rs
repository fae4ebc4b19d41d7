//! From a map to the values of texels.

use super::cover::{self, Fragment};
use super::ground::Ground;
use super::layout::Layout;
use super::places::{Places, Survey};
use super::plan::LightmapError;
use super::seam_report::SeamReport;
use super::shadow::{self, Direct};
use super::texels::{Cover, Lightmap};
use super::work::{After, Pace, Work};
use super::{dilate, stitch};
use crate::engine::net::{Fineness, Net, Wanted};
use crate::engine::{IndirectReading, MapReader};
use crate::map::IlluminationMap;
use crate::scene::Scene;
use crate::units::Rgb;

/// Direct light is to err by no more than this share of the error of indirect light, or this share of itself.
const OF_INDIRECT: f64 = 0.5;
const OF_VALUE: f64 = 0.002;
/// Texels by which the time of direct light is foreseen.
const TRIED: usize = 128;

/// Reads the map over the part of the surface that each texel covers: direct light at places spread evenly over it,
/// indirect light, too, where the map does not tell it, each as [`MapReader`] has it. Then fills the borders of charts and makes the two
/// sides of seams agree. `watch` is told the share of the work that is done, as far as it can be foreseen, nothing where it cannot, and
/// says how to go on: coarsely, what is left is read as the map interpolates it, and by the fewest shadow rays, which standard errors tell.
pub fn bake(
    scene: &Scene,
    map: &IlluminationMap,
    layout: &Layout,
    watch: &mut dyn FnMut(f64) -> Pace,
) -> Result<Lightmap, LightmapError> {
    let fragments = cover::fragments(scene, layout);
    let ground = Ground::of(layout, &fragments);
    let places = Places { reader: MapReader::new(scene, map), layout, seed: map.provenance.seed };
    let mut baked = empty(layout);
    let mut work = Work::new(watch);
    let mut coarse = vec![false; ground.texels.len()];
    let indirect = indirect(&places, (&ground, &mut coarse), &mut work)?;
    let direct = direct(&places, (&ground, &indirect, &mut coarse), &mut work)?;
    let read = indirect.into_iter().zip(direct).zip(coarse);
    for (fragments, ((indirect, direct), coarse)) in ground.texels.iter().zip(read) {
        let is_known = store(fragments, indirect.zip(direct), &mut baked);
        baked.coarse += u64::from(is_known && coarse);
    }
    baked.readings = work.readings;
    drop(ground);
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
        coarse: 0,
    }
}

/// Indirect light of all texels: as the map tells it, or gathered on a net; where time runs out as the map interpolates it.
fn indirect(
    places: &Places<'_>,
    (ground, coarse): (&Ground<'_>, &mut [bool]),
    work: &mut Work<'_>,
) -> Result<Vec<Option<IndirectReading>>, LightmapError> {
    let all = &ground.texels;
    let surveys = work.each(all, After::UNFORESEEN, |fragments| places.survey(fragments))?;
    let charts = ground.charts();
    let mut found = vec![None; all.len()];
    let mut wanted = Vec::new();
    let mut unread: Vec<usize> = (surveys.len()..all.len()).collect();
    for (number, (survey, asked)) in surveys.into_iter().enumerate() {
        work.readings += asked;
        match survey {
            Survey::Unknown => {}
            Survey::Told(reading) => found[number] = Some(reading),
            Survey::Wanted(setting) => {
                let (at, chart) = (ground.place(number), u64::from(charts[number]));
                wanted.push(Wanted { number, at, kind: chart << 2 | setting as u64 });
            }
        }
    }
    let direct_s = if work.is_coarse { 0.0 } else { foresee_direct(places, (ground, &found), work)? };
    let mut net = Net::new(wanted, Fineness::TEXELS);
    net.fill(|numbers, more| {
        let after = After { pieces: more, other_s: direct_s };
        let gathered = work.each(numbers, after, |&number| places.gathered(all[number]))?;
        work.readings += gathered.len() as u64;
        Ok(gathered)
    })?;
    for filled in net.filled() {
        found[filled.number] = filled.reading;
        coarse[filled.number] = net.is_cut_short() && !filled.is_gathered;
        if coarse[filled.number] && filled.reading.is_none() {
            unread.push(filled.number);
        }
    }
    let read = work.each_coarsely(&unread, |&number| places.interpolated(all[number]))?;
    work.readings += unread.len() as u64;
    for (number, reading) in unread.into_iter().zip(read) {
        (found[number], coarse[number]) = (reading, reading.is_some());
    }
    Ok(found)
}

/// The time that direct light will take, s, by a few texels; where indirect light is not known yet, it is taken to err
/// as it does elsewhere.
fn foresee_direct(
    places: &Places<'_>,
    (ground, found): (&Ground<'_>, &[Option<IndirectReading>]),
    work: &mut Work<'_>,
) -> Result<f64, LightmapError> {
    let errors = || found.iter().flatten().map(|reading| reading.error_lx);
    let usual_lx = errors().sum::<f64>() / errors().count().max(1) as f64;
    let numbers: Vec<usize> = (0..ground.texels.len()).collect();
    work.foresee((&numbers, TRIED), |&number| {
        let fragments = ground.texels[number];
        let error_lx = found[number].map_or(usual_lx, |reading| reading.error_lx);
        let needed = shadow::look(places, fragments).and_then(|direct| {
            let goal_lx = goal_lx(error_lx, direct.lx.luminance());
            shadow::needed(direct.variance, goal_lx)
        });
        if let Some(count) = needed {
            shadow::look_closely(places, fragments, count);
        }
    })
}

/// What direct light may err by.
fn goal_lx(indirect_error_lx: f64, value_lx: f64) -> f64 {
    (OF_INDIRECT * indirect_error_lx).max(OF_VALUE * value_lx)
}

/// Direct light of the texels whose indirect light is known.
fn direct(
    places: &Places<'_>,
    (ground, indirect, coarse): (&Ground<'_>, &[Option<IndirectReading>], &mut [bool]),
    work: &mut Work<'_>,
) -> Result<Vec<Option<Direct>>, LightmapError> {
    let numbers: Vec<usize> =
        (0..ground.texels.len()).filter(|&number| indirect[number].is_some()).collect();
    let texel = |number: usize| ground.texels[number];
    let mut found = looks(places, (ground, &numbers, &mut *coarse), work)?;
    let about: Vec<f64> =
        (0..found.len()).map(|number| variance_about(ground, &found, number)).collect();
    for (direct, about) in found.iter_mut().zip(&about) {
        // A few places may agree by chance: they are as uncertain as those around them.
        *direct = direct.map(|direct| Direct { variance: *about, ..direct });
    }
    let closely = |number: usize| {
        let (direct, indirect) = (found[number]?, indirect[number]?);
        let goal_lx = goal_lx(indirect.error_lx, (direct.lx + indirect.lx).luminance());
        Some((number, shadow::needed(direct.variance, goal_lx)?))
    };
    let close: Vec<(usize, u32)> = numbers.into_iter().filter_map(closely).collect();
    let seen = work.each(&close, After::default(), |&(number, count)| {
        shadow::look_closely(places, texel(number), count)
    })?;
    close[seen.len()..].iter().for_each(|&(number, _)| coarse[number] = true);
    for ((number, count), seen) in close.into_iter().zip(seen) {
        work.readings += u64::from(count);
        found[number] = seen.or(found[number]);
    }
    Ok(found)
}

/// First looks at texels.
fn looks(
    places: &Places<'_>,
    (ground, numbers, coarse): (&Ground<'_>, &[usize], &mut [bool]),
    work: &mut Work<'_>,
) -> Result<Vec<Option<Direct>>, LightmapError> {
    let mut found = vec![None; ground.texels.len()];
    // As a rule one in four texels is looked at closely, with eight times the places.
    let after = After { pieces: 2.0 * numbers.len() as f64, other_s: 0.0 };
    let texel = |number: usize| ground.texels[number];
    let looks = work.each(numbers, after, |&number| shadow::look(places, texel(number)))?;
    let (seen, unseen) = numbers.split_at(looks.len());
    let glances = work.each_coarsely(unseen, |&number| shadow::glance(places, texel(number)))?;
    work.readings += u64::from(shadow::FEW) * seen.len() as u64;
    work.readings += u64::from(shadow::FEWEST) * unseen.len() as u64;
    unseen.iter().for_each(|&number| coarse[number] = true);
    numbers.iter().zip(looks.into_iter().chain(glances)).for_each(|(&number, look)| found[number] = look);
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

/// Puts a texel where it lies; whether its value is known.
fn store(
    fragments: &[Fragment],
    known: Option<(IndirectReading, Direct)>,
    into: &mut Lightmap,
) -> bool {
    let texel = fragments[0].texel as usize;
    let largest = fragments.iter().max_by(|a, b| a.share.total_cmp(&b.share));
    into.owners[texel] = largest.map_or(0, |fragment| fragment.side);
    into.covers[texel] = Cover::Unknown;
    let Some((indirect, direct)) = known else { return false };
    let Rgb(lx) = direct.lx + indirect.lx;
    let error_lx = (indirect.error_lx * indirect.error_lx + direct.variance).sqrt();
    if !lx.iter().chain([&error_lx]).all(|c| (*c as f32).is_finite()) {
        return false;
    }
    let share = fragments.iter().map(|f| f64::from(f.share)).sum::<f64>().min(1.0);
    into.covers[texel] = Cover::Known;
    into.shown_lx[texel] = lx.map(|c| c as f32);
    into.standard_errors_lx[texel] = error_lx as f32;
    into.coverage[texel] = (share * direct.known) as f32;
    true
}
