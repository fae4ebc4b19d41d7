//! Whether values are initial or maintained. A maintenance factor counts once: in the light of luminaires, or on a grid.

use crate::failure::Failure;
use crate::quantity::significant;
use isolux::scene::{Maintenance, Scene};
use serde::Serialize;
use std::path::Path;

/// Kinds of values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
enum Values {
    /// Of new luminaires.
    Initial,
    /// Times a maintenance factor.
    Maintained,
    /// Of luminaires of which some have a factor.
    Both,
}

/// What values are, and by which factors.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct Maintained {
    /// Whether they are maintained.
    #[serde(rename = "maintenance")]
    values: Values,
    /// The least and the greatest factor in the light of luminaires; none where there is none.
    luminaire_maintenance: Option<Maintenance>,
}

impl Maintained {
    /// Whether no factor is in any value.
    pub(crate) fn is_initial(&self) -> bool {
        self.values == Values::Initial
    }

    /// The values of a map, or of paths.
    pub(crate) fn of(scene: &Scene) -> Self {
        Self::by(scene.maintenance())
    }

    fn by(factors: Option<Maintenance>) -> Self {
        let values = match factors {
            None => Values::Initial,
            Some(factors) if factors.greatest < 1.0 => Values::Maintained,
            Some(_) => Values::Both,
        };
        Self { values, luminaire_maintenance: factors }
    }

    /// The same times the factor of a grid.
    pub(crate) fn on_grid(self, factor: f64) -> Self {
        let values = if factor == 1.0 { self.values } else { Values::Maintained };
        Self { values, ..self }
    }

    /// The words for it.
    pub(crate) fn text(&self) -> String {
        let factors = |of: Maintenance| [of.least, of.greatest].map(|f| significant(f, 2));
        match (self.values, self.luminaire_maintenance.map(factors)) {
            (Values::Both, Some([least, _])) => {
                format!(
                    "maintained and initial: some luminaires have a maintenance factor, down to {least}"
                )
            }
            (_, Some([least, greatest])) if least != greatest => {
                format!(
                    "maintained: luminaires have maintenance factors from {least} to {greatest}"
                )
            }
            (_, Some([factor, _])) => {
                format!("maintained: luminaires have a maintenance factor of {factor}")
            }
            (Values::Maintained, None) => "maintained".to_owned(),
            (_, None) => "initial".to_owned(),
        }
    }

    /// Whether all of them are initial.
    pub(crate) fn are_initial(&self) -> bool {
        self.values == Values::Initial
    }
}

/// Refuses a factor on values that contain one already.
pub(crate) fn refuse_second(factor: f64, scene: &Scene, source: &Path) -> Result<(), Failure> {
    match scene.maintenance() {
        Some(known) if factor != 1.0 => Err(Failure::bad_input(format!(
            "--maintenance-factor: luminaires of {} have a maintenance factor of {} in their light already, and it \
             counts once; leave the flag out, or remove the factor of the luminaires",
            source.display(),
            significant(known.least, 2)
        ))),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_told_by_their_factors() {
        let by = |least, greatest| Maintained::by(Some(Maintenance { least, greatest }));
        assert_eq!(Maintained::by(None).text(), "initial");
        assert_eq!(Maintained::by(None).on_grid(0.8).text(), "maintained");
        assert!(
            by(0.8, 0.8).text().ends_with("a maintenance factor of 0.80"),
            "{:?}",
            by(0.8, 0.8)
        );
        assert!(by(0.7, 0.9).text().ends_with("from 0.70 to 0.90"));
        assert!(by(0.8, 1.0).text().starts_with("maintained and initial"));
        assert!(Maintained::by(None).are_initial() && !by(0.8, 1.0).are_initial());
        let json = serde_json::to_value(by(0.8, 1.0)).unwrap();
        assert_eq!(json["maintenance"], "both");
        assert_eq!(json["luminaire_maintenance"]["least"], 0.8);
    }
}
