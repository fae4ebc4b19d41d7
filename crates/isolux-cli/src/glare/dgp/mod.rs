//! The daylight glare probability (Wienold and Christoffersen 2006).

mod field;
mod patches;

use super::position::daylight_position_index;
use crate::failure::Failure;
use crate::flags::GlareFlags;
use crate::glare_threshold::Threshold;
use crate::quantity::significant;
use crate::shown::name;
use crate::traced::Watched;
use field::{Field, view_of};
use isolux::engine::{MapReader, ProbePoint};
use isolux::map::NORMAL_95;
use isolux::map::{Figure, IlluminationMap};
use isolux::scene::{Camera, Scene};
use isolux::units::to_error;
use isolux_view::Size;
use patches::{Patch, patches};
use serde::Serialize;

/// Pixels across the hemisphere that is looked at; each is looked at in several places, as fine as the disc of the sun asks for.
const ACROSS: u32 = 300;
/// Views with noise of their own, and Student's t of 95 % for their mean.
const ROUNDS: u32 = 4;
const STUDENT_95: f64 = 3.182;
/// What glares unless something else is said, cd/m2.
const USUAL_THRESHOLD: Threshold = Threshold::Luminance(2000.0);
/// Below this illuminance at the eye, lx, few people are asked for and the probability is lowered.
const DIM_LX: f64 = 1000.0;

/// What an observer in daylight sees.
#[derive(Debug, Serialize)]
pub(super) struct Daylit {
    observer: String,
    position: [f64; 3],
    direction: [f64; 3],
    dgp: Figure,
    /// By the value; the ends of the interval may be in others.
    class: &'static str,
    /// Of the low and of the high end.
    class_from: &'static str,
    class_to: &'static str,
    illuminance_at_eye_lx: Figure,
    mean_luminance_cd_m2: f64,
    threshold_cd_m2: f64,
    sources: Vec<Source>,
}

/// A patch that glares, in the first view.
#[derive(Clone, Debug, Serialize)]
struct Source {
    luminance_cd_m2: f64,
    solid_angle_sr: f64,
    position_index: f64,
}

/// Looks from all eyes; those inside of something are refused.
pub(super) fn observed(
    flags: &GlareFlags,
    (scene, map): (&Scene, &IlluminationMap),
    eyes: &[Camera],
) -> Result<Vec<Daylit>, Failure> {
    let watched = Watched::new(scene, map);
    let reader = MapReader::new(scene, map);
    let threshold = flags.threshold.unwrap_or(USUAL_THRESHOLD);
    eyes.iter().map(|eye| one(threshold, (&watched, &reader), eye)).collect()
}

fn one(
    threshold: Threshold,
    (watched, reader): (&Watched, &MapReader),
    eye: &Camera,
) -> Result<Daylit, Failure> {
    let normal = eye.direction.to_normal();
    let Some(read) = reader.measure(ProbePoint { position: eye.position, normal }) else {
        return Err(Failure::bad_input(format!(
            "observer `{}` is inside of something; move it into the room",
            name(&eye.name)
        )));
    };
    let (lx, error_lx) = (read.illuminance_lx(), read.standard_error_lx);
    let size = Size::new(ACROSS, ACROSS).map_err(Failure::bad_input)?;
    let (mut fields, mut sums) = (Vec::new(), Vec::new());
    for round in 0..ROUNDS {
        let (image, _) = watched.round((view_of(eye), size), round, None)?;
        let field = Field::of(&image, eye);
        let found = patches(&field, level(threshold, &field));
        let sources: Vec<Source> = found.iter().filter_map(|patch| source(eye, patch)).collect();
        sums.push(sources.iter().map(Source::glare).sum::<f64>());
        fields.push((field.mean_cd_m2(), level(threshold, &field), sources));
    }
    let half = half_width(lx, error_lx, &sums);
    let mean = sums.iter().sum::<f64>() / f64::from(ROUNDS);
    let value = probability(lx, mean);
    let dgp = Figure { value, low: (value - half).max(0.0), high: (value + half).min(1.0) };
    let (mean_luminance_cd_m2, threshold_cd_m2, sources) = fields.swap_remove(0);
    let reach = NORMAL_95 * error_lx;
    Ok(Daylit {
        observer: eye.name.clone(),
        position: eye.position.into(),
        direction: eye.direction.to_vector().into(),
        class: class(dgp.value),
        class_from: class(dgp.low),
        class_to: class(dgp.high),
        dgp,
        illuminance_at_eye_lx: Figure { value: lx, low: (lx - reach).max(0.0), high: lx + reach },
        mean_luminance_cd_m2,
        threshold_cd_m2,
        sources,
    })
}

fn level(threshold: Threshold, field: &Field) -> f64 {
    match threshold {
        Threshold::Luminance(cd_m2) => cd_m2,
        Threshold::OfMean(factor) => factor * field.mean_cd_m2(),
    }
}

fn source(eye: &Camera, patch: &Patch) -> Option<Source> {
    let position_index = daylight_position_index(eye, patch.towards()?)?;
    let luminance_cd_m2 = patch.luminance_cd_m2();
    Some(Source { luminance_cd_m2, solid_angle_sr: patch.steradians, position_index })
}

