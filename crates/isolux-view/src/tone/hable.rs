//! The filmic curve of Hable 2010.

/// Exposure before the curve.
const BIAS: f64 = 2.0;
/// What the curve shows as white.
const LINEAR_WHITE: f64 = 11.2;

/// One channel.
pub(super) fn show(exposed: f64) -> f64 {
    curve(BIAS * exposed) / curve(LINEAR_WHITE)
}

fn curve(x: f64) -> f64 {
    const A_SHOULDER: f64 = 0.15;
    const B_LINEAR: f64 = 0.50;
    const C_ANGLE: f64 = 0.10;
    const D_TOE: f64 = 0.20;
    const E_TOE_NUMERATOR: f64 = 0.02;
    const F_TOE_DENOMINATOR: f64 = 0.30;
    let numerator = x * (A_SHOULDER * x + C_ANGLE * B_LINEAR) + D_TOE * E_TOE_NUMERATOR;
    let denominator = x * (A_SHOULDER * x + B_LINEAR) + D_TOE * F_TOE_DENOMINATOR;
    numerator / denominator - E_TOE_NUMERATOR / F_TOE_DENOMINATOR
}
