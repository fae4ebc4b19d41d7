//! Facts of a map, as the page tells them.

use crate::audit;
use crate::quantity::{show_count, show_share};
use crate::request::method_name;
use isolux::map::IlluminationMap;

/// Names and values, for people.
pub(super) fn facts(map: &IlluminationMap) -> Vec<(String, String)> {
    let from = &map.provenance;
    let share = |share: Option<f64>| share.map_or("not known".to_owned(), show_share);
    let reached = if from.complete { "reached" } else { "not reached" };
    let target = from.accuracy_target.map_or("none".to_owned(), show_share);
    let unknown = map.values.iter().filter(|value| value.is_none()).count();
    [
        ("computed by", format!("isolux {}, {}", from.version, method_name(from.method))),
        ("error", share(from.accuracy.map(|accuracy| accuracy.reached))),
        ("error asked for", format!("{target}, {reached}")),
        ("error audited", from.audit.as_ref().map_or("not audited".to_owned(), audit::line)),
        ("error between vertices", share(from.accuracy.map(|accuracy| accuracy.interpolated))),
        ("vertices", format!("{}, {unknown} of them unknown", map.values.len())),
        ("increments", from.increments.to_string()),
        ("rays", show_count(from.rays as f64)),
        ("seed", from.seed.to_string()),
    ]
    .map(|(name, value)| (name.to_owned(), value))
    .into()
}
