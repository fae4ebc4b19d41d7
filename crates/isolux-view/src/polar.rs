//! The polar diagram of an intensity distribution: its main sections, nadir down.

use crate::round::round_step;
use crate::text::escaped;
use isolux::geometry::Vector;
use isolux::photometry::{AngleSystem, IntensityDistribution};
use std::fmt::Write;

/// Steps along a section, degrees, beside the angles of a table.
const STEP_DEG: f64 = 1.0;
/// Radius of the diagram, and the space around it, in units of the SVG.
const RADIUS: f64 = 240.0;
const MARGIN: f64 = 56.0;
/// Circles a diagram has at most.
const MOST_RINGS: f64 = 5.0;
/// Colours and dashes of the sections.
const STYLES: [&str; 3] = [
    "stroke=\"#c0392b\"",
    "stroke=\"#1f5fa8\" stroke-dasharray=\"7 4\"",
    "stroke=\"#2e7d32\" stroke-dasharray=\"2 3\"",
];
/// The section through the greatest intensity is drawn, too, where it is so many times that of the others.
const HIGHER: f64 = 1.05;

/// A section and its points.
#[derive(Clone, Debug, PartialEq)]
struct Section {
    name: String,
    /// Angle from nadir, positive to the right, rad; and intensity, cd.
    points: Vec<[f64; 2]>,
}

/// The diagram of a distribution, to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct PolarDiagram {
    sections: Vec<Section>,
    /// Between circles, cd.
    ring_cd: f64,
    /// Circles.
    rings: u32,
    has_upward: bool,
}

impl PolarDiagram {
    /// Of a distribution: the sections C0-C180 and C90-C270, or for the systems A and B the vertical and the
    /// horizontal section through the aim; and the one through the greatest intensity, if it is higher.
    pub fn of(intensity: &IntensityDistribution) -> Self {
        let names = match intensity {
            IntensityDistribution::Web(web) if web.system() != AngleSystem::C => {
                ["vertical", "horizontal"]
            }
            _ => ["C0-C180", "C90-C270"],
        };
        let [x, y] = [Vector::new(1.0, 0.0, 0.0), Vector::new(0.0, 1.0, 0.0)];
        let section =
            |name: String, to_right| Section { name, points: points(intensity, to_right) };
        let [first, second] = names.map(str::to_owned);
        let mut sections = vec![section(first, x), section(second, y)];
        if let Some((name, to_right)) = highest_plane(intensity, greatest(&sections)) {
            sections.push(section(name, to_right));
        }
        let all = || sections.iter().flat_map(|s| &s.points);
        let most = greatest(&sections);
        let has_upward = all().any(|[angle, cd]| *cd > 0.0 && libm::cos(*angle) < -1e-9);
        let ring_cd = ring(most);
        let rings = (most / ring_cd).ceil().max(1.0) as u32;
        Self { sections, ring_cd, rings, has_upward }
    }

    /// Intensity at the outermost circle, cd.
    fn outermost_cd(&self) -> f64 {
        self.ring_cd * f64::from(self.rings)
    }

    /// Right and down of the middle, as shares of the radius.
    fn place(&self, [angle, cd]: [f64; 2]) -> [f64; 2] {
        let (sine, cosine) = libm::sincos(angle);
        let radius = cd / self.outermost_cd();
        [radius * sine, radius * cosine]
    }

