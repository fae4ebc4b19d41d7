//! Where the light of a ceiling of luminaires first arrives.

use super::room::{Arriving, UgrRoom};
use crate::photometry::PhotometricWeb;
use std::f64::consts::FRAC_PI_2;

/// Zones of the lower hemisphere, a quarter of a degree each.
const ZONES: u32 = 360;
/// Directions in a quarter of the circle.
const DIRECTIONS: u32 = 36;

/// The flux of one luminaire by the angle from nadir, lm.
pub(super) struct Zones {
    /// Tangent of the angle, and flux.
    down: Vec<(f64, f64)>,
    up_lm: f64,
}

impl Zones {
    pub(super) fn of(web: &PhotometricWeb) -> Self {
        let step_deg = 90.0 / f64::from(ZONES);
        let below = |zone: u32| web.flux_below_lm(f64::from(zone) * step_deg);
        let zone = |k: u32| {
            let middle = FRAC_PI_2 * (f64::from(k) + 0.5) / f64::from(ZONES);
            (libm::tan(middle), below(k + 1) - below(k))
        };
        let up_lm = (web.luminous_flux_lm() - below(ZONES)).max(0.0);
        Self { down: (0..ZONES).map(zone).collect(), up_lm }
    }

    pub(super) fn down_lm(&self) -> f64 {
        self.down.iter().map(|(_, lm)| lm).sum()
    }

    /// What arrives of one luminaire, in the mean over all of a room, lm. As CIE 190 has it, the light is taken as even in C.
    pub(super) fn arriving(&self, room: UgrRoom, spacing: f64) -> Arriving {
        let onto_floor = |&(tangent, lm): &(f64, f64)| lm * share_within(room, spacing, tangent);
        let floor: f64 = self.down.iter().map(onto_floor).sum();
        Arriving { ceiling: self.up_lm, walls: self.down_lm() - floor, floor }
    }
}

/// The share of rays that meet the plane of the eye before a wall, of all luminaires and of all directions at an angle from nadir.
fn share_within(room: UgrRoom, spacing: f64, tangent: f64) -> f64 {
    let of_direction = |k: u32| {
        let c = FRAC_PI_2 * (f64::from(k) + 0.5) / f64::from(DIRECTIONS);
        let (sine, cosine) = libm::sincos(c);
        share_of_row(f64::from(room.across), spacing, tangent * cosine)
            * share_of_row(f64::from(room.along), spacing, tangent * sine)
    };
    (0..DIRECTIONS).map(of_direction).sum::<f64>() / f64::from(DIRECTIONS)
}

/// The share of luminaires in a row, half a spacing from both walls, that lie farther than a distance from one of them.
fn share_of_row(length: f64, spacing: f64, distance: f64) -> f64 {
    let count = (length / spacing).round();
    let before = ((length - distance) / spacing + 0.5).floor();
    before.clamp(0.0, count) / count
}

#[cfg(test)]
mod tests {
    use super::*;

    fn web(candela: impl Fn(f64) -> f64) -> PhotometricWeb {
        let gammas: Vec<f64> = (0..=180).map(f64::from).collect();
        let candela = gammas.iter().map(|g| candela(g.to_radians()).max(0.0)).collect();
        PhotometricWeb::new(vec![0.0], gammas, candela).unwrap()
    }

    /// Luminaires one by one: the flux through the rectangle below, by quadrature.
    fn one_by_one(room: UgrRoom, spacing: f64) -> f64 {
        let [a, b] = [room.across, room.along].map(f64::from);
        let row = |side: f64| {
            (0..(side / spacing).round() as u32).map(move |k| (f64::from(k) + 0.5) * spacing)
        };
        let places = |side: f64| (0..60).map(move |k| side * (f64::from(k) + 0.5) / 60.0);
        let (mut sum, mut count) = (0.0, 0.0);
        for (x, y) in row(a).flat_map(|x| row(b).map(move |y| (x, y))) {
            count += 1.0;
            for (u, v) in places(a).flat_map(|u| places(b).map(move |v| (u, v))) {
                let square = 1.0 + (x - u) * (x - u) + (y - v) * (y - v);
                // Intensity cos, and the cosine on the plane, over the square: 1 / square^2.
                sum += a * b / 3600.0 / (square * square);
            }
        }
        sum / count
    }

    #[test]
    fn as_luminaires_one_by_one() {
        let zones = Zones::of(&web(f64::cos));
        for ([across, along], spacing) in [([2, 2], 1.0), ([2, 3], 0.25), ([4, 8], 0.5)] {
            let room = UgrRoom { across, along };
            let (found, due) = (zones.arriving(room, spacing).floor, one_by_one(room, spacing));
            // Whole luminaires step in and out as the angle grows: 36 directions and 360 angles leave 2e-3.
            assert!((found / due - 1.0).abs() < 2e-3, "{room:?} {spacing}: {found}, not {due}");
        }
    }

    #[test]
    fn light_is_shared_out_whole() {
        let zones = Zones::of(&web(|gamma| 1.0 + 0.3 * libm::cos(gamma)));
        let arriving = zones.arriving(UgrRoom { across: 4, along: 6 }, 0.25);
        let whole = web(|gamma| 1.0 + 0.3 * libm::cos(gamma)).luminous_flux_lm();
        let sum = arriving.ceiling + arriving.walls + arriving.floor;
        // A sum of 360 zones.
        assert!((sum / whole - 1.0).abs() < 1e-12, "{sum} {whole}");
        assert!(arriving.ceiling > 0.0 && arriving.walls > 0.0 && arriving.floor > 0.0);
    }
}
