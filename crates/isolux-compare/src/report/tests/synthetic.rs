//! A study that never ran, with figures such as real ones have.

use crate::case::cube::TABLE_1;
use crate::measure::MeasuredPoint;
use crate::metric::{ColourDifference, PictureDistance};
use crate::study::{
    Analytic, Audited, CaseStudy, Cost, Distances, Found, Machine, Measured, Point, Prediction,
    Reference, Reported, Series, Settings, Study, System, Varied, Version, times_s,
};

/// How a system does: its error after one second, how fast that falls, and where it stays.
struct Course {
    at_1_s: f64,
    order: f64,
    floor: f64,
}

impl Course {
    fn at(&self, time_s: f64) -> f64 {
        (self.at_1_s * time_s.powf(-self.order)).hypot(self.floor)
    }
}

fn course(system: System) -> Course {
    let [at_1_s, order, floor] = match system {
        System::Hybrid => [0.0007, 0.5, 0.0],
        System::Forward => [0.012, 0.45, 0.0],
        System::ForwardUnfiltered => [0.03, 0.5, 0.0],
        System::Radiosity => [0.004, 1.0, 0.0031],
        System::RadiosityWithoutAmbient => [0.02, 1.0, 0.0031],
        System::RadiosityDiffuse => [0.01, 1.0, 0.21],
        System::Cache => [0.008, 0.3, 0.001],
        System::Radiance => [0.05, 0.4, 0.002],
        System::Mitsuba | System::LuxCore => [0.1, 0.5, 0.0],
    };
    Course { at_1_s, order, floor }
}

/// The whole study, with all systems and scenes.
pub(super) fn study() -> Study {
    Study {
        isolux: "0.1.0".to_owned(),
        machine: Machine {
            processor: "Made-up processor at 3 GHz".to_owned(),
            cores: 2,
            system: "linux".to_owned(),
        },
        settings: Settings { limit_s: 256.0, seed: 1, threads: 2, picture: [640, 360] },
        cases: vec![exact("cube", 12), exact("sphere", 16_384), practical("hall", 10_218)],
        analytic: vec![analytic()],
        costs: costs(),
        is_unfinished: false,
        versions: vec![Version { system: System::Radiance, version: "1.3.1".to_owned() }],
        missing: vec!["mitsuba (pip install mitsuba)".to_owned()],
    }
}

fn case(name: &str, triangles: u32, series: Vec<Series>) -> CaseStudy {
    CaseStudy {
        name: name.to_owned(),
        scene_hash: "5f1d".repeat(16),
        triangles,
        luminaires: if name == "hall" { 2626 } else { 1 },
        reference: None,
        landing: (name != "hall").then_some(3.0),
        error_limit: Some(0.02),
        series,
    }
}

fn analytic() -> Analytic {
    let found = |system: System| Found {
        system,
        time_s: 0.4,
        values_lx: vec![Some(100.3), (system != System::Cache).then_some(49.9)],
        standard_errors_lx: vec![system.method().map(|_| 0.2), None],
    };
    Analytic {
        number: "5.2".to_owned(),
        title: "point light sources".to_owned(),
        name: "cie171_5_2_isotropic".to_owned(),
        expected_lx: vec![100.0, 50.0],
        found: System::ALL.map(found).into(),
    }
}

fn costs() -> Vec<Cost> {
    let cost = |varied, triangles: u32, luminaires: usize| Cost {
        varied,
        triangles,
        luminaires,
        accuracy: 0.05,
        told: Some(0.048),
        time_s: 0.1 * f64::from(triangles).log2() + 0.2 * (luminaires as f64).log2(),
    };
    let triangles = [10_000, 100_000, 1_000_000].map(|n| cost(Varied::Triangles, n, 2626));
    let luminaires = [100, 1000, 10_000].map(|n| cost(Varied::Luminaires, 10_000, n));
    triangles.into_iter().chain(luminaires).collect()
}

fn exact(name: &str, triangles: u32) -> CaseStudy {
    let point = |system: System, asked_s: f64| {
        let mut point = plain(system, asked_s);
        point.measured = Some(measured(name, system, point.time_s));
        point
    };
    case(name, triangles, all_series(0.125, &System::ALL, &point))
}