    /// As SVG, with a title and a line below it.
    pub fn svg(&self, title: &str, subtitle: &str) -> String {
        let width = 2.0 * (RADIUS + MARGIN);
        let top = if self.has_upward { RADIUS } else { 0.0 };
        let (middle_x, middle_y) = (RADIUS + MARGIN, 72.0 + top + 14.0);
        let height = middle_y + RADIUS + 52.0;
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
             height=\"{height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n\
             <text x=\"16\" y=\"26\" font-size=\"16\" font-weight=\"bold\">{}</text>\n\
             <text x=\"16\" y=\"46\" fill=\"#444444\">{}</text>\n\
             <g transform=\"translate({middle_x} {middle_y})\">\n",
            escaped(title),
            escaped(subtitle)
        );
        self.append_grid(&mut svg);
        for (section, style) in self.sections.iter().zip(STYLES) {
            let mut path = String::new();
            for (k, point) in section.points.iter().enumerate() {
                let [x, y] = self.place(*point).map(|share| share * RADIUS);
                let _ = write!(path, "{}{x:.2} {y:.2}", if k == 0 { "M" } else { "L" });
            }
            let _ = writeln!(svg, "<path d=\"{path}\" fill=\"none\" stroke-width=\"2\" {style}/>");
        }
        svg.push_str("</g>\n");
        self.append_legend(&mut svg, height - 14.0);
        svg.push_str("</svg>\n");
        svg
    }

    fn append_grid(&self, svg: &mut String) {
        svg.push_str("<g fill=\"none\" stroke=\"#cccccc\">\n");
        for k in 1..=self.rings {
            let r = RADIUS * f64::from(k) / f64::from(self.rings);
            let shape = if self.has_upward {
                format!("<circle r=\"{r:.2}\"/>")
            } else {
                format!("<path d=\"M{:.2} 0A{r:.2} {r:.2} 0 0 0 {r:.2} 0\"/>", -r)
            };
            let _ = writeln!(svg, "{shape}");
        }
        let most: i32 = if self.has_upward { 180 } else { 90 };
        for angle in (-most..=most).step_by(30) {
            let (sine, cosine) = libm::sincos(f64::from(angle).to_radians());
            let _ = writeln!(svg, "<path d=\"M0 0L{:.2} {:.2}\"/>", RADIUS * sine, RADIUS * cosine);
        }
        svg.push_str("</g>\n<g fill=\"#555555\" text-anchor=\"middle\">\n");
        for angle in ((30 - most)..=most).step_by(30) {
            let (sine, cosine) = libm::sincos(f64::from(angle).to_radians());
            let at = RADIUS + 16.0;
            let (x, y) = (at * sine, at * cosine + 4.0);
            let _ = writeln!(svg, "<text x=\"{x:.2}\" y=\"{y:.2}\">{}°</text>", angle.abs());
        }
        if !self.has_upward {
            let _ = writeln!(svg, "<text x=\"{:.2}\" y=\"4\">90°</text>", -RADIUS - 16.0);
        }
        for k in 1..=self.rings {
            let r = RADIUS * f64::from(k) / f64::from(self.rings);
            let cd = self.ring_cd * f64::from(k);
            let _ = writeln!(
                svg,
                "<text x=\"2\" y=\"{:.2}\" text-anchor=\"start\">{cd}</text>",
                r - 3.0
            );
        }
        svg.push_str("</g>\n");
    }

    fn append_legend(&self, svg: &mut String, y: f64) {
        let mut x = 16.0;
        for (section, style) in self.sections.iter().zip(STYLES) {
            let (line_y, end, text) = (y - 4.0, x + 34.0, x + 40.0);
            let _ = writeln!(
                svg,
                "<path d=\"M{x} {line_y}H{end}\" stroke-width=\"2\" {style}/>\
                 <text x=\"{text}\" y=\"{y}\">{}</text>",
                section.name
            );
            x += 64.0 + 8.0 * section.name.len() as f64;
        }
        let _ = writeln!(svg, "<text x=\"{x}\" y=\"{y}\" fill=\"#444444\">intensity in cd</text>");
    }

    /// For a terminal: lines of Braille patterns, so many characters wide; the section C0-C180 is drawn
    /// whole, C90-C270 dotted.
    pub fn text(&self, columns: usize) -> String {
        let mut canvas = Canvas::new(columns.clamp(10, 200), self.has_upward);
        canvas.axes();
        for (section, every) in self.sections.iter().zip([1, 4]) {
            let places: Vec<[f64; 2]> = section.points.iter().map(|p| self.place(*p)).collect();
            canvas.curve(&places, every);
        }
        let [first, second] = [&self.sections[0].name, &self.sections[1].name];
        let cd = self.outermost_cd();
        format!("{}edge: {cd} cd; {first} solid, {second} dotted\n", canvas.finish())
    }
}

/// The greatest intensity of sections, cd.
fn greatest(sections: &[Section]) -> f64 {
    sections.iter().flat_map(|s| &s.points).map(|[_, cd]| *cd).fold(0.0, f64::max)
}

