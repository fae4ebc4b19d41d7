//! A scene to files that can be opened and edited: `scene.toml`, its geometry as glTF, photometric
//! files, textures. Reading them gives the same scene, and of flat geometry the same scene hash.
//! (Shading normals, texture coordinates, and tilted luminaires come back rounded.)

mod arrays;
mod file;
mod geometry;
mod lamps;
mod luminaires;
mod materials;
mod numbers;
mod skies;
mod text;

pub use file::SceneFile;
pub use lamps::NamedPhotometry;

use crate::luminance::LuminanceError;
use crate::png::{self, PngError};
use isolux::scene::{Condition, EmergencyArea, Requirement, SceneParts, Texture, UpAxis};

/// Why a scene cannot be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// A texture cannot be.
    #[error(transparent)]
    Texture(#[from] PngError),
    /// A picture of a sky cannot be.
    #[error(transparent)]
    Sky(#[from] LuminanceError),
}

/// All files of a scene, `scene.toml` first. Photometric files that luminaires were made from, if
/// they are known, are used as they are, with a dimming; others are made.
pub fn write(parts: &SceneParts, known: &[NamedPhotometry]) -> Result<Vec<SceneFile>, WriteError> {
    let catalogue = lamps::Catalogue::of(parts, known);
    let mut toml = head(parts);
    toml += &materials::text(parts);
    toml += &geometry::text(parts);
    toml += &luminaires::text(parts, &catalogue);
    toml += &cameras(parts);
    toml += &grids(parts);
    let mut files = vec![SceneFile::new("scene.toml", toml)];
    files.extend(geometry::files(parts));
    files.extend(catalogue.files());
    for (index, texture) in parts.textures.iter().enumerate() {
        files.push(SceneFile::new(materials::texture_name(index as u32), picture(texture)?));
    }
    files.extend(skies::files(parts)?.into_iter().map(|(name, bytes)| SceneFile::new(name, bytes)));
    Ok(files)
}

fn grids(parts: &SceneParts) -> String {
    let mut toml = String::new();
    for grid in &parts.grids {
        toml += "\n[[grid]]\n";
        toml += &format!("name = {}\n", text::quoted(&grid.name));
        toml += &format!("corner = {}\n", text::triple(grid.corner.into()));
        toml += &format!("u = {}\n", text::triple(grid.u.into()));
        toml += &format!("v = {}\n", text::triple(grid.v.into()));
        if let Some(spacing_m) = grid.spacing_m {
            toml += &format!("spacing = {}\n", text::number(spacing_m));
        }
        toml += &format!("border = {}\n", text::number(grid.border_m));
        toml += &format!("maintenance_factor = {}\n", text::number(grid.maintenance_factor));
        toml += &match grid.emergency {
            None => String::new(),
            Some(EmergencyArea::EscapeRoute) => "emergency = \"escape-route\"\n".to_owned(),
            Some(EmergencyArea::OpenArea) => "emergency = \"open-area\"\n".to_owned(),
            Some(EmergencyArea::HighRisk { task_lx }) => {
                format!("emergency = \"high-risk\"\ntask_lx = {}\n", text::number(task_lx))
            }
        };
    }
    for grid in &parts.grids {
        for requirement in &grid.requirements {
            toml += "\n[[requirement]]\n";
            toml += &format!("grid = {}\n", text::quoted(&grid.name));
            toml += &required(requirement);
        }
    }
    toml
}

fn required(requirement: &Requirement) -> String {
    if let Some(task) = &requirement.task {
        // The title of a task begins with its place in the standard.
        let mut parts = task.split(", ");
        let [standard, row] = [parts.next(), parts.next()].map(Option::unwrap_or_default);
        let standard = standard.split(':').next().unwrap_or_default();
        return format!("task = {}\n", text::quoted(&format!("{standard} {row}")));
    }
    let conditions: Vec<String> = requirement.conditions.iter().map(Condition::text).collect();
    format!("conditions = {}\n", text::quoted(&conditions.join(", ")))
}

fn head(parts: &SceneParts) -> String {
    let up = match parts.up {
        UpAxis::Y => "y",
        UpAxis::Z => "z",
    };
    format!("name = {}\nup = \"{up}\"\nunits = \"m\"\n", text::quoted(&parts.name))
}

fn picture(texture: &Texture) -> Result<Vec<u8>, PngError> {
    png::encode(texture.width, texture.height, texture.srgb.as_chunks().0)
}

/// Directions to a millionth: a camera is no part of what is computed.
fn cameras(parts: &SceneParts) -> String {
    let mut toml = String::new();
    for camera in &parts.cameras {
        let fov_deg = numbers::shortest(camera.vertical_fov_rad.to_degrees(), |deg| {
            deg.to_radians() == camera.vertical_fov_rad
        });
        toml += "\n[[camera]]\n";
        toml += &format!("name = {}\n", text::quoted(&camera.name));
        toml += &format!("position = {}\n", text::triple(camera.position.into()));
        let rounded = |direction: isolux::geometry::Direction| {
            text::triple(<[f64; 3]>::from(direction.to_vector()).map(numbers::to_millionth))
        };
        toml += &format!("direction = {}\n", rounded(camera.direction));
        if camera.up != parts.up.direction() {
            toml += &format!("up = {}\n", rounded(camera.up));
        }
        toml += &format!("vertical_fov_deg = {}\n", text::number(fov_deg));
    }
    toml
}
