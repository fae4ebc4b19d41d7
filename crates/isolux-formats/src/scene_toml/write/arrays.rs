//! Luminaires in rows, written as one entry.

use super::numbers::shortest;
use isolux::geometry::{Point, Vector};
use isolux::scene::{Fitting, Luminaire, LuminaireKind};

/// Luminaires that differ in position and number only.
pub(super) struct Run<'a> {
    /// Name without the numbers.
    pub(super) name: &'a str,
    pub(super) first: &'a Luminaire,
    /// Counts and steps (m) along the axes, where there is more than one.
    pub(super) array: Option<([u32; 3], [f64; 3])>,
}

/// The luminaires from the first on that one entry can say, with the same known of each, and how many they are.
pub(super) fn next_run<'a>(
    luminaires: &'a [Luminaire],
    fittings: &[Fitting],
) -> Option<(Run<'a>, usize)> {
    let first = luminaires.first()?;
    let alone = (Run { name: &first.name, first, array: None }, 1);
    let Some((name, [0, 0, 0])) = numbered(&first.name) else { return Some(alone) };
    let named = |l: &&Luminaire| numbered(&l.name).is_some_and(|(base, _)| base == name);
    let length = luminaires.iter().take_while(named).count();
    let run = &luminaires[..length];
    let fitting = |k: usize| fittings.get(k).copied().unwrap_or_default();
    let are_alike = (0..length).all(|k| fitting(k) == fitting(0));
    let counts =
        run.last().and_then(|last| numbered(&last.name)).map(|(_, ijk)| ijk.map(|k| k + 1));
    let array =
        counts.filter(|_| are_alike).and_then(|counts| Some((counts, steps_m(run, counts)?)));
    Some(match array {
        Some(array) => (Run { name, first, array: Some(array) }, length),
        None => alone,
    })
}

/// `name[1,2,3]` in its parts.
fn numbered(name: &str) -> Option<(&str, [u32; 3])> {
    let (base, numbers) = name.strip_suffix(']')?.rsplit_once('[')?;
    let mut words = numbers.split(',').map(|word| word.parse().ok());
    let triple = [words.next()??, words.next()??, words.next()??];
    words.next().is_none().then_some((base, triple))
}

fn position(luminaire: &Luminaire) -> Option<Point> {
    match luminaire.kind {
        LuminaireKind::Point { position, .. } => Some(position),
        LuminaireKind::Directional { .. } | LuminaireKind::Sky { .. } => None,
    }
}

/// The steps with which an array is these luminaires, bit by bit.
fn steps_m(run: &[Luminaire], counts: [u32; 3]) -> Option<[f64; 3]> {
    let total = counts.iter().try_fold(1_usize, |n, &k| n.checked_mul(k as usize))?;
    if total != run.len() || !run.iter().all(|l| is_like(l, &run[0])) {
        return None;
    }
    let first = position(&run[0])?;
    let mut steps = [0.0; 3];
    let mut stride = 1;
    for axis in 0..3 {
        if counts[axis] > 1 {
            let last = position(run.get(stride * (counts[axis] as usize - 1))?)?;
            let way = (last - first).component(axis) / f64::from(counts[axis] - 1);
            let next = position(run.get(stride)?)?.to_vector().component(axis);
            let from = first.to_vector().component(axis);
            steps[axis] = shortest(way, |step| from + step == next);
        }
        stride *= counts[axis] as usize;
    }
    is_array(run, counts, steps).then_some(steps)
}

fn is_like(luminaire: &Luminaire, first: &Luminaire) -> bool {
    let LuminaireKind::Point { world_from_luminaire, intensity, area, .. } = &luminaire.kind else {
        return false;
    };
    let LuminaireKind::Point { world_from_luminaire: turn, intensity: same, .. } = &first.kind
    else {
        return false;
    };
    luminaire.group == first.group
        && luminaire.colour == first.colour
        && world_from_luminaire == turn
        && intensity == same
        && area.as_ref() == first.kind.area()
}

fn is_array(run: &[Luminaire], [nx, ny, nz]: [u32; 3], steps: [f64; 3]) -> bool {
    let Some(first) = position(&run[0]) else { return false };
    let cells = (0..nz).flat_map(|k| (0..ny).flat_map(move |j| (0..nx).map(move |i| [i, j, k])));
    run.iter().zip(cells).all(|(luminaire, cell)| {
        let [x, y, z] = cell.map(f64::from);
        let shift = Vector::new(x * steps[0], y * steps[1], z * steps[2]);
        numbered(&luminaire.name).is_some_and(|(_, numbers)| numbers == cell)
            && position(luminaire) == Some(first + shift)
    })
}
