//! The ambient term of radiosity, as readers have it.

use super::*;
use crate::engine::{SolveRequest, Watch, solve};
use crate::map::{IlluminationMap, Method, Unshot};

#[test]
fn its_error_is_alike_in_all_readings() {
    let walls = inward_box([3.0, 2.0, 2.5], 0);
    let scene =
        scene(walls, vec![painted(Rgb::grey(0.5))], vec![isotropic([1.0, 1.2, 1.5], 100.0)]);
    let request =
        SolveRequest { method: Method::Radiosity, accuracy: Some(0.2), ..SolveRequest::default() };
    let mut map = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap().map;
    let (ambient_lx, doubt_lx) = (Rgb::new(3.0, 2.0, 1.0), 1.5);
    let read = |map: &IlluminationMap| map.interpolate(0, false, 0.3, 0.4).unwrap();
    map.provenance.unshot = Some(Unshot { share: 0.0, ambient_lx: Rgb::BLACK, doubt_lx: 0.0 });
    let without = read(&map);
    map.provenance.unshot = Some(Unshot { share: 0.1, ambient_lx, doubt_lx });
    let with = read(&map);
    assert_eq!(with.indirect_lx, without.indirect_lx + ambient_lx);
    // It is not a mean of what three vertices have of it.
    assert_eq!(with.standard_error_lx, libm::hypot(without.standard_error_lx, doubt_lx));
    let vertex = map.read_at_vertex(0).unwrap();
    assert!(vertex.indirect_standard_error_lx >= doubt_lx);
}
