//! MTL text into its records.

use super::lines::{Statement, number, numbers, place, statements};
use super::record::{MtlMaterial, Named};
use crate::findings::Findings;
use isolux::units::Rgb;
use std::collections::BTreeSet;

/// Reads all materials; what is wrong goes to the findings with its line.
pub(super) fn parse(text: &str, findings: &mut Findings) -> Vec<MtlMaterial> {
    let mut materials: Vec<MtlMaterial> = Vec::new();
    let mut unused = BTreeSet::new();
    for statement in statements(text) {
        let (keyword, rest) = statement.split();
        if keyword == "newmtl" {
            let (name, line) = (rest.to_owned(), statement.line);
            materials.push(MtlMaterial { name, line, ..MtlMaterial::default() });
        } else if let Some(material) = materials.last_mut() {
            take(material, &statement, &mut unused, findings);
        } else {
            findings.problem(
                statement.place(),
                format!("`{keyword}` before the first `newmtl`"),
                "name the material first",
            );
        }
    }
    if !unused.is_empty() {
        let list: Vec<&str> = unused.iter().map(String::as_str).collect();
        findings.warning(
            "",
            format!("statements `{}` are left out", list.join("`, `")),
            "nothing needs to be done; Kd, map_Kd, Ke, d, Tr, Tf, Ni, illum and mirror Ks are read",
        );
    }
    materials
}

fn take(
    material: &mut MtlMaterial,
    statement: &Statement,
    unused: &mut BTreeSet<String>,
    findings: &mut Findings,
) {
    let (keyword, rest) = statement.split();
    let mut bad = |what: &str| {
        let what = format!("`{keyword} {rest}` is not {what}");
        findings.problem(statement.place(), what, "correct it or leave it out");
    };
    let mut colour = |into: &mut Option<Rgb>| match self::colour(rest) {
        Some(value) => *into = Some(value),
        None => bad("one or three finite numbers of zero or more"),
    };
    match keyword {
        "Kd" => colour(&mut material.kd),
        "Ks" => colour(&mut material.ks),
        "Ke" => colour(&mut material.ke),
        "Tf" => colour(&mut material.tf),
        "Ni" => match number(rest) {
            // Programs without a notion of it write 0 for every material.
            Some(0.0) => {
                unused.insert("Ni 0".to_owned());
            }
            Some(value) if value > 0.0 => material.ni = Some(value),
            _ => bad("a positive number"),
        },
        "d" | "Tr" => match rest.split_whitespace().last().and_then(number) {
            Some(value) if (0.0..=1.0).contains(&value) => match keyword {
                "d" => material.d = Some(value),
                _ => material.tr = Some(value),
            },
            _ => bad("a number from 0 to 1"),
        },
        "illum" => match rest.parse() {
            Ok(value) if value <= 10 => material.illum = Some(value),
            _ => bad("a model from 0 to 10"),
        },
        "map_Kd" => material.map_kd = map_file(rest, statement.line, findings),
        "Ka" | "Ns" => {}
        _ => drop(unused.insert(keyword.to_owned())),
    }
}

fn colour(rest: &str) -> Option<Rgb> {
    let value = match numbers(rest)?.as_slice() {
        [grey] => Rgb::grey(*grey),
        [r, g, b, ..] => Rgb::new(*r, *g, *b),
        _ => return None,
    };
    (value.min_channel() >= 0.0).then_some(value)
}

/// The file name after the options, which are left out: they move or scale the picture.
fn map_file(rest: &str, line: usize, findings: &mut Findings) -> Option<Named> {
    let mut name = rest;
    while let Some((option, after)) = name.split_once(char::is_whitespace) {
        let Some(most_arguments) = arguments_of(option) else { break };
        name = skip_arguments(after.trim_start(), most_arguments);
        findings.warning(
            place(line),
            format!("option `{option}` of map_Kd is not used"),
            "apply it to the texture coordinates",
        );
    }
    (!name.is_empty()).then(|| Named { name: name.to_owned(), line })
}

/// How many arguments a map option takes at most.
fn arguments_of(option: &str) -> Option<usize> {
    match option {
        "-o" | "-s" | "-t" => Some(3),
        "-mm" => Some(2),
        "-blendu" | "-blendv" | "-clamp" | "-cc" | "-boost" | "-bm" | "-texres" | "-imfchan"
        | "-type" => Some(1),
        _ => None,
    }
}

fn skip_arguments(mut text: &str, most: usize) -> &str {
    for taken in 0..most {
        let Some((word, after)) = text.split_once(char::is_whitespace) else { break };
        // Of several arguments only the first must be there, and all are numbers.
        if taken > 0 && number(word).is_none() {
            break;
        }
        text = after.trim_start();
    }
    text
}
