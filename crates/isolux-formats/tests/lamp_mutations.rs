//! Real photometric files, spoilt at random: each is read or refused, audited and converted, and nothing
//! panics, hangs, or is read as light that is not a number.

#![expect(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use isolux_formats::lint::audit;
use isolux_formats::photometric_file::{PhotometricFile, Target, convert};
use std::path::{Path, PathBuf};

/// Spoilt copies of every file; of the larger ones fewer.
const COPIES: usize = 120;
const WORK_BYTES: usize = 200_000;

/// SplitMix64 (Steele, Lea, Flood 2014).
struct Dice(u64);

impl Dice {
    fn below(&mut self, most: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % most.max(1) as u64) as usize
    }
}

fn lamps() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/photometry");
    let folders = std::fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path());
    let files = folders
        .filter(|path| path.is_dir())
        .flat_map(|folder| std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()));
    let is_lamp = |path: &PathBuf| path.extension().is_some_and(|e| e == "ies" || e == "ldt");
    let mut files: Vec<PathBuf> = files.filter(is_lamp).collect();
    files.sort();
    files
}

/// What files are spoilt with: numbers at the edges of what is meant.
const WORDS: [&str; 16] = [
    "0",
    "-1",
    "1",
    "-90",
    "90",
    "180",
    "360",
    "1e308",
    "-1e-308",
    "4294967296",
    "1048577",
    "nan",
    "0,5",
    "TILT=INCLUDE",
    "",
    "1e15",
];

/// One change: a byte, a word, a stretch left out, doubled or moved, or the end cut off.
fn spoil(bytes: &mut Vec<u8>, dice: &mut Dice) {
    let at = dice.below(bytes.len());
    let end = (at + 1 + dice.below(80)).min(bytes.len());
    match dice.below(7) {
        0 => bytes[at] = dice.below(256) as u8,
        1 => bytes.truncate(at + 1),
        2 => drop(bytes.drain(at..end)),
        3 => {
            let copy = bytes[at..end].to_vec();
            bytes.splice(at..at, copy);
        }
        4 => {
            let copy: Vec<u8> = bytes.drain(at..end).collect();
            let to = dice.below(bytes.len());
            bytes.splice(to..to, copy);
        }
        _ => {
            let is_space = |b: &u8| b.is_ascii_whitespace();
            let start = bytes[..at].iter().rposition(is_space).map_or(0, |k| k + 1);
            let stop = bytes[at..].iter().position(is_space).map_or(bytes.len(), |k| at + k);
            let word = WORDS[dice.below(WORDS.len())].bytes();
            bytes.splice(start..stop.max(start), word);
        }
    }
    if bytes.is_empty() {
        bytes.push(b'0');
    }
}

/// Whether the bytes are read.
fn check(bytes: &[u8], path: &Path) -> bool {
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
    // The other format may be unable to hold it, and says so.
    let _ = convert(file, target);
    true
}

#[test]
fn spoilt_files_are_read_or_refused() {
    let mut dice = Dice(1);
    let (mut read, mut refused) = (0, 0);
    for path in lamps() {
        let good = std::fs::read(&path).unwrap();
        assert!(check(&good, &path), "{}", path.display());
        for _ in 0..COPIES.min(WORK_BYTES / good.len()) {
            let mut bytes = good.clone();
            for _ in 0..=dice.below(3) {
                spoil(&mut bytes, &mut dice);
            }
            if check(&bytes, &path) { read += 1 } else { refused += 1 }
        }
    }
    // Both must happen often, or the changes are too weak or too strong.
    assert!(read > 500 && refused > 500, "{read} read, {refused} refused");
}
