//! What is under the pointer: as `probe` reads it.

use isolux::engine::{MapReader, ProbePoint};
use isolux::geometry::{Hit, Normal, Point, Ray, Vector};
use isolux::map::{Illuminance, IlluminationMap};
use isolux::scene::{Body, Finish, Scene};
use isolux::units::Rgb;
use isolux_serve::RayAsked;
use rayon::prelude::*;
use serde::Serialize;
use std::f64::consts::PI;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread;

/// Surfaces that are looked through at most.
const MOST_LOOKED_THROUGH: usize = 64;
/// Places are rounded to a tenth of a millimetre: what is shown is what is read.
const ROUNDED: f64 = 1e4;
/// Askers that wait at most.
const WAITING: usize = 64;

/// What is known of a place, as `web/src/wire.ts` has it.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Reading {
    position: Option<[f64; 3]>,
    normal: Option<[f64; 3]>,
    shape: String,
    material: String,
    diffuse_reflectance: Option<f64>,
    illuminance_lx: Option<f64>,
    standard_error_lx: Option<f64>,
    direct_lx: Option<f64>,
    indirect_lx: Option<f64>,
    rgb_lx: Option<[f64; 3]>,
    luminance_cd_m2: Option<f64>,
    found: &'static str,
}

/// What is read: the scene and its map with layers of light dimmed; `None` where no light is left.
pub(super) type Dimmed =
    Box<dyn Fn(&[f64]) -> Option<(Arc<Scene>, Arc<IlluminationMap>)> + Send + Sync>;

/// Reads a map by rays, in a thread of its own, since what it prepares for that lives as long.
pub(super) struct Reader {
    asked: SyncSender<Asked>,
}

/// Rays in dimmed light, whether the asker still waits, and where the answer goes.
struct Asked {
    rays: Vec<RayAsked>,
    dimming: Vec<f64>,
    is_wanted: Box<dyn Fn() -> bool + Send + Sync>,
    answer: SyncSender<Vec<Reading>>,
}

impl Reader {
    /// Begins to prepare; readings wait until it has.
    pub(super) fn start(dimmed: Dimmed) -> Self {
        let (asked, askers) = sync_channel(WAITING);
        thread::spawn(move || answer(&dimmed, &askers));
        Self { asked }
    }

    /// The readings; `None` if too many ask, the asker has gone, or no light is left.
    pub(super) fn read(
        &self,
        (rays, dimming): (Vec<RayAsked>, Vec<f64>),
        is_wanted: Box<dyn Fn() -> bool + Send + Sync>,
    ) -> Option<Vec<Reading>> {
        let (answer, answered) = sync_channel(1);
        self.asked.try_send(Asked { rays, dimming, is_wanted, answer }).ok()?;
        answered.recv().ok()
    }
}

fn answer(dimmed: &Dimmed, askers: &Receiver<Asked>) {
    let mut dimming = Vec::new();
    let mut waiting: Option<Asked> = None;
    loop {
        let lit = dimmed(&dimming);
        let reader = lit.as_ref().map(|(scene, map)| (&**scene, MapReader::new(scene, map)));
        loop {
            let Some(asked) = waiting.take().or_else(|| askers.recv().ok()) else { return };
            if asked.dimming != dimming {
                // Whoever has gone meanwhile needs no other light.
                if (asked.is_wanted)() {
                    dimming.clone_from(&asked.dimming);
                    waiting = Some(asked);
                    break;
                }
                continue;
            }
            if let Some((scene, reader)) = &reader {
                asked.answer_by(scene, reader);
            }
        }
    }
}

impl Asked {
    fn answer_by(&self, scene: &Scene, reader: &MapReader<'_>) {
        let read = |ray: &RayAsked| (self.is_wanted)().then(|| by_probe(scene, reader, ray));
        let readings: Option<Vec<Reading>> = self.rays.par_iter().map(read).collect();
        // Who has gone needs no answer.
        if let Some(readings) = readings {
            let _ = self.answer.send(readings);
        }
    }
}

