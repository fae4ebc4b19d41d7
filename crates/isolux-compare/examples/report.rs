//! Writes the reports of a study again: `report STUDY.json FOLDER`, where FOLDER has its pictures and takes `report.html`, `report.md`, `study.csv` and
//! graphs.

use isolux_compare::report;
use isolux_compare::study::Study;
use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args_os().skip(1);
    let (Some(study), Some(folder)) = (arguments.next(), arguments.next()) else {
        return Err("report STUDY.json FOLDER".into());
    };
    let study: Study = serde_json::from_slice(&std::fs::read(study)?)?;
    write(&study, Path::new(&folder))
}

fn write(study: &Study, folder: &Path) -> Result<(), Box<dyn Error>> {
    let picture = |name: &str| std::fs::read(folder.join(name)).ok();
    std::fs::create_dir_all(folder.join("graphs"))?;
    std::fs::write(folder.join("report.html"), report::html(study, &picture))?;
    std::fs::write(folder.join("report.md"), report::markdown(study))?;
    std::fs::write(folder.join("study.csv"), report::csv(study))?;
    for graph in report::graphs(study) {
        std::fs::write(folder.join(graph.name), graph.svg)?;
    }
    Ok(())
}
