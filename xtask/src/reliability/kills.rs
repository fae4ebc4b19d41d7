//! Runs that are stopped in every way, at any moment, and resumed: they end with the bytes of one that was never stopped.

use super::cases::CASES;
use super::dice::Dice;
use super::runs::{Bench, Ended, Maps, ended, is_over, signal, start, wait};
use super::told::Told;
use crate::case::Case;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::process::Child;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// How often it is looked whether a file is being written.
const GLANCE: Duration = Duration::from_micros(200);
/// The most between two signals.
const TWICE_WITHIN_MS: usize = 50;
/// One in so many runs is stopped again after it was resumed.
const AGAIN: usize = 3;
/// Numbers of threads before and after.
const THREADS: [&str; 4] = ["1", "2", "3", "7"];

/// What stops a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Fault {
    Kill,
    KillWriting,
    Terminate,
    Interrupt,
    InterruptTwice,
    HangUp,
    TimeLimit,
}

impl Fault {
    const ALL: [Self; 7] = [
        Self::Kill,
        Self::KillWriting,
        Self::Terminate,
        Self::Interrupt,
        Self::InterruptTwice,
        Self::HangUp,
        Self::TimeLimit,
    ];

    const fn name(self) -> &'static str {
        match self {
            Self::Kill => "SIGKILL",
            Self::KillWriting => "SIGKILL while a file is written",
            Self::Terminate => "SIGTERM",
            Self::Interrupt => "SIGINT",
            Self::InterruptTwice => "SIGINT twice",
            Self::HangUp => "SIGHUP",
            Self::TimeLimit => "--time-limit",
        }
    }

    /// Whether a run may end so: complete before the fault, or as the fault has it. Before a run listens a signal ends it at once.
    fn may_end(self, code: Option<i32>) -> bool {
        match self {
            Self::Kill | Self::KillWriting => matches!(code, None | Some(0)),
            Self::TimeLimit => matches!(code, Some(0 | 3)),
            _ => matches!(code, None | Some(0 | 130)),
        }
    }

    /// Does it to a run `after` its start, and gives its end.
    fn befall(
        self,
        bench: &Bench,
        mut child: Child,
        after: Duration,
        dice: &mut Dice,
    ) -> Result<Ended, String> {
        if self != Self::TimeLimit {
            sleep(after);
        }
        match self {
            Self::Kill => signal(&child, "KILL")?,
            Self::KillWriting => {
                while !is_over(&mut child) && bench.unfinished() == 0 {
                    sleep(GLANCE);
                }
                // Straight to the system: a file is written in some milliseconds. One that has ended is not there any more.
                let _ = child.kill();
            }
            Self::Terminate => signal(&child, "TERM")?,
            Self::Interrupt => signal(&child, "INT")?,
            Self::InterruptTwice => {
                signal(&child, "INT")?;
                sleep(Duration::from_millis(dice.below(TWICE_WITHIN_MS) as u64));
                signal(&child, "INT")?;
            }
            Self::HangUp => signal(&child, "HUP")?,
            Self::TimeLimit => {}
        }
        wait(child)
    }
}

/// What became of the runs of one fault.
#[derive(Default)]
struct Count {
    runs: u64,
    stopped: u64,
    from_state: u64,
    maps_read: u64,
    unfinished: u64,
    in_time: u64,
    same: u64,
}

