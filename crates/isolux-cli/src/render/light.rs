//! Where the light of views comes from: a map, a scene that is solved first, or a cache of samples.

use super::refined::{self, NoiseReport, Refined, Show, Wish};
use crate::appearance::ExposureChoice;
use crate::cached_view::{self, CacheUse};
use crate::failure::{Failure, Outcome};
use crate::flags::RenderFlags;
use crate::notes::{Note, note};
use crate::quantity::show_share;
use crate::traced::{Watched, bare};
use crate::viewpoint::{self, NamedView};
use crate::{map_file, solving, source, walk};
use isolux::elements::carries_map;
use isolux::engine::SolveRequest;
use isolux::map::IlluminationMap;
use isolux::scene::Scene;
use isolux_view::{Gathered, LuminanceImage, Size, View};
use std::path::{Path, PathBuf};

/// The error that a scene is solved to for a view.
const DRAFT: f64 = 0.05;
/// How good a map the samples of a cache would make.
const CACHE_ACCURACY: f64 = 0.01;

/// A scene, before its light is computed.
pub(super) struct Opened {
    pub(super) scene: Scene,
    /// What light there is already; a scene alone is solved.
    light: Option<Light>,
}

/// A scene and what is known of its light.
pub(super) struct Lit {
    pub(super) scene: Scene,
    light: Light,
}

enum Light {
    /// Direct light is evaluated afresh.
    Map(Box<IlluminationMap>),
    /// All is interpolated.
    Bare(Box<IlluminationMap>),
    Cache {
        path: PathBuf,
        accuracy: f64,
    },
}

/// A view, and where its indirect light comes from.
pub(super) struct Seen {
    pub(super) view: LuminanceImage,
    pub(super) gathered: Option<Gathered>,
    pub(super) cache: Option<CacheUse>,
    pub(super) noise: Option<NoiseReport>,
    /// Whether the user stopped it before it was as good as wished.
    pub(super) interrupted: bool,
}

impl Opened {
    /// Reads a map or a scene, and computes nothing.
    pub(super) fn of(flags: &RenderFlags) -> Result<Self, Failure> {
        let from = &flags.map;
        if let Some(path) = &flags.cache {
            return by_cache(flags, path);
        }
        if is_scene(from) {
            return Ok(Self { scene: source::read_scene(from)?, light: None });
        }
        if flags.accuracy.is_some() {
            return Err(Failure::bad_input(format!(
                "--accuracy: {} is a map, solved before; it belongs to a scene or to --cache; leave it out",
                from.display()
            )));
        }
        let (scene, map) = map_file::read(from)?;
        Ok(Self { scene, light: Some(Light::Map(Box::new(map))) })
    }

    /// Solves what is not solved yet; nothing if the user stops that.
    pub(super) fn lit(self, flags: &RenderFlags) -> Result<Option<Lit>, Failure> {
        let Self { scene, light } = self;
        let light = match light {
            Some(light) => light,
            None => {
                let accuracy = flags.accuracy.unwrap_or(DRAFT);
                match solved((&flags.map, &flags.further), &scene, accuracy)? {
                    Some(map) => Light::Map(Box::new(map)),
                    None => return Ok(None),
                }
            }
        };
        let light = match (light, flags.interpolated, flags.finer) {
            (Light::Map(map), true, None) => Light::Bare(map),
            (Light::Map(map), true, Some(limit)) => {
                Light::Bare(Box::new(walk::finer(&scene, &map, limit)))
            }
            (light, ..) => light,
        };
        Ok(Some(Lit { scene, light }))
    }
}

impl Lit {
    /// The map, unless there is none.
    pub(super) fn map(&self) -> Option<&IlluminationMap> {
        match &self.light {
            Light::Map(map) | Light::Bare(map) => Some(map),
            Light::Cache { .. } => None,
        }
    }

    /// The view of our own, where no camera is asked for and the scene has none.
    pub(super) fn own_view(&self, flags: &RenderFlags) -> NamedView {
        let is_lit = |triangle, back, [u, v]: [f64; 2]| match self.map() {
            Some(map) => {
                let read = map.interpolate(triangle, back, u, v);
                read.is_some_and(|read| read.illuminance_lx() > 0.0)
            }
            None => carries_map(&self.scene, triangle, back),
        };
        viewpoint::own(&self.scene, &flags.eye, &is_lit)
    }

    /// Looks; nothing if the user stops that. Pictures that will get better are shown meanwhile.
    pub(super) fn see(
        &self,
        from: View,
        size: (u32, u32),
        (wish, show): (&Wish<'_>, &mut Show<'_>),
    ) -> Result<Option<Seen>, Failure> {
        let scene = &self.scene;
        let plain =
            |view| Seen { view, gathered: None, cache: None, noise: None, interrupted: false };
        match &self.light {
            Light::Map(map) => {
                let size = Size::new(size.0, size.1).map_err(Failure::bad_input)?;
                let watched = Watched::new(scene, map);
                let refined = refined::look(&watched, (from, size), wish, show)?;
                let Refined { view, gathered, noise, interrupted } = refined;
                let (gathered, noise) = (Some(gathered), Some(noise));
                Ok(Some(Seen { gathered, noise, interrupted, ..plain(view) }))
            }
            Light::Bare(map) => Ok(Some(plain(bare(scene, map, from, size)?))),
            Light::Cache { path, accuracy } => {
                let looked = cached_view::look(scene, from, size, (path, *accuracy))?;
                Ok(looked.map(|(view, used)| Seen { cache: Some(used), ..plain(view) }))
            }
        }
    }
}

/// Whether this is a scene to be solved first, and not a map.
fn is_scene(path: &Path) -> bool {
    source::is_builtin(path)
        || source::is_handed_in(path)
        || path.exists() && !map_file::is_map(path)
}

fn by_cache(flags: &RenderFlags, path: &Path) -> Result<Opened, Failure> {
    if flags.look.exposure == ExposureChoice::Map {
        let what = "--exposure map: with --cache no map is read; leave one of the two out";
        return Err(Failure::bad_input(what));
    }
    let from = &flags.map;
    let scene = match map_file::is_map(from) {
        true => map_file::read(from)?.0,
        false => source::read_scene(from)?,
    };
    if scene.luminous_flux_lm() == 0.0 {
        return Err(source::no_light(from, &scene));
    }
    let accuracy = flags.accuracy.unwrap_or(CACHE_ACCURACY);
    Ok(Opened { scene, light: Some(Light::Cache { path: path.to_owned(), accuracy }) })
}

/// The map of a scene, in memory alone; nothing if the user stops the run.
fn solved(
    (path, further): (&Path, &[PathBuf]),
    scene: &Scene,
    accuracy: f64,
) -> Result<Option<IlluminationMap>, Failure> {
    let further: String = further.iter().map(|file| format!(" {}", file.display())).collect();
    let place = path.display();
    note(
        Note::Info,
        format!(
            "{place} is a scene: it is solved to {} first, and the map is not kept; \
             `isolux solve {place}{further} -o map.glb` keeps one for more views",
            show_share(accuracy)
        ),
    );
    let request = SolveRequest { accuracy: Some(accuracy), ..SolveRequest::default() };
    let solved = solving::solve_here((scene, path), &request)?;
    if solved.outcome == Outcome::Interrupted {
        return Ok(None);
    }
    Ok(Some(solved.solution.map))
}
