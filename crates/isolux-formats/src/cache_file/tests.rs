use super::*;
use crate::cache_file::sample::SAMPLE_BYTES;
use isolux::engine::{CACHE_REPLICATES, SampleKind};
use isolux::geometry::{Direction, Point};
use isolux::units::Rgb;
use std::fs;

const ENOUGH: u64 = 1 << 20;
const SCENE: (&str, &str) = ("room", "abcd");

/// Numbers that single precision holds.
fn sample(number: u32) -> CacheSample {
    let lx = f64::from(number);
    CacheSample {
        kind: if number.is_multiple_of(2) { SampleKind::Near } else { SampleKind::Far },
        position: Point::new(lx, 0.1, -2.0),
        normal: Direction::Y.to_normal(),
        triangle: number,
        radius_m: 0.3,
        nearest_m: f64::INFINITY,
        replicates_lx: [Rgb::grey(lx + 0.5); CACHE_REPLICATES],
        along: [Rgb::new(1.0, -2.0, 3.0); 3],
        turning: [Rgb::grey(-0.25); 3],
    }
}

fn open(path: &Path) -> (CacheFile, Found) {
    CacheFile::open(path, SCENE, ENOUGH).unwrap()
}

fn samples(range: std::ops::Range<u32>) -> Vec<CacheSample> {
    range.map(sample).collect()
}

/// A file of two blocks.
fn written(folder: &tempfile::TempDir) -> (PathBuf, Vec<u8>) {
    let path = folder.path().join("room.cache");
    let (mut file, found) = open(&path);
    assert_eq!(found, Found::default());
    file.append(&samples(0..3)).unwrap();
    file.append(&samples(3..5)).unwrap();
    let bytes = fs::read(&path).unwrap();
    (path, bytes)
}

#[test]
fn samples_come_back() {
    let folder = tempfile::tempdir().unwrap();
    let (path, _) = written(&folder);
    assert_eq!(open(&path).1.cache.samples, samples(0..5));
    assert!(is_cache(&path));
    let (head, found) = read(&path, ENOUGH).unwrap();
    assert_eq!((head.scene.as_str(), head.scene_hash.as_str()), SCENE);
    assert_eq!((found.cache.samples.len(), found.warning), (5, None));
}

#[test]
fn who_appends_learns_what_others_have_appended() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("room.cache");
    let ((mut one, _), (mut other, _)) = (open(&path), open(&path));
    assert_eq!(one.append(&samples(0..2)).unwrap().cache.samples, []);
    assert_eq!(other.append(&samples(2..3)).unwrap().cache.samples, samples(0..2));
    assert_eq!(one.append(&samples(3..4)).unwrap().cache.samples, samples(2..3));
    assert_eq!(open(&path).1.cache.samples, samples(0..4));
}

/// Threads stand for processes: locks belong to what is opened.
#[test]
fn many_may_append_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("room.cache");
    std::thread::scope(|scope| {
        for writer in 0..4 {
            let path = &path;
            scope.spawn(move || {
                let (mut file, _) = open(path);
                for round in 0..8 {
                    let first = 100 * writer + 3 * round;
                    file.append(&samples(first..first + 3)).unwrap();
                }
            });
        }
    });
    let mut numbers: Vec<u32> =
        open(&path).1.cache.samples.iter().map(|sample| sample.triangle).collect();
    numbers.sort_unstable();
    let expected: Vec<u32> = (0..4).flat_map(|writer| 100 * writer..100 * writer + 24).collect();
    assert_eq!(numbers, expected);
}

#[test]
fn another_scene_is_refused_and_its_file_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let (path, bytes) = written(&folder);
    let refused = CacheFile::open(&path, ("room", "abce"), ENOUGH).unwrap_err();
    assert!(refused.what.contains("another scene"), "{refused}");
    // Made meanwhile by somebody else.
    let later = folder.path().join("later.cache");
    let (mut file, _) = CacheFile::open(&later, ("hall", "ffff"), ENOUGH).unwrap();
    fs::write(&later, &bytes).unwrap();
    assert!(file.append(&samples(0..1)).unwrap_err().what.contains("another scene"));
    assert_eq!(fs::read(&later).unwrap(), bytes);
}

