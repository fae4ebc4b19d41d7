//! What is to be run.

use crate::failure::Failure;
use crate::flags::CompareFlags;
use crate::{demo, source};
use isolux::scene::Scene;
use isolux_compare::study::{System, times_s};
use std::path::{Path, PathBuf};

/// The longest time of a point unless told otherwise, s; and of a quick comparison.
const LIMIT_S: f64 = 16.0;
const QUICK_LIMIT_S: f64 = 1.0;

/// The first time of the scenes with exact answers, whose maps are fair within it; of others, s.
const FIRST_OF_EXACT_S: f64 = 0.125;
const FIRST_S: f64 = 1.0;

/// Width and height of pictures.
const PICTURE: [u32; 2] = [640, 360];

/// What the map of the reference picture is asked for, and that of a quick comparison.
const REFERENCE: f64 = 0.01;
const QUICK_REFERENCE: f64 = 0.05;

/// Scenes, systems and times.
pub(crate) struct Plan {
    pub(crate) cases: Vec<Case>,
    pub(crate) systems: Vec<System>,
    pub(crate) limit_s: f64,
    pub(crate) seed: u64,
    pub(crate) picture: [u32; 2],
    /// What the map of the reference picture is asked for.
    pub(crate) reference: f64,
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
        let default_s = if flags.quick { QUICK_LIMIT_S } else { LIMIT_S };
        let systems = match flags.systems.as_slice() {
            [] => System::ALL.to_vec(),
            names => names.iter().map(|name| system(name)).collect::<Result<_, _>>()?,
        };
        Ok(Self {
            cases: cases(&flags.cases)?,
            systems,
            limit_s: flags.limit.map_or(default_s, |limit| limit.as_secs_f64()),
            seed: flags.seed,
            picture: PICTURE,
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
        self.systems.len() as f64 * self.cases.iter().map(of_case).sum::<f64>()
    }
}

fn system(name: &str) -> Result<System, Failure> {
    System::parse(name).ok_or_else(|| {
        let names = System::ALL.map(System::name).join(", ");
        Failure::bad_input(format!(
            "--systems {name}: there is no such system; choose some of {names}"
        ))
    })
}

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
    let source = match name.to_str() {
        Some("demo") => demo::find_scene()?,
        Some(builtin @ ("cube" | "sphere" | "hall")) => PathBuf::from(format!("builtin:{builtin}")),
        _ => name.to_owned(),
    };
    let name = name.display().to_string();
    let is_exact = matches!(name.as_str(), "cube" | "sphere");
    if cases.iter().all(|case| case.name != name) {
        let scene = source::read_scene(&source)?;
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
}
