//! STL as text: facets of three vertices between `solid` and `endsolid`.

use super::record::Solid;
use crate::counted;
use crate::findings::Findings;
use std::collections::{BTreeMap, HashMap};

/// Reads all lines; what is wrong goes to the findings with its line.
pub(super) fn parse(text: &str, findings: &mut Findings) -> Vec<Solid> {
    let mut parser = Parser::default();
    let mut last = 0;
    for (number, line) in (1..).zip(text.lines()) {
        last = number;
        if let Err(what) = parser.take(line.trim(), number) {
            findings.problem(place(number), what, "export the geometry again");
        }
    }
    if let Some(facet) = &parser.facet {
        let what = format!("the file ends within the facet of line {}: it is cut off", facet.line);
        findings.problem(place(last), what, "copy or export it again");
    } else if parser.open.is_some() {
        let what = "the file ends without `endsolid`";
        findings.warning(place(last), what, "copy or export it again if something is missing");
    }
    for (keyword, (line, count)) in parser.unused {
        let what =
            format!("`{keyword}` ({}, first here) is not used", counted(count, "time", "times"));
        findings.warning(place(line), what, "nothing needs to be done; only facets are read");
    }
    parser.solids
}

fn place(line: usize) -> String {
    format!("line {line}")
}

#[derive(Default)]
struct Parser {
    solids: Vec<Solid>,
    index_of: HashMap<String, usize>,
    /// Name of the solid for which `endsolid` is due.
    open: Option<String>,
    facet: Option<Facet>,
    unused: BTreeMap<String, (usize, usize)>,
}

struct Facet {
    line: usize,
    normal: [f64; 3],
    corners: Vec<[f64; 3]>,
}

/// Names in messages of broken files.
const LONGEST_SHOWN: usize = 40;
/// Corners of a facet: of more than three only so many are kept to be counted.
const CORNERS: usize = 3;

impl Parser {
    fn take(&mut self, line: &str, number: usize) -> Result<(), String> {
        let (keyword, rest) = match line.split_once(char::is_whitespace) {
            Some((keyword, rest)) => (keyword, rest.trim()),
            None => (line, ""),
        };
        let keyword = keyword.to_ascii_lowercase();
        // What begins in the line of another statement would be taken for a part of it.
        let within = match keyword.as_str() {
            "solid" => "facet",
            "facet" => "vertex",
            _ => "",
        };
        let mut words = rest.split_whitespace().skip(usize::from(keyword == "solid"));
        if !within.is_empty() && words.any(|word| word.eq_ignore_ascii_case(within)) {
            return Err(format!(
                "`{within}` stands in the line of `{keyword}`; each statement takes a line of its own"
            ));
        }
        match keyword.as_str() {
            "" | "outer" | "endloop" => Ok(()),
            "solid" => self.begin(rest),
            "endsolid" => {
                self.open = None;
                if self.facet.take().is_some() {
                    Err("`endsolid` within a facet".into())
                } else {
                    Ok(())
                }
            }
            "facet" => self.facet(rest, number),
            "vertex" => self.vertex(rest),
            "endfacet" => self.end_facet(),
            other => {
                let shown = other.chars().take(LONGEST_SHOWN).collect();
                // A broken file has as many keywords as words.
                if self.unused.len() < 16 || self.unused.contains_key(&shown) {
                    self.unused.entry(shown).or_insert((number, 0)).1 += 1;
                }
                Ok(())
            }
        }
    }

    fn begin(&mut self, name: &str) -> Result<(), String> {
        match self.open.replace(name.to_owned()) {
            None => Ok(()),
            Some(_) => Err("`solid` where `endsolid` was due".into()),
        }
    }

    fn facet(&mut self, rest: &str, line: usize) -> Result<(), String> {
        if self.open.is_none() {
            return Err("`facet` outside of a solid".into());
        }
        let normal = rest.split_once(char::is_whitespace).and_then(|(_, numbers)| vector(numbers));
        // A normal that is no vector takes no side.
        let normal = normal.unwrap_or([0.0; 3]);
        match self.facet.replace(Facet { line, normal, corners: Vec::with_capacity(CORNERS) }) {
            None => Ok(()),
            Some(open) => Err(format!("`facet` within the facet of line {}", open.line)),
        }
    }

    fn vertex(&mut self, rest: &str) -> Result<(), String> {
        let Some(facet) = &mut self.facet else { return Err("`vertex` outside of a facet".into()) };
        let corner = vector(rest).filter(|c| c.iter().all(|x| x.is_finite()));
        let shown: String = rest.chars().take(LONGEST_SHOWN).collect();
        // One that is wrong keeps its place, so that it is told once.
        let due = facet.corners.len() < CORNERS;
        if due {
            facet.corners.push(corner.unwrap_or([0.0; 3]));
        }
        corner.ok_or_else(|| format!("`{shown}` is not three finite numbers"))?;
        due.then_some(()).ok_or_else(|| "a facet of more than three corners".to_owned())
    }

    fn end_facet(&mut self) -> Result<(), String> {
        let Some(facet) = self.facet.take() else {
            return Err("`endfacet` without `facet`".into());
        };
        let Ok(corners) = <[_; CORNERS]>::try_from(facet.corners) else {
            return Err("a facet of fewer than three corners".into());
        };
        self.solid().add(facet.normal, corners);
        Ok(())
    }

    /// The open solid; solids of one name are one, and those without facets none.
    fn solid(&mut self) -> &mut Solid {
        let name = self.open.clone().unwrap_or_default();
        let solids = &mut self.solids;
        let index = *self.index_of.entry(name).or_insert_with_key(|name| {
            solids.push(Solid { name: name.clone(), ..Solid::default() });
            solids.len() - 1
        });
        &mut self.solids[index]
    }
}

/// Three numbers.
fn vector(text: &str) -> Option<[f64; 3]> {
    let mut words = text.split_whitespace();
    let mut next = || words.next()?.parse().ok();
    let vector = [next()?, next()?, next()?];
    words.next().is_none().then_some(vector)
}
