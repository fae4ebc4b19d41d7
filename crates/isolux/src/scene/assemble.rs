//! From plain parts to a scene that cannot be invalid.

use super::{
    AreaLuminaire, Body, CalculationGrid, Camera, Finish, Fitting, Luminaire, LuminaireKind,
    Maintenance, Material, SceneParts, SceneProblem, Shape, Texture, UpAxis,
};
use super::{mounted, origin, sealed};
use crate::units::Rgb;
use isolux_geometry::{Bvh, Hit, Normal, Point, Triangle, TriangleMesh, Vector};
use std::collections::HashMap;

/// A checked scene with its ray kernel. Immutable.
#[derive(Clone, Debug)]
pub struct Scene {
    name: String,
    up: UpAxis,
    bvh: Bvh,
    /// Unit normals of the triangles as planes, read at every hit.
    geometric_normals: Vec<Normal>,
    /// Shading normals at the corners, for triangles of shapes that have them.
    corner_normals: Vec<Option<[Normal; 3]>>,
    corner_uvs: Vec<Option<[[f64; 2]; 3]>>,
    /// Places in a lightmap, for triangles of shapes that have them; empty where none has.
    corner_lightmap_uvs: Vec<Option<[[f32; 2]; 3]>>,
    triangle_shape: Vec<u32>,
    shape_names: Vec<String>,
    shape_material: Vec<u32>,
    materials: Vec<Material>,
    textures: Vec<Texture>,
    luminaires: Vec<Luminaire>,
    fittings: Vec<Fitting>,
    maintenance: Option<Maintenance>,
    area_luminaires: Vec<AreaLuminaire>,
    groups: Vec<String>,
    cameras: Vec<Camera>,
    grids: Vec<CalculationGrid>,
}

/// One for each luminaire, with nothing known where there was none.
fn of_each(luminaires: &[Luminaire], mut fittings: Vec<Fitting>) -> Vec<Fitting> {
    fittings.resize(luminaires.len(), Fitting::default());
    fittings
}

impl Scene {
    /// Checks all parts and builds the scene; on failure, all problems. Triangles without area are
    /// left out.
    pub fn assemble(parts: SceneParts) -> Result<Self, Vec<SceneProblem>> {
        let problems = super::check::problems(&parts);
        if !problems.is_empty() {
            return Err(problems);
        }
        let Build { mesh, corner_normals, corner_uvs, corner_lightmap_uvs, triangle_shape, .. } =
            Build::of(&parts.shapes);
        let is_transparent = |triangle: u32| {
            let shape = &parts.shapes[triangle_shape[triangle as usize] as usize];
            matches!(parts.materials[shape.material as usize].body, Body::Dielectric(_))
        };
        let normal = |triangle| {
            mesh.triangle(triangle).normal().expect("triangles without area are left out")
        };
        let geometric_normals: Vec<Normal> = (0..mesh.len() as u32).map(normal).collect();
        let bvh = Bvh::build(mesh, is_transparent);
        let luminaires = mounted::before_surfaces(&bvh, &geometric_normals, parts.luminaires);
        let fittings = of_each(&luminaires, parts.fittings);
        let mut scene = Self {
            geometric_normals,
            bvh,
            name: parts.name,
            up: parts.up,
            corner_normals,
            corner_uvs,
            corner_lightmap_uvs,
            triangle_shape,
            shape_names: parts.shapes.iter().map(|s| s.name.clone()).collect(),
            shape_material: parts.shapes.iter().map(|s| s.material).collect(),
            materials: parts.materials,
            textures: parts.textures,
            luminaires,
            fittings,
            maintenance: parts.maintenance,
            area_luminaires: Vec::new(),
            groups: parts.groups,
            cameras: parts.cameras,
            grids: parts.grids,
        };
        scene.area_luminaires = scene.find_area_luminaires();
        Ok(scene)
    }

