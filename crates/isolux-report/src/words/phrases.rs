//! What a language has to say, and how it writes numbers.

use isolux::map::{Figure, Verdict};
use isolux::units::{significant, to_error};
use isolux_view::PlanWords;

/// All words of a language. Braces hold places for figures.
#[derive(Debug)]
pub(crate) struct Words {
    /// The language by its code (BCP 47).
    pub(crate) code: &'static str,
    /// Those of plans, which are drawn elsewhere, and the point of numbers.
    pub(crate) plan: PlanWords,
    pub(crate) cover: CoverWords,
    pub(crate) results: ResultWords,
    pub(crate) areas: AreaWords,
    pub(crate) emergency: EmergencyWords,
    pub(crate) budget: BudgetWords,
    pub(crate) luminaires: LuminaireWords,
    pub(crate) daylight: DaylightWords,
    pub(crate) glare: GlareWords,
    pub(crate) views: ViewWords,
    pub(crate) accuracy: AccuracyWords,
    pub(crate) assumptions: AssumptionWords,
    pub(crate) definitions: &'static [(&'static str, &'static str)],
    /// Of them, those of a year of daylight.
    pub(crate) definitions_daylight: &'static [(&'static str, &'static str)],
    pub(crate) definitions_title: &'static str,
    pub(crate) met: &'static str,
    pub(crate) not_met: &'static str,
    pub(crate) undecided: &'static str,
    /// Between the ends of an interval.
    pub(crate) to: &'static str,
    pub(crate) unknown: &'static str,
    pub(crate) contents: &'static str,
    pub(crate) page: &'static str,
}

#[derive(Debug)]
pub(crate) struct CoverWords {
    pub(crate) subtitle: &'static str,
    pub(crate) subtitle_daylight: &'static str,
    pub(crate) client: &'static str,
    pub(crate) author: &'static str,
    pub(crate) date: &'static str,
    pub(crate) scene: &'static str,
    pub(crate) size: &'static str,
    pub(crate) sky: &'static str,
    pub(crate) software: &'static str,
    pub(crate) mean: &'static str,
    pub(crate) uniformity: &'static str,
    pub(crate) picture: &'static str,
    pub(crate) median_factor: &'static str,
    pub(crate) foot: &'static str,
}