/// Name and right side of the section through the greatest intensity, if it is higher than another.
fn highest_plane(intensity: &IntensityDistribution, than_cd: f64) -> Option<(String, Vector)> {
    let IntensityDistribution::Web(web) = intensity else { return None };
    let mut highest: Option<(Vector, f64)> = None;
    for (at, cd) in web.nodes() {
        if highest.is_none_or(|(_, most)| cd > most) {
            highest = Some((at, cd));
        }
    }
    let (at, cd) = highest?;
    let level = at.x.hypot(at.y);
    if cd <= HIGHER * than_cd || level <= 1e-9 {
        return None;
    }
    let to_right = Vector::new(at.x / level, at.y / level, 0.0);
    let turn = |degrees: f64| ((degrees % 360.0 + 360.0) % 360.0 * 10.0).round() / 10.0;
    let c = libm::atan2(at.y, at.x).to_degrees();
    let name = match web.system() {
        AngleSystem::C => format!("C{}-C{}", turn(c), turn(c + 180.0)),
        AngleSystem::A | AngleSystem::B => "through the greatest".to_owned(),
    };
    Some((name, to_right))
}

/// A section through nadir, from zenith on the left through nadir to zenith on the right.
fn points(intensity: &IntensityDistribution, to_right: Vector) -> Vec<[f64; 2]> {
    let steps = (180.0 / STEP_DEG) as i32;
    let mut angles: Vec<f64> = (-steps..=steps).map(|k| f64::from(k) * STEP_DEG).collect();
    if let IntensityDistribution::Web(web) = intensity
        && web.system() == AngleSystem::C
    {
        angles.extend(web.gammas_deg().iter().flat_map(|gamma| [-gamma, *gamma]));
    }
    angles.sort_by(f64::total_cmp);
    angles.dedup();
    let at = |angle_deg: &f64| {
        let angle = angle_deg.to_radians();
        let (sine, cosine) = libm::sincos(angle);
        let direction = (to_right * sine + Vector::new(0.0, 0.0, -cosine)).direction()?;
        Some([angle, intensity.intensity_cd(direction)])
    };
    angles.iter().filter_map(at).collect()
}

/// The step of circles for a greatest intensity: 1, 2 or 5 times a power of ten.
fn ring(most_cd: f64) -> f64 {
    round_step(most_cd / MOST_RINGS)
}

/// Dots of Braille patterns, two across and four down a character.
struct Canvas {
    columns: usize,
    rows: usize,
    has_upward: bool,
    cells: Vec<u8>,
}

impl Canvas {
    fn new(columns: usize, has_upward: bool) -> Self {
        // A dot is as high as wide.
        let rows = if has_upward { columns.div_ceil(2) } else { columns.div_ceil(4) };
        Self { columns, rows, has_upward, cells: vec![0; columns * rows] }
    }

    /// Sets the dot at a place in shares of the radius.
    fn dot(&mut self, [x, y]: [f64; 2]) {
        let (across, down) = ((2 * self.columns - 1) as f64, (4 * self.rows - 1) as f64);
        let u = (0.5 * (x + 1.0) * across).round();
        let v = if self.has_upward { 0.5 * (y + 1.0) * down } else { y * down }.round();
        if !(0.0..=across).contains(&u) || !(0.0..=down).contains(&v) {
            return;
        }
        let (u, v) = (u as usize, v as usize);
        // Dots 1 to 6 of a pattern go down its columns, 7 and 8 were added below.
        let bit = match (u % 2, v % 4) {
            (0, 3) => 6,
            (_, 3) => 7,
            (column, row) => 3 * column + row,
        };
        self.cells[v / 4 * self.columns + u / 2] |= 1 << bit;
    }

    fn axes(&mut self) {
        let count = 2 * self.columns;
        for k in (0..=count).step_by(4) {
            let share = 2.0 * k as f64 / count as f64 - 1.0;
            self.dot([share, 0.0]);
            self.dot([0.0, share]);
        }
    }

