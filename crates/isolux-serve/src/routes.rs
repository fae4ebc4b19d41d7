//! What is found where. There is nothing else, and no file of the disk.

use crate::answer::{Refusal, of_type};
use crate::body;
use crate::events;
use crate::page;
use crate::query::number;
use crate::shown::{Control, Gone, Question};
use crate::site::Site;
use axum::Router;
use axum::body::{Body, Bytes};
use axum::extract::State;
use axum::http::{StatusCode, Uri};
use axum::response::{IntoResponse, Response};
use axum::routing::{MethodFilter, MethodRouter, on, post};
use std::sync::Arc;

const NOT_FOUND: Refusal = Refusal::new(StatusCode::NOT_FOUND, "there is nothing here");
const NOT_ALLOWED: Refusal =
    Refusal::new(StatusCode::METHOD_NOT_ALLOWED, "this cannot be asked for with that method");
const NO_SEAT: Refusal =
    Refusal::new(StatusCode::SERVICE_UNAVAILABLE, "too many watch already: close another page");

type Answer = Result<Response, Refusal>;
type Here = State<Arc<Site>>;

/// All that is served.
pub(crate) fn router(site: Arc<Site>) -> Router {
    let pages = page::PATHS.iter().fold(Router::new(), |r, path| r.route(path, get(index)));
    pages
        .route("/favicon.ico", get(no_icon))
        .route("/api/hello", get(hello))
        .route("/api/scene", get(scene))
        .route("/api/mesh", get(mesh))
        .route("/api/light", get(light))
        .route("/api/grids", get(grids))
        .route("/api/events", get(watch))
        .route("/api/read", post(read))
        .route("/api/control", post(control))
        .fallback(async || NOT_FOUND)
        .method_not_allowed_fallback(async || NOT_ALLOWED)
        .with_state(site)
}

/// `GET` alone, without the `HEAD` that goes with it elsewhere.
fn get<H, T>(handler: H) -> MethodRouter<Arc<Site>>
where
    H: axum::handler::Handler<T, Arc<Site>>,
    T: 'static,
{
    on(MethodFilter::GET, handler).on(MethodFilter::HEAD, async || NOT_ALLOWED)
}

async fn index(State(site): Here) -> Response {
    site.page.response()
}

async fn no_icon() -> StatusCode {
    StatusCode::NO_CONTENT
}

async fn hello(State(site): Here) -> Answer {
    let shown = Arc::clone(&site.shown);
    Ok(json(site.gates.containers.run(move || shown.hello()).await?))
}

async fn scene(State(site): Here, uri: Uri) -> Answer {
    container(site.fetch(&uri, |shown, world| shown.scene(world)).await?.map(Bytes::from_owner))
}

async fn mesh(State(site): Here, uri: Uri) -> Answer {
    container(site.fetch(&uri, |shown, world| shown.mesh(world)).await?.map(Bytes::from_owner))
}

async fn light(State(site): Here, uri: Uri) -> Answer {
    let (mesh, since) = (number(&uri, "mesh")?, number(&uri, "since")?);
    let light = site.fetch(&uri, move |shown, world| shown.light(world, mesh, since)).await?;
    container(light.map(Bytes::from))
}

async fn grids(State(site): Here, uri: Uri) -> Answer {
    let world = number(&uri, "world")?;
    let call = site.about(&site.gates.readings, world, |shown, world| shown.grids(world));
    call.await?.map(|bytes| json(Bytes::from_owner(bytes))).map_err(Refusal::not_now)
}

async fn watch(State(site): Here) -> Answer {
    let seat = Arc::clone(&site.seats).try_acquire_owned().map_err(|_| NO_SEAT)?;
    Ok(events::stream(&site.feed, seat, site.stopping.clone(), site.limits.keep_alive))
}

async fn read(State(site): Here, body: Body) -> Answer {
    let asked: Question = body::json(body, site.limits.patience).await?;
    if let Some(problem) = asked.problem() {
        return Err(Refusal::bad(problem));
    }
    let world = asked.world;
    let asker = Asker::default();
    let gone = asker.0.clone();
    let call = site.about(&site.gates.readings, world, move |s, w| s.read(w, &asked, &gone));
    call.await?.map(json).map_err(Refusal::not_now)
}

/// Dropped with the request: when it is answered, or when the connection is lost.
#[derive(Default)]
struct Asker(Gone);

impl Drop for Asker {
    fn drop(&mut self) {
        self.0.leave();
    }
}

async fn control(State(site): Here, body: Body) -> Answer {
    let what: Control = body::json(body, site.limits.patience).await?;
    if !what.is_sound() {
        return Err(Refusal::bad("`accuracy` must be above 0"));
    }
    let shown = Arc::clone(&site.shown);
    site.gates.controls.run(move || shown.control(what)).await?.map_err(Refusal::not_now)?;
    Ok(StatusCode::NO_CONTENT.into_response())
}

fn json(bytes: impl Into<Body>) -> Response {
    of_type("application/json", bytes)
}

fn container(bytes: Option<Bytes>) -> Answer {
    let not_there = || Refusal::not_now("not there yet, or replaced by now");
    bytes.map(|bytes| of_type("application/octet-stream", bytes)).ok_or_else(not_there)
}
