//! What is kept of a run: its state, its pilot and parts of it, read and gone on with in a small room.

use isolux::engine::{
    PilotState, Progress, RunState, SoFar, SolveRequest, Watch, make_pilot, solve, solve_looked_at,
    solve_merged, with_parts,
};
use isolux::scene::Scene;
use isolux_formats::checkpoint::{self, Checkpoint, Contents, Part};
use isolux_formats::load;
use std::sync::LazyLock;

/// Everything that a pilot can know of: walls, a mirror, a pane, two kinds of luminaires.
const ROOM: &str = r#"
[materials]
wall = { diffuse = 0.5 }
mirror = { mirror = 0.8, back = { diffuse = 0.3 } }
lamp = { luminance_cd_m2 = 500, sided = "one" }
[[geometry]]
box = { min = [0, 0, 0], max = [1, 1, 1], inward = true }
material = "wall"
[[geometry]]
rectangle = { corner = [0.3, 0.6, 0.2], u = [0, 0, 0.3], v = [0.3, 0, 0] }
material = "mirror"
[[geometry]]
rectangle = { corner = [0.2, 0.2, 0.9], u = [0, 0.3, 0], v = [0.3, 0, 0] }
material = "lamp"
[[luminaire]]
position = [0.4, 0.4, 0.7]
spot = { flux_lm = 10, inner_deg = 20, outer_deg = 40 }
"#;

/// A room, what is asked of it, and what is kept of its run.
pub(crate) struct Kept {
    scene: Scene,
    request: SolveRequest,
    pilot: PilotState,
    pub(crate) files: [Vec<u8>; 3],
}

pub(crate) static KEPT: LazyLock<Kept> = LazyLock::new(|| {
    let home = tempfile::tempdir().unwrap();
    let path = home.path().join("room.toml");
    std::fs::write(&path, ROOM).unwrap();
    let scene = Scene::assemble(load(&path).unwrap().value).unwrap();
    // The memory leaves few receivers, so that the files are short.
    let request = SolveRequest {
        accuracy: Some(0.5),
        mesh_accuracy: 0.9,
        max_memory_bytes: 150_000,
        ..Default::default()
    };
    let pilot = make_pilot(&scene, &request, &mut go_on).unwrap().unwrap();
    let made = with_parts(&scene, &request, &pilot, |maker| maker.make(0..2, &mut go_on)).unwrap();
    let part = Part { scene: "room.toml".to_owned(), part: made };
    let mut state = None;
    solve_looked_at(&scene, &request, None, &mut |progress, so_far| {
        state = so_far.state();
        if progress.increments < 2 { Watch::Continue } else { Watch::Stop }
    })
    .unwrap();
    let drafts = [
        checkpoint::of_pilot(&pilot).unwrap(),
        checkpoint::of_part(&part),
        checkpoint::of_state(state.as_ref().unwrap()),
    ];
    let files = drafts.map(|draft| checkpoint::to_bytes(&draft).unwrap());
    Kept { scene, request, pilot, files }
});

fn go_on(_: &Progress, _: &SoFar<'_>) -> Watch {
    Watch::Continue
}

impl Kept {
    /// Whether a run goes on from what was read. It ends soon, and whatever it begins with does not make it panic.
    pub(crate) fn goes_on(&self, read: &Checkpoint) -> bool {
        match checkpoint::contents(read) {
            Ok(Contents::Pilot(pilot)) => self.takes_pilot(&pilot),
            Ok(Contents::Part(part)) => self.takes_part(&part),
            Ok(Contents::Run(state)) => self.takes_state(&state),
            Err(why) => {
                assert!(!why.is_empty(), "refused without a word");
                false
            }
        }
    }

    fn takes_pilot(&self, pilot: &PilotState) -> bool {
        with_parts(&self.scene, &self.request, pilot, |maker| maker.make(0..1, &mut go_on)).is_ok()
    }

    fn takes_part(&self, Part { part, .. }: &Part) -> bool {
        solve_merged(&self.scene, &self.request, Some(&self.pilot), part, &mut go_on).is_ok()
    }

    fn takes_state(&self, state: &RunState) -> bool {
        let state = RunState { pilot: Some(self.pilot.clone()), ..state.clone() };
        solve(&self.scene, &self.request, Some(&state), &mut |_| Watch::Stop).is_ok()
    }
}
