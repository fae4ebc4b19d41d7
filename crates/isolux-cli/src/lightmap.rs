//! Lightmaps: planned before the work, baked from a map, reported on.

use crate::clock::Clock;
use crate::console::facts;
use crate::failure::Failure;
use crate::flags::{LayoutFlags, LayoutName, ProgressStyle};
use crate::interrupt::Interrupt;
use crate::lightmap_files::{self, Made};
use crate::meter::Meter;
use crate::notes::{Note, note};
use crate::output::OutputPath;
use crate::quantity::{show_bytes, show_count, show_seconds, show_share, significant};
use crate::source;
use isolux::lightmap::{
    BYTES_PER_TEXEL, Cover, Jump, Layout, Lightmap, LightmapError, LightmapSettings, OwnPlaces,
    Pace, SeamReport, UvUnwrap, bake, dark_share, lit_area_m2, plan_without,
};
use isolux::map::IlluminationMap;
use isolux::scene::Scene;
use isolux_formats::lightmap::{Convention, Target};
use serde::Serialize;
use std::collections::HashSet;
use std::time::{Duration, Instant};

/// What texels take to bake on one thread, s, rooms of every kind and 16 to 64 texels a metre taken together: 0.4 to 0.95 ms were
/// measured where details and contacts are many; empty rooms take less.
const A_TEXEL_S: f64 = 3e-4;
/// Of the area with texels, the share of dark surfaces that is told of.
const MOSTLY_DARK: f64 = 0.75;
/// The same of those read coarsely.
const A_COARSE_TEXEL_S: f64 = 1e-5;
/// It may as well be so many times less or more.
const GIVE_OR_TAKE: f64 = 5.0;

/// A lightmap that fits into memory and whose files can be written.
pub(crate) struct Planned {
    layout: Layout,
}

/// A lightmap and how long it took.
pub(crate) struct Baked {
    /// The lightmap.
    pub lightmap: Lightmap,
    /// Whether the map held it already.
    is_held: bool,
    time_s: f64,
}

impl Planned {
    /// Before a scene is solved: nothing where the layout asked for is another.
    pub(crate) fn ahead(
        flags: &LayoutFlags,
        scene: &Scene,
        (output, max_memory_bytes): (&OutputPath, u64),
    ) -> Result<Option<Self>, Failure> {
        if flags.layout == LayoutName::Texels {
            OutputPath::check(&output.path().with_extension("exr"), "exr")?;
        }
        Self::asked(flags, scene, max_memory_bytes)
    }

    /// The same where nothing is to be written.
    pub(crate) fn asked(
        flags: &LayoutFlags,
        scene: &Scene,
        max_memory_bytes: u64,
    ) -> Result<Option<Self>, Failure> {
        match (flags.layout, flags.texels_per_meter) {
            (LayoutName::Texels, _) => {
                Self::new(flags, scene, max_memory_bytes, &HashSet::new()).map(Some)
            }
            (LayoutName::Vertices, None) => Ok(None),
            (LayoutName::Vertices, Some(_)) => Err(Failure::bad_input(
                "--texels-per-meter is only for --layout texels; add it, or leave the density out",
            )),
        }
    }

    /// What it will be, and what so many like it take.
    pub(crate) fn sizes(&self, scene: &Scene, count: usize) -> Sizes {
        let Layout { width, height, pages, charts, texels_per_m, least_texels_per_m, .. } =
            self.layout;
        let time_s = count as f64 * self.foreseen_s(scene);
        Sizes {
            width,
            height,
            pages,
            charts,
            texels_per_meter: texels_per_m,
            least_texels_per_meter: least_texels_per_m,
            texels: self.layout.texel_count() as u64,
            texels_of_surfaces: self.texels_of_surfaces(scene).round() as u64,
            memory_bytes: self.layout.texel_count() as u64 * BYTES_PER_TEXEL,
            time_s,
            time_earliest_s: time_s / GIVE_OR_TAKE,
            time_latest_s: time_s * GIVE_OR_TAKE,
        }
    }

