//! Visible normals of the GGX distribution.

use super::chi_square::misfit;
use super::hemisphere::Bins;
use super::squares;
use crate::sampling::Ggx;
use isolux_geometry::Vector;

fn view(theta_deg: f64, phi_deg: f64) -> Vector {
    let (st, ct) = libm::sincos(theta_deg.to_radians());
    let (sp, cp) = libm::sincos(phi_deg.to_radians());
    Vector::new(st * cp, st * sp, ct)
}

/// Widths, and how far from the axis (`1 - z`) most of their facets lie.
const WIDTHS: [(f64, f64); 4] = [(1.0, 1.0), (0.6, 0.7), (0.25, 0.25), (0.05, 0.015)];
const VIEWS_DEG: [(f64, f64); 4] = [(0.0, 0.0), (30.0, 75.0), (65.0, 200.0), (88.0, 310.0)];

#[test]
fn samples_follow_the_density() {
    for (alpha, widest) in WIDTHS {
        for (theta_deg, phi_deg) in VIEWS_DEG {
            let (ggx, view) = (Ggx { alpha }, view(theta_deg, phi_deg));
            let bins = Bins { widest };
            let facets = squares(5, 60_000).map(|square| ggx.sample(view, square));
            let visible = facets.inspect(|&f| assert!(f.dot(view) > -1e-9, "{f:?} is not seen"));
            let counts = bins.count(visible);
            let shares = bins.shares(|facet| ggx.density(view, facet));
            let found = misfit(&shares, &counts);
            assert!(found < 1.0, "alpha {alpha}, view {theta_deg} {phi_deg}: {found}");
        }
    }
}

#[test]
fn the_test_sees_a_wrong_width() {
    let (view, bins) = (view(30.0, 75.0), Bins { widest: 0.7 });
    let counts = bins.count(squares(5, 60_000).map(|s| Ggx { alpha: 0.5 }.sample(view, s)));
    let shares = |alpha: f64| bins.shares(|facet| Ggx { alpha }.density(view, facet));
    assert!(misfit(&shares(0.5), &counts) < 1.0);
    assert!(misfit(&shares(0.53), &counts) > 1.0);
}

#[test]
fn densities_integrate_to_one() {
    for (alpha, widest) in WIDTHS {
        let (ggx, bins) = (Ggx { alpha }, Bins { widest });
        let whole = |density: &dyn Fn(Vector) -> f64| bins.shares(density).iter().sum::<f64>();
        // Midpoint rule over 200 rings; its largest error is that of the narrowest width.
        let projected = whole(&|facet| ggx.distribution(facet) * facet.z);
        assert!((projected - 1.0).abs() < 2e-3, "alpha {alpha}: {projected}");
        for (theta_deg, phi_deg) in VIEWS_DEG {
            let view = view(theta_deg, phi_deg);
            let seen = whole(&|facet| ggx.density(view, facet));
            assert!((seen - 1.0).abs() < 2e-3, "alpha {alpha}, {theta_deg} deg: {seen}");
        }
    }
}

#[test]
fn masking_is_a_share_that_falls_towards_the_horizon() {
    for (alpha, _) in WIDTHS {
        let ggx = Ggx { alpha };
        let shares: Vec<f64> = (0..=90).map(|deg| ggx.masking(view(f64::from(deg), 0.0))).collect();
        assert_eq!(shares[0], 1.0);
        assert!(shares.windows(2).all(|w| w[1] <= w[0]) && shares[90] >= 0.0, "alpha {alpha}");
        // At the horizon tan is 1e12 at least, as the floor of the cosine has it.
        assert!(shares[90] < 1e-10 / alpha);
    }
}

#[test]
fn views_along_the_surface_and_corners_of_the_square_have_facets() {
    let last = 1.0 - f64::EPSILON / 2.0;
    for alpha in [1e-4, 0.3, 1.0] {
        for view in [view(0.0, 0.0), view(90.0, 45.0), Vector::new(1.0, 0.0, 0.0)] {
            for square in [[0.0, 0.0], [last, 0.0], [0.0, last], [last, last], [0.5, 0.5]] {
                let facet = Ggx { alpha }.sample(view, square);
                assert!((facet.length() - 1.0).abs() < 1e-12, "{alpha} {view:?} {square:?}");
                assert!(facet.z >= 0.0);
            }
        }
    }
}
