//! Makes what is shown of a run, beside it.

use super::served::Served;
use isolux::map::IlluminationMap;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Weak};
use std::thread;
use std::time::{Duration, Instant};

/// Making pictures may take this share of the time of a run.
const SHARE: f64 = 0.05;

/// Shows maps, one after another, in a thread of its own.
pub(super) struct Painter {
    maps: SyncSender<(Arc<IlluminationMap>, Duration)>,
    done: Receiver<Duration>,
    busy: bool,
    /// When the next map may be made.
    next: Option<Instant>,
}

impl Painter {
    /// Shows maps to whoever is served.
    pub(super) fn start(served: Weak<Served>) -> Self {
        let (maps, wanted) = sync_channel(1);
        let (told, done) = sync_channel(1);
        thread::spawn(move || paint(&served, &wanted, &told));
        Self { maps, done, busy: false, next: None }
    }

    /// Whether there is time for another map.
    pub(super) fn has_time(&mut self) -> bool {
        if let Ok(took) = self.done.try_recv() {
            self.busy = false;
            self.next = Instant::now().checked_add(took.div_f64(SHARE));
        }
        !self.busy && self.next.is_none_or(|next| Instant::now() >= next)
    }

    /// Shows a map that took so long to make.
    pub(super) fn show(&mut self, map: IlluminationMap, took: Duration) {
        // None waits: it is shown only when the one before is done.
        self.busy = self.maps.try_send((Arc::new(map), took)).is_ok();
    }
}

type Maps = Receiver<(Arc<IlluminationMap>, Duration)>;

fn paint(served: &Weak<Served>, maps: &Maps, told: &SyncSender<Duration>) {
    for (map, took) in maps {
        let started = Instant::now();
        let Some(served) = served.upgrade() else { return };
        served.places[0].world.show(&map);
        served.tell(|state| state.learn_of_map(&map));
        drop(served);
        if told.send(took + started.elapsed()).is_err() {
            return;
        }
    }
}
