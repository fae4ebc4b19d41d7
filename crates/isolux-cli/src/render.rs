//! `isolux render`: a view from a map.

use crate::appearance::ExposureChoice;
use crate::cached_view::{self, CacheUse};
use crate::console::{facts, print, print_json};
use crate::failure::{Failure, Outcome};
use crate::flags::RenderFlags;
use crate::look::Look;
use crate::meter::Meter;
use crate::output::OutputPath;
use crate::quantity::show_share;
use crate::shown::name;
use crate::viewpoint::IsLit;
use crate::{exposed, map_file, source, viewpoint, walk};
use isolux::elements::carries_map;
use isolux::map::IlluminationMap;
use isolux::scene::{Camera, Scene};
use isolux_view::{
    Gathered, LuminanceImage, Picture, Size, SurfacePoint, TraceSettings, ViewProgress, trace,
    trace_map,
};
use serde::Serialize;
use std::path::Path;

/// Runs the subcommand.
pub(crate) fn run(flags: &RenderFlags, json: bool) -> Result<Outcome, Failure> {
    let output = OutputPath::check(&flags.output, "png")?;
    let look = Look::of(&flags.look)?;
    let Some(Seen { view, camera, gathered, cache, look }) = see(flags, look)? else {
        return Ok(Outcome::Interrupted);
    };
    let picture = look.show(&view)?;
    write(&output, &picture)?;
    if let Look::Picture(how) = &look {
        exposed::warn(&view, &picture, how);
    }
    let report = Report {
        picture: output.path().display().to_string(),
        camera: camera.name,
        width: picture.width,
        height: picture.height,
        profile: look.profile().to_owned(),
        indirect: gathered.map(Indirect::of),
        cache,
    };
    if json {
        print_json(&report)?
    } else {
        print(&report.text())?
    }
    Ok(Outcome::Done)
}

/// A view, whose it is, where its indirect light comes from, and what it is shown as.
struct Seen {
    view: LuminanceImage,
    camera: Camera,
    gathered: Option<Gathered>,
    cache: Option<CacheUse>,
    look: Look,
}

/// Looks at a map, or at a scene by its cache; nothing if the user stops that.
fn see(flags: &RenderFlags, look: Look) -> Result<Option<Seen>, Failure> {
    let camera = |scene: &Scene, is_lit: &IsLit<'_>| {
        viewpoint::chosen(scene, flags.camera.as_deref(), &flags.eye, is_lit)
            .map_err(|what| Failure::bad_input(format!("{}: {what}", flags.map.display())))
    };
    if let Some(path) = &flags.cache {
        if flags.look.exposure == ExposureChoice::Map {
            let what = "--exposure map: with --cache no map is read; leave one of the two out";
            return Err(Failure::bad_input(what));
        }
        let scene = scene_of(&flags.map)?;
        if scene.luminous_flux_lm() == 0.0 {
            return Err(source::no_light(&flags.map, &scene));
        }
        let camera = camera(&scene, &|triangle, back, _| carries_map(&scene, triangle, back))?;
        let looked = cached_view::look(&scene, &camera, flags.size, (path, flags.accuracy))?;
        return Ok(looked.map(|(view, used)| Seen {
            view,
            camera,
            gathered: None,
            cache: Some(used),
            look,
        }));
    }
    let (scene, map) = map_file::read(&flags.map)?;
    let camera = camera(&scene, &|triangle, back, [u, v]| {
        let read = map.interpolate(triangle, back, u, v);
        read.is_some_and(|read| read.illuminance_lx() > 0.0)
    })?;
    let (view, gathered) = if flags.interpolated {
        let finer = flags.finer.map(|limit| walk::finer(&scene, &map, limit));
        (bare(&scene, finer.as_ref().unwrap_or(&map), &camera, flags.size)?, None)
    } else {
        let (view, found) = view(&scene, &map, &camera, flags.size)?;
        (view, Some(found))
    };
    let look = match flags.look.exposure {
        ExposureChoice::Map => look.exposed_by(&scene, &map),
        ExposureChoice::Of(_) => look,
    };
    Ok(Some(Seen { view, camera, gathered, cache: None, look }))
}

