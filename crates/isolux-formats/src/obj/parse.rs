//! OBJ text into its record.

use super::lines::{Statement, numbers, statements};
use super::record::{Corner, Face, Named, ObjFile, Part};
use crate::counted;
use crate::findings::Findings;
use crate::polygon::MOST_CORNERS;
use std::collections::BTreeMap;
use std::collections::HashMap;

/// Reads all statements; what is wrong goes to the findings with its line.
pub(super) fn parse(text: &str, findings: &mut Findings) -> ObjFile {
    let mut parser = Parser::default();
    for statement in statements(text) {
        if let Err(Wrong { what, remedy }) = parser.take(&statement) {
            findings.problem(statement.place(), what, remedy);
        }
    }
    for (keyword, (line, count)) in parser.unused {
        findings.warning(
            super::lines::place(line),
            format!("`{keyword}` ({}, first here) is not used", counted(count, "time", "times")),
            "only polygons with `v`, `vt`, `vn`, `f` are read; convert the rest to polygons",
        );
    }
    parser.file
}

struct Wrong {
    what: String,
    remedy: &'static str,
}

fn wrong(what: impl Into<String>, remedy: &'static str) -> Wrong {
    Wrong { what: what.into(), remedy }
}

#[derive(Default)]
struct Parser {
    file: ObjFile,
    object: String,
    group: String,
    material: Option<Named>,
    /// The part that takes the next face, unless a name has changed since.
    current: Option<usize>,
    part_of: HashMap<(String, Option<String>), usize>,
    unused: BTreeMap<String, (usize, usize)>,
}

impl Parser {
    fn take(&mut self, statement: &Statement) -> Result<(), Wrong> {
        let (keyword, rest) = statement.split();
        match keyword {
            "v" => self.vertex(rest, statement.line)?,
            "vn" => keep(&mut self.file.normals, fixed(rest))?,
            "vt" => keep(&mut self.file.uvs, texture_coordinates(rest))?,
            "f" => self.face(rest, statement.line)?,
            "o" => self.rename(rest.to_owned(), String::new()),
            "g" => self.rename(self.object.clone(), rest.to_owned()),
            "usemtl" => {
                self.material = Some(Named { name: rest.to_owned(), line: statement.line });
                self.current = None;
            }
            "mtllib" => {
                self.file.libraries.push(Named { name: rest.to_owned(), line: statement.line });
            }
            // Smoothing groups say how to make up normals; only written normals are used.
            "s" => {}
            _ => self.unused.entry(keyword.to_owned()).or_insert((statement.line, 0)).1 += 1,
        }
        Ok(())
    }

    /// A place. Of more numbers than four the last three are a colour; one alone is a weight.
    fn vertex(&mut self, rest: &str, line: usize) -> Result<(), Wrong> {
        let list = numbers(rest).unwrap_or_default();
        if let (6.., Some(&colour)) = (list.len(), list.last_chunk()) {
            self.file.colours.push(self.file.positions.len(), colour, line);
        }
        keep(&mut self.file.positions, first_three(&list, rest))
    }

    fn rename(&mut self, object: String, group: String) {
        (self.object, self.group) = (object, group);
        self.current = None;
    }

    fn face(&mut self, rest: &str, line: usize) -> Result<(), Wrong> {
        let count = rest.split_whitespace().take(MOST_CORNERS + 1).count();
        if count < 3 {
            return Err(wrong(format!("a face of {count} corners"), "give at least three corners"));
        }
        if count > MOST_CORNERS {
            let what = format!("a face of more than {MOST_CORNERS} corners");
            return Err(wrong(what, "cut it into smaller faces"));
        }
        let corners: Vec<Corner> =
            rest.split_whitespace().map(|word| self.corner(word)).collect::<Result<_, _>>()?;
        let part = self.current_part();
        part.faces.push(Face { first_corner: part.corners.len(), line });
        part.corners.extend(corners);
        Ok(())
    }

    fn current_part(&mut self) -> &mut Part {
        let index = self.current.unwrap_or_else(|| self.find_part());
        self.current = Some(index);
        &mut self.file.parts[index]
    }

    fn find_part(&mut self) -> usize {
        let name = match (self.object.as_str(), self.group.as_str()) {
            ("", group) => group.to_owned(),
            (object, "") => object.to_owned(),
            (object, group) => format!("{object}/{group}"),
        };
        let parts = &mut self.file.parts;
        let key = (name.clone(), self.material.as_ref().map(|m| m.name.clone()));
        *self.part_of.entry(key).or_insert_with(|| {
            let material = self.material.clone();
            parts.push(Part { name, material, corners: Vec::new(), faces: Vec::new() });
            parts.len() - 1
        })
    }

    /// `position`, `position/uv`, `position//normal` or `position/uv/normal`.
    fn corner(&self, word: &str) -> Result<Corner, Wrong> {
        let mut fields = word.split('/');
        let position = fields.next().unwrap_or("");
        let mut optional = |count: usize, what: &str| match fields.next() {
            None | Some("") => Ok(None),
            Some(index) => resolve_index(index, count, what).map(Some),
        };
        let uv = optional(self.file.uvs.len(), "texture coordinates `vt`")?;
        let normal = optional(self.file.normals.len(), "normals `vn`")?;
        let position = resolve_index(position, self.file.positions.len(), "vertices `v`")?;
        Ok(Corner { position, uv, normal })
    }
}

/// OBJ counts from 1, or backwards from -1, the latest read so far.
fn resolve_index(word: &str, count: usize, what: &str) -> Result<u32, Wrong> {
    let index: i64 = word.parse().map_err(|_| {
        wrong(format!("`{word}` is not an index"), "write corners as v, v/vt, v//vn or v/vt/vn")
    })?;
    let from_zero = if index < 0 { index.checked_add(count as i64) } else { Some(index - 1) };
    from_zero
        .filter(|k| index != 0 && (0..count as i64).contains(k))
        .and_then(|k| u32::try_from(k).ok())
        .ok_or_else(|| {
            let what = format!("index {index} where {count} {what} have been read");
            wrong(what, "count from 1, or from -1 backwards; export the file again")
        })
}

/// Keeps the place of what cannot be read, so that it is not found missing, too.
fn keep<T: Default>(list: &mut Vec<T>, read: Result<T, Wrong>) -> Result<(), Wrong> {
    let (value, read) = match read {
        Ok(value) => (value, Ok(())),
        Err(wrong) => (T::default(), Err(wrong)),
    };
    list.push(value);
    read
}

fn fixed(rest: &str) -> Result<[f64; 3], Wrong> {
    first_three(&numbers(rest).unwrap_or_default(), rest)
}

fn first_three(list: &[f64], rest: &str) -> Result<[f64; 3], Wrong> {
    let remedy = "write x y z";
    list.first_chunk()
        .copied()
        .ok_or_else(|| wrong(format!("`{rest}` is not three finite numbers"), remedy))
}

fn texture_coordinates(rest: &str) -> Result<[f64; 2], Wrong> {
    match numbers(rest).as_deref() {
        Some([u]) => Ok([*u, 0.0]),
        Some([u, v, ..]) => Ok([*u, *v]),
        _ => Err(wrong(format!("`{rest}` is not two finite numbers"), "write u v")),
    }
}