#[test]
fn a_block_cut_short_is_left_out_and_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let (path, bytes) = written(&folder);
    let second = bytes.len() - (8 + 2 * SAMPLE_BYTES + blake3::OUT_LEN);
    for length in second + 1..bytes.len() {
        fs::write(&path, &bytes[..length]).unwrap();
        let (mut file, found) = open(&path);
        assert_eq!(found.cache.samples, samples(0..3), "cut at {length}");
        assert!(found.warning.unwrap().what.contains("cut short"));
        file.append(&samples(3..5)).unwrap();
        assert_eq!(fs::read(&path).unwrap(), bytes, "cut at {length}");
    }
}

#[test]
fn every_cut_of_the_head_and_every_changed_byte_is_noticed() {
    let folder = tempfile::tempdir().unwrap();
    let (path, bytes) = written(&folder);
    let first = bytes.len() - (8 + 2 * SAMPLE_BYTES) - (8 + 3 * SAMPLE_BYTES) - 2 * blake3::OUT_LEN;
    for length in 1..first {
        fs::write(&path, &bytes[..length]).unwrap();
        assert!(CacheFile::open(&path, SCENE, ENOUGH).is_err(), "cut at {length}");
    }
    for at in 0..bytes.len() {
        let mut changed = bytes.clone();
        changed[at] ^= 0x10;
        fs::write(&path, &changed).unwrap();
        let seen = CacheFile::open(&path, SCENE, ENOUGH);
        // A larger count of samples is a block cut short.
        assert!(seen.is_err() || seen.is_ok_and(|(_, f)| f.warning.is_some()), "byte {at}");
    }
}

#[test]
fn false_declarations_are_refused_even_with_a_checksum() {
    let sealed = |mut content: Vec<u8>| {
        let hash = blake3::hash(&content);
        content.extend(hash.as_bytes());
        content
    };
    let head = Head::new(SCENE.0, SCENE.1).pack();
    let block = |count: u32, payload: &[u8]| {
        let content = [b"SAMP", &count.to_le_bytes()[..], payload].concat();
        [head.clone(), sealed(content)].concat()
    };
    let mut wrong_kind = pack(&samples(0..1))[8..8 + SAMPLE_BYTES].to_vec();
    wrong_kind[0] = 2;
    let mut no_normal = pack(&samples(0..1))[8..8 + SAMPLE_BYTES].to_vec();
    no_normal[32..56].fill(0);
    let head_of = |bytes: u32| {
        let prefix = [head::MAGIC, &1_u32.to_le_bytes()[..], &bytes.to_le_bytes()].concat();
        sealed(prefix)
    };
    let newer = sealed([head::MAGIC, &9_u32.to_le_bytes()[..], &[0; 4]].concat());
    for (bytes, said) in [
        (block(u32::MAX, &[]), "more than 65536"),
        (block(1, &wrong_kind), "cannot be one"),
        (block(1, &no_normal), "cannot be one"),
        ([head.clone(), b"something".to_vec()].concat(), "where a block should begin"),
        (head_of(u32::MAX), "declares a head"),
        (head_of(7), "cut short"),
        (head_of(0), "broken head"),
        (newer, "format 9"),
        (b"PNG or so".to_vec(), "not a cache"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("hostile.cache");
        fs::write(&path, &bytes).unwrap();
        let found = CacheFile::open(&path, SCENE, ENOUGH).unwrap_err();
        assert!(found.what.contains(said), "{found}");
        assert!(!found.remedy.is_empty());
    }
}

#[test]
fn what_is_too_large_or_no_file_is_refused_before_it_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let (path, bytes) = written(&folder);
    let small = bytes.len() as u64 - 1;
    assert!(CacheFile::open(&path, SCENE, small).unwrap_err().what.contains("allowed"));
    let (mut file, _) = CacheFile::open(&path, SCENE, small + 1).unwrap();
    assert!(file.append(&samples(0..1)).unwrap_err().what.contains("allowed"));
    assert_eq!(fs::read(&path).unwrap(), bytes);
    let found = CacheFile::open(folder.path(), SCENE, ENOUGH).unwrap_err();
    assert!(found.what.contains("not a regular file"), "{found}");
    let missing = folder.path().join("missing/room.cache");
    assert!(CacheFile::open(&missing, SCENE, ENOUGH).is_err());
}
