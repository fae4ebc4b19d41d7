//! What was compared, on what, and what became of the conclusions of the study.

use super::{names, systems};
use crate::report::document::{Block, Section, Table, numbers, words};
use crate::report::quantity::{UNKNOWN, asked, count, list, things};
use crate::study::{Answer, CaseStudy, Conclusion, Study, System, conclusions};

/// The title of the report.
pub(super) const TITLE: &str = "Illumination maps compared: the study of GraphiCon’98 made anew";

/// The report in a paragraph.
pub(super) fn lead(study: &Study) -> String {
    let (own, others): (Vec<System>, Vec<System>) =
        systems::of(study).into_iter().partition(|system| system.method().is_some());
    let own = things(own.len(), "system", "systems");
    let others = match others.len() {
        0 => String::new(),
        others => format!(" and {}", things(others, "other renderer", "other renderers")),
    };
    let scenes: Vec<String> = study.cases.iter().map(names::name).collect();
    let stopped = if study.is_unfinished { " It was stopped before its end." } else { "" };
    let when = match times_s(study) {
        Some([first, last]) if first < last => {
            format!("aiming at times that double from {} to {}", asked(first), asked(last))
        }
        Some([_, last]) => format!("aiming at {} each", asked(last)),
        None if study.analytic.is_empty() => "but no map was finished".to_owned(),
        None => {
            return format!(
                "isolux {} computed the analytic cases of CIE 171:2006.{stopped}",
                study.isolux
            );
        }
    };
    format!(
        "{own} of isolux {}{others} computed illumination of {}, {when}. Errors are measured where right values are known; elsewhere pictures are \
         compared.{stopped} Scenes, measures and conclusions are those of Kopylov, Khodulev and Volevich [1], who compared LVS 3.1.1 and Inspirer 5.30.",
        study.isolux,
        if scenes.is_empty() { "no scene".to_owned() } else { list(&scenes) },
    )
}

/// The least and the greatest time asked for, s.
fn times_s(study: &Study) -> Option<[f64; 2]> {
    let series = study.cases.iter().flat_map(|case| &case.series);
    let mut times_s = series.flat_map(|series| &series.points).map(|point| point.asked_s);
    let first = times_s.next()?;
    Some(times_s.fold([first; 2], |[least, most], t| [least.min(t), most.max(t)]))
}

/// The conclusions of the study, tested again.
pub(super) fn tested_again(study: &Study) -> Section {
    let row = |(number, of): (usize, Conclusion)| {
        vec![format!("{}. {}", number + 1, of.statement), answer(of.answer).to_owned(), of.figures]
    };
    let table = Table::plain(
        "What the study concludes, and whether it holds of these systems",
        ["Conclusion of the study", "Holds here", "Figures"].map(words).to_vec(),
        conclusions(study).into_iter().enumerate().map(row).collect(),
    );
    Section {
        id: "conclusions".to_owned(),
        title: "Four conclusions tested again".to_owned(),
        blocks: vec![Block::Table(table)],
    }
}

fn answer(answer: Answer) -> &'static str {
    match answer {
        Answer::Yes => "yes",
        Answer::No => "no",
        Answer::Unknown => "not known",
    }
}

/// What was compared, and on what.
pub(super) fn compared(study: &Study) -> Section {
    let mut blocks = vec![Block::Table(facts(study)), Block::Table(scenes(&study.cases))];
    blocks.push(systems::table(&systems::of(study)));
    if !study.missing.is_empty() {
        let missing = study.missing.join("; ");
        blocks.push(Block::Text(format!("Asked for and not compared: {missing}.")));
    }
    Section { id: "compared".to_owned(), title: "What was compared".to_owned(), blocks }
}

fn facts(study: &Study) -> Table {
    let (machine, settings) = (&study.machine, &study.settings);
    let [width, height] = settings.picture;
    let rows = [
        ("isolux", study.isolux.clone()),
        ("Processor", machine.processor.clone()),
        ("Cores that may be used", count(machine.cores as u64)),
        ("Operating system", machine.system.clone()),
        ("Threads of every system", count(settings.threads as u64)),
        ("Seed of all random numbers", settings.seed.to_string()),
        ("Longest time aimed at", asked(settings.limit_s)),
        ("Pictures", format!("{width} × {height} pixels")),
    ];
    let peers = study
        .versions
        .iter()
        .map(|of| (of.system.title(), format!("Python package {}", of.version)));
    let row = |(name, value): (&str, String)| {
        vec![name.to_owned(), if value.is_empty() { UNKNOWN.to_owned() } else { value }]
    };
    let rows = rows.into_iter().chain(peers).map(row).collect();
    Table::plain("Runs", vec![words("What"), words("Value")], rows)
}

fn scenes(cases: &[CaseStudy]) -> Table {
    let row = |case: &CaseStudy| {
        vec![
            names::name(case),
            count(u64::from(case.triangles)),
            count(case.luminaires as u64),
            case.scene_hash.clone(),
        ]
    };
    let columns = vec![words("Scene"), numbers("Triangles"), numbers("Luminaires"), words("Hash")];
    Table::plain("Scenes", columns, cases.iter().map(row).collect())
}
