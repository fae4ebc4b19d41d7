//! Both sides of every seam are made to agree.
//!
//! The texels about seams are moved so that bilinear lookups along both sides of an edge give the same, by least
//! squares (Iwanicki 2013, "Lighting technology of The Last of Us", SIGGRAPH talks). Unlike there, every texel is held
//! to its value in proportion to its standard error, and known ones move by no more than twice that: what is well known
//! gives way least, and what was only filled in beside a chart gives way first, no further than to what is known about
//! the seam. Jumps that are left are no noise but the size of texels.

use super::edge::Seam;
use super::reach::{self, Reach};
use super::seam_report::{Jump, SeamReport};
use super::seams;
use super::solve::{Row, solve};
use super::texels::{Cover, Lightmap};
use crate::scene::Scene;
use crate::units::Rgb;
use isolux_geometry::Point;
use std::collections::HashMap;

/// Lookups compared for every texel along the longer side of a seam: bilinear values have kinks at every texel.
const A_TEXEL: f64 = 2.0;
/// Both sides are to agree within this share of the standard error there.
const AGREEMENT: f64 = 0.1;
/// Texels that are known better than this share of their value are held no harder, so that the system stays solvable.
const SUREST: f64 = 1e-3;
/// What was filled in beside a chart is held this loosely, a share of its value.
const FILLED: f64 = 1.0;
/// Times that texels are stopped there and the others solved for anew.
const PASSES: usize = 4;
/// A lookup counts if known texels have this weight in it on either side: beside narrow charts there may be none.
const KNOWN_WEIGHT: f64 = 0.25;

/// A lookup on either side of a seam.
struct Pair {
    place: Point,
    sides: [[(usize, f64); 4]; 2],
}

impl Pair {
    /// What either side shows, the photometric value.
    fn looked_up_lx(&self, lightmap: &Lightmap) -> [f64; 2] {
        self.sides.map(|side| {
            let light = |(t, w): (usize, f64)| Rgb(lightmap.shown_lx[t].map(f64::from)) * w;
            side.into_iter().map(light).sum::<Rgb>().luminance()
        })
    }

    fn jump_lx(&self, lightmap: &Lightmap) -> f64 {
        let [a, b] = self.looked_up_lx(lightmap);
        (a - b).abs()
    }

    /// Those that count.
    fn texels(&self) -> impl Iterator<Item = usize> {
        let all = self.sides.as_flattened().iter();
        all.filter(|(_, weight)| *weight > 0.0).map(|&(texel, _)| texel)
    }
}

/// Adjusts the texels about all seams.
pub(super) fn stitch(scene: &Scene, lightmap: &mut Lightmap) -> SeamReport {
    let (seams, whole) = seams::find(scene, &lightmap.layout);
    let pairs: Vec<Pair> = seams.iter().flat_map(|seam| lookups(lightmap, seam)).collect();
    let mut report = SeamReport {
        edges: seams.len(),
        t_junctions: seams.len() - whole,
        length_m: seams.iter().map(|s| (s.ends[1] - s.ends[0]).length()).sum(),
        before: jump(lightmap, &pairs),
        ..SeamReport::default()
    };
    if pairs.is_empty() {
        return report;
    }
    let (texels, rows) = system(lightmap, &pairs);
    let reaches = reaches(lightmap, &texels, &pairs);
    let mut changes = bounded(lightmap, (&texels, &reaches), rows);
    apply(lightmap, (&texels, &mut changes), (&pairs, report.before.largest_lx));
    reach::tell(&mut report, reaches.into_iter().zip(changes));
    report.after = jump(lightmap, &pairs);
    report
}

/// How far each texel may move.
fn reaches(lightmap: &Lightmap, texels: &[usize], pairs: &[Pair]) -> Vec<Reach> {
    let new = |&texel: &usize| (texel, Reach::new(lightmap, texel, give_lx(lightmap, texel)));
    let mut found: HashMap<usize, Reach> = texels.iter().map(new).collect();
    for pair in pairs {
        let (filled, known): (Vec<usize>, Vec<usize>) =
            pair.texels().partition(|&texel| lightmap.covers[texel] == Cover::Filled);
        for &texel in &filled {
            let Some(reach) = found.get_mut(&texel) else { continue };
            let own = lightmap.shown_lx[texel].map(f64::from);
            for &other in &known {
                let other = lightmap.shown_lx[other].map(f64::from);
                reach.admit([0, 1, 2].map(|c| other[c] - own[c]));
            }
        }
    }
    texels.iter().map(|texel| found[texel]).collect()
}

/// What texels change by. Those that would move too far are stopped on the way, and the others solved for anew.
fn bounded(
    lightmap: &Lightmap,
    (texels, reaches): (&[usize], &[Reach]),
    mut rows: Vec<Row>,
) -> Vec<[f64; 3]> {
    let give: Vec<f64> = texels.iter().map(|&texel| give_lx(lightmap, texel)).collect();
    let mut stopped: Vec<Option<[f64; 3]>> = vec![None; texels.len()];
    let mut changes = Vec::new();
    for _ in 0..PASSES {
        changes = solve(&rows, &give);
        let mut is_done = true;
        for k in 0..texels.len() {
            if let Some(at) = stopped[k] {
                changes[k] = at;
            } else if let Some(cut) = reaches[k].cut(changes[k]) {
                changes[k] = cut;
                stopped[k] = Some(cut);
                is_done = false;
            }
        }
        if is_done {
            break;
        }
        rows.iter_mut().for_each(|row| row.fix(&stopped));
    }
    changes
}

