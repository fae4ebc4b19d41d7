//! Progress on standard error: a bar, lines, or JSON lines.

use crate::caller::{self, Told};
use crate::flags::ProgressStyle;
use crate::meter::bar;
use crate::notes::{self, Note, note};
use crate::quantity::{show_count, show_seconds, show_share};
use crate::reach;
use indicatif::ProgressBar;
use isolux::engine::{Progress, Stage};
use isolux_formats::counted;
use serde::Serialize;
use std::io::IsTerminal;

/// Lines are for logs: one in so many seconds.
const LINE_EVERY_S: f64 = 2.0;
/// JSON is for programs that draw: several a second.
const JSON_EVERY_S: f64 = 0.2;
/// Steps of the bar.
const BAR_STEPS: u64 = 1000;

/// Shows the state of a run.
pub(crate) struct Reporter {
    shape: Shape,
    last_s: Option<f64>,
}

enum Shape {
    Bar(ProgressBar),
    Lines,
    Json,
    Caller,
    Silent,
}

impl Reporter {
    /// As asked for; otherwise a bar where there is a terminal.
    pub(crate) fn new(asked: Option<ProgressStyle>) -> Self {
        let shape = match asked {
            _ if caller::here().is_some() => Shape::Caller,
            Some(ProgressStyle::Json) => Shape::Json,
            Some(ProgressStyle::None) => Shape::Silent,
            Some(ProgressStyle::Bar) => Shape::Bar(bar(BAR_STEPS)),
            None if std::io::stderr().is_terminal() => Shape::Bar(bar(BAR_STEPS)),
            None => Shape::Lines,
        };
        Self { shape, last_s: None }
    }

    /// Shows a state, unless another was shown just before.
    pub(crate) fn show(&mut self, progress: &Progress) {
        let pause_s = match self.shape {
            Shape::Bar(_) | Shape::Caller => 0.0,
            Shape::Lines => LINE_EVERY_S,
            Shape::Json => JSON_EVERY_S,
            Shape::Silent => return,
        };
        if self.last_s.is_some_and(|last| progress.elapsed_s < last + pause_s) {
            return;
        }
        self.last_s = Some(progress.elapsed_s);
        match &self.shape {
            Shape::Bar(bar) => {
                bar.set_position((share_done(progress) * BAR_STEPS as f64) as u64);
                bar.set_message(line(progress));
            }
            Shape::Lines => note(Note::Info, line(progress)),
            Shape::Json => {
                notes::line(serde_json::to_string(&Report::of(progress)).unwrap_or_default());
            }
            Shape::Caller => {
                let told = ForCaller {
                    report: Report::of(progress),
                    share: share_done(progress),
                    text: line(progress),
                };
                if let (Some(call), Ok(json)) = (caller::here(), serde_json::to_string(&told)) {
                    call.tell(Told::Progress(json));
                }
            }
            Shape::Silent => {}
        }
    }

    /// Leaves the terminal as it was.
    pub(crate) fn finish(&self) {
        if let Shape::Bar(bar) = &self.shape {
            bar.finish_and_clear();
        }
    }
}

/// Time spent over the time predicted.
fn share_done(progress: &Progress) -> f64 {
    let predicted = progress.prediction.map(|p| p.finish_s).filter(|finish| *finish > 0.0);
    predicted.map_or(0.0, |finish| (progress.elapsed_s / finish).clamp(0.0, 1.0))
}