fn practical(name: &str, triangles: u32) -> CaseStudy {
    let point = |system: System, asked_s: f64| {
        let mut point = plain(system, asked_s);
        let error = course(system).at(point.time_s / 20.0);
        point.picture = Some(format!("pictures/{name}-{}-{asked_s}s.png", system.name()));
        let is_last = asked_s == 256.0;
        point.from_last = Some(distances(if is_last { 0.0 } else { 1.4 * error }));
        point.from_reference = Some(distances(error + 0.01));
        point
    };
    let reference = Reference {
        picture: format!("pictures/{name}-reference.png"),
        told: Some(0.0097),
        time_s: 803.2,
        accuracy: 0.01,
        predictions: predictions(803.2, 0.0097),
        landing: Some(2.17),
    };
    let reference = Some(reference);
    CaseStudy { reference, ..case(name, triangles, all_series(1.0, &own(), &point)) }
}

/// The systems of isolux.
fn own() -> Vec<System> {
    System::ALL.into_iter().filter(|system| system.method().is_some()).collect()
}

fn all_series(
    first_s: f64,
    systems: &[System],
    point: &dyn Fn(System, f64) -> Point,
) -> Vec<Series> {
    let series = |&system: &System| Series {
        system,
        points: times_s(first_s, 256.0).into_iter().map(|s| point(system, s)).collect(),
        error_picture: Some(format!("pictures/errors-{}.png", system.name())),
    };
    systems.iter().map(series).collect()
}

/// Something that varies from map to map.
fn waver(system: System, time_s: f64) -> f64 {
    1.0 + 0.12 * (7.0 * time_s.ln() + 2.0 * system.name().len() as f64).sin()
}

fn plain(system: System, asked_s: f64) -> Point {
    let time_s = asked_s * (1.0 + 0.03 * waver(system, asked_s));
    let error = course(system).at(time_s) * waver(system, time_s);
    if system.method().is_none() {
        let effort = Some("0.4:64:0:16:5".to_owned());
        return Point { asked_s, effort, time_s, ..Point::default() };
    }
    let is_radiosity = system.name().starts_with("radiosity");
    let told = (!is_radiosity || asked_s > 0.5).then_some(1.1 * error);
    Point {
        asked_s,
        accuracy: Some(error),
        time_s,
        rays: Some((3.1e6 * time_s) as u64),
        receivers: Some(1634),
        landing: Some(3.0 * (1.0 + error)),
        reported: Reported {
            error: told,
            noise: told.map(|error| 0.8 * error),
            bare: told.map(|error| 2.3 * error),
            unshot: is_radiosity.then(|| (-0.02 * time_s).exp() * 0.6),
            filtered: (system == System::Forward).then(|| 0.9 / (1.0 + time_s)),
        },
        predictions: if is_radiosity { Vec::new() } else { predictions(time_s, error) },
        audited: told.map(|_| Audited {
            error,
            low: if asked_s < 1.0 { 0.0 } else { 0.7 * error },
            high: 1.3 * error,
            contradicts: false,
        }),
        ..Point::default()
    }
}

fn predictions(time_s: f64, error: f64) -> Vec<Prediction> {
    let finish_s = 1e4 * error * time_s;
    let one = |k: u32| {
        let at_s = time_s * f64::from(k) / 40.0;
        let spread = 1.0 / f64::from(k).sqrt();
        Prediction {
            at_s,
            error: (k > 2).then_some(error),
            finish_s,
            earliest_s: finish_s * (1.0 - 0.5 * spread),
            latest_s: finish_s * (1.0 + spread),
        }
    };
    (1..40).map(one).collect()
}

fn measured(name: &str, system: System, time_s: f64) -> Measured {
    let error = course(system).at(time_s) * waver(system, 2.0 * time_s);
    let letters = if name == "cube" { &TABLE_1[..] } else { &TABLE_1[2..3] };
    let is_told = system.method().is_some() && system != System::RadiosityDiffuse;
    let points = letters
        .iter()
        .map(|point| MeasuredPoint {
            name: point.name,
            expected_lx: 1353.247,
            measured_lx: 1353.247 * (1.0 + error),
            standard_error_lx: is_told.then_some(1353.247 * error),
        })
        .collect();
    Measured {
        points,
        error,
        grid: 1.2 * error,
        covered: is_told.then_some((0.95 * waver(system, time_s)).min(1.0)),
        told_over_true: is_told.then(|| 1.05 * waver(system, 3.0 * time_s)),
    }
}

fn distances(share: f64) -> Distances {
    let colours = |scale: f64| ColourDifference {
        mean: scale * share,
        median: 0.8 * scale * share,
        p95: 2.5 * scale * share,
        greatest: 9.0 * scale * share,
    };
    Distances {
        rgb: PictureDistance {
            components: [Some(share), Some(1.1 * share), None],
            mean: Some(1.05 * share),
        },
        cie1976: colours(60.0),
        cie1994: colours(40.0),
        ciede2000: colours(45.0),
    }
}
