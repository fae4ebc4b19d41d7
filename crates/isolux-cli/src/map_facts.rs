//! Facts of a map, for people.

use crate::audit;
use crate::quantity::{show_count, show_share};
use crate::request::method_name;
use isolux::map::Provenance;

/// How it was computed and how good it is, with so many receivers, some of them unknown.
pub(crate) fn of(
    from: &Provenance,
    (receivers, unknown): (usize, usize),
) -> [(&'static str, String); 9] {
    let share = |share: Option<f64>| share.map_or("not known".to_owned(), show_share);
    let target = from.accuracy_target.map_or("none".to_owned(), show_share);
    let reached = if from.complete { "reached" } else { "not reached" };
    [
        ("computed by", format!("isolux {}, {}", from.version, method_name(from.method))),
        ("seed", from.seed.to_string()),
        ("error", share(from.accuracy.map(|accuracy| accuracy.reached))),
        ("error asked for", format!("{target}, {reached}")),
        ("error audited", from.audit.as_ref().map_or("not audited".to_owned(), audit::line)),
        (
            "error of the interpolated map",
            share(from.accuracy.map(|accuracy| accuracy.interpolated)),
        ),
        ("increments", from.increments.to_string()),
        ("rays", show_count(from.rays as f64)),
        ("receivers", format!("{receivers}, {unknown} of them unknown")),
    ]
}
