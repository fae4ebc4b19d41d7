//! Good files to begin with: small ones of this folder, of the repository, and some that are written here.

use crate::example;
use crate::kept::KEPT;
use isolux::engine::{CACHE_REPLICATES, CacheSample, SampleKind};
use isolux::geometry::{Direction, Point};
use isolux::units::Rgb;
use isolux_formats::cache_file::CacheFile;
use isolux_formats::luminance::{Luminances, encode_exr, encode_radiance};
use isolux_formats::map_glb::{self, Preview};
use std::path::{Path, PathBuf};

/// Longer files of the repository are no seeds: changes would be lost in them.
const LONGEST_BYTES: usize = 12_000;

/// Folders of the repository, the kind of file in them, and the entry that reads those.
const FOLDERS: [(&str, &str, &str); 9] = [
    ("tests/data/gltf", "glb", "glb"),
    ("../../scenes/cornell_mcguire", "obj", "obj"),
    ("../../scenes/cornell_embree", "obj", "obj"),
    ("../../scenes/cornell_mcguire", "mtl", "mtl"),
    ("../../scenes/photometry/own", "ies", "ies"),
    ("../../scenes/photometry/photometric-viewer", "ies", "ies"),
    ("../../scenes/photometry/photometric-viewer", "ldt", "ldt"),
    ("../../scenes/cornell_mitsuba", "xml", "mitsuba"),
    ("tests/hostile/beside", "png", "picture"),
];

fn under(folder: &str) -> PathBuf {
    Path::new(crate::FORMATS).join(folder)
}

/// The files of a folder in the order of their names; none where there is no folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.is_file());
    paths.sort();
    paths
}

/// The files with which an entry begins.
pub(crate) fn of(entry: &str) -> Vec<Vec<u8>> {
    let own = files(&under("tests/hostile/seeds").join(entry));
    let folders = FOLDERS.iter().filter(|(_, _, reader)| *reader == entry);
    let others = folders.flat_map(|(folder, kind, _)| {
        files(&under(folder))
            .into_iter()
            .filter(|path| path.extension().is_some_and(|e| e == *kind))
    });
    let read = own.into_iter().chain(others).map(|path| std::fs::read(path).unwrap());
    read.filter(|bytes| bytes.len() <= LONGEST_BYTES).chain(written(entry)).collect()
}

/// What once did harm to an entry.
pub(crate) fn found(entry: &str) -> Vec<Vec<u8>> {
    let files = files(&under("tests/hostile/found").join(entry)).into_iter();
    files.map(|path| std::fs::read(path).unwrap()).collect()
}

/// What once did harm and is too long to be kept as a file.
pub(crate) fn long(entry: &str) -> Option<Vec<u8>> {
    match entry {
        // The folder was read again for every name.
        "obj" => Some(format!("mtllib{}\nv 0 0 0\nf 1 1 1\n", " a<b".repeat(50_000)).into_bytes()),
        _ => None,
    }
}

fn written(entry: &str) -> Vec<Vec<u8>> {
    match entry {
        "map" => vec![map()],
        "epw" => vec![weather()],
        "hdr" => vec![encode_radiance(&surroundings()).unwrap()],
        "exr" => vec![encode_exr(&surroundings()).unwrap()],
        "checkpoint" => KEPT.files.to_vec(),
        "cache" => vec![cache()],
        _ => Vec::new(),
    }
}

fn cache() -> Vec<u8> {
    let home = tempfile::tempdir().unwrap();
    let path = home.path().join("seed");
    let (mut file, _) = CacheFile::open(&path, ("room", "abcd"), 1 << 20).unwrap();
    file.append(&[sample(0), sample(1)]).unwrap();
    file.append(&[sample(2)]).unwrap();
    std::fs::read(path).unwrap()
}

const PIXELS: [[f32; 3]; 128] = [[0.5, 2.0, 1e4]; 128];

fn surroundings() -> Luminances<'static> {
    Luminances { width: 16, height: 8, rgb_cd_m2: &PIXELS }
}

/// Two days of hours.
fn weather() -> Vec<u8> {
    let mut text = String::from(
        "LOCATION,Berlin,-,DEU,Test,103840,52.47,13.40,1.0,49.0\nCOMMENTS 1,none\nDATA PERIODS,1,1,Data,Sunday,6/21,6/22\n",
    );
    for hour in 0..48 {
        let (day, of_day) = (21 + hour / 24, 1 + hour % 24);
        text += &format!(
            "2001,6,{day},{of_day},0,?9,20,11,50,101325,0,0,300,600,500,100,9e4,8e4,999999,0\n"
        );
    }
    text.into_bytes()
}

fn map() -> Vec<u8> {
    let scene = example::scene();
    let map = example::map(&scene);
    map_glb::write(&scene, &map, &Preview::automatic(&scene, &map)).unwrap()
}

fn sample(triangle: u32) -> CacheSample {
    CacheSample {
        kind: if triangle == 0 { SampleKind::Near } else { SampleKind::Far },
        position: Point::new(0.5, 0.1, -2.0),
        normal: Direction::Y.to_normal(),
        triangle,
        radius_m: 0.3,
        nearest_m: 0.2,
        replicates_lx: [Rgb::grey(0.5); CACHE_REPLICATES],
        along: [Rgb::new(1.0, -2.0, 3.0); 3],
        turning: [Rgb::grey(-0.25); 3],
    }
}
