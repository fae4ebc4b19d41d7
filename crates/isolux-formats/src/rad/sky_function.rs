//! Brightness of skies by direction: the functions that `gensky` and `gendaylit` write (`lib/skybright.cal`, `lib/perezlum.cal`).

use super::modifiers::Definition;
use super::record::Object;
use super::xform;
use isolux::geometry::{Direction, Transform, Vector};

/// A function of direction that multiplies a radiance.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SkyFunction {
    form: Form,
    /// W/(sr m2) that below the horizon is all, and just above it a part.
    ground: f64,
    function_from_world: Transform,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    /// The CIE clear sky of 1973, over its value at the zenith.
    Clear {
        zenith: f64,
        norm: f64,
        sun: Direction,
    },
    /// The CIE overcast sky of 1955.
    Overcast {
        zenith: f64,
    },
    Uniform {
        zenith: f64,
    },
    /// The intermediate sky of K. Matsuura.
    Intermediate {
        zenith: f64,
        norm: f64,
        sun: Direction,
    },
    /// The all-weather sky of Perez, Seals and Michalsky.
    Perez {
        scale: f64,
        parameters: [f64; 5],
        sun: Direction,
    },
}

/// Below this sine of elevation the gradation stays as it is there.
const LEAST_UP: f64 = 0.01;

/// Whether a pattern names such a function.
pub(super) fn is_one(object: &Object) -> bool {
    matches!(object.type_.as_str(), "brightfunc" | "colorfunc") && named(object).is_some()
}

/// The variable and the file, and what follows them.
fn named(object: &Object) -> Option<(&str, &str, &[String])> {
    let count = if object.type_ == "colorfunc" { 3 } else { 1 };
    let (variables, rest) = object.strings.split_at_checked(count)?;
    let (file, transform) = rest.split_first()?;
    let first = variables.first()?.as_str();
    if variables.iter().any(|variable| variable != first) {
        return None;
    }
    let file = file.rsplit(['/', '\\']).next().unwrap_or_default();
    let is_known =
        matches!((first, file), ("skybr", "skybright.cal") | ("skybright", "perezlum.cal"));
    is_known.then_some((first, file, transform))
}

impl SkyFunction {
    /// The function of a pattern that [`is_one`], in its place.
    pub(super) fn of(definition: &Definition) -> Result<Self, String> {
        let object = &definition.object;
        let (_, file, words) = named(object).ok_or("is no function of a sky that is read")?;
        let numbers = &object.numbers[..];
        let (form, ground) = match file {
            "perezlum.cal" => perez(numbers)?,
            _ => gensky(numbers)?,
        };
        let own = match words {
            [] => Transform::IDENTITY,
            words => xform::parse(words)?.copies.first().map_or(Transform::IDENTITY, |c| c.map),
        };
        let world_from_function = definition.world_from_file.then_from(&own);
        let function_from_world = world_from_function.inverse().ok_or("has a flat transform")?;
        Ok(Self { form, ground, function_from_world })
    }

    /// The factor in a direction of the world.
    pub(super) fn at(&self, towards: Direction) -> f64 {
        let turned = self.function_from_world.vector(towards.to_vector()).direction();
        let towards = turned.unwrap_or(Direction::Z);
        let up = towards.to_vector().z;
        // As `wmean` of both files blends sky and ground.
        let weight = libm::pow(up + 1.01, 10.0);
        let (sky, ground) = (weight * self.form.at(towards), self.ground / weight);
        ((sky + ground) / (weight + 1.0 / weight)).max(0.0)
    }
}

fn sun([x, y, z]: [f64; 3]) -> Result<Direction, String> {
    Vector::new(x, y, z).direction().ok_or_else(|| "has a sun in no direction".to_owned())
}

fn gensky(numbers: &[f64]) -> Result<(Form, f64), String> {
    match *numbers {
        [2.0, zenith, ground, ..] => Ok((Form::Overcast { zenith }, ground)),
        [3.0, zenith, ground, ..] => Ok((Form::Uniform { zenith }, ground)),
        [1.0, zenith, ground, norm, x, y, z] if norm > 0.0 => {
            Ok((Form::Clear { zenith, norm, sun: sun([x, y, z])? }, ground))
        }
        [4.0, zenith, ground, norm, x, y, z] if norm > 0.0 => {
            Ok((Form::Intermediate { zenith, norm, sun: sun([x, y, z])? }, ground))
        }
        _ => Err("does not have the real arguments that gensky writes".to_owned()),
    }
}

