//! A measured intensity table.

use super::axis::Axis;
use super::check::{MAX_INTENSITY_CD, check};
use super::strip::{Strip, share_below, weights};
use super::{AngleSystem, Symmetry, WebError};
use isolux_geometry::{Direction, Vector};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Intensities over a grid of planes and polar angles, interpolated bilinearly in the angles;
/// in the system C periodically in the planes. Directions outside the angles given are dark.
///
/// In the system C planes and polar angles are C and gamma. In the systems A and B the polar axis lies
/// across the beam, see [`AngleSystem`].
///
/// The interpolated function is what the web *is*: its flux is the exact integral of it, and
/// [`Self::sample`] draws from it without rejection or weight.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Table", into = "Table")]
pub struct PhotometricWeb {
    /// Where the polar axis lies.
    system: AngleSystem,
    /// Planes, degrees; in the system C closed by the first plane a turn later.
    planes: Axis,
    gammas: Axis,
    /// `candela[plane * gammas + gamma]`.
    candela: Vec<f64>,
    /// Flux of each plane below each gamma, lm per radian of C; indexed as `candela`.
    below: Vec<f64>,
    /// Flux before each plane of the closed circle, lm.
    before: Vec<f64>,
}

/// The web as files hold it; everything else follows from it.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    #[serde(default, skip_serializing_if = "AngleSystem::is_c")]
    system: AngleSystem,
    planes_deg: Vec<f64>,
    gammas_deg: Vec<f64>,
    candela: Vec<f64>,
}

impl PhotometricWeb {
    /// Table over the full circle: increasing planes within 0 to 360 degrees (the plane at 360, if
    /// given, closes the circle; otherwise the first one does), increasing gamma angles within 0
    /// to 180 degrees, and `candela[plane * gammas + gamma]`.
    pub fn new(
        planes_deg: Vec<f64>,
        gammas_deg: Vec<f64>,
        candela: Vec<f64>,
    ) -> Result<Self, WebError> {
        Self::in_system(AngleSystem::C, planes_deg, gammas_deg, candela)
    }

    /// Table in a system of angles: for C as [`Self::new`]; for A and B at least two planes within 0 to 180
    /// degrees, of which the one at 90 holds the aim, and polar angles from the pole on.
    pub fn in_system(
        system: AngleSystem,
        planes_deg: Vec<f64>,
        gammas_deg: Vec<f64>,
        candela: Vec<f64>,
    ) -> Result<Self, WebError> {
        check(system, &planes_deg, &gammas_deg, &candela)?;
        let planes = if system.is_c() { closed(planes_deg) } else { Axis::new(planes_deg) };
        Ok(Self::tabulate(system, planes, Axis::new(gammas_deg), candela))
    }

    /// Table over the part of the circle that a symmetry leaves to be given.
    pub fn with_symmetry(
        planes_deg: Vec<f64>,
        gammas_deg: Vec<f64>,
        candela: Vec<f64>,
        symmetry: Symmetry,
    ) -> Result<Self, WebError> {
        check(AngleSystem::C, &planes_deg, &gammas_deg, &candela)?;
        let rows = candela.chunks(gammas_deg.len()).map(<[f64]>::to_vec);
        let whole = symmetry.complete(planes_deg.into_iter().zip(rows).collect());
        let (planes_deg, rows): (Vec<_>, Vec<_>) = whole.into_iter().unzip();
        Self::new(planes_deg, gammas_deg, rows.concat())
    }

    fn tabulate(system: AngleSystem, planes: Axis, gammas: Axis, candela: Vec<f64>) -> Self {
        let below = flux_below(&gammas, &candela);
        let mut web = Self { system, planes, gammas, candela, below, before: vec![0.0] };
        let mut sum = 0.0;
        for cell in 0..web.planes.cells() {
            let [low, high] = web.plane_flux(cell);
            sum += web.cell_width_rad(cell) * 0.5 * (low + high);
            web.before.push(sum);
        }
        web
    }

    /// Where its polar axis lies.
    pub fn system(&self) -> AngleSystem {
        self.system
    }

    /// Planes, degrees.
    pub fn planes_deg(&self) -> &[f64] {
        &self.planes.angles()[..self.candela.len() / self.gammas_deg().len()]
    }

