//! One map as the page has it: its scene, and the newest mesh and light.

use isolux::map::IlluminationMap;
use isolux::scene::Scene;
use isolux_formats::walk::{Light, Mesh};
use std::sync::{Arc, PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard};

/// What is shown of one map.
pub(crate) struct World {
    scene: Arc<Scene>,
    /// Container of the scene.
    scene_bytes: RwLock<Arc<[u8]>>,
    drawn: RwLock<Option<Drawn>>,
}

/// What of a map is drawn.
struct Drawn {
    mesh: Mesh,
    mesh_bytes: Arc<[u8]>,
    light: Light,
    /// What it was made of.
    map: Arc<IlluminationMap>,
}

/// Numbers of a mesh and of its light; zero where there is none yet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Versions {
    pub(crate) mesh: u64,
    pub(crate) light: u64,
}

impl World {
    /// A scene without light.
    pub(crate) fn new(scene: Arc<Scene>, container: Vec<u8>) -> Self {
        let scene_bytes = RwLock::new(container.into());
        Self { scene, scene_bytes, drawn: RwLock::new(None) }
    }

    /// The scene.
    pub(crate) fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    /// Shows a map: its light alone is new if its elements are those that are drawn.
    pub(crate) fn show(&self, map: &Arc<IlluminationMap>) {
        let number = {
            let mut drawn = self.write();
            if let Some(drawn) = &mut *drawn
                && drawn.light.update(&drawn.mesh, map)
            {
                drawn.map = Arc::clone(map);
                return;
            }
            drawn.as_ref().map_or(1, |drawn| drawn.mesh.number() + 1)
        };
        let mesh = Mesh::new(&self.scene, map, number);
        let light = Light::new(&mesh, map);
        self.draw(mesh, light, Arc::clone(map));
    }

    /// Shows a mesh with light that is made already.
    pub(crate) fn draw(&self, mesh: Mesh, light: Light, map: Arc<IlluminationMap>) {
        let mesh_bytes = mesh.to_bytes().into();
        *self.write() = Some(Drawn { mesh, mesh_bytes, light, map });
    }

    /// Replaces what is told of the scene.
    pub(crate) fn tell(&self, container: Vec<u8>) {
        *self.scene_bytes.write().unwrap_or_else(PoisonError::into_inner) = container.into();
    }

    /// What can be fetched.
    pub(crate) fn versions(&self) -> Versions {
        let of =
            |drawn: &Drawn| Versions { mesh: drawn.mesh.number(), light: drawn.light.version() };
        self.read().as_ref().map(of).unwrap_or_default()
    }

    /// The map that is shown.
    pub(crate) fn map(&self) -> Option<Arc<IlluminationMap>> {
        self.read().as_ref().map(|drawn| Arc::clone(&drawn.map))
    }

    /// Container of the scene.
    pub(crate) fn scene_bytes(&self) -> Arc<[u8]> {
        Arc::clone(&self.scene_bytes.read().unwrap_or_else(PoisonError::into_inner))
    }

    /// Container of the mesh, if there is one yet.
    pub(crate) fn mesh_bytes(&self) -> Option<Arc<[u8]>> {
        self.read().as_ref().map(|drawn| Arc::clone(&drawn.mesh_bytes))
    }

    /// Container of the light since a version; nothing if the mesh is another by now.
    pub(crate) fn light_bytes(&self, mesh: u64, since: u64) -> Option<Vec<u8>> {
        let drawn = self.read();
        let drawn = drawn.as_ref().filter(|drawn| drawn.mesh.number() == mesh)?;
        Some(drawn.light.to_bytes(since))
    }

    fn read(&self) -> RwLockReadGuard<'_, Option<Drawn>> {
        self.drawn.read().unwrap_or_else(PoisonError::into_inner)
    }

    fn write(&self) -> RwLockWriteGuard<'_, Option<Drawn>> {
        self.drawn.write().unwrap_or_else(PoisonError::into_inner)
    }
}
