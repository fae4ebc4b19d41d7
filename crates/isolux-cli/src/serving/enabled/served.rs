//! What the server shows.

use super::readings::{self, Reader};
use super::state::State;
use super::steering::Steering;
use super::world::World;
use crate::walk::Hello;
use isolux_serve::{Control, Feed, Gone, Question, Shown};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// What makes the calculation grids of a world, as JSON.
type Grids = Box<dyn Fn() -> Vec<u8> + Send + Sync>;

/// One world with its readers.
pub(super) struct Place {
    pub(super) world: World,
    /// Reads as `probe` does; none while a run is under way.
    pub(super) reader: OnceLock<Reader>,
    /// Made when they are asked for.
    pub(super) grids: OnceLock<Grids>,
    tables: OnceLock<Arc<[u8]>>,
}

impl Place {
    pub(super) fn new(world: World) -> Self {
        let (reader, grids, tables) = (OnceLock::new(), OnceLock::new(), OnceLock::new());
        Self { world, reader, grids, tables }
    }
}

/// All that pages ask for.
pub(super) struct Served {
    pub(super) hello: Hello,
    pub(super) places: Vec<Place>,
    /// Of a run, if one is shown.
    pub(super) steering: Option<Steering>,
    pub(super) feed: Feed,
    pub(super) state: Mutex<State>,
}

impl Served {
    /// Changes the state and tells viewers.
    pub(super) fn tell(&self, change: impl FnOnce(&mut State)) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        change(&mut state);
        state.offer(self.places[0].world.versions());
        let point = state.point();
        // In the order of their numbers.
        self.feed.publish(state.next_json(), point);
    }

    fn place(&self, world: usize) -> Option<&Place> {
        self.places.get(world)
    }
}

impl Shown for Served {
    fn worlds(&self) -> usize {
        self.places.len()
    }

    fn hello(&self) -> Vec<u8> {
        self.hello.to_json().into_bytes()
    }

    fn scene(&self, world: usize) -> Option<Arc<[u8]>> {
        self.place(world).map(|place| place.world.scene_bytes())
    }

    fn mesh(&self, world: usize) -> Option<Arc<[u8]>> {
        self.place(world)?.world.mesh_bytes()
    }

    fn light(&self, world: usize, mesh: u64, since: u64) -> Option<Vec<u8>> {
        self.place(world)?.world.light_bytes(mesh, since)
    }

    fn read(&self, world: usize, asked: &Question, gone: &Gone) -> Result<Vec<u8>, String> {
        let place = self.place(world).ok_or("there is no such map")?;
        let readings = match place.reader.get() {
            Some(reader) => {
                let gone = gone.clone();
                let is_wanted = Box::new(move || !gone.is_gone());
                reader
                    .read((asked.rays.clone(), asked.dimming.clone()), is_wanted)
                    .ok_or("no light is left, or too many ask")?
            }
            None => {
                let map = place.world.map().ok_or("there is no light yet")?;
                let read = |ray| readings::from_vertices(place.world.scene(), &map, ray);
                asked.rays.iter().map(read).collect()
            }
        };
        let answer = serde_json::json!({ "readings": readings });
        Ok(answer.to_string().into_bytes())
    }

    fn grids(&self, world: usize) -> Result<Arc<[u8]>, String> {
        let place = self.place(world).ok_or("there is no such map")?;
        let make = place.grids.get().ok_or("grids are read once the run has ended")?;
        Ok(Arc::clone(place.tables.get_or_init(|| make().into())))
    }

    fn control(&self, what: Control) -> Result<(), String> {
        let steering = self.steering.as_ref().ok_or("no run is under way")?;
        steering.take(what);
        let paused = steering.wishes().paused;
        self.tell(|state| state.paused = paused);
        Ok(())
    }
}
