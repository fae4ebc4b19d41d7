//! One primitive of a mesh, in the coordinates of the mesh.

use super::accessor::{self, Format};
use super::buffers::Document;
use super::notes::{Flaw, Notes};
use super::shown::{Shown, shown};
use super::skin::{self, Influence, Influences};
use super::surfaces::Surfaces;
use super::texcoord::TexCoord;
use super::{extensions, morph, topology};
use gltf_json::accessor::ComponentType;
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked;
use isolux::geometry::{Normal, Point, Transform, Triangle, Vector};
use isolux::scene::Shape;
use isolux::units::Rgb;

/// The set of texture coordinates that by custom is the place in a lightmap.
const LIGHTMAP_SET: u32 = 1;

/// A primitive, decoded.
pub(super) struct Decoded {
    positions: Vec<[f64; 3]>,
    normals: Option<Vec<[f64; 3]>>,
    uvs: Option<Vec<[f64; 2]>>,
    lightmap_uvs: Option<Vec<[f32; 2]>>,
    triangles: Vec<[u32; 3]>,
    material: u32,
    /// Whether joints have brought it to the world already.
    is_in_world: bool,
}

/// How a mesh is bent before it is placed.
pub(super) struct Pose {
    /// Whether a node has a pose of its own.
    pub(super) is_of_node: bool,
    /// Weights of the morph targets.
    pub(super) weights: Vec<f64>,
    /// What each joint of the skin does, from the mesh to the world.
    pub(super) joints: Option<Vec<Transform>>,
}

impl Decoded {
    /// The shape it makes in the world, its front kept in front by reflections too. Its name is left
    /// to the caller.
    pub(super) fn placed(&self, world_from_mesh: &Transform) -> Shape {
        let world_from_mesh = if self.is_in_world { &Transform::IDENTITY } else { world_from_mesh };
        let is_reflected = world_from_mesh.determinant() < 0.0;
        let place = |&p: &[f64; 3]| world_from_mesh.point(p.into()).into();
        // A normal lost on the way is given as zero, for which the scene takes the triangle's own.
        let turn = |&n: &[f64; 3]| {
            let image = Vector::from(n).normal().and_then(|n| world_from_mesh.normal(n));
            image.map(Normal::to_vector).unwrap_or_default().into()
        };
        let wind = |&[a, b, c]: &[u32; 3]| if is_reflected { [a, c, b] } else { [a, b, c] };
        Shape {
            name: String::new(),
            positions: self.positions.iter().map(place).collect(),
            normals: self.normals.as_ref().map(|list| list.iter().map(turn).collect()),
            uvs: self.uvs.clone(),
            lightmap_uvs: self.lightmap_uvs.clone(),
            triangles: self.triangles.iter().map(wind).collect(),
            material: self.material,
        }
    }
}

/// A primitive as written.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    document: &'a Document<'a>,
    record: &'a Primitive,
    mesh: usize,
    index: usize,
}

/// How many vertices and triangles a primitive has, and how they hang together.
#[derive(Clone, Copy)]
pub(super) struct Size {
    pub(super) vertices: usize,
    pub(super) triangles: usize,
    mode: Mode,
}

impl<'a> Source<'a> {
    pub(super) fn new(
        document: &'a Document<'a>,
        record: &'a Primitive,
        mesh: usize,
        index: usize,
    ) -> Self {
        Self { document, record, mesh, index }
    }

    /// Place of the primitive in the file.
    pub(super) fn place(&self) -> String {
        format!("meshes[{}].primitives[{}]", self.mesh, self.index)
    }

    /// The size before anything is decoded; `None` for what has no surface.
    pub(super) fn size(&self, notes: &mut Notes) -> Result<Option<Size>, Flaw> {
        let Checked::Valid(mode) = self.record.mode else {
            return Err(Flaw::new("unknown mode", "modes are 0 to 6").at("mode"));
        };
        let Some(positions) = self.attribute(Semantic::Positions) else {
            let what = "a primitive without POSITION is left out";
            notes.warn(Flaw::new(what, "export the file again").at(self.place()));
            return Ok(None);
        };
        let vertices = self.vertex_format(positions, Semantic::Positions)?.count;
        let corners = match self.record.indices {
            Some(indices) => accessor::format(self.document, indices.value())?.count,
            None => vertices,
        };
        let Some(triangles) = topology::triangle_count(mode, corners) else {
            let what = "points and lines are left out";
            notes.warn(Flaw::new(what, "give them a surface").at(self.place()));
            return Ok(None);
        };
        if mode == Mode::Triangles && !corners.is_multiple_of(3) {
            let what = "the last triangle has too few corners and is left out";
            notes.warn(Flaw::new(what, "export the file again").at(self.place()));
        }
        Ok(Some(Size { vertices, triangles, mode }))
    }

