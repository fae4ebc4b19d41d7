//! `gensky` and `gendaylit`, as far as they are made here: the statements that they would write.

use super::record::Object;
use super::solar::{Solar, value};
use crate::efficacy::EFFICACY_LM_W;
use isolux::geometry::Direction;
use isolux::photometry::SkyWeather;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// Luminous efficacies of skylight and sunlight, lm/W (`SKYEFFICACY`, `SUNEFFICACY` of Radiance's `color.h`).
const SKY_LM_W: f64 = 203.0;
const SUN_LM_W: f64 = 208.0;
/// Solid angles of the sun, sr, as they are rounded there: by gensky for the ground and for the irradiance of `-R`, by gendaylit.
const SUN_SR: [f64; 3] = [6e-5, 5.98e-5, 6.8e-5];
/// Full angles of the suns of both.
const GENSKY_SUN_DEG: f64 = 0.5;
const GENDAYLIT_SUN_DEG: f64 = 0.533;
/// The day that gendaylit counts where the sun is given by angles: its brightness is that of early January (a table in the core compares).
const USUAL_DAY: u16 = 1;
/// The dew point of two centimetres of water in the air, which gendaylit takes.
const DEW_POINT_C: f64 = 10.973_53;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    Clear,
    Overcast,
    Uniform,
    Intermediate,
}

struct Gensky {
    form: Form,
    has_sun: bool,
    turbidity: f64,
    ground: f64,
    /// A radiance, or an irradiance.
    zenith: Option<(f64, bool)>,
    solar: Option<(f64, bool)>,
}

/// The statements of `gensky`.
pub(super) fn gensky(words: &[String], line: usize) -> Result<Vec<Object>, String> {
    let solar = Solar::parse(words)?;
    let asked = Gensky::parse(&solar.rest)?;
    let is_even = matches!(asked.form, Form::Overcast | Form::Uniform);
    let (altitude, sun) = solar.sun(is_even);
    let up = sun.to_vector().z;
    let (norm, share) = asked.form.norms(altitude, up);
    let zenith = match asked.zenith {
        Some((radiance, false)) => radiance,
        Some((irradiance, true)) => irradiance / (share * PI),
        None => usual_zenith_cd_m2(asked.form, asked.turbidity, altitude, up) / SKY_LM_W,
    };
    let is_up = !is_even && up > 0.0 && asked.solar.is_none_or(|(solar, _)| solar > 0.0);
    let radiance = match asked.solar {
        Some((radiance, false)) => radiance,
        Some((irradiance, true)) => irradiance / (SUN_SR[1] * up),
        None => usual_sun(asked.form, up),
    };
    let of_sun = if is_up { SUN_SR[0] / PI * radiance * up } else { 0.0 };
    let ground = asked.ground * (zenith * share + of_sun);
    let kind = match asked.form {
        Form::Clear => 1.0,
        Form::Overcast => 2.0,
        Form::Uniform => 3.0,
        Form::Intermediate => 4.0,
    };
    let mut numbers = vec![kind, zenith, ground];
    if !is_even {
        numbers.push(norm);
        numbers.extend(<[f64; 3]>::from(sun.to_vector()));
    }
    let sun = (is_up && asked.has_sun).then_some((radiance, GENSKY_SUN_DEG, sun));
    Ok(statements(line, sun, ["skybr", "skybright.cal"], numbers))
}

impl Gensky {
    fn parse(options: &[&str]) -> Result<Self, String> {
        let mut asked = Self {
            form: Form::Clear,
            has_sun: true,
            turbidity: 2.45,
            ground: 0.2,
            zenith: None,
            solar: None,
        };
        let mut options = options.iter().copied();
        while let Some(option) = options.next() {
            let mut next =
                || value(options.next().ok_or_else(|| format!("{option} without its value"))?);
            match option {
                "+s" | "-s" => (asked.form, asked.has_sun) = (Form::Clear, option == "+s"),
                "+i" | "-i" => (asked.form, asked.has_sun) = (Form::Intermediate, option == "+i"),
                "-c" | "+c" => asked.form = Form::Overcast,
                "-u" | "+u" => asked.form = Form::Uniform,
                "-t" => asked.turbidity = next()?,
                "-g" => asked.ground = next()?,
                "-b" => asked.zenith = Some((next()?, false)),
                "-B" => asked.zenith = Some((next()?, true)),
                "-r" => asked.solar = Some((next()?, false)),
                "-R" => asked.solar = Some((next()?, true)),
                _ => return Err(format!("its option `{option}` is not read")),
            }
        }
        Ok(asked)
    }
}