    /// Lays out all surfaces but dark ones and says what comes.
    pub(crate) fn new(
        flags: &LayoutFlags,
        scene: &Scene,
        max_memory_bytes: u64,
        dark: &HashSet<(u32, bool)>,
    ) -> Result<Self, Failure> {
        let settings = LightmapSettings {
            texels_per_m: flags.texels_per_meter,
            max_memory_bytes,
            ..LightmapSettings::default()
        };
        let layout = plan_without(scene, &settings, &UvUnwrap, dark).map_err(failure)?;
        note(
            Note::Info,
            format!(
                "lightmap: {} of {} x {} texels, {} a metre, {} charts, up to {} of memory",
                pages(layout.pages),
                layout.width,
                layout.height,
                significant(layout.texels_per_m, 3),
                layout.charts,
                show_bytes(layout.texel_count() as u64 * BYTES_PER_TEXEL)
            ),
        );
        if layout.is_short() {
            let text = format!(
                "lightmap: charts have as few as {} texels a metre in place of {}, as they are longer than a page; \
                 fewer --texels-per-meter, or surfaces in shorter pieces, are alike all over",
                significant(layout.least_texels_per_m, 3),
                significant(layout.asked_texels_per_m, 3)
            );
            note(Note::Warning, text);
        }
        match &layout.own_places {
            OwnPlaces::None => {}
            OwnPlaces::Kept => {
                note(Note::Info, "lightmap: uses the lightmap coordinates of the file")
            }
            OwnPlaces::Refused(why) => {
                note(Note::Warning, format!("{why}; all surfaces are laid out anew"))
            }
        }
        Ok(Self { layout })
    }

    /// What baking may take, s: a rough guess, as it depends on how much of the light is to be gathered.
    pub(crate) fn foreseen_s(&self, scene: &Scene) -> f64 {
        self.texels_of_surfaces(scene) * A_TEXEL_S / rayon::current_num_threads() as f64
    }

    /// What solving may take if so many lightmaps like this are to be baked before the time is up.
    pub(crate) fn time_to_solve(
        &self,
        scene: &Scene,
        clock: Clock,
        count: usize,
    ) -> Option<Duration> {
        let foreseen_s = count as f64 * self.foreseen_s(scene);
        let limit = clock.for_solving(foreseen_s)?;
        let text = format!(
            "lightmap: of the time limit {} are for solving, the rest is kept for texels",
            show_seconds(limit.as_secs_f64())
        );
        note(Note::Info, text);
        Some(limit)
    }

    fn texels_of_surfaces(&self, scene: &Scene) -> f64 {
        lit_area_m2(scene) * self.layout.texels_per_m * self.layout.texels_per_m
    }

    /// Says where most texels lie on surfaces that no light comes to: the others are few then.
    fn tell_of_dark(&self, scene: &Scene, map: &IlluminationMap) {
        let share = dark_share(scene, map, &self.layout);
        if share > MOSTLY_DARK {
            let text = format!(
                "lightmap: only {} of the surface with texels has light, and gets no more than {} texels a metre; \
                 `export --without-dark` leaves the dark out",
                show_share(1.0 - share),
                significant(self.layout.texels_per_m, 3)
            );
            note(Note::Warning, text);
        }
    }

    /// Reads the map over all texels, coarsely once the time is up; nothing if interrupted.
    pub(crate) fn bake(
        &self,
        (scene, map): (&Scene, &IlluminationMap),
        (clock, progress): (Clock, Option<ProgressStyle>),
    ) -> Result<Option<Baked>, Failure> {
        let interrupt = Interrupt::install()?;
        self.tell_of_dark(scene, map);
        let started = Instant::now();
        let a_thread = rayon::current_num_threads() as f64;
        let whole = clock.ahead_by(self.texels_of_surfaces(scene) * A_COARSE_TEXEL_S / a_thread);
        let mut meter = Meter::new("lightmap", progress);
        let baked = bake(scene, map, &self.layout, &mut |share| {
            meter.tell(share);
            match () {
                () if interrupt.is_requested() => Pace::Stop,
                () if clock.is_up() => Pace::Late,
                () if whole.is_up() => Pace::Coarse,
                () => Pace::Whole,
            }
        });
        drop(meter);
        match baked {
            Ok(lightmap) => {
                let time_s = started.elapsed().as_secs_f64();
                if lightmap.count(Cover::Known) == 0 {
                    let text =
                        "lightmap: no texel is known, as the map knows nothing of any surface";
                    note(Note::Warning, text);
                }
                Ok(Some(Baked { lightmap, is_held: false, time_s }))
            }
            Err(LightmapError::Stopped) => Ok(None),
            Err(other) => Err(failure(other)),
        }
    }
}

impl Baked {
    /// What a map holds, if it is what baking anew would give: of the density asked for, if any, by this version, none of
    /// it coarse.
    pub(crate) fn held(
        flags: &LayoutFlags,
        map: &IlluminationMap,
        lightmap: Option<Lightmap>,
    ) -> Option<Self> {
        let lightmap = lightmap.filter(|held| {
            let asked = held.layout.asked_texels_per_m;
            held.coarse == 0
                && flags.texels_per_meter.is_none_or(|density| density == asked)
                && map.provenance.version == env!("CARGO_PKG_VERSION")
        })?;
        note(Note::Info, "lightmap: its texels are in the map already");
        Some(Self { lightmap, is_held: true, time_s: 0.0 })
    }

