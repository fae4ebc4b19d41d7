//! A bill of materials of the command, in CycloneDX 1.5, made of what cargo knows.

use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

/// The package that is released.
const RELEASED: &str = "isolux-cli";

/// The bill as text, the same on every machine.
pub(crate) fn run(root: &Path) -> Result<String, String> {
    let metadata = metadata(root)?;
    let sums = checksums(root)?;
    let bill = bill(&metadata, &sums).ok_or("cargo metadata has no isolux-cli")?;
    serde_json::to_string_pretty(&bill).map_err(|e| e.to_string())
}

fn metadata(root: &Path) -> Result<Value, String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let arguments = ["metadata", "--format-version", "1", "--locked", "--all-features"];
    let output = Command::new(cargo).args(arguments).current_dir(root).output();
    let output = output.map_err(|e| format!("cannot run cargo metadata: {e}"))?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    serde_json::from_slice(&output.stdout).map_err(|e| format!("cargo metadata: {e}"))
}

/// SHA-256 of every package of the registry, by name and version.
type Sums = BTreeMap<(String, String), String>;

fn checksums(root: &Path) -> Result<Sums, String> {
    let text = std::fs::read_to_string(root.join("Cargo.lock")).map_err(|e| e.to_string())?;
    let lock: toml::Table = text.parse().map_err(|e| format!("Cargo.lock: {e}"))?;
    let packages = lock.get("package").and_then(toml::Value::as_array).into_iter().flatten();
    let sum = |package: &toml::Value| {
        let text = |key: &str| package.get(key)?.as_str().map(str::to_owned);
        Some(((text("name")?, text("version")?), text("checksum")?))
    };
    Ok(packages.filter_map(sum).collect())
}

/// All packages that are linked into the command, each after the name by which others refer to it.
fn bill(metadata: &Value, sums: &Sums) -> Option<Value> {
    let packages: BTreeMap<&str, &Value> =
        metadata["packages"].as_array()?.iter().map(|p| (text(p, "id"), p)).collect();
    let nodes: BTreeMap<&str, &Value> =
        metadata["resolve"]["nodes"].as_array()?.iter().map(|n| (text(n, "id"), n)).collect();
    let (released, package) = packages.iter().find(|(_, p)| p["name"] == RELEASED)?;
    let (mut linked, mut left) = (BTreeSet::new(), vec![*released]);
    while let Some(id) = left.pop() {
        if linked.insert(id) {
            left.extend(dependencies(nodes.get(id)?));
        }
    }
    let list = linked.iter().filter(|id| *id != released).map(|id| component(packages[id], sums));
    let edges = linked.iter().map(|id| {
        let names: BTreeSet<String> = dependencies(nodes[id]).map(|d| name(packages[d])).collect();
        json!({"ref": name(packages[id]), "dependsOn": names})
    });
    Some(json!({
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": {"component": component(package, sums)},
        "components": list.collect::<Vec<_>>(),
        "dependencies": edges.collect::<Vec<_>>(),
    }))
}

/// What a package is linked with: neither its tests nor what builds it.
fn dependencies(node: &Value) -> impl Iterator<Item = &str> {
    let is_linked = |d: &&Value| {
        d["dep_kinds"].as_array().is_some_and(|kinds| kinds.iter().any(|k| k["kind"].is_null()))
    };
    node["deps"].as_array().into_iter().flatten().filter(is_linked).map(|d| text(d, "pkg"))
}

fn component(package: &Value, sums: &Sums) -> Value {
    let key = (text(package, "name").to_owned(), text(package, "version").to_owned());
    let kind = if key.0 == RELEASED { "application" } else { "library" };
    let mut component = json!({
        "type": kind,
        "bom-ref": name(package),
        "name": key.0,
        "version": key.1,
        "purl": name(package),
        // Older manifests separate a choice by a slash.
        "licenses": [{"expression": text(package, "license").replace('/', " OR ")}],
    });
    if let Some(sum) = sums.get(&key) {
        component["hashes"] = json!([{"alg": "SHA-256", "content": sum}]);
    }
    component
}

fn name(package: &Value) -> String {
    format!("pkg:cargo/{}@{}", text(package, "name"), text(package, "version"))
}

fn text<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_linked_is_listed_and_nothing_else() {
        let package = |name: &str| json!({"id": name, "name": name, "version": "1.0.0", "license": "MIT/Apache-2.0"});
        let dependency =
            |name: &str, kind: Value| json!({"pkg": name, "dep_kinds": [{"kind": kind}]});
        let deps = [dependency("a", Value::Null), dependency("tested", json!("dev"))];
        let metadata = json!({
            "packages": [package(RELEASED), package("a"), package("tested")],
            "resolve": {"nodes": [{"id": RELEASED, "deps": deps}, {"id": "a", "deps": []}]},
        });
        let sums = [(("a".to_owned(), "1.0.0".to_owned()), "ab".to_owned())].into();
        let bill = bill(&metadata, &sums).unwrap();
        let list = bill["components"].as_array().unwrap();
        assert_eq!(list.len(), 1);
        assert_eq!(list[0]["purl"], "pkg:cargo/a@1.0.0");
        assert_eq!(list[0]["licenses"][0]["expression"], "MIT OR Apache-2.0");
        assert_eq!(list[0]["hashes"][0]["content"], "ab");
        assert_eq!(bill["dependencies"][1]["dependsOn"], json!(["pkg:cargo/a@1.0.0"]));
    }
}
