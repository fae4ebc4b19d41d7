//! `isolux report`: a lighting report as HTML or PDF.

mod areas;
mod fixtures;
mod surfaces;
mod views;
mod year;

use crate::console::{facts, print, print_json};
use crate::failure::{Failure, Outcome};
use crate::flags::{LanguageName, ReportFlags};
use crate::grid::{choice, decide, emergency, requirement};
use crate::maintained::Maintained;
use crate::origin::Extent;
use crate::output::OutputPath;
use crate::quantity::significant;
use crate::shown::name;
use crate::{annual, check, energy, map_file, source};
use isolux::engine::{MapReader, reference_lx};
use isolux::map::{IlluminationMap, Verdict};
use isolux::scene::{CalculationGrid, Luminaire, LuminaireKind, Scene, UpAxis};
use isolux_report::{Emergency, Finding, Language, Maintenance, Project, Report, Severity};
use serde::Serialize;

/// Files of reports.
const ENDS: [&str; 2] = ["html", "pdf"];

/// Runs the subcommand.
pub(crate) fn run(flags: &ReportFlags, json: bool) -> Result<Outcome, Failure> {
    let output = OutputPath::check_any(&flags.output, &ENDS)?;
    output.differs_from(&flags.source)?;
    let is_pdf = output.path().extension().is_some_and(|end| end.eq_ignore_ascii_case("pdf"));
    if is_pdf && !cfg!(feature = "pdf") {
        return Err(Failure::bad_input(format!(
            "{}: this isolux was built without PDF; write .html, which prints as pages, or build it with --features pdf",
            output.path().display()
        )));
    }
    let opened = Opened::of(flags)?;
    let language = match flags.language {
        LanguageName::En => Language::English,
        LanguageName::De => Language::German,
    };
    let report = report(flags, &opened, language)?;
    output.write(&bytes(&report, language, is_pdf)?)?;
    let told = Told::of(&output, &report);
    if json {
        print_json(&told)?;
    } else {
        print(&told.text())?;
    }
    let all_met = told.met == told.requirements;
    Ok(if all_met { opened.outcome } else { Outcome::CheckFailed })
}

/// What a report is made of.
struct Opened {
    scene: Scene,
    /// `None` of a scene without light of its own.
    map: Option<IlluminationMap>,
    grids: Vec<CalculationGrid>,
    findings: Vec<(bool, String)>,
    outcome: Outcome,
}

impl Opened {
    fn of(flags: &ReportFlags) -> Result<Self, Failure> {
        if !map_file::is_map(&flags.source) {
            return Self::of_scene(flags);
        }
        let (scene, map) = map_file::read_solved(&flags.source, flags.required.accuracy)?;
        map_file::warn_of_unknown_error(&flags.source, &map);
        let grids = grids(flags, &scene)?;
        let findings = check::findings(&scene, &flags.source, &[]);
        Ok(Self { scene, map: Some(map), grids, findings, outcome: Outcome::Done })
    }

    fn of_scene(flags: &ReportFlags) -> Result<Self, Failure> {
        let loaded = source::read_scene_with_warnings(&flags.source)?;
        let scene = loaded.value;
        let grids = grids(flags, &scene)?;
        // What else is asked for is looked at before anything is computed.
        views::cameras(flags, &scene)?;
        if scene.grids().iter().any(|grid| grid.emergency.is_some()) {
            emergency::lit(&scene, &flags.source)?;
        }
        if let Some(weather) = &flags.weather {
            annual::weather(weather)?;
        }
        let findings = check::findings(&scene, &flags.source, &loaded.warnings);
        // A room with windows alone has a year of daylight, and no light of its own.
        let is_dark = !scene.gives_light() && flags.weather.is_some();
        let (map, outcome) = match is_dark {
            true => (None, Outcome::Done),
            false => {
                let asked = (&scene, flags.source.as_path());
                let judge = |map: &IlluminationMap| {
                    let lit = (&scene, &MapReader::new(&scene, map));
                    requirement::judge(&areas::read(lit, &grids), lit)
                };
                let (map, outcome) =
                    decide::decided(asked, flags.required.accuracy, (&grids, &judge))?;
                (Some(map), outcome)
            }
        };
        Ok(Self { scene, map, grids, findings, outcome })
    }
}

/// The grids of the report: none of a scene without, unless something is asked of some.
fn grids(flags: &ReportFlags, scene: &Scene) -> Result<Vec<CalculationGrid>, Failure> {
    let has_none = flags.grid.is_empty() && !choice::has_ordinary(scene);
    if has_none && flags.required.require.is_empty() {
        return Ok(Vec::new());
    }
    requirement::grids((&flags.grid, true), &flags.required, (&flags.source, scene))
}

