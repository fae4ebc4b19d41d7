//! Files with the checksums and lengths that they should have, so that what lies behind those is read.

use serde_json::Value;

const HASH_BYTES: usize = 32;
const GLB_PREFIX_BYTES: usize = 20;
/// Magic, version, length of the JSON text, as in caches and checkpoints.
const PREFIX_BYTES: usize = 16;
const CACHE_SAMPLE_BYTES: usize = 72 + 12 * (isolux::engine::CACHE_REPLICATES + 6);

fn word(bytes: &[u8], at: usize) -> Option<usize> {
    Some(u32::from_le_bytes(*bytes.get(at..)?.first_chunk()?) as usize)
}

fn put_word(bytes: &mut [u8], at: usize, value: usize) {
    if let Some(place) = bytes.get_mut(at..at + 4) {
        place.copy_from_slice(&(value as u32).to_le_bytes());
    }
}

/// A binary glTF file as long as its header says, whose last chunk ends where the file does.
pub(crate) fn container(bytes: &[u8]) -> Vec<u8> {
    let mut sealed = bytes.to_vec();
    if !sealed.starts_with(b"glTF") || sealed.len() < GLB_PREFIX_BYTES {
        return sealed;
    }
    sealed.resize(sealed.len().next_multiple_of(4), b' ');
    let length = sealed.len();
    put_word(&mut sealed, 8, length);
    let json = word(&sealed, 12).unwrap_or(0);
    let binary = GLB_PREFIX_BYTES.saturating_add(json);
    if binary + 8 > length || !json.is_multiple_of(4) {
        put_word(&mut sealed, 12, length - GLB_PREFIX_BYTES);
    } else {
        put_word(&mut sealed, binary, length - binary - 8);
    }
    sealed
}

/// A map whose arrays have the checksum that its JSON says.
pub(crate) fn map(bytes: &[u8]) -> Vec<u8> {
    let bytes = container(bytes);
    resealed(&bytes).unwrap_or(bytes)
}

fn resealed(bytes: &[u8]) -> Option<Vec<u8>> {
    let json_bytes = word(bytes, 12)?;
    let json = bytes.get(GLB_PREFIX_BYTES..GLB_PREFIX_BYTES + json_bytes)?;
    let rest = &bytes[GLB_PREFIX_BYTES + json_bytes..];
    let mut document: Value = serde_json::from_slice(json).ok()?;
    let sum = array_sum(&document, rest.get(8..)?)?;
    *document.pointer_mut("/extras/isolux/arrays_blake3")? = Value::String(sum);
    // Without a checksum, as in maps of before, the record may be anything.
    document.pointer_mut("/extras")?.as_object_mut()?.remove("isolux_blake3");
    let mut json = serde_json::to_vec(&document).ok()?;
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut sealed = [&bytes[..GLB_PREFIX_BYTES], &json, rest].concat();
    put_word(&mut sealed, 12, json.len());
    let length = sealed.len();
    put_word(&mut sealed, 8, length);
    Some(sealed)
}

/// The sum as `docs/book/map-format.md` describes it: names, types, shapes, contents, in the order of names.
fn array_sum(document: &Value, binary: &[u8]) -> Option<String> {
    let mut hasher = blake3::Hasher::new();
    for (name, entry) in document.pointer("/extras/isolux/arrays")?.as_object()? {
        let mut scalar = entry["type"].as_str()?.to_owned();
        scalar[..1].make_ascii_uppercase();
        let [rows, columns] = [0, 1].map(|k| entry["shape"][k].as_u64());
        hasher.update(format!("{name} {scalar} {} {}\n", rows?, columns?).as_bytes());
        if let Some(view) = entry["bufferView"].as_u64() {
            let view = &document["bufferViews"][view as usize];
            let [offset, length] =
                ["byteOffset", "byteLength"].map(|key| view[key].as_u64().unwrap_or(0) as usize);
            hasher.update(binary.get(offset..offset.checked_add(length)?)?);
        }
    }
    Some(hasher.finalize().to_hex().to_string())
}

/// A checkpoint with its checksum behind it.
pub(crate) fn checkpoint(bytes: &[u8]) -> Vec<u8> {
    let content = &bytes[..bytes.len().saturating_sub(HASH_BYTES)];
    [content, blake3::hash(content).as_bytes()].concat()
}

/// A cache with the checksums of its head and of every block in their places.
pub(crate) fn cache(bytes: &[u8]) -> Vec<u8> {
    let mut sealed = bytes.to_vec();
    let mut start = 0_usize;
    let mut length = word(bytes, 12).map(|json| PREFIX_BYTES + json);
    while let Some(end) = length.and_then(|length| start.checked_add(length)) {
        let Some((content, after)) = sealed.split_at_mut_checked(end) else { break };
        let Some(place) = after.first_chunk_mut::<HASH_BYTES>() else { break };
        *place = *blake3::hash(&content[start..]).as_bytes();
        start = end + HASH_BYTES;
        length = word(&sealed, start + 4).map(|count| 8 + count.saturating_mul(CACHE_SAMPLE_BYTES));
    }
    sealed
}
