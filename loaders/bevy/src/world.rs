//! Maps in a world: meshes whose colours follow the levels.

use crate::file::IlluminationLoader;
use crate::map::{IlluminationMap, Surface};
use crate::mix::Levels;
use bevy_app::{App, Plugin, Update};
use bevy_asset::{AssetApp, AssetEvent, AssetId, Assets, Handle, RenderAssetUsages};
use bevy_ecs::prelude::*;
use bevy_mesh::{Indices, Mesh, Mesh3d, MeshVertexAttribute, PrimitiveTopology, VertexFormat};
use bevy_transform::components::Transform;

/// Illuminance at vertices as it is dimmed, in channels of linear Rec. 709, lx.
pub const ATTRIBUTE_ILLUMINANCE_LX: MeshVertexAttribute = MeshVertexAttribute::new(
    "Vertex_IlluminanceLx",
    0x69_73_6f_6c_75_78_01,
    VertexFormat::Float32x3,
);
/// Its standard error, lx; -1 where the light is not known, -2 where the error is not.
pub const ATTRIBUTE_STANDARD_ERROR_LX: MeshVertexAttribute = MeshVertexAttribute::new(
    "Vertex_StandardErrorLx",
    0x69_73_6f_6c_75_78_02,
    VertexFormat::Float32,
);

/// Loads maps and keeps their meshes lit. `MeshPlugin` and `AssetPlugin` must be there, as in `DefaultPlugins`.
pub struct IlluminationPlugin;

impl Plugin for IlluminationPlugin {
    fn build(&self, app: &mut App) {
        app.init_asset::<IlluminationMap>()
            .init_asset_loader::<IlluminationLoader>()
            .add_systems(Update, (forget, show, relight).chain());
    }
}

/// Shows a map: once it is loaded, its surfaces are children of this entity.
#[derive(Component, Clone, Debug)]
#[require(Levels, Transform)]
pub struct IlluminationRoot(
    /// The map.
    pub Handle<IlluminationMap>,
);

/// A child of an [`IlluminationRoot`] with a `Mesh3d`. Give it an unlit material: all light is in the colours of its vertices.
#[derive(Component, Clone, Copy, Debug)]
pub struct LitSurface {
    /// Which of the surfaces of the map.
    pub index: usize,
}

/// Of a root whose surfaces are there.
#[derive(Component)]
struct Shown;

/// Roots whose surfaces are there, and whose levels have changed.
type Redimmed = (Changed<Levels>, With<Shown>);

/// Takes the surfaces of maps away whose files have changed.
fn forget(
    mut commands: Commands,
    mut events: MessageReader<AssetEvent<IlluminationMap>>,
    roots: Query<(Entity, &IlluminationRoot), With<Shown>>,
) {
    let changed: Vec<AssetId<IlluminationMap>> = events
        .read()
        .filter_map(|event| match event {
            AssetEvent::Modified { id } => Some(*id),
            _ => None,
        })
        .collect();
    for (entity, root) in &roots {
        if changed.contains(&root.0.id()) {
            commands.entity(entity).despawn_related::<Children>().remove::<Shown>();
        }
    }
}

/// Adds the surfaces of maps that have been loaded.
fn show(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    maps: Res<Assets<IlluminationMap>>,
    roots: Query<(Entity, &IlluminationRoot, &Levels), Without<Shown>>,
) {
    for (entity, root, levels) in &roots {
        let Some(map) = maps.get(&root.0) else { continue };
        commands.entity(entity).insert(Shown);
        for (index, surface) in map.surfaces.iter().enumerate() {
            let mut mesh = mesh_of(surface);
            light(&mut mesh, surface, map, levels);
            commands.spawn((
                Name::new(surface.shape.clone()),
                LitSurface { index },
                Mesh3d(meshes.add(mesh)),
                Transform::from_rotation(map.world_from_scene),
                ChildOf(entity),
            ));
        }
        tell_strange_groups(map, levels);
    }
}

/// Lights the surfaces of roots whose levels have changed.
fn relight(
    mut meshes: ResMut<Assets<Mesh>>,
    maps: Res<Assets<IlluminationMap>>,
    roots: Query<(&IlluminationRoot, &Levels, &Children), Redimmed>,
    surfaces: Query<(&LitSurface, &Mesh3d)>,
) {
    for (root, levels, children) in &roots {
        let Some(map) = maps.get(&root.0) else { continue };
        for (of, mesh) in surfaces.iter_many(children) {
            if let (Some(surface), Some(mut mesh)) =
                (map.surfaces.get(of.index), meshes.get_mut(&mesh.0))
            {
                light(&mut mesh, surface, map, levels);
            }
        }
        tell_strange_groups(map, levels);
    }
}

fn tell_strange_groups(map: &IlluminationMap, levels: &Levels) {
    for name in levels.strange(&map.groups) {
        tracing::warn!("the map has no group \"{name}\", but {:?}; it dims nothing", map.groups);
    }
}

fn mesh_of(surface: &Surface) -> Mesh {
    let mut mesh = Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default());
    mesh.insert_attribute(Mesh::ATTRIBUTE_POSITION, surface.positions.clone());
    mesh.insert_attribute(Mesh::ATTRIBUTE_NORMAL, surface.normals.clone());
    if surface.uvs.len() == surface.positions.len() {
        mesh.insert_attribute(Mesh::ATTRIBUTE_UV_0, surface.uvs.clone());
    }
    mesh.insert_indices(Indices::U32(surface.triangles.as_flattened().to_vec()));
    mesh
}

fn light(mesh: &mut Mesh, surface: &Surface, map: &IlluminationMap, levels: &Levels) {
    let exposure = levels.exposure_m2_cd.unwrap_or(map.exposure_m2_cd);
    let levels = levels.of(&map.groups);
    let vertices = || 0..surface.positions.len();
    let colours: Vec<[f32; 4]> = vertices().map(|k| surface.colour(&levels, exposure, k)).collect();
    let lit: Vec<[f32; 3]> = vertices().map(|k| surface.lit(&levels, k)).collect();
    let errors: Vec<f32> = vertices().map(|k| surface.error(&levels, k)).collect();
    mesh.insert_attribute(Mesh::ATTRIBUTE_COLOR, colours);
    mesh.insert_attribute(ATTRIBUTE_ILLUMINANCE_LX, lit);
    mesh.insert_attribute(ATTRIBUTE_STANDARD_ERROR_LX, errors);
}
