//! A row a vertex.

use isolux::map::{IlluminationMap, VertexLight};
use isolux::units::Digits;
use std::fmt::Write;

const HEADER: &str = "x,y,z,nx,ny,nz,area_m2,illuminance_lx,standard_error_lx,direct_lx,indirect_lx,red_lx,\
                      green_lx,blue_lx\n";

/// All vertices of a map, in its order; empty fields where nothing is known.
pub fn csv(map: &IlluminationMap, digits: Digits) -> String {
    let mut text = HEADER.to_owned();
    for (vertex, value) in map.elements.vertices().iter().zip(&map.values) {
        let (p, n) = (vertex.position, vertex.normal.to_vector());
        let fields = value.as_ref().map_or([const { String::new() }; 7], |value| {
            fields(value).map(|number| digits.number(number, value.standard_error_lx))
        });
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{},{},{},{},{},{},{},{}",
            p.x,
            p.y,
            p.z,
            n.x,
            n.y,
            n.z,
            vertex.area_m2,
            fields.join(",")
        );
    }
    text
}

fn fields(value: &VertexLight) -> [f64; 7] {
    let [red, green, blue] = value.total_lx().0;
    [
        value.illuminance_lx(),
        value.standard_error_lx,
        value.direct_lx.luminance(),
        value.indirect_lx.luminance(),
        red,
        green,
        blue,
    ]
}
