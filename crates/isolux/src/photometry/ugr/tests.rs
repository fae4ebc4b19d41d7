#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

use super::position::tabulated_position_index;
use super::*;
use crate::photometry::AngleSystem;
use isolux_geometry::Vector;

const C0: UgrLayout = UgrLayout { spacing_to_height: 0.5, crosswise_is_c0: true };

/// Some of every room light: wide across C0, some light up, shiny at no angle.
fn trough() -> PhotometricWeb {
    table(|c, gamma| {
        let across = 1.0 + 0.5 * libm::cos(c) * libm::cos(c) * libm::sin(gamma);
        if libm::cos(gamma) > 0.0 { 800.0 * libm::cos(gamma) * across } else { 60.0 }
    })
}

fn table(candela: impl Fn(f64, f64) -> f64) -> PhotometricWeb {
    let planes: Vec<f64> = (0..24).map(|k| f64::from(k) * 15.0).collect();
    let gammas: Vec<f64> = (0..=72).map(|k| f64::from(k) * 2.5).collect();
    let candela = planes
        .iter()
        .flat_map(|c| {
            gammas.iter().map(|g| candela(c.to_radians(), g.to_radians())).collect::<Vec<_>>()
        })
        .collect();
    PhotometricWeb::new(planes, gammas, candela).unwrap()
}

/// A box 0.3 m along C0, 1.2 m along C90 and 0.05 m high.
fn box_m2(along: Direction) -> f64 {
    let Vector { x, y, z } = along.to_vector();
    0.36 * z.abs() + 0.06 * x.abs() + 0.015 * y.abs()
}

/// The rating by the words of the standard: luminaires one by one, luminance times solid angle, light on the walls as what does not
/// meet the plane of the eye, and bounce by bounce.
fn by_luminaires(web: &PhotometricWeb, room: UgrRoom, of: UgrReflectances, turn_deg: f64) -> f64 {
    let (a, b) = (2.0 * f64::from(room.across), 2.0 * f64::from(room.along));
    let places = |side: f64, step: f64| {
        (0..(side / step).round() as u32).map(move |k| (f64::from(k) + 0.5) * step)
    };
    let axial = |gamma: f64| {
        let at = |k: u32| {
            let c = f64::from(k).to_radians();
            let at = Vector::new(
                libm::cos(c) * libm::sin(gamma),
                libm::sin(c) * libm::sin(gamma),
                -libm::cos(gamma),
            );
            web.intensity_cd(at.direction().unwrap())
        };
        (0..360).map(at).sum::<f64>() / 360.0
    };
    // Intensity in the mean of C at every half degree.
    let mean: Vec<f64> = (0..=360).map(|k| axial(0.5 * f64::from(k).to_radians())).collect();
    let (mut sum, mut on_floor, mut count) = (0.0, 0.0, 0.0);
    for (x, y) in places(a, 1.0).flat_map(|x| places(b, 1.0).map(move |y| (x, y))) {
        count += 1.0;
        for (u, v) in places(a, 0.1).flat_map(|u| places(b, 0.1).map(move |v| (u, v))) {
            let square = 4.0 + (x - u) * (x - u) + (y - v) * (y - v);
            let at = 2.0 * libm::acos(2.0 / square.sqrt()).to_degrees();
            let low = mean[at as usize];
            let candela = low + (mean[at as usize + 1] - low) * at.fract();
            on_floor += 0.01 * candela * 2.0 / (square * square.sqrt());
        }
        let (right, ahead) = (x - 0.5 * a, y);
        if let Some(index) = tabulated_position_index(right / ahead, 2.0 / ahead) {
            let (sin, cos) = libm::sincos(turn_deg.to_radians());
            let to_eye = Vector::new(cos * ahead - sin * right, sin * ahead + cos * right, -2.0);
            let towards = to_eye.direction().unwrap();
            let luminance = web.intensity_cd(towards) / box_m2(towards);
            let steradians = box_m2(towards) / to_eye.length_squared();
            sum += luminance * luminance * steradians / (index * index);
        }
    }
    let down = count * web.flux_below_lm(90.0);
    let up = count * web.luminous_flux_lm() - down;
    let walls_m2 = 8.0 * f64::from(room.across + room.along);
    let background = by_bounces(room, of, [up, down - on_floor, on_floor]) / walls_m2 / PI;
    8.0 * libm::log10(0.25 / background * sum)
}