impl Form {
    /// The value of the formula in the zenith, and horizontal irradiance over pi times the radiance there, as gensky has them.
    fn norms(self, altitude: f64, up: f64) -> (f64, f64) {
        let zenith_rad = FRAC_PI_2 - altitude;
        let x = (altitude - FRAC_PI_4) / FRAC_PI_4;
        let (norm, polynomial) = match self {
            Self::Uniform => return (1.0, 1.0),
            Self::Overcast => return (1.0, 0.777_778),
            Self::Clear => (
                0.274 * (0.91 + 10.0 * libm::exp(-3.0 * zenith_rad) + 0.45 * up * up),
                [2.766_521, 0.547_665, -0.369_832, 0.009_237, 0.059_229],
            ),
            Self::Intermediate => (
                (2.739 + 0.9891 * libm::sin(0.3119 + 2.6 * altitude))
                    * libm::exp(-zenith_rad * (0.4441 + 1.48 * altitude)),
                [3.5556, -2.7152, -1.3081, 1.0660, 0.602_27],
            ),
        };
        let sum = polynomial.iter().rev().fold(0.0, |sum, c| sum * x + c);
        (norm, sum / norm / PI)
    }
}

/// In cd/m2, by the height of the sun.
fn usual_zenith_cd_m2(form: Form, turbidity: f64, altitude: f64, up: f64) -> f64 {
    let overcast = 8.6 * up + 0.123;
    let clear = (1.376 * turbidity - 1.81) * libm::tan(altitude) + 0.38;
    let klux = match form {
        Form::Overcast | Form::Uniform => overcast,
        Form::Clear => clear,
        Form::Intermediate => 0.5 * (clear + overcast),
    };
    1000.0 * klux.max(0.0)
}

/// Radiance of the sun, W/(sr m2).
fn usual_sun(form: Form, up: f64) -> f64 {
    let clear = 1.5e9 / SUN_LM_W * (1.147 - 0.147 / up.max(0.16));
    if form == Form::Intermediate { 0.15 * clear } else { clear }
}

/// The form of gensky by which gendaylit finds the light of the ground.
fn nearest(clearness: f64) -> Form {
    if clearness <= 1.0 {
        Form::Overcast
    } else if clearness >= 6.0 {
        Form::Clear
    } else {
        Form::Intermediate
    }
}

/// The statements of `gendaylit` with irradiances (`-W`, `-G`). Its sum over 145 parts of the sky is an integral here.
pub(super) fn gendaylit(words: &[String], line: usize) -> Result<Vec<Object>, String> {
    let solar = Solar::parse(words)?;
    let (altitude, sun) = solar.sun(false);
    let up = sun.to_vector().z;
    let (mut given, mut has_sun, mut reflectance) = (None, true, 0.2);
    let mut options = solar.rest.iter().copied();
    while let Some(option) = options.next() {
        let mut next =
            || value(options.next().ok_or_else(|| format!("{option} without its value"))?);
        match option {
            "-W" => given = Some([next()?, next()?]),
            "-G" => given = Some([next()? / up, next()?]),
            "-g" => reflectance = next()?,
            "-s" | "+s" => has_sun = option == "+s",
            "-w" => {}
            _ => return Err(format!("its option `{option}` is not read: give -W or -G")),
        }
    }
    let [direct_normal_w_m2, diffuse_horizontal_w_m2] = given
        .filter(|given| given.iter().all(|w| *w >= 0.0 && w.is_finite()))
        .ok_or("it needs irradiances of 0 or more, by -W or -G, of a sun above the horizon")?;
    let weather = SkyWeather {
        direct_normal_w_m2,
        diffuse_horizontal_w_m2,
        day: solar.day().unwrap_or(USUAL_DAY),
        dew_point_c: DEW_POINT_C,
    };
    let light = weather.light(sun);
    let half_sin = libm::sin(GENDAYLIT_SUN_DEG.to_radians() / 4.0);
    let radiance = light.sun_normal_lx / (4.0 * PI * half_sin * half_sin) / EFFICACY_LM_W;
    // As gensky has it for the form that is nearest.
    let (_, share) = nearest(light.clearness).norms(altitude, up);
    let zenith = light.sky.luminance_cd_m2(Direction::Z) / EFFICACY_LM_W;
    let of_sun =
        if has_sun && light.clearness > 1.0 { SUN_SR[2] / PI * radiance * up } else { 0.0 };
    let ground = reflectance * (zenith * share + of_sun);
    let mut numbers = vec![light.sky.scale_cd_m2 / EFFICACY_LM_W, ground];
    let [_, c, d, e] = light.sky.indicatrix;
    numbers.extend(light.sky.gradation);
    numbers.extend([c, d, e]);
    numbers.extend(<[f64; 3]>::from(sun.to_vector()));
    let sun = (has_sun && radiance > 0.0).then_some((radiance, GENDAYLIT_SUN_DEG, sun));
    Ok(statements(line, sun, ["skybright", "perezlum.cal"], numbers))
}

