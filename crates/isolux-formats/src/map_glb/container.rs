//! The binary glTF container: a header, a chunk of JSON, a chunk of bytes (glTF 2.0, section 4).

use super::MapTooLarge;

/// What every binary glTF file begins with.
pub(super) const MAGIC: &[u8] = b"glTF";
const JSON: u32 = u32::from_le_bytes(*b"JSON");
const BINARY: u32 = u32::from_le_bytes(*b"BIN\0");
const HEADER_BYTES: usize = 12;
const CHUNK_HEADER_BYTES: usize = 8;
/// How far a file is read to find out about its first chunk.
pub(super) const PREFIX_BYTES: usize = HEADER_BYTES + CHUNK_HEADER_BYTES;

/// The two chunks of a container.
#[derive(Debug, PartialEq)]
pub(super) struct Chunks<'a> {
    pub(super) json: &'a [u8],
    pub(super) binary: &'a [u8],
}

/// Packs both chunks; without bytes there is no second chunk.
pub(crate) fn pack(json: &[u8], binary: &[u8]) -> Result<Vec<u8>, MapTooLarge> {
    let chunk = |length: usize| CHUNK_HEADER_BYTES + length.next_multiple_of(4);
    let second = if binary.is_empty() { 0 } else { chunk(binary.len()) };
    let total = HEADER_BYTES + chunk(json.len()) + second;
    let declared = u32::try_from(total).map_err(|_| MapTooLarge { bytes: total as u64 })?;
    let mut bytes = Vec::with_capacity(total);
    bytes.extend_from_slice(MAGIC);
    for word in [2, declared] {
        bytes.extend(word.to_le_bytes());
    }
    append_chunk(&mut bytes, JSON, json, b' ');
    if !binary.is_empty() {
        append_chunk(&mut bytes, BINARY, binary, 0);
    }
    Ok(bytes)
}

fn append_chunk(bytes: &mut Vec<u8>, kind: u32, content: &[u8], filler: u8) {
    let padded = content.len().next_multiple_of(4);
    // The whole file was found to fit in 32 bits.
    bytes.extend((padded as u32).to_le_bytes());
    bytes.extend(kind.to_le_bytes());
    bytes.extend_from_slice(content);
    bytes.resize(bytes.len() + padded - content.len(), filler);
}

/// Finds both chunks, or says what is wrong. Chunks of other kinds are passed over.
pub(super) fn unpack(bytes: &[u8]) -> Result<Chunks<'_>, &'static str> {
    json_length(bytes)?;
    if word(bytes, 8) as usize != bytes.len() {
        return Err("the file is not as long as its header says: it was cut or added to");
    }
    let (json, mut rest) = split_chunk(&bytes[HEADER_BYTES..])?;
    let mut chunks = Chunks { json: json.1, binary: &[] };
    while !rest.is_empty() {
        let ((kind, content), after) = split_chunk(rest)?;
        if kind == BINARY && chunks.binary.is_empty() {
            chunks.binary = content;
        }
        rest = after;
    }
    Ok(chunks)
}

/// Length of the JSON chunk, from the first [`PREFIX_BYTES`] of a file.
pub(super) fn json_length(prefix: &[u8]) -> Result<usize, &'static str> {
    if prefix.len() < PREFIX_BYTES || !prefix.starts_with(MAGIC) {
        return Err("it is not a binary glTF file");
    }
    if word(prefix, 4) != 2 {
        return Err("it is not of version 2 of glTF");
    }
    if word(prefix, 16) != JSON {
        return Err("its first chunk is not JSON");
    }
    Ok(word(prefix, 12) as usize)
}

type Chunk<'a> = (u32, &'a [u8]);

fn split_chunk(bytes: &[u8]) -> Result<(Chunk<'_>, &[u8]), &'static str> {
    const CUT: &str = "a chunk reaches beyond the end of the file";
    let (header, rest) = bytes.split_at_checked(CHUNK_HEADER_BYTES).ok_or(CUT)?;
    let (content, rest) = rest.split_at_checked(word(header, 0) as usize).ok_or(CUT)?;
    Ok(((word(header, 4), content), rest))
}

fn word(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chunks_come_back_with_their_padding() {
        for (json, binary) in [("{}", "".as_bytes()), ("{ }", b"a"), ("{  }", b"1234")] {
            let bytes = pack(json.as_bytes(), binary).unwrap();
            assert_eq!(bytes.len() % 4, 0);
            let chunks = unpack(&bytes).unwrap();
            assert_eq!(std::str::from_utf8(chunks.json).unwrap().trim_end(), json);
            assert!(chunks.binary.starts_with(binary));
            assert_eq!(chunks.binary.len(), binary.len().next_multiple_of(4));
        }
    }

    #[test]
    fn every_cut_and_every_false_word_is_refused_without_panic() {
        let whole = pack(b"{}", b"12345678").unwrap();
        for length in 0..whole.len() {
            assert!(unpack(&whole[..length]).is_err(), "{length}");
        }
        for at in [0, 4, 8, 12, 16, 24] {
            let mut bytes = whole.clone();
            bytes[at..at + 4].fill(0xff);
            assert!(unpack(&bytes).is_err(), "{at}");
        }
    }
}
