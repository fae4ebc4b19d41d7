//! Where the light goes, and whether the map has all of it.

use crate::console::table;
use crate::notes::{Note, note};
use crate::quantity::significant;
use crate::shown;
use isolux::engine::energy_balance;
use isolux::map::{EnergyBalance, IlluminationMap, MeasuredFlux, SurfaceBalance};
use isolux::scene::Scene;
use isolux::units::{to_error, with_error};

/// Particles for the report of a run: the flux on a surface that has a tenth of the light is known to a twentieth.
const OF_A_RUN: u32 = 1 << 12;
/// Particles for an audit that was asked for.
const OF_AN_AUDIT: u32 = 1 << 16;

/// Digits of fluxes, and the relative error from which these show it.
const DIGITS: usize = 4;
const SHOWN_ERROR: f64 = 1e-4;

/// The balance for the report of a run; it warns where the map lacks light, or has too much. `None` where parallel light
/// has no flux, and of maps whose error is not known.
pub(crate) fn of_run(scene: &Scene, map: &IlluminationMap) -> Option<EnergyBalance> {
    map.provenance.audit.as_ref()?;
    let balance = energy_balance(scene, map, OF_A_RUN, map.provenance.seed)?;
    if !balance.holds() {
        note(Note::Warning, failure(&balance));
    }
    Some(balance)
}

/// The balance for an audit.
pub(crate) fn of_audit(scene: &Scene, map: &IlluminationMap, seed: u64) -> Option<EnergyBalance> {
    energy_balance(scene, map, OF_AN_AUDIT, seed)
}

/// One line for the report of a run.
pub(crate) fn line(balance: &EnergyBalance) -> String {
    let [absorbed, escaped] = [balance.absorbed, balance.escaped].map(lm);
    let emitted = significant(balance.emitted_lm, DIGITS);
    let given_up = match balance.given_up.lm > SHOWN_ERROR * balance.emitted_lm {
        true => format!(", {} given up", lm(balance.given_up)),
        false => String::new(),
    };
    format!("{emitted} lm: absorbed {absorbed}, escaped {escaped}{given_up}")
}

/// What is wrong with a balance that does not hold.
fn failure(balance: &EnergyBalance) -> String {
    let (what, arriving, mapped) = match balance.surfaces.first() {
        Some(worst) => {
            (format!("on {}", shown::name(&worst.shape)), worst.arriving, worst.mapped_lm)
        }
        None => ("on all surfaces".to_owned(), balance.arriving, balance.mapped_lm),
    };
    format!(
        "the map does not have the light of the scene: {what} it has {} lm, particles bring ({}) lm; \
         `isolux audit` shows more",
        to_error(mapped, arriving.standard_error_lm),
        with_error(arriving.lm, arriving.standard_error_lm)
    )
}

/// For people: where the light goes, what the map has, and where that differs.
pub(crate) fn text(balance: &EnergyBalance) -> String {
    let result = |holds: bool| if holds { "passed" } else { "not passed" };
    let row = |what: String, arriving: MeasuredFlux, mapped_lm: f64, explained_lm: f64| {
        let apart = (arriving.lm - mapped_lm).abs();
        let noise = arriving.standard_error_lm;
        vec![
            what,
            with_error(arriving.lm, noise),
            to_error(mapped_lm, noise),
            to_error(explained_lm, explained_lm / 10.0),
            result(apart <= explained_lm).to_owned(),
        ]
    };
    let all = "all surfaces".to_owned();
    let mut rows = vec![row(all, balance.arriving, balance.mapped_lm, balance.explained_lm)];
    rows.extend(balance.surfaces.iter().map(|of| {
        let SurfaceBalance { shape, arriving, mapped_lm, explained_lm } = of;
        row(shown::name(shape), *arriving, *mapped_lm, *explained_lm)
    }));
    let header = ["light that arrives", "particles, lm", "map, lm", "may differ, lm", "result"];
    format!("\n emitted  {}\n\n{}", line(balance), table(&header, &rows))
}

/// A flux, with its error where its digits show it.
fn lm(flux: MeasuredFlux) -> String {
    match flux.standard_error_lm > SHOWN_ERROR * flux.lm {
        true => with_error(flux.lm, flux.standard_error_lm),
        false => significant(flux.lm, DIGITS),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flux(lm: f64, standard_error_lm: f64) -> MeasuredFlux {
        MeasuredFlux { lm, standard_error_lm }
    }

    #[test]
    fn surfaces_that_lack_light_are_named() {
        let mut balance = EnergyBalance {
            particles: 4096,
            rays: 20_000,
            emitted_lm: 1000.0,
            absorbed: flux(950.2, 4.0),
            escaped: flux(49.8, 4.0),
            given_up: flux(0.0, 0.0),
            arriving: flux(2000.0, 10.0),
            mapped_lm: 2010.0,
            explained_lm: 90.0,
            surfaces: Vec::new(),
        };
        assert!(balance.holds());
        assert_eq!(line(&balance), "1000 lm: absorbed 950 \u{b1} 4, escaped 50 \u{b1} 4");
        assert!(text(&balance).contains("passed"));
        balance.surfaces.push(SurfaceBalance {
            shape: "desk".into(),
            arriving: flux(100.0, 2.0),
            mapped_lm: 60.0,
            explained_lm: 15.0,
        });
        assert!(!balance.holds());
        let said = failure(&balance);
        assert!(said.contains("desk") && said.contains("it has 60 lm"), "{said}");
        assert!(text(&balance).contains("not passed"));
    }
}
