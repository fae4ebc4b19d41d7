//! Runs whose increments are made elsewhere: the caller has them made, by other processes that make parts.

use crate::caller::{self, Call, Told, Wanted};
use isolux::engine::{PilotState, RunPart, SolveError};
use isolux::scene::Scene;
use isolux_formats::{checkpoint, map_glb};
use std::rc::Rc;
use std::sync::mpsc::channel;

/// Increments that a caller has made.
pub(crate) struct Increments {
    call: Rc<Call>,
    /// The scene and the mesh that the caller knows.
    known: Option<(String, u32)>,
}

impl Increments {
    /// None where there is no caller, or one that has none made.
    pub(crate) fn of_caller() -> Option<Self> {
        let call = caller::here().filter(|call| call.makes_increments());
        call.map(|call| Self { call, known: None })
    }

    /// The part of one increment; `None` if the run is to end.
    pub(crate) fn next(
        &mut self,
        scene: &Scene,
        pilot: &PilotState,
        increment: u64,
    ) -> Result<Option<RunPart>, SolveError> {
        let of_run = &pilot.identity.scene_hash;
        let known = self.known.as_ref().filter(|(scene, _)| scene == of_run);
        let (is_new_scene, is_new) =
            (known.is_none(), known.is_none_or(|(_, stage)| *stage != pilot.stage));
        let wrong = SolveError::Elsewhere;
        let new_scene = is_new_scene.then(|| map_glb::scene_bytes(scene)).transpose();
        let new_pilot = is_new.then(|| pilot_bytes(pilot)).transpose();
        let (answer, answered) = channel();
        self.call.tell(Told::Wanted(Wanted {
            scene: new_scene.map_err(|error| wrong(error.to_string()))?,
            pilot: new_pilot.map_err(wrong)?,
            stage: pilot.stage,
            increment,
            answer,
        }));
        if is_new {
            self.known = Some((of_run.clone(), pilot.stage));
        }
        let Ok(bytes) = answered.recv() else { return Ok(None) };
        let read = checkpoint::from_bytes(bytes).and_then(|read| checkpoint::part(&read));
        read.map(|read| Some(read.part))
            .map_err(|what| wrong(format!("increment {increment}, made elsewhere: {what}")))
    }
}

fn pilot_bytes(pilot: &PilotState) -> Result<Vec<u8>, String> {
    checkpoint::to_bytes(&checkpoint::of_pilot(pilot)?)
}
