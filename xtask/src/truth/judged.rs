//! By how much a map is wrong, and whether it knew.

use super::exported::{Place, TruthScene};
use super::paths::Truth;
use super::solved::Reading;
use serde_json::{Value, json};

/// Standard errors to either side of an interval of 95 %.
const INTERVAL_95: f64 = 1.96;
/// Digits of a map, relative to its light: values are stored in single precision.
const ROUNDING: f64 = 1e-6;
/// A map is broken whose true error exceeds the one told by this factor, or that has more than this share of readings
/// outside their intervals.
pub(super) const MOST_OVER_TOLD: f64 = 1.5;
pub(super) const MOST_OUTSIDE: f64 = 0.08;
/// Places listed.
const WORST: usize = 8;

/// A place with what is right there and what the map says.
struct Compared<'a> {
    place: &'a Place,
    truth: Truth,
    reading: Reading,
    z: f64,
}

impl Compared<'_> {
    /// Squared error without that of the paths.
    fn excess_lx2(&self) -> f64 {
        (self.reading.lx - self.truth.lx).powi(2) - self.truth.variance
    }
}

/// What a row says of a map, added to what its run said of itself.
pub(super) fn row(
    scene: &TruthScene,
    truth: &[Truth],
    solved: Value,
    readings: &[Option<Reading>],
) -> Value {
    let all = || scene.places.iter().zip(truth).zip(readings);
    let known = all().filter_map(|((place, &truth), reading)| Some((place, truth, (*reading)?)));
    let is_area = |place: &Place| place.stratum == "area";
    let light: Vec<Truth> =
        known.clone().filter(|(place, ..)| is_area(place)).map(|(_, truth, _)| truth).collect();
    // What errors are told relative to.
    let reference_lx = solved["reference_lx"].as_f64().unwrap_or(0.0);
    let mut compared: Vec<Compared> = known
        .map(|(place, truth, reading)| {
            let noise_lx2 = truth.variance
                + reading.standard_error_lx.powi(2)
                + (ROUNDING * reference_lx).powi(2);
            let z = if noise_lx2 > 0.0 { (reading.lx - truth.lx) / noise_lx2.sqrt() } else { 0.0 };
            Compared { place, truth, reading, z }
        })
        .collect();
    let (area, beside): (Vec<&Compared>, Vec<&Compared>) =
        compared.iter().partition(|c| is_area(c.place));
    let mut row = solved;
    let error = true_error(&area, reference_lx);
    let ratio =
        |share: f64| row["told"].as_f64().filter(|told| *told > 0.0).map(|told| share / told);
    let over = error.map(ratio);
    // Light that is there and of which the map says nothing.
    let is_lit = |t: &Truth| t.lx > INTERVAL_95 * t.variance.sqrt() && t.lx > 1e-3 * reference_lx;
    let unknown =
        all().filter(|((place, truth), r)| r.is_none() && is_area(place) && is_lit(truth));
    row["unknown"] = json!(unknown.count());
    row["paths_noise"] = json!(own_noise(&light, reference_lx));
    (row["true_low"], row["true"], row["true_high"]) =
        (json!(error[0]), json!(error[1]), json!(error[2]));
    (row["over_told_low"], row["over_told"]) = (json!(over[0]), json!(over[1]));
    (row["places"], row["outside"], row["largest_z"]) = spread(&area);
    (row["places_beside"], row["outside_beside"], row["largest_z_beside"]) = spread(&beside);
    row["negative"] = json!(compared.iter().filter(|c| c.reading.lx < 0.0).count());
    compared.sort_by(|a, b| b.z.abs().total_cmp(&a.z.abs()));
    row["worst"] = compared.iter().take(WORST).map(listed).collect();
    compared.retain(|c| is_area(c.place));
    compared.sort_by(|a, b| b.excess_lx2().total_cmp(&a.excess_lx2()));
    row["costliest"] = compared.iter().take(WORST).map(listed).collect();
    row
}

fn own_noise(light: &[Truth], reference_lx: f64) -> f64 {
    let sum: f64 = light.iter().map(|t| t.variance).sum();
    (sum / light.len().max(1) as f64).sqrt() / reference_lx
}

/// The error without that of the paths, between the ends of an interval of 95 %. An estimate without bias of a square
/// may be below zero: then the error is too small to be seen.
fn true_error(area: &[&Compared], reference_lx: f64) -> [f64; 3] {
    let squares: Vec<f64> = area.iter().map(|c| c.excess_lx2()).collect();
    let count = squares.len().max(2) as f64;
    let mean = squares.iter().sum::<f64>() / count;
    let variance = squares.iter().map(|s| (s - mean).powi(2)).sum::<f64>() / (count - 1.0);
    let reach = INTERVAL_95 * (variance / count).sqrt();
    [mean - reach, mean, mean + reach].map(|square| square.max(0.0).sqrt() / reference_lx)
}

/// Number of places, share outside their intervals, largest deviation in standard errors.
fn spread(compared: &[&Compared]) -> (Value, Value, Value) {
    let count = compared.len();
    let outside = compared.iter().filter(|c| c.z.abs() > INTERVAL_95).count();
    let largest = compared.iter().map(|c| c.z.abs()).fold(0.0, f64::max);
    (json!(count), json!(outside as f64 / count.max(1) as f64), json!(largest))
}

fn listed(Compared { place, truth, reading, z }: &Compared) -> Value {
    json!({
        "point": place.point,
        "surface": place.surface,
        "stratum": place.stratum,
        "read_lx": reading.lx,
        "read_error_lx": reading.standard_error_lx,
        "right_lx": truth.lx,
        "right_error_lx": truth.variance.sqrt(),
        "z": z,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 100 places of 100 lx known to 1 lx: half of the readings right, half 5 lx off.
    fn judged(standard_error_lx: f64) -> Value {
        let place = |k: usize| Place {
            point: k.to_string(),
            surface: "wall".into(),
            stratum: "area".into(),
        };
        let scene = TruthScene {
            name: "one".into(),
            kind: "one".into(),
            half: "tuning".into(),
            hash: String::new(),
            leaves_caustics: false,
            places: (0..100).map(place).collect(),
        };
        let truth = [Truth { lx: 100.0, variance: 1.0 }; 100];
        let reading =
            |k: usize| Some(Reading { lx: 100.0 + 5.0 * (k % 2) as f64, standard_error_lx });
        let readings: Vec<_> = (0..100).map(reading).collect();
        row(&scene, &truth, json!({ "told": 0.01, "reference_lx": 100.0 }), &readings)
    }

    #[test]
    fn the_paths_own_error_is_taken_off() {
        let row = judged(1.0);
        // (0 + 25) / 2 - 1, over 100^2.
        let expected = 11.5_f64.sqrt() / 100.0;
        assert!((row["true"].as_f64().unwrap() - expected).abs() < 1e-12, "{row}");
        assert!((row["over_told"].as_f64().unwrap() - 100.0 * expected).abs() < 1e-9);
        assert!(row["true_low"].as_f64().unwrap() < expected);
    }

    #[test]
    fn readings_are_outside_where_their_errors_are_too_small() {
        assert_eq!(judged(1.0)["outside"], 0.5);
        assert_eq!(judged(3.0)["outside"], 0.0);
    }
}
