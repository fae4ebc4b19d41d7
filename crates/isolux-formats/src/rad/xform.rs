//! The arguments of `xform`, as the Radiance manual explains them.

use super::limits;
use super::words::number;
use isolux::geometry::{Transform, Vector};
use isolux::units::sincos_deg;

/// One `xform`: names, what it moves, and every copy of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Xform {
    /// `-n`.
    pub(super) prefix: Option<String>,
    /// `-m`.
    pub(super) modifier: Option<String>,
    /// `-I`: surfaces are turned inside out.
    pub(super) invert: bool,
    pub(super) copies: Vec<Copy>,
    /// What follows the arguments.
    pub(super) files: Vec<String>,
}

/// One place of an array.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Copy {
    pub(super) map: Transform,
    /// What names get in front; empty without a prefix and an array.
    pub(super) prefix: String,
}

enum Step {
    Map(Transform),
    /// What comes next is done so often.
    Repeat(u64),
    /// What comes next is done never, once, ... in the copies.
    Array(u64),
}

/// Reads what follows the word `xform`.
pub(super) fn parse(words: &[String]) -> Result<Xform, String> {
    let mut xform = Xform::default();
    let mut rest = words.iter().map(String::as_str).peekable();
    let mut steps = Vec::new();
    while let Some(&word) = rest.peek() {
        if !word.starts_with('-') {
            break;
        }
        rest.next();
        match word {
            "-n" => {
                let name = rest.next().ok_or("-n without a name")?.to_owned();
                xform.prefix = Some(match xform.prefix.take() {
                    Some(before) => format!("{before}.{name}"),
                    None => name,
                });
            }
            "-m" => {
                let name = rest.next().ok_or("-m without a modifier")?.to_owned();
                xform.modifier.get_or_insert(name);
            }
            "-c" | "-e" => {}
            "-I" => xform.invert = !xform.invert,
            "-i" => steps.push(Step::Repeat(count(word, rest.next())?)),
            "-a" => steps.push(Step::Array(count(word, rest.next())?)),
            _ => steps.push(Step::Map(map(word, &mut rest)?)),
        }
    }
    xform.files = rest.map(str::to_owned).collect();
    xform.copies = copies(&steps, xform.prefix.as_deref())?;
    Ok(xform)
}

fn count(option: &str, word: Option<&str>) -> Result<u64, String> {
    let count = word.and_then(|w| w.parse().ok());
    count.filter(|&n: &u64| n <= limits::COPIES as u64 && (n > 0 || option == "-i")).ok_or_else(
        || match word {
            Some(word) => {
                format!("{option} {word}: give a whole number of copies, up to {}", limits::COPIES)
            }
            None => format!("{option} without a count"),
        },
    )
}

fn map<'a>(option: &str, rest: &mut impl Iterator<Item = &'a str>) -> Result<Transform, String> {
    let mut value = || {
        let word = rest.next().ok_or_else(|| format!("{option} without its numbers"))?;
        number(word).ok_or_else(|| format!("{option}: `{word}` is not a finite number"))
    };
    Ok(match option {
        "-t" => Transform::translation(Vector::new(value()?, value()?, value()?)),
        "-rx" => turn(0, value()?),
        "-ry" => turn(1, value()?),
        "-rz" => turn(2, value()?),
        "-s" => match value()? {
            0.0 => return Err("-s 0 flattens what it scales".into()),
            s => Transform::scale(s, s, s),
        },
        "-mx" => Transform::scale(-1.0, 1.0, 1.0),
        "-my" => Transform::scale(1.0, -1.0, 1.0),
        "-mz" => Transform::scale(1.0, 1.0, -1.0),
        _ => return Err(format!("xform has no argument `{option}` that is read here")),
    })
}

/// Right-handed about an axis, exact at quarter turns.
fn turn(axis: usize, angle_deg: f64) -> Transform {
    let (s, c) = sincos_deg(angle_deg);
    let mut rows = [[0.0; 3]; 3];
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    rows[axis][axis] = 1.0;
    (rows[u][u], rows[v][v]) = (c, c);
    (rows[u][v], rows[v][u]) = (s, -s);
    Transform { columns: rows.map(Vector::from), translation: Vector::ZERO }
}

fn copies(steps: &[Step], prefix: Option<&str>) -> Result<Vec<Copy>, String> {
    let counts: Vec<u64> = steps
        .iter()
        .filter_map(|step| if let Step::Array(n) = step { Some(*n) } else { None })
        .collect();
    let total = counts.iter().try_fold(1_u64, |product, &n| product.checked_mul(n));
    let total = total
        .filter(|&n| n <= limits::COPIES as u64)
        .ok_or_else(|| format!("arrays of more than {} copies", limits::COPIES))?;
    let copy = |index: u64| {
        // The first array is the slowest.
        let mut left = index;
        let mut indices: Vec<u64> = counts.iter().rev().map(|n| (left % n, left /= n).0).collect();
        indices.reverse();
        let map = compose(steps, &indices);
        let is_placed = map.inverse().is_some();
        let copy = Copy { map, prefix: name(prefix, &indices) };
        is_placed.then_some(copy).ok_or_else(|| "it moves things out of all bounds".to_owned())
    };
    (0..total).map(copy).collect()
}

/// `a0`, `a1`, ... as `xform` names copies without a name, `name.0` with one.
fn name(prefix: Option<&str>, indices: &[u64]) -> String {
    let mut name = prefix.unwrap_or_default().to_owned();
    for index in indices {
        let joint = if name.is_empty() { "a" } else { "." };
        name = format!("{name}{joint}{index}");
    }
    name
}

/// Blocks of steps between repetitions, each as often as it says, the first innermost.
fn compose(steps: &[Step], indices: &[u64]) -> Transform {
    let mut indices = indices.iter();
    let (mut total, mut block, mut times) = (Transform::IDENTITY, Transform::IDENTITY, 1);
    for step in steps {
        let next = match step {
            Step::Map(map) => {
                block = map.then_from(&block);
                continue;
            }
            Step::Repeat(n) => *n,
            Step::Array(_) => indices.next().copied().unwrap_or(0),
        };
        total = power(&block, times).then_from(&total);
        (block, times) = (Transform::IDENTITY, next);
    }
    power(&block, times).then_from(&total)
}

/// A map done so often, by squaring.
fn power(map: &Transform, mut times: u64) -> Transform {
    let (mut result, mut square) = (Transform::IDENTITY, *map);
    while times > 0 {
        if times % 2 == 1 {
            result = square.then_from(&result);
        }
        square = square.then_from(&square);
        times /= 2;
    }
    result
}