    pub(super) fn decode(
        &self,
        size: Size,
        pose: &Pose,
        surfaces: &mut Surfaces,
        notes: &mut Notes,
    ) -> Result<Decoded, Flaw> {
        let mut positions = self.vectors::<3>(Semantic::Positions, size)?.unwrap_or_default();
        let mut normals = self.normals(size, notes)?;
        let mut triangles = self.triangles(size)?;
        self.morph(&pose.weights, &mut positions, normals.as_deref_mut())?;
        let carried = self.carried(pose, size, notes)?;
        if let Some(world_from_mesh) = &carried {
            skin::carry_points(&mut positions, world_from_mesh);
            skin::carry_normals(normals.as_deref_mut().unwrap_or_default(), world_from_mesh);
            skin::keep_fronts(&mut triangles, world_from_mesh);
        }
        let tint = self.tint(&positions, &triangles, size, notes)?;
        let material = self.record.material.map(|m| m.value());
        if material.is_none() {
            let what = "no material: glTF's default is a rough white metal that absorbs nothing";
            notes.warn(Flaw::new(what, "give it a material").at(self.place()));
        }
        let glow = self.glow(surfaces, (&positions, &triangles), size, notes)?;
        let surface =
            surfaces.surface(material, (tint, glow), notes).map_err(|flaw| flaw.at("material"))?;
        // Coordinates of a picture are no places in a lightmap.
        let has_places = surface.texcoord.is_none_or(|of_colour| of_colour.set != LIGHTMAP_SET);
        Ok(Decoded {
            normals,
            uvs: surface.texcoord.map(|t| self.uvs(t, size, notes)).transpose()?,
            lightmap_uvs: if has_places { self.lightmap_uvs(size)? } else { None },
            positions,
            triangles,
            material: surface.material,
            is_in_world: carried.is_some(),
        })
    }

    fn morph(
        &self,
        weights: &[f64],
        positions: &mut [[f64; 3]],
        normals: Option<&mut [[f64; 3]]>,
    ) -> Result<(), Flaw> {
        let targets = self.record.targets.as_deref().unwrap_or_default();
        let document = self.document;
        let index = |accessor: &Option<gltf_json::Index<_>>| accessor.map(|a| a.value());
        morph::add(document, targets, weights, |target| index(&target.positions), positions)?;
        let normals = normals.unwrap_or_default();
        morph::add(document, targets, weights, |target| index(&target.normals), normals)
    }

    /// What takes each vertex to the world, where joints do.
    fn carried(
        &self,
        pose: &Pose,
        size: Size,
        notes: &mut Notes,
    ) -> Result<Option<Vec<Transform>>, Flaw> {
        let Some(joints) = &pose.joints else { return Ok(None) };
        let mut sets = Vec::new();
        for set in 0.. {
            let joints = self.vectors::<4>(Semantic::Joints(set), size)?;
            let weights = self.vectors::<4>(Semantic::Weights(set), size)?;
            let (Some(joints), Some(weights)) = (joints, weights) else { break };
            sets.push(Influence { joints, weights });
        }
        if sets.is_empty() {
            let what = "a skin without JOINTS_0 and WEIGHTS_0 is left out";
            notes.warn(Flaw::new(what, "export the file again").at(self.place()));
            return Ok(None);
        }
        Influences { sets }.blend(joints, size.vertices).map(Some)
    }

    fn attribute(&self, semantic: Semantic) -> Option<usize> {
        self.record.attributes.get(&Checked::Valid(semantic)).map(|index| index.value())
    }

