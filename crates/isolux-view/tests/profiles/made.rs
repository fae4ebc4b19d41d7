//! ICC files made for tests. All of them describe the display of sRGB, so that what they say is known.

use isolux::units::Rgb;
use isolux_view::MonitorProfile;
use moxcms::{
    ColorProfile, DataColorSpace, LutDataType, LutMultidimensionalType, LutStore, LutType,
    LutWarehouse, Matrix3d, ToneReprCurve, Vector3d,
};

/// XYZ of 1 in tables, which go to 1 + 32767/32768.
pub(crate) const XYZ_RANGE: f64 = 1.0 + 32767.0 / 32768.0;

/// Curves and primaries.
pub(crate) fn with_primaries() -> Vec<u8> {
    ColorProfile::new_srgb().encode().unwrap()
}

/// A gamma for each channel and no other name: an old tube.
pub(crate) fn with_gammas(gammas: [f32; 3]) -> Vec<u8> {
    let mut profile = ColorProfile::new_srgb();
    let [red, green, blue] = gammas.map(|gamma| Some(ToneReprCurve::Parametric(vec![gamma])));
    (profile.red_trc, profile.green_trc, profile.blue_trc) = (red, green, blue);
    profile.cicp = None;
    profile.encode().unwrap()
}

/// Tables of 16 bits to XYZ and back, whose grids have corners alone.
pub(crate) fn with_tables_of_xyz() -> Vec<u8> {
    let to = matrix();
    let corner = |code: [f64; 3]| to.apply(code).map(|v| v / XYZ_RANGE);
    let a_to_b = sampled(2, linear, corner, |v| v);
    let from = to.inverse().scaled(XYZ_RANGE);
    let mut b_to_a = sampled(2, |v| v, |xyz| xyz, signal);
    b_to_a.matrix = Matrix3d { v: from.0 };
    encoded(DataColorSpace::Xyz, LutWarehouse::Lut(a_to_b), LutWarehouse::Lut(b_to_a))
}

/// Tables of 16 bits to CIE Lab and back, of so many corners along each side.
pub(crate) fn with_tables_of_lab(corners: u8) -> Vec<u8> {
    let to = matrix();
    let from = to.inverse();
    let lab = |signals: [f64; 3]| legacy_lab(to.apply(signals.map(linear)));
    // Signals from -1/2 to 3/2, cut off behind the grid: not at corners, which would bend what lies between.
    let signals =
        |lab: [f64; 3]| from.apply(xyz_from_legacy_lab(lab)).map(|v| (signal(v) + 0.5) / 2.0);
    let a_to_b = sampled(corners, |v| v, lab, |v| v);
    let b_to_a = sampled(corners, |v| v, signals, |v| 2.0 * v - 0.5);
    encoded(DataColorSpace::Lab, LutWarehouse::Lut(a_to_b), LutWarehouse::Lut(b_to_a))
}

/// Curves and a matrix in a table of the kind that has them, without a grid.
pub(crate) fn with_curves_in_tables() -> Vec<u8> {
    let curves = |parameters: [f32; 5]| vec![ToneReprCurve::Parametric(parameters.to_vec()); 3];
    let plain = vec![ToneReprCurve::Parametric(vec![1.0]); 3];
    let table = |m_curves, matrix: Matrix| LutMultidimensionalType {
        num_input_channels: 3,
        num_output_channels: 3,
        grid_points: [0; 16],
        clut: None,
        a_curves: Vec::new(),
        b_curves: plain.clone(),
        m_curves,
        matrix: Matrix3d { v: matrix.0 },
        bias: Vector3d::default(),
    };
    let eotf = [2.4, 1.0 / 1.055, 0.055 / 1.055, 1.0 / 12.92, 0.04045];
    // (1.055^2.4 x)^(1/2.4) - 0.055 and 12.92 x.
    let a = 1.055_f32.powf(2.4);
    let oetf =
        vec![
            ToneReprCurve::Parametric(vec![1.0 / 2.4, a, 0.0, 12.92, 0.003_130_8, -0.055, 0.0]);
            3
        ];
    let to = table(curves(eotf), matrix().scaled(1.0 / XYZ_RANGE));
    let from = table(oetf, matrix().inverse().scaled(XYZ_RANGE));
    let [to, from] = [to, from].map(LutWarehouse::Multidimensional);
    encoded(DataColorSpace::Xyz, to, from)
}

fn encoded(pcs: DataColorSpace, to: LutWarehouse, from: LutWarehouse) -> Vec<u8> {
    let mut profile = ColorProfile::new_srgb();
    profile.pcs = pcs;
    profile.cicp = None;
    profile.lut_a_to_b_colorimetric = Some(to);
    profile.lut_b_to_a_perceptual = Some(from);
    // What tables say counts, not these.
    let falling = ToneReprCurve::Lut(vec![u16::MAX, 0]);
    profile.red_trc = Some(falling);
    profile.encode().unwrap()
}