/// Moves texels, and those back that make any jump larger than the largest was: squares of jumps, each in its standard
/// errors, may grow less in sum while one of them grows.
fn apply(
    lightmap: &mut Lightmap,
    (texels, changes): (&[usize], &mut [[f64; 3]]),
    (pairs, largest_lx): (&[Pair], f64),
) {
    let before: Vec<[f32; 3]> = texels.iter().map(|&texel| lightmap.shown_lx[texel]).collect();
    for (&texel, change) in texels.iter().zip(changes.iter()) {
        for (shown, change) in lightmap.shown_lx[texel].iter_mut().zip(change) {
            *shown = (f64::from(*shown) + change).max(0.0) as f32;
        }
    }
    let numbers: HashMap<usize, usize> = texels.iter().enumerate().map(|(k, &t)| (t, k)).collect();
    loop {
        let grown: Vec<&Pair> =
            pairs.iter().filter(|pair| pair.jump_lx(lightmap) > largest_lx).collect();
        // Lookups of texels that are all back jump as they did: this ends.
        if grown.is_empty() {
            return;
        }
        for texel in grown.into_iter().flat_map(Pair::texels) {
            let number = numbers[&texel];
            lightmap.shown_lx[texel] = before[number];
            changes[number] = [0.0; 3];
        }
    }
}

fn lookups(lightmap: &Lightmap, seam: &Seam) -> Vec<Pair> {
    let length = |[p, q]: [[f64; 2]; 2]| libm::hypot(q[0] - p[0], q[1] - p[1]);
    let texels = length(seam.sides[0].1).max(length(seam.sides[1].1));
    let steps = (A_TEXEL * texels).ceil().max(1.0) as usize;
    let at = |k: usize| {
        let t = (k as f64 + 0.5) / steps as f64;
        let side = |(page, [p, q]): (u32, [[f64; 2]; 2])| {
            let place = [0, 1].map(|k| p[k] + t * (q[k] - p[k]));
            lightmap.layout.bilinear(page, place)
        };
        Pair { place: seam.ends[0].lerp(seam.ends[1], t), sides: seam.sides.map(side) }
    };
    let is_known = |pair: &Pair| {
        pair.sides.iter().all(|side| {
            let weight = |cover| -> f64 {
                let of = |&&(texel, _): &&(usize, f64)| lightmap.covers[texel] == cover;
                side.iter().filter(of).map(|(_, weight)| weight).sum()
            };
            weight(Cover::Known) >= KNOWN_WEIGHT
                && weight(Cover::Empty) + weight(Cover::Unknown) == 0.0
        })
    };
    (0..steps).map(at).filter(is_known).collect()
}

/// Standard error that a texel may give way by, lx.
fn give_lx(lightmap: &Lightmap, texel: usize) -> f64 {
    let value = Rgb(lightmap.shown_lx[texel].map(f64::from)).luminance().abs();
    let give = match lightmap.texel(texel) {
        // An error that is not known is as large as the value.
        Some(known) if known.standard_error_lx.is_infinite() => value,
        Some(known) => known.standard_error_lx.max(SUREST * value),
        None => FILLED * value,
    };
    // A black texel of a black surface is held, but not infinitely.
    give.max(1e-9)
}

/// Texels that lookups read, each once, and the differences to bring to nothing: weighted lookups over the error
/// that they may differ by.
fn system(lightmap: &Lightmap, pairs: &[Pair]) -> (Vec<usize>, Vec<Row>) {
    let mut texels: Vec<usize> = Vec::new();
    let mut numbers: HashMap<usize, u32> = HashMap::new();
    let mut rows = Vec::with_capacity(pairs.len());
    for pair in pairs {
        let mut known: Vec<f64> = Vec::with_capacity(8);
        let mut row = Row { parts: [(0, 0.0); 8], goal: [0.0; 3] };
        let both = pair.sides[0].into_iter().chain(pair.sides[1].map(|(t, w)| (t, -w)));
        for (part, (texel, weight)) in row.parts.iter_mut().zip(both) {
            let number = *numbers.entry(texel).or_insert_with(|| {
                texels.push(texel);
                texels.len() as u32 - 1
            });
            *part = (number, weight);
            known.extend(lightmap.texel(texel).map(|_| give_lx(lightmap, texel)));
            for (goal, value) in row.goal.iter_mut().zip(lightmap.shown_lx[texel]) {
                *goal -= weight * f64::from(value);
            }
        }
        let give = match known.len() {
            0 => 1.0,
            n => known.iter().sum::<f64>() / n as f64,
        };
        row.scale(1.0 / (AGREEMENT * give));
        rows.push(row);
    }
    (texels, rows)
}

fn jump(lightmap: &Lightmap, pairs: &[Pair]) -> Jump {
    let mut found = Jump::default();
    let mut squared = 0.0;
    for pair in pairs {
        let [a, b] = pair.looked_up_lx(lightmap);
        let jump_lx = pair.jump_lx(lightmap);
        squared += jump_lx * jump_lx;
        if jump_lx > found.largest_lx {
            let mean = 0.5 * (a + b);
            found.largest_lx = jump_lx;
            found.largest_share = if mean > 0.0 { jump_lx / mean } else { 0.0 };
            found.place = Some(pair.place);
        }
    }
    found.rms_lx = (squared / pairs.len().max(1) as f64).sqrt();
    found
}
