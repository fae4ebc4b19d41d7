//! How fine the surfaces are divided to have a number of triangles.

use super::solid::Solid;

/// Longer than anything in the hall times what divides coarsest: nothing is divided.
const UNDIVIDED_M: f64 = 100.0;
/// Finer than any variant needs.
const FINEST_M: f64 = 1e-4;
/// Halvings that tell 100 m from 100 m less one rounding.
const HALVINGS: u32 = 60;

/// The longest edge each solid may have, so that together they have at most so many triangles:
/// one length for all, the largest number that is not exceeded, and a hair less for the first ones
/// as long as that fits.
pub(super) fn edge_lengths_m(solids: &[Solid], triangles: u32) -> Vec<f64> {
    let total = |size_m: f64| solids.iter().map(|s| s.triangles(size_m)).sum::<u64>();
    let most = u64::from(triangles);
    let (mut fits_m, mut exceeds_m) = (UNDIVIDED_M, FINEST_M);
    for _ in 0..HALVINGS {
        let middle_m = 0.5 * (fits_m + exceeds_m);
        if total(middle_m) <= most { fits_m = middle_m } else { exceeds_m = middle_m }
    }
    let mut left = most.saturating_sub(total(fits_m));
    let choose = |solid: &Solid| {
        let more = solid.triangles(exceeds_m) - solid.triangles(fits_m);
        if more > left {
            return fits_m;
        }
        left -= more;
        exceeds_m
    };
    solids.iter().map(choose).collect()
}
