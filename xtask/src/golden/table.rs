//! What is said of a case.

use serde_json::Value;

/// Whether two rows are of the same map.
pub(super) fn is_same(before: &Value, now: &Value) -> bool {
    before["hash"].is_string() && before["hash"] == now["hash"]
}

/// A case beside what is kept of it.
pub(super) fn line(name: &str, before: &Value, found: &Result<Value, String>) -> String {
    let said = match found {
        Err(problem) => format!("FAILED: {problem}"),
        Ok(now) if is_same(before, now) => "same".to_owned(),
        Ok(now) if before["hash"].is_string() => changed(before, now),
        Ok(_) => "new".to_owned(),
    };
    format!("{name:24} {said}")
}

fn changed(before: &Value, now: &Value) -> String {
    let times = |key: &str| match (before[key].as_f64(), now[key].as_f64()) {
        (Some(before), Some(now)) if before > 0.0 => format!("{:.3}", now / before),
        _ => "?".to_owned(),
    };
    format!(
        "CHANGED: times {} rays, {} receivers, {} reported error",
        times("rays"),
        times("receivers"),
        times("accuracy_reached")
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_map_is_the_same_by_its_hash_alone() {
        let kept = json!({ "hash": "a", "rays": 100 });
        let said = |row: Value| line("x", &kept, &Ok(row));
        assert!(said(json!({ "hash": "a", "rays": 200 })).ends_with("same"));
        assert!(
            said(json!({ "hash": "b", "rays": 150 })).contains("times 1.500 rays, ? receivers")
        );
        assert!(line("x", &Value::Null, &Ok(json!({ "hash": "a" }))).ends_with("new"));
        assert!(!is_same(&Value::Null, &json!({})));
    }
}