    /// Corners of the triangles in the order of the file.
    pub(super) fn triangles(&self, size: Size) -> Result<Vec<[u32; 3]>, Flaw> {
        let corners = match self.record.indices {
            Some(indices) => accessor::indices(self.document, indices.value())?,
            None => (0..size.vertices as u32).collect(),
        };
        topology::triangles(size.mode, &corners, size.vertices).map_err(|flaw| flaw.at("indices"))
    }

    /// Stored normals; zero, for which the scene takes the triangle's own, where they are no
    /// numbers, as exporters leave them at triangles without area.
    fn normals(&self, size: Size, notes: &mut Notes) -> Result<Option<Vec<[f64; 3]>>, Flaw> {
        let Some(accessor) = self.checked_attribute(Semantic::Normals, size)? else {
            return Ok(None);
        };
        let mut normals = accessor::unchecked_vectors(self.document, accessor)?;
        for normal in normals.iter_mut().filter(|normal| !accessor::is_finite(normal)) {
            *normal = [0.0; 3];
            let what = "normals that are no finite numbers are replaced by those of the triangles";
            let remedy = "compute the normals again and export";
            notes.warn(Flaw::new(what, remedy).at(self.place()));
        }
        Ok(Some(normals))
    }

    /// The accessor of a vertex attribute, as many elements as there are vertices.
    fn checked_attribute(&self, semantic: Semantic, size: Size) -> Result<Option<usize>, Flaw> {
        let Some(index) = self.attribute(semantic.clone()) else { return Ok(None) };
        let format = self.vertex_format(index, semantic.clone())?;
        if format.count != size.vertices {
            let what = format!("{} elements for {} vertices", format.count, size.vertices);
            return Err(attribute_flaw(&semantic, what, "export the file again"));
        }
        Ok(Some(index))
    }

    fn vectors<const N: usize>(
        &self,
        semantic: Semantic,
        size: Size,
    ) -> Result<Option<Vec<[f64; N]>>, Flaw> {
        let accessor = self.checked_attribute(semantic, size)?;
        accessor.map(|accessor| accessor::vectors(self.document, accessor)).transpose()
    }

    /// The format of an attribute's accessor, found to be one the attribute may have.
    fn vertex_format(&self, accessor: usize, semantic: Semantic) -> Result<Format, Flaw> {
        let format = accessor::format(self.document, accessor)?;
        let is_quantized = extensions::is_quantized(&self.document.root);
        if may_have(&semantic, format, is_quantized) {
            return Ok(format);
        }
        let remedy = if may_have(&semantic, format, true) {
            "use floats, or declare KHR_mesh_quantization"
        } else {
            "export the file again with floats"
        };
        Err(attribute_flaw(&semantic, format.name(), remedy))
    }

    fn uvs(
        &self,
        texcoord: TexCoord,
        size: Size,
        notes: &mut Notes,
    ) -> Result<Vec<[f64; 2]>, Flaw> {
        let stored = self.vectors::<2>(Semantic::TexCoords(texcoord.set), size)?;
        let stored = stored.unwrap_or_else(|| {
            let what = "no texture coordinates: the texture is read at one place";
            notes.warn(Flaw::new(what, "unwrap the mesh").at(self.place()));
            vec![[0.0; 2]; size.vertices]
        });
        let uvs: Vec<_> = stored.into_iter().map(|uv| texcoord.apply(uv)).collect();
        let is_inside = |uv: &[f64; 2]| uv.iter().all(|c| (0.0..=1.0).contains(c));
        if !texcoord.repeats && !uvs.iter().all(is_inside) {
            let what = "a texture that ends or is mirrored at its borders is repeated";
            notes
                .warn(Flaw::new(what, "keep texture coordinates between 0 and 1").at(self.place()));
        }
        Ok(uvs)
    }

    /// What it shows of the emissive texture in the mean over the area.
    fn glow(
        &self,
        surfaces: &mut Surfaces,
        (positions, triangles): (&[[f64; 3]], &[[u32; 3]]),
        size: Size,
        notes: &mut Notes,
    ) -> Result<Option<Rgb>, Flaw> {
        let Some(material) = self.record.material.map(|m| m.value()) else { return Ok(None) };
        let rooted = |flaw: Flaw| flaw.rooted(format!("materials[{material}]"));
        let emissive = surfaces.emissive(Some(material)).map_err(rooted)?;
        let Some((texcoord, picture)) = emissive else { return Ok(None) };
        let uvs = self.uvs(texcoord, size, notes)?;
        let Shown { mean, is_even } = shown(picture, positions, &uvs, triangles);
        if !is_even {
            let what = "the surface shines evenly, by the mean of the emissiveTexture over it";
            let remedy =
                "split the mesh where the picture changes: each primitive has a mean of its own";
            notes.warn(Flaw::new(what, remedy).at(self.place()));
        }
        Ok(Some(mean))
    }

