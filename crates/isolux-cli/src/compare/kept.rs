//! What an earlier comparison has left in the folder, with what it was made of.

use super::folder::Folder;
use super::plan::Plan;
use crate::failure::Failure;
use crate::map_file;
use isolux::map::IlluminationMap;
use isolux::scene::Scene;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// What something was made of: what was made otherwise is made anew.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Made {
    version: String,
    scene_hash: String,
    seed: u64,
    threads: usize,
    picture: [u32; 2],
    /// The accuracy asked for, where it was asked for beforehand.
    accuracy: Option<f64>,
    /// What another renderer was asked for.
    effort: Option<String>,
}

impl Made {
    pub(crate) fn of(scene_hash: &str, plan: &Plan) -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            scene_hash: scene_hash.to_owned(),
            seed: plan.seed,
            threads: rayon::current_num_threads(),
            picture: plan.picture,
            accuracy: None,
            effort: None,
        }
    }

    pub(crate) fn for_accuracy(self, accuracy: f64) -> Self {
        Self { accuracy: Some(accuracy), ..self }
    }

    pub(crate) fn with_effort(self, effort: &str) -> Self {
        Self { effort: Some(effort.to_owned()), ..self }
    }

    /// A result of an earlier comparison that was made of the same.
    pub(crate) fn found<T: DeserializeOwned>(&self, folder: &Folder, stem: &str) -> Option<T> {
        let text = std::fs::read(folder.path(&format!("maps/{stem}.json"))).ok()?;
        let kept: Kept<T> = serde_json::from_slice(&text).ok()?;
        (kept.made == *self).then_some(kept.result)
    }

    /// Keeps a result.
    pub(crate) fn keep<T: Serialize>(
        &self,
        folder: &Folder,
        stem: &str,
        result: &T,
    ) -> Result<(), Failure> {
        let kept = Kept { made: self.clone(), result };
        let json = serde_json::to_vec_pretty(&kept).expect("plain values always have a JSON text");
        folder.write(&format!("maps/{stem}.json"), &json)
    }
}

#[derive(Serialize, Deserialize)]
struct Kept<T> {
    made: Made,
    result: T,
}

/// Keeps a map. Its result is kept after it: who finds that finds the map.
pub(crate) fn keep_map(
    folder: &Folder,
    stem: &str,
    (scene, map): (&Scene, &IlluminationMap),
) -> Result<(), Failure> {
    map_file::write(&folder.output(&format!("maps/{stem}.glb"), "glb")?, scene, map)
}

/// A map that was kept, with its scene.
pub(crate) fn map(folder: &Folder, stem: &str) -> Result<(Scene, IlluminationMap), Failure> {
    map_file::read(&folder.path(&format!("maps/{stem}.glb")))
}
