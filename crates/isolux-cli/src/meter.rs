//! How far work is whose end can be foreseen: a bar on a terminal, else a line now and then, or JSON lines.

use crate::caller;
use crate::flags::ProgressStyle as Asked;
use crate::notes::{self, Note, note};
use crate::quantity::{show_seconds, show_share};
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;
use std::io::IsTerminal;
use std::time::Instant;

/// Lines are for logs: one in so many seconds.
const LINE_EVERY_S: f64 = 10.0;
/// JSON is for programs that draw: several a second.
const JSON_EVERY_S: f64 = 0.2;
/// Steps of the bar.
const BAR_STEPS: u64 = 1000;
/// Nothing is foreseen in the first moments.
const QUIET_S: f64 = 0.5;
/// A new foresight is believed within so many seconds, or within this share of the time passed, if that is more: one kind of
/// work after another tells better what is left, and one that was wrong for a moment is not to be seen.
const BELIEVED_WITHIN_S: f64 = 1.0;
const BELIEVED_WITHIN: f64 = 0.1;
/// So small a share tells nothing of the rest.
const LEAST_SHARE: f64 = 1e-4;

/// Tells of one kind of work; the bar goes when this does.
pub(crate) struct Meter {
    what: String,
    shape: Shape,
    /// When it was first told of, which is when the work began.
    started: Option<Instant>,
    last_s: Option<f64>,
    foresight: Foresight,
}

enum Shape {
    Bar(ProgressBar),
    Lines,
    Json,
    Silent,
}

impl Meter {
    /// Of work that has not begun, shown as asked for; otherwise by a bar where there is a terminal.
    pub(crate) fn new(what: impl Into<String>, asked: Option<Asked>) -> Self {
        let on_terminal = || std::io::stderr().is_terminal() && !notes::are_json();
        let shape = match asked {
            _ if caller::here().is_some() => Shape::Silent,
            Some(Asked::Json) => Shape::Json,
            Some(Asked::None) => Shape::Silent,
            Some(Asked::Bar) => Shape::Bar(bar(BAR_STEPS)),
            None if on_terminal() => Shape::Bar(bar(BAR_STEPS)),
            None => Shape::Lines,
        };
        Self {
            what: what.into(),
            shape,
            started: None,
            last_s: None,
            foresight: Foresight::default(),
        }
    }

    /// So much is done; nothing where that cannot be told yet. Work that a caller has left ends here.
    pub(crate) fn tell(&mut self, share: f64) {
        caller::look();
        let elapsed_s = self.started.get_or_insert_with(Instant::now).elapsed().as_secs_f64();
        self.foresight.learn(elapsed_s, share);
        let pause_s = match self.shape {
            Shape::Bar(_) => 0.0,
            Shape::Lines => LINE_EVERY_S,
            Shape::Json => JSON_EVERY_S,
            Shape::Silent => return,
        };
        // Lines come after a first pause, too: work that is shorter needs none.
        let last_s = self.last_s.unwrap_or(match self.shape {
            Shape::Lines => 0.0,
            _ => QUIET_S - pause_s,
        });
        if elapsed_s < last_s + pause_s {
            return;
        }
        self.last_s = Some(elapsed_s);
        let state = self.foresight.at(elapsed_s);
        match &self.shape {
            Shape::Bar(bar) => {
                bar.set_position((state.share * BAR_STEPS as f64) as u64);
                bar.set_message(state.line(&self.what));
            }
            Shape::Lines => note(Note::Info, state.line(&self.what)),
            Shape::Json => {
                let report = Report { stage: &self.what, state };
                notes::line(serde_json::to_string(&report).unwrap_or_default());
            }
            Shape::Silent => {}
        }
    }
}

impl Drop for Meter {
    fn drop(&mut self) {
        if let Shape::Bar(bar) = &self.shape {
            bar.finish_and_clear();
        }
    }
}

/// When work will be done, as far as it was told.
#[derive(Clone, Copy, Debug, Default)]
struct Foresight {
    /// From the beginning, s.
    finish_s: Option<f64>,
    /// When that was last told.
    learned_s: f64,
    /// The highest so far: what was foreseen may have been too little, but work is not undone.
    share: f64,
}

