//! Layouts by the crate `uvunwrap`.

use super::charts::{Patch, Placed, UnwrapError, UnwrapRequest, Unwrapped, Unwrapper};
use isolux_geometry::Point;
use std::collections::BTreeMap;
use uvunwrap::{Atlas, Density, Error, MeshInput, Options, OutputMesh};

/// Charts by region growing, least squares conformal maps and as-rigid-as-possible iterations, packed by shape, as the
/// crate `uvunwrap` does it: without its direct solver, so that the result is the same on every machine.
#[derive(Clone, Copy, Debug, Default)]
pub struct UvUnwrap;

impl Unwrapper for UvUnwrap {
    fn unwrap(&self, patches: &[Patch], request: &UnwrapRequest) -> Result<Unwrapped, UnwrapError> {
        let inputs: Vec<MeshInput> = patches
            .iter()
            .map(|patch| MeshInput {
                seams: Some(&patch.creases),
                ..MeshInput::new(&patch.positions, patch.triangles.as_flattened())
            })
            .collect();
        // One page that grows to fit, where it stays small enough.
        let atlas = match generate(&inputs, request, None) {
            Ok(atlas) if atlas.width <= request.page && atlas.height <= request.page => {
                squarer(&inputs, request, atlas)
            }
            Ok(_) | Err(UnwrapError::TooLarge) => generate(&inputs, request, Some(request.page)),
            Err(other) => Err(other),
        }?;
        let placed = atlas.meshes.iter().map(placed).collect();
        let Atlas { width, height, page_count: pages, chart_count: charts, .. } = atlas;
        let meshes = || inputs.iter().map(|input| input.positions).zip(&atlas.meshes);
        let longest = f64::from(longest(request)) - 1.0;
        let densities = meshes()
            .flat_map(|mesh| sizes(mesh, [width, height].map(f64::from)))
            .filter(|size| size.longest_side() >= longest)
            .map(|size| (size.texels / size.area_m2).sqrt());
        let least_texels_per_m = densities.fold(request.texels_per_m, f64::min);
        Ok(Unwrapped { width, height, pages, charts, least_texels_per_m, placed })
    }
}

/// How long a chart may be, texels. One that would be longer gets fewer texels a metre.
fn longest(request: &UnwrapRequest) -> u32 {
    request.page - 2 * request.padding
}

/// How large a chart is.
#[derive(Clone, Copy)]
struct Size {
    area_m2: f64,
    texels: f64,
    low: [f64; 2],
    high: [f64; 2],
}

impl Size {
    const NOTHING: Self =
        Self { area_m2: 0.0, texels: 0.0, low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };

    fn longest_side(&self) -> f64 {
        (self.high[0] - self.low[0]).max(self.high[1] - self.low[1])
    }

    fn add(&mut self, [a, b, c]: [Point; 3], [p, q, r]: [[f64; 2]; 3]) {
        self.area_m2 += 0.5 * (b - a).cross(c - a).length();
        let cross = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
        self.texels += 0.5 * cross.abs();
        for corner in [p, q, r] {
            self.low = [0, 1].map(|k| self.low[k].min(corner[k]));
            self.high = [0, 1].map(|k| self.high[k].max(corner[k]));
        }
    }
}

/// The sizes of the charts of a mesh.
fn sizes((positions, mesh): (&[[f32; 3]], &OutputMesh), page: [f64; 2]) -> Vec<Size> {
    let mut charts: BTreeMap<u32, Size> = BTreeMap::new();
    for corners in mesh.indices.as_chunks::<3>().0 {
        let corners = corners.map(|corner| mesh.vertices[corner as usize]);
        let Some(chart) = corners.iter().find_map(|corner| corner.chart) else { continue };
        let points = corners.map(|corner| positions[corner.xref as usize].map(f64::from).into());
        let texels = corners.map(|corner| [0, 1].map(|k| f64::from(corner.uv[k]) * page[k]));
        charts.entry(chart).or_insert(Size::NOTHING).add(points, texels);
    }
    charts.into_values().collect()
}

/// A page that grows is as wide as its widest chart: large charts make a tower of it. The smallest square that takes
/// all is better, if there is one of no more texels than half as many again.
fn squarer(
    inputs: &[MeshInput<'_>],
    request: &UnwrapRequest,
    atlas: Atlas,
) -> Result<Atlas, UnwrapError> {
    if atlas.height <= 2 * atlas.width {
        return Ok(atlas);
    }
    let texels = f64::from(atlas.width) * f64::from(atlas.height);
    for more in [1.0, 1.15, 1.3, 1.5] {
        let side = ((texels * more).sqrt().ceil() as u32).max(atlas.width).min(request.page);
        let square = generate(inputs, request, Some(side))?;
        if square.page_count == 1 {
            return Ok(square);
        }
    }
    Ok(atlas)
}

fn generate(
    inputs: &[MeshInput<'_>],
    request: &UnwrapRequest,
    page_size: Option<u32>,
) -> Result<Atlas, UnwrapError> {
    let options = Options {
        density: Density::Fixed { texels_per_unit: request.texels_per_m as f32, page_size },
        padding: request.padding,
        max_chart_size: longest(request),
        ..Options::default()
    };
    uvunwrap::generate(inputs, &options).map_err(|error| match error {
        Error::AtlasTooLarge { .. } => UnwrapError::TooLarge,
        other => UnwrapError::Other(other.to_string()),
    })
}

fn placed(mesh: &OutputMesh) -> Vec<Placed> {
    let (triangles, _) = mesh.indices.as_chunks();
    let one = |corners: &[u32; 3]| {
        let corners = corners.map(|corner| mesh.vertices[corner as usize]);
        let page = corners.iter().find_map(|corner| corner.page).unwrap_or(0);
        Placed { page, uvs: corners.map(|corner| corner.uv) }
    };
    triangles.iter().map(one).collect()
}
