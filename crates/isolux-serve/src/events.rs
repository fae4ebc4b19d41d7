//! Streams of events.

use crate::feed::{Feed, State, States};
use crate::stopping::Stopping;
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse, Response};
use futures_util::stream::{once, unfold};
use futures_util::{Stream, StreamExt};
use std::convert::Infallible;
use std::future::ready;
use std::time::Duration;
use tokio::sync::OwnedSemaphorePermit;

/// A client whose stream broke off comes back after this time.
const RETRY: Duration = Duration::from_secs(1);

/// One who watches a run.
struct Viewer {
    states: States,
    stopping: Stopping,
    /// Given back when the stream ends.
    _seat: OwnedSemaphorePermit,
}

/// The history, then the newest state, then each that is newest when the client can take one.
pub(crate) fn stream(
    feed: &Feed,
    seat: OwnedSemaphorePermit,
    stopping: Stopping,
    keep_alive: Duration,
) -> Response {
    let (history, states) = feed.join();
    let first = Event::default().event("history").retry(RETRY).data(history);
    let later = unfold(Viewer { states, stopping, _seat: seat }, next);
    let events = once(ready(first)).chain(later).map(Ok::<_, Infallible>);
    sse(events, keep_alive)
}

fn sse(
    events: impl Stream<Item = Result<Event, Infallible>> + Send + 'static,
    keep_alive: Duration,
) -> Response {
    let comments = KeepAlive::new().interval(keep_alive).text("still here");
    Sse::new(events).keep_alive(comments).into_response()
}

async fn next(mut viewer: Viewer) -> Option<(Event, Viewer)> {
    // A last state is told before the stream ends.
    let state = tokio::select! {
        biased;
        state = viewer.states.next() => state,
        () = viewer.stopping.told() => None,
    };
    state.map(|state| (event(&state), viewer))
}

fn event(state: &State) -> Event {
    Event::default().event("state").id(state.number.to_string()).data(&*state.json)
}
