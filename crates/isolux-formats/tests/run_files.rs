//! Pilots and parts of runs as files: what is written comes back.
#![allow(clippy::unwrap_used, reason = "tests may stop at the first surprise")]

use isolux::engine::{
    PilotState, Progress, RunPart, Segment, SoFar, SolveRequest, Watch, make_pilot, with_parts,
};
use isolux::scene::Scene;
use isolux_formats::checkpoint::{self, Checkpoint, Draft, Part};
use isolux_formats::load;

/// A room with a wall, a mirror, glass and a lamp: a pilot has something of everything.
const ROOM: &str = r#"
[materials.walls]
diffuse = 0.7

[materials.mirror]
diffuse = 0
mirror = 0.9

[[geometry]]
box = { min = [0, 0, 0], max = [2, 2, 2], inward = true }
material = "walls"

[[geometry]]
box = { min = [0.5, 0.5, 0.0], max = [0.9, 0.9, 0.5] }
material = "walls"
materials = { z_max = "mirror" }

[[luminaire]]
position = [1.0, 1.0, 1.9]
isotropic = { intensity_cd = 100 }
"#;

fn go_on(_: &Progress, _: &SoFar<'_>) -> Watch {
    Watch::Continue
}

fn request() -> SolveRequest {
    SolveRequest { accuracy: Some(0.2), mesh_accuracy: 0.5, ..SolveRequest::default() }
}

fn scene() -> Scene {
    let home = tempfile::tempdir().unwrap();
    let path = home.path().join("scene.toml");
    std::fs::write(&path, ROOM).unwrap();
    Scene::assemble(load(&path).unwrap().value).unwrap()
}

fn part_of(scene: &Scene, pilot: &PilotState) -> Option<RunPart> {
    with_parts(scene, &request(), pilot, |maker| maker.make(0..2, &mut go_on)).ok()
}

fn through(draft: &Draft<'_>) -> Checkpoint {
    checkpoint::from_bytes(checkpoint::to_bytes(draft).unwrap()).unwrap()
}

#[test]
fn pilots_and_parts_come_back_from_bytes() {
    let scene = scene();
    let pilot = make_pilot(&scene, &request(), &mut go_on).unwrap().unwrap();
    let whole = through(&checkpoint::of_pilot(&pilot).unwrap());
    let read = checkpoint::pilot(&whole).unwrap();
    assert_eq!(read, pilot);
    // Tables come back in the same order.
    assert_eq!(through(&checkpoint::of_pilot(&read).unwrap()), whole);
    let part = part_of(&scene, &pilot).unwrap();
    assert_eq!(part_of(&scene, &read).unwrap(), part);
    // One increment has sums alone, two have squares, too.
    for range in [0..1, 2..4] {
        let made = with_parts(&scene, &request(), &read, |maker| maker.make(range, &mut go_on));
        let part = Part { scene: "room.toml".into(), part: made.unwrap() };
        let read = checkpoint::part(&through(&checkpoint::of_part(&part)));
        assert_eq!(read, Ok(part));
    }
}

#[test]
fn each_kind_is_told_from_the_others() {
    let scene = scene();
    let pilot = make_pilot(&scene, &request(), &mut go_on).unwrap().unwrap();
    let part = Part { scene: String::new(), part: part_of(&scene, &pilot).unwrap() };
    let of_pilot = through(&checkpoint::of_pilot(&pilot).unwrap());
    let of_part = through(&checkpoint::of_part(&part));
    assert!(checkpoint::part(&of_pilot).unwrap_err().contains("it is the result of a pilot"));
    assert!(checkpoint::pilot(&of_part).unwrap_err().contains("it is a part of a run"));
    assert!(checkpoint::state(&of_part).unwrap_err().contains("not the state of a run"));
    // Increments twice, or with sums of other lengths.
    let segments = |edit: &dyn Fn(&mut Vec<Segment>)| {
        let mut part = part.clone();
        edit(&mut part.part.segments);
        checkpoint::part(&through(&checkpoint::of_part(&part)))
    };
    assert!(segments(&|all| all.push(all[0].clone())).is_err());
    assert!(segments(&|all| all[1].count = u64::MAX).is_err());
    assert!(segments(&|all| all[1].checks.clear()).is_err());
    assert!(segments(&Vec::clear).is_err());
}
