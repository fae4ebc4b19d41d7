//! Audits in a run: an independent test of the map before its increments end.

use super::super::increments::Work;
use super::session::{End, Run};
use crate::ablation::without;
use crate::engine::audit::{AuditSettings, MOST_AUDITS, audit_with, trend};
use crate::map::{Accuracy, Audit};
use std::sync::Arc;

/// The rays of an audit, as a share of the rays of the run.
const AUDIT_SHARE: f64 = 0.1;
/// The number of rays that an audit may always take: some hundredths of a second.
const FEWEST_AUDIT_RAYS: u64 = 1 << 14;
/// The number of paths at a place in the audit of a run.
const PATHS_OF_AUDIT: u32 = 32;
/// The largest ratio of the true error to the reported one for which a run continues. Errors fall like the root of the
/// work, so a larger ratio would take more than four times the work done.
const MOST_MENDED: f64 = 2.0;

impl Run<'_, '_> {
    /// Whether and why the increments end here. The map is audited first if they are about to end.
    pub(super) fn audited_end(&mut self, work: &Work, accuracy: Option<Accuracy>) -> Option<End> {
        self.audit = None;
        self.note_noise(work, accuracy);
        let end = self.end(work, accuracy);
        let is_last = matches!(end, Some(End::Reached | End::InVain)) && !self.stopped;
        let audit = self.request.audit && is_last;
        let Some(audit) = audit.then(|| self.audit(work, accuracy)).flatten() else { return end };
        if !audit.contradicts {
            self.audit = Some(audit);
            return end;
        }
        let times = audit.error.value / audit.told;
        let goes_on = !without("audit-feedback")
            && end == Some(End::Reached)
            && audit.number < MOST_AUDITS
            && times * self.audited.true_over_told <= MOST_MENDED;
        if !goes_on {
            self.audit = Some(audit);
            return Some(End::Contradicted);
        }
        // An audit that ends the run is not kept: a run that ends by its time limit and goes on makes the same one again.
        self.audited.audits = audit.number;
        self.audited.true_over_told *= times;
        self.end(work, accuracy)
    }

    /// Notes the reported noise where the number of increments is a power of two.
    pub(super) fn note_noise(&mut self, work: &Work, accuracy: Option<Accuracy>) {
        let count = work.sums.increments;
        // Increments are judged a second time where a saved run goes on, or the time ends within the next one.
        let noise =
            accuracy.filter(|_| count.is_power_of_two()).map(|told| (count, told.statistical));
        if noise.is_some() && noise != self.audited.noise.last().copied() {
            self.audited.noise.extend(noise);
        }
    }

    /// An audit of the present map.
    fn audit(&self, work: &Work, accuracy: Option<Accuracy>) -> Option<Audit> {
        let lighting = self.lighting.as_ref()?;
        let map = self.map(work, accuracy, true);
        let bright = work.plan.light.bright.clone();
        let settings = AuditSettings {
            paths: PATHS_OF_AUDIT,
            most_rays: ((AUDIT_SHARE * self.all_rays(work)) as u64).max(FEWEST_AUDIT_RAYS),
            seed: self.request.seed,
            number: self.audited.audits + 1,
            ..AuditSettings::default()
        };
        let prepared = (Arc::clone(lighting), bright);
        let mut audit = audit_with((self.scene, &map), prepared, (&settings, &mut |_: f64| {}))?;
        audit.trust.trend = trend(&self.audited.noise);
        Some(audit)
    }

    /// The approximate number of rays of the run, shadow rays of direct light at its receivers included.
    fn all_rays(&self, work: &Work) -> f64 {
        let lighting = work.plan.lighting;
        let is_once = lighting.samples_exactly() || lighting.is_measured_once();
        let looks = if is_once { 1 } else { work.sums.increments };
        let receivers = work.sums.sums.len() as u64;
        let shadow_rays = looks * receivers * lighting.rays_of_sampled(1);
        (self.rays + shadow_rays) as f64
    }
}
