//! What is told to all viewers: the newest state of a run, and how its error fell.

mod history;

pub use history::Point;

use history::History;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tokio::sync::watch;

/// Where a run tells its states. Clones tell the same viewers.
///
/// Only the newest state is kept, and a history of errors of bounded length. A viewer who cannot
/// keep up misses states and never holds up the run.
#[derive(Clone, Debug)]
pub struct Feed(Arc<Told>);

#[derive(Debug)]
struct Told {
    history: Mutex<History>,
    newest: watch::Sender<Option<State>>,
}

/// A state as it is told.
#[derive(Clone, Debug)]
pub(crate) struct State {
    /// Counts the states of the feed from 1.
    pub(crate) number: u64,
    pub(crate) json: Arc<str>,
}

impl Default for Feed {
    fn default() -> Self {
        Self::new()
    }
}

impl Feed {
    /// A feed that has told nothing.
    pub fn new() -> Self {
        let newest = watch::Sender::new(None);
        Self(Arc::new(Told { history: Mutex::default(), newest }))
    }

    /// Tells a state, as JSON, and an error that belongs to it. Waits for no viewer. Errors must
    /// come in the order of time; others are left out of the history, as is what is not a number.
    pub fn publish(&self, state_json: String, point: Option<Point>) {
        let json = Arc::from(in_one_line(state_json));
        let mut history = self.history();
        if let Some(point) = point {
            history.add(point);
        }
        self.0.newest.send_modify(|newest| {
            let number = newest.as_ref().map_or(0, |s| s.number) + 1;
            *newest = Some(State { number, json });
        });
    }

    /// The history so far, as JSON, and the states from the newest on.
    pub(crate) fn join(&self) -> (String, States) {
        let history = self.history();
        let mut states = self.0.newest.subscribe();
        if states.borrow().is_some() {
            states.mark_changed();
        }
        (history.json(), States(states))
    }

    /// It is never held for longer than copying its few points takes.
    fn history(&self) -> MutexGuard<'_, History> {
        self.0.history.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The states for one viewer.
pub(crate) struct States(watch::Receiver<Option<State>>);

impl States {
    /// The newest state, as soon as it is one that was not told here; `None` when no more can come.
    pub(crate) async fn next(&mut self) -> Option<State> {
        self.0.changed().await.ok()?;
        self.0.borrow_and_update().clone()
    }
}

/// Line ends mean something in a stream of events, and nothing in JSON.
fn in_one_line(json: String) -> String {
    if json.contains(['\r', '\n']) { json.replace(['\r', '\n'], " ") } else { json }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wait<T>(future: impl Future<Output = T>) -> T {
        tokio::runtime::Builder::new_current_thread().build().unwrap().block_on(future)
    }

    #[test]
    fn late_joiners_get_history_and_newest() {
        let feed = Feed::new();
        for k in 1..=3 {
            let point = Point { elapsed_s: f64::from(k), error: 0.5 };
            feed.publish(format!("{{\"number\":{k}}}"), Some(point));
        }
        let (history, mut states) = feed.join();
        assert_eq!(history, "[[1.0,0.5],[2.0,0.5],[3.0,0.5]]");
        let newest = wait(states.next()).unwrap();
        assert_eq!((newest.number, &*newest.json), (3, "{\"number\":3}"));
    }

    #[test]
    fn states_between_are_left_out() {
        let feed = Feed::new();
        let (history, mut states) = feed.join();
        assert_eq!(history, "[]");
        for k in 0..1000 {
            feed.publish(k.to_string(), None);
        }
        assert_eq!(wait(states.next()).unwrap().number, 1000);
        feed.publish("last".to_owned(), None);
        assert_eq!(&*wait(states.next()).unwrap().json, "last");
    }

    #[test]
    fn states_are_in_one_line() {
        assert_eq!(in_one_line("{\r\n\"a\":1\n}".to_owned()), "{  \"a\":1 }");
    }
}
