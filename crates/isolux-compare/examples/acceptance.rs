//! Measured against reported error of CUBE and SPHERE, seed by seed:
//! `cargo run --release -p isolux-compare --example acceptance -- cube 0.01 1 20`.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "an example for the terminal")]

use isolux::engine::{Progress, Solution, SolveRequest, Watch, solve};
use isolux::map::Method;
use isolux::scene::Scene;
use isolux_compare::{Readings, builtin};

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let accuracy: f64 = words[1].parse().unwrap();
    let (first, last): (u64, u64) = (words[2].parse().unwrap(), words[3].parse().unwrap());
    let method = if words.len() > 4 { Method::Forward } else { Method::Hybrid };
    let scene = Scene::assemble(builtin(&words[0]).unwrap()).unwrap();
    for seed in first..=last {
        let request =
            SolveRequest { method, accuracy: Some(accuracy), seed, ..SolveRequest::default() };
        let Solution { map, time_s, .. } = solve(&scene, &request, None, &mut |p: &Progress| {
            if std::env::var("TRACE").is_ok() {
                println!(
                    "{:?} {} {:.2}s {:?} {}",
                    p.stage, p.increments, p.elapsed_s, p.accuracy, p.receivers
                );
            }
            Watch::Continue
        })
        .unwrap();
        let readings = Readings::of_map(&words[0], &scene, &map).unwrap().unwrap();
        let (point, grid) = (readings.points_error().unwrap(), readings.grid_error().unwrap());
        let p = &map.provenance;
        let a = p.accuracy.unwrap();
        println!(
            "seed {seed}: {:.2} s {} inc {} rays {:.1} Mrays/s reported {:.5} (stat {:.5} disc {:.5} bias {:.5} \
             interp {:.5}) points {point:.5} ({:.2}) grid {grid:.5} ({:.2}) receivers {}",
            time_s,
            p.increments,
            p.rays,
            p.rays as f64 / time_s / 1e6,
            a.reached,
            a.statistical,
            a.discretization,
            a.bias,
            a.interpolated,
            point / a.reached,
            grid / a.reached,
            map.values.len()
        );
    }
}
