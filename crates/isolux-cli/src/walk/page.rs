//! The walk-through in one file.

use super::PAGE;
use super::grids::grids_of_map;
use super::hello::Hello;
use super::opened::Opened;
use crate::failure::Failure;
use isolux_formats::walk::{Embedded, Page, embed};
use std::time::Duration;

/// The page with one or two maps in it, which opens from a disk. A map that stands alone, and cannot be dimmed by groups, is shown with
/// finer shadows, as far as they are found within a time.
pub(crate) fn file(maps: &[Opened], limit: Duration) -> Result<String, Failure> {
    let names = maps.iter().map(|map| (map.scene.name().to_owned(), map.file())).collect();
    let hello = Hello::new(names, false, "vertices").to_json();
    let embedded = |number: usize| {
        let own = &maps[number];
        let other = maps.iter().enumerate().find(|(k, _)| *k != number).map(|(_, map)| map);
        let (mesh, light) = match maps {
            [alone] if !alone.has_groups() => alone.drawn_finer(limit),
            _ => own.drawn(other),
        };
        Ok(Embedded {
            scene: own.scene_bytes(other)?,
            mesh: mesh.to_bytes(),
            light: light.to_bytes(0),
            grids: grids_of_map(&own.scene, &own.map),
        })
    };
    let worlds: Vec<Embedded> =
        (0..maps.len()).map(embedded).collect::<Result<Vec<_>, Failure>>()?;
    embed(Page(PAGE), &hello, &worlds)
        .ok_or_else(|| Failure::Refused("the page of this program has no place for data".into()))
}
