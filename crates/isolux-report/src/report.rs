//! What a report is of: plain values, without words of a language.

use isolux::map::{EnergyBalance, Figure, GridFigures, Provenance, Verdict};
use isolux::scene::Condition;
use serde::Serialize;

/// All of it.
#[derive(Clone, Debug)]
pub struct Report {
    /// Who it is for and by.
    pub project: Project,
    /// The scene.
    pub scene: Scene,
    /// Calculation grids, with what is required of them.
    pub areas: Vec<Area>,
    /// Emergency lighting, where grids are areas of it.
    pub emergency: Option<Emergency>,
    /// Types of luminaires.
    pub luminaires: Vec<Luminaire>,
    /// A year of daylight, where one was asked for.
    pub daylight: Option<Daylight>,
    /// Observers.
    pub glare: Vec<Glare>,
    /// Pictures.
    pub views: Vec<View>,
    /// Materials, the largest surface first.
    pub surfaces: Vec<Surface>,
    /// How the map was computed and how good it is; `None` where there is none.
    pub provenance: Option<Provenance>,
    /// The mean illuminance that relative errors are shares of, lx.
    pub reference_lx: f64,
    /// Where the light goes, where that is known.
    pub energy: Option<EnergyBalance>,
    /// What an audit of the scene has found.
    pub findings: Vec<Finding>,
    /// Name and version of the software.
    pub software: String,
}

/// What the cover says.
#[derive(Clone, Debug, Default)]
pub struct Project {
    /// The title.
    pub title: String,
    /// Who it is made for.
    pub client: Option<String>,
    /// Who has made it.
    pub author: Option<String>,
    /// The day, as it is to be read.
    pub date: Option<String>,
    /// Free remarks.
    pub remarks: Option<String>,
}

/// The scene in figures.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Its name.
    pub name: String,
    /// Lengths along its axes, the vertical one last, m.
    pub size_m: [f64; 3],
    /// The area of its surfaces, m2.
    pub surface_m2: f64,
    /// Their mean diffuse reflectance.
    pub mean_reflectance: f64,
    /// The flux of all luminaires, lm; `None` where light comes from infinitely far away alone.
    pub flux_lm: Option<f64>,
    /// Factors that the light of luminaires contains.
    pub maintenance: Maintenance,
    /// The sky and the sun, where there are any: their names.
    pub skies: Vec<String>,
}

/// What the light of luminaires contains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Maintenance {
    /// No factor: luminaires are new.
    Initial,
    /// The least and the greatest factor; a greatest one of 1 means that some luminaires have none.
    Maintained {
        /// The least factor.
        least: f64,
        /// The greatest.
        greatest: f64,
    },
}

/// A calculation grid.
#[derive(Clone, Debug)]
pub struct Area {
    /// Its name.
    pub name: String,
    /// Its plan.
    pub plan: Option<Image>,
    /// Numbers of points along its sides.
    pub counts: [u32; 2],
    /// Lengths of its sides without the border, m.
    pub sides_m: [f64; 2],
    /// The border left out, m.
    pub border_m: f64,
    /// The height of its points; `None` of grids that are not level, m.
    pub height_m: Option<f64>,
    /// The maintenance factor of its values.
    pub maintenance_factor: f64,
    /// Its figures; `None` where nothing is known.
    pub figures: Option<GridFigures>,
    /// Maintained illuminance at its points, along the first side first; `None` where it is not known, lx.
    pub values_lx: Vec<Option<f64>>,
    /// The middle standard error of the points, lx.
    pub error_lx: f64,
    /// Points outside of the room, left out.
    pub outside: usize,
    /// What has to hold on it.
    pub requirements: Vec<Requirement>,
    /// What its mean may be off by, where inputs are uncertain.
    pub budget: Option<Budget>,
}

/// What the mean of a grid may be off by, at 95 %, in the manner of the GUM (JCGM 100).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Budget {
    /// The grid.
    pub grid: String,
    /// The mean with the interval of its calculation, lx.
    pub mean_lx: Figure,
    /// The mean with all inputs, lx.
    pub with_inputs_lx: Figure,
    /// Its lines.
    pub lines: Vec<BudgetLine>,
}

/// A line of a budget.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BudgetLine {
    /// Where it comes from.
    pub source: UncertainInput,
    /// What the input may be off by, relative; `None` of the calculation.
    pub input: Option<f64>,
    /// What the mean may be off by for it, lx.
    pub half_lx: f64,
    /// Its share of the variance.
    pub share: f64,
}

/// Where an uncertainty comes from.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case", tag = "kind", content = "name")]
pub enum UncertainInput {
    /// The calculation.
    Calculation,
    /// Luminous flux, of a group if it has a name.
    Flux(Option<String>),
    /// The maintenance factor.
    Maintenance,
    /// The reflectance of a material.
    Reflectance(String),
    /// Those of all other materials, each for itself.
    OtherReflectances,
}

/// Something that has to hold, and what came of it.
#[derive(Clone, Debug)]
pub struct Requirement {
    /// What it limits, and how.
    pub condition: Condition,
    /// The place in a standard that it follows from.
    pub source: Option<String>,
    /// What was found.
    pub figure: Figure,
    /// Whether it holds at 95 %.
    pub verdict: Verdict,
    /// The probability that it holds.
    pub probability: f64,
}

/// Emergency lighting by EN 1838.
#[derive(Clone, Debug)]
pub struct Emergency {
    /// Luminaires that are part of it.
    pub luminaires: usize,
    /// What has to hold on its areas.
    pub requirements: Vec<EmergencyRequirement>,
}