    /// The inverse of [`Scene::assemble`], but for triangles without area and for positions, which
    /// come back as the ray kernel stores them (`f32`, counted from its origin). Every triangle has its own three vertices.
    pub fn to_parts(&self) -> SceneParts {
        let mut shapes: Vec<Shape> = self
            .shape_names
            .iter()
            .zip(&self.shape_material)
            .map(|(name, &material)| Shape { name: name.clone(), material, ..Shape::default() })
            .collect();
        for triangle in 0..self.triangle_count() {
            self.append_triangle(triangle, &mut shapes[self.shape_of(triangle) as usize]);
        }
        SceneParts {
            name: self.name.clone(),
            up: self.up,
            shapes,
            materials: self.materials.clone(),
            textures: self.textures.clone(),
            luminaires: self.luminaires.clone(),
            fittings: self.fittings.clone(),
            maintenance: self.maintenance,
            groups: self.groups.clone(),
            cameras: self.cameras.clone(),
            grids: self.grids.clone(),
        }
    }

    /// The same surfaces with other luminaires, and materials that differ in their own light alone.
    pub(super) fn relit(
        &self,
        luminaires: Vec<Luminaire>,
        groups: Vec<String>,
        materials: Vec<Material>,
    ) -> Self {
        let fittings = of_each(&luminaires, Vec::new());
        let mut scene = Self { luminaires, fittings, groups, materials, ..self.clone() };
        scene.area_luminaires = scene.find_area_luminaires();
        scene
    }

    fn append_triangle(&self, triangle: u32, shape: &mut Shape) {
        let first = shape.positions.len() as u32;
        shape.triangles.push([first, first + 1, first + 2]);
        shape.positions.extend(self.triangle(triangle).corners.map(<[f64; 3]>::from));
        if let Some(normals) = self.corner_normals[triangle as usize] {
            let list = shape.normals.get_or_insert_default();
            list.extend(normals.map(|n| <[f64; 3]>::from(n.to_vector())));
        }
        if let Some(uvs) = self.corner_uvs[triangle as usize] {
            shape.uvs.get_or_insert_default().extend(uvs);
        }
        if let Some(uvs) = self.corner_lightmap_uvs(triangle) {
            shape.lightmap_uvs.get_or_insert_default().extend(uvs);
        }
    }

    fn find_area_luminaires(&self) -> Vec<AreaLuminaire> {
        let mut found: Vec<AreaLuminaire> = Vec::new();
        let mut known = HashMap::new();
        for triangle in 0..self.triangle_count() {
            for back in [false, true] {
                let Some(finish) = self.material(triangle).finish(back) else { continue };
                if !finish.is_emitter() {
                    continue;
                }
                let shape = self.shape_of(triangle);
                let index = *known.entry((shape, back)).or_insert_with(|| {
                    found.push(AreaLuminaire {
                        shape,
                        triangles: Vec::new(),
                        back,
                        luminance_cd_m2: finish.luminance_cd_m2,
                        area_m2: 0.0,
                    });
                    found.len() - 1
                });
                found[index].triangles.push(triangle);
                found[index].area_m2 += self.triangle(triangle).area();
            }
        }
        let shines = |triangle: u32, back: bool| {
            self.material(triangle).finish(back).is_some_and(Finish::is_emitter)
        };
        sealed::without_insides(self.bvh.mesh(), &self.places(), shines, found)
    }

    /// Where something is asked for or shines.
    fn places(&self) -> Vec<Point> {
        let luminaires = self.luminaires.iter().filter_map(|luminaire| match luminaire.kind {
            LuminaireKind::Point { position, .. } => Some(position),
            _ => None,
        });
        let cameras = self.cameras.iter().map(|camera| camera.position);
        let grids = self.grids.iter().flat_map(|&CalculationGrid { corner, u, v, .. }| {
            [corner, corner + u, corner + v, corner + u + v]
        });
        luminaires.chain(cameras).chain(grids).collect()
    }

    /// Name of the scene.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The axis that points up in the coordinates as written.
    pub fn up(&self) -> UpAxis {
        self.up
    }

    /// The ray kernel over all triangles.
    pub fn bvh(&self) -> &Bvh {
        &self.bvh
    }

    /// Number of triangles.
    pub fn triangle_count(&self) -> u32 {
        self.triangle_shape.len() as u32
    }

    /// A triangle by index.
    pub fn triangle(&self, index: u32) -> Triangle {
        self.bvh.mesh().triangle(index)
    }

    /// Index of the shape a triangle belongs to.
    pub fn shape_of(&self, triangle: u32) -> u32 {
        self.triangle_shape[triangle as usize]
    }