fn perez(numbers: &[f64]) -> Result<(Form, f64), String> {
    let &[scale, ground, a, b, c, d, e, x, y, z] = numbers else {
        return Err("does not have the 10 real arguments that gendaylit writes".to_owned());
    };
    Ok((Form::Perez { scale, parameters: [a, b, c, d, e], sun: sun([x, y, z])? }, ground))
}

impl Form {
    fn at(&self, towards: Direction) -> f64 {
        let up = towards.to_vector().z.clamp(-1.0, 1.0);
        let from_sun = |sun: Direction| towards.dot(sun).clamp(-1.0, 1.0);
        match *self {
            Self::Uniform { zenith } => zenith,
            Self::Overcast { zenith } => zenith * (1.0 + 2.0 * up) / 3.0,
            Self::Clear { zenith, norm, sun } => {
                let cos = from_sun(sun);
                let about_sun = 0.91 + 10.0 * libm::exp(-3.0 * libm::acos(cos)) + 0.45 * cos * cos;
                let gradation = if up > LEAST_UP { 1.0 - libm::exp(-0.32 / up) } else { 1.0 };
                zenith * about_sun * gradation / norm
            }
            Self::Intermediate { zenith, norm, sun } => {
                let gamma = libm::acos(from_sun(sun));
                let eta = libm::acos(up);
                let zt = libm::acos(sun.to_vector().z.clamp(-1.0, 1.0));
                let gradation = (1.35 * libm::sin(5.631 - 3.59 * eta) + 3.12)
                    * libm::sin(4.396 - 2.6 * zt)
                    + 6.37
                    - eta;
                let falling = -0.563 * ((2.629 - eta) * (1.562 - zt) + 0.812);
                zenith * gradation / 2.326 * libm::exp(gamma * falling) / norm
            }
            Self::Perez { scale, parameters: [a, b, c, d, e], sun } => {
                let cos = from_sun(sun);
                let gradation = 1.0 + a * libm::exp(b / up.max(LEAST_UP));
                scale * gradation * (1.0 + c * libm::exp(d * libm::acos(cos)) + e * cos * cos)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lines::At;
    use crate::rad::modifiers::Named;
    use std::path::Path;

    /// Directions in which Radiance was asked.
    const ASKED: [[f64; 3]; 9] = [
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 1.0],
        [0.0, 1.0, 0.1],
        [-0.5, -0.8, 0.9],
        [0.3, -0.7, 0.02],
        [0.0, -1.0, -0.02],
        [1.0, 1.0, -0.3],
        [0.0, 0.0, -1.0],
        [-0.2, -0.75, 0.63],
    ];

    /// Material of sky and ground, as Radiance's tutorials have them, by 179 (0.265 red + 0.670 green + 0.065 blue).
    const SKY_CD_M2: f64 = 179.0 * (0.265 * 0.9 + 0.67 * 0.9 + 0.065 * 1.15);
    const GROUND_CD_M2: f64 = 179.0 * (0.265 * 1.4 + 0.67 * 0.9 + 0.065 * 0.6);

    /// Real arguments by the programs named, and luminances, cd/m2, by `rtrace -h -ab 0` (pyradiance 1.3.1).
    const RADIANCE: [(&str, &str, &[f64], [f64; 9]); 5] = [
        (
            "gensky -ang 40 20 +s -t 2.45",
            "skybr skybright.cal",
            &[1.0, 8.325, 19.12, 0.5002, -0.262003, -0.719846, 0.642788],
            [1364.5, 1138.8, 2938.6, 7473.6, 4005.1, 4733.6, 3469.3, 3467.0, 10281.6],
        ),
        (
            "gensky -ang 40 20 -c",
            "skybr skybright.cal",
            &[2.0, 27.84, 4.330],
            [4566.0, 3674.4, 1700.9, 3623.1, 1308.4, 1158.7, 787.6, 785.1, 3440.2],
        ),
        (
            "gensky -ang 40 20 +i",
            "skybr skybright.cal",
            &[4.0, 18.08, 6.922, 0.9860, -0.262003, -0.719846, 0.642788],
            [2964.5, 2427.9, 1279.9, 9217.2, 3206.4, 3091.2, 1255.3, 1255.1, 10593.4],
        ),
        (
            "gensky -ang 40 20 -u -b 10",
            "skybr skybright.cal",
            &[3.0, 10.0, 2.0],
            [1640.1, 1640.1, 1494.1, 1640.1, 1208.3, 1015.3, 380.2, 362.7, 1640.0],
        ),
        (
            "gendaylit -ang 40 20 -W 450 150",
            "skybright perezlum.cal",
            &[
                31.10, 15.07, -1.005403, -0.477853, 13.788334, -3.284768, 0.034342, -0.262003,
                -0.719846, 0.642788,
            ],
            [3454.6, 2981.0, 4871.0, 22713.0, 6302.3, 6732.2, 2769.6, 2732.6, 32336.5],
        ),
    ];

    fn function(words: &str, numbers: &[f64], world_from_file: Transform) -> SkyFunction {
        let strings = words.split_whitespace().map(str::to_owned).collect();
        let object = Object {
            type_: "brightfunc".into(),
            strings,
            numbers: numbers.to_vec(),
            ..Object::default()
        };
        assert!(is_one(&object));
        let at = At { file: Path::new("a.rad").into(), line: 1 };
        let (modifier, target, background) = (Named::Nothing, Named::Unknown, Named::Unknown);
        SkyFunction::of(&Definition { at, object, modifier, target, background, world_from_file })
            .unwrap()
    }

    fn direction(v: [f64; 3]) -> Direction {
        Vector::from(v).direction().unwrap()
    }

    /// What rtrace prints has four digits.
    #[test]
    fn skies_are_as_bright_as_in_radiance() {
        for (command, words, numbers, luminances) in RADIANCE {
            let sky = function(words, numbers, Transform::IDENTITY);
            for (towards, expected) in ASKED.into_iter().zip(luminances) {
                let of_material = if towards[2] < 0.0 { GROUND_CD_M2 } else { SKY_CD_M2 };
                let found = of_material * sky.at(direction(towards));
                assert!(
                    (found / expected - 1.0).abs() < 2e-3,
                    "{command} {towards:?}: {found} {expected}"
                );
            }
        }
    }

    #[test]
    fn skies_turn_with_their_file() {
        let (_, words, numbers, _) = RADIANCE[4];
        let straight = function(words, numbers, Transform::IDENTITY);
        // A quarter turn about z takes +x to +y.
        let quarter = Transform {
            columns: [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]].map(Vector::from),
            ..Transform::IDENTITY
        };
        let words_turned = format!("{words} -rz 90");
        for turned in [
            function(words, numbers, quarter),
            function(&words_turned, numbers, Transform::IDENTITY),
        ] {
            for [x, y, z] in ASKED {
                let (a, b) = (straight.at(direction([x, y, z])), turned.at(direction([-y, x, z])));
                assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
            }
        }
    }

    #[test]
    fn arguments_that_are_wrong_are_told() {
        for (words, numbers) in [
            ("skybr skybright.cal", &[1.0, 2.0, 3.0][..]),
            ("skybr skybright.cal", &[7.0, 2.0, 3.0]),
            ("skybr skybright.cal", &[1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0]),
            ("skybr skybright.cal", &[1.0, 2.0, 3.0, 1.0, 0.0, 0.0, 0.0]),
            ("skybright perezlum.cal", &[1.0; 9]),
            ("skybr skybright.cal -s 0", &[3.0, 1.0, 1.0]),
        ] {
            let strings = words.split_whitespace().map(str::to_owned).collect();
            let object = Object {
                type_: "brightfunc".into(),
                strings,
                numbers: numbers.to_vec(),
                ..Object::default()
            };
            let at = At { file: Path::new("a.rad").into(), line: 1 };
            let (modifier, target, background) = (Named::Nothing, Named::Unknown, Named::Unknown);
            let definition = Definition {
                at,
                object,
                modifier,
                target,
                background,
                world_from_file: Transform::IDENTITY,
            };
            assert!(SkyFunction::of(&definition).is_err(), "{words} {numbers:?}");
        }
        let other = Object {
            type_: "brightfunc".into(),
            strings: vec!["f".into(), "mine.cal".into()],
            ..Object::default()
        };
        assert!(!is_one(&other));
    }
}
