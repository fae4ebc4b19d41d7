//! Requirements as people write them: `Em >= 500, U0 >= 0.6`, or a task of EN 12464-1.

mod tasks;

use isolux::scene::{Condition, GridQuantity, Requirement};
use tasks::task;

const HOW: &str =
    "write `Em >= 500`, with Em, Emin, Emax, U0, Ud or UGR, and >= or <=; or `EN 12464-1 34.2`";

/// Reads conditions, or a task.
pub fn requirement(text: &str) -> Result<Requirement, String> {
    if let Some(row) = text.trim().strip_prefix("EN 12464-1").map(str::trim) {
        let task = task(row)?;
        return Ok(Requirement {
            task: Some(task.title()),
            conditions: task.conditions().to_vec(),
        });
    }
    let conditions = text.split(',').map(condition).collect::<Result<Vec<_>, _>>()?;
    Ok(Requirement { task: None, conditions })
}

fn condition(text: &str) -> Result<Condition, String> {
    let parts = [(">=", true), ("<=", false)]
        .into_iter()
        .find_map(|(sign, is_least)| Some((text.split_once(sign)?, is_least)));
    let Some(((word, number), is_least)) = parts else {
        return Err(format!("`{}` is no condition; {HOW}", text.trim()));
    };
    let of = GridQuantity::ALL.into_iter().find(|(known, _)| *known == word.trim());
    let Some((_, of)) = of else {
        return Err(format!("`{}` is no figure of a grid; {HOW}", word.trim()));
    };
    let number = number.trim().strip_suffix("lx").unwrap_or(number).trim();
    let bound = match number.parse::<f64>() {
        Ok(bound) if bound.is_finite() && bound >= 0.0 => bound,
        _ => return Err(format!("`{number}` is no number of zero or more; {HOW}")),
    };
    match of.most() {
        Some(most) if bound > most => {
            Err(format!("{} is a ratio of at most 1, and `{number}` is more", of.symbol()))
        }
        _ => Ok(Condition { of, is_least, bound }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requirements_are_read() {
        let mean = Condition { of: GridQuantity::Mean, is_least: true, bound: 500.0 };
        let even = Condition { of: GridQuantity::Uniformity, is_least: true, bound: 0.6 };
        let found = requirement("Em >= 500 lx, U0 >= 0.6").unwrap();
        assert_eq!(found, Requirement { task: None, conditions: vec![mean, even] });
        let found = requirement("EN 12464-1 34.2").unwrap();
        assert_eq!(found.conditions, [mean, even]);
        assert!(found.task.unwrap().contains("34.2"));
        let [mean, even] = requirement("EN 12464-1 44.1").unwrap().conditions[..] else { panic!() };
        assert_eq!((mean.bound, even.bound), (500.0, 0.6));
        // Regression: a uniformity of 6 was accepted, and is never met.
        for text in
            ["", "Em", "Em > 500", "E >= 500", "Em >= x", "Em >= -1", "EN 12464-1 99.9", "U0 >= 6"]
        {
            assert!(requirement(text).is_err(), "{text}");
        }
    }
}
