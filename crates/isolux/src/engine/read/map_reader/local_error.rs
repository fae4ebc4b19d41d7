//! The local factor on the errors of a map.
//!
//! A map reports its error over the whole scene, as a share of all light. Lookup and interpolation errors
//! arrive with the light that was read, so the figure is wrong for a dim room beside a bright one. Every
//! vertex therefore has a factor on it, from the light of surfaces that it sees and that see it. In a single
//! room the factor is about the same everywhere. Elements of a dim room may be coarse for its light, so the
//! factor from their expected errors counts if it is larger. Both factors are relative to their own root mean
//! square over the surface, so over all of it the reported errors hold.

use super::effort::LOOKS;
use super::state::MapReader;
use crate::ablation::without;
use crate::elements::Element;
use crate::engine::gather::{DirectAtEnds, Gatherer, Gathering, Operator};
use crate::engine::ray::{SurfacePoint, place_key};
use crate::map::VertexLight;
use crate::sampling::Key;
use crate::units::Rgb;

/// The number of reflections over which surroundings are averaged, as in the pilot.
const REFLECTIONS: usize = 3;
/// The most rays per element; the least is one. About a vertex there are half a dozen elements, whose views
/// count together.
const MOST_RAYS: u32 = 2;
/// The total number of rays of all elements, unless there are more elements.
const RAYS: usize = 1 << 16;

/// An element that gathers from its centroid.
struct Looking<'e> {
    element: &'e Element,
    gatherer: Gatherer,
    area_m2: f64,
}

