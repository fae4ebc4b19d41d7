//! A file of which the typed model cannot take a part that is not read: the same file without such parts.

use super::notes::Flaw;
use gltf_json::Root;
use serde::de::DeserializeOwned;
use serde_json::{Map, Number, Value, json};
use std::collections::HashSet;

type Members = Map<String, Value>;

/// The typed model of what is read of a file, or what is wrong with an element of a list.
pub(super) fn root(mut file: Members) -> Result<Root, Flaw> {
    file.values_mut().for_each(plain);
    file.remove("extras");
    leave_out(&mut file);
    Ok(Root {
        accessors: list(&file, "accessors")?,
        animations: list(&file, "animations")?,
        buffers: list(&file, "buffers")?,
        buffer_views: list(&file, "bufferViews")?,
        scene: one(&file, "scene")?,
        extensions: one(&file, "extensions")?,
        extensions_used: list(&file, "extensionsUsed")?,
        extensions_required: list(&file, "extensionsRequired")?,
        cameras: list(&file, "cameras")?,
        images: list(&file, "images")?,
        materials: list(&file, "materials")?,
        meshes: list(&file, "meshes")?,
        nodes: list(&file, "nodes")?,
        samplers: list(&file, "samplers")?,
        scenes: list(&file, "scenes")?,
        skins: list(&file, "skins")?,
        textures: list(&file, "textures")?,
        ..Root::default()
    })
}

/// The elements of a list, read one by one so that a wrong one has a place.
fn list<T: DeserializeOwned>(file: &Members, name: &str) -> Result<Vec<T>, Flaw> {
    let elements = match file.get(name) {
        None => return Ok(Vec::new()),
        Some(Value::Array(elements)) => elements,
        Some(_) => return Err(Flaw::new("is no list", REMEDY).at(name)),
    };
    let element = |(k, value)| typed(value).map_err(|flaw| flaw.at(format!("{name}[{k}]")));
    elements.iter().enumerate().map(element).collect()
}

fn one<T: DeserializeOwned>(file: &Members, name: &str) -> Result<Option<T>, Flaw> {
    file.get(name).map(|value| typed(value).map_err(|flaw| flaw.at(name))).transpose()
}

const REMEDY: &str = "mend the JSON or export the file again";

/// A value by way of its text, because from text alone numbers beyond single precision are refused.
fn typed<T: DeserializeOwned>(value: &Value) -> Result<T, Flaw> {
    serde_json::from_str(&value.to_string()).map_err(|error| {
        let text = error.to_string();
        let what = text.rsplit_once(" at line ").map_or(text.as_str(), |(what, _)| what);
        Flaw::new(what, REMEDY)
    })
}

/// Takes out, at all depths, what may be anything: `extras`, names that are no text, `null`; whole numbers become integers.
fn plain(value: &mut Value) {
    match value {
        Value::Array(elements) => elements.iter_mut().for_each(plain),
        Value::Object(members) => {
            members.retain(|key, value| match key.as_str() {
                "extras" => false,
                "extensions" => value.is_object(),
                "name" => value.is_string(),
                _ => !value.is_null(),
            });
            members.values_mut().for_each(plain);
        }
        Value::Number(number) => *number = whole(number),
        Value::Null | Value::Bool(_) | Value::String(_) => {}
    }
}

/// JSON knows one kind of number: 3.0 is 3.
fn whole(number: &Number) -> Number {
    let value = number.as_f64().filter(|v| number.is_f64() && *v == v.trunc());
    let value = value.filter(|v| (0.0..=f64::from(u32::MAX)).contains(v));
    value.map_or_else(|| number.clone(), |value| Number::from(value as u64))
}

/// Puts the least that the model takes in the place of parts that are not read.
fn leave_out(file: &mut Members) {
    for animation in elements(file, "animations") {
        *animation = json!({"channels": [], "samplers": []});
    }
    for scene in elements(file, "scenes").filter_map(Value::as_object_mut) {
        scene.entry("nodes").or_insert_with(|| json!([]));
    }
    let of_nodes = |file: &Members, key: &str| -> HashSet<u64> {
        let nodes = file.get("nodes").and_then(Value::as_array).into_iter().flatten();
        nodes.filter_map(|node| node.get(key)?.as_u64()).collect()
    };
    let used = of_nodes(file, "skin");
    for (_, skin) in (0..).zip(elements(file, "skins")).filter(|(k, _)| !used.contains(k)) {
        *skin = json!({"joints": []});
    }
    let used = of_nodes(file, "camera");
    for (k, camera) in (0..).zip(elements(file, "cameras")) {
        let is_read = used.contains(&k) && camera.get("type") == Some(&json!("perspective"));
        leave_out_of_camera(camera, is_read);
    }
    for material in elements(file, "materials") {
        for name in ["normalTexture", "occlusionTexture"] {
            if let Some(texture) = material.get_mut(name) {
                *texture = json!({"index": 0});
            }
        }
    }
}

/// Of a camera its opening angle is read, if it has perspective.
fn leave_out_of_camera(camera: &mut Value, is_read: bool) {
    let orthographic = || json!({"type": "orthographic"});
    match camera.get_mut("perspective").and_then(Value::as_object_mut) {
        Some(perspective) if is_read => {
            perspective.retain(|key, _| key == "yfov");
            perspective.insert("znear".into(), json!(1));
        }
        _ => *camera = orthographic(),
    }
}

fn elements<'a>(file: &'a mut Members, name: &str) -> impl Iterator<Item = &'a mut Value> {
    file.get_mut(name).and_then(Value::as_array_mut).into_iter().flatten()
}
