//! A small local web server: one page, containers of bytes, readings, and a stream of events.
//!
//! It knows nothing of light. Whoever shows something implements [`Shown`], and tells states of a
//! run through a [`Feed`]. No file of the disk is ever served, and what is served reaches no pages
//! of other origins; where others can connect, they must know a token.
//!
//! ```no_run
//! use isolux_serve::{Control, Feed, Gone, Page, Question, Settings, Shown, serve};
//! use std::sync::Arc;
//!
//! struct Nothing;
//!
//! impl Shown for Nothing {
//!     fn worlds(&self) -> usize { 0 }
//!     fn hello(&self) -> Vec<u8> { b"{}".to_vec() }
//!     fn scene(&self, _: usize) -> Option<Arc<[u8]>> { None }
//!     fn mesh(&self, _: usize) -> Option<Arc<[u8]>> { None }
//!     fn light(&self, _: usize, _: u64, _: u64) -> Option<Vec<u8>> { None }
//!     fn read(&self, _: usize, _: &Question, _: &Gone) -> Result<Vec<u8>, String> {
//!         Err("nothing is shown".to_owned())
//!     }
//!     fn grids(&self, _: usize) -> Result<Arc<[u8]>, String> {
//!         Err("nothing is shown".to_owned())
//!     }
//!     fn control(&self, _: Control) -> Result<(), String> { Err("no run is under way".to_owned()) }
//! }
//!
//! let feed = Feed::new();
//! let page = Page { html: "<!doctype html>".into() };
//! let server = serve(Settings::default(), &page, Arc::new(Nothing), feed.clone())?;
//! println!("open {}", server.url());
//! feed.publish("{\"number\":1}".to_owned(), None);
//! server.wait();
//! # Ok::<(), isolux_serve::ServeError>(())
//! ```

mod answer;
mod body;
mod connection;
mod error;
mod events;
mod feed;
mod gate;
mod guard;
mod page;
mod patient;
mod query;
mod routes;
mod server;
mod settings;
mod shown;
mod site;
mod stopping;
mod token;

pub use error::ServeError;
pub use feed::{Feed, Point};
pub use page::Page;
pub use server::{Server, serve};
pub use settings::{Limits, Settings};
pub use shown::{Control, Gone, Question, RayAsked, Shown};
pub use stopping::Stopper;
