//! What of the light of luminaires never comes to the scene, told beside a map.

use crate::notes::{Note, note};
use crate::quantity::show_share;
use crate::shown;
use isolux::engine::{Arrival, arrivals};
use isolux::scene::Scene;
use serde::Serialize;

/// A luminaire of which less than this arrives lights nothing.
const NOTHING: f64 = 0.01;

/// Smaller shares of all light are not worth a line.
const WORTH_TELLING: f64 = 0.01;

/// Luminaires named in text; JSON holds all.
const MAX_NAMED: usize = 5;

/// Light that comes to no surface that carries the map.
#[derive(Serialize)]
pub(crate) struct FluxLost {
    /// Of the flux of all luminaires, parallel light left out; none where there is no other.
    pub(crate) share: Option<f64>,
    /// The luminaires that lose some, most of it first, and parallel light of which nothing arrives.
    luminaires: Vec<Loser>,
}

#[derive(Serialize)]
struct Loser {
    name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    luminous_flux_lm: Option<f64>,
    /// Of its own flux.
    share: f64,
    /// Whether next to nothing of it arrives.
    lights_nothing: bool,
}

impl FluxLost {
    /// That of a scene; luminaires that light nothing are warned of.
    pub(crate) fn told(scene: &Scene) -> Self {
        let found = Self::of(&arrivals(scene));
        found.tell();
        found
    }

    fn of(arrivals: &[Arrival]) -> Self {
        let flux = |weight: fn(&Arrival) -> f64| {
            arrivals.iter().filter_map(|a| Some(a.luminous_flux_lm? * weight(a))).sum::<f64>()
        };
        let (lost_lm, all_lm) = (flux(|a| a.lost), flux(|_| 1.0));
        let lights_nothing = |a: &Arrival| match a.luminous_flux_lm {
            Some(_) => a.arrives < NOTHING,
            // Parallel light comes in by windows, and mostly to the outside of a room.
            None => a.arrives == 0.0,
        };
        let loses =
            |a: &&Arrival| a.luminous_flux_lm.is_some() && a.lost > 0.0 || lights_nothing(a);
        let mut losers: Vec<&Arrival> = arrivals.iter().filter(loses).collect();
        let lost_lm_of = |a: &Arrival| a.luminous_flux_lm.map_or(f64::INFINITY, |lm| lm * a.lost);
        losers.sort_by(|a, b| lost_lm_of(b).total_cmp(&lost_lm_of(a)));
        let loser = |a: &Arrival| Loser {
            name: a.name.clone(),
            luminous_flux_lm: a.luminous_flux_lm,
            share: a.lost,
            lights_nothing: lights_nothing(a),
        };
        Self {
            share: (all_lm > 0.0).then(|| lost_lm / all_lm),
            luminaires: losers.into_iter().map(loser).collect(),
        }
    }

    fn tell(&self) {
        let dark: Vec<&Loser> = self.luminaires.iter().filter(|l| l.lights_nothing).collect();
        if !dark.is_empty() {
            let named = dark.iter().take(MAX_NAMED).map(|l| format!("`{}`", shown::name(&l.name)));
            let mut named = named.collect::<Vec<_>>().join(", ");
            if dark.len() > MAX_NAMED {
                named += &format!(" and {} more", dark.len() - MAX_NAMED);
            }
            let share = self.share.map_or(String::new(), |share| {
                format!(" ({} of the light of all luminaires is lost)", show_share(share))
            });
            note(
                Note::Warning,
                format!(
                    "almost no light of {named} reaches a surface that carries the map{share}: \
                     `isolux check` names luminaires that light nothing"
                ),
            );
        }
    }

    /// For the table of results, if it is worth it.
    pub(crate) fn text(&self) -> Option<String> {
        self.share.filter(|share| *share >= WORTH_TELLING).map(show_share)
    }
}
