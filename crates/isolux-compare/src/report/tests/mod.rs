//! Reports of a study that never ran.

mod synthetic;

use super::{csv, graphs, html, markdown};
use crate::study::{Study, System};
use roxmltree::{Document, Node, ParsingOptions};
use serde_json::Value;

const PNG: &[u8] = b"\x89PNG\r\n\x1a\n made up";

fn no_picture(_: &str) -> Option<Vec<u8>> {
    None
}

fn parsed(html: &str) -> Document<'_> {
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    Document::parse_with_options(html, options).expect("the page is well-formed")
}

/// A study of which only scenes are known.
fn bare() -> Study {
    let mut study = synthetic::study();
    study.costs.clear();
    study.analytic.clear();
    for case in &mut study.cases {
        (case.reference, case.landing, case.error_limit) = (None, None, None);
        for series in &mut case.series {
            series.points.truncate(1);
            series.error_picture = None;
            for point in &mut series.points {
                point.reported = Default::default();
                point.predictions.clear();
                (point.audited, point.measured, point.picture) = (None, None, None);
                (point.from_last, point.from_reference) = (None, None);
            }
        }
    }
    study
}

/// A study that was stopped before its first map.
fn empty() -> Study {
    Study { cases: Vec::new(), costs: Vec::new(), analytic: Vec::new(), ..synthetic::study() }
}

#[test]
fn pages_are_well_formed_and_need_nothing_beside_them() {
    let picture = |_: &str| Some(PNG.to_vec());
    for study in [synthetic::study(), bare(), empty()] {
        for html in [html(&study, &picture), html(&study, &no_picture)] {
            let page = parsed(&html);
            let attributes = page.descendants().flat_map(|node| node.attributes());
            for attribute in attributes.filter(|a| ["src", "href"].contains(&a.name())) {
                let value = attribute.value();
                let is_own = value.starts_with('#') || value.starts_with("data:");
                assert!(is_own || value.starts_with("https://doi.org/"), "{value}");
            }
            assert!(!html.contains("@import") && !html.contains("url("));
            check_links(&page);
        }
    }
}

/// What links lead to is there, and once.
fn check_links(page: &Document) {
    let ids: Vec<&str> = page.descendants().filter_map(|node| node.attribute("id")).collect();
    let mut once = ids.clone();
    once.sort_unstable();
    once.dedup();
    assert_eq!(once.len(), ids.len(), "an id is there twice");
    let links = page.descendants().filter_map(|node| node.attribute("href"));
    for link in links.filter_map(|link| link.strip_prefix('#')) {
        assert!(ids.contains(&link), "{link}");
    }
}

#[test]
fn every_picture_is_shown_once() {
    let study = synthetic::study();
    let page = html(&study, &|_| Some(PNG.to_vec()));
    let points = study.cases.iter().flat_map(|case| &case.series).flat_map(|series| &series.points);
    let pictures = points.filter(|point| point.picture.is_some()).count();
    let of_errors: usize = study.cases.iter().map(|case| case.series.len()).sum();
    let shown = page.matches("src=\"data:image/png;base64,").count();
    assert_eq!(shown, pictures + of_errors + 1);
    assert!(html(&study, &no_picture).contains("is not at hand"));
}

/// How many systems are of isolux.
const OWN: usize = 7;

#[test]
fn graphs_have_a_line_for_every_system() {
    for (id, lines) in [
        ("case-cube-measured", System::ALL.len()),
        ("case-cube-audited", OWN),
        // What is filtered is known of one system alone.
        ("case-cube-filtered", 1),
        ("case-hall-progress", OWN),
        ("case-hall-cie94-last", OWN),
        // One run has no time limit.
        ("case-hall-foreseen", 1),
        ("cost-triangles", 1),
        ("cost-luminaires", 1),
    ] {
        let files = graphs(&synthetic::study());
        let file = files.iter().find(|file| file.name == format!("graphs/{id}.svg")).expect(id);
        let drawing = parsed(&file.svg);
        assert_eq!(drawing.descendants().filter(is_line_of_data).count(), lines, "{id}");
        for part in ["title", "desc"] {
            let text = drawing
                .descendants()
                .find(|node| node.has_tag_name(("http://www.w3.org/2000/svg", part)));
            assert!(text.and_then(|node| node.text()).is_some_and(|text| text.len() > 9), "{id}");
        }
    }
}

/// Lines of data have classes `l0`, `l1`, ...; a swatch of a legend is one of two points.
fn is_line_of_data(node: &Node) -> bool {
    let class = node.attribute("class").unwrap_or_default();
    let points = node.attribute("points").unwrap_or_default().split_whitespace().count();
    class.strip_prefix('l').is_some_and(|number| number.parse::<usize>().is_ok()) && points > 2
}

