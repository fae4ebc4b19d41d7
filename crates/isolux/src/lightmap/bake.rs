//! From a map to the values of texels.

use super::cover::{self, Fragment};
use super::ground::Ground;
use super::layout::Layout;
use super::places::{Places, Survey};
use super::plan::LightmapError;
use super::seam_report::SeamReport;
use super::shadow::{self, Direct};
use super::texels::{Cover, Lightmap, UNKNOWN_ERROR};
use super::work::{After, Pace, Work};
use super::{dilate, stitch};
use crate::engine::net::{Fineness, Net, Wanted};
use crate::engine::{IndirectReading, MapReader};
use crate::map::IlluminationMap;
use crate::scene::Scene;
use crate::units::Rgb;
use std::time::Instant;

/// Direct light is to err by no more than this share of the error of indirect light, or this share of itself.
const OF_INDIRECT: f64 = 0.5;
const OF_VALUE: f64 = 0.002;
/// Texels by which the time of gathering is foreseen.
const TRIED: usize = 32;

/// Reads the map over the part of the surface that each texel covers: direct light at places spread evenly over it,
/// indirect light, too, where the map does not tell it, each as [`MapReader`] has it. Then fills the borders of charts and makes the two
/// sides of seams agree. `watch` is told the share of the work that is done, as far as it can be foreseen, nothing where it cannot, and
/// says how to go on: coarsely, what is left is read as the map interpolates it, and by the fewest shadow rays, which standard errors tell;
/// late, without any.
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
    let surveyed = survey(&places, &ground, &mut work)?;
    let looks = look(&places, (&ground, &surveyed), &mut work)?;
    let closely_s = foresee_closely(&surveyed.told, &looks);
    let indirect = indirect(&places, (&ground, surveyed, &mut coarse), (closely_s, &mut work))?;
    let direct = direct(&places, (&ground, &indirect, &mut coarse), (looks, &mut work))?;
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

/// What is known of the indirect light of texels before any of it is gathered.
struct Surveyed<'a> {
    /// Of each texel, as the map tells it.
    told: Vec<Option<IndirectReading>>,
    /// Those to be gathered at.
    net: Net<'a>,
    /// Those that there was no time to ask the map about.
    unread: Vec<usize>,
    /// The time that gathering will take, s.
    gathering_s: f64,
}

/// First looks at the direct light of texels.
struct Looks {
    found: Vec<Option<Direct>>,
    /// Texels from this one on were looked at coarsely.
    coarse_from: usize,
    /// The number of texels that got shadow rays then; the others after them got none.
    glances: usize,
    /// The time that a look takes, s.
    a_look_s: f64,
}

/// Asks the map about all texels.
fn survey<'a>(
    places: &'a Places<'_>,
    ground: &Ground<'_>,
    work: &mut Work<'_>,
) -> Result<Surveyed<'a>, LightmapError> {
    let all = &ground.texels;
    let surveys = work.each(all, After::UNFORESEEN, |fragments| places.survey(fragments))?;
    let charts = ground.charts();
    let mut told = vec![None; all.len()];
    let mut standing = vec![None; all.len()];
    let (mut wanted, mut numbers) = (Vec::new(), Vec::new());
    let unread = (surveys.len()..all.len()).collect();
    for (number, (survey, asked)) in surveys.into_iter().enumerate() {
        work.readings += asked;
        match survey {
            Survey::Unknown => {}
            Survey::Told(reading) => told[number] = Some(reading),
            Survey::Wanted(setting, place) => {
                standing[number] = Some(place);
                let (at, chart) = (ground.place(number), u64::from(charts[number]));
                wanted.push(Wanted { number, at, kind: chart << 2 | setting as u64 });
                numbers.push(number);
            }
        }
    }
    let sight = move |from: usize, to: usize| match (standing[from], standing[to]) {
        (Some(from), Some(to)) => places.sees(from, to),
        _ => false,
    };
    let net = Net::new(wanted, Fineness::TEXELS, Box::new(sight));
    let all_s = work.foresee((&numbers, TRIED), |&number| {
        places.gathered(all[number]);
    })?;
    let gathering_s = all_s * net.foreseen() / numbers.len().max(1) as f64;
    Ok(Surveyed { told, net, unread, gathering_s })
}

