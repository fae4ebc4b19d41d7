//! `isolux compare`: the study of GraphiCon'98 made anew.

mod analytic;
mod case;
mod costs;
mod folder;
mod kept;
mod machine;
mod pace;
mod peers;
mod pictures;
mod plan;
mod point;
mod wrong;

use crate::console::{print, print_json};
use crate::failure::{Failure, Outcome};
use crate::flags::CompareFlags;
use crate::interrupt::Interrupt;
use crate::notes::{Note, note};
use folder::Folder;
use isolux_compare::report;
use isolux_compare::study::{Answer, Settings, Study, conclusions};
use pace::Pace;
use peers::Peers;
use plan::Plan;

/// Runs the subcommand.
pub(crate) fn run(flags: &CompareFlags, json: bool) -> Result<Outcome, Failure> {
    let plan = Plan::of(flags)?;
    let folder = Folder::create(&flags.output)?;
    let interrupt = Interrupt::install()?;
    let peers = Peers::of(&plan.peers);
    let mut study = empty(flags, &plan);
    (study.versions, study.missing) = (peers.versions.clone(), peers.missing.clone());
    for missing in &study.missing {
        note(Note::Info, format!("not compared: {missing}"));
    }
    let mut pace = Pace::start(&plan);
    for case in &plan.cases {
        let done = case::compare(case, (&plan, &peers, &folder), &interrupt, &mut pace)?;
        study.cases.extend(done);
        if interrupt.is_requested() {
            break;
        }
    }
    if plan.is_analytic && !interrupt.is_requested() {
        study.analytic = analytic::measure(&peers, (&plan, &folder), &interrupt, &mut pace)?;
    }
    if !interrupt.is_requested() {
        study.costs = costs::measure((&plan, &folder), &interrupt, &mut pace)?;
    }
    write(&folder, &study)?;
    if json {
        print_json(&study)?
    } else {
        print(&text(&study, &folder))?
    }
    Ok(if interrupt.is_requested() { Outcome::Interrupted } else { Outcome::Done })
}

fn empty(flags: &CompareFlags, plan: &Plan) -> Study {
    Study {
        isolux: env!("CARGO_PKG_VERSION").to_owned(),
        machine: machine::this(),
        settings: Settings {
            limit_s: plan.limit_s,
            seed: flags.seed,
            threads: rayon::current_num_threads(),
            picture: plan.picture,
        },
        cases: Vec::new(),
        analytic: Vec::new(),
        costs: Vec::new(),
        versions: Vec::new(),
        missing: Vec::new(),
    }
}

/// The report in all its forms.
fn write(folder: &Folder, study: &Study) -> Result<(), Failure> {
    let picture = |name: &str| folder.picture(name);
    let json = serde_json::to_vec_pretty(study).expect("plain values always have a JSON text");
    folder.write("study.json", &json)?;
    folder.write("study.csv", report::csv(study).as_bytes())?;
    folder.write("report.md", report::markdown(study).as_bytes())?;
    report::graphs(study).iter().try_for_each(|of| folder.write(&of.name, of.svg.as_bytes()))?;
    folder.write("report.html", report::html(study, &picture).as_bytes())
}

fn text(study: &Study, folder: &Folder) -> String {
    let answer = |answer: Answer| match answer {
        Answer::Yes => "Yes",
        Answer::No => "No",
        Answer::Unknown => "Not known",
    };
    let line = |of: &isolux_compare::study::Conclusion| {
        format!("{} {}: {}\n", of.statement, answer(of.answer), of.figures)
    };
    let conclusions: String = conclusions(study).iter().map(line).collect();
    format!("{conclusions}report {}\n", folder.path("report.html").display())
}
