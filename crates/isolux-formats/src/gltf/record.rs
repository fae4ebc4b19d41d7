//! From JSON text to the file as written.

use super::notes::Flaw;
use super::{extensions, limits, thinned};
use gltf_json::Root;
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value};
use std::collections::HashSet;
use std::fmt;

/// Reads the JSON, without judging what it refers to.
pub(super) fn parse(json: &[u8]) -> Result<Root, Flaw> {
    if json.len() as u64 > limits::JSON_BYTES {
        return Err(Flaw::new(
            format!("{} bytes of JSON", json.len()),
            format!("at most {} are read; put mesh data into buffers", limits::JSON_BYTES),
        ));
    }
    survey(json).map_err(|error| flaw(&error))?;
    check_version(json)?;
    if let Ok(root) = serde_json::from_slice::<Root>(json) {
        refuse_map(root.extras.as_deref().and_then(|raw| serde_json::from_str(raw.get()).ok()))?;
        return Ok(root);
    }
    let members: Map<String, Value> = serde_json::from_slice(json).map_err(|error| flaw(&error))?;
    refuse_map(members.get("extras").cloned())?;
    thinned::root(members)
}

/// A map's materials are made for viewers: solved again they would say that there is no light, or, of a lightmap, that all
/// surfaces shine.
fn refuse_map(extras: Option<Value>) -> Result<(), Flaw> {
    let Some(Value::Object(extras)) = extras else { return Ok(()) };
    // What was baked onto a scene of somebody's is still that scene.
    let is_baked = extras.get("isolux_lightmap").is_some_and(|note| note.get("onto").is_none());
    for (key, is_there, what) in [
        (
            "isolux",
            extras.get("isolux").is_some_and(|note| !note.is_null()),
            "is an illumination map, no scene",
        ),
        ("isolux_lightmap", is_baked, "is a scene with its light baked in, no scene to light"),
    ] {
        if is_there {
            let remedy = "give the scene that it was computed from";
            return Err(Flaw::new(what, remedy).at(format!("extras.{key}")));
        }
    }
    Ok(())
}

fn flaw(error: &serde_json::Error) -> Flaw {
    let text = error.to_string();
    let what = text.rsplit_once(" at line ").map_or(text.as_str(), |(what, _)| what);
    Flaw::new(what, "mend the JSON or export the file again").at(format!(
        "line {}, column {}",
        error.line(),
        error.column()
    ))
}

/// The one part of a file that every version of glTF has.
#[derive(Deserialize)]
struct Versioned {
    asset: Asset,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Asset {
    version: Version,
    min_version: Option<String>,
}

/// Text, and in files of version 1 also a number.
#[derive(Deserialize)]
#[serde(untagged)]
enum Version {
    Text(String),
    Number(f64),
}

/// Looked at first: a file of version 1 would only fail with a riddle.
fn check_version(json: &[u8]) -> Result<(), Flaw> {
    let Versioned { asset } = serde_json::from_slice(json).map_err(|error| flaw(&error))?;
    let version = match asset.version {
        Version::Text(text) => text,
        Version::Number(number) => number.to_string(),
    };
    let readable = match (&asset.min_version, version.split_once('.')) {
        (Some(needed), _) => needed == "2.0",
        (None, Some((major, _))) => major == "2",
        (None, None) => false,
    };
    if readable {
        return Ok(());
    }
    let what = format!("glTF version `{}`", asset.min_version.unwrap_or(version));
    Err(Flaw::new(what, "convert the file to glTF 2.0").at("asset"))
}

/// Looks through the text before it is believed: how many values it makes, and whether every index
/// fits 32 bits (the typed model would cut off the rest and name something else).
fn survey(json: &[u8]) -> Result<(), serde_json::Error> {
    let mut counts = Counts::default();
    let mut text = serde_json::Deserializer::from_slice(json);
    Survey { counts: &mut counts, holds: Holds::Other }.deserialize(&mut text)?;
    text.end()
}

#[derive(Default)]
struct Counts {
    objects: u64,
    values: u64,
}

/// What the numbers at a place of the file mean.
#[derive(Clone, Copy, PartialEq)]
enum Holds {
    Index,
    /// An object all of whose members are indices.
    IndexMap,
    /// An object whose members are extensions by name.
    Extensions,
    /// What an extension says that is not read.
    Unknown,
    Other,
}

impl Holds {
    fn below(self, key: &str) -> Self {
        match key {
            _ if self == Self::Unknown => Self::Unknown,
            _ if self == Self::Extensions && !extensions::is_known(key) => Self::Unknown,
            _ if self == Self::IndexMap => Self::Index,
            "extensions" => Self::Extensions,
            "attributes" | "targets" => Self::IndexMap,
            "buffer"
            | "bufferView"
            | "camera"
            | "children"
            | "componentType"
            | "index"
            | "indices"
            | "inverseBindMatrices"
            | "joints"
            | "light"
            | "material"
            | "mesh"
            | "mode"
            | "nodes"
            | "sampler"
            | "scene"
            | "skeleton"
            | "skin"
            | "source" => Self::Index,
            _ => Self::Other,
        }
    }
}

struct Survey<'a> {
    counts: &'a mut Counts,
    holds: Holds,
}

impl Survey<'_> {
    fn count<E: Error>(&mut self) -> Result<(), E> {
        self.counts.values += 1;
        if self.counts.values > limits::JSON_VALUES {
            return Err(E::custom(format!("more than {} values", limits::JSON_VALUES)));
        }
        Ok(())
    }
}

impl<'de> DeserializeSeed<'de> for Survey<'_> {
    type Value = ();
    fn deserialize<D: Deserializer<'de>>(mut self, text: D) -> Result<(), D::Error> {
        self.count()?;
        text.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Survey<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("JSON")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        self.counts.objects += 1;
        if self.counts.objects > limits::JSON_OBJECTS {
            return Err(A::Error::custom(format!("more than {} objects", limits::JSON_OBJECTS)));
        }
        let mut keys = HashSet::new();
        while let Some(key) = map.next_key::<String>()? {
            if !keys.insert(key.clone()) {
                return Err(A::Error::custom(format!("duplicate field `{key}`")));
            }
            if key == "extras" {
                map.next_value::<IgnoredAny>()?;
            } else {
                map.next_value_seed(Survey { counts: self.counts, holds: self.holds.below(&key) })?;
            }
        }
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        while list.next_element_seed(Survey { counts: self.counts, holds: self.holds })?.is_some() {
        }
        Ok(())
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<(), E> {
        if self.holds == Holds::Index && value > u64::from(u32::MAX) {
            return Err(E::custom(format!("the index {value} does not fit 32 bits")));
        }
        Ok(())
    }

    fn visit_i64<E: Error>(self, _: i64) -> Result<(), E> {
        Ok(())
    }
    fn visit_f64<E: Error>(self, value: f64) -> Result<(), E> {
        if self.holds == Holds::Index && value > f64::from(u32::MAX) {
            return Err(E::custom(format!("the index {value} does not fit 32 bits")));
        }
        Ok(())
    }
    fn visit_bool<E: Error>(self, _: bool) -> Result<(), E> {
        Ok(())
    }
    fn visit_str<E: Error>(self, _: &str) -> Result<(), E> {
        Ok(())
    }
    fn visit_unit<E: Error>(self) -> Result<(), E> {
        Ok(())
    }
}