#[derive(Debug)]
pub(crate) struct ResultWords {
    pub(crate) title: &'static str,
    pub(crate) none: &'static str,
    pub(crate) lead: &'static str,
    pub(crate) caption: &'static str,
    pub(crate) area: &'static str,
    pub(crate) requirement: &'static str,
    pub(crate) found: &'static str,
    pub(crate) result: &'static str,
    /// `{}` is a probability.
    pub(crate) likely: &'static str,
    pub(crate) all_met: &'static str,
    /// `{met}` of `{all}`.
    pub(crate) some_met: &'static str,
    pub(crate) figures: &'static str,
    pub(crate) columns: [&'static str; 6],
}

#[derive(Debug)]
pub(crate) struct AreaWords {
    pub(crate) title: &'static str,
    pub(crate) plan: &'static str,
    pub(crate) plan_shows: &'static str,
    pub(crate) points: &'static str,
    /// `{x}`, `{y}`, `{dx}`, `{dy}`.
    pub(crate) points_are: &'static str,
    pub(crate) size: &'static str,
    pub(crate) border: &'static str,
    pub(crate) height: &'static str,
    pub(crate) factor: &'static str,
    pub(crate) factor_none: &'static str,
    pub(crate) factor_in_luminaires: &'static str,
    pub(crate) outside: &'static str,
    pub(crate) nothing: &'static str,
    /// `{mean}`, `{direct}`, `{indirect}`.
    pub(crate) sentence: &'static str,
    /// `{error}`.
    pub(crate) values_caption: &'static str,
    pub(crate) too_many: &'static str,
    pub(crate) row: &'static str,
}

#[derive(Debug)]
pub(crate) struct EmergencyWords {
    pub(crate) title: &'static str,
    /// `{count}`.
    pub(crate) lead: &'static str,
    pub(crate) caption: &'static str,
    /// Where a condition is of, after it.
    pub(crate) centre_line: &'static str,
    pub(crate) middle_half: &'static str,
    pub(crate) core: &'static str,
    pub(crate) high_risk: &'static str,
    /// Of a ratio to nothing.
    pub(crate) dark: &'static str,
}

#[derive(Debug)]
pub(crate) struct BudgetWords {
    pub(crate) caption: &'static str,
    pub(crate) columns: [&'static str; 4],
    pub(crate) calculation: &'static str,
    pub(crate) flux: &'static str,
    /// `{name}`.
    pub(crate) flux_of: &'static str,
    pub(crate) maintenance: &'static str,
    /// `{name}`.
    pub(crate) reflectance: &'static str,
    pub(crate) other_reflectances: &'static str,
    /// `{mean}`.
    pub(crate) together: &'static str,
}

#[derive(Debug)]
pub(crate) struct LuminaireWords {
    pub(crate) title: &'static str,
    pub(crate) none: &'static str,
    pub(crate) caption: &'static str,
    pub(crate) columns: [&'static str; 8],
    pub(crate) total: &'static str,
    pub(crate) point: &'static str,
    pub(crate) area: &'static str,
    pub(crate) surface: &'static str,
    pub(crate) diagram: &'static str,
    pub(crate) diagram_shows: &'static str,
    pub(crate) positions: &'static str,
    pub(crate) positions_columns: [&'static str; 5],
    pub(crate) positions_too_many: &'static str,
    pub(crate) power_unknown: &'static str,
}

#[derive(Debug)]
pub(crate) struct DaylightWords {
    pub(crate) title: &'static str,
    /// The values of its plans.
    pub(crate) factor: &'static str,
    /// `{place}`, `{from}`, `{to}`, `{ground}`, `{paths}`.
    pub(crate) lead: &'static str,
    pub(crate) plan: &'static str,
    pub(crate) caption: &'static str,
    pub(crate) columns: [&'static str; 3],
    pub(crate) factor_mean: &'static str,
    pub(crate) sky_component: &'static str,
    pub(crate) factor_median: &'static str,
    pub(crate) factor_95: &'static str,
    pub(crate) target_half: &'static str,
    pub(crate) target_95: &'static str,
    pub(crate) en_17037: [&'static str; 3],
    pub(crate) autonomy: &'static str,
    pub(crate) spatial: &'static str,
    pub(crate) spatial_55: &'static str,
    pub(crate) spatial_75: &'static str,
    pub(crate) exposure: &'static str,
    pub(crate) useful: [&'static str; 4],
    pub(crate) not_in: &'static str,
}

#[derive(Debug)]
pub(crate) struct GlareWords {
    pub(crate) title: &'static str,
    pub(crate) lead: &'static str,
    pub(crate) caption: &'static str,
    pub(crate) columns: [&'static str; 5],
    pub(crate) none: &'static str,
    pub(crate) below: &'static str,
}

#[derive(Debug)]
pub(crate) struct ViewWords {
    pub(crate) title: &'static str,
    pub(crate) picture: &'static str,
    pub(crate) chart: &'static str,
}

#[derive(Debug)]
pub(crate) struct AccuracyWords {
    pub(crate) title: &'static str,
    pub(crate) methods: [&'static str; 4],
    pub(crate) lead: &'static str,
    pub(crate) asked: &'static str,
    pub(crate) reached: &'static str,
    pub(crate) noise: &'static str,
    pub(crate) interpolation: &'static str,
    pub(crate) bias: &'static str,
    pub(crate) relative_to: &'static str,
    pub(crate) audited: &'static str,
    /// `{places}`, `{found}`.
    pub(crate) audit: &'static str,
    pub(crate) contradicted: &'static str,
    pub(crate) not_contradicted: &'static str,
    pub(crate) not_audited: &'static str,
    pub(crate) energy: &'static str,
    /// `{emitted}`, `{absorbed}`, `{escaped}`.
    pub(crate) energy_is: &'static str,
    pub(crate) rays: &'static str,
    pub(crate) seed: &'static str,
    pub(crate) incomplete: &'static str,
    pub(crate) none: &'static str,
}

#[derive(Debug)]
pub(crate) struct AssumptionWords {
    pub(crate) title: &'static str,
    pub(crate) initial: &'static str,
    /// `{factor}`.
    pub(crate) maintained: &'static str,
    /// `{least}`, `{greatest}`.
    pub(crate) maintained_range: &'static str,
    pub(crate) grid_factor: &'static str,
    pub(crate) empty: &'static str,
    pub(crate) as_given: &'static str,
    pub(crate) surfaces: &'static str,
    pub(crate) surfaces_caption: &'static str,
    pub(crate) surfaces_columns: [&'static str; 4],
    pub(crate) glass: &'static str,
    /// `{reflectance}`, `{area}`.
    pub(crate) mean_reflectance: &'static str,
    pub(crate) findings: &'static str,
    pub(crate) warning: &'static str,
    pub(crate) note: &'static str,
    pub(crate) no_findings: &'static str,
    /// Of languages other than that of the findings.
    pub(crate) findings_language: &'static str,
}

impl Words {
    pub(crate) fn verdict(&self, verdict: Verdict) -> &'static str {
        match verdict {
            Verdict::Met => self.met,
            Verdict::NotMet => self.not_met,
            Verdict::Undecided => self.undecided,
        }
    }

    /// A number with the point of the language.
    pub(crate) fn local(&self, number: &str) -> String {
        self.plan.local(number)
    }

    /// A number with so many significant digits.
    pub(crate) fn number(&self, value: f64, digits: usize) -> String {
        self.local(&significant(value, digits))
    }

    /// A number with a given count of digits behind the point.
    pub(crate) fn fixed(&self, value: f64, decimals: usize) -> String {
        // Nothing has no sign.
        self.local(&format!("{:.decimals$}", if value.abs() < 1e-12 { 0.0 } else { value }))
    }

    /// A number to the first digit of its error.
    pub(crate) fn to_error(&self, value: f64, error: f64) -> String {
        self.local(&to_error(value, error))
    }

    /// A figure with its interval, in digits of half of it, and of no less than this.
    pub(crate) fn figure(&self, of: Figure, least: f64) -> String {
        let half = of.half_width().max(least);
        let [value, low, high] = [of.value, of.low, of.high].map(|n| self.to_error(n, half));
        match low == value && high == value {
            true => value,
            false => format!("{value} ({low} {} {high})", self.to),
        }
    }

    /// A share in per cent with its interval.
    pub(crate) fn percent(&self, of: Figure, least_percent: f64) -> String {
        format!("{}\u{a0}%", self.figure(of.times(100.0), least_percent))
    }

    /// A share in per cent.
    pub(crate) fn share(&self, share: f64) -> String {
        format!("{} %", self.number(100.0 * share, 2))
    }
}
