//! Where the luminaires hang: downlights over nave and aisles, lines of batwings under their profiles
//! over the desks, washers along the walls and around the columns.

use super::lamps::lamps;
use super::room::{BEAM_BOTTOM_M, HALF_BEAM_M, PROFILE_BOTTOM_M, PROFILES, column_x_m};
use super::size::{COLUMNS, HEIGHT_M, LENGTH_M, ROWS_M, WIDTH_M};
use isolux::geometry::{Direction, Point, Vector};
use isolux::photometry::IntensityDistribution;
use isolux::scene::{Luminaire, LuminaireKind, UpAxis, world_from_luminaire};
use isolux::units::{Rgb, sincos_deg};

/// Light groups.
pub(super) const GROUPS: [&str; 3] = ["downlights", "desks", "walls"];
/// Shares of the full flux at which the standard hall has 300 to 800 lx on its desks.
const DIMMING: [f64; 3] = [0.06, 0.12, 0.15];
const DOWNLIGHT: usize = 0;
const BATWING: usize = 1;
const WASHER: usize = 2;
/// Below the ceiling, the profile or the beams, m.
const CLEARANCE_M: f64 = 0.01;
/// From the wall to its washers, and from the axis of a column to its ring of washers, m.
const WALL_M: f64 = 0.5;
const RING_M: f64 = 0.8;
/// Between a cross beam and the first luminaires of a bay, m.
const BESIDE_BEAM_M: f64 = 0.08;

/// A place for luminaires of one type, and how many of them the standard hall has there.
struct Zone {
    name: String,
    lamp: usize,
    standard: u32,
    layout: Layout,
}

enum Layout {
    /// Rows along x of luminaires with C0 along x, at the middles of equal parts of a rectangle.
    Rows { low_m: [f64; 2], high_m: [f64; 2], rows: u32, z_m: f64 },
    /// A line from one end to the other, C0 in a direction.
    Line { from_m: [f64; 2], to_m: [f64; 2], c0_deg: f64, z_m: f64 },
    /// A circle, C0 towards its centre.
    Ring { centre_m: [f64; 2], radius_m: f64, z_m: f64 },
}

/// So many luminaires, each type with the same total flux as in the standard hall.
pub(super) fn luminaires(count: u32) -> Vec<Luminaire> {
    let zones = zones();
    let counts = apportion(&zones.iter().map(|z| z.standard).collect::<Vec<_>>(), count);
    let of_type = |lamp: usize, counts: &mut dyn Iterator<Item = u32>| -> u32 {
        zones.iter().zip(counts).filter(|(zone, _)| zone.lamp == lamp).map(|(_, n)| n).sum()
    };
    let mut made = Vec::with_capacity(count as usize);
    let intensities: Vec<IntensityDistribution> = lamps()
        .iter()
        .enumerate()
        .map(|(lamp, file)| {
            let standard = of_type(lamp, &mut zones.iter().map(|z| z.standard));
            let here = of_type(lamp, &mut counts.iter().copied());
            let dimming = DIMMING[lamp] * f64::from(standard) / f64::from(here);
            file.distribution().scaled(rounded(dimming, 1e9))
        })
        .collect();
    for (zone, n) in zones.iter().zip(counts) {
        for (suffix, position, c0_deg) in zone.layout.places(n) {
            made.push(Luminaire {
                name: format!("{}{suffix}", zone.name),
                group: zone.lamp as u32,
                colour: Rgb::WHITE,
                kind: LuminaireKind::Point {
                    position,
                    world_from_luminaire: world_from_luminaire(UpAxis::Z, -Direction::Z, c0_deg),
                    intensity: intensities[zone.lamp].clone(),
                    area: None,
                },
            });
        }
    }
    made
}

/// A number as a file of the scene would give it.
fn rounded(x: f64, per_unit: f64) -> f64 {
    (x * per_unit).round() / per_unit
}

fn micrometre(x_m: f64) -> f64 {
    rounded(x_m, 1e6)
}

