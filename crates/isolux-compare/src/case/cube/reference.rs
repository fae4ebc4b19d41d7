//! The illuminance of CUBE to eight digits and more, without random numbers.
//!
//! Kopylov, Khodulev, Volevich (1998, 2.1) obtained their "semi-theoretical" table by one direct
//! integration over a Monte Carlo map. Here the integral equation is solved: collocation with
//! product integration on panels graded towards the edges ([`super::line`]), Krylov iteration, and
//! one last integration at the place asked for (Nystrom's interpolation), which is more accurate than
//! the collocated function itself. On an edge the limit from inside the face is taken: the adjacent
//! face at zero distance fills half of the hemisphere (three quarters in a corner) with the very
//! radiosity sought, `E = (D + distant) / (1 - rho contact)`.

use super::krylov::Krylov;
use super::line::Resolution;
use super::room::{HALF_EDGE_M, INTENSITY_CD, REFLECTANCE};
use super::transport::Transport;
use std::sync::{Arc, LazyLock};

/// The solution of CUBE for one reflectance, anywhere on a face.
#[derive(Clone, Debug)]
pub struct CubeReference {
    reflectance: f64,
    space: Arc<CubeSpace>,
    /// At the nodes, lx.
    illuminance: Vec<f64>,
    residual: f64,
}

/// Illuminance at a place, lx.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CubeIlluminance {
    /// From the luminaire.
    pub direct_lx: f64,
    /// From the faces.
    pub indirect_lx: f64,
}

impl CubeIlluminance {
    /// Both, lx.
    pub fn total_lx(self) -> f64 {
        self.direct_lx + self.indirect_lx
    }
}

/// How the face is resolved at run time: an error below 1e-8 (see the tests).
const RUN_TIME: Resolution =
    Resolution { panels: 6, first_order: 10, last_order: 6, tolerance: 1e-9 };

/// Applications of the operator: each divides the residual by about six.
const KRYLOV_SIZE: usize = 13;

/// What all reflectances share.
#[derive(Debug)]
struct CubeSpace {
    transport: Transport,
    krylov: Krylov,
}

impl CubeSpace {
    fn new(resolution: Resolution) -> Self {
        let transport = Transport::new(resolution);
        let nodes = transport.nodes();
        let direct: Vec<f64> =
            nodes.iter().flat_map(|&y| nodes.iter().map(move |&x| direct_lx(x, y))).collect();
        let krylov = Krylov::new(&transport, &direct, KRYLOV_SIZE);
        Self { transport, krylov }
    }
}

/// CUBE as published: reflectance 2/3. Computed once, in less than half a second on two threads.
pub fn cube_reference() -> &'static CubeReference {
    static REFERENCE: LazyLock<CubeReference> =
        LazyLock::new(|| CubeReference::with_reflectance(REFLECTANCE));
    &REFERENCE
}

impl CubeReference {
    /// CUBE with walls of another reflectance, 0 to 0.9.
    pub fn with_reflectance(reflectance: f64) -> Self {
        static SPACE: LazyLock<Arc<CubeSpace>> =
            LazyLock::new(|| Arc::new(CubeSpace::new(RUN_TIME)));
        Self::over(SPACE.clone(), reflectance)
    }

    fn over(space: Arc<CubeSpace>, reflectance: f64) -> Self {
        let (illuminance, residual) = space.krylov.solve(reflectance);
        Self { reflectance, space, illuminance, residual }
    }

    /// Reflectance of the walls.
    pub fn reflectance(&self) -> f64 {
        self.reflectance
    }

    /// Root mean square residual of the collocated equations, relative to the solution.
    pub fn residual(&self) -> f64 {
        self.residual
    }

    /// The illuminance at a place of a face, in its own coordinates: (0, 0) in the middle, edges at
    /// +-1; beyond them the nearest place.
    pub fn at(&self, x: f64, y: f64) -> CubeIlluminance {
        let (x, y) = (x.clamp(-1.0, 1.0), y.clamp(-1.0, 1.0));
        let direct_lx = direct_lx(x, y);
        let received = self.space.transport.receive(x, y, &self.illuminance);
        let total_lx = (direct_lx + self.reflectance * received.distant)
            / (1.0 - self.reflectance * received.contact);
        CubeIlluminance { direct_lx, indirect_lx: total_lx - direct_lx }
    }

    /// The mean illuminance of the collocated solution.
    pub fn mean_illuminance_lx(&self) -> f64 {
        let one = vec![1.0; self.illuminance.len()];
        self.space.transport.mean_product(&self.illuminance, &one)
    }
}

