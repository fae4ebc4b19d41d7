//! A map in a world: its surfaces appear, are told of, and follow the levels.

use bevy_app::{App, TaskPoolPlugin};
use bevy_asset::{AssetPlugin, Assets};
use bevy_ecs::prelude::*;
use bevy_math::Quat;
use bevy_mesh::{Mesh, Mesh3d, MeshPlugin, VertexAttributeValues};
use bevy_transform::components::Transform;
use isolux_bevy::{
    ATTRIBUTE_STANDARD_ERROR_LX, IlluminationMap, IlluminationPlugin, IlluminationRoot, Levels,
    Light, LitSurface, Surface,
};
use std::f32::consts::PI;

/// What users give a material to.
#[derive(Component)]
struct Material;

fn light(lx: f32, error: f32) -> Light {
    Light { rgb_lx: vec![[lx, 2.0 * lx, 0.0]; 3], errors_lx: vec![error; 3] }
}

fn map() -> IlluminationMap {
    let surface = Surface {
        shape: "desk".to_owned(),
        positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        normals: vec![[0.0, 0.0, 1.0]; 3],
        triangles: vec![[0, 1, 2]],
        whole: light(3.0 * PI, 5.0),
        direct_lx: vec![[0.0; 3]; 3],
        groups: vec![light(PI, 3.0), light(2.0 * PI, 4.0)],
        reflection: Some([[0.5, 0.25, 1.0], [0.0, 0.0, 7.0]]),
        ..Surface::default()
    };
    IlluminationMap {
        groups: vec!["spots".to_owned(), "lamps".to_owned()],
        exposure_m2_cd: 2.0,
        world_from_scene: Quat::from_rotation_x(-PI / 2.0),
        surfaces: vec![surface],
    }
}

fn app() -> (App, Entity) {
    let mut app = App::new();
    app.add_plugins((
        TaskPoolPlugin::default(),
        AssetPlugin::default(),
        MeshPlugin,
        IlluminationPlugin,
    ));
    app.add_observer(|lit: On<Add, LitSurface>, mut commands: Commands| {
        commands.entity(lit.entity).insert(Material);
    });
    let map = app.world_mut().resource_mut::<Assets<IlluminationMap>>().add(map());
    let root = app.world_mut().spawn(IlluminationRoot(map)).id();
    app.update();
    (app, root)
}

/// Colour and error of the first vertex of the only mesh.
fn shown(app: &mut App) -> ([f32; 4], f32) {
    let mut surfaces = app.world_mut().query_filtered::<(&Mesh3d, &Transform), With<Material>>();
    let (mesh, transform) = surfaces.single(app.world()).unwrap();
    assert_eq!(transform.rotation, map().world_from_scene);
    let mesh = app.world().resource::<Assets<Mesh>>().get(&mesh.0).unwrap();
    match (mesh.attribute(Mesh::ATTRIBUTE_COLOR), mesh.attribute(ATTRIBUTE_STANDARD_ERROR_LX)) {
        (Some(VertexAttributeValues::Float32x4(c)), Some(VertexAttributeValues::Float32(e))) => {
            (c[0], e[0])
        }
        _ => panic!("no colours or errors"),
    }
}

#[track_caller]
fn near(found: ([f32; 4], f32), (colour, error): ([f32; 4], f32)) {
    let all = found.0.iter().zip(colour).chain([(&found.1, error)]);
    // Some roundings to 32 bits.
    all.for_each(|(found, due)| assert!((found - due).abs() <= 1e-5 * due, "{found} and {due}"));
}

#[test]
fn surfaces_appear_and_follow_the_levels() {
    let (mut app, root) = app();
    // 2 (0.5 * 3 pi / pi + 0), 2 (0.25 * 6 pi / pi + 0), 2 (0 + 7)
    near(shown(&mut app), ([3.0, 3.0, 14.0, 1.0], 5.0));
    let set = |app: &mut App, group: &str, level: f32| {
        app.world_mut().get_mut::<Levels>(root).unwrap().set(group, level);
        app.update();
    };
    set(&mut app, "lamps", 0.5);
    near(shown(&mut app), ([2.0, 2.0, 14.0, 1.0], f32::hypot(3.0, 2.0)));
    set(&mut app, "spots", 0.0);
    near(shown(&mut app), ([1.0, 1.0, 14.0, 1.0], 2.0));
    set(&mut app, "no such group", 0.0);
    app.world_mut().get_mut::<Levels>(root).unwrap().exposure_m2_cd = Some(20.0);
    app.update();
    near(shown(&mut app), ([10.0, 10.0, 140.0, 1.0], 2.0));
}

#[test]
fn a_map_that_changes_is_shown_anew() {
    let (mut app, root) = app();
    let handle = app.world().get::<IlluminationRoot>(root).unwrap().0.clone();
    let mut maps = app.world_mut().resource_mut::<Assets<IlluminationMap>>();
    maps.get_mut(&handle).unwrap().exposure_m2_cd = 4.0;
    // The change is told of after the frame.
    app.update();
    app.update();
    near(shown(&mut app), ([6.0, 6.0, 28.0, 1.0], 5.0));
}
