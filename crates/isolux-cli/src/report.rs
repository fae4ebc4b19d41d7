//! How good a map is and what it took.

use crate::arriving::FluxLost;
use crate::audit;
use crate::console::facts;
use crate::energy;
use crate::kept::LessKnown;
use crate::lightmap;
use crate::maintained::Maintained;
use crate::output::OutputPath;
use crate::quantity::{show_bytes, show_count, show_seconds, show_share, significant};
use crate::request::method_name;
use isolux::engine::reference_lx;
use isolux::map::{Audit, EnergyBalance, IlluminationMap, KnownSurface};
use isolux::scene::Scene;
use serde::Serialize;

/// What `solve --json` prints.
#[derive(Serialize)]
pub(crate) struct Report {
    scene: String,
    method: &'static str,
    complete: bool,
    accuracy_target: Option<f64>,
    pub(crate) accuracy_reached: Option<f64>,
    accuracy_statistical: Option<f64>,
    accuracy_discretization: Option<f64>,
    accuracy_bias: Option<f64>,
    accuracy_interpolated: Option<f64>,
    /// What these are shares of.
    reference_lx: f64,
    /// The area that they are a mean over, and the lit part of it.
    surface_m2: f64,
    lit_surface_m2: f64,
    #[serde(flatten)]
    maintained: Maintained,
    accuracy_audited: Option<f64>,
    accuracy_audited_low: Option<f64>,
    accuracy_audited_high: Option<f64>,
    audit_places: Option<u64>,
    audit_paths: Option<u64>,
    audit: Option<Audit>,
    #[serde(skip_serializing_if = "Option::is_none")]
    unshot: Option<f64>,
    pub(crate) time_s: f64,
    /// The most memory that the command has taken so far.
    memory_peak_bytes: u64,
    increments: u64,
    rays: u64,
    receivers: usize,
    seed: u64,
    #[serde(skip_serializing_if = "String::is_empty")]
    pub(crate) map: String,
    /// Light that does not come to the scene, where that was looked at.
    #[serde(skip_serializing_if = "Option::is_none")]
    flux_lost: Option<FluxLost>,
    /// Where the light goes, where that was looked at.
    #[serde(skip_serializing_if = "Option::is_none")]
    energy: Option<EnergyBalance>,
    /// What a resumed run has come to that the map is not of: it was there before, and knows more.
    #[serde(skip_serializing_if = "Option::is_none")]
    kept_instead_of: Option<LessKnown>,
    /// Of a map as texels.
    #[serde(skip_serializing_if = "Option::is_none")]
    lightmap: Option<lightmap::Report>,
}

impl Report {
    /// Of a map, the time it took, and where it was written.
    pub(crate) fn of(
        (scene, map): (&Scene, &IlluminationMap),
        time_s: f64,
        output: &OutputPath,
    ) -> Self {
        let from = &map.provenance;
        let KnownSurface { all_m2, lit_m2 } = map.known_surface();
        Self {
            scene: from.scene.clone(),
            method: method_name(from.method),
            complete: from.complete,
            accuracy_target: from.accuracy_target,
            accuracy_reached: from.accuracy.map(|a| a.reached),
            accuracy_statistical: from.accuracy.map(|a| a.statistical),
            accuracy_discretization: from.accuracy.map(|a| a.discretization),
            accuracy_bias: from.accuracy.map(|a| a.bias),
            accuracy_interpolated: from.accuracy.map(|a| a.interpolated),
            reference_lx: reference_lx(map),
            surface_m2: all_m2,
            lit_surface_m2: lit_m2,
            maintained: Maintained::of(scene),
            accuracy_audited: from.audit.as_ref().map(|a| a.error.value),
            accuracy_audited_low: from.audit.as_ref().map(|a| a.error.low),
            accuracy_audited_high: from.audit.as_ref().map(|a| a.error.high),
            audit_places: from.audit.as_ref().map(|a| a.places),
            audit_paths: from.audit.as_ref().map(|a| a.paths),
            audit: from.audit.clone(),
            unshot: from.unshot.map(|unshot| unshot.share),
            time_s,
            memory_peak_bytes: isolux_memory::peak_bytes(),
            increments: from.increments,
            rays: from.rays,
            receivers: map.values.len(),
            seed: from.seed,
            map: output.path().display().to_string(),
            flux_lost: None,
            energy: None,
            kept_instead_of: None,
            lightmap: None,
        }
    }

    /// The same of a map that was kept, if one was, instead of what the run has come to.
    pub(crate) fn instead_of(self, less: Option<LessKnown>) -> Self {
        Self { kept_instead_of: less, ..self }
    }

    /// The same with a lightmap, if there is one.
    pub(crate) fn with_lightmap(self, lightmap: Option<lightmap::Report>) -> Self {
        Self { lightmap, ..self }
    }

    /// The same with where the light goes.
    pub(crate) fn with_energy(self, energy: Option<EnergyBalance>) -> Self {
        Self { energy, ..self }
    }

    /// The same with what of the light does not come to the scene.
    pub(crate) fn with_flux_lost(self, lost: FluxLost) -> Self {
        Self { flux_lost: Some(lost), ..self }
    }

    /// The same of a map that is not kept.
    pub(crate) fn without_map(self) -> Self {
        Self { map: String::new(), ..self }
    }

    /// What the error is a share of, and over which area.
    fn relative_to(&self) -> String {
        let [lx, lit_m2, all_m2] =
            [self.reference_lx, self.lit_surface_m2, self.surface_m2].map(|of| significant(of, 3));
        format!("{lx} lx over {all_m2} m2 of surface, of which {lit_m2} m2 are lit")
    }

    /// For people.
    pub(crate) fn text(&self) -> String {
        let share = |s: Option<f64>| s.map_or("not known".to_owned(), show_share);
        let reached = match self.accuracy_target {
            Some(target) if !self.complete => {
                format!("{}; {} was asked for", share(self.accuracy_reached), show_share(target))
            }
            _ => share(self.accuracy_reached),
        };
        let mut all = Vec::new();
        if !self.map.is_empty() {
            all.push(("map", self.map.clone()));
        }
        all.extend([
            ("error", reached),
            ("  from noise", share(self.accuracy_statistical)),
            ("  from interpolation", share(self.accuracy_discretization)),
            ("  from light at ray ends and cut-off paths", share(self.accuracy_bias)),
            ("  relative to", self.relative_to()),
            ("  audited", self.audit.as_ref().map_or("no".to_owned(), audit::line)),
            ("error of the interpolated map", share(self.accuracy_interpolated)),
            ("values", self.maintained.text()),
            ("time", show_seconds(self.time_s)),
            ("memory", format!("{}, the program itself aside", show_bytes(self.memory_peak_bytes))),
            ("receivers", self.receivers.to_string()),
            ("increments", self.increments.to_string()),
            ("rays", show_count(self.rays as f64)),
        ]);
        if let Some(unshot) = self.unshot {
            all.push(("light unshot", show_share(unshot)));
        }
        if let Some(balance) = &self.energy {
            all.push(("light, lm", energy::line(balance)));
        }
        if let Some(lost) = self.flux_lost.as_ref().and_then(FluxLost::text) {
            all.push(("light that reaches no surface", lost));
        }
        let lightmap = self.lightmap.as_ref().map(lightmap::Report::text);
        facts(&all) + &lightmap.unwrap_or_default()
    }
}
