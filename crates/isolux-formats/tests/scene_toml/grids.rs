//! Calculation grids.

use super::{FLOOR, near, problems, read};
use isolux::geometry::Vector;

#[test]
fn grids_are_in_the_units_of_the_file() {
    let text = format!(
        "units = \"cm\"\n[[grid]]\nname = \"desk\"\ncorner = [100, 50, 75]\nu = [160, 0, 0]\n\
         v = [0, 80, 0]\nspacing = 20\nborder = 10\nmaintenance_factor = 0.8\n\
         [[grid]]\ncorner = [0, 0, 0]\nu = [100, 0, 0]\nv = [0, 100, 0]\n{FLOOR}"
    );
    let grids = read(&text).grids;
    let desk = &grids[0];
    assert!(near(desk.corner - isolux::geometry::Point::ORIGIN, [1.0, 0.5, 0.75]), "{desk:?}");
    assert!(near(desk.u, [1.6, 0.0, 0.0]) && near(desk.v, [0.0, 0.8, 0.0]));
    assert_eq!((desk.spacing_m, desk.border_m, desk.maintenance_factor), (Some(0.2), 0.1, 0.8));
    assert_eq!(desk.counts(), [7, 3]);
    assert_eq!((grids[1].name.as_str(), grids[1].spacing_m), ("grid 2", None));
    assert_eq!(grids[1].normal().map(|n| n.to_vector()), Some(Vector::new(0.0, 0.0, 1.0)));
}

#[test]
fn a_maintenance_factor_is_on_luminaires_or_on_grids() {
    let lamp = "[[luminaire]]\nposition = [0, 0, 2]\nisotropic = { intensity_cd = 10 }\n";
    let maintained = format!("{lamp}maintenance_factor = 0.8\n");
    let grid = "[[grid]]\ncorner = [0, 0, 0]\nu = [1, 0, 0]\nv = [0, 1, 0]\n";
    let range = |text: &str| read(text).maintenance.map(|m| (m.least, m.greatest));
    assert_eq!(range(&format!("{lamp}{grid}maintenance_factor = 0.8\n{FLOOR}")), None);
    assert_eq!(range(&format!("{maintained}{grid}{FLOOR}")), Some((0.8, 0.8)));
    assert_eq!(range(&format!("{maintained}{lamp}{grid}{FLOOR}")), Some((0.8, 1.0)));
    let found = problems(&format!("{maintained}{grid}maintenance_factor = 0.8\n{FLOOR}"));
    assert!(found.len() == 1 && found[0].contains("counts once"), "{found:?}");
}

#[test]
fn what_is_no_grid_is_told_with_its_line() {
    for (wrong, told) in [
        ("v = [1, 1, 0]", "not at right angles"),
        ("v = [0, 1, 0]\nborder = 0.5", "leaves nothing"),
        ("v = [0, 1, 0]\nmaintenance_factor = 80", "maintenance factor of 80"),
        ("v = [0, 1, 0]\nspacing = 1e-6", "has points every"),
    ] {
        let text = format!("[[grid]]\ncorner = [0, 0, 0]\nu = [1, 0, 0]\n{wrong}\n{FLOOR}");
        let found = problems(&text);
        assert!(found.len() == 1 && found[0].contains(told), "{found:?}");
    }
    let unknown = "[[grid]]\ncorner = [0, 0, 0]\nu = [1, 0, 0]\nv = [0, 1, 0]\nheight = 3\n";
    assert!(problems(&format!("{unknown}{FLOOR}"))[0].contains("height"));
}