fn by_probe(scene: &Scene, reader: &MapReader<'_>, ray: &RayAsked) -> Reading {
    reading(scene, ray, "probe", &|_, at| reader.probe(at))
}

/// The same interpolated between the vertices of a map, which takes no time.
pub(super) fn from_vertices(scene: &Scene, map: &IlluminationMap, ray: &RayAsked) -> Reading {
    let read =
        |hit: &Hit, _| map.interpolate(hit.triangle, hit.back, f64::from(hit.u), f64::from(hit.v));
    reading(scene, ray, "vertices", &read)
}

type Read<'a> = dyn Fn(&Hit, ProbePoint) -> Option<Illuminance> + 'a;

fn reading(scene: &Scene, ray: &RayAsked, found: &'static str, read: &Read<'_>) -> Reading {
    let nothing = Reading {
        position: None,
        normal: None,
        shape: String::new(),
        material: String::new(),
        diffuse_reflectance: None,
        illuminance_lx: None,
        standard_error_lx: None,
        direct_lx: None,
        indirect_lx: None,
        rgb_lx: None,
        luminance_cd_m2: None,
        found,
    };
    let Some(hit) = first_seen(scene, ray) else { return nothing };
    let at = ProbePoint { position: rounded(scene.hit_point(&hit)), normal: side(scene, &hit) };
    let value = read(&hit, at);
    let finish = scene.material(hit.triangle).finish(hit.back);
    let diffuse = finish.map(|finish| {
        scene.diffuse_reflectance(finish, hit.triangle, f64::from(hit.u), f64::from(hit.v))
    });
    let emitted_cd_m2 = finish.map_or(Rgb::BLACK, |finish| finish.luminance_cd_m2);
    let luminance = |value: Illuminance| {
        (emitted_cd_m2 + diffuse.unwrap_or(Rgb::BLACK) * value.total_lx() / PI).luminance()
    };
    Reading {
        position: Some(at.position.into()),
        normal: Some(at.normal.to_vector().into()),
        shape: scene.shape_names()[scene.shape_of(hit.triangle) as usize].clone(),
        material: scene.material(hit.triangle).name.clone(),
        diffuse_reflectance: diffuse.map(Rgb::luminance),
        illuminance_lx: value.map(|value| value.illuminance_lx()),
        standard_error_lx: value.map(|value| value.standard_error_lx),
        direct_lx: value.map(|value| value.direct_lx.luminance()),
        indirect_lx: value.map(|value| value.indirect_lx.luminance()),
        rgb_lx: value.map(|value| value.total_lx().0),
        luminance_cd_m2: value.map(luminance),
        ..nothing
    }
}

/// The first surface that is drawn along a ray: glass and the black backs of walls are looked through.
fn first_seen(scene: &Scene, ray: &RayAsked) -> Option<Hit> {
    let direction = Vector::from(ray.direction).direction()?;
    let mut next = Ray::new(Point::from(ray.origin), direction);
    for _ in 0..MOST_LOOKED_THROUGH {
        let hit = scene.bvh().closest_hit(&next)?;
        let is_drawn = match &scene.material(hit.triangle).body {
            Body::Dielectric(_) => false,
            Body::Opaque { back, .. } => !hit.back || *back != Finish::BLACK,
        };
        if is_drawn {
            return Some(hit);
        }
        let behind = (-side(scene, &hit).to_direction()).to_normal();
        let origin = scene.bvh().offset_origin(scene.hit_point(&hit), behind);
        next = Ray::new(origin, direction).skipping(hit.triangle);
    }
    None
}

/// The normal of the side that is hit.
fn side(scene: &Scene, hit: &Hit) -> Normal {
    let front = scene.geometric_normal(hit.triangle);
    if hit.back { (-front.to_direction()).to_normal() } else { front }
}

fn rounded(place: Point) -> Point {
    Point::from(<[f64; 3]>::from(place).map(|c| (c * ROUNDED).round() / ROUNDED))
}
