//! How far work is whose end can be foreseen: a bar on a terminal, else a line now and then.

use crate::notes::{self, Note, note};
use crate::quantity::{show_seconds, show_share};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::time::Instant;

/// Lines are for logs: one in so many seconds.
const LINE_EVERY_S: f64 = 10.0;
/// Steps of the bar.
const BAR_STEPS: u64 = 1000;
/// Nothing is foreseen in the first moments.
const QUIET_S: f64 = 0.5;

/// Tells of one kind of work; the bar goes when this does.
pub(crate) struct Meter {
    what: &'static str,
    /// When it was first told of, which is when the work began.
    started: Option<Instant>,
    last_s: f64,
    /// The highest so far: what was foreseen may have been too little, but work is not undone.
    share: f64,
    bar: Option<ProgressBar>,
}

impl Meter {
    /// Of work that has not begun.
    pub(crate) fn new(what: &'static str) -> Self {
        let on_terminal = std::io::stderr().is_terminal() && !notes::are_json();
        Self {
            what,
            started: None,
            last_s: 0.0,
            share: 0.0,
            bar: on_terminal.then(|| bar(BAR_STEPS)),
        }
    }

    /// So much is done.
    pub(crate) fn tell(&mut self, share: f64) {
        let passed_s = self.started.get_or_insert_with(Instant::now).elapsed().as_secs_f64();
        self.share = self.share.max(share);
        if self.share <= 0.0 || passed_s < QUIET_S {
            return;
        }
        // Nor is what is left less for it.
        let left_s = passed_s / share.max(f64::MIN_POSITIVE) - passed_s;
        let (done, left) = (show_share(self.share), show_seconds(left_s));
        let text = format!("{}: {done} done, about {left} left", self.what);
        match &self.bar {
            Some(bar) => {
                bar.set_position((self.share * BAR_STEPS as f64) as u64);
                bar.set_message(text);
            }
            None if passed_s > self.last_s + LINE_EVERY_S => {
                self.last_s = passed_s;
                note(Note::Info, text);
            }
            None => {}
        }
    }
}

impl Drop for Meter {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// A bar with a message beside it.
pub(crate) fn bar(steps: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:24} {msg}");
    ProgressBar::new(steps).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
