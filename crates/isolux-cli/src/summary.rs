//! What a map says of each object: mean, least and most lux.

use crate::console::table;
use crate::quantity::significant;
use crate::shown::name;
use isolux::elements::Element;
use isolux::geometry::Triangle;
use isolux::map::{IlluminationMap, VertexLight};
use isolux::scene::Scene;
use serde::Serialize;

/// Objects shown in text; JSON holds all.
const MAX_SHOWN: usize = 12;

/// The light on one shape: on both sides together, unless one of them gets none at all, as that of walls which looks out of a room.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Lit {
    /// Name of the shape.
    pub shape: String,
    /// Surface that carries a map and gets light, m2.
    pub area_m2: f64,
    /// That of a side left out, as no light comes to it, m2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unlit_side_m2: Option<f64>,
    /// Share of it where the value is known.
    pub known: f64,
    /// Mean over the known part, lx.
    pub mean_lx: Option<f64>,
    /// Least value at a vertex, lx.
    pub min_lx: Option<f64>,
    /// Greatest value at a vertex, lx.
    pub max_lx: Option<f64>,
}

/// All shapes that carry a map, the largest first.
pub(crate) fn by_shape(scene: &Scene, map: &IlluminationMap) -> Vec<Lit> {
    let mut sums = vec![[Sum::default(); 2]; scene.shape_names().len()];
    for element in map.elements.elements() {
        let sides = &mut sums[scene.shape_of(element.triangle) as usize];
        sides[usize::from(element.back)].add(map, &element);
    }
    let shapes = scene.shape_names().iter().zip(&sums);
    let mut lit: Vec<Lit> = shapes.filter_map(|(name, sides)| lit(name, *sides)).collect();
    lit.sort_by(|a, b| b.area_m2.total_cmp(&a.area_m2));
    lit
}

/// As a table.
pub(crate) fn text(lit: &[Lit]) -> String {
    let lux = |value: Option<f64>| value.map_or("-".to_owned(), |lx| significant(lx, 3));
    let row = |l: &Lit| {
        vec![
            name(&l.shape),
            significant(l.area_m2, 3),
            lux(l.mean_lx),
            lux(l.min_lx),
            lux(l.max_lx),
            format!("{:.0} %", 100.0 * l.known),
        ]
    };
    let rows: Vec<Vec<String>> = lit.iter().take(MAX_SHOWN).map(row).collect();
    let mut text = table(&["surface", "m2", "mean lx", "min lx", "max lx", "known"], &rows);
    if lit.iter().any(|l| l.unlit_side_m2.is_some()) {
        text += "of surfaces lit on one side, only that side counts\n";
    }
    if lit.len() > MAX_SHOWN {
        text += &format!("and {} smaller ones; --json lists all\n", lit.len() - MAX_SHOWN);
    }
    text
}

/// None where a shape carries no map.
fn lit(shape: &str, sides: [Sum; 2]) -> Option<Lit> {
    let [front, back] = sides;
    let (sum, left_out) = match sides.map(|side| side.is_unlit()) {
        [false, true] if front.is_lit() => (front, Some(back)),
        [true, false] if back.is_lit() => (back, Some(front)),
        _ => (front.and(back), None),
    };
    (sum.area_m2 > 0.0).then(|| Lit {
        shape: shape.to_owned(),
        area_m2: sum.area_m2,
        unlit_side_m2: left_out.map(|side| side.area_m2),
        known: sum.known_m2 / sum.area_m2,
        mean_lx: (sum.known_m2 > 0.0).then(|| sum.flux_lm / sum.known_m2),
        min_lx: sum.range_lx.map(|(low, _)| low),
        max_lx: sum.range_lx.map(|(_, high)| high),
    })
}

/// What is known of one side of a shape.
#[derive(Clone, Copy, Default)]
struct Sum {
    area_m2: f64,
    known_m2: f64,
    flux_lm: f64,
    range_lx: Option<(f64, f64)>,
}

impl Sum {
    fn add(&mut self, map: &IlluminationMap, element: &Element) {
        let vertices = map.elements.vertices();
        let corners = element.vertices.map(|v| vertices[v as usize].position);
        let third_m2 = Triangle { corners }.area() / 3.0;
        self.area_m2 += 3.0 * third_m2;
        for vertex in element.vertices {
            let Some(value) = &map.read_at_vertex(vertex) else { continue };
            let lx = VertexLight::illuminance_lx(value);
            self.known_m2 += third_m2;
            self.flux_lm += third_m2 * lx;
            self.range_lx = Some(range(self.range_lx, (lx, lx)));
        }
    }

    /// Whether it is known that no light comes anywhere.
    fn is_unlit(&self) -> bool {
        self.range_lx == Some((0.0, 0.0))
    }

    /// Whether it is known that light comes somewhere.
    fn is_lit(&self) -> bool {
        self.range_lx.is_some_and(|(_, high)| high > 0.0)
    }

    fn and(self, other: Self) -> Self {
        let one = self.range_lx.or(other.range_lx);
        Self {
            area_m2: self.area_m2 + other.area_m2,
            known_m2: self.known_m2 + other.known_m2,
            flux_lm: self.flux_lm + other.flux_lm,
            range_lx: one.map(|one| range(other.range_lx, one)),
        }
    }
}

/// A range widened by another.
fn range(before: Option<(f64, f64)>, (low, high): (f64, f64)) -> (f64, f64) {
    before.map_or((low, high), |before| (before.0.min(low), before.1.max(high)))
}
