//! Views traced over a map.

use crate::caller;
use crate::failure::Failure;
use crate::meter::Meter;
use crate::quantity::significant;
use isolux::map::IlluminationMap;
use isolux::scene::Scene;
use isolux_view::{
    Gathered, LuminanceImage, MapViewer, Noise, Size, SurfacePoint, TraceSettings, View,
    ViewProgress, Window, trace_watched,
};

/// Walls of one side only are looked through from outside.
pub(crate) const SETTINGS: TraceSettings =
    TraceSettings { through_black_backs: true, ..TraceSettings::FINE };

/// Kinds of work on a view, and the share of its time that each takes, roughly: what a round has in its line of progress.
const SHARES: [f64; 3] = [0.3, 0.4, 0.3];

/// How far the rounds of a picture are.
pub(crate) struct RoundsState {
    pub(crate) noise: Noise,
    /// The mean noise that is wished for, CIE94.
    pub(crate) goal: f64,
    /// The rounds that this is expected to take.
    pub(crate) of: u32,
}

impl RoundsState {
    /// For the line of progress of a round.
    fn of_round(&self, round: u32) -> String {
        let [noise, goal] = [self.noise.mean, self.goal].map(|value| significant(value, 2));
        format!("view, noise {noise} of {goal} CIE94, round {} of {}", round + 1, self.of)
    }
}

/// A map whose views are traced while the user is told how far that is.
pub(crate) struct Watched<'a>(MapViewer<'a>);

impl<'a> Watched<'a> {
    pub(crate) fn new(scene: &'a Scene, map: &'a IlluminationMap) -> Self {
        Self(MapViewer::new(scene, map))
    }

    /// Traces a view: direct light evaluated afresh, indirect light gathered where the map is not to be trusted. Rounds have
    /// independent noise.
    pub(crate) fn round(
        &self,
        (view, size): (View, Size),
        round: u32,
        state: Option<&RoundsState>,
    ) -> Result<(LuminanceImage, Gathered), Failure> {
        let settings = TraceSettings { round: u64::from(round), ..SETTINGS };
        let traced = match state {
            None => {
                let mut lighting = Meter::new("direct light of the view", None);
                let mut gathering = Meter::new("indirect light of the view", None);
                let mut looking = Meter::new("view", None);
                let watch = &mut |progress| match progress {
                    ViewProgress::Lighting(share) => lighting.tell(share),
                    ViewProgress::Gathering(share) => gathering.tell(share),
                    ViewProgress::Looking(share) => looking.tell(share),
                };
                self.0.trace(view, size, (&settings, watch))
            }
            Some(state) => {
                let mut meter = Meter::new(state.of_round(round), None);
                let watch = &mut |progress| meter.tell(share_of_round(progress));
                self.0.trace(view, size, (&settings, watch))
            }
        };
        traced.map_err(Failure::bad_input)
    }

    /// The same of a few pixels, of which nobody waits to be told.
    pub(crate) fn glimpse(
        &self,
        (view, size): (View, Size),
        round: u32,
    ) -> Result<LuminanceImage, Failure> {
        let settings = TraceSettings { round: u64::from(round), ..SETTINGS };
        let traced = self.0.trace(view, size, (&settings, &mut |_| {}));
        traced.map(|(image, _)| image).map_err(Failure::bad_input)
    }

    /// Traces windows of the same size of a view, as its round 1.
    pub(crate) fn windows(
        &self,
        (view, size): (View, Size),
        windows: Vec<Window>,
    ) -> Result<Vec<(Window, LuminanceImage)>, Failure> {
        let mut meter = Meter::new("noise of the view", None);
        let count = windows.len() as f64;
        let trace = |(index, window)| {
            meter.tell(index as f64 / count);
            let settings = TraceSettings { round: 1, window: Some(window), ..SETTINGS };
            let (image, _) = self.0.trace(view, size, (&settings, &mut |_| {}))?;
            Ok((window, image))
        };
        windows
            .into_iter()
            .enumerate()
            .map(trace)
            .collect::<Result<_, _>>()
            .map_err(|problem: isolux_view::ViewError| Failure::bad_input(problem))
    }
}

fn share_of_round(progress: ViewProgress) -> f64 {
    let [lighting, gathering, looking] = SHARES;
    match progress {
        ViewProgress::Lighting(share) => lighting * share,
        ViewProgress::Gathering(share) => lighting + gathering * share,
        ViewProgress::Looking(share) => lighting + gathering + looking * share,
    }
}

/// Traces a view over a map in one round.
pub(crate) fn view(
    scene: &Scene,
    map: &IlluminationMap,
    view: impl Into<View>,
    (width, height): (u32, u32),
) -> Result<(LuminanceImage, Gathered), Failure> {
    let size = Size::new(width, height).map_err(Failure::bad_input)?;
    Watched::new(scene, map).round((view.into(), size), 0, None)
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
    trace_watched(scene, view, size, &SETTINGS, (&read, &mut |_| caller::look()))
        .map_err(Failure::bad_input)
}
