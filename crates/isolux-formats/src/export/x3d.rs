//! X3D 3.3 in XML. Without a `Material` node colours are shown as they are, no light added (ISO/IEC 19775-1,
//! 17.2.2).

use super::shown::{Shown, Viewpoint};
use crate::map_glb::Displayed;
use isolux::units::escape_markup as escaped;
use std::fmt::{Display, Write};

/// The file. Writing to a string cannot fail.
pub(super) fn write(shown: &Shown) -> String {
    let mut text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
        <!DOCTYPE X3D PUBLIC \"ISO//Web3D//DTD X3D 3.3//EN\" \"http://www.web3d.org/specifications/x3d-3.3.dtd\">\n\
        <X3D profile=\"Interchange\" version=\"3.3\">\n<head>\n"
        .to_owned();
    for (name, content) in [("generator", "isolux"), ("title", &shown.title)] {
        let _ = writeln!(text, "<meta name=\"{name}\" content=\"{}\"/>", escaped(content));
    }
    let info: Vec<String> =
        shown.info.iter().map(|line| format!("&quot;{}&quot;", escaped(line))).collect();
    let _ = writeln!(
        text,
        "</head>\n<Scene>\n<WorldInfo title=\"{}\" info=\"{}\">",
        escaped(&shown.title),
        info.join(" ")
    );
    let known = [
        ("exposure_m2_cd", Some(shown.exposure_m2_cd)),
        ("white_cd_m2", Some(shown.white_cd_m2)),
        ("accuracy_reached", shown.accuracy),
    ];
    text.push_str("<MetadataSet name=\"isolux\" containerField=\"metadata\">\n");
    for (name, value) in known.into_iter().filter_map(|(name, value)| Some((name, value?))) {
        let _ = writeln!(
            text,
            "<MetadataDouble name=\"{name}\" value=\"{value}\" containerField=\"value\"/>"
        );
    }
    let m = shown.avatar_m;
    let _ = writeln!(
        text,
        "</MetadataSet>\n</WorldInfo>\n<NavigationInfo type=\"&quot;WALK&quot; &quot;EXAMINE&quot;\" headlight=\"false\" \
         speed=\"{m}\" avatarSize=\"{} {m} {}\"/>",
        0.1 * m,
        0.3 * m
    );
    let ([x, y, z], angle) = shown.turn;
    let _ = writeln!(text, "<Transform rotation=\"{x} {y} {z} {angle}\">");
    shown.viewpoints.iter().for_each(|view| viewpoint(view, &mut text));
    shown.surfaces.iter().for_each(|surface| shape(surface, &mut text));
    text + "</Transform>\n</Scene>\n</X3D>\n"
}

fn viewpoint(view: &Viewpoint, text: &mut String) {
    let ([x, y, z], [u, v, w]) = (view.position, view.axis);
    let _ = writeln!(
        text,
        "<Viewpoint description=\"{}\" position=\"{x} {y} {z}\" orientation=\"{u} {v} {w} {}\" fieldOfView=\"{}\"/>",
        escaped(&view.name),
        view.angle_rad,
        view.field_of_view_rad
    );
}

fn shape(surface: &Displayed, text: &mut String) {
    text.push_str("<Shape>\n");
    if surface.colours.is_empty() {
        let [r, g, b] = surface.colour;
        let _ = writeln!(
            text,
            "<Appearance><Material diffuseColor=\"0 0 0\" ambientIntensity=\"0\" emissiveColor=\"{r} {g} {b}\" \
             transparency=\"{}\"/></Appearance>",
            1.0 - surface.opacity
        );
    }
    let solid = surface.opacity >= 1.0;
    let indices = surface.indices.as_chunks::<3>().0;
    let _ = write!(text, "<IndexedFaceSet solid=\"{solid}\" coordIndex=\"");
    list(indices.iter().map(|[a, b, c]| format!("{a} {b} {c} -1")), text);
    text.push_str("\">\n<Coordinate point=\"");
    list(surface.positions.iter().map(|[x, y, z]| format!("{x} {y} {z}")), text);
    text.push_str("\"/>\n");
    if !surface.colours.is_empty() {
        text.push_str("<Color color=\"");
        list(surface.colours.iter().map(|[r, g, b]| format!("{r:.4} {g:.4} {b:.4}")), text);
        text.push_str("\"/>\n");
    }
    text.push_str("</IndexedFaceSet>\n</Shape>\n");
}

fn list(items: impl Iterator<Item = impl Display>, text: &mut String) {
    for item in items {
        let _ = writeln!(text, "{item}");
    }
}
