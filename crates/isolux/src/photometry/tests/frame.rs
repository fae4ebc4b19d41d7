//! Nadir is -z, C0 is +x, C90 is +y; values between and beyond the angles given.

use super::*;

fn near(found: f64, expected: f64) {
    // An arc tangent, its conversion to degrees and two interpolations of numbers up to 1000.
    assert!((found - expected).abs() < 1e-11, "{found} against {expected}");
}

#[test]
fn planes_and_angles_lie_where_the_convention_says() {
    let candela: Vec<f64> = (0..12).map(f64::from).collect();
    let web = PhotometricWeb::new(vec![0.0, 90.0, 180.0, 270.0], vec![0.0, 90.0, 180.0], candela)
        .unwrap();
    let at = |x, y, z| web.intensity_cd(Vector::new(x, y, z).direction().unwrap());
    near(at(1.0, 0.0, 0.0), 1.0);
    near(at(0.0, 1.0, 0.0), 4.0);
    near(at(-1.0, 0.0, 0.0), 7.0);
    near(at(0.0, -1.0, 0.0), 10.0);
    near(at(0.0, 0.0, -1.0), 0.0);
    near(at(0.0, 0.0, 1.0), 2.0);
}

#[test]
fn values_between_are_bilinear_and_periodic() {
    let web = lopsided();
    near(web.intensity_cd(direction(10.0, 30.0)), 900.0);
    near(web.intensity_cd(direction(50.0, 17.5)), 0.25 * (100.0 + 900.0 + 300.0 + 100.0));
    // From 300 to 10 + 360: half way is 335, three quarters 352.5, and 5 is 65/70.
    near(web.intensity_cd(direction(335.0, 30.0)), 650.0);
    near(web.intensity_cd(direction(-7.5, 30.0)), 0.25 * 400.0 + 0.75 * 900.0);
    near(web.intensity_cd(direction(5.0, 30.0)), 400.0 + 500.0 * 65.0 / 70.0);
}

#[test]
fn beyond_the_angles_given_it_is_dark() {
    let web = axial(vec![30.0, 60.0], |_| 5.0);
    for (gamma, expected) in [(0.0, 0.0), (29.9, 0.0), (30.1, 5.0), (59.9, 5.0), (60.1, 0.0)] {
        near(web.intensity_cd(direction(123.0, gamma)), expected);
    }
    assert_eq!(web.intensity_cd(Direction::Z), 0.0);
}

#[test]
fn floodlights_are_dark_beyond_their_planes_and_bilinear_between() {
    let at = |system, x, y, z| {
        let direction = Vector::new(x, y, z).direction().unwrap();
        floodlight(system).intensity_cd(direction)
    };
    // The aim: plane 90, polar angle 90.
    near(at(AngleSystem::B, 0.0, 0.0, -1.0), 900.0 - 200.0 * 10.0 / 15.0);
    near(at(AngleSystem::A, 0.0, 0.0, -1.0), 900.0 - 200.0 * 10.0 / 15.0);
    // Straight up ends the planes of B, straight to the right those of A.
    near(at(AngleSystem::B, 1.0, 0.0, 0.0), 10.0);
    near(at(AngleSystem::A, 0.0, -1.0, 0.0), 10.0);
    // Backwards there is nothing.
    near(at(AngleSystem::B, 0.1, 0.2, 1.0), 0.0);
    near(at(AngleSystem::A, 0.1, 0.2, 1.0), 0.0);
}

#[test]
fn the_horizontal_belongs_to_a_table_that_ends_there() {
    let web = axial(vec![0.0, 90.0], |_| 5.0);
    near(web.intensity_cd(Direction::X), 5.0);
    near(web.intensity_cd(Direction::Y), 5.0);
}

#[test]
fn analytic_kinds_follow_their_definition() {
    use IntensityDistribution::*;
    let lambertian = CosinePower { peak_cd: 80.0, exponent: 1.0 };
    near(lambertian.intensity_cd(direction(77.0, 60.0)), 40.0);
    near(lambertian.intensity_cd(direction(77.0, 120.0)), 0.0);
    let spot = Spot { peak_cd: 100.0, inner_rad: 0.0, outer_rad: std::f64::consts::FRAC_PI_2 };
    near(spot.intensity_cd(direction(5.0, 60.0)), 25.0);
    near(spot.intensity_cd(direction(5.0, 0.0)), 100.0);
    near(spot.intensity_cd(direction(5.0, 100.0)), 0.0);
    near(Isotropic { intensity_cd: 3.0 }.intensity_cd(direction(5.0, 100.0)), 3.0);
}

#[test]
fn the_highest_intensity_is_nowhere_exceeded_and_reached() {
    assert_eq!(lopsided().max_intensity_cd(), 900.0);
    for (name, distribution) in every_kind() {
        let highest = distribution.max_intensity_cd();
        let seen = (0..180 * 360)
            .map(|k| distribution.intensity_cd(direction(f64::from(k % 360), f64::from(k / 360))))
            .fold(0.0, f64::max);
        assert!(seen <= highest * (1.0 + 1e-12), "{name}: {seen} above {highest}");
        assert!(seen > 0.9 * highest, "{name}: {seen} far below {highest}");
    }
}
