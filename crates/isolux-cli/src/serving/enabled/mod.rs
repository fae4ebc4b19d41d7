//! The server of walk-throughs.

mod even;
mod finer;
mod live;
mod painter;
mod readings;
mod served;
mod state;
mod steering;
mod view;
mod world;

pub(crate) use live::Live;
pub(crate) use view::view;

use crate::failure::Failure;
use crate::flags::ServerFlags;
use crate::notes::{Note, note};
use crate::walk::PAGE;
use isolux_serve::{Feed, Page, Server, Settings, serve};
use served::Served;
use std::sync::Arc;

/// Starts a server, tells its address, and opens a browser unless that is not wanted.
fn started(flags: &ServerFlags, served: Arc<Served>, feed: Feed) -> Result<Server, Failure> {
    let settings = Settings { address: flags.address, port: flags.port, ..Settings::default() };
    let server = serve(settings, &Page { html: PAGE.into() }, served, feed)
        .map_err(|error| Failure::bad_input(error.to_string()))?;
    if !flags.address.is_loopback() {
        note(
            Note::Info,
            "others reach the page by the name or address of this machine, with the same port and token",
        );
    }
    if !flags.no_open && open::that_detached(server.url()).is_err() {
        note(Note::Info, "no browser can be opened from here: open the address in one");
    }
    Ok(server)
}
