//! Requirements on calculation grids: `desks: Em >= 500, U0 >= 0.6`, or a task of EN 12464-1.

use super::condition::{Condition, condition};
use super::result::GridResult;
use super::tasks::task;
use crate::failure::Failure;
use crate::interval::{Interval, Verdict};
use crate::maintained::Maintained;
use crate::notes::{Note, note};
use crate::shown::name;
use serde::Serialize;

/// What has to hold on one grid, or on each.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Requirement {
    grid: Option<String>,
    /// The task that it follows from, with its place in the standard.
    task: Option<String>,
    conditions: Vec<Condition>,
}

/// A condition on a grid, and what came of it.
#[derive(Debug, Serialize)]
pub(super) struct Judged {
    grid: String,
    /// The task of a standard, if it follows from one.
    task: Option<String>,
    condition: String,
    #[serde(flatten)]
    figure: Interval,
    pub(super) verdict: Verdict,
    /// How likely it holds, if errors are normal.
    probability: f64,
}

/// Reads the words of `--require`.
pub(super) fn requirement(text: &str) -> Result<Requirement, String> {
    let (grid, rest) = match text.split_once(':') {
        Some((grid, rest)) => (Some(grid.trim().to_owned()), rest.trim()),
        None => (None, text.trim()),
    };
    if let Some(row) = rest.strip_prefix("EN 12464-1").map(str::trim) {
        let task = task(row)?;
        let conditions = task.conditions().to_vec();
        return Ok(Requirement { grid, task: Some(task.title()), conditions });
    }
    let conditions = rest.split(',').map(condition).collect::<Result<Vec<_>, _>>()?;
    Ok(Requirement { grid, task: None, conditions })
}

/// All conditions on all grids that they are for.
pub(super) fn judge(
    requirements: &[Requirement],
    results: &[GridResult],
) -> Result<Vec<Judged>, Failure> {
    let mut judged = Vec::new();
    for requirement in requirements {
        let is_for = |result: &&GridResult| {
            requirement.grid.as_ref().is_none_or(|grid| *grid == result.read.grid.name)
        };
        let mut for_these = results.iter().filter(is_for).peekable();
        if for_these.peek().is_none() {
            let grid = requirement.grid.as_deref().unwrap_or_default();
            let what = format!("--require: there is no grid `{}`", name(grid));
            return Err(Failure::bad_input(format!("{what}; name one that is read")));
        }
        for result in for_these {
            let grid = &result.read.grid.name;
            let Some(figures) = &result.read.figures else {
                let what = format!("--require: nothing is known on grid `{}`", name(grid));
                return Err(Failure::bad_input(format!("{what}; put it where light is")));
            };
            judged.extend(requirement.conditions.iter().map(|condition| {
                let figure = condition.of.of(figures);
                Judged {
                    grid: grid.clone(),
                    task: requirement.task.clone(),
                    condition: condition.text(),
                    figure: figure.into(),
                    verdict: condition.verdict(figure),
                    probability: condition.probability(figure),
                }
            }));
        }
    }
    Ok(judged)
}

/// Standards require maintained values.
pub(super) fn warn_of_initial(judged: &[Judged], results: &[GridResult], light: Maintained) {
    for GridResult { read, .. } in results {
        let grid = &read.grid;
        let is_task = |of: &&Judged| of.task.is_some() && of.grid == grid.name;
        let is_initial = light.on_grid(grid.maintenance_factor).is_initial();
        if is_initial && judged.iter().any(|of| is_task(&of)) {
            let grid = name(&grid.name);
            let what = "EN 12464-1 requires maintained values, and these are initial";
            let remedy = "give a maintenance factor, as --maintenance-factor 0.8";
            note(Note::Warning, format!("grid `{grid}`: {what}; {remedy}"));
        }
    }
}

impl Judged {
    /// The line that people read.
    pub(super) fn line(&self) -> String {
        let task = self.task.as_ref().map_or(String::new(), |task| format!(" ({task})"));
        let likely = match self.verdict {
            Verdict::Undecided => format!(", {:.0} % likely", 100.0 * self.probability),
            _ => String::new(),
        };
        let said = self.verdict.text();
        format!("{}: {}{task}: {said}{likely}", name(&self.grid), self.condition)
    }
}

#[cfg(test)]
mod tests {
    use super::super::condition::Quantity;
    use super::*;
    use isolux::map::Figure;

    #[test]
    fn requirements_are_read() {
        let found = requirement("desks: Em >= 500 lx, U0 >= 0.6").unwrap();
        assert_eq!(found.grid.as_deref(), Some("desks"));
        let mean = Condition { of: Quantity::Mean, is_least: true, bound: 500.0 };
        let even = Condition { of: Quantity::Uniformity, is_least: true, bound: 0.6 };
        assert_eq!(found.conditions, [mean, even]);
        let found = requirement("EN 12464-1 34.2").unwrap();
        assert_eq!(found.conditions, [mean, even]);
        assert!(found.task.unwrap().contains("34.2"));
        for text in ["", "Em", "Em > 500", "E >= 500", "Em >= x", "Em >= -1", "EN 12464-1 99.9"] {
            assert!(requirement(text).is_err(), "{text}");
        }
    }

    #[test]
    fn verdicts_and_their_probabilities() {
        let least = |bound: f64| Condition { of: Quantity::Mean, is_least: true, bound };
        let figure = Figure { value: 500.0, low: 490.0, high: 520.0 };
        assert_eq!(least(489.0).verdict(figure), Verdict::Met);
        assert_eq!(least(521.0).verdict(figure), Verdict::NotMet);
        assert_eq!(least(500.0).verdict(figure), Verdict::Undecided);
        assert!((least(500.0).probability(figure) - 0.5).abs() < 1e-12);
        // One end of an interval of 95 %.
        assert!((least(490.0).probability(figure) - 0.975).abs() < 1e-4);
        assert!((least(520.0).probability(figure) - 0.025).abs() < 1e-4);
        let exact = Figure { value: 500.0, low: 500.0, high: 500.0 };
        assert_eq!(least(500.0).probability(exact), 1.0);
    }
}