    /// Names of the shapes.
    pub fn shape_names(&self) -> &[String] {
        &self.shape_names
    }

    /// Index of the material of a triangle.
    pub fn material_index(&self, triangle: u32) -> u32 {
        self.shape_material[self.shape_of(triangle) as usize]
    }

    /// The material of a triangle.
    pub fn material(&self, triangle: u32) -> &Material {
        &self.materials[self.material_index(triangle) as usize]
    }

    /// All materials.
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// All textures.
    pub fn textures(&self) -> &[Texture] {
        &self.textures
    }

    /// Luminaires without surface.
    pub fn luminaires(&self) -> &[Luminaire] {
        &self.luminaires
    }

    /// What is known of each luminaire beside its light.
    pub fn fittings(&self) -> &[Fitting] {
        &self.fittings
    }

    /// The same scene with this known of its luminaires.
    pub(super) fn fitted(self, fittings: Vec<Fitting>) -> Self {
        Self { fittings: of_each(&self.luminaires, fittings), ..self }
    }

    /// The same scene with other maintenance factors within its light.
    pub(super) fn maintained(self, maintenance: Option<Maintenance>) -> Self {
        Self { maintenance, ..self }
    }

    /// Emitting surfaces.
    pub fn area_luminaires(&self) -> &[AreaLuminaire] {
        &self.area_luminaires
    }

    /// The maintenance factors that the light of the scene already contains, with 1 for emitting surfaces; `None` where
    /// all light is initial.
    pub fn maintenance(&self) -> Option<Maintenance> {
        let has_surfaces = !self.area_luminaires.is_empty();
        let greatest = |of: Maintenance| if has_surfaces { 1.0 } else { of.greatest };
        self.maintenance.map(|of| Maintenance { greatest: greatest(of), ..of })
    }

    /// Names of the light groups.
    pub fn groups(&self) -> &[String] {
        &self.groups
    }

    /// Where illuminance is asked for.
    pub fn grids(&self) -> &[CalculationGrid] {
        &self.grids
    }

    /// Cameras.
    pub fn cameras(&self) -> &[Camera] {
        &self.cameras
    }

    /// The normal of the front of a triangle.
    pub fn geometric_normal(&self, triangle: u32) -> Normal {
        self.geometric_normals[triangle as usize]
    }

    /// The shading normals at the corners of a triangle, where it is not flat.
    pub fn corner_normals(&self, triangle: u32) -> Option<[Normal; 3]> {
        self.corner_normals[triangle as usize]
    }

    /// Texture coordinates at the corners of a triangle.
    pub fn corner_uvs(&self, triangle: u32) -> Option<[[f64; 2]; 3]> {
        self.corner_uvs[triangle as usize]
    }

    /// Places of the corners of a triangle in a lightmap, as its file has them.
    pub fn corner_lightmap_uvs(&self, triangle: u32) -> Option<[[f32; 2]; 3]> {
        self.corner_lightmap_uvs.get(triangle as usize).copied().flatten()
    }

    /// The front shading normal at barycentric weights `(1 - u - v, u, v)`.
    pub fn shading_normal(&self, triangle: u32, u: f64, v: f64) -> Normal {
        self.corner_normals[triangle as usize]
            .and_then(|[a, b, c]| (a * (1.0 - u - v) + b * u + c * v).normal())
            .unwrap_or_else(|| self.geometric_normal(triangle))
    }

    /// The place of a hit on its triangle.
    pub fn hit_point(&self, hit: &Hit) -> Point {
        self.triangle(hit.triangle).point(f64::from(hit.u), f64::from(hit.v))
    }

    /// Diffuse reflectance of a finish at a place of a triangle.
    pub fn diffuse_reflectance(&self, finish: &Finish, triangle: u32, u: f64, v: f64) -> Rgb {
        let Some(texture) = finish.diffuse.texture else { return finish.diffuse.colour };
        let Some([a, b, c]) = self.corner_uvs[triangle as usize] else {
            return finish.diffuse.colour;
        };
        let mix = |k: usize| a[k] * (1.0 - u - v) + b[k] * u + c[k] * v;
        finish.diffuse.colour * self.textures[texture as usize].value(mix(0), mix(1))
    }

