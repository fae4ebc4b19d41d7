//! The luminaires of a report, by type.

use crate::shown::name;
use isolux::geometry::Point;
use isolux::photometry::IntensityDistribution;
use isolux::scene::{AreaLuminaire, LuminaireKind, LuminousArea, Scene};
use isolux_report::{Image, Luminaire, LuminousBody};
use isolux_view::PolarDiagram;
use std::f64::consts::PI;

/// Areas and luminances are alike up to such a share: coordinates of files are rounded.
const ALIKE: f64 = 1e-3;

/// All types, in the order of the scene.
pub(super) fn of(scene: &Scene) -> Vec<Luminaire> {
    let mut types: Vec<Type> = Vec::new();
    for (luminaire, fitting) in scene.luminaires().iter().zip(scene.fittings()) {
        if let LuminaireKind::Point { position, intensity, area, .. } = &luminaire.kind {
            let body = Body::Photometric(intensity, area.as_ref(), fitting.power_w);
            add(&mut types, &luminaire.name, *position, body);
        }
    }
    for surface in scene.area_luminaires() {
        let name = scene.shape_names().get(surface.shape as usize).map_or("", String::as_str);
        add(&mut types, name, middle(scene, surface), Body::Surface(surface));
    }
    types.into_iter().map(|of| of.luminaire()).collect()
}

/// What makes luminaires of one type.
#[derive(Clone, Copy)]
enum Body<'a> {
    /// With the power of one, if it is known, W.
    Photometric(&'a IntensityDistribution, Option<&'a LuminousArea>, Option<f64>),
    Surface(&'a AreaLuminaire),
}

struct Type<'a> {
    names: Vec<&'a str>,
    positions: Vec<Point>,
    body: Body<'a>,
}

fn add<'a>(types: &mut Vec<Type<'a>>, name: &'a str, position: Point, body: Body<'a>) {
    match types.iter_mut().find(|of| of.body.is_like(body)) {
        Some(of) => {
            of.names.push(name);
            of.positions.push(position);
        }
        None => types.push(Type { names: vec![name], positions: vec![position], body }),
    }
}

impl Body<'_> {
    fn is_like(self, other: Self) -> bool {
        let alike = |a: f64, b: f64| (a - b).abs() <= ALIKE * a.abs().max(b.abs());
        match (self, other) {
            (Self::Photometric(a, of_a, w_a), Self::Photometric(b, of_b, w_b)) => {
                a == b
                    && w_a == w_b
                    && of_a.map(seen_m2).zip(of_b.map(seen_m2)).is_none_or(|(a, b)| alike(a, b))
            }
            (Self::Surface(a), Self::Surface(b)) => {
                let luminance = |of: &AreaLuminaire| of.luminance_cd_m2.luminance();
                alike(a.area_m2, b.area_m2) && alike(luminance(a), luminance(b))
            }
            _ => false,
        }
    }
}

/// The greatest area that is seen along an axis.
fn seen_m2(area: &LuminousArea) -> f64 {
    use isolux::geometry::Direction;
    [Direction::X, Direction::Y, Direction::Z]
        .into_iter()
        .map(|along| area.seen_m2(along))
        .fold(0.0, f64::max)
}

impl Type<'_> {
    fn luminaire(&self) -> Luminaire {
        let (flux_lm, power_w, body, diagram) = match self.body {
            Body::Photometric(intensity, area, power_w) => {
                let svg = PolarDiagram::of(intensity).svg("", "");
                let body = area.map_or(LuminousBody::Point, |a| LuminousBody::Area(seen_m2(a)));
                (intensity.luminous_flux_lm(), power_w, body, Some(Image::Svg(svg)))
            }
            Body::Surface(of) => {
                let luminance = of.luminance_cd_m2.luminance();
                let flux_lm = PI * luminance * of.area_m2;
                (flux_lm, None, LuminousBody::Surface(of.area_m2, luminance), None)
            }
        };
        Luminaire {
            name: name(&common(&self.names)),
            manufacturer: None,
            positions_m: self.positions.iter().map(|&at| at.into()).collect(),
            flux_lm,
            power_w,
            body,
            diagram,
        }
    }
}

/// What names have in common at their beginning; the first name where that is nothing.
fn common(names: &[&str]) -> String {
    let [first, rest @ ..] = names else { return String::new() };
    let shared = |a: &str, b: &str| {
        a.char_indices()
            .zip(b.chars())
            .take_while(|((_, a), b)| a == b)
            .map(|((i, c), _)| i + c.len_utf8())
            .last()
    };
    let length = rest.iter().map(|name| shared(first, name).unwrap_or(0)).min();
    let start = first[..length.unwrap_or(first.len())].trim_end_matches(|c: char| {
        c.is_ascii_digit() || c.is_whitespace() || "[](),_-#.".contains(c)
    });
    if start.is_empty() { (*first).to_owned() } else { start.to_owned() }
}

/// The middle of a luminous surface, by area.
fn middle(scene: &Scene, of: &AreaLuminaire) -> Point {
    let mut sum = [0.0; 3];
    for &triangle in &of.triangles {
        let triangle = scene.triangle(triangle);
        let share = triangle.area() / of.area_m2 / 3.0;
        for corner in triangle.corners {
            let at: [f64; 3] = corner.into();
            (0..3).for_each(|k| sum[k] += share * at[k]);
        }
    }
    Point::from(sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_are_named_by_what_their_luminaires_share() {
        assert_eq!(common(&["panel 1", "panel 2", "panel 10"]), "panel");
        assert_eq!(common(&["downlight[0][1]", "downlight[0][2]"]), "downlight");
        assert_eq!(common(&["a", "b"]), "a");
        assert_eq!(common(&["spot 12"]), "spot");
    }
}
