//! The power of the luminaires of a scene, and what it is for every square metre of floor.

mod floor;

use crate::quantity::significant;
use floor::floor_m2;
use isolux::map::Figure;
use isolux::scene::Scene;
use isolux::units::to_error;
use isolux_formats::counted;
use serde::Serialize;

/// Illuminance that power densities are compared by, lx.
const COMPARED_LX: f64 = 100.0;

/// What is installed. Skies and the sun need no power.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct Installed {
    /// Of all luminaires; `None` where that of some is not known, or where there are none.
    installed_power_w: Option<f64>,
    /// Of those whose power is known.
    known_power_w: f64,
    luminaires_with_power: usize,
    luminaires_without_power: usize,
    /// The plan area below the luminaires; `None` where nothing is below any, and where their power is not known.
    floor_m2: Option<f64>,
    power_density_w_m2: Option<f64>,
}

impl Installed {
    pub(crate) fn of(scene: &Scene) -> Self {
        let all = scene.luminaires().iter().zip(scene.fittings());
        let near = || all.clone().filter(|(luminaire, _)| !luminaire.kind.is_infinitely_far());
        let known = || near().filter_map(|(_, fitting)| fitting.power_w);
        let without = near().count() - known().count() + scene.area_luminaires().len();
        let (with, known_w) = (known().count(), known().sum::<f64>() + 0.0);
        let is_known = with > 0 && without == 0;
        Self::new((known_w, with, without), is_known.then(|| floor_m2(scene)).flatten())
    }

    fn new((known_w, with, without): (f64, usize, usize), floor_m2: Option<f64>) -> Self {
        let power_w = (with > 0 && without == 0).then_some(known_w);
        Self {
            installed_power_w: power_w,
            known_power_w: known_w,
            luminaires_with_power: with,
            luminaires_without_power: without,
            floor_m2,
            power_density_w_m2: power_w.zip(floor_m2).map(|(w, m2)| w / m2),
        }
    }

    /// Power density for every 100 lx of a mean illuminance, W/m2.
    pub(crate) fn per_100_lx(&self, mean_lx: Figure) -> Option<Figure> {
        let w_m2 = self.power_density_w_m2?;
        let per = |lx: f64| w_m2 * COMPARED_LX / lx;
        let Figure { value, low, high } = mean_lx;
        (low > 0.0).then(|| Figure { value: per(value), low: per(high), high: per(low) })
    }

    /// The words for it, with power densities for every 100 lx on grids, if there are luminaires that need power.
    pub(crate) fn with_grids(&self, grids: &[(String, Figure)]) -> Option<String> {
        let per = |(grid, mean_lx): &(String, Figure)| {
            let per = self.per_100_lx(*mean_lx)?;
            let written = |w_m2: f64| to_error(w_m2, 0.5 * (per.high - per.low));
            let [value, low, high] = [per.value, per.low, per.high].map(written);
            Some(format!("; {value} W/m2 ({low} to {high}) for 100 lx on {grid}"))
        };
        Some(self.text()? + &grids.iter().filter_map(per).collect::<String>())
    }

    /// The words for it; `None` without luminaires that need power.
    pub(crate) fn text(&self) -> Option<String> {
        let (with, without) = (self.luminaires_with_power, self.luminaires_without_power);
        let known_w = significant(self.known_power_w, 4);
        let Some(_) = self.installed_power_w else {
            return match (with, without) {
                (_, 0) => None,
                (0, _) => Some("not known; give power_w, or files that say it".to_owned()),
                _ => Some(format!(
                    "not known: {known_w} W of {}, and {without} without power_w",
                    counted(with, "luminaire", "luminaires")
                )),
            };
        };
        Some(match self.power_density_w_m2.zip(self.floor_m2) {
            Some((w_m2, m2)) => {
                let [w_m2, m2] = [w_m2, m2].map(|number| significant(number, 3));
                format!("{known_w} W, {w_m2} W/m2 of {m2} m2 floor")
            }
            None => format!("{known_w} W; there is no floor below the luminaires"),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn densities_by_hand() {
        let all = Installed::new((240.0, 8, 0), Some(30.0));
        assert_eq!(all.power_density_w_m2, Some(8.0));
        assert_eq!(all.text().unwrap(), "240.0 W, 8.00 W/m2 of 30.0 m2 floor");
        let per = all.per_100_lx(Figure { value: 400.0, low: 320.0, high: 500.0 }).unwrap();
        assert_eq!(per, Figure { value: 2.0, low: 1.6, high: 2.5 });
        assert_eq!(all.per_100_lx(Figure { value: 0.0, low: 0.0, high: 0.0 }), None);
    }

    #[test]
    fn unknown_power_is_not_zero() {
        let some = Installed::new((240.0, 8, 1), Some(30.0));
        assert_eq!((some.installed_power_w, some.power_density_w_m2), (None, None));
        assert!(some.text().unwrap().starts_with("not known: 240.0 W of 8 luminaires"));
        let none = Installed::new((0.0, 0, 2), Some(30.0));
        assert!(none.installed_power_w.is_none() && none.text().unwrap().starts_with("not known"));
        assert_eq!(Installed::new((0.0, 0, 0), None).text(), None);
    }
}
