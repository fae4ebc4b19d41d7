//! Scenes to be judged and the places where they are, as JSON for `cargo xtask bench truth`:
//! `cargo run -p isolux-compare --example truth -- 400 40`, places by area and in every other stratum.
#![expect(clippy::print_stdout, reason = "a program whose result is JSON")]

use isolux::engine::PathTracer;
use isolux::scene::Scene;
use isolux_compare::truth::places::{TruthPlace, places};
use isolux_compare::truth::{Half, TruthScene};
use serde_json::{Value, json};

/// The seed of places.
const SEED: u64 = 1;

fn main() {
    let words: Vec<u32> =
        std::env::args().skip(1).map(|word| word.parse().expect("counts of places")).collect();
    let &[by_area, beside] = &words[..] else { panic!("give two counts of places") };
    let scenes: Vec<Value> = TruthScene::all().map(|of| scene(of, [by_area, beside])).collect();
    println!("{}", Value::Array(scenes));
}

fn scene(of: TruthScene, [by_area, beside]: [u32; 2]) -> Value {
    let scene = Scene::assemble(of.parts()).expect("scenes are valid");
    let half = match of.half() {
        Half::Tuning => "tuning",
        Half::Judging => "judging",
    };
    json!({
        "name": of.name(),
        "kind": of.kind(),
        "half": half,
        "hash": scene.hash(),
        "triangles": scene.triangle_count(),
        "luminaires": scene.luminaires().len() + scene.area_luminaires().len(),
        "leaves_caustics": PathTracer::new(&scene).leaves_caustics(),
        "places": places(&scene, by_area, beside, SEED).iter().map(place).collect::<Vec<_>>(),
    })
}

fn place(TruthPlace { at, surface, stratum }: &TruthPlace) -> Value {
    let (p, n) = (at.position, at.normal.to_vector());
    let point = [p.x, p.y, p.z, n.x, n.y, n.z].map(|c| c.to_string()).join(" ");
    json!({ "point": point, "surface": surface, "stratum": stratum.name() })
}
