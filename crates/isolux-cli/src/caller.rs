//! A program that has the command work in its own process, in place of a terminal: it hands in scenes and maps, is told what
//! terminals show and given what files get.

use crate::reading::Reading;
use crate::stop::Stop;
use isolux::map::IlluminationMap;
use isolux::scene::Scene;
use isolux_view::Picture;
use std::cell::RefCell;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;
use std::sync::mpsc::Sender;

/// Who has work done.
pub struct Caller {
    /// What is in memory already, each by the name that words refer to it by.
    pub given: Vec<(PathBuf, Given)>,
    /// What is wanted of the work.
    pub stop: Arc<Stop>,
    /// Whether the caller has the increments of runs made: it is then told which are wanted.
    pub makes_increments: bool,
    /// Hears of all, on the thread that works.
    pub tell: Box<dyn Fn(Told) + Send + Sync>,
}

/// What need not be read from a file.
#[derive(Clone)]
pub enum Given {
    /// A scene.
    Scene(Arc<Scene>),
    /// A map with its scene.
    Map(Arc<(Scene, IlluminationMap)>),
}

/// What a caller is told.
pub enum Told {
    /// A line for people, and what it is: `error`, `refused`, `warning` or `note`.
    Note(&'static str, String),
    /// How far a run is: the object of `solve --progress json`, with `text`, the line for people, and `share`, the time passed over
    /// the time predicted.
    Progress(String),
    /// What `--json` prints.
    Json(String),
    /// Help, or the version: what is printed in place of a result.
    Text(String),
    /// A map that is written to this file.
    Map(PathBuf, Box<(Scene, IlluminationMap)>),
    /// A picture that is written.
    Picture(Picture),
    /// An increment that the caller has to have made.
    Wanted(Wanted),
    /// Luminances that are written, cd/m2, row by row from the top.
    Luminances {
        /// In pixels.
        width: u32,
        /// In pixels.
        height: u32,
        /// Of every pixel, in linear Rec. 709.
        rgb_cd_m2: Vec<[f32; 3]>,
    },
}

/// An increment that a caller is to have made.
pub struct Wanted {
    /// The scene in bytes, unless it is the same as before.
    pub scene: Option<Vec<u8>>,
    /// The pilot, as a file, unless it is the same as before.
    pub pilot: Option<Vec<u8>>,
    /// The number of the mesh, counted from one.
    pub stage: u32,
    /// The number of the increment.
    pub increment: u64,
    /// Takes its part, as a file. If it is dropped without one, the run ends.
    pub answer: Sender<Vec<u8>>,
}

/// Work for a caller.
pub(crate) struct Call {
    pub(crate) caller: Caller,
    /// How scenes are read in it.
    pub(crate) reading: Reading,
    /// Bytes that a map or a lightmap may take.
    pub(crate) max_memory: Option<u64>,
    /// What it was asked for by.
    pub(crate) words: Vec<OsString>,
}

thread_local! {
    static HERE: RefCell<Option<Rc<Call>>> = const { RefCell::new(None) };
}

/// The call that this thread works for.
pub(crate) fn here() -> Option<Rc<Call>> {
    HERE.with_borrow(Clone::clone)
}

/// Ends the work on this thread if its caller has left. Long work looks now and then, before it writes, too.
pub(crate) fn look() {
    if let Some(call) = here() {
        call.stop().look();
    }
}

/// Whether the caller has left, for threads that share the work of this one: what they have not begun they leave out, and then this one
/// looks. To unwind from each of a million places would take a minute.
pub(crate) fn lookout() -> impl Fn() -> bool + Send + Sync {
    let stop = here().map(|call| call.stop());
    move || stop.as_ref().is_some_and(|stop| stop.is_left())
}

/// Works for a caller.
pub(crate) fn called<T>(call: Call, work: impl FnOnce() -> T) -> T {
    /// Ends the call however the work ends.
    struct End;
    impl Drop for End {
        fn drop(&mut self) {
            HERE.set(None);
        }
    }
    HERE.set(Some(Rc::new(call)));
    let _end = End;
    work()
}

impl Call {
    /// Tells the caller.
    pub(crate) fn tell(&self, told: Told) {
        (self.caller.tell)(told);
    }

    /// What the caller wants of the work.
    pub(crate) fn stop(&self) -> Arc<Stop> {
        Arc::clone(&self.caller.stop)
    }

    /// Words that may name files; what was handed in is none.
    pub(crate) fn names_of_files(&self) -> Vec<String> {
        let is_file = |word: &&OsString| self.given(Path::new(word)).is_none();
        let words = self.words.iter().filter(is_file);
        words.map(|word| word.to_string_lossy().into_owned()).collect()
    }

    /// Whether the caller has increments made.
    pub(crate) fn makes_increments(&self) -> bool {
        self.caller.makes_increments
    }

    /// Whether a scene was handed in by this name.
    pub(crate) fn has_scene(&self, name: &Path) -> bool {
        matches!(self.given(name), Some(Given::Scene(_)))
    }

    /// A scene that was handed in by this name.
    pub(crate) fn scene(&self, name: &Path) -> Option<Scene> {
        match self.given(name)? {
            Given::Scene(scene) => Some(Scene::clone(scene)),
            Given::Map(_) => None,
        }
    }

    /// A map that was handed in by this name.
    pub(crate) fn map(&self, name: &Path) -> Option<&(Scene, IlluminationMap)> {
        match self.given(name)? {
            Given::Scene(_) => None,
            Given::Map(map) => Some(map),
        }
    }

    fn given(&self, name: &Path) -> Option<&Given> {
        self.caller.given.iter().find(|(known, _)| known == name).map(|(_, given)| given)
    }
}
