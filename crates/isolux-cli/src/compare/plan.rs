//! What is to be run.

use crate::failure::Failure;
use crate::flags::CompareFlags;
use crate::{demo, source};
use isolux::scene::Scene;
use isolux_compare::case::cie171::CASES;
use isolux_compare::hall::Variant;
use isolux_compare::study::{System, Varied, times_s};
use std::path::{Path, PathBuf};

/// The longest time of a point unless told otherwise, s; and of a quick comparison.
const LIMIT_S: f64 = 8.0;
const QUICK_LIMIT_S: f64 = 0.5;

/// The first time of the scenes with exact answers, whose maps are fair within it; of others, s.
const FIRST_OF_EXACT_S: f64 = 0.125;
const FIRST_S: f64 = 1.0;

/// Width and height of pictures; and of a quick comparison.
const PICTURE: [u32; 2] = [640, 360];
const QUICK_PICTURE: [u32; 2] = [320, 180];

/// What the map of the reference picture is asked for, and that of a quick comparison.
const REFERENCE: f64 = 0.01;
const QUICK_REFERENCE: f64 = 0.05;

/// Rays that the audit of a point may take, so that it takes no longer than a second or two; and of a quick comparison.
const AUDIT_RAYS: u64 = 1 << 19;
const QUICK_AUDIT_RAYS: u64 = 1 << 16;

/// What maps of larger halls are asked for, and how long one may take, s: for the time that is told to be left.
const LARGER: f64 = 0.05;
const LARGER_ABOUT_S: f64 = 10.0;

/// Numbers of triangles and of luminaires that HALL is enlarged to.
const TRIANGLES: [u32; 3] = [10_000, 100_000, 1_000_000];
const LUMINAIRES: [u32; 4] = [100, 1_000, 10_000, 100_000];

/// What maps of analytic cases are asked for, as by `validate`, and in about how long, s.
pub(crate) const ANALYTIC_ACCURACY: f64 = 0.005;
pub(crate) const ANALYTIC_ABOUT_S: f64 = 2.0;

/// Systems that are asked for them, which differ in method alone: filters and ambient terms are tested elsewhere.
pub(crate) const ANALYTIC_SYSTEMS: [System; 4] =
    [System::Hybrid, System::Forward, System::Radiosity, System::Cache];

/// Scenes, systems and times.
pub(crate) struct Plan {
    pub(crate) cases: Vec<Case>,
    pub(crate) systems: Vec<System>,
    /// Renderers beside isolux.
    pub(crate) peers: Vec<System>,
    pub(crate) limit_s: f64,
    pub(crate) seed: u64,
    pub(crate) picture: [u32; 2],
    /// What the map of the reference picture is asked for.
    pub(crate) reference: f64,
    /// Rays that the audit of a point may take.
    pub(crate) audit_rays: u64,
    /// Whether the analytic cases of CIE 171:2006 are to be run.
    pub(crate) is_analytic: bool,
    /// Larger halls, and what their maps are asked for.
    pub(crate) larger: Vec<Larger>,
    pub(crate) accuracy_of_larger: f64,
}

/// A larger hall.
pub(crate) struct Larger {
    pub(crate) variant: Variant,
    pub(crate) varied: Varied,
    pub(crate) about_s: f64,
}

/// A scene to compare on.
pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) source: PathBuf,
    /// Read before any is compared: what is wrong with the last one is told before hours are spent on the first.
    pub(crate) scene: Scene,
    /// Whether its right values are known: then errors are measured, and no pictures made.
    pub(crate) is_exact: bool,
}

impl Plan {
    pub(crate) fn of(flags: &CompareFlags) -> Result<Self, Failure> {
        let picture = if flags.quick { QUICK_PICTURE } else { PICTURE };
        let default_s = if flags.quick { QUICK_LIMIT_S } else { LIMIT_S };
        let systems = match flags.systems.as_slice() {
            [] => System::ALL.to_vec(),
            names => names.iter().map(|name| system(name)).collect::<Result<_, _>>()?,
        };
        let (mut systems, mut peers): (Vec<System>, Vec<System>) =
            systems.into_iter().partition(|system| system.method().is_some());
        for all in [&mut systems, &mut peers] {
            all.sort();
            all.dedup();
        }
        let is_analytic = |name: &PathBuf| name.to_str() == Some(ANALYTIC);
        let is_all = |name: &PathBuf| name.to_str() == Some("all");
        let (analytic, others): (Vec<PathBuf>, Vec<PathBuf>) =
            flags.cases.iter().cloned().partition(is_analytic);
        let cases = cases(&others)?;
        let has_hall = cases.iter().any(|case| case.name == "hall");
        Ok(Self {
            larger: if has_hall && !flags.quick { larger() } else { Vec::new() },
            is_analytic: !analytic.is_empty() || others.iter().any(is_all) && !flags.quick,
            accuracy_of_larger: LARGER,
            audit_rays: if flags.quick { QUICK_AUDIT_RAYS } else { AUDIT_RAYS },
            cases,
            systems,
            peers,
            limit_s: flags.limit.map_or(default_s, |limit| limit.as_secs_f64()),
            seed: flags.seed,
            picture: flags.size.map_or(picture, |(width, height)| [width, height]),
            reference: if flags.quick { QUICK_REFERENCE } else { REFERENCE },
        })
    }

