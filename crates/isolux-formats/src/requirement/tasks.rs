//! Tasks of EN 12464-1:2021: rows of its tables with the maintained illuminance and the uniformity that they require. Only values
//! of illuminance on the task area are here; glare and colour rendering are for other judges.

use isolux::scene::{Condition, GridQuantity};

/// A row of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Task {
    row: &'static str,
    name: &'static str,
    mean_lx: f64,
    uniformity: f64,
}

const fn task_of(row: &'static str, name: &'static str, mean_lx: f64, uniformity: f64) -> Task {
    Task { row, name, mean_lx, uniformity }
}

/// Tables 9 (traffic zones), 10 (general areas), 34 (offices) and 44 (education), as far as public sources quote rows by the numbers of this
/// edition.
const TASKS: [Task; 13] = [
    task_of("9.1", "corridors and circulation areas", 100.0, 0.4),
    task_of("9.4", "areas in front of lifts", 200.0, 0.4),
    task_of("10.4", "cloakrooms, washrooms, toilets", 200.0, 0.4),
    task_of("10.6", "sick bays", 500.0, 0.6),
    task_of("10.7", "rooms for medical attention", 500.0, 0.6),
    task_of("34.1", "filing, copying, etc.", 300.0, 0.4),
    task_of("34.2", "writing, typing, reading, data processing", 500.0, 0.6),
    task_of("34.3", "technical drawing", 750.0, 0.7),
    task_of("34.4", "CAD work stations", 500.0, 0.6),
    task_of("34.5", "conference and meeting rooms", 500.0, 0.6),
    task_of("34.6", "reception desk", 300.0, 0.6),
    task_of("34.7", "archiving", 200.0, 0.4),
    task_of("44.1", "classrooms", 500.0, 0.6),
];

/// The task of a row.
pub(super) fn task(row: &str) -> Result<Task, String> {
    let known = || TASKS.map(|task| task.row).join(", ");
    let found = TASKS.into_iter().find(|task| task.row == row);
    found
        .ok_or_else(|| format!("row `{row}` of EN 12464-1 is not known; choose one of {}", known()))
}

impl Task {
    pub(super) const fn conditions(&self) -> [Condition; 2] {
        [
            Condition { of: GridQuantity::Mean, is_least: true, bound: self.mean_lx },
            Condition { of: GridQuantity::Uniformity, is_least: true, bound: self.uniformity },
        ]
    }

    pub(super) fn title(&self) -> String {
        format!("EN 12464-1:2021, {}, {}", self.row, self.name)
    }
}
