//! Layouts by the crate `uvunwrap`.

use super::charts::{Patch, Placed, UnwrapError, UnwrapRequest, Unwrapped, Unwrapper};
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
        Ok(Unwrapped { width, height, pages, charts, placed })
    }
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
        // A chart larger than a page gets fewer texels a metre.
        max_chart_size: request.page - 2 * request.padding,
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
