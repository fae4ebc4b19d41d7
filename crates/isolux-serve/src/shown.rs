//! What is shown, as whoever shows it provides it.

use serde::Deserialize;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// What is shown. Its methods are called from threads that may wait, and with worlds below
/// [`worlds`](Self::worlds) only. What an error says is shown to the user.
pub trait Shown: Send + Sync + 'static {
    /// How many worlds there are.
    fn worlds(&self) -> usize;

    /// What a page begins with, as JSON.
    fn hello(&self) -> Vec<u8>;

    /// The container of the scene of a world; `None`: not there yet.
    fn scene(&self, world: usize) -> Option<Arc<[u8]>>;

    /// The container of the newest mesh of a world; `None`: not there yet.
    fn mesh(&self, world: usize) -> Option<Arc<[u8]>>;

    /// The container of the light on a mesh that is newer than version `since`; `None`: the world
    /// has another mesh by now, or none yet.
    fn light(&self, world: usize, mesh: u64, since: u64) -> Option<Vec<u8>>;

    /// Readings along rays, one for each, as JSON: `{"readings": [...]}`. Work for somebody who
    /// is gone may be given up, with any result.
    fn read(&self, world: usize, asked: &Question, gone: &Gone) -> Result<Vec<u8>, String>;

    /// The tables of the measuring grids of a world, as JSON.
    fn grids(&self, world: usize) -> Result<Arc<[u8]>, String>;

    /// Does with the run what is asked; an error where no run is under way.
    fn control(&self, what: Control) -> Result<(), String>;
}

/// More rays are not asked for at once, and more layers of light are dimmed by nobody.
const MAX_RAYS: usize = 256;
const MAX_LAYERS: usize = 256;

/// What somebody wants to read.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Question {
    pub(crate) world: u64,
    /// Along which rays.
    pub rays: Vec<RayAsked>,
    /// What each layer of light is multiplied by: finite, not negative; none: as they are.
    #[serde(default)]
    pub dimming: Vec<f64>,
}

impl Question {
    /// What is wrong with it.
    pub(crate) fn problem(&self) -> Option<String> {
        if !(1..=MAX_RAYS).contains(&self.rays.len()) {
            return Some(format!("from 1 to {MAX_RAYS} rays can be asked for at once"));
        }
        if let Some(k) = self.rays.iter().position(|ray| !ray.is_ray()) {
            return Some(format!("rays[{k}] has no origin or no direction of some length"));
        }
        let is_dimming = |by: &f64| by.is_finite() && *by >= 0.0;
        let is_sound = self.dimming.len() <= MAX_LAYERS && self.dimming.iter().all(is_dimming);
        (!is_sound).then(|| "`dimming` must hold numbers that are not negative".to_owned())
    }
}

/// A ray along which somebody wants a reading: finite numbers, and the square of the length of
/// its direction is a normal number.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RayAsked {
    /// Where it begins, in coordinates of the scene as written, in metres.
    pub origin: [f64; 3],
    /// Where it goes, of any length.
    pub direction: [f64; 3],
}

impl RayAsked {
    pub(crate) fn is_ray(&self) -> bool {
        let square: f64 = self.direction.iter().map(|x| x * x).sum();
        square.is_normal() && self.origin.iter().all(|x| x.is_finite())
    }
}

/// What a viewer wants of the run.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(tag = "action", rename_all = "lowercase")]
pub enum Control {
    /// Rest after what is being computed now.
    Pause,
    /// Go on after a pause.
    Resume,
    /// End the run with what it has.
    Stop,
    /// Run to this accuracy: a relative error, above zero.
    Target {
        /// The error wanted.
        accuracy: f64,
    },
}

impl Control {
    pub(crate) fn is_sound(&self) -> bool {
        !matches!(self, Self::Target { accuracy } if !(accuracy.is_finite() && *accuracy > 0.0))
    }
}

/// Whether an asker has left. Clones tell the same.
#[derive(Clone, Debug, Default)]
pub struct Gone(Arc<AtomicBool>);

impl Gone {
    /// Whether nobody waits for the result any longer.
    pub fn is_gone(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Says that nobody waits any longer.
    pub fn leave(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_need_a_direction() {
        let is_ray = |origin, direction| RayAsked { origin, direction }.is_ray();
        assert!(is_ray([0.0; 3], [0.0, 0.0, -1.0]));
        assert!(is_ray([1e300; 3], [1e-100, 0.0, 1e100]));
        for direction in [[0.0; 3], [f64::NAN, 0.0, 1.0], [1e-200; 3], [1e200; 3]] {
            assert!(!is_ray([0.0; 3], direction), "{direction:?}");
        }
        assert!(!is_ray([f64::INFINITY, 0.0, 0.0], [1.0, 0.0, 0.0]));
    }

    #[test]
    fn controls_are_read_from_json() {
        let read = |text| serde_json::from_str::<Control>(text).ok();
        assert_eq!(read(r#"{"action":"pause"}"#), Some(Control::Pause));
        assert_eq!(read(r#"{"action":"resume"}"#), Some(Control::Resume));
        assert_eq!(read(r#"{"action":"stop"}"#), Some(Control::Stop));
        let target = r#"{"action":"target","accuracy":0.01}"#;
        assert_eq!(read(target), Some(Control::Target { accuracy: 0.01 }));
        assert_eq!(read(r#"{"action":"target"}"#), None);
        assert_eq!(read(r#"{"action":"burn"}"#), None);
    }

    #[test]
    fn targets_are_above_zero() {
        assert!(Control::Stop.is_sound());
        assert!(Control::Target { accuracy: 0.01 }.is_sound());
        assert!(!Control::Target { accuracy: 0.0 }.is_sound());
        assert!(!Control::Target { accuracy: f64::NAN }.is_sound());
    }
}