impl Source {
    /// L^2 omega / P^2.
    fn glare(&self) -> f64 {
        self.luminance_cd_m2 * self.luminance_cd_m2 * self.solid_angle_sr
            / (self.position_index * self.position_index)
    }
}

/// Half of the interval of 95 %: by the noise of the illuminance and by that of the views.
fn half_width(lx: f64, error_lx: f64, sums: &[f64]) -> f64 {
    let count = sums.len() as f64;
    let each: Vec<f64> = sums.iter().map(|&sum| probability(lx, sum)).collect();
    let mean = each.iter().sum::<f64>() / count;
    let variance = each.iter().map(|dgp| (dgp - mean) * (dgp - mean)).sum::<f64>() / (count - 1.0);
    let of_views = STUDENT_95 * (variance / count).sqrt();
    let sum = sums.iter().sum::<f64>() / count;
    let step = NORMAL_95 * error_lx;
    let of_light =
        0.5 * (probability(lx + step, sum) - probability((lx - step).max(0.0), sum)).abs();
    libm::hypot(of_views, of_light)
}

/// `5.87e-5 Ev + 0.0918 lg (1 + sum L^2 omega / (Ev^1.87 P^2)) + 0.16`, lowered in dim light and at most 1, as `evalglare` has it.
fn probability(lx: f64, sum: f64) -> f64 {
    if lx <= 0.0 {
        return 0.0;
    }
    let dgp = 5.87e-5 * lx + 0.0918 * libm::log10(1.0 + sum / libm::pow(lx, 1.87)) + 0.16;
    let dim = if lx < DIM_LX {
        let of_light = libm::exp(0.024 * lx - 4.0);
        of_light / (1.0 + of_light)
    } else {
        1.0
    };
    (dgp * dim).min(1.0)
}

/// What people say (Wienold 2009).
fn class(dgp: f64) -> &'static str {
    match dgp {
        dgp if dgp < 0.35 => "imperceptible",
        dgp if dgp < 0.40 => "perceptible",
        dgp if dgp < 0.45 => "disturbing",
        _ => "intolerable",
    }
}

/// For people.
pub(super) fn text(observed: &[Daylit]) -> String {
    let row = |of: &Daylit| {
        let Figure { value, low, high } = of.dgp;
        let written = |dgp: f64| to_error(dgp, (0.5 * (high - low)).max(0.005));
        let class = if of.class_from == of.class_to {
            of.class.to_owned()
        } else {
            format!("{} ({} to {})", of.class, of.class_from, of.class_to)
        };
        vec![
            name(&of.observer),
            format!("{} ({} to {})", written(value), written(low), written(high)),
            class,
            significant(of.illuminance_at_eye_lx.value, 3),
            of.sources.len().to_string(),
        ]
    };
    let header = ["observer", "DGP", "glare is", "at the eye, lx", "sources"];
    crate::console::table(&header, &observed.iter().map(row).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn probabilities_by_hand() {
        // 0.1174 + 0.0918 lg (1 + 1e8 / 2000^1.87) + 0.16, the logarithm of 1 + 67.15.
        let by_hand = 0.1174 + 0.0918 * libm::log10(1.0 + 1e8 / libm::pow(2000.0, 1.87)) + 0.16;
        assert!((probability(2000.0, 1e8) - by_hand).abs() < 1e-12);
        assert!((by_hand - 0.4457).abs() < 1e-3, "{by_hand}");
        // Without a source, in dim light: 100 lx are 0.1659 times exp(-1.6) / (1 + exp(-1.6)).
        let dim = libm::exp(-1.6) / (1.0 + libm::exp(-1.6));
        assert!((probability(100.0, 0.0) - 0.165_87 * dim).abs() < 1e-9);
        assert_eq!(probability(0.0, 0.0), 0.0);
        assert_eq!(probability(1e6, 0.0), 1.0);
    }

    #[test]
    fn noise_of_light_and_of_views_adds_in_squares() {
        // Of light alone: 1.96 x 100 lx x 5.87e-5.
        let light = half_width(3000.0, 100.0, &[0.0; 4]);
        assert!((light - NORMAL_95 * 100.0 * 5.87e-5).abs() < 1e-9, "{light}");
        let views = half_width(3000.0, 0.0, &[1e8, 2e8, 1e8, 2e8]);
        let [low, high] = [1e8, 2e8].map(|sum| probability(3000.0, sum));
        let by_hand = STUDENT_95 * (high - low) * (1.0_f64 / 12.0).sqrt();
        assert!((views - by_hand).abs() < 1e-9, "{views} {by_hand}");
        assert_eq!(half_width(3000.0, 0.0, &[1e8; 4]), 0.0);
    }

    #[test]
    fn classes_end_where_they_should() {
        for (dgp, said) in [
            (0.349, "imperceptible"),
            (0.35, "perceptible"),
            (0.42, "disturbing"),
            (0.45, "intolerable"),
        ] {
            assert_eq!(class(dgp), said);
        }
    }
}
