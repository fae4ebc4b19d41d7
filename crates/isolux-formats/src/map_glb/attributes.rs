//! Vertex attributes of the displayed geometry.

use super::bytes::Bytes;
use super::display::Surface;
use super::document::{Accessor, Attributes, INDICES, LightAttributes, VERTICES};
use super::preview::{Preview, luminance_cd_m2};
use super::value_arrays::storable;
use isolux::map::VertexLight;
use isolux::scene::Finish;
use isolux::units::Rgb;
use std::collections::BTreeMap;

const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
/// Standard error where the illuminance is not known.
const UNKNOWN: f32 = -1.0;
/// Standard error where the illuminance is known but not its error.
const NO_ESTIMATE: f32 = -2.0;

/// Where attributes go.
pub(super) struct Sink<'a> {
    pub(super) bytes: &'a mut Bytes,
    pub(super) accessors: &'a mut Vec<Accessor>,
}

impl Sink<'_> {
    /// Writes the geometry of a surface: its attributes (without light) and its indices.
    pub(super) fn geometry(&mut self, surface: &Surface) -> (Attributes, u32) {
        let position = self.floats(&surface.positions, "VEC3");
        let accessor = &mut self.accessors[position as usize];
        (accessor.min, accessor.max) = bounds(&surface.positions);
        let normal = self.floats(&surface.normals, "VEC3");
        let texcoord = (!surface.uvs.is_empty()).then(|| self.floats(&surface.uvs, "VEC2"));
        let indices = surface.indices.iter().flat_map(|i| i.to_le_bytes()).collect();
        let layout = Layout { target: INDICES, component: UNSIGNED_INT, kind: "SCALAR" };
        let indices = self.add(indices, surface.indices.len(), layout);
        let attributes = Attributes {
            position,
            normal,
            texcoord,
            lightmap_texcoord: None,
            colour: None,
            light: None,
        };
        (attributes, indices)
    }

    /// Writes what a map says about the vertices of a surface: their colour and the rest.
    pub(super) fn coloured_light(
        &mut self,
        values: &[Option<VertexLight>],
        (finish, preview): (&Finish, &Preview),
    ) -> (u32, LightAttributes) {
        let values = shown(values);
        let colours =
            values.iter().map(|v| preview.colour(luminance_cd_m2(finish, seen_lx(v.as_ref()))));
        let colour = self.colours(&colours.collect::<Vec<_>>());
        (colour, self.light(&values, &[]))
    }

    /// Writes the light at the vertices of a surface, and that of each group; all values are [`shown`] ones.
    pub(super) fn light(
        &mut self,
        values: &[Option<VertexLight>],
        groups: &[Vec<Option<VertexLight>>],
    ) -> LightAttributes {
        let mut light = LightAttributes {
            illuminance_lx: self.rgb_lx(values, VertexLight::total_lx),
            direct_lx: self.rgb_lx(values, |v| v.direct_lx),
            standard_error_lx: self.errors_lx(values),
            groups: BTreeMap::new(),
        };
        for (k, values) in groups.iter().enumerate() {
            let lx = self.rgb_lx(values, VertexLight::total_lx);
            light.groups.insert(format!("_GROUP_{k}_LX"), lx);
            light.groups.insert(format!("_GROUP_{k}_STDERR_LX"), self.errors_lx(values));
        }
        light
    }

    fn rgb_lx(&mut self, values: &[Option<VertexLight>], of: fn(&VertexLight) -> Rgb) -> u32 {
        let row =
            |v: &Option<VertexLight>| v.as_ref().map_or([0.0; 3], |v| of(v).0.map(|c| c as f32));
        self.floats(&values.iter().map(row).collect::<Vec<_>>(), "VEC3")
    }

    fn errors_lx(&mut self, values: &[Option<VertexLight>]) -> u32 {
        let errors: Vec<[f32; 1]> = values.iter().map(|v| [shown_error(v.as_ref())]).collect();
        self.floats(&errors, "SCALAR")
    }

    /// Writes the places of vertices in a lightmap.
    pub(super) fn lightmap_uvs(&mut self, uvs: &[[f32; 2]]) -> u32 {
        self.floats(uvs, "VEC2")
    }

    /// Opaque colours in 32-bit floats.
    pub(super) fn float_colours(&mut self, pixels: &[[f64; 3]]) -> u32 {
        let rows: Vec<[f32; 3]> = pixels.iter().map(|rgb| rgb.map(|c| c as f32)).collect();
        self.floats(&rows, "VEC3")
    }

    fn floats<const N: usize>(&mut self, rows: &[[f32; N]], kind: &'static str) -> u32 {
        let bytes = rows.iter().flatten().flat_map(|v| v.to_le_bytes()).collect();
        self.add(bytes, rows.len(), Layout { target: VERTICES, component: FLOAT, kind })
    }

    /// Opaque colours in 16 bits a channel: in linear light, 8 bits show steps in the shadows.
    pub(super) fn colours(&mut self, pixels: &[[f64; 3]]) -> u32 {
        // Conversions of floats saturate.
        let quantized = |c: f64| (c * f64::from(u16::MAX)).round() as u16;
        let bytes = pixels
            .iter()
            .flat_map(|&[r, g, b]| [r, g, b, 1.0].map(quantized))
            .flat_map(u16::to_le_bytes)
            .collect();
        let layout = Layout { target: VERTICES, component: UNSIGNED_SHORT, kind: "VEC4" };
        let index = self.add(bytes, pixels.len(), layout);
        self.accessors[index as usize].normalized = true;
        index
    }

    fn add(&mut self, bytes: Vec<u8>, count: usize, layout: Layout) -> u32 {
        self.accessors.push(Accessor {
            buffer_view: self.bytes.view(&bytes, Some(layout.target)),
            component_type: layout.component,
            normalized: false,
            count,
            kind: layout.kind,
            min: None,
            max: None,
        });
        self.accessors.len() as u32 - 1
    }
}

struct Layout {
    target: u32,
    component: u32,
    kind: &'static str,
}

/// The values of which a viewer can be told.
pub(super) fn shown(values: &[Option<VertexLight>]) -> Vec<Option<VertexLight>> {
    values.iter().map(|value| value.and_then(storable).filter(is_shown)).collect()
}

/// The light that a surface is shown in: none where nothing is known, as what no light is known to reach must not glow.
pub(super) fn seen_lx(value: Option<&VertexLight>) -> Rgb {
    value.map_or(Rgb::BLACK, VertexLight::total_lx)
}

/// Whether a viewer can be given a value: attributes must be finite in 32 bits.
fn is_shown(value: &VertexLight) -> bool {
    let fits = |c: &f64| (*c as f32).is_finite();
    value.total_lx().0.iter().chain(&value.direct_lx.0).all(fits)
}

fn shown_error(value: Option<&VertexLight>) -> f32 {
    match value {
        None => UNKNOWN,
        Some(value) => {
            let error = value.standard_error_lx as f32;
            if error.is_finite() && error >= 0.0 { error } else { NO_ESTIMATE }
        }
    }
}

type Corner = Option<[f64; 3]>;

fn bounds(positions: &[[f32; 3]]) -> (Corner, Corner) {
    let extreme = |pick: fn(f32, f32) -> f32| {
        positions.iter().copied().reduce(|a, b| std::array::from_fn(|k| pick(a[k], b[k])))
    };
    (extreme(f32::min).map(|p| p.map(f64::from)), extreme(f32::max).map(|p| p.map(f64::from)))
}
