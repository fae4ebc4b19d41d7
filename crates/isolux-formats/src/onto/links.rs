//! Files that a file names, taken into the new one: it may stand in another folder.

use super::error::OntoError;
use super::store::Store;
use crate::gltf::Opened;
use serde_json::{Value, json};

const PROFILES: &str = "/extensions/EXT_lights_ies/lights";
const PROFILE_KIND: &str = "application/x-ies-lm-63";

/// Takes in all pictures and photometric files. Data in the JSON stays there.
pub(super) fn take_in(
    opened: &Opened,
    document: &mut Value,
    store: &mut Store,
) -> Result<(), OntoError> {
    for (list, place) in [("/images", "images"), (PROFILES, "extensions.EXT_lights_ies.lights")] {
        let entries = document.pointer_mut(list).and_then(Value::as_array_mut);
        for (index, entry) in entries.into_iter().flatten().enumerate() {
            let Some(uri) = entry.get("uri").and_then(Value::as_str).filter(|uri| !is_data(uri))
            else {
                continue;
            };
            let place = format!("{place}[{index}].uri");
            let bytes = opened.linked(uri, &place)?;
            let kind = if list == PROFILES { Some(PROFILE_KIND) } else { kind(&bytes) };
            let known = entry.get("mimeType").and_then(Value::as_str);
            let kind = known.or(kind).filter(|_| !bytes.is_empty()).ok_or_else(|| {
                let what = format!("`{uri}` is no picture of a known kind");
                opened.problem(place, what, "convert it to PNG or JPEG")
            })?;
            entry["mimeType"] = json!(kind);
            entry["bufferView"] = json!(store.view(&bytes, json!({}))?);
            entry.as_object_mut().and_then(|members| members.remove("uri"));
        }
    }
    Ok(())
}

fn is_data(uri: &str) -> bool {
    uri.get(..5).is_some_and(|scheme| scheme.eq_ignore_ascii_case("data:"))
}

/// The kind of a picture by how it begins.
fn kind(bytes: &[u8]) -> Option<&'static str> {
    let starts: [(usize, &[u8], &str); 6] = [
        (0, b"\x89PNG", "image/png"),
        (0, b"\xff\xd8\xff", "image/jpeg"),
        (8, b"WEBP", "image/webp"),
        (0, b"\xabKTX 20\xbb", "image/ktx2"),
        (0, b"DDS ", "image/vnd-ms.dds"),
        (4, b"ftypavif", "image/avif"),
    ];
    let is_it =
        |at: usize, start: &[u8]| bytes.get(at..).is_some_and(|rest| rest.starts_with(start));
    starts.into_iter().find(|(at, start, _)| is_it(*at, start)).map(|(_, _, kind)| kind)
}