    /// Whether some luminaire gives light: none that is dimmed to nothing does.
    pub fn gives_light(&self) -> bool {
        self.luminous_flux_lm() > 0.0 || self.luminaires.iter().any(|l| l.kind.is_infinitely_far())
    }

    /// Flux of all luminaires with finite flux, lm (the sun and the sky have none of their own).
    pub fn luminous_flux_lm(&self) -> f64 {
        let points: f64 = self
            .luminaires
            .iter()
            .map(|l| match &l.kind {
                LuminaireKind::Point { intensity, .. } => intensity.luminous_flux_lm(),
                LuminaireKind::Directional { .. } | LuminaireKind::Sky { .. } => 0.0,
            })
            .sum();
        points + self.area_luminaires.iter().map(AreaLuminaire::luminous_flux_lm).sum::<f64>()
    }
}

/// Triangle soup with its attributes, while shapes are added.
#[derive(Default)]
struct Build {
    mesh: TriangleMesh,
    corner_normals: Vec<Option<[Normal; 3]>>,
    corner_uvs: Vec<Option<[[f64; 2]; 3]>>,
    corner_lightmap_uvs: Vec<Option<[[f32; 2]; 3]>>,
    triangle_shape: Vec<u32>,
    /// Whether any shape has a place in a lightmap.
    has_lightmap: bool,
}

/// How often the origin is chosen anew. Once is enough but where rounding moves the box around the surfaces across the border
/// between two origins.
const ORIGINS: usize = 4;

impl Build {
    /// All shapes, about the origin that the surfaces as stored have themselves: a scene that is read from a map has it, too,
    /// and thereby the same bits.
    fn of(shapes: &[Shape]) -> Self {
        let mut build = Self::about(origin::of(shapes.iter().flat_map(corners)), shapes);
        for _ in 1..ORIGINS {
            let own = build.own_origin();
            if own == build.mesh.origin {
                break;
            }
            build = Self::about(own, shapes);
        }
        build
    }

    fn about(origin: Point, shapes: &[Shape]) -> Self {
        let has_lightmap = shapes.iter().any(|shape| shape.lightmap_uvs.is_some());
        let mesh = TriangleMesh { origin, ..TriangleMesh::default() };
        let mut build = Self { mesh, has_lightmap, ..Self::default() };
        for (index, shape) in shapes.iter().enumerate() {
            build.add(index as u32, shape);
        }
        build
    }

    fn own_origin(&self) -> Point {
        let corners = self.mesh.triangles.as_flattened().iter();
        origin::of(corners.map(|&v| self.mesh.world_from_local(self.mesh.positions[v as usize])))
    }

    fn add(&mut self, index: u32, shape: &Shape) {
        let first = self.mesh.positions.len() as u32;
        let local: Vec<[f32; 3]> =
            shape.positions.iter().map(|&p| self.mesh.local_from_world(p.into())).collect();
        self.mesh.positions.extend(local);
        for corners in &shape.triangles {
            self.mesh.triangles.push(corners.map(|v| first + v));
            let stored = self.mesh.triangle(self.mesh.len() as u32 - 1);
            let Some(flat) = stored.normal() else {
                self.mesh.triangles.pop();
                continue;
            };
            self.triangle_shape.push(index);
            self.corner_normals.push(
                shape
                    .normals
                    .as_ref()
                    .map(|list| corners.map(|v| shading_normal(list[v as usize], flat))),
            );
            let uvs = shape.uvs.as_ref();
            self.corner_uvs.push(uvs.map(|list| corners.map(|v| list[v as usize])));
            if self.has_lightmap {
                let uvs = shape.lightmap_uvs.as_ref();
                self.corner_lightmap_uvs.push(uvs.map(|list| corners.map(|v| list[v as usize])));
            }
        }
    }
}

/// Corners of all triangles of a shape.
fn corners(shape: &Shape) -> impl Iterator<Item = Point> {
    shape.triangles.as_flattened().iter().map(|&v| Point::from(shape.positions[v as usize]))
}

/// The stored normal where it has a direction on the front of the triangle, else the flat one.
fn shading_normal(stored: [f64; 3], flat: Normal) -> Normal {
    Vector::from(stored).normal().filter(|n| n.dot(flat) > 0.0).unwrap_or(flat)
}