/// The scene of a map, or of a file of its own.
fn scene_of(path: &Path) -> Result<Scene, Failure> {
    if map_file::is_map(path) {
        map_file::read(path).map(|(scene, _)| scene)
    } else {
        source::read_scene(path)
    }
}

/// Walls of one side only are looked through from outside.
const SETTINGS: TraceSettings = TraceSettings { through_black_backs: true, ..TraceSettings::FINE };

/// Traces a view over a map: direct light evaluated afresh, indirect light gathered where the map is not to be trusted.
pub(crate) fn view(
    scene: &Scene,
    map: &IlluminationMap,
    camera: &Camera,
    (width, height): (u32, u32),
) -> Result<(LuminanceImage, Gathered), Failure> {
    let size = Size::new(width, height).map_err(Failure::bad_input)?;
    let mut lighting = Meter::new("direct light of the view", None);
    let mut gathering = Meter::new("indirect light of the view", None);
    let mut looking = Meter::new("view", None);
    let watch = &mut |progress| match progress {
        ViewProgress::Lighting(share) => lighting.tell(share),
        ViewProgress::Gathering(share) => gathering.tell(share),
        ViewProgress::Looking(share) => looking.tell(share),
    };
    trace_map((scene, map), camera, size, (&SETTINGS, watch)).map_err(Failure::bad_input)
}

/// The same of the bare map, all light interpolated.
pub(crate) fn bare(
    scene: &Scene,
    map: &IlluminationMap,
    camera: &Camera,
    (width, height): (u32, u32),
) -> Result<LuminanceImage, Failure> {
    let size = Size::new(width, height).map_err(Failure::bad_input)?;
    let read = |at: SurfacePoint| map.interpolate(at.triangle, at.back, at.u, at.v);
    trace(scene, camera, size, &SETTINGS, &read).map_err(Failure::bad_input)
}

/// Writes a picture.
pub(crate) fn write(output: &OutputPath, picture: &Picture) -> Result<(), Failure> {
    let Picture { width, height, rgb, icc } = picture;
    let bytes = isolux_formats::png::encode_profiled(*width, *height, rgb, icc.as_deref())
        .map_err(|e| Failure::Refused(format!("{}: {e}", output.path().display())))?;
    output.write(&bytes)
}

/// What `render --json` prints.
#[derive(Serialize)]
struct Report {
    picture: String,
    camera: String,
    width: u32,
    height: u32,
    profile: String,
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    indirect: Option<Indirect>,
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    cache: Option<CacheUse>,
}

/// Where the indirect light of a view from a map comes from, by places of surfaces.
#[derive(Serialize)]
struct Indirect {
    places_interpolated: usize,
    places_gathered: usize,
    places_continued: usize,
}

impl Indirect {
    fn of(found: Gathered) -> Self {
        let Gathered { interpolated, gathered, continued } = found;
        Self {
            places_interpolated: interpolated,
            places_gathered: gathered,
            places_continued: continued,
        }
    }

    /// For people.
    fn fact(&self) -> (&'static str, String) {
        let all = self.places_interpolated + self.places_gathered + self.places_continued;
        let share = |part: usize| show_share(part as f64 / all.max(1) as f64);
        let text = format!(
            "interpolated in {} of what is seen, gathered in {}, continued from that in {}",
            share(self.places_interpolated),
            share(self.places_gathered),
            share(self.places_continued)
        );
        ("indirect light", text)
    }
}

impl Report {
    fn text(&self) -> String {
        let mut lines = vec![
            ("picture", self.picture.clone()),
            ("camera", name(&self.camera)),
            ("size", format!("{} x {}", self.width, self.height)),
            ("profile", name(&self.profile)),
        ];
        lines.extend(self.indirect.iter().map(Indirect::fact));
        lines.extend(self.cache.iter().flat_map(CacheUse::facts));
        facts(&lines)
    }
}
