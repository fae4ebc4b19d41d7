//! One entry for every reader of files of others: bytes in, and whether they are read. Whoever calls them looks for panics, long runs
//! and memory.

use crate::kept::KEPT;
use crate::seal;
use isolux::engine::MapReader;
use isolux::scene::{Scene, SceneParts};
use isolux_formats::lint::audit;
use isolux_formats::obj::Materials;
use isolux_formats::photometric_file::{PhotometricFile, Target, convert};
use isolux_formats::{
    Loaded, Problems, Reach, cache_file, checkpoint, epw, load, load_with, map_glb, picture,
};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// The longest cache and checkpoint that is read, bytes.
const MOST_BYTES: u64 = 1 << 24;

/// Triangles of maps that are asked for their light.
const ASKED: u32 = 4;

/// Photometric files are converted whose sum of bytes is below this, of 256.
const CONVERTED: u8 = 16;

/// Files that scenes may name, whatever else is wrong with them.
const BESIDE: [(&str, &[u8]); 7] = [
    ("beside.obj", include_bytes!("beside/beside.obj")),
    ("beside.mtl", include_bytes!("beside/beside.mtl")),
    ("beside.png", include_bytes!("beside/beside.png")),
    ("beside.ply", include_bytes!("seeds/ply/ascii.ply")),
    ("beside.rad", b"void plastic p 0 0 5 .5 .5 .5 0 0\np polygon f 0 0 9 0 0 0 1 0 0 0 1 0\n"),
    ("beside.ies", include_bytes!("../../../../scenes/photometry/own/downlight.ies")),
    ("beside.ldt", include_bytes!("../../../../scenes/photometry/photometric-viewer/dummy.ldt")),
];

/// A folder of its own with a few good files in it.
pub(crate) struct Home(TempDir);

impl Home {
    pub(crate) fn new() -> Self {
        let home = Self(tempfile::tempdir().expect("a folder for temporary files"));
        BESIDE.iter().for_each(|(name, bytes)| drop(home.write(name, bytes)));
        home
    }

    fn write(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.0.path().join(name);
        std::fs::write(&path, bytes).expect("space for a small file");
        path
    }
}

/// A reader and how it is called.
pub(crate) struct Entry {
    pub(crate) name: &'static str,
    pub(crate) read: fn(&Home, &[u8]) -> bool,
    /// Repairs what would keep changed bytes from being looked at: checksums and lengths.
    pub(crate) seal: fn(&[u8]) -> Vec<u8>,
}

const fn entry(name: &'static str, read: fn(&Home, &[u8]) -> bool) -> Entry {
    Entry { name, read, seal: <[u8]>::to_vec }
}

/// All of them.
pub(crate) const ENTRIES: [Entry; 18] = [
    entry("gltf", |home, bytes| scene(load(&home.write("scene.gltf", bytes)))),
    Entry {
        seal: seal::container,
        ..entry("glb", |home, bytes| scene(load(&home.write("scene.glb", bytes))))
    },
    entry("obj", |home, bytes| with_both_meanings(&home.write("scene.obj", bytes))),
    entry("mtl", |home, bytes| {
        home.write("hostile.mtl", bytes);
        with_both_meanings(&home.write("scene.obj", include_bytes!("beside/of_hostile_mtl.obj")))
    }),
    entry("ply", |home, bytes| scene(load(&home.write("scene.ply", bytes)))),
    entry("stl", |home, bytes| scene(load(&home.write("scene.stl", bytes)))),
    entry("ies", |_, bytes| lamp(Path::new("lamp.ies"), bytes)),
    entry("ldt", |_, bytes| lamp(Path::new("lamp.ldt"), bytes)),
    entry("rad", |home, bytes| scene(load(&home.write("scene.rad", bytes)))),
    entry("mitsuba", |home, bytes| scene(load(&home.write("scene.xml", bytes)))),
    entry("scene_toml", |home, bytes| scene(load(&home.write("scene.toml", bytes)))),
    entry("epw", |home, bytes| weather(&home.write("place.epw", bytes))),
    entry("hdr", |home, bytes| below(home, "sky.hdr", bytes)),
    entry("exr", |home, bytes| below(home, "sky.exr", bytes)),
    entry("picture", |home, bytes| picture::read(&home.write("picture.png", bytes)).is_ok()),
    Entry { seal: seal::map, ..entry("map", map) },
    Entry {
        seal: seal::checkpoint,
        ..entry("checkpoint", |home, bytes| {
            let read = checkpoint::read(&home.write("map.checkpoint", bytes), MOST_BYTES);
            read.is_ok_and(|read| KEPT.goes_on(&read))
        })
    },
    Entry {
        seal: seal::cache,
        ..entry("cache", |home, bytes| {
            cache_file::read(&home.write("room.cache", bytes), MOST_BYTES).is_ok()
        })
    },
];