/// How far work is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
struct State {
    share: f64,
    elapsed_s: f64,
    /// Nothing while it cannot be foreseen.
    left_s: Option<f64>,
}

/// A state as a JSON line.
#[derive(Serialize)]
struct Report<'a> {
    stage: &'a str,
    #[serde(flatten)]
    state: State,
}

impl Foresight {
    fn learn(&mut self, elapsed_s: f64, share: f64) {
        // What is not a number, neither.
        if !(share > LEAST_SHARE && elapsed_s > 0.0) {
            return;
        }
        let told_s = elapsed_s / share.min(1.0);
        let within_s = BELIEVED_WITHIN_S.max(BELIEVED_WITHIN * elapsed_s);
        let since_s = (elapsed_s - self.learned_s).max(0.0);
        let believed = since_s / (since_s + within_s);
        let finish_s = self.finish_s.map_or(told_s, |before| before + believed * (told_s - before));
        if finish_s.is_finite() {
            self.finish_s = Some(finish_s);
            self.learned_s = elapsed_s;
            self.share = self.share.max((elapsed_s / finish_s).min(1.0));
        }
    }

    fn at(&self, elapsed_s: f64) -> State {
        let left_s = self.finish_s.map(|finish_s| (finish_s - elapsed_s).max(0.0));
        State { share: self.share, elapsed_s, left_s }
    }
}

impl State {
    fn line(&self, what: &str) -> String {
        match self.left_s {
            Some(left_s) => {
                let (done, left) = (show_share(self.share), show_seconds(left_s));
                format!("{what}: {done} done, about {left} left")
            }
            None => format!(
                "{what}: {} so far, what is left is not known yet",
                show_seconds(self.elapsed_s)
            ),
        }
    }
}

/// A bar with a message beside it.
pub(crate) fn bar(steps: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:24} {msg}");
    ProgressBar::new(steps).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_foreseen_is_not_told() {
        let mut foresight = Foresight::default();
        for share in [0.0, f64::NAN, -1.0] {
            foresight.learn(12.0, share);
        }
        foresight.learn(0.0, 0.5);
        foresight.learn(3.0, f64::MIN_POSITIVE);
        let state = foresight.at(12.0);
        assert_eq!(state.line("light"), "light: 12 s so far, what is left is not known yet");
        let report = Report { stage: "light", state };
        let json = serde_json::to_string(&report).unwrap();
        assert_eq!(json, r#"{"stage":"light","share":0.0,"elapsed_s":12.0,"left_s":null}"#);
    }

    #[test]
    fn progress_is_shown_as_asked_for() {
        assert!(matches!(Meter::new("light", Some(Asked::None)).shape, Shape::Silent));
        assert!(matches!(Meter::new("light", Some(Asked::Json)).shape, Shape::Json));
    }

    #[test]
    fn a_moment_of_another_foresight_is_not_seen_and_a_lasting_one_is() {
        let mut foresight = Foresight::default();
        foresight.learn(10.0, 0.25);
        assert_eq!(foresight.at(10.0).left_s, Some(30.0));
        // For a twentieth of a second as good as done.
        foresight.learn(10.05, 0.999);
        let left_s = foresight.at(10.05).left_s.unwrap();
        assert!((27.0..30.0).contains(&left_s), "{left_s}");
        // It lasts.
        let times = |from_s: f64| (1..=100).map(move |k| from_s + 0.05 * f64::from(k));
        times(10.05).for_each(|now_s| foresight.learn(now_s, now_s / 20.0));
        let state = foresight.at(15.05);
        assert!((4.5..5.5).contains(&state.left_s.unwrap()), "{state:?}");
        // More is left than was foreseen: the share that is done stays.
        let before = state.share;
        times(15.05).for_each(|now_s| foresight.learn(now_s, now_s / 60.0));
        let state = foresight.at(20.05);
        assert!(state.left_s.unwrap() > 30.0 && state.share == before, "{state:?}");
    }
}
