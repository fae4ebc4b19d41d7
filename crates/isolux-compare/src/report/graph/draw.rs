//! From a graph to SVG.

use super::ink::{self, GRID, INK};
use super::legend;
use super::plan::{Dot, Graph, Line, Rule};
use super::sheet::{
    BOTTOM, FONT, HEIGHT, MARGIN, MARK, SWATCH, SWATCH_GAP, THIN, TO_TITLE, TOP, WIDTH, text_width,
};
use super::strokes::{Failed, Sheet, draw_interval, draw_marker, draw_rule, stroke_line, text};
use super::ticks::Span;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

/// What is drawn of a graph, and where.
struct Frame {
    lines: Vec<Line>,
    x: Span,
    y: Span,
    titles: Vec<String>,
    height: i32,
}

/// The elements of the drawing, and its height; `None` of a graph without points.
pub(super) fn draw(graph: &Graph) -> Option<(String, i32)> {
    let frame = Frame::of(graph)?;
    let mut svg = String::new();
    let size = (WIDTH as u32, frame.height as u32);
    let sheet = SVGBackend::with_string(&mut svg, size).into_drawing_area();
    let drawn = frame.draw(graph, &sheet);
    drop(sheet);
    drawn.ok()?;
    // The library writes the element of the drawing itself, which is to have a title first.
    let inside = svg.split_once('>')?.1.trim_end().strip_suffix("</svg>")?;
    Some((ink::classed(inside), frame.height))
}

impl Frame {
    fn of(graph: &Graph) -> Option<Self> {
        let lines = graph.drawn();
        if lines.is_empty() {
            return None;
        }
        let places: Vec<(f64, f64)> = lines
            .iter()
            .flat_map(|line| &line.points)
            .flat_map(|dot| corners(graph, dot))
            .chain(levels(graph, &lines))
            .collect();
        let (x, y): (Vec<f64>, Vec<f64>) = places.into_iter().unzip();
        let is_square = graph.rules.iter().any(|rule| matches!(rule, Rule::Equal(_)));
        let (x, y) = if is_square && graph.x.scale == graph.y.scale {
            let both = Span::common(graph.x.scale, &x, &y);
            (both.clone(), both)
        } else {
            (Span::of(graph.x.scale, &x), Span::of(graph.y.scale, &y))
        };
        let titles: Vec<String> = lines
            .iter()
            .map(|line| line.title.clone())
            .chain(graph.rules.iter().map(title))
            .collect();
        let height = HEIGHT + legend::places(&titles).1 + MARGIN;
        Some(Self { lines, x, y, titles, height })
    }

    fn draw(&self, graph: &Graph, sheet: &Sheet) -> Result<(), Failed> {
        let (upper, lower) = sheet.split_vertically(HEIGHT);
        let marks = self.y.marks.iter().map(|&mark| text_width(&self.y.label(mark), FONT));
        let mut chart = ChartBuilder::on(&upper)
            .margin_left(MARGIN)
            .margin_right(2 * MARGIN)
            .margin_top(TOP)
            .x_label_area_size(BOTTOM)
            .y_label_area_size(marks.max().unwrap_or_default() + 2 * MARK)
            .build_cartesian_2d(self.x.clone(), self.y.clone())?;
        chart
            .configure_mesh()
            .axis_style(INK.stroke_width(THIN))
            .bold_line_style(GRID.stroke_width(THIN))
            .label_style(text(HPos::Center, VPos::Center))
            .set_all_tick_mark_size(MARK)
            .draw()?;
        let at = |(x, y): (f64, f64)| chart.backend_coord(&(x, y));
        name_axes(graph, [at((self.x.from, self.y.from)), at((self.x.to, self.y.from))], sheet)?;
        for rule in &graph.rules {
            draw_rule(&self.ends(graph, rule).map(at), sheet)?;
        }
        for line in &self.lines {
            draw_line(graph, line, (&at, self.y.from), sheet)?;
        }
        self.draw_legend(&lower)
    }

    /// Where a rule begins and ends within the axes.
    fn ends(&self, graph: &Graph, rule: &Rule) -> [(f64, f64); 2] {
        match rule {
            Rule::Level(value, _) => {
                let y = graph.y.scale.place(*value).unwrap_or(self.y.from);
                [(self.x.from, y), (self.x.to, y)]
            }
            Rule::Equal(_) => {
                let (from, to) = (self.x.from.max(self.y.from), self.x.to.min(self.y.to));
                [(from, from), (to, to)]
            }
        }
    }

    fn draw_legend(&self, sheet: &Sheet) -> Result<(), Failed> {
        for place in legend::places(&self.titles).0 {
            let ends = [(place.x, place.y), (place.x + SWATCH, place.y)];
            match self.lines.get(place.entry) {
                Some(line) => {
                    stroke_line(&ends, line.look, sheet)?;
                    draw_marker((place.x + SWATCH / 2, place.y), line.look, sheet)?;
                }
                None => draw_rule(&ends, sheet)?,
            }
            let style = text(HPos::Left, VPos::Center);
            sheet.draw_text(
                &self.titles[place.entry],
                &style,
                (ends[1].0 + SWATCH_GAP, place.y),
            )?;
        }
        Ok(())
    }
}

/// A point and the ends of its interval.
fn corners(graph: &Graph, dot: &Dot) -> Vec<(f64, f64)> {
    let ends = dot.interval.into_iter().flatten().filter_map(|y| graph.place(dot.x, y));
    graph.place(dot.x, dot.y).into_iter().chain(ends).collect()
}

/// The levels of rules, above points that there are.
fn levels(graph: &Graph, lines: &[Line]) -> Vec<(f64, f64)> {
    let Some(dot) = lines.first().and_then(|line| line.points.first()) else { return Vec::new() };
    let level = |rule: &Rule| match rule {
        Rule::Level(value, _) => graph.place(dot.x, *value),
        Rule::Equal(_) => None,
    };
    graph.rules.iter().filter_map(level).collect()
}

fn title(rule: &Rule) -> String {
    match rule {
        Rule::Level(_, title) | Rule::Equal(title) => title.clone(),
    }
}

fn name_axes(graph: &Graph, [left, right]: [(i32, i32); 2], sheet: &Sheet) -> Result<(), Failed> {
    let beneath = ((left.0 + right.0) / 2, left.1 + TO_TITLE);
    sheet.draw_text(&graph.x.title, &text(HPos::Center, VPos::Top), beneath)?;
    Ok(sheet.draw_text(&graph.y.title, &text(HPos::Left, VPos::Top), (MARGIN, MARGIN))?)
}

fn draw_line(
    graph: &Graph,
    line: &Line,
    (at, bottom): (&impl Fn((f64, f64)) -> (i32, i32), f64),
    sheet: &Sheet,
) -> Result<(), Failed> {
    let place = |dot: &Dot| graph.place(dot.x, dot.y).map(at);
    let places: Vec<(i32, i32)> = line.points.iter().filter_map(place).collect();
    stroke_line(&places, line.look, sheet)?;
    for dot in &line.points {
        // An interval from zero begins below the axis.
        let end = |y: f64| {
            Some(at((graph.x.scale.place(dot.x)?, graph.y.scale.place(y).unwrap_or(bottom))))
        };
        if let Some([Some(low), Some(high)]) = dot.interval.map(|ends| ends.map(end)) {
            draw_interval(low, high, line.look, sheet)?;
        }
    }
    places.into_iter().try_for_each(|place| draw_marker(place, line.look, sheet))
}
