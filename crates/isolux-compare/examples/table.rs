#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "an example for the terminal")]
use isolux::map::Method;
use isolux_compare::{ValidateSettings, case::cases, validate};
fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let accuracy: f64 = words[0].parse().unwrap();
    let seeds: u64 = words[1].parse().unwrap();
    for case in cases() {
        if words.len() > 2 && !case.name.contains(&words[2]) {
            continue;
        }
        for method in [Method::Hybrid, Method::Forward] {
            if words.len() > 3 && !format!("{method:?}").to_lowercase().contains(&words[3]) {
                continue;
            }
            for seed in 1..=seeds {
                let s = ValidateSettings { accuracy, ..Default::default() };
                match validate(&case, method, seed, &s) {
                    Ok(r) => println!(
                        "{:22} {:?} {} n {} stat {} out {}/{} outside {} ratio {:.2} worst {:?} acc {:?} inc {} rays {} {:.1}s {:?}",
                        r.case,
                        r.method,
                        r.seed,
                        r.readings,
                        r.statistical,
                        r.outliers,
                        r.accepted_outliers,
                        r.outside_interval,
                        r.worst.map_or(0.0, |w| w.ratio),
                        r.worst.map(|w| (
                            w.position,
                            w.quantity,
                            w.expected_lx,
                            w.measured_lx,
                            w.standard_error_lx,
                            w.bound_lx
                        )),
                        r.accuracy.map(|a| (a.reached, a.statistical, a.discretization, a.bias)),
                        r.increments,
                        r.rays,
                        r.time_s,
                        r.verdict
                    ),
                    Err(e) => println!("{} {e}", case.name),
                }
            }
        }
    }
}
