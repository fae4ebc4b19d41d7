//! Every tolerance, named by its cause.

/// A few dozen roundings of numbers around one.
pub const ROUNDING: f64 = 1e-14;

/// Numbers printed with six digits after the point, in tests: half of the last, and our rounding of it.
pub const PRINTED_SIX_DIGITS: f64 = 1e-6;

/// Numbers printed with four digits after the point: half of the last.
pub const PRINTED_FOUR_DIGITS: f64 = 5e-5;

/// Luminances printed with one digit after the point: half of it.
pub const PRINTED_TENTH: f64 = 0.05;

/// Relative error of the CUBE reference at run time. Measured against the next finer resolution
/// over the points of Table 1 and places near edges (4e-9), and by the balance of flux (2e-9).
pub const CUBE_REFERENCE: f64 = 1e-8;

/// Relative error of Gauss quadratures that were doubled until they no longer changed.
pub const QUADRATURE: f64 = 1e-11;

/// Share of its largest coordinate by which a reader may move a place: on the rim of a triangle 64
/// roundings of `f32` inwards, so that it is not in the wall that meets it there (8e-6).
pub const PLACE_ON_RIM: f64 = 1e-5;

/// Relative error of direct light from that, where light changes no faster than the inverse cube of a
/// distance of half the coordinates: luminaires stand no nearer in the cases here.
pub const RAY_KERNEL_POSITION: f64 = 6.0 * PLACE_ON_RIM;

/// A reading lies within this many standard errors ...
pub const STANDARD_ERRORS: f64 = 3.0;

/// ... and within this many times the error of discretization and bias that the map reports for the
/// scene as a whole: a place may err more than the root mean square over all.
pub const PLACE_OVER_SCENE: f64 = 3.0;

/// Light of emitting surfaces is read afresh by eight independent estimates, less one.
pub const DIRECT_FREEDOM: f64 = 7.0;

/// A verdict may be wrong by chance this often.
pub const SIGNIFICANCE: f64 = 1e-4;

/// The interval whose coverage is counted.
pub const COVERAGE: f64 = 0.95;

/// Relative error of a disc replaced by a polygon of 256 corners and the same area: the border is
/// off by (pi / 256)^2 / 3 of the radius, up and down in turn. Measured over the receivers of the tests.
pub const DISC_POLYGON: f64 = 1e-6;

/// Relative error of the flux on walls and floor from four Gauss nodes each way, as `cie171_5_4` reads them: measured.
pub const FLUX_ON_GRID: f64 = 2e-3;

/// Relative error of light through a window by the midpoints of 400 by 400 cells of it, in tests: the second order of the
/// midpoint rule. Measured.
pub const WINDOW_QUADRATURE: f64 = 1e-4;

/// Share of the light through a window that rays of a grid of it tell wrongly where an edge of the sky crosses their
/// cells, in tests: half a row of 80 in a part of the light.
pub const RAYS_PAST_EDGES: f64 = 0.0125;

/// Largest relative difference between the overcast sky of type 1 and that of Moon and Spencer (1942) from 20 degrees above
/// the horizon on. Measured.
pub const MOON_SPENCER: f64 = 0.11;
