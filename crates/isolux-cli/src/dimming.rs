//! Dimmings as written: of maps and of groups.

use crate::quantity;
use std::path::{Path, PathBuf};

/// A map and what it is dimmed to, written `MAP.glb` or `MAP.glb=30%`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DimmedMap {
    /// The map.
    pub path: PathBuf,
    /// What all of its light is multiplied by.
    pub dimming: f64,
}

impl DimmedMap {
    /// Reads one.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        // A file of that very name needs no number.
        let split = text.rsplit_once('=').filter(|_| !Path::new(text).exists());
        let Some((path, number)) = split else {
            return Ok(Self { path: PathBuf::from(text), dimming: 1.0 });
        };
        if path.is_empty() {
            return Err("names no map; write MAP.glb=30%".into());
        }
        Ok(Self { path: PathBuf::from(path), dimming: quantity::dimming(number)? })
    }
}

/// A group and what it is dimmed to, written `NAME=30%`.
pub(crate) fn dimmed_group(text: &str) -> Result<(String, f64), String> {
    let split = text.rsplit_once('=').filter(|(name, _)| !name.is_empty());
    let (name, number) = split.ok_or("write GROUP=30% or GROUP=0.3")?;
    Ok((name.to_owned(), quantity::dimming(number)?))
}
