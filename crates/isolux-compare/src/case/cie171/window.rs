//! 5.11 under the overcast and the clear sky: the sky component at an unglazed window in the facade.
//!
//! The sky is infinitely far away ([`super::sky`]), and below the horizon there is nothing: under a sky that is not uniform the illuminance of the ground beside a building has no exact
//! form that is short, so the externally reflected component is left to the uniform sky
//! ([`super::facade`]). The sun of the clear sky stands behind the building.

use super::room::black;
use super::sky::{CieSky, Skylight};
use super::street::{room, window};
use crate::expectation::{Case, Expectation};
use isolux::engine::ProbePoint;
use isolux::geometry::Vector;
use isolux::scene::SceneParts;

const ZENITH_CD_M2: f64 = 4000.0;

pub(super) fn cases() -> [Case; 2] {
    [
        Case {
            name: "cie171_5_11_overcast",
            notes: "CIE 171 5.11: the CIE overcast sky (type 1) through an unglazed window",
            parts: || parts("cie171_5_11_overcast", &overcast()),
            expectations: || expectations(&overcast()),
        },
        Case {
            name: "cie171_5_11_clear",
            notes: "CIE 171 5.11: the CIE clear sky (type 12) through an unglazed window",
            parts: || parts("cie171_5_11_clear", &clear()),
            expectations: || expectations(&clear()),
        },
    ]
}

fn overcast() -> CieSky {
    CieSky::overcast(ZENITH_CD_M2)
}

fn clear() -> CieSky {
    CieSky::clear(ZENITH_CD_M2, Vector::new(-0.7, 0.3, 0.6))
}

fn parts(name: &str, sky: &CieSky) -> SceneParts {
    let shapes = room().shapes(Some(window()));
    let (materials, luminaires) = (vec![black()], vec![sky.luminaire()]);
    SceneParts { name: name.into(), shapes, materials, luminaires, ..SceneParts::default() }
}

/// Below the window, and at its height, where the sky is seen down to the horizon.
fn places() -> Vec<ProbePoint> {
    let room = room();
    let floor = [-0.6, -1.3, -2.0, -2.8, -3.6].map(|x| room.floor.place(x, 2.0));
    let back = [0.3, 0.9, 1.8].map(|z| room.west.place(2.0, z));
    let side = [(0.7, -1.5), (1.2, -3.0)].map(|(z, x)| room.south.place(z, x));
    [floor.as_slice(), &back, &side].concat()
}

fn expectations(sky: &CieSky) -> Vec<Expectation> {
    let corners = window().corners();
    let skylight = Skylight { sky, opening: &corners, transmitted: None };
    places().into_iter().flat_map(|at| skylight.expected(at)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::WINDOW_QUADRATURE;

    /// The luminance that rays of a fine grid of the window meet.
    #[test]
    fn the_sky_through_the_window_agrees_with_a_sum_over_rays() {
        for sky in [overcast(), clear()] {
            let corners = window().corners();
            let skylight = Skylight { sky: &sky, opening: &corners, transmitted: None };
            for at in places() {
                let (steps, mut sum) = (400, 0.0);
                for k in 0..steps * steps {
                    let share = |n: u32| (f64::from(n) + 0.5) / f64::from(steps);
                    let through =
                        window().point(1.0 + 2.0 * share(k % steps), 1.5 + share(k / steps));
                    let way = through - at.position;
                    let (r2, cos) = (way.length_squared(), way.dot(at.normal.to_vector()));
                    sum += sky.luminance_cd_m2(way) * cos * way.x / (r2 * r2);
                }
                let sum = sum * 2.0 / f64::from(steps * steps);
                let found = skylight.of_sky_lx(at);
                assert!((found / sum - 1.0).abs() < WINDOW_QUADRATURE, "{at:?}: {found} {sum}");
            }
        }
    }
}