fn zones() -> Vec<Zone> {
    let mut zones = Vec::new();
    for bay in 0..=COLUMNS {
        zones.extend(bay_zones(bay));
    }
    zones.extend(wall_zones());
    for (row, y) in ROWS_M.into_iter().enumerate() {
        zones.extend((0..COLUMNS).map(|k| Zone {
            name: format!("column {} {}", row + 1, k + 1),
            lamp: WASHER,
            standard: 12,
            layout: Layout::Ring {
                centre_m: [column_x_m(k), y],
                radius_m: RING_M,
                z_m: micrometre(BEAM_BOTTOM_M[0] - 5.0 * CLEARANCE_M),
            },
        }));
    }
    zones
}

/// The ends of a bay along the hall, between cross beams or walls, m.
fn bay_ends_m(bay: u32) -> [f64; 2] {
    let beside_m = HALF_BEAM_M[1] + BESIDE_BEAM_M;
    let from = if bay == 0 { 0.2 } else { column_x_m(bay - 1) + beside_m };
    let to = if bay == COLUMNS { LENGTH_M - 0.2 } else { column_x_m(bay) - beside_m };
    [from, to]
}

fn bay_zones(bay: u32) -> [Zone; 5] {
    let [from, to] = bay_ends_m(bay);
    let is_half = bay == 0 || bay == COLUMNS;
    let per_row = |full: u32| if is_half { full / 2 } else { full };
    let (first_m, step_m, lines) = PROFILES;
    let ceiling_m = micrometre(HEIGHT_M - CLEARANCE_M);
    // A strip of the south aisle whose rows begin at a distance from the wall, and its image.
    let aisle = |first_row_m: f64, is_north: bool| {
        let low = first_row_m - 0.5 * step_m;
        let high = low + step_m * f64::from(lines);
        if is_north { [WIDTH_M - high, WIDTH_M - low] } else { [low, high] }
    };
    let zone = |name: &str, lamp, [low, high]: [f64; 2], rows, full, z_m| Zone {
        name: format!("{name} {}", bay + 1),
        lamp,
        standard: rows * per_row(full),
        layout: Layout::Rows { low_m: [from, low], high_m: [to, high], rows, z_m },
    };
    let nave_m = [ROWS_M[0] + 0.3, ROWS_M[1] - 0.3];
    let under_profile_m = micrometre(PROFILE_BOTTOM_M - CLEARANCE_M);
    let between_m = first_m - 0.5 * step_m;
    [
        zone("nave", DOWNLIGHT, nave_m, 14, 12, ceiling_m),
        zone("south aisle", DOWNLIGHT, aisle(between_m, false), lines, 6, ceiling_m),
        zone("north aisle", DOWNLIGHT, aisle(between_m, true), lines, 6, ceiling_m),
        zone("south desks", BATWING, aisle(first_m, false), lines, 6, under_profile_m),
        zone("north desks", BATWING, aisle(first_m, true), lines, 6, under_profile_m),
    ]
}

fn wall_zones() -> [Zone; 4] {
    let z_m = micrometre(BEAM_BOTTOM_M[0] - 5.0 * CLEARANCE_M);
    let (east, north) = (LENGTH_M - WALL_M, WIDTH_M - WALL_M);
    let line = |name: &str, standard, from_m, to_m, c0_deg| Zone {
        name: format!("{name} wall"),
        lamp: WASHER,
        standard,
        layout: Layout::Line { from_m, to_m, c0_deg, z_m },
    };
    [
        line("south", 97, [0.2, WALL_M], [LENGTH_M - 0.2, WALL_M], 270.0),
        line("north", 97, [0.2, north], [LENGTH_M - 0.2, north], 90.0),
        line("west", 64, [WALL_M, 0.2], [WALL_M, WIDTH_M - 0.2], 180.0),
        line("east", 64, [east, 0.2], [east, WIDTH_M - 0.2], 0.0),
    ]
}

/// Shares a total in proportion to weights: by largest remainders, the first of equals first.
fn apportion(weights: &[u32], total: u32) -> Vec<u32> {
    let sum: u64 = weights.iter().map(|&w| u64::from(w)).sum();
    let exact = |w: u32| u64::from(w) * u64::from(total);
    let mut shares: Vec<u32> = weights.iter().map(|&w| (exact(w) / sum) as u32).collect();
    let mut order: Vec<usize> = (0..weights.len()).collect();
    order.sort_by_key(|&k| std::cmp::Reverse(exact(weights[k]) % sum));
    let missing = total - shares.iter().sum::<u32>();
    order.iter().take(missing as usize).for_each(|&k| shares[k] += 1);
    shares
}

