//! Properties by name and type.

use super::record::{Element, Wrong};
use isolux::geometry::{Direction, Point, Transform, Vector};
use isolux::units::sincos_deg;

fn number(word: &str) -> Option<f64> {
    word.parse().ok().filter(|value: &f64| value.is_finite())
}

/// Finite numbers separated by blanks or commas.
pub(super) fn numbers(text: &str) -> Option<Vec<f64>> {
    let words = text.split(|c: char| c.is_whitespace() || c == ',').filter(|w| !w.is_empty());
    words.map(number).collect()
}

fn wrong<T>(element: &Element, what: &str) -> Result<T, Wrong> {
    let shown: String = element.attribute("value").unwrap_or_default().chars().take(60).collect();
    Err((format!("{} `{}`: `{shown}` is not {what}", element.tag, element.slot()), "correct it"))
}

/// A number; `None` where the property is not given.
pub(super) fn float(object: &Element, name: &str) -> Result<Option<f64>, Wrong> {
    let Some(element) = object.child(name) else { return Ok(None) };
    match (element.tag.as_str(), element.attribute("value").map(str::trim).and_then(number)) {
        ("float" | "integer", Some(value)) => Ok(Some(value)),
        _ => wrong(element, "one finite number"),
    }
}

/// A length, an angle or a count above zero.
pub(super) fn positive(object: &Element, name: &str, usual: f64) -> Result<f64, Wrong> {
    let value = float(object, name)?.unwrap_or(usual);
    let refused = || (format!("`{name}` is {value}"), "give a number above 0");
    (value > 0.0).then_some(value).ok_or_else(refused)
}

pub(super) fn boolean(object: &Element, name: &str, usual: bool) -> Result<bool, Wrong> {
    let Some(element) = object.child(name) else { return Ok(usual) };
    match element.attribute("value").map(str::trim) {
        Some("true") => Ok(true),
        Some("false") => Ok(false),
        _ => wrong(element, "`true` or `false`"),
    }
}

pub(super) fn string<'a>(object: &'a Element, name: &str) -> Option<&'a str> {
    object.child(name).and_then(|element| element.attribute("value"))
}

/// A point or vector, from `x`, `y`, `z` or from `value`.
pub(super) fn triple(object: &Element, name: &str) -> Result<Option<[f64; 3]>, Wrong> {
    object.child(name).map(|element| components(element, 0.0)).transpose()
}

/// `x`, `y`, `z`, of which those not given are usual, or `value`.
fn components(element: &Element, usual: f64) -> Result<[f64; 3], Wrong> {
    if let Some(value) = element.attribute("value") {
        return match numbers(value).as_deref() {
            Some(&[all]) if element.tag == "scale" => Ok([all; 3]),
            Some(&[x, y, z]) => Ok([x, y, z]),
            _ => wrong(element, "three finite numbers"),
        };
    }
    let mut components = [usual; 3];
    for (component, name) in components.iter_mut().zip(["x", "y", "z"]) {
        if let Some(text) = element.attribute(name) {
            let bad =
                || (format!("{} {name} = `{text}` is not a number", element.tag), "correct it");
            *component = number(text.trim()).ok_or_else(bad)?;
        }
    }
    Ok(components)
}

/// A map, the identity where the property is not given. Its steps are done in the order written.
pub(super) fn transform(object: &Element, name: &str) -> Result<Transform, Wrong> {
    let Some(element) = object.child(name) else { return Ok(Transform::IDENTITY) };
    let mut map = Transform::IDENTITY;
    for step in &element.children {
        map = self::step(step)?.then_from(&map);
    }
    let flat =
        || (format!("transform `{name}` flattens what it moves"), "use scales that are not 0");
    // A determinant that overflows or vanishes has no inverse.
    map.inverse().map(|_| map).ok_or_else(flat)
}

fn step(step: &Element) -> Result<Transform, Wrong> {
    Ok(match step.tag.as_str() {
        "translate" => Transform::translation(Vector::from(components(step, 0.0)?)),
        "scale" => {
            let [x, y, z] = components(step, 1.0)?;
            Transform::scale(x, y, z)
        }
        "rotate" => rotation(step)?,
        "lookat" | "look_at" => look_at(step)?,
        "matrix" => matrix(step)?,
        _ => return Err((format!("transform step `{}` is not known", step.tag), TRANSFORM_STEPS)),
    })
}

const TRANSFORM_STEPS: &str = "use translate, rotate, scale, lookat or matrix";

fn rotation(step: &Element) -> Result<Transform, Wrong> {
    let axis = Vector::from(components(step, 0.0)?).direction();
    let angle_deg = step.attribute("angle").and_then(|text| number(text.trim()));
    let (Some(axis), Some(angle_deg)) = (axis, angle_deg) else {
        return Err(("rotate without an axis and an angle".into(), "give x, y or z, and angle"));
    };
    // Exact about the axes at quarter turns.
    let (s, c) = sincos_deg(angle_deg);
    let k = axis.to_vector();
    let turned = |v: Vector| v * c + k.cross(v) * s + k * (k.dot(v) * (1.0 - c));
    let columns = Transform::IDENTITY.columns.map(turned);
    Ok(Transform { columns, translation: Vector::ZERO })
}

/// Where a camera, or a spotlight, stands and looks.
fn look_at(step: &Element) -> Result<Transform, Wrong> {
    let read = |name: &str, usual: Option<[f64; 3]>| match step.attribute(name) {
        None => usual.ok_or_else(|| (format!("lookat without `{name}`"), "give three numbers")),
        Some(text) => match numbers(text).as_deref() {
            Some(&[x, y, z]) => Ok([x, y, z]),
            _ => Err((format!("lookat {name} = `{text}`"), "give three numbers")),
        },
    };
    let (origin, target) =
        (Vector::from(read("origin", None)?), Vector::from(read("target", None)?));
    let up = Vector::from(read("up", Some([0.0, 1.0, 0.0]))?);
    let along = ("lookat: origin, target and up lie on a line".to_owned(), "move one of them");
    let z = (target - origin).direction().ok_or_else(|| along.clone())?;
    let x = match up.cross(z.to_vector()).direction() {
        Some(x) => x,
        // As Mitsuba, any, where no up is given.
        None if step.attribute("up").is_none() => z.frame().0,
        None => return Err(along),
    };
    let y = z.to_vector().cross(x.to_vector());
    Ok(Transform { columns: [x.to_vector(), y, z.to_vector()], translation: origin })
}

/// Rows of a 4 x 4 or 3 x 3 matrix.
fn matrix(step: &Element) -> Result<Transform, Wrong> {
    let values = step.attribute("value").and_then(numbers);
    let (m, n) = match values.as_deref() {
        Some(m) if m.len() == 16 && m[12..] == [0.0, 0.0, 0.0, 1.0] => (m.to_vec(), 4),
        Some(m) if m.len() == 9 => (m.to_vec(), 3),
        _ => {
            let what = "matrix of neither 9 nor 16 numbers, the last row 0 0 0 1";
            return Err((what.into(), "write an affine map row by row"));
        }
    };
    let column = |k: usize| Vector::new(m[k], m[n + k], m[2 * n + k]);
    let translation = if n == 4 { column(3) } else { Vector::ZERO };
    Ok(Transform { columns: [column(0), column(1), column(2)], translation })
}

/// Where a map takes the third axis, and the origin.
pub(super) fn origin_and_axis(map: &Transform) -> Option<(Point, Direction)> {
    Some((map.point(Point::ORIGIN), map.columns[2].direction()?))
}
