//! Checkpoints as files.

use super::Checkpoint;
use crate::{Problem, atomic};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::HashSet;
use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

const MAGIC: &[u8; 8] = b"ISOLUXCK";
const VERSION: u32 = 2;
const PREFIX_BYTES: usize = 16;
const HASH_BYTES: usize = blake3::OUT_LEN;
const NO_CHECKPOINT: &str = "it is not a checkpoint, a pilot or a part of a run of isolux";
const START_ANEW: &str = "remove it, and compute anew what it was of";

#[derive(Serialize, Deserialize)]
struct Contents<H> {
    header: H,
    arrays: Vec<Entry>,
}

#[derive(Serialize, Deserialize)]
struct Entry {
    name: String,
    bytes: usize,
}

/// Writes a checkpoint in place of an older one: at any moment one of the two is there, whole.
pub fn write(path: &Path, checkpoint: &Checkpoint) -> Result<(), Problem> {
    let bytes = to_bytes(checkpoint)
        .map_err(|what| Problem::new(path, "header", what, "keep less in it"))?;
    atomic::write(path, &bytes)
}

/// The bytes of a checkpoint as a file. The error is a header of more than 4 GiB.
pub fn to_bytes(checkpoint: &Checkpoint) -> Result<Vec<u8>, String> {
    let entry =
        |(name, bytes): &(String, Vec<u8>)| Entry { name: name.clone(), bytes: bytes.len() };
    let contents = Contents {
        header: &checkpoint.header,
        arrays: checkpoint.arrays.iter().map(entry).collect(),
    };
    let json = serde_json::to_vec(&contents).expect("JSON of JSON with names for keys");
    let Ok(json_length) = u32::try_from(json.len()) else {
        return Err(format!("the header takes {} bytes, more than 4 GiB", json.len()));
    };
    let arrays: usize = checkpoint.arrays.iter().map(|(_, bytes)| bytes.len()).sum();
    let mut bytes = Vec::with_capacity(PREFIX_BYTES + json.len() + arrays + HASH_BYTES);
    bytes.extend(MAGIC);
    bytes.extend(VERSION.to_le_bytes());
    bytes.extend(json_length.to_le_bytes());
    bytes.extend(json);
    for (_, array) in &checkpoint.arrays {
        bytes.extend_from_slice(array);
    }
    let hash = blake3::hash(&bytes);
    bytes.extend(hash.as_bytes());
    Ok(bytes)
}

/// Whether a file is a checkpoint, by how it begins.
pub fn is_checkpoint(path: &Path) -> bool {
    let mut magic = [0; MAGIC.len()];
    let is_file = fs::metadata(path).is_ok_and(|known| known.is_file());
    is_file
        && File::open(path).and_then(|mut file| file.read_exact(&mut magic)).is_ok()
        && &magic == MAGIC
}

/// Reads a checkpoint of any origin that is no longer than `max_bytes`.
pub fn read(path: &Path, max_bytes: u64) -> Result<Checkpoint, Problem> {
    let bytes = whole(path, max_bytes)?;
    if !bytes.starts_with(MAGIC) {
        return Err(Problem::new(path, "", NO_CHECKPOINT, "give another file"));
    }
    from_bytes(&bytes).map_err(|what| Problem::new(path, "", what, START_ANEW))
}

fn whole(path: &Path, max_bytes: u64) -> Result<Vec<u8>, Problem> {
    let unreadable = |error: std::io::Error| Problem::unreadable(path, &error);
    let known = fs::metadata(path).map_err(unreadable)?;
    if !known.is_file() {
        return Err(Problem::new(path, "", "is not a regular file", START_ANEW));
    }
    if known.len() > max_bytes {
        let what = format!("takes {} bytes, more than the {max_bytes} allowed", known.len());
        return Err(Problem::new(path, "", what, "allow more memory"));
    }
    let mut bytes = Vec::with_capacity(known.len() as usize);
    let file = File::open(path).map_err(unreadable)?;
    file.take(known.len()).read_to_end(&mut bytes).map_err(unreadable)?;
    Ok(bytes)
}

/// The checkpoint in bytes of any origin. The error says what is wrong with them.
pub fn from_bytes(bytes: &[u8]) -> Result<Checkpoint, String> {
    const CUT: &str = "the checkpoint is cut short";
    if !bytes.starts_with(MAGIC) {
        return Err(NO_CHECKPOINT.into());
    }
    let length = bytes.len().checked_sub(HASH_BYTES).ok_or(CUT)?;
    let (content, hash) = bytes.split_at(length);
    let (prefix, rest) = content.split_at_checked(PREFIX_BYTES).ok_or(CUT)?;
    let word = |at: usize| {
        u32::from_le_bytes([prefix[at], prefix[at + 1], prefix[at + 2], prefix[at + 3]])
    };
    if word(8) != VERSION {
        return Err(format!("it has format {}; this version reads format {VERSION}", word(8)));
    }
    if blake3::hash(content).as_bytes() != hash {
        return Err("its contents do not match their checksum: it is damaged or cut short".into());
    }
    let (json, arrays) = rest.split_at_checked(word(12) as usize).ok_or(CUT)?;
    let contents: Contents<Value> =
        serde_json::from_slice(json).map_err(|error| format!("its header is broken: {error}"))?;
    Ok(Checkpoint { header: contents.header, arrays: cut(arrays, contents.arrays)? })
}