#[test]
fn letters_stay_on_the_sheet() {
    for file in graphs(&synthetic::study()) {
        let drawing = parsed(&file.svg);
        let size: Vec<f64> = drawing
            .root_element()
            .attribute("viewBox")
            .expect("drawings have a size")
            .split(' ')
            .map(|number| number.parse().unwrap())
            .collect();
        for text in drawing.descendants().filter(|node| node.has_attribute("text-anchor")) {
            let number = |name| text.attribute(name).unwrap().parse::<f64>().unwrap();
            let width =
                0.6 * number("font-size") * text.text().unwrap().trim().chars().count() as f64;
            let before = match text.attribute("text-anchor").unwrap() {
                "start" => 0.0,
                "middle" => 0.5,
                _ => 1.0,
            };
            let left = number("x") - before * width;
            let is_on = left >= 0.0 && left + width <= size[2] && number("y") < size[3];
            assert!(is_on, "{}: {:?}", file.name, text.text());
        }
    }
}

#[test]
fn what_is_not_known_is_a_dash_and_never_zero() {
    for html in [html(&bare(), &no_picture), html(&empty(), &no_picture)] {
        let page = parsed(&html);
        let cells = page
            .descendants()
            .filter(|node| node.has_tag_name(("http://www.w3.org/1999/xhtml", "td")));
        let texts: Vec<&str> = cells.filter_map(|cell| cell.text()).collect();
        assert!(!texts.is_empty() && texts.iter().all(|text| !["0", "NaN", "0.00"].contains(text)));
        assert!(!html.contains("<svg"));
        assert!(!html.contains("NaN"));
    }
    let mut study = synthetic::study();
    study.cases[0].series[0].points[0].reported.error = None;
    assert!(html(&study, &no_picture).contains("<td class=\"number\">–</td>"));
    assert!(csv(&study).contains(",,"));
    let text = html(&bare(), &no_picture);
    assert!(text.contains("have no graphs: nothing was found to draw"));
    assert!(text.contains("Of none of these maps is known"));
}

#[test]
fn every_number_of_a_map_is_in_the_table_for_programs() {
    let study = synthetic::study();
    let table = csv(&study);
    let mut lines = table.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let points = study.cases.iter().flat_map(|case| &case.series).flat_map(|series| &series.points);
    let mut rows = 0;
    for (line, point) in lines.zip(points) {
        let fields: Vec<&str> = line.split(',').flat_map(|field| field.split([' ', ';'])).collect();
        for number in numbers(&serde_json::to_value(point).unwrap()) {
            assert!(fields.iter().any(|field| field.parse() == Ok(number)), "{number} in {line}");
        }
        assert_eq!(line.split(',').count(), names.len());
        rows += 1;
    }
    assert_eq!(rows, table.lines().count() - 1);
    assert_eq!(csv(&empty()).lines().count(), 1);
}

fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Number(number) => number.as_f64().into_iter().collect(),
        Value::Array(values) => values.iter().flat_map(numbers).collect(),
        Value::Object(values) => values.values().flat_map(numbers).collect(),
        _ => Vec::new(),
    }
}

#[test]
fn studies_are_read_back() {
    let study = synthetic::study();
    let text = serde_json::to_string(&study).unwrap();
    assert_eq!(serde_json::from_str::<Study>(&text).unwrap(), study);
}

#[test]
fn markdown_names_the_graphs_that_there_are() {
    let study = synthetic::study();
    let text = markdown(&study);
    let names: Vec<String> = graphs(&study).into_iter().map(|file| file.name).collect();
    assert!(names.len() > 20);
    for name in &names {
        assert_eq!(text.matches(&format!("({name})")).count(), 1, "{name}");
    }
    assert_eq!(text.matches("](graphs/").count(), names.len());
    assert!(text.contains("(<pictures/hall-reference.png>)"));
    assert!(markdown(&empty()).contains("no map was finished"));
}

#[test]
fn names_of_scenes_do_no_harm() {
    let mut study = synthetic::study();
    study.cases[2].name = "a/<b> & \"c\".toml".to_owned();
    study.missing.push("x < y & z".to_owned());
    let html = html(&study, &no_picture);
    parsed(&html);
    assert!(html.contains("a/&lt;b&gt; &amp; &quot;c&quot;.toml"));
    for file in graphs(&study) {
        parsed(&file.svg);
        assert!(file.name.chars().all(|c| c.is_ascii_alphanumeric() || "-./".contains(c)));
    }
}