    /// Whether some of it was read coarsely, as the time was up.
    pub(crate) fn is_coarse(&self) -> bool {
        self.lightmap.coarse > 0
    }

    /// Writes the `.glb` and what belongs beside it.
    pub(crate) fn write(
        &self,
        scene: &Scene,
        map: &IlluminationMap,
        (output, target, made): (&OutputPath, Target, Made<'_>),
    ) -> Result<Report, Failure> {
        let files = lightmap_files::glb(&self.lightmap, (scene, map), (output, target, made))?;
        self.tell_of_coarse(output);
        tell_of_older(output, &files);
        Ok(self.report(target, files))
    }

    fn tell_of_coarse(&self, output: &OutputPath) {
        let (coarse, known) = (self.lightmap.coarse, self.lightmap.count(Cover::Known));
        if coarse == 0 {
            return;
        }
        let map = output.path().display();
        let text = format!(
            "{map}: {coarse} of {known} texels are read coarsely, as the time was up: indirect light as the map interpolates it, or \
             no more than a few shadow rays, which their standard errors show; the same command with --resume and more time, or \
             `isolux export {map} --layout texels -o FILE.glb`, reads them all in full"
        );
        note(Note::Warning, text);
    }

    /// What was made, in which files.
    pub(crate) fn report(&self, target: Target, files: Vec<String>) -> Report {
        let map = &self.lightmap;
        let Layout { width, height, pages, charts, texels_per_m, least_texels_per_m, .. } =
            map.layout;
        Report {
            target: target.name(),
            convention: target.convention(),
            files,
            width,
            height,
            pages,
            charts,
            texels_per_meter: texels_per_m,
            least_texels_per_meter: least_texels_per_m,
            texels_known: map.count(Cover::Known),
            texels_unknown: map.count(Cover::Unknown),
            texels_filled: map.count(Cover::Filled),
            sides_without_texels: map.layout.sides.iter().filter(|side| side.is_point()).count(),
            texels_coarse: map.coarse,
            readings: map.readings,
            taken_from_map: self.is_held,
            time_s: self.time_s,
            seams: Seams::of(&map.seams),
        }
    }
}

/// Says that a map was interrupted before its texels.
pub(crate) fn tell_of_missing(output: &OutputPath) {
    let map = output.path().display();
    let text = format!(
        "{map}: its light is at vertices alone, the texels are not baked; the same command with --resume goes on, `isolux \
         export {map} --layout texels -o FILE.glb` bakes them of what there is"
    );
    note(Note::Warning, text);
    tell_of_older(output, &[]);
}

/// Says which lightmaps beside a map are not of it: whoever takes them takes old light.
pub(crate) fn tell_of_older(output: &OutputPath, written: &[String]) {
    let older = lightmap_files::older(output.path(), written);
    if !older.is_empty() {
        let text = format!(
            "{}: {} an earlier bake, whose light is not that of {}; remove what is not needed",
            older.join(", "),
            if older.len() == 1 { "is of" } else { "are of" },
            output.path().display()
        );
        note(Note::Warning, text);
    }
}

/// Sorted by who can mend it.
fn failure(error: LightmapError) -> Failure {
    match error {
        LightmapError::Memory { needed, allowed } => Failure::Refused(format!(
            "the lightmap needs about {}, more than the {} of --max-memory; ask for fewer \
             --texels-per-meter, leave out what is dark (`export --without-dark`), or raise it",
            show_bytes(needed),
            show_bytes(allowed)
        )),
        LightmapError::NothingLit => {
            let (what, remedy) = source::NO_MAP;
            Failure::bad_input(format!("{what}; {remedy}"))
        }
        LightmapError::Sparse(_) => {
            Failure::bad_input(format!("{error}; ask for more --texels-per-meter"))
        }
        other => Failure::bad_input(format!("{other}; try other --texels-per-meter")),
    }
}

fn pages(count: u32) -> String {
    if count == 1 { "one page".to_owned() } else { format!("{count} pages") }
}

/// What `solve --dry-run` says of a lightmap.
#[derive(Serialize)]
pub(crate) struct Sizes {
    width: u32,
    height: u32,
    pages: u32,
    charts: u32,
    texels_per_meter: f64,
    least_texels_per_meter: f64,
    texels: u64,
    texels_of_surfaces: u64,
    memory_bytes: u64,
    /// Of baking, on top of the time to solve.
    time_s: f64,
    time_earliest_s: f64,
    time_latest_s: f64,
}

impl Sizes {
    /// What baking takes, for people.
    pub(crate) fn time_text(&self) -> String {
        format!(
            "rough guess {} ({} to {}), on top of the time to solve",
            show_seconds(self.time_s),
            show_seconds(self.time_earliest_s),
            show_seconds(self.time_latest_s)
        )
    }