/// Direct illuminance at a place of a face: inverse square and cosine.
pub fn direct_lx(x: f64, y: f64) -> f64 {
    let r2 = 1.0 + x * x + y * y;
    INTENSITY_CD / (HALF_EDGE_M * HALF_EDGE_M) / (r2 * r2.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::cube::room::TABLE_1;
    use crate::tolerance::{CUBE_REFERENCE, PRINTED_SIX_DIGITS, PRINTED_TENTH};
    use std::f64::consts::PI;

    fn solved(resolution: Resolution) -> CubeReference {
        CubeReference::over(Arc::new(CubeSpace::new(resolution)), REFLECTANCE)
    }

    /// Largest relative difference over the points of the table and some near edges.
    fn distance(a: &CubeReference, b: &CubeReference) -> f64 {
        let near_edges = [(0.99, 0.3), (0.97, 0.98), (0.3, 0.9)];
        let table = TABLE_1.iter().map(|p| (p.x, p.y));
        table
            .chain(near_edges)
            .map(|(x, y)| (a.at(x, y).total_lx() / b.at(x, y).total_lx() - 1.0).abs())
            .fold(0.0, f64::max)
    }

    #[test]
    fn converges_under_refinement() {
        let finest = cube_reference();
        let of = |panels, first_order, last_order, tolerance| {
            solved(Resolution { panels, first_order, last_order, tolerance })
        };
        let errors = [of(2, 4, 2, 1e-4), of(4, 6, 3, 1e-6), of(6, 8, 4, 1e-8)]
            .map(|coarse| distance(&coarse, finest));
        assert!(errors[1] < 0.1 * errors[0] && errors[2] < 0.1 * errors[1], "{errors:?}");
        let finer = of(8, 11, 6, 1e-10);
        let error = distance(finest, &finer);
        assert!(error < CUBE_REFERENCE, "{error:e}");
    }

    #[test]
    fn a_closed_cube_receives_all_that_it_sends() {
        let transport = Transport::new(RUN_TIME);
        let count = transport.nodes().len().pow(2);
        for share in transport.apply(&vec![1.0; count]) {
            assert!((share - 1.0).abs() < CUBE_REFERENCE, "{share}");
        }
    }

    #[test]
    fn absorbed_flux_is_the_flux_of_the_luminaire() {
        for reflectance in [0.0, 0.3, REFLECTANCE, 0.9] {
            let reference = CubeReference::with_reflectance(reflectance);
            let area_m2 = 6.0 * 4.0 * HALF_EDGE_M * HALF_EDGE_M;
            let expected = 4.0 * PI * INTENSITY_CD / area_m2 / (1.0 - reflectance);
            let found = reference.mean_illuminance_lx();
            assert!((found / expected - 1.0).abs() < CUBE_REFERENCE, "{found} {expected}");
            assert!(reference.residual() < CUBE_REFERENCE);
        }
    }

    #[test]
    fn table_1_is_right_but_for_the_last_digit_of_c() {
        for point in &TABLE_1 {
            let total_lx = cube_reference().at(point.x, point.y).total_lx();
            let luminance_cd_m2 = REFLECTANCE * total_lx / PI;
            let agrees = (luminance_cd_m2 - point.luminance_cd_m2).abs() <= PRINTED_TENTH;
            assert_eq!(agrees, point.name != 'C', "{} {luminance_cd_m2}", point.name);
        }
    }

    /// From the solution with 8 panels of 11 to 6 nodes.
    #[test]
    fn nine_digits_are_those_of_the_finest_solution() {
        let luminances_cd_m2 =
            [892.798_101, 768.694_704, 686.697_453, 565.097_479, 522.413_779, 388.445_535];
        for (point, expected) in TABLE_1.iter().zip(luminances_cd_m2) {
            let found = REFLECTANCE * cube_reference().at(point.x, point.y).total_lx() / PI;
            assert!((found - expected).abs() < PRINTED_SIX_DIGITS, "{} {found}", point.name);
        }
    }

    #[test]
    fn edges_are_the_limit_of_places_near_them() {
        // The illuminance approaches its limit like the square root of the distance or faster.
        for (y, inside) in [(0.0, 0.0), (0.5, 0.5), (1.0, 1.0 - 1e-5)] {
            let edge = cube_reference().at(1.0, y).total_lx();
            let near = cube_reference().at(1.0 - 1e-5, inside).total_lx();
            assert!((near / edge - 1.0).abs() < 1e-5_f64.sqrt(), "{y}: {near} {edge}");
        }
    }
}
