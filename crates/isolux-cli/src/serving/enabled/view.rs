//! `isolux view`: a map in a browser.

use super::readings::Reader;
use super::served::{Place, Served};
use super::state::{Phase, State};
use super::world::World;
use super::{finer, started};
use crate::console::{print, print_json};
use crate::failure::{Failure, Outcome};
use crate::flags::ViewFlags;
use crate::interrupt::signals;
use crate::map_file;
use crate::walk::{Hello, Opened, grids_of_map};
use isolux_serve::Feed;
use serde::Serialize;
use std::sync::{Arc, Mutex};

/// What is printed of the page.
#[derive(Serialize)]
struct Report<'a> {
    address: &'a str,
}

/// Serves one map or two until somebody stops it.
pub(crate) fn view(flags: &ViewFlags, json: bool) -> Result<Outcome, Failure> {
    let mut maps = Vec::new();
    for path in std::iter::once(&flags.map).chain(&flags.other) {
        let map = Opened::read(path)?;
        map_file::warn_of_unknown_error(path, &map.map);
        maps.push(Arc::new(map));
    }
    let names = maps.iter().map(|map| (map.scene.name().to_owned(), map.file())).collect();
    let places = maps.iter().enumerate().map(|(number, map)| {
        let other = maps.iter().enumerate().find(|(k, _)| *k != number).map(|(_, map)| &**map);
        place(map, other)
    });
    let method = maps[0].map.provenance.method;
    let served = Arc::new(Served {
        hello: Hello::new(names, false, "probe"),
        places: places.collect::<Result<Vec<_>, Failure>>()?,
        steering: None,
        feed: Feed::new(),
        state: Mutex::new(State::new(method, Phase::Done)),
    });
    served.tell(|state| state.learn_of_map(&maps[0].map));
    let server = started(&flags.server, Arc::clone(&served), served.feed.clone())?;
    let stopper = server.stopper();
    signals::listen(move || stopper.stop())
        .map_err(|e| Failure::Refused(format!("cannot listen to Ctrl-C: {e}")))?;
    match json {
        true => print_json(&Report { address: server.url() })?,
        false => print(&format!("{}\nCtrl-C ends it\n", server.url()))?,
    }
    if let [map] = &maps[..]
        && !map.has_groups()
    {
        let (scene, map) = (Arc::clone(&map.scene), Arc::clone(&map.map));
        finer::start(scene, map, Arc::downgrade(&served));
    }
    server.wait();
    Ok(Outcome::Done)
}

/// A map with what reads it.
fn place(map: &Arc<Opened>, other: Option<&Opened>) -> Result<Place, Failure> {
    let world = World::new(Arc::clone(&map.scene), map.scene_bytes(other)?);
    let (mesh, light) = map.drawn(other);
    world.draw(mesh, light, Arc::clone(&map.map));
    let place = Place::new(world);
    let (of_reader, of_grids) = (Arc::clone(map), Arc::clone(map));
    let reader = Reader::start(Box::new(move |dimming| of_reader.dimmed(dimming)));
    // Both are set here alone.
    let _ = place.reader.set(reader);
    let _ = place.grids.set(Box::new(move || grids_of_map(&of_grids.scene, &of_grids.map)));
    Ok(place)
}
