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

use crate::console::{print, print_json, wrapped};
use crate::failure::{Failure, Outcome};
use crate::flags::CompareFlags;
use crate::interrupt::Interrupt;
use crate::notes::{Note, note};
use folder::Folder;
use isolux_compare::case::cie171::CASES;
use isolux_compare::report;
use isolux_compare::study::{Answer, Series, Settings, Study, conclusions};
use pace::Pace;
use peers::Peers;
use plan::Plan;

/// Runs the subcommand.
pub(crate) fn run(flags: &CompareFlags, json: bool) -> Result<Outcome, Failure> {
    let plan = Plan::of(flags)?;
    let peers = Peers::of(&plan.peers);
    check_something_to_do(&plan, &peers)?;
    let folder = Folder::create(&flags.output)?;
    let interrupt = Interrupt::install()?;
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
    study.is_unfinished = interrupt.is_requested();
    tell_of_none(&mut study);
    write(&folder, &study)?;
    if json {
        print_json(&study)?
    } else {
        print(&text(&study, &folder))?
    }
    Ok(if interrupt.is_requested() { Outcome::Interrupted } else { Outcome::Done })
}

/// Refuses systems none of which can do any of the cases.
fn check_something_to_do(plan: &Plan, peers: &Peers) -> Result<(), Failure> {
    let exact = plan.cases.iter().filter(|case| case.is_exact);
    let has_peer = exact.map(|case| peers.systems(&case.name)).any(|of| !of.is_empty());
    let mut analytic = CASES.iter().flat_map(|of| of.names);
    let has_analytic = plan.is_analytic && analytic.any(|name| !peers.systems(name).is_empty());
    if !plan.systems.is_empty() || has_peer || has_analytic {
        return Ok(());
    }
    let missing: String = peers.missing.iter().map(|why| format!("; {why}")).collect();
    Err(Failure::bad_input(format!(
        "--systems: none of these can do any of these cases; other renderers do cube, sphere and cie171 where they are installed{missing}"
    )))
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
        is_unfinished: false,
        versions: Vec::new(),
        missing: Vec::new(),
    }
}

/// Other renderers that were asked and found nothing in the time are told of, without a series.
fn tell_of_none(study: &mut Study) {
    for case in &mut study.cases {
        let is_none =
            |series: &Series| series.points.is_empty() && series.system.method().is_none();
        for series in case.series.iter().filter(|series| is_none(series)) {
            let title = series.system.title();
            study.missing.push(format!("{title} on {} (no effort ended in the time)", case.name));
        }
        case.series.retain(|series| !is_none(series));
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
    // What was not run tells nothing of the study's conclusions.
    let line = |of: &isolux_compare::study::Conclusion| match of.answer {
        Answer::Yes => Some(wrapped(&format!("{} Yes: {}", of.statement, of.figures))),
        Answer::No => Some(wrapped(&format!("{} No: {}", of.statement, of.figures))),
        Answer::Unknown => None,
    };
    let conclusions: String = conclusions(study).iter().filter_map(line).collect();
    format!("{conclusions}report {}\n", folder.path("report.html").display())
}
