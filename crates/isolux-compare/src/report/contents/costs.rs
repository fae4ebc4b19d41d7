//! What larger scenes cost.

use crate::report::document::{Block, Section, Table, numbers};
use crate::report::graph::{Axis, Dot, Graph, Line, Scale};
use crate::report::quantity::{count, known, number, percent};
use crate::study::{Cost, System, Varied};

/// Graphs and figures; `None` where nothing was measured.
pub(super) fn section(costs: &[Cost]) -> Option<Section> {
    if costs.is_empty() {
        return None;
    }
    let graphs = [
        graph(costs, Varied::Triangles, "cost-triangles", "triangles"),
        graph(costs, Varied::Luminaires, "cost-luminaires", "luminaires"),
    ];
    Some(Section {
        id: "costs".to_owned(),
        title: "What larger scenes cost".to_owned(),
        blocks: vec![
            Block::Text(says(costs)),
            Block::Graphs(graphs.into_iter().filter(|graph| !graph.is_empty()).collect()),
            Block::Table(table(costs)),
        ],
    })
}

fn says(costs: &[Cost]) -> String {
    let growth = [(Varied::Triangles, "triangles"), (Varied::Luminaires, "luminaires")];
    let said = growth.into_iter().filter_map(|(varied, name)| {
        let of: Vec<&Cost> = costs.iter().filter(|cost| cost.varied == varied).collect();
        let [first, .., last] = of.as_slice() else { return None };
        let [more, longer] = [size(last) / size(first), last.time_s / first.time_s].map(number);
        Some(format!(" With {more} times the {name} a map takes {longer} times as long."))
    });
    format!(
        "HALL with its surfaces divided into more triangles, and with its flux from more luminaires; the hybrid method, without reading the scene.{}",
        said.collect::<String>()
    )
}

/// How much there is of what was varied.
fn size(cost: &Cost) -> f64 {
    match cost.varied {
        Varied::Triangles => f64::from(cost.triangles),
        Varied::Luminaires => cost.luminaires as f64,
    }
}

fn graph(costs: &[Cost], varied: Varied, id: &str, name: &str) -> Graph {
    let dot = |cost: &Cost| Dot { x: size(cost), y: cost.time_s, interval: None };
    let points = costs.iter().filter(|cost| cost.varied == varied).map(dot).collect::<Vec<_>>();
    let line = Line { title: System::Hybrid.title().to_owned(), look: 0, points };
    Graph {
        id: id.to_owned(),
        title: format!("Time over {name}"),
        description: format!(
            "What a map of HALL of the same accuracy takes, over its number of {name}."
        ),
        x: Axis { title: name.to_owned(), scale: Scale::Decades },
        y: Axis { title: "time, s".to_owned(), scale: Scale::Decades },
        lines: Some(line).into_iter().filter(|line| !line.points.is_empty()).collect(),
        rules: Vec::new(),
    }
}

fn table(costs: &[Cost]) -> Table {
    let row = |cost: &Cost| {
        vec![
            count(u64::from(cost.triangles)),
            count(cost.luminaires as u64),
            percent(cost.accuracy),
            known(cost.told, percent),
            number(cost.time_s),
        ]
    };
    let columns = ["Triangles", "Luminaires", "Asked for, %", "Reported error, %", "Took, s"];
    Table::plain(
        "Maps of variants of HALL",
        columns.map(numbers).to_vec(),
        costs.iter().map(row).collect(),
    )
}