/// A refusal says what is wrong; what is read is a scene or no scene, and that is said, too.
fn scene(read: Result<Loaded<SceneParts>, Problems>) -> bool {
    match read {
        Ok(loaded) => Scene::assemble(loaded.value).is_ok(),
        Err(Problems(list)) => {
            assert!(!list.is_empty(), "refused without a word");
            false
        }
    }
}

fn with_both_meanings(path: &Path) -> bool {
    let read = |materials| scene(load_with(path, materials, Reach::Inside));
    read(Materials::AsMeant) & read(Materials::AsWritten)
}

/// What is read as light is light, and the other format holds it or says why not.
fn lamp(path: &Path, bytes: &[u8]) -> bool {
    let audit = audit(path, bytes, PhotometricFile::parse(bytes, path));
    let Some((file, web)) = &audit.usable else {
        assert!(!audit.findings.is_empty(), "refused without a word");
        return false;
    };
    let flux = web.luminous_flux_lm();
    assert!(flux >= 0.0 && flux.is_finite(), "{flux}");
    let target = match file {
        PhotometricFile::Ies(_) => Target::Ldt,
        PhotometricFile::Ldt(_) => Target::Ies,
    };
    // A conversion takes far longer than reading: some are enough.
    if bytes.iter().fold(0, |sum: u8, &byte| sum.wrapping_add(byte)) < CONVERTED {
        drop(convert(file, target));
    }
    true
}

/// What is read has light at the times that it has hours of.
fn weather(path: &Path) -> bool {
    let Ok(Loaded { value, .. }) = epw::read(path) else { return false };
    for hour in &value.hours {
        let at = value.at(hour.month, hour.day, f64::from(hour.hour) - 0.75);
        let is_light = |w: f64| w >= 0.0 && w.is_finite();
        assert!(at.is_none_or(
            |at| is_light(at.direct_normal_w_m2) && is_light(at.diffuse_horizontal_w_m2)
        ));
    }
    true
}

/// A scene below a picture.
fn below(home: &Home, name: &str, bytes: &[u8]) -> bool {
    home.write(name, bytes);
    let text = format!(
        "[materials.a]\ndiffuse = 0.5\n[[geometry]]\nrectangle = {{ corner = [0, 0, 0], u = [1, 0, 0], v = [0, 1, 0] }}\nmaterial = \"a\"\n\
         [sky]\npicture = \"{name}\"\nluminance_factor = 1\n"
    );
    scene(load(&home.write("below.toml", text.as_bytes())))
}

fn map(home: &Home, bytes: &[u8]) -> bool {
    let path = home.write("map.glb", bytes);
    map_glb::is_map(&path);
    map_glb::is_export(&path);
    let Ok(Loaded { value: file, .. }) = map_glb::read_with_texels(&path) else { return false };
    // What is read can be asked.
    let reader = MapReader::new(&file.scene, &file.map);
    for triangle in 0..file.scene.triangle_count().min(ASKED) {
        for back in [false, true] {
            let _ = reader.at(triangle, back, 0.3, 0.3);
        }
    }
    true
}