    /// For people.
    pub(crate) fn text(&self) -> String {
        format!(
            "{} of {} x {} texels, about {} of them on surfaces, {} a metre, about {}",
            pages(self.pages),
            self.width,
            self.height,
            self.texels_of_surfaces,
            significant(self.texels_per_meter, 3),
            show_bytes(self.memory_bytes)
        )
    }
}

/// What `--json` says of a lightmap.
#[derive(Serialize)]
pub(crate) struct Report {
    target: &'static str,
    convention: Convention,
    files: Vec<String>,
    width: u32,
    height: u32,
    pages: u32,
    charts: u32,
    texels_per_meter: f64,
    least_texels_per_meter: f64,
    texels_known: usize,
    texels_unknown: usize,
    texels_filled: usize,
    /// Dark ones, and triangles too thin to be laid out.
    sides_without_texels: usize,
    /// Of those known, read in a cheaper way as the time was up.
    texels_coarse: u64,
    readings: u64,
    /// Rather than baked.
    taken_from_map: bool,
    time_s: f64,
    seams: Seams,
}

#[derive(Serialize)]
struct Seams {
    edges: usize,
    t_junctions: usize,
    length_m: f64,
    before: JumpReport,
    after: JumpReport,
    largest_change_lx: f64,
    rms_change_standard_errors: f64,
    stopped_at_two_standard_errors: f64,
}

#[derive(Serialize)]
struct JumpReport {
    largest_lx: f64,
    largest_share: f64,
    place: Option<[f64; 3]>,
    rms_lx: f64,
}

impl Seams {
    fn of(seams: &SeamReport) -> Self {
        let jump = |j: &Jump| JumpReport {
            largest_lx: j.largest_lx,
            largest_share: j.largest_share,
            place: j.place.map(<[f64; 3]>::from),
            rms_lx: j.rms_lx,
        };
        Self {
            edges: seams.edges,
            t_junctions: seams.t_junctions,
            // A sum of nothing is -0.
            length_m: seams.length_m + 0.0,
            before: jump(&seams.before),
            after: jump(&seams.after),
            largest_change_lx: seams.largest_change_lx,
            rms_change_standard_errors: seams.rms_change_errors,
            stopped_at_two_standard_errors: seams.stopped,
        }
    }
}

impl Report {
    fn texels_text(&self) -> String {
        let coarse = match self.texels_coarse {
            0 => String::new(),
            count => format!(", {count} of them read coarsely"),
        };
        let Self { texels_known, texels_unknown, texels_filled, .. } = self;
        format!(
            "{texels_known} known{coarse}, {texels_unknown} unknown, {texels_filled} filled beside charts"
        )
    }

    /// For people.
    pub(crate) fn text(&self) -> String {
        let jump = |j: &JumpReport| {
            format!(
                "{} lx, {} there; rms {} lx",
                significant(j.largest_lx, 3),
                show_share(j.largest_share),
                significant(j.rms_lx, 3)
            )
        };
        let [mean, least] = [self.texels_per_meter, self.least_texels_per_meter]
            .map(|density| significant(density, 3));
        let is_even = self.least_texels_per_meter >= self.texels_per_meter || mean == least;
        let least = if is_even { String::new() } else { format!(" in the mean, {least} at least") };
        let Convention { quantity, unit, formula, setting, .. } = self.convention;
        let mut all = vec![
            ("lightmap", self.files.join(", ")),
            ("  holds", format!("{quantity}, in {unit}; {formula}")),
            (
                "  size",
                format!(
                    "{} of {} x {}, {} texels a metre{least}, {} charts",
                    pages(self.pages),
                    self.width,
                    self.height,
                    mean,
                    self.charts
                ),
            ),
            ("  texels", self.texels_text()),
            ("  readings", show_count(self.readings as f64)),
            ("  time", show_seconds(self.time_s)),
        ];
        if !setting.is_empty() {
            all.insert(2, ("  set", format!("{}: {setting}", self.target)));
        }
        if self.sides_without_texels > 0 {
            let count = self.sides_without_texels;
            all.push(("  without texels", format!("{count} sides of triangles, dark or too thin")));
        }
        if self.seams.edges > 0 {
            all.push((
                "  seams",
                format!(
                    "{} edges, {} m, {} at T-junctions",
                    self.seams.edges,
                    significant(self.seams.length_m, 3),
                    self.seams.t_junctions
                ),
            ));
            all.push(("    largest jump before", jump(&self.seams.before)));
            all.push(("    and after stitching", jump(&self.seams.after)));
        }
        facts(&all)
    }
}
