//! Shows the white card to Bevy, without a window, and prints the codes of eight bits that it has in the middle.
//!
//! Usage: `isolux-bevy-judge FOLDER texels WHITE_CD_M2` for `card.glb` with `card.ktx2`, both of `--layout texels`, exposed so
//! that this luminance is white; `isolux-bevy-judge FOLDER vertices` for `card.glb` with colours of vertices, as it is.

use bevy::app::ScheduleRunnerPlugin;
use bevy::asset::{LoadState, RenderAssetUsages};
use bevy::camera::{Exposure, OrthographicProjection, RenderTarget, ScalingMode};
use bevy::core_pipeline::tonemapping::{DebandDither, Tonemapping};
use bevy::image::ImageLoaderSettings;
use bevy::pbr::Lightmap;
use bevy::prelude::*;
use bevy::render::gpu_readback::{Readback, ReadbackComplete};
use bevy::render::render_resource::{Extent3d, TextureDimension, TextureFormat, TextureUsages};
use bevy::window::ExitCondition;
use std::time::{Duration, Instant};

/// Pixels each way; a row of copied ones has to be a multiple of 256 bytes.
const SIZE: u32 = 64;
/// Shaders are made in the background, and without a graphics card that takes its time.
const PATIENCE: Duration = Duration::from_secs(120);
/// So many pictures in a row have to agree.
const AGREEING: u32 = 5;

#[derive(Resource)]
struct Asked {
    /// What is white where light is in texels.
    white_cd_m2: Option<f32>,
    started: Instant,
}

#[derive(Resource)]
struct Shown {
    scene: Handle<WorldAsset>,
    lightmap: Option<Handle<Image>>,
    codes: [u8; 3],
    agreeing: u32,
}

fn main() -> AppExit {
    let given: Vec<String> = std::env::args().skip(1).collect();
    let (folder, white_cd_m2) = match given.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [folder, "vertices"] => (folder.to_owned(), None),
        [folder, "texels", white] if white.parse::<f32>().is_ok_and(|white| white > 0.0) => {
            (folder.to_owned(), white.parse().ok())
        }
        _ => {
            eprintln!("usage: isolux-bevy-judge FOLDER vertices | FOLDER texels WHITE_CD_M2");
            return AppExit::from_code(2);
        }
    };
    let window =
        WindowPlugin { primary_window: None, exit_condition: ExitCondition::DontExit, ..default() };
    App::new()
        .add_plugins(DefaultPlugins.set(window).set(AssetPlugin { file_path: folder, ..default() }))
        .add_plugins(ScheduleRunnerPlugin::run_loop(Duration::from_millis(20)))
        .insert_resource(ClearColor(Color::BLACK))
        // All light is in the file.
        .insert_resource(GlobalAmbientLight::NONE)
        .insert_resource(Asked { white_cd_m2, started: Instant::now() })
        .add_systems(Startup, set_up)
        .add_systems(Update, (light, finish))
        .run()
}

fn set_up(
    mut commands: Commands,
    mut images: ResMut<Assets<Image>>,
    assets: Res<AssetServer>,
    asked: Res<Asked>,
) {
    let size = Extent3d { width: SIZE, height: SIZE, depth_or_array_layers: 1 };
    let format = TextureFormat::Rgba8UnormSrgb;
    let mut picture =
        Image::new_fill(size, TextureDimension::D2, &[0; 4], format, RenderAssetUsages::default());
    picture.texture_descriptor.usage =
        TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_SRC | TextureUsages::RENDER_ATTACHMENT;
    let picture = images.add(picture);
    commands.spawn(Readback::texture(picture.clone())).observe(read);
    let scene = assets.load(GltfAssetLabel::Scene(0).from_asset("card.glb"));
    commands.spawn(WorldAssetRoot(scene.clone()));
    let lightmap = asked.white_cd_m2.map(|_| {
        let linear = |settings: &mut ImageLoaderSettings| settings.is_srgb = false;
        assets.load_builder().with_settings(linear).load("card.ktx2")
    });
    // Up to 1.2 x 2^EV cd/m2 do not saturate.
    let ev100 = asked.white_cd_m2.map_or(0.0, |white| (white / 1.2).log2());
    let projection = OrthographicProjection {
        scaling_mode: ScalingMode::Fixed { width: 0.4, height: 0.4 },
        ..OrthographicProjection::default_3d()
    };
    // Above the middle of the card, which lies from (0, 0, 0) to (1, 0, -1).
    let above = Transform::from_xyz(0.5, 1.0, -0.5).looking_at(Vec3::new(0.5, 0.0, -0.5), -Vec3::Z);
    commands.spawn((
        Camera3d::default(),
        RenderTarget::Image(picture.into()),
        Projection::Orthographic(projection),
        Exposure { ev100 },
        Tonemapping::None,
        DebandDither::Disabled,
        Msaa::Off,
        above,
    ));
    commands.insert_resource(Shown { scene, lightmap, codes: [0; 3], agreeing: 0 });
}

/// What a project has to do with a lightmap: Bevy does not read where a file refers to one.
fn light(
    mut commands: Commands,
    mut materials: ResMut<Assets<StandardMaterial>>,
    meshes: Query<(Entity, &MeshMaterial3d<StandardMaterial>), Without<Lightmap>>,
    shown: Res<Shown>,
) {
    let Some(image) = &shown.lightmap else { return };
    for (entity, material) in &meshes {
        if let Some(mut material) = materials.get_mut(material) {
            material.lightmap_exposure = 1.0;
            commands.entity(entity).insert(Lightmap { image: image.clone(), ..default() });
        }
    }
}

fn read(event: On<ReadbackComplete>, mut shown: ResMut<Shown>) {
    let middle = 4 * (SIZE * SIZE / 2 + SIZE / 2) as usize;
    let Some(&[r, g, b]) = event.data.get(middle..middle + 3).and_then(|rgb| rgb.as_array()) else {
        return;
    };
    shown.agreeing = if shown.codes == [r, g, b] { shown.agreeing + 1 } else { 0 };
    shown.codes = [r, g, b];
}

/// Ends when the picture is there, and stays.
fn finish(
    asked: Res<Asked>,
    shown: Res<Shown>,
    assets: Res<AssetServer>,
    mut exit: MessageWriter<AppExit>,
) {
    if let LoadState::Failed(why) = assets.load_state(&shown.scene) {
        eprintln!("card.glb: {why}");
        exit.write(AppExit::error());
    } else if shown.codes != [0; 3] && shown.agreeing >= AGREEING {
        let [r, g, b] = shown.codes;
        println!("codes {r} {g} {b}");
        exit.write(AppExit::Success);
    } else if asked.started.elapsed() > PATIENCE {
        eprintln!("nothing was drawn in {} s", PATIENCE.as_secs());
        exit.write(AppExit::error());
    }
}