    /// Angles from the pole, degrees; in the system C gamma angles.
    pub fn gammas_deg(&self) -> &[f64] {
        self.gammas.angles()
    }

    /// Intensities, cd: one row of gamma angles a plane.
    pub fn candela(&self) -> &[f64] {
        &self.candela
    }

    /// Direction, of length 1 in the luminaire's frame, and intensity, cd, of every entry of the table.
    pub fn nodes(&self) -> impl Iterator<Item = (Vector, f64)> {
        let rows = self.candela.chunks(self.gammas_deg().len()).zip(self.planes_deg());
        rows.flat_map(move |(row, plane)| {
            let c = plane.to_radians();
            row.iter().zip(self.gammas_deg()).map(move |(&cd, gamma)| {
                (self.system.luminaire_from_web(spherical(c, gamma.to_radians())), cd)
            })
        })
    }

    /// Highest intensity in any direction, cd; a bilinear function has it at a node.
    pub fn max_intensity_cd(&self) -> f64 {
        self.candela.iter().copied().fold(0.0, f64::max)
    }

    /// Intensity in a direction of the luminaire's frame, cd.
    pub fn intensity_cd(&self, local: Direction) -> f64 {
        let Vector { x, y, z } = self.system.web_from_luminaire(local.to_vector());
        let gamma = libm::atan2((x * x + y * y).sqrt(), -z).to_degrees();
        let Some((strip, up)) = self.gammas.locate(gamma) else { return 0.0 };
        let mut c = libm::atan2(y, x).to_degrees();
        while c < self.planes.first() {
            c += 360.0;
        }
        let Some((cell, across)) = self.planes.locate(c) else { return 0.0 };
        let [low, high] = self.intensities_cd(cell, across, strip);
        low + (high - low) * up
    }

    /// Flux, lm: the exact integral of the interpolated distribution.
    pub fn luminous_flux_lm(&self) -> f64 {
        self.before[self.planes.cells()]
    }

    /// Flux below an angle from the pole, lm; in the system C of the cone about nadir up to gamma.
    pub fn flux_below_lm(&self, gamma_deg: f64) -> f64 {
        let plane = |across: f64, cell: usize| self.plane_flux_below(cell, across, gamma_deg);
        let cell = |k: usize| self.cell_width_rad(k) * 0.5 * (plane(0.0, k) + plane(1.0, k));
        (0..self.planes.cells()).map(cell).sum::<f64>() + 0.0
    }

    /// Flux of a half-plane below an angle from the pole, lm per radian of C.
    fn plane_flux_below(&self, cell: usize, across: f64, gamma_deg: f64) -> f64 {
        let strips = self.gammas.cells();
        let Some((strip, _)) = self.gammas.locate(gamma_deg) else {
            let whole = gamma_deg > self.gammas.first();
            return if whole { self.mix(&self.below, cell, across, strips) } else { 0.0 };
        };
        let part = Strip {
            angles_rad: self.gammas.bounds(strip).map(f64::to_radians),
            intensities_cd: self.intensities_cd(cell, across, strip),
        };
        self.mix(&self.below, cell, across, strip) + part.below(gamma_deg.to_radians()).flux()
    }

    /// A direction in proportion to intensity, from two numbers of [0, 1); `None` if all is dark.
    ///
    /// Exact: `b` chooses C by the flux of the half-planes, whose density is linear between
    /// planes, then `a` chooses gamma in that half-plane, linear times sine between angles. Both
    /// maps are continuous and monotone, so that well distributed points stay so.
    pub fn sample(&self, [a, b]: [f64; 2]) -> Option<Direction> {
        let total = self.luminous_flux_lm();
        if total <= 0.0 {
            return None;
        }
        let (cell, across) = self.sample_plane(b * total);
        let gamma = self.sample_gamma(cell, across, a);
        let c = self.planes.bounds(cell)[0].to_radians() + across * self.cell_width_rad(cell);
        self.system.luminaire_from_web(spherical(c, gamma)).direction()
    }

    /// Every intensity multiplied by a factor >= 0; anything else counts as 0. Products beyond
    /// 1e30 cd stay there.
    pub fn scaled(&self, factor: f64) -> Self {
        let factor = factor.max(0.0);
        let scale = |cd: &f64| (cd * factor).min(MAX_INTENSITY_CD);
        let candela = self.candela.iter().map(scale).collect();
        Self::tabulate(self.system, self.planes.clone(), self.gammas.clone(), candela)
    }

