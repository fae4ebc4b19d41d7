//! Streams of events.

use crate::client::get;
use crate::fake::{Fake, SOON, served, until};
use crate::viewer::Viewer;
use isolux_serve::{Feed, Limits, Point, Server};
use std::sync::Arc;
use std::time::{Duration, Instant};

fn told(feed: &Feed, limits: Limits) -> Server {
    served(Arc::new(Fake::default()), feed.clone(), limits)
}

fn point(elapsed_s: f64) -> Option<Point> {
    Some(Point { elapsed_s, error: 0.5 })
}

#[test]
fn late_joiners_get_history_and_newest_and_then_what_is_new() {
    let feed = Feed::new();
    let server = told(&feed, Limits::default());
    feed.publish("{\"number\":1}".to_owned(), point(1.0));
    feed.publish("{\"number\":2}".to_owned(), point(2.0));
    let mut viewer = Viewer::join(server.address());
    assert_eq!(viewer.data("history"), "[[1.0,0.5],[2.0,0.5]]");
    let newest = viewer.next().unwrap();
    assert_eq!((&*newest.name, &*newest.id, &*newest.data), ("state", "2", "{\"number\":2}"));
    feed.publish("{\"number\":3}".to_owned(), None);
    assert_eq!(viewer.data("state"), "{\"number\":3}");
}

#[test]
fn early_joiners_get_an_empty_history_and_wait() {
    let feed = Feed::new();
    let server = told(&feed, Limits::default());
    let mut viewer = Viewer::join(server.address());
    assert_eq!(viewer.data("history"), "[]");
    feed.publish("1".to_owned(), None);
    assert_eq!(viewer.data("state"), "1");
}

#[test]
fn who_comes_back_gets_history_and_newest_again() {
    let feed = Feed::new();
    let server = told(&feed, Limits::default());
    for k in 1..=3 {
        feed.publish(k.to_string(), point(f64::from(k)));
        let mut viewer = Viewer::join(server.address());
        assert_eq!(viewer.data("history").matches(",0.5]").count(), k as usize);
        assert_eq!(viewer.data("state"), k.to_string());
    }
    assert!(until(|| server.viewers() == 0));
}

#[test]
fn silence_is_broken_by_comments() {
    let keep_alive = Duration::from_millis(20);
    let server = told(&Feed::new(), Limits { keep_alive, ..Limits::default() });
    let mut viewer = Viewer::join(server.address());
    viewer.data("history");
    assert_eq!(viewer.next().unwrap().comment, "still here");
    assert_eq!(viewer.next().unwrap().comment, "still here");
}

#[test]
fn viewers_are_counted_and_too_many_turned_away() {
    let server = told(&Feed::new(), Limits { viewers: 2, ..Limits::default() });
    assert_eq!(server.viewers(), 0);
    let first = Viewer::join(server.address());
    let _second = Viewer::join(server.address());
    assert_eq!(server.viewers(), 2);
    assert_eq!(get(server.address(), "/api/events").status, 503);
    drop(first);
    assert!(until(|| server.viewers() == 1));
    let _third = Viewer::join(server.address());
    assert_eq!(server.viewers(), 2);
}

/// Whatever is buffered for a client reaches it in the end: of 100 MB of states that is little.
#[test]
fn a_viewer_who_does_not_read_holds_up_nothing_and_gets_the_newest() {
    const STATES: u64 = 100_000;
    let feed = Feed::new();
    let server = told(&feed, Limits::default());
    let mut viewer = Viewer::join(server.address());
    viewer.data("history");
    let begun = Instant::now();
    let padding = " ".repeat(1000);
    for k in 1..=STATES {
        feed.publish(format!("{k}{padding}"), point(k as f64));
    }
    assert!(begun.elapsed() < SOON, "{:?}", begun.elapsed());
    let mut ids = vec![0];
    while ids.last() != Some(&STATES) {
        ids.push(viewer.next().unwrap().id.parse().unwrap());
    }
    assert!(ids.is_sorted() && ids.len() < STATES as usize / 5, "{} states came", ids.len());
}