    /// The times of the points of a case, s.
    pub(crate) fn times_s(&self, case: &Case) -> Vec<f64> {
        times_s(if case.is_exact { FIRST_OF_EXACT_S } else { FIRST_S }, self.limit_s)
    }

    /// The times of all points together, s.
    pub(crate) fn asked_s(&self) -> f64 {
        let of_case = |case: &Case| self.times_s(case).iter().sum::<f64>();
        let larger_s: f64 = self.larger.iter().map(|larger| larger.about_s).sum();
        let ours = self.systems.iter().filter(|system| ANALYTIC_SYSTEMS.contains(system)).count();
        let analytic: usize = CASES.iter().map(|of| of.names.len()).sum();
        let analytic_s = match self.is_analytic {
            true => (ours * analytic) as f64 * ANALYTIC_ABOUT_S,
            false => 0.0,
        };
        self.systems.len() as f64 * self.cases.iter().map(of_case).sum::<f64>()
            + larger_s
            + analytic_s
    }
}

fn larger() -> Vec<Larger> {
    let larger = |variant, varied| Larger { variant, varied, about_s: LARGER_ABOUT_S };
    let triangles = TRIANGLES
        .map(|triangles| larger(Variant { triangles, ..Variant::STANDARD }, Varied::Triangles));
    let luminaires = LUMINAIRES
        .map(|luminaires| larger(Variant { luminaires, ..Variant::STANDARD }, Varied::Luminaires));
    triangles.into_iter().chain(luminaires).collect()
}

fn system(name: &str) -> Result<System, Failure> {
    System::parse(name).ok_or_else(|| {
        let names = System::ALL.map(System::name).join(", ");
        if name.is_empty() {
            return Failure::bad_input(format!("--systems: a name is empty; give some of {names}"));
        }
        Failure::bad_input(format!(
            "--systems {name}: there is no such system; choose some of {names}"
        ))
    })
}

/// The name of all cases of CIE 171:2006 together.
const ANALYTIC: &str = "cie171";

const ALL: [&str; 4] = ["cube", "sphere", "hall", "demo"];

fn cases(names: &[PathBuf]) -> Result<Vec<Case>, Failure> {
    let mut cases: Vec<Case> = Vec::new();
    for name in names {
        match name.to_str() {
            Some("all") => ALL.iter().try_for_each(|name| add(&mut cases, Path::new(name)))?,
            _ => add(&mut cases, name)?,
        }
    }
    Ok(cases)
}

fn add(cases: &mut Vec<Case>, name: &Path) -> Result<(), Failure> {
    // `builtin:cube` has the same right values as `cube`.
    let known = name.to_str().and_then(|name| name.strip_prefix("builtin:"));
    let name = known.filter(|name| ALL.contains(name)).map_or(name, Path::new);
    let source = match name.to_str() {
        Some("demo") => demo::find_scene()?,
        Some(builtin @ ("cube" | "sphere" | "hall")) => PathBuf::from(format!("builtin:{builtin}")),
        _ => name.to_owned(),
    };
    if !source.exists() && !source::is_builtin(&source) {
        let cases = ALL.join(", ");
        return Err(Failure::bad_input(format!(
            "{}: is no case and no file; give some of {cases}, {ANALYTIC}, all of them as `all`, or a scene",
            name.display()
        )));
    }
    let name = name.display().to_string();
    let is_exact = matches!(name.as_str(), "cube" | "sphere");
    if cases.iter().all(|case| case.name != name) {
        let scene = source::read_scene(&source)?;
        if !scene.gives_light() {
            return Err(source::no_light(&source, &scene));
        }
        cases.push(Case { name, source, scene, is_exact });
    }
    Ok(())
}

impl Case {
    /// Its name as a part of names of files.
    pub(crate) fn stem(&self) -> String {
        let kept = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
        self.name.chars().map(kept).collect::<String>().trim_matches('-').to_lowercase()
    }

    /// The beginning of the names of the files of a point.
    pub(crate) fn point_stem(&self, system: System, asked_s: f64) -> String {
        format!("{}-{}-{asked_s}s", self.stem(), system.name())
    }
}