    /// Straight lines between places; of them every so manyth dot.
    fn curve(&mut self, places: &[[f64; 2]], every: usize) {
        let mut drawn = 0;
        for pair in places.windows(2) {
            let [[x0, y0], [x1, y1]] = [pair[0], pair[1]];
            let span = (x1 - x0).abs().max((y1 - y0).abs());
            let dots = (span * self.columns as f64).ceil().max(1.0) as usize;
            for k in 0..dots {
                let share = k as f64 / dots as f64;
                if drawn % every == 0 {
                    self.dot([x0 + (x1 - x0) * share, y0 + (y1 - y0) * share]);
                }
                drawn += 1;
            }
        }
    }

    fn finish(&self) -> String {
        let pattern = |cell: &u8| char::from_u32(0x2800 + u32::from(*cell)).unwrap_or(' ');
        let mut text = String::new();
        for row in self.cells.chunks(self.columns) {
            let line: String = row.iter().map(pattern).collect();
            text.push_str(line.trim_end_matches('\u{2800}'));
            text.push('\n');
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::photometry::PhotometricWeb;
    use std::sync::Arc;

    fn downlight() -> PolarDiagram {
        PolarDiagram::of(&IntensityDistribution::CosinePower { peak_cd: 930.0, exponent: 1.0 })
    }

    #[test]
    fn circles_have_round_steps() {
        for (most, step) in
            [(930.0, 200.0), (1000.0, 200.0), (0.3, 0.1), (12_345.0, 5000.0), (0.0, 1.0)]
        {
            assert_eq!(ring(most), step, "{most}");
        }
    }

    #[test]
    fn a_cosine_is_a_circle_through_the_middle() {
        let diagram = downlight();
        assert_eq!((diagram.rings, diagram.ring_cd, diagram.has_upward), (5, 200.0, false));
        for point in &diagram.sections[0].points {
            let [x, y] = diagram.place(*point);
            let half = 0.5 * 930.0 / 1000.0;
            // Points behind the luminaire lie in the middle; a handful of roundings.
            assert!((x.hypot(y - half) - half).abs() < 1e-12, "{point:?}");
        }
    }

    #[test]
    fn the_right_side_is_c0_and_c90() {
        let candela = vec![1.0, 100.0, 1.0, 1.0, 1.0, 1.0, 1.0, 50.0];
        let planes = vec![0.0, 90.0, 180.0, 270.0];
        let web = PhotometricWeb::new(planes, vec![0.0, 90.0], candela).unwrap();
        let diagram = PolarDiagram::of(&IntensityDistribution::Web(Arc::new(web)));
        let end = |section: usize, degrees: f64| {
            let points = &diagram.sections[section].points;
            let at = points.iter().find(|p| (p[0] - degrees.to_radians()).abs() < 1e-9).unwrap();
            at[1].round()
        };
        assert_eq!([end(0, 90.0), end(0, -90.0)], [100.0, 1.0]);
        assert_eq!([end(1, 90.0), end(1, -90.0)], [1.0, 50.0]);
    }

    #[test]
    fn a_beam_between_the_main_sections_has_one_of_its_own() {
        let candela = vec![1.0, 1.0, 1.0, 100.0, 1.0, 1.0, 1.0, 1.0];
        let planes = vec![0.0, 37.5, 90.0, 225.0];
        let web = PhotometricWeb::new(planes, vec![0.0, 60.0], candela).unwrap();
        let diagram = PolarDiagram::of(&IntensityDistribution::Web(Arc::new(web)));
        let names: Vec<&str> = diagram.sections.iter().map(|s| s.name.as_str()).collect();
        assert_eq!(names, ["C0-C180", "C90-C270", "C37.5-C217.5"]);
        // At 60 degrees to the right; an arc tangent in degrees from the border of the table.
        assert!((greatest(&diagram.sections) - 100.0).abs() < 1e-9);
    }

    #[test]
    fn a_drawing_names_its_sections_and_escapes_its_title() {
        let svg = downlight().svg("a & <b>", "1 lm");
        for part in ["a &amp; &lt;b&gt;", "C0-C180", "C90-C270", ">1000</text>", "1 lm"] {
            assert!(svg.contains(part), "{part}");
        }
        let text = downlight().text(40);
        assert_eq!(text.lines().count(), 11);
        assert!(text.contains("edge: 1000 cd"), "{text}");
        // The lowest point of the curve is in the middle of the last but one row of the drawing.
        assert!(text.lines().nth(9).unwrap().chars().any(|c| c != '\u{2800}'));
    }
}
