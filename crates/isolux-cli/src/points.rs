//! Files of points: `x y z nx ny nz` a line.

use crate::failure::Failure;
use isolux::engine::ProbePoint;
use isolux::geometry::{Point, Vector};
use isolux_formats::{Problem, counted};
use std::io::Read;
use std::path::Path;

/// No more is read: ten million points.
const MAX_BYTES: u64 = 1 << 30;
/// Read before it is decided whether it is text.
const FIRST_BYTES: u64 = 1 << 12;
/// Problems shown; a file with more of them is another kind of file.
const MAX_PROBLEMS: usize = 20;

/// Reads points from a file, or from standard input where the path is `-`.
pub(crate) fn read(path: &Path) -> Result<Vec<ProbePoint>, Failure> {
    let name =
        if path == Path::new("-") { "standard input".into() } else { path.to_string_lossy() };
    let fail = |e| Failure::bad_input(Problem::unreadable(Path::new(name.as_ref()), &e));
    let source: Box<dyn Read> = if path == Path::new("-") {
        Box::new(std::io::stdin().lock())
    } else {
        Box::new(std::fs::File::open(path).map_err(fail)?)
    };
    let mut source = source.take(MAX_BYTES + 1);
    let mut bytes = Vec::new();
    // Text has no zero bytes: what is no text need not be read to its end, if it has one.
    source.by_ref().take(FIRST_BYTES).read_to_end(&mut bytes).map_err(fail)?;
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return Err(Failure::bad_input(format!(
            "{name}: is text in UTF-16, which is not read; save it as UTF-8"
        )));
    }
    if bytes.contains(&0) {
        return Err(Failure::bad_input(format!(
            "{name}: is not text; write x y z nx ny nz, one a line"
        )));
    }
    source.read_to_end(&mut bytes).map_err(fail)?;
    if bytes.len() as u64 > MAX_BYTES {
        return Err(Failure::bad_input(format!("{name}: larger than 1 GiB; split it")));
    }
    parse(&String::from_utf8_lossy(&bytes), &name)
}

/// The points of a text; every problem with its line.
fn parse(text: &str, name: &str) -> Result<Vec<ProbePoint>, Failure> {
    // Windows editors begin UTF-8 with a byte order mark.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut points = Vec::new();
    let mut problems = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let content = line.split('#').next().unwrap_or_default().trim();
        if content.is_empty() {
            continue;
        }
        match point(content) {
            Ok(point) => points.push(point),
            Err(what) => problems.push(format!("{name}: line {}: {what}", index + 1)),
        }
        if problems.len() == MAX_PROBLEMS {
            problems.push(format!("{name}: and perhaps more; the rest was not read"));
            break;
        }
    }
    if points.is_empty() {
        // What is no list of points at all is told once.
        problems.truncate(1);
        problems.push(format!("{name}: holds no point; write x y z nx ny nz, one a line"));
    }
    if problems.is_empty() { Ok(points) } else { Err(Failure::bad_inputs(problems)) }
}

fn point(line: &str) -> Result<ProbePoint, String> {
    let fields: Vec<&str> =
        line.split(|c: char| c.is_whitespace() || c == ',').filter(|f| !f.is_empty()).collect();
    let mut numbers = [0.0; 6];
    if fields.len() != numbers.len() {
        let found = counted(fields.len(), "number", "numbers");
        return Err(format!("{found}; write six: x y z nx ny nz"));
    }
    for (number, field) in numbers.iter_mut().zip(&fields) {
        let finite = field.parse::<f64>().ok().filter(|v| v.is_finite());
        *number = finite.ok_or_else(|| {
            // A binary file has no short words.
            let shown: String = field.chars().take(20).flat_map(char::escape_default).collect();
            format!("`{shown}` is not a finite number; write six: x y z nx ny nz")
        })?;
    }
    let [x, y, z, nx, ny, nz] = numbers;
    let normal = Vector::new(nx, ny, nz).normal();
    let normal = normal.ok_or("the normal has no direction; 0 0 1 faces up in a z-up scene")?;
    Ok(ProbePoint { position: Point::new(x, y, z), normal })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_comments_and_blank_lines() {
        let points =
            parse("\u{feff}# desk\r\n\n1 2 3 0 0 2 # up\r\n-1e0, 0,0 , 1 0 0", "p").unwrap();
        assert_eq!(points.len(), 2);
        assert_eq!(points[0].position, Point::new(1.0, 2.0, 3.0));
        assert_eq!(points[0].normal.to_vector(), Vector::new(0.0, 0.0, 1.0));
    }

    #[test]
    fn a_byte_order_mark_is_no_part_of_a_number() {
        let points = parse("\u{feff}2,2.5,0.75,0,0,1\r\n3,2.5,0.75,0,0,1\r\n", "p").unwrap();
        assert_eq!(points[0].position, Point::new(2.0, 2.5, 0.75));
        assert_eq!(points.len(), 2);
    }

    #[test]
    fn every_problem_has_its_line() {
        let Err(Failure::BadInput(problems)) =
            parse("1 2 3 0 0 1\n1 2 3\n1 2 x 0 0 1\n1 2 3 0 0 0\n1 2 NaN 0 0 1", "p.pts")
        else {
            panic!("no problem found");
        };
        for (problem, start) in problems.iter().zip(["line 2", "line 3", "line 4", "line 5"]) {
            assert!(problem.message.starts_with(&format!("p.pts: {start}: ")), "{problem:?}");
        }
        assert_eq!(problems.len(), 4);
    }

    #[test]
    fn another_kind_of_file_is_one_screen_of_problems() {
        for text in ["", "# nothing\n", &"\u{0}binary \u{fffd}\n".repeat(1000)] {
            let Err(Failure::BadInput(problems)) = parse(text, "p") else { panic!("{text:?}") };
            assert!((1..=MAX_PROBLEMS + 1).contains(&problems.len()));
        }
    }
}