/// Cuts the arrays out, which must fill their part of the file to the last byte.
fn cut(mut rest: &[u8], entries: Vec<Entry>) -> Result<Vec<(String, Vec<u8>)>, String> {
    let mut arrays = Vec::new();
    let mut names = HashSet::new();
    for Entry { name, bytes } in entries {
        let (array, after) = rest
            .split_at_checked(bytes)
            .ok_or_else(|| format!("array `{name}` reaches beyond the end"))?;
        if !names.insert(name.clone()) {
            return Err(format!("array `{name}` is there twice"));
        }
        arrays.push((name, array.to_vec()));
        rest = after;
    }
    if rest.is_empty() { Ok(arrays) } else { Err("bytes are left over behind the arrays".into()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checkpoint::ArrayError;
    use serde_json::json;

    const ENOUGH: u64 = 1 << 20;

    fn example() -> Checkpoint {
        let mut checkpoint = Checkpoint::new(json!({"scene_hash": "ab", "seed": u64::MAX}));
        checkpoint.push("counters", &[1_u64, 2, u64::MAX]);
        checkpoint.push("sums", &[i128::MIN, -1, 0, i128::MAX]);
        checkpoint.push("nothing", &[0_i64; 0]);
        checkpoint
    }

    fn packed(checkpoint: &Checkpoint) -> Vec<u8> {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("run.ckpt");
        write(&path, checkpoint).unwrap();
        assert_eq!(read(&path, ENOUGH).unwrap(), *checkpoint);
        fs::read(&path).unwrap()
    }

    /// With the checksum it should have.
    fn sealed(mut content: Vec<u8>) -> Vec<u8> {
        let hash = blake3::hash(&content);
        content.extend(hash.as_bytes());
        content
    }

    #[test]
    fn integers_come_back() {
        packed(&Checkpoint::default());
        packed(&example());
        let found = example();
        assert_eq!(found.integers("counters"), Ok(vec![1_u64, 2, u64::MAX]));
        assert_eq!(found.integers("sums"), Ok(vec![i128::MIN, -1, 0, i128::MAX]));
        assert_eq!(found.integers::<i64>("nothing"), Ok(vec![]));
        assert_eq!(found.integers::<u64>("none"), Err(ArrayError::Missing("none".into())));
        let size = ArrayError::Size { name: "counters".into(), bytes: 24, size: 16 };
        assert_eq!(found.integers::<i128>("counters"), Err(size));
    }

    #[test]
    fn every_cut_and_every_changed_byte_is_noticed() {
        let whole = packed(&example());
        for length in 0..whole.len() {
            assert!(from_bytes(&whole[..length]).is_err(), "cut at {length}");
        }
        for at in 0..whole.len() {
            let mut bytes = whole.clone();
            bytes[at] ^= 0x10;
            assert!(from_bytes(&bytes).is_err(), "byte {at}");
        }
    }

    #[test]
    fn false_declarations_are_refused_even_with_a_checksum() {
        let with_json = |json: &str, arrays: &[u8]| {
            let length = (json.len() as u32).to_le_bytes();
            sealed([MAGIC, &VERSION.to_le_bytes()[..], &length, json.as_bytes(), arrays].concat())
        };
        for (json, arrays, said) in [
            (r#"{"header":1,"arrays":[{"name":"a","bytes":9}]}"#, 8, "beyond the end"),
            (r#"{"header":1,"arrays":[{"name":"a","bytes":18446744073709551615}]}"#, 8, "beyond"),
            (r#"{"header":1,"arrays":[{"name":"a","bytes":-1}]}"#, 8, "broken"),
            (r#"{"header":1,"arrays":[{"name":"a","bytes":7}]}"#, 8, "left over"),
            (
                r#"{"header":1,"arrays":[{"name":"a","bytes":4},{"name":"a","bytes":4}]}"#,
                8,
                "twice",
            ),
            (r#"{"header":1}"#, 0, "broken"),
            ("", 0, "broken"),
        ] {
            let found = from_bytes(&with_json(json, &vec![0; arrays])).unwrap_err();
            assert!(found.contains(said), "{json}: {found}");
        }
        let huge = [MAGIC, &VERSION.to_le_bytes()[..], &[0xff; 4]].concat();
        assert!(from_bytes(&sealed(huge)).unwrap_err().contains("cut short"));
        let newer = [MAGIC, &7_u32.to_le_bytes()[..], &[0; 4]].concat();
        assert!(from_bytes(&sealed(newer)).unwrap_err().contains("format 7"));
    }

    #[test]
    fn what_is_no_checkpoint_is_refused_before_it_is_read() {
        let directory = tempfile::tempdir().unwrap();
        let found = read(directory.path(), ENOUGH).unwrap_err();
        assert!(found.what.contains("not a regular file"), "{found}");
        let missing = read(&directory.path().join("none"), ENOUGH).unwrap_err();
        assert!(missing.what.contains("does not exist"), "{missing}");
        let path = directory.path().join("run.ckpt");
        write(&path, &example()).unwrap();
        assert!(read(&path, 10).unwrap_err().what.contains("more than the 10 allowed"));
    }
}
