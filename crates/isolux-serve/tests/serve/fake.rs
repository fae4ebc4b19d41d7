//! Something to show: two worlds, the second without a mesh.

use isolux_serve::{Control, Feed, Gone, Limits, Page, Question, Server, Settings, Shown, serve};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// The first origin coordinate of rays whose reading takes until the asker leaves or is let go.
pub(crate) const LONG: f64 = 7.0;
/// The first origin coordinate of rays whose reading fails.
pub(crate) const FAILING: f64 = 8.0;
/// The first origin coordinate of rays whose reading panics.
pub(crate) const PANICKING: f64 = 9.0;
/// No test waits longer for what it expects.
pub(crate) const SOON: Duration = Duration::from_secs(5);

pub(crate) const PAGE: &str = "<!doctype html><script>walk()</script>";

#[derive(Default)]
pub(crate) struct Fake {
    /// What the container of a scene holds.
    pub(crate) scene: Option<Arc<[u8]>>,
    pub(crate) live: AtomicBool,
    pub(crate) asked: Mutex<Vec<Control>>,
    /// Readings that have begun.
    pub(crate) begun: AtomicUsize,
    /// Readings whose asker left.
    pub(crate) left: AtomicUsize,
    /// Lets long readings end.
    pub(crate) go: AtomicBool,
}

impl Shown for Fake {
    fn worlds(&self) -> usize {
        2
    }

    fn hello(&self) -> Vec<u8> {
        br#"{"live":true}"#.to_vec()
    }

    fn scene(&self, world: usize) -> Option<Arc<[u8]>> {
        self.scene.clone().or_else(|| Some(Arc::from(format!("scene {world}").into_bytes())))
    }

    fn mesh(&self, world: usize) -> Option<Arc<[u8]>> {
        (world == 0).then(|| Arc::from(*b"mesh 0"))
    }

    fn light(&self, world: usize, mesh: u64, since: u64) -> Option<Vec<u8>> {
        (mesh == 1).then(|| format!("light {world} since {since}").into_bytes())
    }

    fn read(&self, _: usize, asked: &Question, gone: &Gone) -> Result<Vec<u8>, String> {
        self.begun.fetch_add(1, Ordering::SeqCst);
        let first = asked.rays[0].origin[0];
        if first == FAILING {
            return Err("no surface has light yet".to_owned());
        }
        assert!(first != PANICKING, "on purpose");
        if first == LONG {
            until(|| gone.is_gone() || self.go.load(Ordering::SeqCst));
            self.left.fetch_add(usize::from(gone.is_gone()), Ordering::SeqCst);
        }
        Ok(format!("{{\"readings\":[{}]}}", asked.rays.len()).into_bytes())
    }

    fn grids(&self, world: usize) -> Result<Arc<[u8]>, String> {
        if world == 0 { Ok(Arc::from(*b"[]")) } else { Err("no grids".to_owned()) }
    }

    fn control(&self, what: Control) -> Result<(), String> {
        self.asked.lock().unwrap().push(what);
        let live = self.live.load(Ordering::SeqCst);
        if live { Ok(()) } else { Err("no run is under way".to_owned()) }
    }
}

/// Waits for something, not forever; whether it came.
pub(crate) fn until(is_so: impl Fn() -> bool) -> bool {
    let begun = Instant::now();
    while !is_so() && begun.elapsed() < SOON {
        sleep(Duration::from_millis(1));
    }
    is_so()
}

/// A server of a fake, at any free port.
pub(crate) fn served(fake: Arc<Fake>, feed: Feed, limits: Limits) -> Server {
    let settings = Settings { limits, ..Settings::default() };
    serve(settings, &Page { html: PAGE.into() }, fake, feed).unwrap()
}

pub(crate) fn server() -> Server {
    served(Arc::default(), Feed::new(), Limits::default())
}
