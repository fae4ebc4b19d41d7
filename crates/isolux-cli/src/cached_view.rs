//! Views of a scene whose indirect light comes from a cache.

use crate::cache_samples;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::meter::Meter;
use crate::notes::{Note, note};
use crate::quantity::{show_count, show_seconds};
use crate::traced::SETTINGS;
use isolux::engine::{
    CacheReader, CacheSettings, CachedPlace, IrradianceCache, SampleKind, Served,
};
use isolux::scene::Scene;
use isolux_formats::counted;
use isolux_view::{LuminanceImage, Size, SurfacePoint, TraceSettings, View, trace, trace_watched};
use serde::Serialize;
use std::path::Path;
use std::sync::Mutex;
use std::time::Instant;

/// What the cache gave and what was added.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct CacheUse {
    /// The file.
    cache: String,
    /// Samples that were there.
    samples_found: usize,
    /// Samples that were made for this view.
    samples_made: usize,
    /// Of those, the ones that are read; the others are read by rays.
    samples_made_to_read: usize,
    /// Rays traced for them.
    rays: u64,
    /// Time that took, s.
    samples_time_s: f64,
    /// Time of the view itself, its direct light included, s.
    view_time_s: f64,
}

impl CacheUse {
    /// For people.
    pub(crate) fn facts(&self) -> [(&'static str, String); 3] {
        let found = counted(self.samples_found, "sample", "samples");
        let made = self.samples_made;
        let times = [self.samples_time_s, self.view_time_s].map(show_seconds);
        [
            ("cache", format!("{}: {found} found, {made} made", self.cache)),
            ("rays for samples", show_count(self.rays as f64)),
            ("time", format!("{} for samples, {} for the view", times[0], times[1])),
        ]
    }
}

/// Traces a view; makes the samples that it still needs and keeps them in the file. No view if the user stops that: those made
/// until then are kept, and it is said.
pub(crate) fn look(
    scene: &Scene,
    view: View,
    (width, height): (u32, u32),
    (path, accuracy): (&Path, f64),
) -> Result<Option<(LuminanceImage, CacheUse)>, Failure> {
    let interrupt = Interrupt::install()?;
    interrupt.has_more_to_keep();
    let size = Size::new(width, height).map_err(Failure::bad_input)?;
    let started = Instant::now();
    let (mut file, cache) = cache_samples::open(path, scene, cache_samples::MAX_CACHE_BYTES)?;
    let mut reader = CacheReader::new(scene, &cache, CacheSettings::for_accuracy(accuracy))
        .map_err(|error| cache_samples::impossible(path, &error))?;
    if reader.leaves_caustics() {
        note(
            Note::Warning,
            "light that glass, gloss and curved mirrors throw on surfaces is left out of a view by a cache; \
             solve for a map to see it",
        );
    }
    let asked = Mutex::new(Vec::new());
    // A first look in the dark finds what is in view; it costs little, as no light is evaluated, that of luminaires in gloss neither.
    let in_the_dark = TraceSettings { highlights: false, ..SETTINGS };
    let ask = |at: SurfacePoint| {
        asked.lock().unwrap_or_else(std::sync::PoisonError::into_inner).push(place(at));
        None
    };
    trace(scene, view, size, &in_the_dark, &ask).map_err(Failure::bad_input)?;
    let asked = asked.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    let served = reader.serve_until(&asked, &|| interrupt.is_requested());
    cache_samples::keep(&mut file, &served.made);
    if !served.is_whole {
        tell_interrupted(path, &served);
        return Ok(None);
    }
    interrupt.has_nothing_more_to_keep();
    let samples_time_s = started.elapsed().as_secs_f64();
    let mut meter = Meter::new("view", None);
    let read = |at: SurfacePoint| reader.glance(&place(at), 0);
    let watch = &mut |share| meter.tell(share);
    let view = trace_watched(scene, view, size, &SETTINGS, (&read, watch));
    let view = view.map_err(Failure::bad_input)?;
    let count = |cache: &IrradianceCache| cache.samples.len();
    let found = CacheUse {
        cache: path.display().to_string(),
        samples_found: count(&cache),
        samples_made: count(&served.made),
        samples_made_to_read: served.made.count(SampleKind::Near),
        rays: served.rays,
        samples_time_s,
        view_time_s: started.elapsed().as_secs_f64() - samples_time_s,
    };
    Ok(Some((view, found)))
}

fn tell_interrupted(path: &Path, served: &Served) {
    let (made, path) = (served.made.samples.len(), path.display());
    let kept = match made {
        0 => "no sample was whole yet".to_owned(),
        _ => format!("{made} samples are kept in {path}, and the same command goes on from there"),
    };
    note(Note::Warning, format!("interrupted, without a view: {kept}"));
}

fn place(at: SurfacePoint) -> CachedPlace {
    let SurfacePoint { triangle, back, u, v, .. } = at;
    CachedPlace { triangle, back, u, v }
}
