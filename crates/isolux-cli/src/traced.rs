//! Views traced over a map.

use crate::failure::Failure;
use crate::meter::Meter;
use isolux::map::IlluminationMap;
use isolux::scene::Scene;
use isolux_view::{
    Gathered, LuminanceImage, Size, SurfacePoint, TraceSettings, View, ViewProgress, trace,
    trace_map,
};

/// Walls of one side only are looked through from outside.
pub(crate) const SETTINGS: TraceSettings =
    TraceSettings { through_black_backs: true, ..TraceSettings::FINE };

/// Traces a view over a map: direct light evaluated afresh, indirect light gathered where the map is not to be trusted.
pub(crate) fn view(
    scene: &Scene,
    map: &IlluminationMap,
    view: impl Into<View>,
    (width, height): (u32, u32),
) -> Result<(LuminanceImage, Gathered), Failure> {
    let size = Size::new(width, height).map_err(Failure::bad_input)?;
    let mut lighting = Meter::new("direct light of the view", None);
    let mut gathering = Meter::new("indirect light of the view", None);
    let mut looking = Meter::new("view", None);
    let watch = &mut |progress| match progress {
        ViewProgress::Lighting(share) => lighting.tell(share),
        ViewProgress::Gathering(share) => gathering.tell(share),
        ViewProgress::Looking(share) => looking.tell(share),
    };
    trace_map((scene, map), view, size, (&SETTINGS, watch)).map_err(Failure::bad_input)
}

/// The same of the bare map, all light interpolated.
pub(crate) fn bare(
    scene: &Scene,
    map: &IlluminationMap,
    view: impl Into<View>,
    (width, height): (u32, u32),
) -> Result<LuminanceImage, Failure> {
    let size = Size::new(width, height).map_err(Failure::bad_input)?;
    let read = |at: SurfacePoint| map.interpolate(at.triangle, at.back, at.u, at.v);
    trace(scene, view, size, &SETTINGS, &read).map_err(Failure::bad_input)
}
