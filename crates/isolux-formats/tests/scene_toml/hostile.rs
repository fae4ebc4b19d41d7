//! Files made to hurt.

use super::{FLOOR, read_with};
use proptest::prelude::*;
use std::fmt::Write;

#[test]
fn deep_and_long_files_end() {
    let deep = format!("x = {}", "[".repeat(100_000));
    assert!(read_with(&deep, &[]).is_err());
    let deep_keys = format!("{}x = 1", "a.".repeat(50_000));
    assert!(read_with(&deep_keys, &[]).is_err());
    let mut keys = String::from("[[luminaire]]\n");
    for k in 0..20_000 {
        writeln!(keys, "key{k} = 1").unwrap();
    }
    let problems = read_with(&keys, &[]).unwrap_err();
    assert!(problems.0.len() < 30, "a few problems stand for all");
}

#[test]
fn requirements_of_all_grids_are_bounded() {
    const GRID: &str = "[[grid]]\ncorner = [0, 0, 1]\nu = [1, 0, 0]\nv = [0, 1, 0]\n";
    const REQUIREMENT: &str = "[[requirement]]\nconditions = 'Em >= 100'\n";
    let with = |count: usize| {
        let text = [FLOOR, &GRID.repeat(count), &REQUIREMENT.repeat(count)].concat();
        read_with(&text, &[])
    };
    let read = with(100).expect("10,000 are enough for anybody").value;
    assert!(read.grids.iter().all(|grid| grid.requirements.len() == 100));
    let found = with(400).expect_err("160,000 are too many").to_string();
    assert!(found.contains("more than 100000 requirements of all grids together"), "{found}");
}

#[test]
fn copies_without_end_are_refused() {
    let mut text = String::from("[materials.m]\ndiffuse = 0.5\n");
    for _ in 0..3 {
        text += "[[geometry]]\nmaterial = 'm'\n\
                 sphere = { centre = [0,0,0], radius = 1, segments = 2048 }\nplacements = [";
        text += &"{},".repeat(1000);
        text += "]\n";
    }
    let problems = read_with(&text, &[]).unwrap_err().to_string();
    assert!(problems.contains("triangles are more than"), "{problems}");
}

/// A scene that uses every kind of value.
const RICH: &str = "name = 'r'\nup = 'z'\nunits = 'cm'\n[materials.m]\ndiffuse = [0.1, 0.2, 0.3]\n\
    gloss = { f0 = 0.04, roughness = 0.3 }\nback = { mirror = '#808080' }\n[[geometry]]\n\
    sphere = { centre = [0, 0, 0], radius = 1, segments = 8, octant = true }\nmaterial = 'm'\n\
    placements = [{ rotate_deg = [1, 2, 3], scale = 2 }, { translate = [1, 2, 3] }]\n\
    [[luminaire]]\nposition = [1, 2, 3]\ntarget = [0, 0, 0]\ncct_k = 3000\n\
    spot = { flux_lm = 10, inner_deg = 1, outer_deg = 2 }\n\
    array = { count = [2, 2, 2], step = [1, 1, 1] }\n[[camera]]\nposition = [0, 0, 0]\n\
    target = [1, 0, 0]\nvertical_fov_deg = 30\n";

#[test]
fn the_scene_that_is_damaged_is_good() {
    assert!(read_with(RICH, &[]).is_ok());
    assert!(read_with(FLOOR, &[]).is_ok());
}

proptest! {
    /// Any damage ends in a scene or in problems, never in a panic or a hang.
    #[test]
    fn damaged_bytes(at in 0..RICH.len(), byte in 32_u8..127, cut in 0..RICH.len()) {
        let mut bytes = RICH.as_bytes().to_vec();
        bytes[at] = byte;
        let _ = read_with(&String::from_utf8(bytes).unwrap(), &[]);
        let _ = read_with(&RICH[..cut], &[]);
    }

    /// Numbers of any size.
    #[test]
    fn damaged_numbers(value in any::<f64>(), which in 0_usize..40) {
        let mut seen = 0;
        let text: String = RICH
            .split_inclusive(|c: char| !(c.is_ascii_digit() || c == '.'))
            .map(|token| {
                let digits = token.trim_end_matches(|c: char| !(c.is_ascii_digit() || c == '.'));
                if digits.is_empty() || digits.parse::<f64>().is_err() {
                    return token.to_owned();
                }
                seen += 1;
                let rest = &token[digits.len()..];
                if seen == which { format!("{value:e}{rest}") } else { token.to_owned() }
            })
            .collect();
        if let Ok(loaded) = read_with(&text, &[]) {
            let _ = isolux::scene::Scene::assemble(loaded.value);
        }
    }
}
