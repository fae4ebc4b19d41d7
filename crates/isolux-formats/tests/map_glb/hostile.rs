//! Files made to do harm: every one is refused with a message or read, none does more.

use super::example::{map, scene};
use super::{bytes, json_and_rest, read_bytes};
use proptest::prelude::*;
use serde_json::{Value, json};
use std::sync::LazyLock;

static WHOLE: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let scene = scene();
    bytes(&scene, &map(&scene))
});

/// A container of changed JSON, with its checksums as the format describes them.
fn repack(mut json: Value, rest: &[u8]) -> Vec<u8> {
    if let Some(sum) = checksum(&json, rest.get(8..).unwrap_or_default()) {
        json["extras"]["isolux"]["arrays_blake3"] = json!(sum);
    }
    let record = json["extras"]["isolux"].to_string();
    if json["extras"].is_object() {
        let sum = blake3::hash(record.as_bytes()).to_hex().to_string();
        json["extras"]["isolux_blake3"] = json!(sum);
    }
    container(&json, rest)
}

fn container(json: &Value, rest: &[u8]) -> Vec<u8> {
    let mut text = json.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut bytes = b"glTF".to_vec();
    let total = 20 + text.len() + rest.len();
    for word in [2, total as u32, text.len() as u32, u32::from_le_bytes(*b"JSON")] {
        bytes.extend(word.to_le_bytes());
    }
    bytes.extend(text);
    bytes.extend(rest);
    bytes
}

fn checksum(json: &Value, binary: &[u8]) -> Option<String> {
    let mut hasher = blake3::Hasher::new();
    for (name, entry) in json["extras"]["isolux"]["arrays"].as_object()? {
        let (kind, shape) = (entry["type"].as_str()?.to_uppercase(), &entry["shape"]);
        hasher.update(format!("{name} {kind} {} {}\n", shape[0], shape[1]).as_bytes());
        if let Some(index) = entry["bufferView"].as_u64() {
            let view = &json["bufferViews"][index as usize];
            let start = view["byteOffset"].as_u64()? as usize;
            let end = start.checked_add(view["byteLength"].as_u64()? as usize)?;
            hasher.update(binary.get(start..end)?);
        }
    }
    Some(hasher.finalize().to_hex().to_string())
}

fn refused(bytes: &[u8]) -> String {
    let problems = read_bytes(bytes).map(|_| ()).unwrap_err();
    assert!(problems.0.iter().all(|p| !p.remedy.is_empty()));
    problems.to_string()
}

#[test]
fn an_unchanged_copy_is_read() {
    let (json, rest) = json_and_rest(&WHOLE);
    read_bytes(&repack(json, rest)).unwrap();
}

#[test]
fn false_declarations_are_refused_with_their_place() {
    let isolux = "/extras/isolux";
    for (pointer, value, said) in [
        ("/format_version", json!(1), "format 1"),
        ("/format_version", json!("1"), "no illumination map"),
        ("/arrays/nodes/shape", json!([u64::MAX, 3]), "arrays.nodes"),
        ("/arrays/nodes/shape", json!([1, 3]), "arrays.nodes"),
        ("/arrays/nodes/shape", json!([3, 1]), "arrays.nodes"),
        ("/arrays/nodes/bufferView", json!(4_000_000_000_u32), "checksum"),
        ("/arrays/nodes/type", json!("f32"), "arrays.nodes"),
        ("/arrays/direct_lx/type", json!("u32"), "arrays.direct_lx"),
        ("/arrays/nodes/type", json!("i7"), "extras.isolux: "),
        ("/arrays/nodes", Value::Null, "extras.isolux: "),
        ("/scene/shapes/0/triangles", json!(u64::MAX), "floor"),
        ("/scene/shapes/0/triangles", json!(1), "leave triangles over"),
        ("/scene/shapes/0/has_normals", json!(true), "curtain"),
        ("/scene/shapes/0/material", json!(77), "floor"),
        ("/scene/textures/0/width", json!(u32::MAX), "textures"),
        ("/scene/textures/0/width", json!(2), "textures[0]"),
        ("/scene/textures/0/bufferView", json!(1), "textures[0]"),
        ("/scene/luminaires/0/kind/point/distribution", json!(9), "luminaire 0"),
        ("/scene/cameras/0/direction", json!([0, 0, 0]), "extras.isolux: "),
        ("/scene/cameras/0/vertical_fov_rad", json!(-1), "from the corner"),
        ("/scene/materials/0/body/opaque/front/diffuse/colour", json!([2, 2, 2]), "plaster"),
        ("/provenance/rays", Value::Null, "extras.isolux: "),
    ] {
        let (mut json, rest) = json_and_rest(&WHOLE);
        *json.pointer_mut(&format!("{isolux}{pointer}")).unwrap() = value.clone();
        let message = refused(&repack(json, rest));
        assert!(message.contains(said), "{pointer} = {value}: {message}");
    }
}

