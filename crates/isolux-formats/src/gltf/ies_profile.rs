//! EXT_lights_ies: measured photometry on a node.

use super::buffers::Document;
use super::limits;
use super::notes::{Flaw, Notes, no_such};
use super::uri;
use crate::{Problem, ies};
use isolux::photometry::IntensityDistribution;
use isolux::scene::LuminousArea;
use serde_json::Value;
use std::borrow::Cow;
use std::path::Path;

pub(super) const NAME: &str = "EXT_lights_ies";

/// The light of a profile.
pub(super) struct Profile {
    pub(super) intensity: IntensityDistribution,
    pub(super) area: Option<LuminousArea>,
}

/// What a node says of its profile.
pub(super) struct Instance {
    pub(super) profile: usize,
    pub(super) multiplier: f64,
    /// Linear, 0 to 1 in each channel.
    pub(super) colour: [f64; 3],
}

impl Instance {
    pub(super) fn read(value: &Value) -> Result<Self, Flaw> {
        let wrong = |member: &str, remedy: &str| Flaw::new("unreadable", remedy).at(member);
        let profile = value.get("light").and_then(Value::as_u64);
        let multiplier = value.get("multiplier").map_or(Some(1.0), Value::as_f64);
        let colour = value.get("color").map_or(Some([1.0; 3]), |colour| {
            let list = colour.as_array().filter(|list| list.len() == 3)?;
            Some([list[0].as_f64()?, list[1].as_f64()?, list[2].as_f64()?])
        });
        Ok(Self {
            profile: profile
                .and_then(|index| usize::try_from(index).ok())
                .ok_or_else(|| wrong("light", "give the index of a profile"))?,
            multiplier: multiplier
                .filter(|m| *m >= 0.0)
                .ok_or_else(|| wrong("multiplier", "give a number of zero or more"))?,
            // The extension clamps colours.
            colour: colour
                .ok_or_else(|| wrong("color", "give three numbers"))?
                .map(|c| c.clamp(0.0, 1.0)),
        })
    }
}

/// A profile by its index.
pub(super) fn profile(
    document: &Document,
    index: usize,
    notes: &mut Notes,
) -> Result<Profile, Flaw> {
    let root_extensions = document.root.extensions.as_ref();
    let lights = root_extensions
        .and_then(|e| e.others.get(NAME)?.get("lights")?.as_array())
        .map_or(&[][..], Vec::as_slice);
    let list = format!("extensions.{NAME}.lights");
    let record = lights.get(index).ok_or_else(|| no_such(&list, index, lights.len()))?;
    let place = format!("{list}[{index}]");
    let (bytes, name) = bytes(document, record).map_err(|flaw| flaw.rooted(&place))?;
    distribution(&bytes, Path::new(&name), &place, notes)
}

/// The bytes of a profile, and what to call them in a message.
fn bytes<'a>(document: &'a Document, record: &Value) -> Result<(Cow<'a, [u8]>, String), Flaw> {
    let uri = record.get("uri").and_then(Value::as_str);
    let view = record.get("bufferView").and_then(Value::as_u64);
    match (uri, view.and_then(|view| usize::try_from(view).ok())) {
        (Some(uri), _) => {
            let bytes =
                document.folder.fetch(uri, limits::PROFILE_BYTES).map_err(|f| f.at("uri"))?;
            Ok((Cow::Owned(bytes), uri::shown(uri)))
        }
        (None, Some(view)) => {
            Ok((Cow::Borrowed(document.view(view)?.bytes), format!("bufferViews[{view}]")))
        }
        (None, None) => Err(Flaw::new("neither uri nor bufferView", "export the file again")),
    }
}

/// Photometry from memory. Its findings are given the place of the profile in the glTF file.
fn distribution(
    bytes: &[u8],
    name: &Path,
    place: &str,
    notes: &mut Notes,
) -> Result<Profile, Flaw> {
    let flaw = |problem: Problem| Flaw::new(problem.without_remedy(), problem.remedy).rooted(place);
    let read_tilt = &mut |_: &str| {
        let what = "is not read through glTF";
        Err(Problem::new(name, "", what, "write TILT=NONE or TILT=INCLUDE"))
    };
    let loaded = ies::parse(bytes, name, read_tilt).map_err(|problems| {
        let mut flaws = problems.0.into_iter().map(flaw);
        let first = flaws.next();
        flaws.for_each(|flaw| notes.problem(flaw));
        first.unwrap_or_else(|| Flaw::new("unreadable", "replace it").rooted(place))
    })?;
    loaded.warnings.into_iter().map(flaw).for_each(|warning| notes.warn(warning));
    let area = loaded.value.opening.area();
    loaded.value.resolve().map(|intensity| Profile { intensity, area }).map_err(flaw)
}