fn report(flags: &ReportFlags, opened: &Opened, language: Language) -> Result<Report, Failure> {
    let Opened { scene, map, grids, findings, .. } = opened;
    let light = Maintained::of(scene);
    grids.iter().for_each(|grid| requirement::warn_of_initial(grid, light));
    let daylight = year::of((flags.weather.as_deref(), &flags.year), scene, grids, language)?;
    let (mut areas, mut views, mut glare) = Default::default();
    if let Some(map) = map {
        let reader = MapReader::new(scene, map);
        areas = areas::of((scene, &reader), grids, (&flags.inputs, language.plan()))?;
        (views, glare) = views::of(flags, (scene, map, &reader))?;
    }
    let finding = |(is_warning, text): &(bool, String)| Finding {
        severity: if *is_warning { Severity::Warning } else { Severity::Note },
        text: text.clone(),
    };
    Ok(Report {
        project: project(flags, scene),
        scene: facts_of(scene),
        areas,
        luminaires: fixtures::of(scene),
        emergency: emergency(flags, scene)?,
        daylight,
        glare,
        views,
        surfaces: surfaces::of(scene),
        provenance: map.as_ref().map(|map| map.provenance.clone()),
        reference_lx: map.as_ref().map_or(0.0, reference_lx),
        energy: map.as_ref().and_then(|map| energy::of_run(scene, map)),
        findings: findings.iter().map(finding).collect(),
        software: concat!("isolux ", env!("CARGO_PKG_VERSION")).to_owned(),
    })
}

/// What came of the areas of emergency lighting, if there are any.
fn emergency(flags: &ReportFlags, scene: &Scene) -> Result<Option<Emergency>, Failure> {
    let source = flags.source.as_path();
    let mut areas = scene.grids().to_vec();
    areas.retain(|grid| grid.emergency.is_some());
    if areas.is_empty() {
        return Ok(None);
    }
    requirement::maintain(&mut areas, &flags.required, (source, scene))?;
    let lit = emergency::lit(scene, source)?;
    let mut requirements = Vec::new();
    for grid in &areas {
        requirements.extend(emergency::judged(grid, (&lit, source))?);
    }
    for of in &mut requirements {
        of.area = name(&of.area);
    }
    Ok(Some(Emergency { luminaires: lit.luminaires().len(), requirements }))
}

fn project(flags: &ReportFlags, scene: &Scene) -> Project {
    let of_scene = || match scene.name() {
        "" => flags.source.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        name => name.to_owned(),
    };
    Project {
        title: name(&flags.title.clone().unwrap_or_else(of_scene)),
        client: flags.client.clone(),
        author: flags.author.clone(),
        date: flags.date.clone(),
        remarks: flags.remarks.clone(),
    }
}

fn facts_of(scene: &Scene) -> isolux_report::Scene {
    let [x, y, z] = Extent::of(scene).size_m();
    let far = |kind: &LuminaireKind| kind.is_infinitely_far();
    let has_flux = scene.luminaires().iter().any(|luminaire| !far(&luminaire.kind))
        || !scene.area_luminaires().is_empty();
    let skies = scene.luminaires().iter().filter(|luminaire| far(&luminaire.kind));
    let (surface_m2, mean_reflectance) = surfaces::mean(scene);
    isolux_report::Scene {
        name: name(scene.name()),
        size_m: match scene.up() {
            UpAxis::Y => [x, z, y],
            UpAxis::Z => [x, y, z],
        },
        surface_m2,
        mean_reflectance,
        flux_lm: has_flux.then(|| scene.luminous_flux_lm()),
        maintenance: scene.maintenance().map_or(Maintenance::Initial, |factors| {
            Maintenance::Maintained { least: factors.least, greatest: factors.greatest }
        }),
        skies: skies.map(far_light).collect(),
    }
}

/// What is infinitely far away with what it brings: of a sky on open ground, of a sun to what faces it.
fn far_light(luminaire: &Luminaire) -> String {
    let lx = match &luminaire.kind {
        LuminaireKind::Sky { sky, .. } => sky.horizontal_lx(),
        LuminaireKind::Directional { illuminance_lx, .. } => *illuminance_lx,
        LuminaireKind::Point { .. } => 0.0,
    };
    let lx = significant(lx * luminaire.colour.luminance(), 3);
    format!("{} ({lx} lx)", name(&luminaire.name))
}

#[cfg_attr(not(feature = "pdf"), expect(clippy::unnecessary_wraps, reason = "PDF may fail"))]
fn bytes(report: &Report, language: Language, is_pdf: bool) -> Result<Vec<u8>, Failure> {
    #[cfg(feature = "pdf")]
    if is_pdf {
        return isolux_report::pdf(report, language).map_err(|e| Failure::Refused(e.to_string()));
    }
    debug_assert!(!is_pdf, "a build without PDF has refused it");
    Ok(isolux_report::html(report, language).into_bytes())
}

/// What `report --json` prints.
#[derive(Serialize)]
struct Told {
    report: String,
    grids: usize,
    requirements: usize,
    /// Of them, those surely met.
    met: usize,
    pictures: usize,
}

impl Told {
    fn of(output: &OutputPath, report: &Report) -> Self {
        let of_areas = report.areas.iter().flat_map(|area| &area.requirements).map(|of| of.verdict);
        let of_emergency = report.emergency.iter().flat_map(|emergency| &emergency.requirements);
        let verdicts: Vec<Verdict> = of_areas.chain(of_emergency.map(|of| of.verdict)).collect();
        Self {
            report: output.path().display().to_string(),
            grids: report.areas.len(),
            requirements: verdicts.len(),
            met: verdicts.iter().filter(|verdict| **verdict == Verdict::Met).count(),
            pictures: report.views.len(),
        }
    }

    fn text(&self) -> String {
        let Self { requirements, met, .. } = self;
        let required = match requirements {
            0 => "none were given".to_owned(),
            all => format!("{met} of {all} met"),
        };
        facts(&[
            ("report", self.report.clone()),
            ("grids", self.grids.to_string()),
            ("requirements", required),
            ("pictures", self.pictures.to_string()),
        ])
    }
}