/// Reflected light on the walls, bounce by bounce, of direct light on ceiling, walls and floor; the form factor of ceiling and floor by
/// the midpoint rule.
pub(super) fn by_bounces(room: UgrRoom, of: UgrReflectances, direct: [f64; 3]) -> f64 {
    let [a, b] = [room.across, room.along].map(f64::from);
    let n = 28;
    let places = |side: f64| (0..n).map(move |k| side * (f64::from(k) + 0.5) / f64::from(n));
    let mut facing = 0.0;
    for (x, y) in places(a).flat_map(|x| places(b).map(move |y| (x, y))) {
        for (u, v) in places(a).flat_map(|u| places(b).map(move |v| (u, v))) {
            let square = 1.0 + (x - u) * (x - u) + (y - v) * (y - v);
            facing += a * b / (PI * square * square * f64::from(n * n * n * n));
        }
    }
    let to_walls = 1.0 - facing;
    let from_walls = a * b / (2.0 * (a + b)) * to_walls;
    let (mut now, mut sum) = (direct, 0.0);
    for _ in 0..200 {
        let [c, w, f] = [now[0] * of.ceiling, now[1] * of.walls, now[2] * of.floor];
        now = [
            w * from_walls + f * facing,
            (c + f) * to_walls + w * (1.0 - 2.0 * from_walls),
            w * from_walls + c * facing,
        ];
        sum += now[1];
    }
    sum
}

#[test]
fn the_table_is_what_luminaires_one_by_one_give() {
    let web = trough();
    let found = UgrTable::of(&web, box_m2, C0).unwrap();
    for k in [0, 1, 8, 9] {
        for (q, of) in UGR_REFLECTANCES.into_iter().enumerate() {
            for (rows, turn_deg) in [(&found.crosswise, 0.0), (&found.endwise, 90.0)] {
                let due = by_luminaires(&web, UGR_ROOMS[k], of, turn_deg);
                let found = rows[k][q].unwrap();
                // A share of 0.3 % of the background, by the steps of both sums, is a hundredth.
                assert!(
                    (found - due).abs() < 0.01,
                    "{:?} {of:?} {turn_deg}: {found}, not {due}",
                    UGR_ROOMS[k]
                );
            }
        }
    }
}

#[test]
fn twice_the_light_is_eight_lg_two_and_a_quarter_turn_changes_places() {
    let web = trough();
    let table = UgrTable::of(&web, box_m2, C0).unwrap();
    let brighter = UgrTable::of(&web.scaled(2.0), box_m2, C0).unwrap();
    let turned = UgrTable::of(&web, box_m2, UgrLayout { crosswise_is_c0: false, ..C0 }).unwrap();
    assert_eq!(turned.crosswise, table.endwise);
    for (one, two) in table.crosswise.iter().flatten().zip(brighter.crosswise.iter().flatten()) {
        let more = two.unwrap() - one.unwrap();
        assert!((more - UgrTable::flux_correction(2000.0)).abs() < 1e-9, "{more}");
    }
    assert!(table.asymmetry < 1e-9, "{}", table.asymmetry);
}

#[test]
fn one_sided_and_other_luminaires_have_no_table() {
    let sideways = table(|c, gamma| {
        if libm::cos(gamma) > 0.0 { 100.0 * (1.2 + libm::cos(c) * libm::sin(gamma)) } else { 0.0 }
    });
    assert!(
        matches!(UgrTable::of(&sideways, box_m2, C0), Err(NoUgrTable::Asymmetric(by)) if by > 1.0)
    );
    let up = table(|_, gamma| if gamma > 1.6 { 100.0 } else { 0.0 });
    assert_eq!(UgrTable::of(&up, box_m2, C0), Err(NoUgrTable::Dark));
    let angles = vec![45.0, 90.0, 135.0];
    let flood =
        PhotometricWeb::in_system(AngleSystem::B, angles.clone(), angles, vec![1.0; 9]).unwrap();
    assert_eq!(UgrTable::of(&flood, box_m2, C0), Err(NoUgrTable::Floodlight));
}

#[test]
fn a_beam_that_nobody_sees_has_no_rating() {
    let beam = table(|_, gamma| if gamma < 0.3 { 1000.0 } else { 0.0 });
    let table = UgrTable::of(&beam, box_m2, C0).unwrap();
    assert_eq!(table.crosswise[0], [None; 5]);
}
