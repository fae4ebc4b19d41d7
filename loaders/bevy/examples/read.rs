//! Reads a map at points, without a window, and says what its meshes show there.
//!
//! Usage: `read LIGHT.glb POINTS.pts [GROUP=LEVEL]...`; points are those of `isolux probe`, `x y z nx ny nz` a line. Prints a JSON array.

use bevy_app::{App, AppExit, ScheduleRunnerPlugin, Startup, TaskPoolPlugin, Update};
use bevy_asset::{AssetPlugin, AssetServer, Assets, LoadState};
use bevy_ecs::prelude::*;
use bevy_math::DVec3;
use bevy_mesh::{Mesh, Mesh3d, MeshPlugin, VertexAttributeValues};
use isolux_bevy::{
    ATTRIBUTE_ILLUMINANCE_LX, IlluminationMap, IlluminationPlugin, IlluminationRoot, Levels,
    LitSurface, Reading,
};
use std::path::Path;
use std::time::{Duration, Instant};

/// A map is read in less.
const PATIENCE: Duration = Duration::from_secs(60);

#[derive(Resource)]
struct Asked {
    file: String,
    points: Vec<[DVec3; 2]>,
    levels: Vec<(String, f32)>,
    started: Instant,
    /// Whether groups are dimmed already: that is done once the map is shown undimmed.
    is_dimmed: bool,
}

fn main() -> AppExit {
    let given: Vec<String> = std::env::args().skip(1).collect();
    let (folder, asked) = match asked(&given) {
        Ok(asked) => asked,
        Err(message) => {
            eprintln!("{message}");
            return AppExit::from_code(2);
        }
    };
    App::new()
        .add_plugins((
            TaskPoolPlugin::default(),
            ScheduleRunnerPlugin::run_loop(Duration::from_millis(5)),
            AssetPlugin { file_path: folder, ..AssetPlugin::default() },
            MeshPlugin,
            IlluminationPlugin,
        ))
        .insert_resource(asked)
        .add_systems(
            Startup,
            |mut commands: Commands, asked: Res<Asked>, assets: Res<AssetServer>| {
                commands.spawn(IlluminationRoot(assets.load(&asked.file)));
            },
        )
        .add_systems(Update, tell)
        .run()
}

fn asked(given: &[String]) -> Result<(String, Asked), String> {
    let [map, points, levels @ ..] = given else {
        return Err("usage: read LIGHT.glb POINTS.pts [GROUP=LEVEL]...".to_owned());
    };
    let map = std::path::absolute(map).map_err(|e| format!("{map}: {e}"))?;
    let folder = map.parent().unwrap_or(Path::new("/")).to_string_lossy().into_owned();
    let file = map.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let text = std::fs::read_to_string(points).map_err(|e| format!("{points}: {e}"))?;
    let points =
        text.lines().map(|line| point(line).ok_or(format!("{points}: {line}: is no point")));
    let levels = levels.iter().map(|level| {
        let (group, number) =
            level.rsplit_once('=').ok_or(format!("{level}: is no GROUP=LEVEL"))?;
        let number = number.parse().map_err(|e| format!("{level}: {e}"))?;
        Ok::<_, String>((group.to_owned(), number))
    });
    let asked = Asked {
        file,
        points: points.collect::<Result<_, _>>()?,
        levels: levels.collect::<Result<_, _>>()?,
        started: Instant::now(),
        is_dimmed: false,
    };
    Ok((folder, asked))
}

fn point(line: &str) -> Option<[DVec3; 2]> {
    let numbers: Result<Vec<f64>, _> = line.split_whitespace().map(str::parse).collect();
    let [x, y, z, nx, ny, nz] = numbers.ok()?[..] else { return None };
    Some([DVec3::new(x, y, z), DVec3::new(nx, ny, nz)])
}

/// Dims, and a frame later prints.
fn tell(
    mut asked: ResMut<Asked>,
    (assets, maps, meshes): (Res<AssetServer>, Res<Assets<IlluminationMap>>, Res<Assets<Mesh>>),
    mut roots: Query<(&IlluminationRoot, &mut Levels)>,
    surfaces: Query<(&LitSurface, &Mesh3d)>,
    mut exit: MessageWriter<AppExit>,
) {
    let Ok((root, mut levels)) = roots.single_mut() else { return };
    let mut refuse = |why: &str| {
        // Bevy adds where in its own code that was.
        eprintln!("{}", why.lines().next().unwrap_or_default());
        exit.write(AppExit::error());
    };
    if let LoadState::Failed(why) = assets.load_state(&root.0) {
        return refuse(&why.to_string());
    }
    if asked.started.elapsed() > PATIENCE {
        return refuse(&format!("{}: was not loaded in {} s", asked.file, PATIENCE.as_secs()));
    }
    let Some(map) = maps.get(&root.0).filter(|_| !surfaces.is_empty()) else { return };
    if let Some((name, _)) = asked.levels.iter().find(|(name, _)| !map.groups.contains(name)) {
        return refuse(&format!("{}: has no group {name}, but {:?}", asked.file, map.groups));
    }
    if !asked.is_dimmed {
        asked.is_dimmed = true;
        asked.levels.iter().for_each(|(group, level)| levels.set(group, *level));
        return;
    }
    // Colours follow in the frame after that, as this system may run before theirs.
    if levels.is_changed() {
        return;
    }
    let told = asked.points.iter().map(|[place, normal]| {
        let reading = map.read_near(&levels, *place, *normal).map(|(reading, _)| reading);
        let shown = surfaces.iter().filter_map(|(of, mesh)| Some((of.index, meshes.get(&mesh.0)?)));
        let shown = shown
            .filter_map(|(index, mesh)| at_vertex(&map.surfaces[index].positions, mesh, *place));
        json(reading, shown.collect())
    });
    println!("[{}]", told.collect::<Vec<_>>().join(",\n"));
    exit.write(AppExit::Success);
}

/// The illuminance and the colour that a mesh has at a vertex, if it has one at that place.
fn at_vertex(positions: &[[f32; 3]], mesh: &Mesh, place: DVec3) -> Option<([f32; 3], [f32; 4])> {
    let wanted = place.as_vec3().to_array();
    let vertex = positions.iter().position(|position| *position == wanted)?;
    match (mesh.attribute(ATTRIBUTE_ILLUMINANCE_LX)?, mesh.attribute(Mesh::ATTRIBUTE_COLOR)?) {
        (VertexAttributeValues::Float32x3(lx), VertexAttributeValues::Float32x4(colours)) => {
            Some((lx[vertex], colours[vertex]))
        }
        _ => None,
    }
}

fn json(reading: Option<Reading>, shown: Vec<([f32; 3], [f32; 4])>) -> String {
    let number = |value: Option<f64>| value.map_or("null".to_owned(), |value| value.to_string());
    let shown: Vec<String> = shown
        .iter()
        .map(|(lx, colour)| format!("{{\"lx\": {lx:?}, \"colour\": {colour:?}}}"))
        .collect();
    format!(
        "{{\"illuminance_lx\": {}, \"standard_error_lx\": {}, \"direct_lx\": {}, \"vertices\": [{}]}}",
        number(reading.map(|r| r.illuminance_lx)),
        number(reading.and_then(|r| r.standard_error_lx)),
        number(reading.and_then(|r| r.direct_lx)),
        shown.join(", ")
    )
}
