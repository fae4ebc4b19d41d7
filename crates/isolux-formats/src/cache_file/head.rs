//! What stands in front of the blocks.

use serde::{Deserialize, Serialize};

pub(super) const MAGIC: &[u8; 8] = b"ISOLUXIC";
const VERSION: u32 = 1;
const PREFIX_BYTES: usize = 16;
const HASH_BYTES: usize = blake3::OUT_LEN;

/// Names of scenes end somewhere.
const MOST_JSON_BYTES: usize = 1 << 20;

/// Bytes within which a head ends.
pub(super) const MOST_BYTES: usize = PREFIX_BYTES + MOST_JSON_BYTES + HASH_BYTES;

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Head {
    pub(super) scene: String,
    pub(super) scene_hash: String,
    pub(super) version: String,
}

impl Head {
    pub(super) fn new(scene: &str, scene_hash: &str) -> Self {
        let version = env!("CARGO_PKG_VERSION").to_owned();
        // Far from the limit, whatever the scene is called.
        let scene = scene.chars().take(1000).collect();
        Self { scene, scene_hash: scene_hash.to_owned(), version }
    }

    pub(super) fn pack(&self) -> Vec<u8> {
        let json = serde_json::to_vec(self).expect("JSON of three texts");
        let mut bytes = MAGIC.to_vec();
        bytes.extend(VERSION.to_le_bytes());
        bytes.extend((json.len() as u32).to_le_bytes());
        bytes.extend(json);
        let hash = blake3::hash(&bytes);
        bytes.extend(hash.as_bytes());
        bytes
    }

    /// The head and what comes after it.
    pub(super) fn unpack(bytes: &[u8]) -> Result<(Self, &[u8]), String> {
        const CUT: &str = "is cut short before its first sample";
        if !bytes.starts_with(MAGIC) {
            return Err("is not a cache of isolux".into());
        }
        let word = |at: usize| -> Option<u32> {
            Some(u32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?))
        };
        let version = word(8).ok_or(CUT)?;
        if version != VERSION {
            return Err(format!("has format {version}; this version reads format {VERSION}"));
        }
        let json_bytes = word(12).ok_or(CUT)? as usize;
        if json_bytes > MOST_JSON_BYTES {
            return Err(format!(
                "declares a head of {json_bytes} bytes, more than {MOST_JSON_BYTES}"
            ));
        }
        let (content, rest) = bytes.split_at_checked(PREFIX_BYTES + json_bytes).ok_or(CUT)?;
        let (hash, rest) = rest.split_at_checked(HASH_BYTES).ok_or(CUT)?;
        if blake3::hash(content).as_bytes() != hash {
            return Err("is damaged: its head does not match its checksum".into());
        }
        let head = serde_json::from_slice(&content[PREFIX_BYTES..])
            .map_err(|error| format!("has a broken head: {error}"))?;
        Ok((head, rest))
    }
}
