//! The bytes of a checkpoint: `ISOLUXCK`, the format's version, the length of a JSON text, the text, arrays, a BLAKE3 hash.

use super::dice::Dice;
use serde_json::Value;

const FORMAT_AT: usize = 8;
const LENGTH_AT: usize = 12;
const JSON_AT: usize = 16;
const HASH_BYTES: usize = blake3::OUT_LEN;

/// A checkpoint with something of its JSON changed, and the hash that it should have.
pub(super) fn with(state: &[u8], change: impl Fn(&mut Value)) -> Result<Vec<u8>, String> {
    let (head, rest) = state.split_at_checked(JSON_AT).ok_or("a checkpoint is too short")?;
    let length = word(head, LENGTH_AT) as usize;
    let end = rest.len().saturating_sub(HASH_BYTES);
    let (json, arrays) = rest[..end].split_at_checked(length).ok_or("a checkpoint is too short")?;
    let mut contents: Value = serde_json::from_slice(json).map_err(|e| e.to_string())?;
    change(&mut contents["header"]);
    let json = contents.to_string().into_bytes();
    let length = u32::try_from(json.len()).map_err(|e| e.to_string())?.to_le_bytes();
    Ok(hashed([&head[..LENGTH_AT], &length, &json, arrays].concat()))
}

/// The same in another format.
pub(super) fn in_format(state: &[u8], version: u32) -> Vec<u8> {
    let mut content = state[..state.len() - HASH_BYTES].to_vec();
    content[FORMAT_AT..LENGTH_AT].copy_from_slice(&version.to_le_bytes());
    hashed(content)
}

/// With some bits changed, cut short, longer, or empty for a while.
pub(super) fn damaged(state: &[u8], dice: &mut Dice) -> Vec<u8> {
    let mut bytes = state.to_vec();
    let at = dice.below(bytes.len());
    match dice.below(4) {
        0 => (0..=dice.below(3)).for_each(|_| {
            let at = dice.below(bytes.len());
            bytes[at] ^= 1 << dice.below(8);
        }),
        1 => bytes.truncate(at),
        2 => (0..=dice.below(100)).for_each(|_| bytes.push(dice.next() as u8)),
        _ => {
            let end = (at + 512).min(bytes.len());
            bytes[at..end].fill(0);
        }
    }
    bytes
}

fn hashed(mut content: Vec<u8>) -> Vec<u8> {
    let hash = blake3::hash(&content);
    content.extend(hash.as_bytes());
    content
}

fn word(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_checkpoint_that_is_changed_is_sealed_again() {
        let json = br#"{"header":{"a":1}}"#;
        let length = (json.len() as u32).to_le_bytes();
        let state =
            hashed([b"ISOLUXCK", &1_u32.to_le_bytes()[..], &length, json, b"sums"].concat());
        assert_eq!(with(&state, |_| {}).unwrap(), state);
        let changed = with(&state, |header| header["a"] = json!(22)).unwrap();
        let end = changed.len() - HASH_BYTES;
        assert!(changed[..end].ends_with(br#"{"header":{"a":22}}sums"#));
        assert_eq!(blake3::hash(&changed[..end]).as_bytes(), &changed[end..]);
        assert_eq!(in_format(&state, 1), state);
        assert_eq!(word(&in_format(&state, 2), FORMAT_AT), 2);
        let mut dice = Dice::new(1, "test");
        assert!((0..100).all(|_| damaged(&state, &mut dice) != state));
    }
}