/// A table of 16 bits: curves of 4096 steps about a grid.
fn sampled(
    corners: u8,
    before: impl Fn(f64) -> f64,
    grid: impl Fn([f64; 3]) -> [f64; 3],
    after: impl Fn(f64) -> f64,
) -> LutDataType {
    const STEPS: u16 = 4096;
    let curve = |f: &dyn Fn(f64) -> f64| {
        let step = |k: u16| part(f(f64::from(k % STEPS) / f64::from(STEPS - 1)));
        LutStore::Store16((0..3 * STEPS).map(step).collect())
    };
    let side = |k: u8| f64::from(k) / f64::from(corners - 1);
    let mut clut = Vec::new();
    for i in 0..corners {
        for j in 0..corners {
            for k in 0..corners {
                clut.extend(grid([side(i), side(j), side(k)]).map(part));
            }
        }
    }
    LutDataType {
        num_input_channels: 3,
        num_output_channels: 3,
        num_clut_grid_points: corners,
        matrix: Matrix3d::IDENTITY,
        num_input_table_entries: STEPS,
        num_output_table_entries: STEPS,
        input_table: curve(&before),
        clut_table: LutStore::Store16(clut),
        output_table: curve(&after),
        lut_type: LutType::Lut16,
    }
}

fn part(value: f64) -> u16 {
    (65535.0 * value.clamp(0.0, 1.0) + 0.5) as u16
}

fn linear(signal: f64) -> f64 {
    if signal <= 0.04045 { signal / 12.92 } else { ((signal + 0.055) / 1.055).powf(2.4) }
}

fn signal(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// White of the connection space.
const D50: [f64; 3] = [0.9642, 1.0, 0.8249];

/// Numbers of tables of 16 bits for XYZ under D50: CIE Lab in parts of 65280.
fn legacy_lab(xyz: [f64; 3]) -> [f64; 3] {
    let f = |t: f64| if t > 0.008_856 { t.cbrt() } else { 7.787 * t + 16.0 / 116.0 };
    let [x, y, z] = [0, 1, 2].map(|k| f(xyz[k] / D50[k]));
    let steps = [652.8 * (116.0 * y - 16.0), 128_000.0 * (x - y), 51_200.0 * (y - z)];
    [steps[0] / 65535.0, (steps[1] + 32768.0) / 65535.0, (steps[2] + 32768.0) / 65535.0]
}

fn xyz_from_legacy_lab(numbers: [f64; 3]) -> [f64; 3] {
    let [l, a, b] = numbers.map(|v| 65535.0 * v / 256.0);
    let y = (100.0 * l / 255.0 + 16.0) / 116.0;
    let f = |t: f64| if t > 0.206_893 { t.powi(3) } else { (t - 16.0 / 116.0) / 7.787 };
    let shares = [y + (a - 128.0) / 500.0, y, y - (b - 128.0) / 200.0].map(f);
    [0, 1, 2].map(|k| shares[k] * D50[k])
}

/// From linear sRGB to XYZ under D50.
fn matrix() -> Matrix {
    Matrix(ColorProfile::new_srgb().colorant_matrix().v)
}

struct Matrix([[f64; 3]; 3]);

impl Matrix {
    fn apply(&self, v: [f64; 3]) -> [f64; 3] {
        self.0.map(|row| (0..3).map(|k| row[k] * v[k]).sum())
    }

    fn inverse(&self) -> Self {
        Self(Matrix3d { v: self.0 }.inverse().v)
    }

    fn scaled(self, factor: f64) -> Self {
        Self(self.0.map(|row| row.map(|v| factor * v)))
    }
}

/// Codes of all corners, of greys, and of some hundred colours between.
pub(crate) fn codes() -> impl Iterator<Item = [u8; 3]> {
    let steps = [0, 1, 17, 64, 128, 200, 254, 255];
    let mixed = steps.into_iter().flat_map(move |r| {
        steps.into_iter().flat_map(move |g| steps.into_iter().map(move |b| [r, g, b]))
    });
    (0..=255).map(|grey| [grey; 3]).chain(mixed)
}

/// How far codes are from where they were, at most, after they became colours and codes again.
pub(crate) fn farthest(profile: &MonitorProfile) -> u8 {
    let off = |code: [u8; 3]| {
        let back = profile.code_from_linear(profile.linear_from_code(code));
        back.into_iter().zip(code).map(|(b, c)| b.abs_diff(c)).max().unwrap_or(0)
    };
    codes().map(off).max().unwrap()
}

/// How far two profiles are from each other in linear colours at most.
pub(crate) fn apart(a: &MonitorProfile, b: &MonitorProfile) -> f64 {
    let off = |code: [u8; 3]| {
        let [Rgb(a), Rgb(b)] = [a, b].map(|profile| profile.linear_from_code(code));
        a.into_iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    codes().map(off).fold(0.0, f64::max)
}
