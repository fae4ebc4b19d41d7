//! How the map was computed, and how good it is.

use crate::document::{Block, Section};
use crate::report::Report;
use crate::words::{Words, fill};
use isolux::map::{EnergyBalance, Method, Provenance};

#[expect(clippy::unnecessary_wraps, reason = "sections of a report may be missing")]
pub(super) fn section(report: &Report, language: &Words) -> Option<Section> {
    let says = &language.accuracy;
    let blocks = match &report.provenance {
        None => vec![Block::Text(says.none.to_owned())],
        Some(from) => {
            let method = match from.method {
                Method::Hybrid => says.methods[0],
                Method::Forward => says.methods[1],
                Method::Radiosity => says.methods[2],
                Method::Cache => says.methods[3],
            };
            let mut blocks = vec![Block::Text(format!("{method} {}", says.lead))];
            if !from.complete {
                blocks.push(Block::Text(says.incomplete.to_owned()));
            }
            blocks.push(Block::Facts(facts(report, from, language)));
            blocks
        }
    };
    Some(Section { id: "accuracy", title: says.title.to_owned(), blocks })
}

fn facts(report: &Report, from: &Provenance, language: &Words) -> Vec<(String, String)> {
    let says = &language.accuracy;
    let unknown = || language.unknown.to_owned();
    let share = |share: Option<f64>| share.map_or_else(unknown, |share| language.share(share));
    let of = from.accuracy;
    let mut facts = vec![
        (says.asked, share(from.accuracy_target)),
        (says.reached, share(of.map(|of| of.reached))),
        (says.noise, share(of.map(|of| of.statistical))),
        (says.interpolation, share(of.map(|of| of.discretization))),
        (says.bias, share(of.map(|of| of.bias))),
        (says.relative_to, format!("{} lx", language.number(report.reference_lx, 3))),
        (says.audited, audited(from, language)),
    ];
    facts.extend(report.energy.as_ref().map(|of| (says.energy, balance(of, language))));
    facts.push((says.rays, grouped(from.rays)));
    facts.push((says.seed, from.seed.to_string()));
    facts.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

fn audited(from: &Provenance, language: &Words) -> String {
    let says = &language.accuracy;
    let Some(audit) = &from.audit else { return says.not_audited.to_owned() };
    let [value, low, high] =
        [audit.error.value, audit.error.low, audit.error.high].map(|share| language.share(share));
    let found = format!("{value} ({low} {} {high})", language.to);
    let verdict = if audit.contradicts { says.contradicted } else { says.not_contradicted };
    let places = [("found", &*found), ("places", &audit.places.to_string())];
    format!("{}; {verdict}", fill(says.audit, &places))
}

fn balance(of: &EnergyBalance, language: &Words) -> String {
    let [emitted, absorbed, escaped] =
        [of.emitted_lm, of.absorbed.lm, of.escaped.lm].map(|lm| language.number(lm, 3));
    let places = [("emitted", &*emitted), ("absorbed", &absorbed), ("escaped", &escaped)];
    fill(language.accuracy.energy_is, &places)
}

/// A count in groups of three digits, as both languages read it.
fn grouped(count: u64) -> String {
    let digits = count.to_string();
    let mut text = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_grouped() {
        assert_eq!(grouped(999), "999");
        assert_eq!(grouped(1_234_567), "1\u{202f}234\u{202f}567");
    }
}
