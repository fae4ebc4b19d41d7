//! Real photometric files, spoilt at random: each is read or refused, audited and converted, and nothing
//! panics, hangs, or is read as light that is not a number.

#![expect(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

mod spoil;

use isolux_formats::lint::audit;
use isolux_formats::photometric_file::{PhotometricFile, Target, convert};
use spoil::{Dice, spoil};
use std::path::{Path, PathBuf};

/// Spoilt copies of every file; of the larger ones fewer.
const COPIES: usize = 120;
const WORK_BYTES: usize = 200_000;

fn lamps() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/photometry");
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
                spoil(&mut bytes, &mut dice, &WORDS);
            }
            if check(&bytes, &path) { read += 1 } else { refused += 1 }
        }
    }
    // Both must happen often, or the changes are too weak or too strong.
    assert!(read > 500 && refused > 500, "{read} read, {refused} refused");
}
