//! What a map says of each object: mean, least and most lux.

use crate::console::table;
use crate::quantity::significant;
use isolux::elements::Element;
use isolux::geometry::Triangle;
use isolux::map::{Illuminance, IlluminationMap};
use isolux::scene::Scene;
use serde::Serialize;

/// Objects shown in text; JSON holds all.
const MAX_SHOWN: usize = 12;

/// The light on one shape, both sides together.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Lit {
    /// Name of the shape.
    pub shape: String,
    /// Surface that carries a map, m2.
    pub area_m2: f64,
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
    let mut sums = vec![Sum::default(); scene.shape_names().len()];
    for element in map.elements.elements() {
        sums[scene.shape_of(element.triangle) as usize].add(map, &element);
    }
    let shapes = scene.shape_names().iter().zip(&sums).filter(|(_, sum)| sum.area_m2 > 0.0);
    let mut lit: Vec<Lit> = shapes.map(|(name, sum)| sum.lit(name)).collect();
    lit.sort_by(|a, b| b.area_m2.total_cmp(&a.area_m2));
    lit
}

/// As a table.
pub(crate) fn text(lit: &[Lit]) -> String {
    let lux = |value: Option<f64>| value.map_or("-".to_owned(), |lx| significant(lx, 3));
    let row = |l: &Lit| {
        vec![
            l.shape.clone(),
            significant(l.area_m2, 3),
            lux(l.mean_lx),
            lux(l.min_lx),
            lux(l.max_lx),
            format!("{:.0} %", 100.0 * l.known),
        ]
    };
    let rows: Vec<Vec<String>> = lit.iter().take(MAX_SHOWN).map(row).collect();
    let mut text = table(&["surface", "m2", "mean lx", "min lx", "max lx", "known"], &rows);
    if lit.len() > MAX_SHOWN {
        text += &format!("and {} smaller ones; --json lists all\n", lit.len() - MAX_SHOWN);
    }
    text
}

#[derive(Clone, Default)]
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
            let lx = Illuminance::illuminance_lx(value);
            self.known_m2 += third_m2;
            self.flux_lm += third_m2 * lx;
            let (low, high) = self.range_lx.unwrap_or((lx, lx));
            self.range_lx = Some((low.min(lx), high.max(lx)));
        }
    }

    fn lit(&self, shape: &str) -> Lit {
        Lit {
            shape: shape.to_owned(),
            area_m2: self.area_m2,
            known: self.known_m2 / self.area_m2,
            mean_lx: (self.known_m2 > 0.0).then(|| self.flux_lm / self.known_m2),
            min_lx: self.range_lx.map(|(low, _)| low),
            max_lx: self.range_lx.map(|(_, high)| high),
        }
    }
}