    /// Where in C the flux before it is `flux`: a cell of the circle and the place inside.
    fn sample_plane(&self, flux: f64) -> (usize, f64) {
        let last = self.planes.cells() - 1;
        let cell = self.before.partition_point(|&f| f <= flux).saturating_sub(1).min(last);
        let share = (flux - self.before[cell]) / (self.before[cell + 1] - self.before[cell]);
        (cell, share_below(self.plane_flux(cell), share))
    }

    /// The gamma, rad, below which a half-plane holds a share of its flux.
    fn sample_gamma(&self, cell: usize, across: f64, share: f64) -> f64 {
        let below = |gamma: usize| self.mix(&self.below, cell, across, gamma);
        let strips = self.gammas.cells();
        let flux = share * below(strips);
        let (mut low, mut high) = (0, strips);
        while high - low > 1 {
            let middle = low.midpoint(high);
            if below(middle) <= flux { low = middle } else { high = middle }
        }
        let strip = Strip {
            angles_rad: self.gammas.bounds(low).map(f64::to_radians),
            intensities_cd: self.intensities_cd(cell, across, low),
        };
        strip.angle_below_which(flux - below(low))
    }

    /// Intensities at both ends of a strip, between the planes of a cell.
    fn intensities_cd(&self, cell: usize, across: f64, strip: usize) -> [f64; 2] {
        [strip, strip + 1].map(|gamma| self.mix(&self.candela, cell, across, gamma))
    }

    /// A value at a gamma angle, between the planes of a cell.
    fn mix(&self, values: &[f64], cell: usize, across: f64, gamma: usize) -> f64 {
        let count = self.gammas_deg().len();
        let next = if (cell + 1) * count < values.len() { cell + 1 } else { 0 };
        let (low, high) = (values[cell * count + gamma], values[next * count + gamma]);
        low + (high - low) * across
    }

    /// Flux of the half-planes on both sides of a cell, lm per radian of C.
    fn plane_flux(&self, cell: usize) -> [f64; 2] {
        [0.0, 1.0].map(|across| self.mix(&self.below, cell, across, self.gammas.cells()))
    }

    fn cell_width_rad(&self, cell: usize) -> f64 {
        let [low, high] = self.planes.bounds(cell);
        (high - low) * (PI / 180.0)
    }
}

/// The direction at C and gamma, rad.
fn spherical(c: f64, gamma: f64) -> Vector {
    let (sin_c, cos_c) = libm::sincos(c);
    let (sin_gamma, cos_gamma) = libm::sincos(gamma);
    Vector::new(sin_gamma * cos_c, sin_gamma * sin_c, -cos_gamma)
}

/// The circle closed by its first plane, unless the file closed it.
fn closed(mut planes_deg: Vec<f64>) -> Axis {
    let turn = planes_deg[0] + 360.0;
    if planes_deg.last().is_some_and(|&last| last < turn) {
        planes_deg.push(turn);
    }
    Axis::new(planes_deg)
}

/// Running sums of each plane's flux, lm per radian of C.
fn flux_below(gammas: &Axis, candela: &[f64]) -> Vec<f64> {
    let weights: Vec<_> =
        (0..gammas.cells()).map(|k| weights(gammas.bounds(k).map(f64::to_radians))).collect();
    let mut below = Vec::with_capacity(candela.len());
    for row in candela.chunks(gammas.cells() + 1) {
        let mut sum = 0.0;
        below.push(sum);
        for ([low, high], ends) in weights.iter().zip(row.windows(2)) {
            sum += low * ends[0] + high * ends[1];
            below.push(sum);
        }
    }
    below
}

impl TryFrom<Table> for PhotometricWeb {
    type Error = WebError;
    fn try_from(table: Table) -> Result<Self, WebError> {
        Self::in_system(table.system, table.planes_deg, table.gammas_deg, table.candela)
    }
}

impl From<PhotometricWeb> for Table {
    fn from(web: PhotometricWeb) -> Self {
        Self {
            system: web.system,
            planes_deg: web.planes_deg().to_vec(),
            gammas_deg: web.gammas_deg().to_vec(),
            candela: web.candela,
        }
    }
}
