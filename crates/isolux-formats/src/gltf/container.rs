//! The GLB container (glTF 2.0, section 4.4): a header, a JSON chunk, a binary chunk.

use super::notes::Flaw;

const MAGIC: &[u8] = b"glTF";
const JSON: u32 = u32::from_le_bytes(*b"JSON");
const BINARY: u32 = u32::from_le_bytes(*b"BIN\0");

/// The parts of a file, GLB or plain JSON.
#[derive(Debug, PartialEq)]
pub(super) struct Container<'a> {
    pub(super) json: &'a [u8],
    pub(super) binary: Option<&'a [u8]>,
}

/// Tells GLB from JSON by the first bytes, not by the name of the file.
pub(super) fn open(file: &[u8]) -> Result<Container<'_>, Flaw> {
    if !file.starts_with(MAGIC) {
        return plain(file);
    }
    let (version, length) = (word(file, 4)?, word(file, 8)?);
    if version != 2 {
        return Err(Flaw::new(
            format!("GLB container version {version}"),
            "convert the file to glTF 2.0",
        )
        .at("byte 4"));
    }
    let whole = file.get(..length as usize).ok_or_else(|| {
        Flaw::new(
            format!("the header says {length} bytes, the file has {}", file.len()),
            "the file is cut short; copy it again",
        )
        .at("byte 8")
    })?;
    chunks(whole)
}

fn plain(file: &[u8]) -> Result<Container<'_>, Flaw> {
    let json = file.strip_prefix(b"\xef\xbb\xbf").unwrap_or(file);
    match json.trim_ascii_start().first() {
        Some(b'{') => Ok(Container { json, binary: None }),
        Some(_) => Err(Flaw::new("is neither GLB nor JSON", "give a glTF 2.0 file")),
        None => Err(Flaw::new("is empty", "copy or export it again")),
    }
}

fn chunks(glb: &[u8]) -> Result<Container<'_>, Flaw> {
    let (kind, json, mut next) = chunk(glb, 12)?;
    if kind != JSON {
        return Err(Flaw::new("the first chunk is not JSON", "export the file again").at("byte 16"));
    }
    let json = json.strip_suffix(b"\0").map_or(json, trim_nul);
    let mut binary = None;
    while next < glb.len() {
        let (kind, data, end) = chunk(glb, next)?;
        if kind == BINARY && binary.is_none() {
            binary = Some(data);
        }
        next = end;
    }
    Ok(Container { json, binary })
}

/// Kind and data of the chunk at `start`, and where the next one starts.
fn chunk(glb: &[u8], start: usize) -> Result<(u32, &[u8], usize), Flaw> {
    let (length, kind) = (word(glb, start)?, word(glb, start + 4)?);
    let rest = &glb[start + 8..];
    let data = rest.get(..length as usize).ok_or_else(|| {
        Flaw::new(
            format!("a chunk of {length} bytes where {} are left", rest.len()),
            "the file is damaged; export it again",
        )
        .at(format!("byte {start}"))
    })?;
    Ok((kind, data, start + 8 + data.len()))
}

fn word(glb: &[u8], at: usize) -> Result<u32, Flaw> {
    glb.get(at..)
        .and_then(|rest| rest.first_chunk())
        .map(|bytes| u32::from_le_bytes(*bytes))
        .ok_or_else(|| {
            Flaw::new("the GLB ends inside a header", "copy or export it again")
                .at(format!("byte {at}"))
        })
}

/// Some writers pad the JSON chunk with NUL instead of spaces.
fn trim_nul(json: &[u8]) -> &[u8] {
    let end = json.iter().rposition(|&byte| byte != 0).map_or(0, |last| last + 1);
    &json[..end]
}
