//! VRML97. Without a `Material` node colours are shown as they are, no light added (ISO/IEC 14772-1, 4.14).

use super::shown::{Shown, Viewpoint};
use crate::map_glb::Displayed;
use std::fmt::Write;

/// The file. Writing to a string cannot fail.
pub(super) fn write(shown: &Shown) -> String {
    let mut text = "#VRML V2.0 utf8\n".to_owned();
    let info: Vec<String> = shown.info.iter().map(|line| quoted(line)).collect();
    let _ = writeln!(
        text,
        "WorldInfo {{ title {} info [ {} ] }}",
        quoted(&shown.title),
        info.join(", ")
    );
    let m = shown.avatar_m;
    let _ = writeln!(
        text,
        "NavigationInfo {{ type [ \"WALK\", \"EXAMINE\" ] headlight FALSE speed {m} avatarSize [ {}, {m}, {} ] }}",
        0.1 * m,
        0.3 * m
    );
    let ([x, y, z], angle) = shown.turn;
    let _ = writeln!(text, "Transform {{ rotation {x} {y} {z} {angle} children [");
    shown.viewpoints.iter().for_each(|view| viewpoint(view, &mut text));
    shown.surfaces.iter().for_each(|surface| shape(surface, &mut text));
    text + "] }\n"
}

fn viewpoint(view: &Viewpoint, text: &mut String) {
    let ([x, y, z], [u, v, w]) = (view.position, view.axis);
    let _ = writeln!(
        text,
        "Viewpoint {{ description {} position {x} {y} {z} orientation {u} {v} {w} {} fieldOfView {} }}",
        quoted(&view.name),
        view.angle_rad,
        view.field_of_view_rad
    );
}

fn shape(surface: &Displayed, text: &mut String) {
    let _ = write!(text, "# {}\nShape {{ ", surface.name.replace(['\n', '\r'], " "));
    if surface.colours.is_empty() {
        let [r, g, b] = surface.colour;
        let _ = write!(
            text,
            "appearance Appearance {{ material Material {{ diffuseColor 0 0 0 ambientIntensity 0 \
             emissiveColor {r} {g} {b} transparency {} }} }} ",
            1.0 - surface.opacity
        );
    }
    let solid = if surface.opacity < 1.0 { "FALSE" } else { "TRUE" };
    let _ = writeln!(text, "geometry IndexedFaceSet {{ solid {solid} coord Coordinate {{ point [");
    for [x, y, z] in &surface.positions {
        let _ = writeln!(text, "{x} {y} {z},");
    }
    text.push_str("] }\n");
    if !surface.colours.is_empty() {
        text.push_str("color Color { color [\n");
        for [r, g, b] in &surface.colours {
            let _ = writeln!(text, "{r:.4} {g:.4} {b:.4},");
        }
        text.push_str("] }\n");
    }
    text.push_str("coordIndex [\n");
    for [a, b, c] in surface.indices.as_chunks().0 {
        let _ = writeln!(text, "{a} {b} {c} -1,");
    }
    text.push_str("] } }\n");
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}