/// Looks at all texels of which the map may know anything. This comes before light is gathered: where time runs out in that, all
/// texels have their shadows.
fn look(
    places: &Places<'_>,
    (ground, surveyed): (&Ground<'_>, &Surveyed<'_>),
    work: &mut Work<'_>,
) -> Result<Looks, LightmapError> {
    let started = Instant::now();
    let mut is_asked: Vec<bool> = surveyed.told.iter().map(Option::is_some).collect();
    surveyed.net.filled().for_each(|wanted| is_asked[wanted.number] = true);
    surveyed.unread.iter().for_each(|&number| is_asked[number] = true);
    let numbers: Vec<usize> = (0..is_asked.len()).filter(|&number| is_asked[number]).collect();
    // As a rule one in four texels is looked at closely, with eight times the places.
    let after = After { pieces: 2.0 * numbers.len() as f64, other_s: surveyed.gathering_s };
    let texel = |number: usize| ground.texels[number];
    let looks = work.each(&numbers, after, |&number| shadow::look(places, texel(number)))?;
    let a_look_s = started.elapsed().as_secs_f64() / looks.len().max(1) as f64;
    let unseen = &numbers[looks.len()..];
    let coarse_from = unseen.first().map_or(ground.texels.len(), |&first| first);
    let glances = work.each_unless_late(unseen, |&number| shadow::glance(places, texel(number)))?;
    let (glances, glanced) = (glances.len(), glances);
    let rest = &unseen[glances..];
    let told = work.each_coarsely(rest, |&number| shadow::told(places, texel(number)))?;
    let mut found = vec![None; ground.texels.len()];
    let all = looks.into_iter().chain(glanced).chain(told);
    numbers.iter().zip(all).for_each(|(&number, look)| found[number] = look);
    Ok(Looks { found, coarse_from, glances, a_look_s })
}

/// Indirect light of all texels: as the map tells it, or gathered on a net; where time runs out as the map interpolates it.
fn indirect(
    places: &Places<'_>,
    (ground, surveyed, coarse): (&Ground<'_>, Surveyed<'_>, &mut [bool]),
    (closely_s, work): (f64, &mut Work<'_>),
) -> Result<Vec<Option<IndirectReading>>, LightmapError> {
    let all = &ground.texels;
    let Surveyed { told: mut found, mut net, mut unread, .. } = surveyed;
    net.fill(|numbers, more| {
        let after = After { pieces: more, other_s: closely_s };
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
        (found[number], coarse[number]) = (reading, true);
    }
    Ok(found)
}

/// What direct light may err by.
fn goal_lx(indirect_error_lx: f64, value_lx: f64) -> f64 {
    (OF_INDIRECT * indirect_error_lx).max(OF_VALUE * value_lx)
}

/// The time of looking closely, s; where indirect light is not known yet, it is taken to err as it does elsewhere.
fn foresee_closely(told: &[Option<IndirectReading>], looks: &Looks) -> f64 {
    let errors = || told.iter().flatten().map(|reading| reading.error_lx);
    let usual_lx = errors().sum::<f64>() / errors().count().max(1) as f64;
    let places = looks.found.iter().zip(told).filter_map(|(direct, told)| {
        let direct = (*direct)?;
        let error_lx = told.map_or(usual_lx, |reading| reading.error_lx);
        shadow::needed(direct.variance, goal_lx(error_lx, direct.lx.luminance()))
    });
    looks.a_look_s * places.map(f64::from).sum::<f64>() / f64::from(shadow::FEW)
}

/// Direct light of the texels whose indirect light is known.
fn direct(
    places: &Places<'_>,
    (ground, indirect, coarse): (&Ground<'_>, &[Option<IndirectReading>], &mut [bool]),
    (looks, work): (Looks, &mut Work<'_>),
) -> Result<Vec<Option<Direct>>, LightmapError> {
    let Looks { mut found, coarse_from, glances, .. } = looks;
    let numbers: Vec<usize> =
        (0..ground.texels.len()).filter(|&number| indirect[number].is_some()).collect();
    found
        .iter_mut()
        .zip(indirect)
        .for_each(|(found, indirect)| *found = found.filter(|_| indirect.is_some()));
    let (looked, glanced) =
        numbers.split_at(numbers.partition_point(|&number| number < coarse_from));
    work.readings += u64::from(shadow::FEW) * looked.len() as u64;
    work.readings += u64::from(shadow::FEWEST) * glanced.len().min(glances) as u64;
    glanced.iter().for_each(|&number| coarse[number] = true);
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
        shadow::look_closely(places, ground.texels[number], count)
    })?;
    close[seen.len()..].iter().for_each(|&(number, _)| coarse[number] = true);
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
    if !lx.iter().all(|c| (*c as f32).is_finite()) {
        return false;
    }
    let share = fragments.iter().map(|f| f64::from(f.share)).sum::<f64>().min(1.0);
    into.covers[texel] = Cover::Known;
    into.shown_lx[texel] = lx.map(|c| c as f32);
    into.standard_errors_lx[texel] = (error_lx as f32).min(UNKNOWN_ERROR);
    into.coverage[texel] = (share * direct.known) as f32;
    true
}
