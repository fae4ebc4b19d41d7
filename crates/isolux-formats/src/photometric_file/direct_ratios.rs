//! Direct ratios of EULUMDAT: of the light that goes down, the share that falls on the working plane without meeting a wall.

use isolux::geometry::Vector;
use isolux::photometry::PhotometricWeb;

/// Room indices of the ten ratios, k = a b / (h (a + b)) of a room a by b, its luminaires h above the working plane.
pub const ROOM_INDICES: [f64; 10] = [0.6, 0.8, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0];

/// Directions summed: rings of a quarter of a degree, planes of 2.5 degrees. Measured on a Lambertian table: 6e-6 off.
const RINGS: u32 = 360;
const PLANES: u32 = 144;

/// The ratios of a luminaire in square rooms under a ceiling evenly filled with it; `None` of one that sends nothing down.
///
/// EULUMDAT asks for the ratios of LiTG publication 3.5, whose tables may not be had freely. This is what they stand for:
/// of the places of such a ceiling, the share (1 - r |cos C| / a) (1 - r |sin C| / a) sends its ray of the direction
/// (gamma, C), r = h tan gamma long on the plane, to a point inside a room of the side a = 2 k h. Lamps in few rows give
/// other ratios: up to 0.22 in small rooms with luminaires 1.5 h apart.
pub fn direct_ratios(web: &PhotometricWeb) -> Option<[f64; 10]> {
    let mut within = [0.0; 10];
    let mut down = 0.0;
    for ring in 0..RINGS {
        let gamma = std::f64::consts::FRAC_PI_2 * (f64::from(ring) + 0.5) / f64::from(RINGS);
        let (sin_gamma, cos_gamma) = libm::sincos(gamma);
        for plane in 0..PLANES {
            let c = std::f64::consts::TAU * (f64::from(plane) + 0.5) / f64::from(PLANES);
            let (sin_c, cos_c) = libm::sincos(c);
            let at = Vector::new(sin_gamma * cos_c, sin_gamma * sin_c, -cos_gamma);
            let Some(at) = at.direction() else { continue };
            let light = web.intensity_cd(at) * sin_gamma;
            down += light;
            for (sum, k) in within.iter_mut().zip(ROOM_INDICES) {
                let reach = sin_gamma / cos_gamma / (2.0 * k);
                let inside = |along: f64| (1.0 - reach * along.abs()).max(0.0);
                *sum += light * inside(cos_c) * inside(sin_c);
            }
        }
    }
    (down > 0.0).then(|| within.map(|sum| sum / down))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn web(candela: impl Fn(f64) -> f64) -> PhotometricWeb {
        let gammas: Vec<f64> = (0..=180).map(f64::from).collect();
        let candela = gammas.iter().map(|g| candela(g.to_radians()).max(0.0)).collect();
        PhotometricWeb::new(vec![0.0], gammas, candela).unwrap_or_else(|e| panic!("{e:?}"))
    }

    /// Between two squares of side x, 1 apart (Howell, configuration C-11).
    fn form_factor(x: f64) -> f64 {
        let one = 1.0 + x * x;
        let root = one.sqrt();
        let logarithm = (one * one / (1.0 + 2.0 * x * x)).sqrt().ln();
        2.0 / (std::f64::consts::PI * x * x)
            * (logarithm + 2.0 * x * root * (x / root).atan() - 2.0 * x * x.atan())
    }

    #[test]
    fn of_a_lambertian_ceiling_they_are_form_factors() {
        let ratios = direct_ratios(&web(f64::cos)).unwrap();
        for (ratio, k) in ratios.into_iter().zip(ROOM_INDICES) {
            let due = form_factor(2.0 * k);
            // The table is linear between degrees: 2e-5 of a cosine; the sum is finer.
            assert!((ratio - due).abs() < 5e-5, "k {k}: {ratio} for {due}");
        }
    }

    #[test]
    fn a_beam_straight_down_meets_no_wall_and_light_up_has_no_ratio() {
        let beam = direct_ratios(&web(|gamma| f64::from(u8::from(gamma < 0.01)))).unwrap();
        // All within one degree: tan 1 / 1.2, twice.
        assert!(beam.into_iter().all(|ratio| ratio > 0.97 && ratio <= 1.0), "{beam:?}");
        let up = web(|gamma| f64::from(u8::from(gamma > 1.6)));
        assert_eq!(direct_ratios(&up), None);
    }

    #[test]
    fn in_a_square_room_it_does_not_matter_which_way_a_trough_lies() {
        let gammas: Vec<f64> = (0..=90).map(f64::from).collect();
        let planes: Vec<f64> = (0..4).map(|k| f64::from(k) * 90.0).collect();
        let across = |c: f64| if c == 0.0 || c == 180.0 { 1.0 } else { 0.0 };
        let table = |turn: f64| {
            let candela = planes.iter().flat_map(|c| vec![across((c + turn) % 360.0); 91]);
            let candela: Vec<f64> = candela.collect();
            PhotometricWeb::new(planes.clone(), gammas.clone(), candela)
        };
        let [one, other] = [0.0, 90.0].map(|turn| match table(turn) {
            Ok(web) => direct_ratios(&web).unwrap(),
            Err(e) => panic!("{e:?}"),
        });
        for (a, b) in one.into_iter().zip(other) {
            assert!((a - b).abs() < 1e-12);
        }
    }
}
