//! Prints the light of the hall at places of its surfaces as the path tracer finds it, as CSV:
//! `cargo xtask bench hall --reference` keeps it in `benchmarks/hall/`.
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program whose result is a table")]

use isolux::engine::{ExactSettings, PathTracer};
use isolux::map::Illuminance;
use isolux::scene::Scene;
use isolux_compare::hall::places::{HallPlace, at_corners, by_area};
use isolux_compare::hall::{Variant, parts};
use rayon::prelude::*;

/// Places of either kind that are kept, and how many are tried: no light reaches some of them.
const KEPT: [usize; 2] = [1500, 500];
const TRIED: [u32; 2] = [2000, 800];
/// Paths of one replicate, unless another number is given.
const PATHS: u32 = 256;

fn main() {
    let rays = std::env::args().nth(1).map_or(PATHS, |word| word.parse().expect("paths, a number"));
    let settings = ExactSettings { rays, ..ExactSettings::default() };
    let scene = Scene::assemble(parts(Variant::STANDARD)).expect("the hall is a valid scene");
    let tracer = PathTracer::new(&scene);
    println!("x,y,z,nx,ny,nz,total_lx,direct_lx,indirect_lx,stderr_lx,kind,surface");
    let kinds = [("area", by_area(&scene, TRIED[0])), ("corner", at_corners(&scene, TRIED[1]))];
    for ((kind, places), count) in kinds.iter().zip(KEPT) {
        let mut left = count;
        // A few at a time: what is kept is enough long before all are tried.
        for part in places.chunks(50) {
            let values: Vec<Illuminance> =
                part.par_iter().map(|place| tracer.estimate(place.at, &settings)).collect();
            let lit = part.iter().zip(&values).filter(|(_, value)| value.illuminance_lx() > 0.0);
            for (place, value) in lit.take(left) {
                println!("{}", row(place, value, kind));
                left -= 1;
            }
            eprintln!("{kind}: {left} of {count} left");
            if left == 0 {
                break;
            }
        }
    }
}

fn row(HallPlace { surface, at }: &HallPlace, value: &Illuminance, kind: &str) -> String {
    let (p, n) = (at.position, at.normal.to_vector());
    let place = [p.x, p.y, p.z, n.x, n.y, n.z].map(|c| c.to_string()).join(",");
    let (direct, indirect) = (value.direct_lx.luminance(), value.indirect_lx.luminance());
    let light = [direct + indirect, direct, indirect, value.standard_error_lx];
    let light = light.map(|lx| format!("{lx:.4}")).join(",");
    format!("{place},{light},{kind},{surface}")
}