/// Stops `count` runs.
pub(super) fn run(
    bench: &Bench,
    (seed, count): (u64, u64),
    told: &mut Told,
) -> Result<Value, String> {
    let mut dice = Dice::new(seed, "kills");
    let mut wholes = Vec::new();
    for case in &CASES {
        let (maps, time) = bench.whole(case, "2")?;
        told.step(&format!("{}: {:.1} s undisturbed", case.name, time.as_secs_f64()));
        wholes.push((case, maps, time));
    }
    let mut counts: BTreeMap<usize, Count> = BTreeMap::new();
    // Moments fill the time of a run evenly, however many there are.
    let golden = (5_f64.sqrt() - 1.0) / 2.0;
    let first = dice.share();
    for number in 0..count as usize {
        let kind = number % Fault::ALL.len();
        let (case, maps, time) = &wholes[number % wholes.len()];
        let share = (first + golden * number as f64).fract();
        let stopped =
            Stopped { bench, case, maps, fault: Fault::ALL[kind], after: time.mul_f64(share) };
        stopped.run(&mut dice, counts.entry(kind).or_default(), told)?;
    }
    let rows = counts.into_iter().map(|(kind, c)| {
        json!({
            "fault": Fault::ALL[kind].name(), "runs": c.runs, "stopped": c.stopped, "from_state": c.from_state,
            "maps_read": c.maps_read, "unfinished_left": c.unfinished,
            "in_time": c.in_time, "same_bytes": c.same,
        })
    });
    Ok(rows.collect())
}

/// A run that is stopped.
struct Stopped<'a> {
    bench: &'a Bench<'a>,
    case: &'a Case,
    /// What it is to end with.
    maps: &'a Maps,
    fault: Fault,
    after: Duration,
}

impl Stopped<'_> {
    fn run(&self, dice: &mut Dice, count: &mut Count, told: &mut Told) -> Result<(), String> {
        let Self { bench, fault, .. } = self;
        bench.clear()?;
        count.runs += 1;
        let problem = self.disturbed(&[], dice, count)?.or(match dice.below(AGAIN) {
            0 => self.disturbed(&["--resume"], dice, count)?,
            _ => None,
        });
        count.unfinished += bench.unfinished() as u64;
        // A map that is complete within its limit may have increments with fewer rays, and is kept.
        let is_in_time = *fault == Fault::TimeLimit && bench.has_complete_map();
        let threads = THREADS[dice.below(THREADS.len())];
        let resumed = ended(bench.solve(self.case, &[], &["--resume", "--threads", threads]))?;
        count.from_state += u64::from(!resumed.said.contains("no such run to resume"));
        let others = bench.others();
        let problem = problem.or_else(|| {
            if resumed.code != Some(0) {
                Some(format!("the resumed run fails: {resumed:?}"))
            } else if bench.maps() != *self.maps && !is_in_time {
                Some("the resumed run ends with other bytes".to_owned())
            } else {
                (!others.is_empty()).then(|| format!("{} is left", others.join(", ")))
            }
        });
        let (name, after) = (self.case.name, self.after.as_secs_f64());
        let what = format!("{name}: {} after {after:.2} s", fault.name());
        match problem {
            None if is_in_time => count.in_time += 1,
            None => count.same += 1,
            Some(problem) => told.problem(&format!("{what}: {problem}")),
        }
        told.step(&what);
        Ok(())
    }

    /// A run that the fault befalls, and what is wrong then.
    fn disturbed(
        &self,
        flags: &[&str],
        dice: &mut Dice,
        count: &mut Count,
    ) -> Result<Option<String>, String> {
        let threads = THREADS[dice.below(THREADS.len())];
        let limit = format!("{}ms", self.after.as_millis().max(1));
        let mut all = [flags, &["--threads", threads]].concat();
        if self.fault == Fault::TimeLimit {
            all.extend(["--time-limit", &limit]);
        }
        let begun = Instant::now();
        let child = start(self.bench.solve(self.case, &[], &all))?;
        let left = self.after.saturating_sub(begun.elapsed());
        let ended = self.fault.befall(self.bench, child, left, dice)?;
        count.stopped += u64::from(ended.code != Some(0));
        if !self.fault.may_end(ended.code) {
            return Ok(Some(format!("the run ends otherwise: {ended:?}")));
        }
        if let Some(map) = self.bench.broken_map()? {
            return Ok(Some(format!("{map} cannot be read")));
        }
        count.maps_read += self.bench.maps().len() as u64;
        Ok(None)
    }
}
