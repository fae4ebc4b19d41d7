//! Runs end only where an independent test of the map lets them.

use super::super::increments::Work;
use super::session::{End, Run};
use crate::ablation::without;
use crate::engine::audit::{AuditSettings, MOST_AUDITS, audit_with, trend};
use crate::map::{Accuracy, Audit};
use std::sync::Arc;

/// What an audit takes, as a share of the rays of the run, and rays that it may take at least: some hundredths of a second.
const AUDIT_SHARE: f64 = 0.1;
const FEWEST_AUDIT_RAYS: u64 = 1 << 14;
/// Paths of a place in the audit of a run.
const PATHS_OF_AUDIT: u32 = 32;
/// A claim that is wrong by more than this is not mended by going on: as errors fall like the root of the work, that would take more than four
/// times what was done.
const MOST_MENDED: f64 = 2.0;

impl Run<'_, '_> {
    /// Whether and why these increments should end here, once the map has been audited if it is to be the last.
    pub(super) fn audited_end(&mut self, work: &Work, accuracy: Option<Accuracy>) -> Option<End> {
        self.audit = None;
        let count = work.sums.increments;
        if let Some(told) = accuracy.filter(|_| count.is_power_of_two()) {
            self.audited.noise.push((count, told.statistical));
        }
        let end = self.end(work, accuracy);
        let is_last = matches!(end, Some(End::Reached | End::InVain)) && !self.stopped;
        let audit = self.request.audit && is_last;
        let Some(audit) = audit.then(|| self.audit(work, accuracy)).flatten() else { return end };
        self.audited.audits = audit.number;
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
        self.audited.true_over_told *= times;
        self.end(work, accuracy)
    }

    /// An independent test of the map as it is now.
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
        let mut audit = audit_with((self.scene, &map), (Arc::clone(lighting), bright), &settings)?;
        audit.trust.trend = trend(&self.audited.noise);
        Some(audit)
    }

    /// The rays of the run, those of direct light at its receivers counted, too, about.
    fn all_rays(&self, work: &Work) -> f64 {
        let lighting = work.plan.lighting;
        let is_once = lighting.samples_exactly() || lighting.is_measured_once();
        let looks = if is_once { 1 } else { work.sums.increments };
        let receivers = work.sums.sums.len() as u64;
        let shadow_rays = looks * receivers * lighting.rays_of_sampled(1);
        (self.rays + shadow_rays) as f64
    }
}
