//! While somebody looks, the map is shown with finer shadows.

use super::served::Served;
use crate::walk::fineness;
use isolux::engine::Finer;
use isolux::map::IlluminationMap;
use isolux::scene::Scene;
use std::sync::{Arc, Weak};
use std::thread;
use std::time::{Duration, Instant};

/// The first finer map is shown after this time, and each further one after half as long again.
const FIRST: Duration = Duration::from_secs(2);

/// Makes the map that is shown finer, in a thread of its own, as long as it is served.
pub(super) fn start(scene: Arc<Scene>, map: Arc<IlluminationMap>, served: Weak<Served>) {
    thread::spawn(move || refine((&scene, &map), &served));
}

fn refine((scene, map): (&Scene, &IlluminationMap), served: &Weak<Served>) {
    let how = fineness(scene);
    let mut finer = Finer::new(scene, map);
    let mut pause = FIRST;
    loop {
        let (started, vertices) = (Instant::now(), finer.vertices());
        let is_wanted = || started.elapsed() < pause && served.strong_count() > 0;
        let goes_on = finer.refine(&how, &mut { is_wanted });
        let Some(served) = served.upgrade() else { return };
        if finer.vertices() > vertices {
            served.places[0].world.show(&Arc::new(finer.map()));
            served.tell(|_| {});
        }
        if !goes_on {
            return;
        }
        pause = pause * 3 / 2;
    }
}