    /// The place in a lightmap.
    fn lightmap_uvs(&self, size: Size) -> Result<Option<Vec<[f32; 2]>>, Flaw> {
        let stored = self.vectors::<2>(Semantic::TexCoords(LIGHTMAP_SET), size)?;
        Ok(stored.map(|list| list.into_iter().map(|uv| uv.map(|c| c as f32)).collect()))
    }

    /// The vertex colours as one colour: their mean over the area.
    fn tint(
        &self,
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
        size: Size,
        notes: &mut Notes,
    ) -> Result<Rgb, Flaw> {
        let Some(colours) = self.vertex_colours(size)? else { return Ok(Rgb::WHITE) };
        if let Some(first) = colours.first().filter(|&first| colours.iter().all(|c| c == first)) {
            return Ok(*first);
        }
        let what = "vertex colours are taken as their mean over the primitive";
        notes
            .warn(Flaw::new(what, "use a texture, or a material for each colour").at(self.place()));
        let (mut sum, mut area) = (Rgb::BLACK, 0.0);
        for corners in triangles {
            let corners = corners.map(|v| v as usize);
            let weight = Triangle { corners: corners.map(|v| Point::from(positions[v])) }.area();
            area += weight;
            sum += corners.map(|v| colours[v]).into_iter().sum::<Rgb>() * (weight / 3.0);
        }
        Ok(if area > 0.0 { (sum / area).map(|c| c.clamp(0.0, 1.0)) } else { Rgb::WHITE })
    }

    fn vertex_colours(&self, size: Size) -> Result<Option<Vec<Rgb>>, Flaw> {
        const COLOUR: Semantic = Semantic::Colors(0);
        let Some(index) = self.attribute(COLOUR) else { return Ok(None) };
        let clamped = |c: f64| c.clamp(0.0, 1.0);
        Ok(if accessor::format(self.document, index)?.width == 4 {
            let colours = self.vectors::<4>(COLOUR, size)?;
            colours.map(|l| l.iter().map(|&[r, g, b, _]| Rgb::new(r, g, b).map(clamped)).collect())
        } else {
            let colours = self.vectors::<3>(COLOUR, size)?;
            colours.map(|l| l.iter().map(|&c| Rgb(c).map(clamped)).collect())
        })
    }
}

fn attribute_flaw(semantic: &Semantic, what: String, remedy: &str) -> Flaw {
    Flaw::new(what, remedy).at(format!("attributes.{}", semantic.to_string()))
}

/// Section 3.7.2.1 of glTF 2.0, and the table of KHR_mesh_quantization.
fn may_have(semantic: &Semantic, format: Format, is_quantized: bool) -> bool {
    use ComponentType::{F32, I8, I16, U8, U16};
    let Format { component, width, normalized, .. } = format;
    match (semantic, component) {
        (Semantic::Positions, F32) => width == 3,
        (Semantic::Positions, I8 | U8 | I16 | U16) => is_quantized && width == 3,
        (Semantic::Normals, F32) => width == 3,
        (Semantic::Normals, I8 | I16) => is_quantized && normalized && width == 3,
        (Semantic::TexCoords(_), F32) => width == 2,
        (Semantic::TexCoords(_), U8 | U16) => (normalized || is_quantized) && width == 2,
        (Semantic::TexCoords(_), I8 | I16) => is_quantized && width == 2,
        (Semantic::Colors(_), F32) => width == 3 || width == 4,
        (Semantic::Colors(_), U8 | U16) => normalized && (width == 3 || width == 4),
        (Semantic::Joints(_), U8 | U16) => !normalized && width == 4,
        (Semantic::Weights(_), F32) => width == 4,
        (Semantic::Weights(_), U8 | U16) => normalized && width == 4,
        _ => false,
    }
}
