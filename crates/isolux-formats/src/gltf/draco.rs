//! KHR_draco_mesh_compression: primitives whose vertices and triangles are stored together.
//!
//! The bitstream is read by the `draco-core` crate under limits of our own; what it holds is laid out as the
//! accessors of the primitive say, so that all else reads it as if it had been plain.

use super::accessor::{self, Format};
use super::buffers::Document;
use super::limits;
use super::notes::Flaw;
use super::unpacked::{Budget, Elements};
use draco_core::{DecodeLimits, DecoderBuffer, Mesh, MeshDecoder};
use gltf_json::accessor::ComponentType;
use gltf_json::mesh::{Mode, Primitive};
use gltf_json::validation::Checked;
use serde::Deserialize;
use std::collections::HashMap;

/// Name of the extension.
pub(crate) const NAME: &str = "KHR_draco_mesh_compression";

/// The extension of a primitive.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Compressed {
    buffer_view: usize,
    /// Names of attributes, and their numbers in the bitstream.
    attributes: HashMap<String, u32>,
}

/// Unpacks the primitives of all meshes.
pub(super) fn unpack_primitives(document: &mut Document, budget: &mut Budget) -> Result<(), Flaw> {
    for mesh in 0..document.root.meshes.len() {
        for index in 0..document.root.meshes[mesh].primitives.len() {
            let record = &document.root.meshes[mesh].primitives[index];
            let extension = record.extensions.as_ref().and_then(|e| e.others.get(NAME));
            let Some(extension) = extension.filter(|_| is_needed(document, record)) else {
                continue;
            };
            let place = format!("meshes[{mesh}].primitives[{index}].extensions.{NAME}");
            let unpacked = Compressed::deserialize(extension)
                .map_err(|error| Flaw::new(error.to_string(), "export the file again"))
                .and_then(|compressed| unpack(document, record, &compressed, budget))
                .map_err(|flaw| flaw.rooted(&place))?;
            for (accessor, count, bytes) in unpacked {
                let elements = Elements { count, bytes, source: (mesh, index) };
                keep(document, accessor, elements).map_err(|flaw| flaw.rooted(&place))?;
            }
        }
    }
    Ok(())
}

/// Accessors may be shared, but then the data must be the same.
fn keep(document: &mut Document, accessor: usize, new: Elements) -> Result<(), Flaw> {
    if let Some(old) = document.unpacked.accessors.get(&accessor)
        && old.bytes != new.bytes
    {
        let (mesh, primitive) = old.source;
        let what = format!(
            "accessors[{accessor}] is also that of meshes[{mesh}].primitives[{primitive}], with other data"
        );
        return Err(Flaw::new(what, "give each compressed primitive accessors of its own"));
    }
    document.unpacked.accessors.insert(accessor, new);
    Ok(())
}

/// Whether something of the primitive is stored compressed only.
fn is_needed(document: &Document, record: &Primitive) -> bool {
    let accessors = record.attributes.values().chain(&record.indices);
    accessors.map(|index| index.value()).any(|index| {
        let accessor = document.root.accessors.get(index);
        accessor.is_some_and(|accessor| accessor.buffer_view.is_none())
    })
}

/// Accessor, number of elements and bytes of each part.
type Parts = Vec<(usize, usize, Vec<u8>)>;

fn unpack(
    document: &Document,
    record: &Primitive,
    compressed: &Compressed,
    budget: &mut Budget,
) -> Result<Parts, Flaw> {
    if record.mode != Checked::Valid(Mode::Triangles) {
        let what = "a compressed primitive that is not of single triangles";
        return Err(Flaw::new(what, "export it as triangles"));
    }
    let mesh = decode(document.view(compressed.buffer_view)?.bytes, budget)?;
    let mut parts = Vec::new();
    if let Some(indices) = record.indices {
        parts.push(indices_of(document, indices.value(), &mesh, budget)?);
    }
    for (semantic, accessor) in &record.attributes {
        let Checked::Valid(semantic) = semantic else { continue };
        let name = semantic.to_string();
        let Some(&id) = compressed.attributes.get(&name) else { continue };
        let part = attribute(document, accessor.value(), (&mesh, id), budget);
        parts.push(part.map_err(|flaw| flaw.at(format!("attributes.{name}")))?);
    }
    Ok(parts)
}

fn decode(data: &[u8], budget: &Budget) -> Result<Mesh, Flaw> {
    let bounds = DecodeLimits::default()
        .with_max_points(limits::VERTICES)
        .with_max_faces(limits::TRIANGLES)
        .with_max_decoded_bytes(budget.left());
    let mut mesh = Mesh::new();
    let mut decoder = MeshDecoder::new();
    decoder.decode(&mut DecoderBuffer::new(data).with_limits(bounds), &mut mesh).map_err(
        |error| {
            let what = format!("the compressed mesh cannot be read: {error}");
            Flaw::new(what, "export it uncompressed, or unpack it with `gltf-transform copy`")
        },
    )?;
    Ok(mesh)
}

/// Corners of the triangles, in the component type of their accessor.
fn indices_of(
    document: &Document,
    accessor: usize,
    mesh: &Mesh,
    budget: &mut Budget,
) -> Result<(usize, usize, Vec<u8>), Flaw> {
    let format = accessor::format(document, accessor)?;
    let size = format.component.size();
    let count = 3 * mesh.num_faces();
    budget.spend(Some((count * size) as u64))?;
    let largest = u32::MAX >> (32 - 8 * size.min(4));
    let corners = mesh.faces().iter().flatten().map(|corner| corner.0);
    let mut bytes = Vec::with_capacity(count * size);
    for corner in corners {
        if corner > largest {
            let what = format!("vertex {corner} does not fit {}", format.name());
            return Err(Flaw::new(what, "export the file again").at("indices"));
        }
        bytes.extend_from_slice(&corner.to_le_bytes()[..size]);
    }
    Ok((accessor, count, bytes))
}

/// Values of an attribute for every vertex, in the format of their accessor.
fn attribute(
    document: &Document,
    accessor: usize,
    (mesh, id): (&Mesh, u32),
    budget: &mut Budget,
) -> Result<(usize, usize, Vec<u8>), Flaw> {
    let format = accessor::format(document, accessor)?;
    let values = mesh.attribute_by_unique_id(id).ok_or_else(|| {
        Flaw::new(format!("the compressed mesh has no attribute {id}"), "export the file again")
    })?;
    if usize::from(values.num_components()) != format.width {
        let what = format!("{} numbers where {} belong", values.num_components(), format.name());
        return Err(Flaw::new(what, "export the file again"));
    }
    let count = mesh.num_points();
    let bytes = (count * format.width * format.component.size()) as u64;
    // Once as numbers, once as bytes.
    budget.spend(bytes.checked_add((count * format.width * 4) as u64))?;
    Ok((accessor, count, stored(&values.read_f32s(count, format.width), format)))
}

/// Numbers as their accessor would store them.
fn stored(values: &[f32], format: Format) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(values.len() * format.component.size());
    for &value in values {
        match format.component {
            ComponentType::I8 => bytes.extend((value as i8).to_le_bytes()),
            ComponentType::U8 => bytes.extend((value as u8).to_le_bytes()),
            ComponentType::I16 => bytes.extend((value as i16).to_le_bytes()),
            ComponentType::U16 => bytes.extend((value as u16).to_le_bytes()),
            ComponentType::U32 => bytes.extend((value as u32).to_le_bytes()),
            ComponentType::F32 => bytes.extend(value.to_le_bytes()),
        }
    }
    bytes
}
