//! Layouts by the crate `uvunwrap`.

use super::charts::{Patch, Placed, UnwrapError, UnwrapRequest, Unwrapped, Unwrapper};
use uvunwrap::{Atlas, Density, Error, MeshInput, Options, OutputMesh};

/// Charts by region growing, least squares conformal maps and as-rigid-as-possible iterations, packed by shape, as the
/// crate `uvunwrap` does it: without its direct solver, so that the result is the same on every machine.
#[derive(Clone, Copy, Debug, Default)]
pub struct UvUnwrap;

impl Unwrapper for UvUnwrap {
    fn unwrap(
        &self,
        patches: &[Patch],
        request: &UnwrapRequest,
    ) -> Result<Unwrapped, UnwrapError> {
        let inputs: Vec<MeshInput> = patches
            .iter()
            .map(|patch| MeshInput {
                seams: Some(&patch.creases),
                ..MeshInput::new(&patch.positions, patch.triangles.as_flattened())
            })
            .collect();
        // One page that grows to fit, where it stays small enough.
        let atlas = match generate(&inputs, request, None) {
            Ok(atlas) if atlas.width <= request.page && atlas.height <= request.page => Ok(atlas),
            Ok(_) | Err(UnwrapError::TooLarge) => generate(&inputs, request, Some(request.page)),
            Err(other) => Err(other),
        }?;
        let placed = atlas.meshes.iter().map(placed).collect();
        let Atlas { width, height, page_count: pages, chart_count: charts, .. } = atlas;
        Ok(Unwrapped { width, height, pages, charts, placed })
    }
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
