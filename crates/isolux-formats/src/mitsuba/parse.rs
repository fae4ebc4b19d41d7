//! XML into elements: parameters are filled in, included files read.

use super::limits;
use super::record::Element;
use super::spectrum_file;
use crate::lines::{At, Notes};
use crate::reach::Root;
use crate::{Reach, product_file, source};
use roxmltree::{Document, Node, ParsingOptions};
use std::cell::Cell;
use std::path::Path;
use std::rc::Rc;

/// The root of a scene and of all files it includes; `None` after a problem.
pub(super) fn parse(path: &Path, reach: Reach, notes: &mut Notes) -> Option<Element> {
    let mut parser = Parser {
        root: Root::of(path, reach),
        notes,
        defaults: Vec::new(),
        bytes_left: limits::BYTES,
        nodes_left: limits::NODES,
    };
    let text = match source::read_text(path, limits::BYTES) {
        Ok(text) => text,
        Err(problem) => {
            notes.findings().absorb::<()>(Err(problem.into()));
            return None;
        }
    };
    let at = At { file: path.into(), line: 1 };
    let children = parser.file(&text, &at.file, 0)?;
    let attributes = Vec::new();
    Some(Element { tag: "scene".into(), attributes, children, at, is_used: Cell::new(true) })
}

struct Parser<'a> {
    root: Root,
    notes: &'a mut Notes,
    /// Parameters by name, the longest name first.
    defaults: Vec<(String, String)>,
    bytes_left: u64,
    nodes_left: usize,
}

/// Where lines of a text begin.
struct Lines(Vec<usize>);

impl Lines {
    fn of(text: &str) -> Self {
        Self(text.bytes().enumerate().filter(|(_, b)| *b == b'\n').map(|(k, _)| k).collect())
    }

    fn number(&self, at: usize) -> usize {
        self.0.partition_point(|&end| end < at) + 1
    }
}

