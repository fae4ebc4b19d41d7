//! Pilots and parts of runs as files: what is written comes back, and whatever else is read does no harm.
#![allow(clippy::unwrap_used, reason = "tests may stop at the first surprise")]

use isolux::engine::{
    PilotState, Progress, RunPart, Segment, SoFar, SolveRequest, Watch, make_pilot, with_parts,
};
use isolux::sampling::Key;
use isolux::scene::Scene;
use isolux_formats::checkpoint::{self, Checkpoint, Part};
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

/// The number of damaged pilots: fifteen hundred were tried once.
const MUTANTS: u64 = 200;

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

#[test]
fn damaged_pilots_are_refused_or_do_no_harm() {
    let scene = scene();
    let pilot = make_pilot(&scene, &request(), &mut go_on).unwrap().unwrap();
    let whole = checkpoint::of_pilot(&pilot).unwrap();
    let mut used = 0;
    for number in 0..MUTANTS {
        let key = Key::new(7).with(number);
        let mut spoilt = whole.clone();
        let bytes = &mut spoilt.arrays[0].1;
        let draw = |k: u64, below: usize| (key.with(k).uniform() * below as f64) as usize;
        for change in 0..1 + draw(0, 3) as u64 {
            let at = draw(3 * change + 1, bytes.len());
            bytes[at] = match draw(3 * change + 2, 3) {
                0 => draw(3 * change + 3, 256) as u8,
                1 => bytes[at] ^ 1 << draw(3 * change + 3, 8),
                _ => 0xff,
            };
        }
        // What is read and fits the scene is used: it must not panic.
        let read = checkpoint::pilot(&spoilt);
        used += u64::from(read.is_ok_and(|pilot| part_of(&scene, &pilot).is_some()));
    }
    assert!((1..MUTANTS).contains(&used), "{used} of {MUTANTS} were used");
}

#[test]
fn pilots_and_parts_come_back_from_bytes() {
    let scene = scene();
    let pilot = make_pilot(&scene, &request(), &mut go_on).unwrap().unwrap();
    let through =
        |whole: &Checkpoint| checkpoint::from_bytes(&checkpoint::to_bytes(whole).unwrap()).unwrap();
    let whole = checkpoint::of_pilot(&pilot).unwrap();
    let read = checkpoint::pilot(&through(&whole)).unwrap();
    assert_eq!(read, pilot);
    // Tables come back in the same order.
    assert_eq!(checkpoint::of_pilot(&read).unwrap(), whole);
    let part = part_of(&scene, &pilot).unwrap();
    assert_eq!(part_of(&scene, &read).unwrap(), part);
    // One increment has sums alone, two have squares, too.
    for range in [0..1, 2..4] {
        let made = with_parts(&scene, &request(), &read, |maker| maker.make(range, &mut go_on));
        let part = Part { scene: "room.toml".into(), part: made.unwrap() };
        assert_eq!(checkpoint::part(&through(&checkpoint::of_part(&part))), Ok(part));
    }
}

#[test]
fn each_kind_is_told_from_the_others() {
    let scene = scene();
    let pilot = make_pilot(&scene, &request(), &mut go_on).unwrap().unwrap();
    let part = Part { scene: String::new(), part: part_of(&scene, &pilot).unwrap() };
    let (of_pilot, of_part) = (checkpoint::of_pilot(&pilot).unwrap(), checkpoint::of_part(&part));
    assert!(checkpoint::part(&of_pilot).unwrap_err().contains("it is the result of a pilot"));
    assert!(checkpoint::pilot(&of_part).unwrap_err().contains("it is a part of a run"));
    assert!(checkpoint::state(&of_part).unwrap_err().contains("not the state of a run"));
    // Increments twice, or with sums of other lengths.
    let segments = |edit: &dyn Fn(&mut Vec<Segment>)| {
        let mut part = part.clone();
        edit(&mut part.part.segments);
        checkpoint::part(&checkpoint::of_part(&part))
    };
    assert!(segments(&|all| all.push(all[0].clone())).is_err());
    assert!(segments(&|all| all[1].count = u64::MAX).is_err());
    assert!(segments(&|all| all[1].checks.clear()).is_err());
    assert!(segments(&Vec::clear).is_err());
}
