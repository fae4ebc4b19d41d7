//! Blocks of samples.

use super::sample::{self, SAMPLE_BYTES};
use isolux::engine::CacheSample;

const MARK: &[u8; 4] = b"SAMP";
const HEAD_BYTES: usize = 8;
const HASH_BYTES: usize = blake3::OUT_LEN;

/// Samples of a block at most.
const MOST_SAMPLES: usize = 1 << 16;

/// Whole blocks that were read.
#[derive(Debug, Default)]
pub(super) struct Blocks {
    pub(super) samples: Vec<CacheSample>,
    /// Bytes that they take.
    pub(super) bytes: u64,
    /// Whether something is left behind them that is no whole block.
    pub(super) is_cut: bool,
}

/// Samples as blocks; nothing of none.
pub(super) fn pack(samples: &[CacheSample]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for part in samples.chunks(MOST_SAMPLES) {
        let first = bytes.len();
        bytes.extend(MARK);
        bytes.extend((part.len() as u32).to_le_bytes());
        part.iter().for_each(|sample| sample::append(sample, &mut bytes));
        let hash = blake3::hash(&bytes[first..]);
        bytes.extend(hash.as_bytes());
    }
    bytes
}

impl Blocks {
    /// Reads all whole blocks; refuses what is whole but wrong.
    pub(super) fn unpack(mut rest: &[u8]) -> Result<Self, String> {
        let mut found = Self::default();
        while !rest.is_empty() {
            let Some((block, after)) = cut(rest)? else {
                found.is_cut = true;
                break;
            };
            let number = found.samples.len();
            let (content, hash) = block.split_at(block.len() - HASH_BYTES);
            if blake3::hash(content).as_bytes() != hash {
                return Err(format!(
                    "is damaged: the block behind sample {number} does not match its checksum"
                ));
            }
            for bytes in content[HEAD_BYTES..].chunks_exact(SAMPLE_BYTES) {
                let number = found.samples.len();
                let sample = sample::read(bytes)
                    .ok_or_else(|| format!("holds a sample {number} that cannot be one"))?;
                found.samples.push(sample);
            }
            found.bytes += block.len() as u64;
            rest = after;
        }
        Ok(found)
    }
}

/// A block and what comes after it.
type Cut<'a> = (&'a [u8], &'a [u8]);

/// The first block and what comes after it; `None` if it is cut short.
fn cut(rest: &[u8]) -> Result<Option<Cut<'_>>, String> {
    let mark = &rest[..rest.len().min(MARK.len())];
    if !MARK.starts_with(mark) {
        return Err("is damaged: something else stands where a block should begin".into());
    }
    let Some((_, count)) = rest.get(..HEAD_BYTES).and_then(|head| head.split_last_chunk::<4>())
    else {
        return Ok(None);
    };
    let count = u32::from_le_bytes(*count) as usize;
    if count > MOST_SAMPLES {
        return Err(format!("declares a block of {count} samples, more than {MOST_SAMPLES}"));
    }
    Ok(rest.split_at_checked(HEAD_BYTES + count * SAMPLE_BYTES + HASH_BYTES))
}
