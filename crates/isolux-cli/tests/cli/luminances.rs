//! Luminances of grids as an eye sees them.

use crate::ran::Home;

/// An open floor of reflectance 0.5 with a lamp of 1000 cd at 2 m over its middle, and a black board before one of the four points.
const ROOM: &str = "name = \"floor\"\n[materials.grey]\ndiffuse = 0.5\n[materials.black]\ndiffuse = 0\n\
    [[geometry]]\npolygon = [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]]\nmaterial = \"grey\"\n\
    [[geometry]]\npolygon = [[1.3, 1.2, 0], [1.8, 1.2, 0], [1.8, 1.2, 0.2], [1.3, 1.2, 0.2]]\nmaterial = \"black\"\n\
    [[luminaire]]\nposition = [2, 2, 2]\nisotropic = { intensity_cd = 1000 }\n\
    [[grid]]\nname = \"road\"\ncorner = [1, 1, 0]\nu = [2, 0, 0]\nv = [0, 2, 0]\nspacing = 1\n\
    maintenance_factor = 0.8\n";

const GRID: [&str; 6] = ["grid", "room.toml", "--quantity", "luminance", "--eye", "2,-3,1.5"];

#[test]
fn luminances_are_those_of_diffuse_reflection() {
    let home = Home::new();
    home.file("room.toml", ROOM);
    let ran = home.run(&[&GRID[..], &["--json", "--csv", "road.csv"]].concat());
    assert_eq!(ran.code, 0, "{ran:?}");
    assert!(ran.err.contains("1 point is hidden"), "{}", ran.err);
    let road = &ran.json()["grids"][0];
    assert_eq!(road["known"], 3, "{road}");
    assert_eq!(road["hidden"], 1, "{road}");
    assert!(road["values"][0]["luminance_cd_m2"].is_null(), "{road}");
    let squared = 4.0 + 2.0 * 0.25;
    let lx = 1000.0 * 2.0 / (squared * f64::sqrt(squared));
    let expected = 0.8 * 0.5 * lx / std::f64::consts::PI;
    let found = road["mean_cd_m2"]["value"].as_f64().unwrap();
    // The field of the meter is some centimetres of floor, and pictures are single precision.
    assert!((found / expected - 1.0).abs() < 1e-3, "{found} for {expected}");
    assert!(road["uniformity"]["value"].as_f64().unwrap() > 0.999, "{road}");
    let csv = std::fs::read_to_string(home.path("road.csv")).unwrap();
    assert!(
        csv.starts_with("grid,i,j,x,y,z,luminance_cd_m2,") && csv.lines().count() == 5,
        "{csv}"
    );
    assert!(csv.lines().nth(1).unwrap().ends_with(",,,0.8"), "{csv}");
    let text = home.run(&GRID).out;
    assert!(text.contains("Lm, cd/m2") && text.contains("hidden"), "{text}");
}

#[test]
fn what_says_nothing_of_luminances_is_refused() {
    let home = Home::new();
    home.file("room.toml", ROOM);
    for (flags, words) in [
        (&GRID[..4], "add --eye"),
        (&["grid", "room.toml", "--eye", "0,0,1"], "add --quantity luminance"),
        (&[&GRID[..], &["--require", "Em >= 5"]].concat()[..], "--require is for illuminances"),
        (&[&GRID[..], &["-o", "plan.png"]].concat(), "--picture is for illuminances"),
    ] {
        let ran = home.run(flags);
        assert!(ran.code == 2 && ran.err.contains(words), "{flags:?}: {ran:?}");
    }
    let above = home.run(
        &[
            &["grid", "room.toml", "--corner", "1,1,0.1", "--u", "2,0,0", "--v", "0,2,0"],
            &GRID[2..],
        ]
        .concat(),
    );
    assert!(above.err.contains("put the grid on what is looked at"), "{above:?}");
}
