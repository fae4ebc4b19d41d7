//! A scene without a map, for another process of the same build: the container and the arrays of a map file.

use super::arrays::{Arrays, Table};
use super::bytes::{Bytes, View};
use super::document::{BufferView, Objects};
use super::record::SceneRecord;
use super::{MapTooLarge, container, scene_arrays, write};
use isolux::scene::Scene;
use serde::{Deserialize, Serialize};

#[derive(Serialize, Deserialize)]
struct Alone<V> {
    scene: SceneRecord,
    arrays: Table,
    views: Vec<V>,
}

/// The bytes of a scene. They are no file: another version may not read them.
pub fn scene_bytes(scene: &Scene) -> Result<Vec<u8>, MapTooLarge> {
    let (mut bytes, mut arrays) = (Bytes::default(), Table::new());
    let pictures = write::add_textures(scene, &mut Objects::default(), &mut bytes)?;
    let scene = scene_arrays::write(scene.to_parts(), &pictures, &mut bytes, &mut arrays);
    let alone = Alone::<BufferView> { scene, arrays, views: bytes.views };
    let json = serde_json::to_vec(&alone).expect("plain structs with names for keys");
    let mut packed = container::pack(&json, &bytes.content)?;
    packed.extend(blake3::hash(&packed).as_bytes());
    Ok(packed)
}

/// The scene of such bytes, which may be of any origin. The error says what is wrong with them.
pub fn scene_of_bytes(bytes: &[u8]) -> Result<Scene, String> {
    let (packed, _) = bytes
        .split_last_chunk::<{ blake3::OUT_LEN }>()
        .filter(|(packed, hash)| blake3::hash(packed).as_bytes() == *hash)
        .ok_or("they do not match their checksum: they are damaged or cut short")?;
    let container::Chunks { json, binary } = container::unpack(packed)?;
    let alone: Alone<View> = serde_json::from_slice(json).map_err(|error| error.to_string())?;
    let arrays = Arrays { binary, views: &alone.views, table: &alone.arrays };
    let parts = scene_arrays::read(alone.scene, &arrays)
        .map_err(|fault| format!("{}: {}", fault.place, fault.what))?;
    Scene::assemble(parts).map_err(|problems| match problems.first() {
        Some(problem) => format!("{}: {}", problem.place, problem.what),
        None => "it cannot be assembled".to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::scene::{Finish, Material, SceneParts, Shape};
    use isolux::units::Rgb;

    fn example() -> Scene {
        let shape = Shape {
            name: "floor".to_owned(),
            positions: vec![[0.1, 0.0, 0.0], [4.0, 0.0, 1e-7], [0.0, 3.3, 0.0], [4.0, 3.3, 0.0]],
            triangles: vec![[0, 1, 2], [1, 3, 2]],
            ..Shape::default()
        };
        let materials = vec![Material::two_sided("paint", Finish::diffuse(Rgb::grey(0.5)))];
        Scene::assemble(SceneParts { shapes: vec![shape], materials, ..SceneParts::default() })
            .unwrap()
    }

    #[test]
    fn a_scene_comes_back() {
        let scene = example();
        let bytes = scene_bytes(&scene).unwrap();
        let back = scene_of_bytes(&bytes).unwrap();
        assert_eq!(back.hash(), scene.hash());
        assert_eq!(scene_bytes(&back).unwrap(), bytes);
    }

    #[test]
    fn damaged_bytes_are_refused() {
        let bytes = scene_bytes(&example()).unwrap();
        for length in 0..bytes.len() {
            assert!(scene_of_bytes(&bytes[..length]).is_err(), "cut at {length}");
        }
        for at in 0..bytes.len() {
            let mut changed = bytes.clone();
            changed[at] ^= 1;
            assert!(scene_of_bytes(&changed).is_err(), "byte {at}");
        }
    }
}