/// Something that has to hold of emergency lighting, and what came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct EmergencyRequirement {
    /// The grid.
    pub area: String,
    /// What is limited.
    pub criterion: EmergencyCriterion,
    /// The limit, lx or a ratio.
    pub bound: f64,
    /// What was found.
    pub figure: Figure,
    /// Whether it holds at 95 %.
    pub verdict: Verdict,
}

/// What is limited of emergency lighting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EmergencyCriterion {
    /// Least illuminance on the centre line of an escape route, lx.
    CentreLine,
    /// Least illuminance in the middle half of an escape route, lx.
    MiddleHalf,
    /// Greatest over least illuminance on the centre line.
    CentreLineSpread,
    /// Least illuminance of an open area without its outer half metre, lx.
    OpenArea,
    /// Greatest over least illuminance there.
    OpenAreaSpread,
    /// Mean illuminance where something dangerous is to be ended, lx.
    HighRiskMean,
    /// Uniformity there.
    HighRiskUniformity,
}

/// Luminaires of one type.
#[derive(Clone, Debug)]
pub struct Luminaire {
    /// What it is called.
    pub name: String,
    /// Who makes it, where that is known.
    pub manufacturer: Option<String>,
    /// Where each stands, m.
    pub positions_m: Vec<[f64; 3]>,
    /// The flux of one, lm.
    pub flux_lm: f64,
    /// The power of one, where it is known, W.
    pub power_w: Option<f64>,
    /// What light leaves from.
    pub body: LuminousBody,
    /// Its luminous intensity, drawn.
    pub diagram: Option<Image>,
}

/// What light leaves from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LuminousBody {
    /// A point.
    Point,
    /// An area of this size, m2.
    Area(f64),
    /// Surfaces of this size and luminance, m2 and cd/m2.
    Surface(f64, f64),
}

/// A year of daylight.
#[derive(Clone, Debug)]
pub struct Daylight {
    /// The place of the weather file.
    pub place: String,
    /// Hours of use of every day, from and to.
    pub hours: [u32; 2],
    /// Reflectance of the ground.
    pub ground_reflectance: f64,
    /// Paths from every point.
    pub paths: u32,
    /// Grids.
    pub areas: Vec<DaylightArea>,
}

/// The year of a grid; shares are fractions.
#[derive(Clone, Debug)]
pub struct DaylightArea {
    /// Its name.
    pub name: String,
    /// Its plan: daylight factors in per cent.
    pub plan: Option<Image>,
    /// Daylight factor: mean.
    pub factor_mean: Figure,
    /// Its part straight from the sky.
    pub sky_component: Figure,
    /// Daylight factor that half of the points exceed.
    pub factor_median: Figure,
    /// Daylight factor that 95 % of the points exceed.
    pub factor_95: Figure,
    /// Illuminance in half of the hours of daylight, of half of the points and of 95 %, lx.
    pub target_lx: [Figure; 2],
    /// Levels of EN 17037: minimum, medium, high.
    pub en_17037: [Verdict; 3],
    /// Mean share of the hours of use with 300 lx.
    pub autonomy: Figure,
    /// Share of points with 300 lx in half of the hours of use.
    pub spatial_autonomy: Figure,
    /// Whether that is 55 % and 75 %.
    pub spatial_autonomy_reaches: [Verdict; 2],
    /// Share of points with more than 1000 lx of direct sun in more than 250 hours.
    pub sunlight_exposure: f64,
    /// Whether that is at most 10 %.
    pub sunlight_acceptable: Verdict,
    /// Mean shares of the hours of use below 100 lx, to 300, to 3000, and above.
    pub useful: [Figure; 4],
}

/// What observers see.
#[derive(Clone, Debug)]
pub struct Glare {
    /// Who looks.
    pub observer: Observer,
    /// The unified glare rating; `None` without a source in view.
    pub rating: Option<Figure>,
    /// Luminance of the background, cd/m2.
    pub background_cd_m2: f64,
}

/// Who looks, from where, and which way.
#[derive(Clone, Debug)]
pub struct Observer {
    /// The name.
    pub name: String,
    /// The place of the eye, m.
    pub position_m: [f64; 3],
    /// The direction of view.
    pub direction: [f64; 3],
}

/// A camera's picture.
#[derive(Clone, Debug)]
pub struct View {
    /// The camera's name.
    pub name: String,
    /// As an eye sees it.
    pub picture: Image,
    /// Illuminance in false colour.
    pub chart: Option<Image>,
}

/// A material and the surfaces that have it.
#[derive(Clone, Debug)]
pub struct Surface {
    /// The material.
    pub name: String,
    /// Its area, m2.
    pub area_m2: f64,
    /// Diffuse reflectance, weighted by the eye; `None` of glass.
    pub reflectance: Option<f64>,
    /// Specular reflectance at normal incidence.
    pub specular: f64,
}

/// What an audit of the scene has found, in English.
#[derive(Clone, Debug)]
pub struct Finding {
    /// How much it matters.
    pub severity: Severity,
    /// A sentence.
    pub text: String,
}

/// How much a finding matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// Results may be wrong.
    Warning,
    /// Good to know.
    Note,
}

/// A picture or a drawing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Image {
    /// A drawing.
    Svg(String),
    /// A picture.
    Png(Vec<u8>),
}

/// A file that a document names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Attachment {
    /// Its name.
    pub name: String,
    /// What is in it.
    pub bytes: Vec<u8>,
}
