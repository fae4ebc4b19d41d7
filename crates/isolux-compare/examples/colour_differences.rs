//! Differences of pairs of colours, and colours beside their whites, from JSON to JSON: what `checks/colour` judges.
//! `{"pairs": [[[L, a, b], [L, a, b]], ...], "xyz_and_white": [[[X, Y, Z], [X, Y, Z]], ...]}` on standard input;
//! the first of each pair is the reference.
#![expect(clippy::print_stdout, reason = "a program whose result is JSON")]

use isolux_compare::metric::{DeltaE, Lab, White};
use serde::Deserialize;
use serde_json::{Map, json};

#[derive(Deserialize)]
struct Colours {
    pairs: Vec<[[f64; 3]; 2]>,
    xyz_and_white: Vec<[[f64; 3]; 2]>,
}

fn main() {
    let colours: Colours = serde_json::from_reader(std::io::stdin()).expect("JSON of colours");
    let lab: Vec<Lab> = colours.xyz_and_white.iter().map(beside_white).collect();
    let mut differences = Map::new();
    for formula in DeltaE::ALL {
        let name = json!(formula).as_str().expect("formulas have names").to_owned();
        let between = |&[one, other]: &[[f64; 3]; 2]| formula.between(one.into(), other.into());
        differences.insert(name, colours.pairs.iter().map(between).collect());
    }
    println!("{}", json!({ "differences": differences, "lab": lab }));
}

fn beside_white(&[xyz, white]: &[[f64; 3]; 2]) -> Lab {
    Lab::from_xyz(xyz.into(), White::new(white.into()).expect("a white is above zero"))
}