#[test]
fn an_array_that_is_missing_is_named() {
    let (json, rest) = json_and_rest(&WHOLE);
    let names = json["extras"]["isolux"]["arrays"].as_object().unwrap().keys();
    // Maps of earlier versions have no such array.
    for name in names.filter(|name| *name != "common_errors_lx") {
        let mut json = json.clone();
        json["extras"]["isolux"]["arrays"].as_object_mut().unwrap().remove(name);
        let message = refused(&repack(json, rest));
        assert!(message.contains(&format!("arrays.{name}: is missing")), "{message}");
    }
}

/// Where an array lies in the binary chunk, with its header.
fn place(json: &Value, name: &str) -> std::ops::Range<usize> {
    let index = json["extras"]["isolux"]["arrays"][name]["bufferView"].as_u64().unwrap();
    let view = &json["bufferViews"][index as usize];
    let start = 8 + view["byteOffset"].as_u64().unwrap() as usize;
    start..start + view["byteLength"].as_u64().unwrap() as usize
}

#[test]
fn damage_without_a_new_checksum_is_noticed() {
    let (json, rest) = json_and_rest(&WHOLE);
    let mut damaged = rest.to_vec();
    damaged[place(&json, "indirect_lx").start + 2] ^= 4;
    let sum = json["extras"]["isolux"]["arrays_blake3"].clone();
    let mut bytes = repack(json, rest);
    let binary = bytes.len() - rest.len();
    bytes[binary..].copy_from_slice(&damaged);
    assert!(sum.is_string());
    assert!(refused(&bytes).contains("checksum"));
}

/// One digit of a luminaire or of an error would change a report.
#[test]
fn no_digit_of_the_record_can_change_unnoticed() {
    let (json, rest) = json_and_rest(&WHOLE);
    let start = WHOLE.windows(10).position(|w| w == b"\"isolux\":{").unwrap();
    let end = WHOLE.windows(16).position(|w| w == b"\"isolux_blake3\":").unwrap();
    let digits = (start..end).filter(|&at| WHOLE[at].is_ascii_digit());
    let mut count = 0;
    for at in digits {
        let mut changed = WHOLE.clone();
        changed[at] = if changed[at] == b'7' { b'3' } else { b'7' };
        refused(&changed);
        count += 1;
    }
    assert!(count > 500, "{count}");
    // Maps of before have no such checksum.
    let mut before = json;
    before["extras"].as_object_mut().unwrap().remove("isolux_blake3");
    read_bytes(&container(&before, rest)).unwrap();
    // One that is no text is none of before.
    for odd in [Value::Null, json!(12)] {
        before["extras"]["isolux_blake3"] = odd;
        let message = refused(&container(&before, rest));
        assert!(message.contains("JSON chunk: invalid type"), "{message}");
    }
}

#[test]
fn arrays_filled_with_one_byte_never_do_harm() {
    let (json, rest) = json_and_rest(&WHOLE);
    for name in json["extras"]["isolux"]["arrays"].as_object().unwrap().keys() {
        for byte in [0, 1, 0x7f, 0x80, 0xff] {
            let mut rest = rest.to_vec();
            rest[place(&json, name)].fill(byte);
            if let Err(problems) = read_bytes(&repack(json.clone(), &rest)) {
                assert!(!problems.0.is_empty(), "{name} {byte}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn random_numbers_in_arrays_are_read_or_refused(
        array in 0_usize..16, at in 0_usize..1_000_000, value in any::<[u8; 4]>(),
    ) {
        let (json, rest) = json_and_rest(&WHOLE);
        let names: Vec<_> =
            json["extras"]["isolux"]["arrays"].as_object().unwrap().keys().cloned().collect();
        let range = place(&json, &names[array % names.len()]);
        let mut rest = rest.to_vec();
        let start = range.start + at % (range.len() - 3);
        rest[start..start + 4].copy_from_slice(&value);
        if let Ok(loaded) = read_bytes(&repack(json, &rest)) {
            // Whatever was read can be shown and written again.
            let (scene, map) = loaded.value;
            bytes(&scene, &map);
        }
    }

    #[test]
    fn random_bytes_anywhere_are_read_or_refused(
        at in 0_usize..1_000_000, value in any::<u8>(), cut in 0_usize..40,
    ) {
        let mut bytes = WHOLE.clone();
        let at = at % bytes.len();
        bytes[at] = value;
        bytes.truncate(bytes.len() - cut.saturating_sub(20));
        let _ = read_bytes(&bytes);
    }
}