/// What a name ends in, the position, and the angle of C0.
type Hung = (String, Point, f64);

impl Layout {
    fn places(&self, count: u32) -> Vec<Hung> {
        match *self {
            Self::Rows { low_m, high_m, rows, z_m } => in_rows(low_m, high_m, rows, z_m, count),
            Self::Line { from_m, to_m, c0_deg, z_m } => {
                let ([x, y], step_m) = middles(from_m, to_m, count);
                let is_along_x = step_m[1] == 0.0;
                let counts = if is_along_x { [count, 1] } else { [1, count] };
                array([x, y, z_m], step_m, counts, "", c0_deg)
            }
            Self::Ring { centre_m, radius_m, z_m } => on_ring(centre_m, radius_m, z_m, count),
        }
    }
}

/// The first middle of equal parts of a line, and the step to the next.
fn middles(from_m: [f64; 2], to_m: [f64; 2], count: u32) -> ([f64; 2], [f64; 2]) {
    let step = [0, 1].map(|k| micrometre((to_m[k] - from_m[k]) / f64::from(count.max(1))));
    ([0, 1].map(|k| micrometre(from_m[k] + 0.5 * step[k])), step)
}

/// Names end as those of an array in a `scene.toml` do, and positions are sums in the same order.
fn array(first: [f64; 3], step: [f64; 2], [nx, ny]: [u32; 2], row: &str, c0_deg: f64) -> Vec<Hung> {
    let place = |i: u32, j: u32| {
        let shift = Vector::new(f64::from(i) * step[0], f64::from(j) * step[1], 0.0);
        (format!("{row}[{i},{j},0]"), Point::from(first) + shift, c0_deg)
    };
    (0..ny).flat_map(|j| (0..nx).map(move |i| (i, j))).map(|(i, j)| place(i, j)).collect()
}

fn in_rows(low: [f64; 2], high: [f64; 2], rows: u32, z_m: f64, count: u32) -> Vec<Hung> {
    let ([_, first_y], [_, step_y]) = middles([0.0, low[1]], [0.0, high[1]], rows);
    if count.is_multiple_of(rows) {
        let ([x, _], [step_x, _]) = middles([low[0], 0.0], [high[0], 0.0], count / rows);
        return array([x, first_y, z_m], [step_x, step_y], [count / rows, rows], "", 0.0);
    }
    (0..rows)
        .flat_map(|row| {
            let before = |row: u32| (u64::from(count) * u64::from(row) / u64::from(rows)) as u32;
            let here = before(row + 1) - before(row);
            let ([x, _], [step_x, _]) = middles([low[0], 0.0], [high[0], 0.0], here);
            let y = micrometre(first_y + step_y * f64::from(row));
            array([x, y, z_m], [step_x, 0.0], [here, 1], &format!(" row {}", row + 1), 0.0)
        })
        .collect()
}

fn on_ring(centre: [f64; 2], radius_m: f64, z_m: f64, count: u32) -> Vec<Hung> {
    (0..count)
        .map(|k| {
            let at_deg = rounded(360.0 * (f64::from(k) + 0.5) / f64::from(count), 1e6);
            let (sin, cos) = sincos_deg(at_deg);
            let x = micrometre(centre[0] + radius_m * cos);
            let y = micrometre(centre[1] + radius_m * sin);
            let c0_deg = if at_deg < 180.0 { at_deg + 180.0 } else { at_deg - 180.0 };
            (format!(" {}", k + 1), Point::new(x, y, z_m), c0_deg)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hall::variant::Variant;

    #[test]
    fn the_standard_zones_hold_the_standard_number() {
        let sum: u32 = zones().iter().map(|z| z.standard).sum();
        assert_eq!(sum, Variant::STANDARD.luminaires);
    }

    #[test]
    fn shares_sum_to_the_total() {
        for total in [100, 101, 2626, 99_999] {
            let weights: Vec<u32> = zones().iter().map(|z| z.standard).collect();
            assert_eq!(apportion(&weights, total).iter().sum::<u32>(), total);
        }
        assert_eq!(apportion(&[1, 1, 1], 4), [2, 1, 1]);
    }
}
