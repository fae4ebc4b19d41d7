//! MTL text into its records.

use super::lines::{Statement, number, numbers, place, statements};
use super::record::{MtlMaterial, Named};
use crate::findings::Findings;
use crate::srgb::rec709_from_xyz;
use isolux::units::Rgb;
use isolux::units::short;
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
    match keyword {
        "Kd" => material.kd = colour(material.kd, statement, findings),
        "Ks" => material.ks = colour(material.ks, statement, findings),
        "Ke" => material.ke = colour(material.ke, statement, findings),
        "Tf" => material.tf = colour(material.tf, statement, findings),
        "Ni" => match number(rest) {
            // Programs without a notion of it write 0 for every material.
            Some(0.0) => {
                unused.insert("Ni 0".to_owned());
            }
            Some(value) if value > 0.0 => material.ni = Some(value),
            _ => left_out(statement, "no index of refraction", findings),
        },
        "d" | "Tr" => {
            let share = share(statement, findings);
            match keyword {
                "d" => material.d = share.or(material.d),
                _ => material.tr = share.or(material.tr),
            }
        }
        "illum" => match rest.parse() {
            Ok(value) if value <= 10 => material.illum = Some(value),
            _ => left_out(statement, "no model from 0 to 10", findings),
        },
        "map_Kd" => material.map_kd = map_file(rest, statement.line, findings),
        "Ka" | "Ns" => {}
        _ => drop(unused.insert(keyword.to_owned())),
    }
}

/// Characters of a statement in a message.
const LONGEST_SHOWN: usize = 60;

fn shown(statement: &Statement) -> String {
    statement.text.chars().take(LONGEST_SHOWN).collect()
}

/// A warning of a statement that says nothing here.
fn left_out(statement: &Statement, why: &str, findings: &mut Findings) {
    let what = format!("`{}` is {why}: the line is left out", shown(statement));
    findings.warning(statement.place(), what, "correct it, or remove it");
}

/// A share that `d` or `Tr` gives, cut at 0 and 1.
fn share(statement: &Statement, findings: &mut Findings) -> Option<f64> {
    // Options stand before it.
    let value = statement.split().1.split_whitespace().last().and_then(number);
    let Some(value) = value else {
        left_out(statement, "no number from 0 to 1", findings);
        return None;
    };
    let cut = value.clamp(0.0, 1.0);
    if cut != value {
        let what = format!("`{}` is not from 0 to 1: {cut} is taken", shown(statement));
        findings.warning(statement.place(), what, "correct it, or leave it out");
    }
    Some(cut)
}

/// The colour that a statement gives: one or three numbers, `xyz` with one or three, or `spectral` with a file, which is left out
/// with a warning. What is no number is a problem: taken for another one, it would make up reflectance or light. Without one the
/// colour stays what it was.
fn colour(before: Option<Rgb>, statement: &Statement, findings: &mut Findings) -> Option<Rgb> {
    let rest = statement.split().1;
    let (kind, values) = rest.split_once(char::is_whitespace).unwrap_or((rest, ""));
    let read = match kind {
        "spectral" => {
            left_out(statement, "a spectrum, which is not read", findings);
            return before;
        }
        "xyz" => three(values).map(|xyz| of_xyz(xyz, statement, findings)),
        _ => three(rest).map(Rgb),
    };
    let read = read.filter(|colour| colour.min_channel() >= 0.0);
    if read.is_none() {
        let what = format!(
            "`{}` does not give one or three finite numbers of zero or more",
            shown(statement)
        );
        findings.problem(statement.place(), what, "correct it or leave it out");
    }
    read.or(before)
}

/// Three numbers, or one that stands for all.
fn three(text: &str) -> Option<[f64; 3]> {
    match numbers(text)?.as_slice() {
        [grey] => Some([*grey; 3]),
        [r, g, b, ..] => Some([*r, *g, *b]),
        _ => None,
    }
}

/// Linear Rec. 709 of CIE XYZ, cut at 0, with a warning that says so.
fn of_xyz(xyz: [f64; 3], statement: &Statement, findings: &mut Findings) -> Rgb {
    let colour = rec709_from_xyz(xyz).map(|c| c.max(0.0));
    let taken = colour.0.map(|c| short(c, 4)).join(" ");
    let what = format!("`{}` is read as {taken} in linear Rec. 709", shown(statement));
    findings.warning(statement.place(), what, "write it as three numbers where this is not meant");
    colour
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