impl Parser<'_> {
    /// The children of the `scene` that a file is.
    fn file(&mut self, text: &str, file: &Rc<Path>, depth: usize) -> Option<Vec<Element>> {
        let first = At { file: file.clone(), line: 1 };
        let all = format!("more than {} MiB of XML in all", limits::BYTES >> 20);
        let Some(left) = self.bytes_left.checked_sub(text.len() as u64) else {
            self.notes.problem(&first, all, "name large meshes by `filename`");
            return None;
        };
        self.bytes_left = left;
        let options = ParsingOptions {
            allow_dtd: false,
            nodes_limit: self.nodes_left as u32,
            ..ParsingOptions::default()
        };
        let document = match Document::parse_with_options(text, options) {
            Ok(document) => document,
            Err(error) => {
                let at = At { line: error.pos().row as usize, ..first };
                let what = format!("is no XML that is read here ({error})");
                self.notes.problem(&at, what, "correct it; DTDs and entities are not read");
                return None;
            }
        };
        self.nodes_left = self.nodes_left.saturating_sub(document.descendants().len());
        let root = document.root_element();
        let lines = Lines::of(text);
        if root.tag_name().name() != "scene" {
            let at = At { line: lines.number(root.range().start), ..first };
            let name = root.tag_name().name();
            match product_file::by_root(name) {
                Some([what, remedy]) => self.notes.problem(&at, what, remedy),
                None => {
                    let what = format!("`{name}` is not a Mitsuba `scene`");
                    self.notes.problem(&at, what, "give a scene of Mitsuba 3");
                }
            }
            return None;
        }
        self.children(root, &lines, file, depth)
    }

    fn children(
        &mut self,
        node: Node,
        lines: &Lines,
        file: &Rc<Path>,
        depth: usize,
    ) -> Option<Vec<Element>> {
        let mut children = Vec::new();
        for child in node.children().filter(Node::is_element) {
            let at = At { file: file.clone(), line: lines.number(child.range().start) };
            if depth >= limits::DEPTH {
                let what =
                    format!("more than {} elements or files one in the other", limits::DEPTH);
                self.notes.problem(&at, what, "nest them less");
                return None;
            }
            let mut attributes = self.attributes(child, &at);
            if child.tag_name().name() == "spectrum" {
                self.read_spectrum(&mut attributes, &at);
            }
            let element = |children| Element {
                tag: lower_case(child.tag_name().name()),
                attributes,
                children,
                at: at.clone(),
                is_used: Cell::new(false),
            };
            match child.tag_name().name() {
                "default" => self.default(&element(Vec::new())),
                "include" => children.extend(self.include(&element(Vec::new()), depth + 1)?),
                _ => children.push(element(self.children(child, lines, file, depth + 1)?)),
            }
        }
        Some(children)
    }

    fn attributes(&mut self, node: Node, at: &At) -> Vec<(String, String)> {
        let mut attributes = Vec::new();
        for attribute in node.attributes() {
            let value = match self.filled(attribute.value()) {
                Ok(value) => value,
                Err(what) => {
                    self.notes.problem(at, what, "give it by <default name value> before");
                    continue;
                }
            };
            // Version 0 of the format wrote names as `toWorld`.
            let value = if attribute.name() == "name" { lower_case(&value) } else { value };
            attributes.push((attribute.name().to_owned(), value));
        }
        attributes
    }

    /// A value with `$name` replaced.
    fn filled(&self, value: &str) -> Result<String, String> {
        let mut filled = String::new();
        let mut rest = value;
        while let Some(start) = rest.find('$') {
            filled += &rest[..start];
            rest = &rest[start + 1..];
            let known = self.defaults.iter().find(|(name, _)| rest.starts_with(name.as_str()));
            let Some((name, value)) = known else {
                let shown: String = rest.chars().take(40).collect();
                return Err(format!("parameter `${shown}` has no value"));
            };
            filled += value;
            rest = &rest[name.len()..];
            if filled.len() > limits::ATTRIBUTE_BYTES {
                return Err(format!("parameters make more than {} bytes", limits::ATTRIBUTE_BYTES));
            }
        }
        filled += rest;
        Ok(filled)
    }

    /// A parameter; the first value counts, as one of the command line would.
    fn default(&mut self, element: &Element) {
        let (Some(name), Some(value)) = (element.attribute("name"), element.attribute("value"))
        else {
            self.notes.problem(&element.at, "default without name and value", "give both");
            return;
        };
        if !name.is_empty() && !self.defaults.iter().any(|(known, _)| known == name) {
            let place = self.defaults.partition_point(|(known, _)| known.len() >= name.len());
            self.defaults.insert(place, (name.to_owned(), value.to_owned()));
        }
    }

    /// Puts what the file of a spectrum says in the place of its name.
    fn read_spectrum(&mut self, attributes: &mut Vec<(String, String)>, at: &At) {
        let Some(place) = attributes.iter().position(|(name, _)| name == "filename") else {
            return;
        };
        let name = attributes[place].1.clone();
        let read = self.root.file(&name).map_err(|why| why.explain(&name));
        let pairs = read.and_then(|path| {
            let most = self.bytes_left.min(limits::ATTRIBUTE_BYTES as u64);
            let text = source::read_text(&path, most)
                .map_err(|problem| (format!("`{name}` {}", problem.what), problem.remedy))?;
            self.bytes_left -= text.len() as u64;
            spectrum_file::pairs(&text).map_err(|(line, what)| {
                (format!("`{name}`: line {line}: {what}"), spectrum_file::REMEDY.to_owned())
            })
        });
        match pairs {
            Ok(pairs) => {
                attributes[place] = ("value".to_owned(), pairs);
                attributes.retain(|(name, value)| name != "type" || value != "irregular");
            }
            Err((what, remedy)) => self.notes.problem(at, what, remedy),
        }
    }

    fn include(&mut self, element: &Element, depth: usize) -> Option<Vec<Element>> {
        let name = element.attribute("filename").unwrap_or_default();
        let path = match self.root.file(name) {
            Ok(path) => path,
            Err(why) => {
                let (what, remedy) = why.explain(name);
                self.notes.problem(&element.at, what, remedy);
                return None;
            }
        };
        match source::read_text(&path, self.bytes_left) {
            Ok(text) => self.file(&text, &path.into(), depth),
            Err(problem) => {
                let what = format!("`{name}` {}", problem.what);
                self.notes.problem(&element.at, what, problem.remedy);
                None
            }
        }
    }
}

/// `toWorld` as `to_world`, `intIOR` as `int_ior`.
fn lower_case(name: &str) -> String {
    let mut lower = String::with_capacity(name.len());
    let mut was_small = false;
    for c in name.chars() {
        if c.is_ascii_uppercase() && was_small {
            lower.push('_');
        }
        was_small = c.is_ascii_lowercase();
        lower.push(c.to_ascii_lowercase());
    }
    lower
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_version_0() {
        let names = ["toWorld", "intIOR", "fov_axis", "specularReflectance", "k"];
        let due = ["to_world", "int_ior", "fov_axis", "specular_reflectance", "k"];
        assert_eq!(names.map(lower_case), due);
    }
}
