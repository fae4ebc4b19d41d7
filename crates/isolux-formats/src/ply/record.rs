//! A PLY file as written, of its elements those that are read.

use super::body::{Body, Row};
use super::faces::Faces;
use super::header::{Header, Wrong};
use super::vertices::Vertices;
use crate::counted;
use crate::findings::Findings;

/// What of a file is read.
#[derive(Default)]
pub(super) struct Mesh {
    pub(super) vertices: Vertices,
    pub(super) faces: Faces,
}

/// Reads the data after the header.
pub(super) fn parse(header: &Header, data: &[u8], findings: &mut Findings) -> Result<Mesh, Wrong> {
    let mut mesh = Mesh::default();
    if let Some((line, word)) = &header.odd_line {
        let what = format!("`{word}` is no word of a header; the line is left out");
        findings.warning(format!("line {line}"), what, "write `comment` before it");
    }
    let mut body = Body::new(header.format, data, header.lines);
    let mut row = Row::default();
    for element in &header.elements {
        body.begin(element)?;
        match element.name.as_str() {
            "vertex" => mesh.vertices.read(element, &mut body, &mut row, findings)?,
            "face" => mesh.faces.read(element, &mut body, &mut row, false, findings)?,
            "tristrips" => mesh.faces.read(element, &mut body, &mut row, true, findings)?,
            name => {
                if element.count > 0 {
                    let place = format!("line {}", element.line);
                    let what =
                        format!("{} of `{name}` not used", counted(element.count, "row", "rows"));
                    let remedy = "nothing needs to be done if they are no surfaces";
                    findings.warning(place, what, remedy);
                }
                for _ in 0..element.count {
                    body.row(element, &mut row)?;
                }
            }
        }
    }
    if body.bytes_left() > 0 && data[data.len() - body.bytes_left()..].trim_ascii() != b"" {
        let what = format!("{} bytes follow the data and are not read", body.bytes_left());
        findings.warning("", what, "export the geometry again if something is missing");
    }
    Ok(mesh)
}