/// A sun with its radiance and full angle, if there is one, and the function `skyfunc`.
fn statements(
    line: usize,
    sun: Option<(f64, f64, Direction)>,
    function: [&str; 2],
    numbers: Vec<f64>,
) -> Vec<Object> {
    let object = |modifier: &str, type_: &str, name: &str, numbers| Object {
        line,
        modifier: modifier.to_owned(),
        type_: type_.to_owned(),
        name: name.to_owned(),
        strings: Vec::new(),
        numbers,
    };
    let mut made = Vec::new();
    if let Some((radiance, angle_deg, towards)) = sun {
        let [x, y, z] = towards.to_vector().into();
        made.push(object("void", "light", "solar", vec![radiance; 3]));
        made.push(object("solar", "source", "sun", vec![x, y, z, angle_deg]));
    }
    let sky = object("void", "brightfunc", "skyfunc", numbers);
    made.push(Object { strings: function.map(str::to_owned).to_vec(), ..sky });
    made
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Arguments and what the programs write (pyradiance 1.3.1): radiance of the sun, real arguments of the function.
    const WRITTEN: [(&str, Option<f64>, &[f64]); 7] = [
        (
            "gensky 6 21 12 +s",
            Some(7.177e6),
            &[1.0, 31.59, 30.18, 1.647, 0.038267, -0.247596, 0.968107],
        ),
        ("gensky 6 21 12 -c", None, &[2.0, 41.62, 6.474]),
        (
            "gensky 6 21 12 +i",
            Some(1.076e6),
            &[4.0, 36.60, 7.060, 1.191, 0.038267, -0.247596, 0.968107],
        ),
        ("gensky 6 21 12 -u", None, &[3.0, 41.62, 8.324]),
        (
            "gensky -ang 30 0 +s -B 55.8 -R 3 -g .2",
            Some(1.003e5),
            &[1.0, 8.745, 3.744, 0.3986, 0.0, -0.866025, 0.5],
        ),
        (
            "gendaylit 6 21 12 -W 700 120",
            Some(5.957e6),
            &[
                33.86, 31.31, -0.994264, -0.222785, 24.384671, -5.863408, 1.524523, 0.038267,
                -0.247596, 0.968107,
            ],
        ),
        (
            "gendaylit 9 21 12 -a 40 -o 98 -m 105 -W 650 110",
            Some(5.507e+06),
            &[
                35.25, 21.76, -0.970273, -0.212402, 15.411103, -3.920491, 0.625288, -0.151065,
                -0.638105, 0.754984,
            ],
        ),
    ];

    /// Four digits are written; the scale of gendaylit is that of a sum over parts of the sky.
    #[test]
    fn statements_are_those_of_radiance() {
        for (command, radiance, expected) in WRITTEN {
            let words: Vec<String> = command.split_whitespace().map(str::to_owned).collect();
            let is_gensky = words[0] == "gensky";
            let made = if is_gensky { gensky(&words[1..], 1) } else { gendaylit(&words[1..], 1) };
            let made = made.unwrap();
            let sun = made.iter().find(|object| object.type_ == "light").map(|o| o.numbers[0]);
            assert_eq!(sun.is_some(), radiance.is_some(), "{command}");
            if let (Some(found), Some(expected)) = (sun, radiance) {
                assert!((found / expected - 1.0).abs() < 1e-3, "{command}: {found}");
            }
            let numbers = &made.last().unwrap().numbers;
            assert_eq!(numbers.len(), expected.len(), "{command}");
            for (k, (found, expected)) in numbers.iter().zip(expected).enumerate() {
                let share = if !is_gensky && k < 2 { 0.02 } else { 1e-3 };
                println!("{command}, {k}: {}", found / expected);
                let most = share * expected.abs() + 1e-4;
                assert!((found - expected).abs() <= most, "{command}, {k}: {found} {expected}");
            }
        }
    }

    #[test]
    fn what_is_not_read_is_told() {
        let words = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
        for wrong in
            ["6 21", "13 1 12", "6 21 12EST", "6 21 25", "6 21 12 -y 2026", "6 21 12 -t", "a b c"]
        {
            assert!(gensky(&words(wrong), 1).is_err(), "{wrong}");
        }
        for wrong in
            ["6 21 12", "6 21 12 -L 1 2", "6 21 12 -W 1 -2", "6 21 12 -W 1", "-ang 0 0 -G 5 5"]
        {
            assert!(gendaylit(&words(wrong), 1).is_err(), "{wrong}");
        }
    }
}
