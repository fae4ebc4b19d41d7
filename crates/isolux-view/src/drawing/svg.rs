//! Drawings as SVG.

use super::mark::{Anchor, At, Ink, Lettering, Letters, Line, Mark, Pixels};
use crate::text::escaped;
use std::collections::BTreeMap;
use std::fmt::Write;

/// A file of a drawing.
pub(super) fn written([width, height]: [u32; 2], marks: &[Mark]) -> String {
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" font-family=\"sans-serif\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
    );
    for mark in marks {
        match mark {
            Mark::Pixels(pixels) => append_pixels(&mut svg, pixels),
            Mark::Area { rings, ink } => {
                let outline: String = rings.iter().map(|ring| path(ring) + "Z").collect();
                let ink = colour(*ink);
                let _ =
                    writeln!(svg, "<path d=\"{outline}\" fill=\"{ink}\" fill-rule=\"evenodd\"/>");
            }
            Mark::Line(line) => append_line(&mut svg, line),
            Mark::Text(lettering) => append_text(&mut svg, lettering),
        }
    }
    svg + "</svg>\n"
}

fn colour([red, green, blue]: Ink) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

fn path(points: &[At]) -> String {
    let mut path = String::new();
    for (k, [x, y]) in points.iter().enumerate() {
        let _ = write!(path, "{}{x:.1} {y:.1}", if k == 0 { 'M' } else { 'L' });
    }
    path
}

/// One path a colour, of the runs of it.
fn append_pixels(svg: &mut String, pixels: &Pixels) {
    let mut runs: BTreeMap<Ink, String> = BTreeMap::new();
    for (row, inks) in pixels.inks.chunks(pixels.width.max(1)).enumerate() {
        let mut column = 0;
        for run in inks.chunk_by(|a, b| a == b) {
            if let Some(ink) = run[0] {
                let (x, y) = (pixels.left + column as i64, pixels.top + row as i64);
                let width = run.len();
                let _ = write!(runs.entry(ink).or_default(), "M{x} {y}h{width}v1h-{width}z");
            }
            column += run.len();
        }
    }
    svg.push_str("<g shape-rendering=\"crispEdges\">\n");
    for (ink, path) in runs {
        let _ = writeln!(svg, "<path d=\"{path}\" fill=\"{}\"/>", colour(ink));
    }
    svg.push_str("</g>\n");
}

fn append_line(svg: &mut String, line: &Line) {
    let (path, ink, width) = (path(&line.points), colour(line.ink), line.width);
    let dash = line.dash.map_or(String::new(), |dash| format!(" stroke-dasharray=\"{dash}\""));
    let _ = writeln!(
        svg,
        "<path d=\"{path}\" fill=\"none\" stroke=\"{ink}\" stroke-width=\"{width}\" \
         stroke-linecap=\"round\" stroke-linejoin=\"round\"{dash}/>"
    );
}

fn append_text(svg: &mut String, lettering: &Lettering) {
    let anchor = match lettering.anchor {
        Anchor::Left => "start",
        Anchor::Middle => "middle",
        Anchor::Right => "end",
    };
    let size = match lettering.letters {
        Letters::Small => 13.0,
        Letters::Large => 20.0,
    };
    let halo = lettering.halo.map_or(String::new(), |halo| {
        let (halo, [[left, top], [right, bottom]]) = (colour(halo), lettering.plate());
        let (width, height) = (right - left, bottom - top);
        let _ = writeln!(
            svg,
            "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" rx=\"3\" fill=\"{halo}\"/>"
        );
        format!(
            " stroke=\"{halo}\" stroke-width=\"4\" stroke-linejoin=\"round\" paint-order=\"stroke\""
        )
    });
    // Digits are about seven tenths as high as their font.
    let ([x, y], ink) = (lettering.at, colour(lettering.ink));
    let _ = writeln!(
        svg,
        "<text x=\"{x:.1}\" y=\"{:.1}\" font-size=\"{size}\" text-anchor=\"{anchor}\" fill=\"{ink}\"{halo}>{}</text>",
        y + 0.35 * size,
        // Not all viewers keep spaces in a row unless they are no-break spaces.
        escaped(&lettering.text).replace("  ", " \u{a0}")
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_of_a_colour_are_runs_of_one_path() {
        let [red, blue] = [Some([255, 0, 0]), Some([0, 0, 255])];
        let inks = vec![red, red, None, blue, red, None];
        let svg = written([3, 2], &[Mark::Pixels(Pixels { left: 5, top: 7, width: 3, inks })]);
        assert!(svg.contains("d=\"M5 7h2v1h-2zM6 8h1v1h-1z\" fill=\"#ff0000\""), "{svg}");
        assert!(svg.contains("d=\"M5 8h1v1h-1z\" fill=\"#0000ff\""), "{svg}");
    }

    #[test]
    fn names_are_escaped() {
        let lettering = Lettering {
            at: [1.0, 2.0],
            anchor: Anchor::Middle,
            letters: Letters::Small,
            ink: [0; 3],
            halo: None,
            text: "a & <b>   c".into(),
        };
        let svg = written([3, 2], &[Mark::Text(lettering)]);
        assert!(svg.contains(">a &amp; &lt;b&gt; \u{a0} c</text>"), "{svg}");
    }
}