fn line(progress: &Progress) -> String {
    let mut parts = vec![match progress.stage {
        Stage::Pilot => "subdividing".to_owned(),
        Stage::Increments => match progress.unshot {
            Some(unshot) => {
                let shots = counted(progress.increments, "shot", "shots");
                format!("{shots}, {} of the light unshot", show_share(unshot))
            }
            None => counted(progress.increments, "increment", "increments"),
        },
    }];
    match progress.accuracy {
        Some(accuracy) => parts.push(format!("error {}", show_share(accuracy.reached))),
        None if progress.stage == Stage::Pilot => {}
        None => parts.push("error not known yet".to_owned()),
    }
    if let Some(target) = progress.target {
        parts.push(format!("target {}", show_share(target)));
    }
    if let Some(long) = reach::left(progress) {
        parts.push(long);
    } else if let Some(p) = progress.prediction {
        let left = |finish_s: f64| show_seconds((finish_s - progress.elapsed_s).max(0.0));
        let (likely, early) = (left(p.finish_s), left(p.earliest_s));
        let late = match reach::is_beyond_a_day(p.latest_s - progress.elapsed_s) {
            true => "more than a day".to_owned(),
            false => left(p.latest_s),
        };
        parts.push(match () {
            () if p.latest_s <= progress.elapsed_s => "about to end".to_owned(),
            () if p.finish_s <= progress.elapsed_s => format!("up to {late} left"),
            () if p.earliest_s <= progress.elapsed_s => format!("{likely} left (up to {late})"),
            () => format!("{likely} left ({early} to {late})"),
        });
    }
    if progress.elapsed_s > 0.0 {
        parts.push(format!("{} rays/s", show_count(progress.rays_per_s())));
    }
    parts.push(counted(progress.receivers, "receiver", "receivers"));
    parts.join(", ")
}

/// A state as a JSON line.
#[derive(Serialize)]
struct Report {
    stage: &'static str,
    increments: u64,
    accuracy: Option<f64>,
    accuracy_statistical: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    unshot: Option<f64>,
    target: Option<f64>,
    receivers: u64,
    rays: u64,
    rays_per_s: f64,
    elapsed_s: f64,
    finish_s: Option<f64>,
    finish_earliest_s: Option<f64>,
    finish_latest_s: Option<f64>,
}

/// The same for a caller.
#[derive(Serialize)]
struct ForCaller {
    #[serde(flatten)]
    report: Report,
    share: f64,
    text: String,
}

impl Report {
    fn of(progress: &Progress) -> Self {
        Self {
            stage: match progress.stage {
                Stage::Pilot => "pilot",
                Stage::Increments => "increments",
            },
            increments: progress.increments,
            accuracy: progress.accuracy.map(|a| a.reached),
            accuracy_statistical: progress.accuracy.map(|a| a.statistical),
            unshot: progress.unshot,
            target: progress.target,
            receivers: progress.receivers,
            rays: progress.rays,
            rays_per_s: progress.rays_per_s(),
            elapsed_s: progress.elapsed_s,
            finish_s: progress.prediction.map(|p| p.finish_s),
            finish_earliest_s: progress.prediction.map(|p| p.earliest_s),
            finish_latest_s: progress.prediction.map(|p| p.latest_s),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::engine::Prediction;

    #[test]
    fn a_line_says_when() {
        let progress = Progress {
            stage: Stage::Increments,
            increments: 12,
            accuracy: None,
            unshot: None,
            target: Some(0.01),
            receivers: 3458,
            rays: 7_000_000,
            earlier_rays: 4_000_000,
            elapsed_s: 2.0,
            prediction: Some(Prediction { finish_s: 5.0, earliest_s: 4.0, latest_s: 8.0 }),
            ends: false,
        };
        assert_eq!(
            line(&progress),
            "12 increments, error not known yet, target 1.0 %, 3.0 s left (2.0 s to 6.0 s), \
             1.50 M rays/s, 3458 receivers"
        );
        let at = |elapsed_s| line(&Progress { elapsed_s, ..progress.clone() });
        assert!(at(4.5).contains(", 0.50 s left (up to 3.5 s), "), "{}", at(4.5));
        assert!(at(5.5).contains(", up to 2.5 s left, "), "{}", at(5.5));
        assert!(at(8.5).contains(", about to end, "), "{}", at(8.5));
        let long = Prediction { finish_s: 1e6, earliest_s: 1e5, latest_s: 1e7 };
        let long = line(&Progress { prediction: Some(long), ..progress.clone() });
        assert!(long.contains(", more than a day left, a day reaches about 3.4 %, "), "{long}");
        let late = Prediction { latest_s: 1e7, ..progress.prediction.unwrap() };
        let late = line(&Progress { prediction: Some(late), ..progress.clone() });
        assert!(late.contains(", 3.0 s left (2.0 s to more than a day), "), "{late}");
        assert_eq!(share_done(&progress), 0.4);
        assert_eq!(share_done(&Progress { prediction: None, ..progress }), 0.0);
    }
}
