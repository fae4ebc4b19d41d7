//! `isolux solve --live`: a run in a browser.

use super::even::even_light;
use super::finer;
use super::painter::Painter;
use super::readings::Reader;
use super::served::{Place, Served};
use super::started;
use super::state::{Phase, State};
use super::steering::Steering;
use super::world::World;
use crate::failure::Failure;
use crate::flags::ServerFlags;
use crate::interrupt::Interrupt;
use crate::notes::{Note, note};
use crate::viewpoint;
use crate::walk::{ALL_LIGHT, Hello, grids_of_map, told};
use isolux::engine::{Progress, SoFar, Solution, SolveRequest, Watch};
use isolux::map::{IlluminationMap, Method};
use isolux::scene::Scene;
use isolux_formats::walk;
use isolux_serve::{Feed, Server};
use std::path::Path;
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

/// States are told no more often than this; the eye sees no more.
const PAUSE: Duration = Duration::from_millis(100);
/// Once a run has ended it looks this often whether somebody still looks.
const LINGERS: Duration = Duration::from_millis(200);

/// Somebody may begin to look until so long after the start, however soon the run has ended.
const FIRST_VIEWER: Duration = Duration::from_secs(10);

/// A run that is shown.
pub(crate) struct Live {
    served: Arc<Served>,
    server: Server,
    painter: Painter,
    file: String,
    told: Option<Instant>,
    was_seen: bool,
    started: Instant,
}

impl Live {
    /// Shows a scene whose map will be written to `output`.
    pub(crate) fn start(
        flags: &ServerFlags,
        scene: &Scene,
        output: &Path,
    ) -> Result<Self, Failure> {
        let scene = Arc::new(scene.clone());
        let file = output.file_name().map_or(String::new(), |f| f.to_string_lossy().into_owned());
        let even = even_light(&scene);
        let world = World::new(Arc::clone(&scene), container((&scene, &even), &file)?);
        world.show(&Arc::new(even));
        let served = Arc::new(Served {
            hello: Hello::new(vec![(scene.name().to_owned(), file.clone())], true, "probe"),
            places: vec![Place::new(world)],
            steering: Some(Steering::default()),
            feed: Feed::new(),
            state: Mutex::new(State::new(Method::Hybrid, Phase::Starting)),
        });
        served.tell(|_| {});
        let server = started(flags, Arc::clone(&served), served.feed.clone())?;
        note(Note::Info, format!("watch it at {}", server.url()));
        let painter = Painter::start(Arc::downgrade(&served));
        Ok(Self {
            served,
            server,
            painter,
            file,
            told: None,
            was_seen: false,
            started: Instant::now(),
        })
    }

    /// A run begins, perhaps anew.
    pub(crate) fn begin(&mut self, request: &SolveRequest) {
        self.served.tell(|state| {
            let before = state.clone();
            *state = State::new(request.method, Phase::Elements).after(&before);
            state.target = request.accuracy;
        });
    }

    /// Shows where the run is, and does what viewers want.
    pub(crate) fn look(
        &mut self,
        progress: &Progress,
        so_far: &SoFar<'_>,
        is_interrupted: &dyn Fn() -> bool,
    ) -> Watch {
        self.is_seen();
        let is_due = self.told.is_none_or(|told| told.elapsed() >= PAUSE) || progress.ends;
        if is_due {
            self.told = Some(Instant::now());
            self.served.tell(|state| state.learn(progress));
        }
        if self.server.viewers() > 0 && self.painter.has_time() {
            let started = Instant::now();
            if let Some(map) = so_far.map() {
                self.painter.show(map, started.elapsed());
            }
        }
        let Some(steering) = &self.served.steering else { return Watch::Continue };
        let waited = steering.wait_while_paused(is_interrupted);
        let wishes = steering.wishes();
        match waited {
            _ if wishes.stopped || wishes.target.is_some() => Watch::Stop,
            Duration::ZERO => Watch::Continue,
            waited => Watch::After(waited),
        }
    }

    /// Whether the run is to begin anew.
    pub(crate) fn begins_anew(&self) -> bool {
        let wishes = self.served.steering.as_ref().map(Steering::wishes);
        wishes.is_some_and(|wishes| wishes.target.is_some() && !wishes.stopped)
    }

    /// Another accuracy that the run is to begin anew for.
    pub(crate) fn next_target(&mut self) -> Option<f64> {
        let steering = self.served.steering.as_ref()?;
        if steering.wishes().stopped { None } else { steering.take_target() }
    }

    /// Whether a viewer has stopped the run.
    pub(crate) fn is_stopped(&self) -> bool {
        self.served.steering.as_ref().is_some_and(|steering| steering.wishes().stopped)
    }

    /// The run has ended and its map is written.
    pub(crate) fn end(&mut self, solution: &Solution, path: &Path) {
        let place = &self.served.places[0];
        let map = Arc::new(solution.map.clone());
        place.world.show(&map);
        if let Ok(container) = container((place.world.scene(), &map), &self.file) {
            place.world.tell(container);
        }
        let scene = Arc::clone(place.world.scene());
        // A run ends once.
        let lit = (Arc::clone(&scene), Arc::clone(&map));
        let _ = place.reader.set(Reader::start(Box::new(move |_| Some(lit.clone()))));
        let of_grids = Arc::clone(&map);
        let _ = place.grids.set(Box::new(move || grids_of_map(&scene, &of_grids)));
        let is_complete = map.provenance.complete;
        self.served.tell(|state| {
            state.learn_of_map(&map);
            state.phase = if is_complete { Phase::Done } else { Phase::Stopped };
            state.paused = false;
            state.saved = Some(path.display().to_string());
        });
        if self.server.viewers() > 0 {
            let scene = Arc::clone(self.served.places[0].world.scene());
            finer::start(scene, map, Arc::downgrade(&self.served));
        }
    }

    /// Serves the map as long as somebody looks, or may still begin to.
    pub(crate) fn linger(mut self) {
        let interrupt = Interrupt::install();
        let is_interrupted = || interrupt.as_ref().is_ok_and(Interrupt::is_requested);
        // A short run is over before a browser has opened.
        while !self.is_seen() && self.started.elapsed() < FIRST_VIEWER && !is_interrupted() {
            thread::sleep(LINGERS);
        }
        if self.server.viewers() > 0 {
            note(Note::Info, "the page is served until it is closed, or until Ctrl-C");
        }
        while self.server.viewers() > 0 && !is_interrupted() {
            thread::sleep(LINGERS);
        }
    }

    /// Whether somebody has looked.
    fn is_seen(&mut self) -> bool {
        self.was_seen |= self.server.viewers() > 0;
        self.was_seen
    }
}

fn container((scene, map): (&Scene, &IlluminationMap), file: &str) -> Result<Vec<u8>, Failure> {
    let camera = viewpoint::camera(scene, None).map_err(Failure::bad_input)?;
    let layers = vec![ALL_LIGHT.to_owned()];
    Ok(walk::scene(scene, &told((scene, map), &camera, (file, None), layers)))
}