impl MapReader<'_> {
    /// The factors of all vertices, relative to their root mean square, and the root mean square of the
    /// factors that arrive after one reflection. Empty where the map does not know its error.
    pub(super) fn parts_of_vertices(&self) -> (Vec<Rgb>, f64) {
        if self.map.provenance.accuracy.is_none() {
            return (Vec::new(), 0.0);
        }
        let all = self.map.elements.elements();
        let is_known = |v: u32| self.standings[v as usize].is_some();
        let of_each = RAYS.checked_div(all.len()).map_or(0, |rays| rays as u32).clamp(1, MOST_RAYS);
        let looking = |element| {
            let (gatherer, area_m2) = self.amid(element);
            Looking { element, gatherer: gatherer.with_rays(of_each), area_m2 }
        };
        let known = all.iter().filter(|element| element.vertices.into_iter().any(is_known));
        let elements: Vec<Looking<'_>> = known.map(looking).collect();
        let rows: Vec<Gatherer> = elements.iter().map(|looking| looking.gatherer).collect();
        let dark = self.dark();
        let key = Key::new(self.map.provenance.seed).with(18);
        let operator = self.reading_alone(&dark).operator(&rows, |row| key.with(row as u64));
        self.count(operator.rays);
        let of = |read: &dyn Fn(&VertexLight) -> f64| {
            let read = self.map.values.iter().map(|v| v.as_ref().map_or(0.0, read)).collect();
            self.relative(self.about(&operator, &elements, read))
        };
        let ambient_lx = self.map.ambient_lx().luminance();
        let by_light = of(&|value| value.illuminance_lx() + ambient_lx);
        // Where more error is expected, readers gather.
        let trusted_lx = self.map.provenance.fresh.and_then(|fresh| fresh.above_lx);
        let most_lx = trusted_lx.unwrap_or(f64::INFINITY);
        let expected = |value: &VertexLight| value.interpolation_error_lx;
        let by_elements =
            of(&|value| Some(expected(value)).filter(|e| *e <= most_lx).unwrap_or(0.0));
        let of_vertices: Vec<Rgb> =
            by_light.into_iter().zip(by_elements).map(|(a, b)| Rgb::grey(a.max(b))).collect();
        let seen = operator.reflected(&of_vertices);
        let seen = elements.iter().zip(seen).map(|(of, seen)| (of.area_m2, seen.luminance()));
        (of_vertices, root_mean_square(seen))
    }

    /// The mean of some vertex values over the surroundings of every vertex: over the surfaces it sees and
    /// their surroundings in turn, weighted by reflected light. A vertex that sees nothing keeps its own
    /// value.
    fn about(&self, operator: &Operator, elements: &[Looking<'_>], own: Vec<f64>) -> Vec<f64> {
        let whole = operator.reflected(&vec![Rgb::grey(1.0); own.len()]);
        let mut about = own;
        for _ in 0..REFLECTIONS {
            let read: Vec<Rgb> = about.iter().copied().map(Rgb::grey).collect();
            let mut sums = vec![[0.0; 2]; about.len()];
            let seen = operator.reflected(&read);
            for ((looking, seen), whole) in elements.iter().zip(seen).zip(&whole) {
                let Looking { element, area_m2, .. } = looking;
                for vertex in element.vertices {
                    let [sum, share] = &mut sums[vertex as usize];
                    *sum += area_m2 * seen.luminance();
                    *share += area_m2 * whole.luminance();
                }
            }
            for (about, [sum, share]) in about.iter_mut().zip(sums) {
                if share > 0.0 {
                    *about = sum / share;
                }
            }
        }
        about
    }

    /// Values of vertices divided by their root mean square on the known surface.
    fn relative(&self, values: Vec<f64>) -> Vec<f64> {
        let vertices = self.map.elements.vertices().iter().zip(&self.standings).zip(&values);
        let known = vertices.filter(|((_, standing), _)| standing.is_some());
        let over = root_mean_square(known.map(|((vertex, _), value)| (vertex.area_m2, *value)));
        values.into_iter().map(|value| if over > 0.0 { value / over } else { 0.0 }).collect()
    }

    /// The local factor of a place on a surface.
    pub(super) fn part_at(&self, at: &SurfacePoint) -> f64 {
        if self.local.of_vertices.is_empty() || without("local-errors") {
            return 1.0;
        }
        let Some(corners) = self.map.elements.locate(at.triangle, at.back, at.u, at.v) else {
            return 1.0;
        };
        corners
            .iter()
            .map(|&(v, weight)| weight * self.local.of_vertices[v as usize].luminance())
            .sum()
    }

    /// The local factor of a gatherer, on a surface or in space: the mean of the factors that arrive from the
    /// surfaces it sees. Vertices about it may lie beyond an obstacle.
    pub(super) fn part_of(&self, from: &Gatherer) -> f64 {
        if self.local.of_vertices.is_empty() || without("local-errors") {
            return 1.0;
        }
        let dark = self.dark();
        let key = place_key(from.surface.point).with(19);
        let operator = self.reading_alone(&dark).operator(&[from.with_rays(LOOKS)], |_| key);
        let arrives = operator.reflected(&self.local.of_vertices)[0].luminance();
        if self.local.arriving > 0.0 { arrives / self.local.arriving } else { 0.0 }
    }

    fn dark(&self) -> Vec<Rgb> {
        vec![Rgb::BLACK; self.map.values.len()]
    }

    /// Rays that read vertices as readings do, without direct light.
    fn reading_alone<'b>(&'b self, dark: &'b [Rgb]) -> Gathering<'b> {
        let direct = DirectAtEnds::Read { values: dark, level: u32::MAX };
        Gathering { backdrop: None, ..self.gathering(direct) }
    }
}

/// The root mean square of values, each with the area that it stands for, m2.
fn root_mean_square(values: impl Iterator<Item = (f64, f64)>) -> f64 {
    let sum = |[area_m2, squared]: [f64; 2], (of_m2, value): (f64, f64)| {
        [area_m2 + of_m2, squared + of_m2 * value * value]
    };
    let [area_m2, squared] = values.fold([0.0; 2], sum);
    if area_m2 > 0.0 { (squared / area_m2).sqrt() } else { 0.0 }
}
