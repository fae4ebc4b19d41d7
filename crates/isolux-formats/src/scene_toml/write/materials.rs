//! Materials as tables.

use super::numbers::shortest;
use super::text::{colour, number, quoted};
use isolux::scene::{Body, Dielectric, Finish, SceneParts};
use isolux::units::Rgb;

/// Names by which geometry refers to materials: their own, made different where two are alike.
pub(super) fn names(parts: &SceneParts) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for material in &parts.materials {
        let mut name = material.name.clone();
        while names.contains(&name) {
            name.push('*');
        }
        names.push(name);
    }
    names
}

/// The file of a texture.
pub(super) fn texture_name(index: u32) -> String {
    format!("texture-{}.png", index + 1)
}

pub(super) fn text(parts: &SceneParts) -> String {
    let mut toml = String::new();
    for (name, material) in names(parts).iter().zip(&parts.materials) {
        toml += &format!("\n[materials.{}]\n", quoted(name));
        toml += &match &material.body {
            Body::Dielectric(glass) => pane(glass),
            Body::Opaque { front, back } => {
                let mut toml = finish(front, "");
                if *back == Finish::BLACK {
                    toml += "sided = \"one\"\n";
                } else if back != front {
                    toml += &finish(back, "back.");
                }
                toml
            }
        };
    }
    toml
}

fn pane(glass: &Dielectric) -> String {
    format!(
        "glass = {{ ior = {}, thin = {}, transmittance = {} }}\n",
        number(glass.ior),
        glass.thin,
        colour(glass.transmittance)
    )
}

fn finish(finish: &Finish, prefix: &str) -> String {
    let mut toml = String::new();
    let mut line = |key: &str, value: String| toml += &format!("{prefix}{key} = {value}\n");
    if let Some(texture) = finish.diffuse.texture {
        line("texture", quoted(&texture_name(texture)));
    }
    // A finish says something, and a texture is white unless told otherwise.
    line("diffuse", colour(finish.diffuse.colour));
    if finish.mirror != Rgb::BLACK {
        line("mirror", colour(finish.mirror));
    }
    if let Some(gloss) = finish.gloss {
        let roughness = shortest(gloss.alpha.sqrt(), |r| r * r == gloss.alpha);
        let (f0, roughness) = (colour(gloss.f0), number(roughness));
        line("gloss", format!("{{ f0 = {f0}, roughness = {roughness} }}"));
    }
    if let Some(coat) = finish.coat {
        let roughness = shortest(coat.alpha.sqrt(), |r| r * r == coat.alpha);
        let (cover, roughness) = (number(coat.cover), number(roughness));
        line("coat", format!("{{ cover = {cover}, roughness = {roughness} }}"));
    }
    if finish.luminance_cd_m2 != Rgb::BLACK {
        line("luminance_cd_m2", colour(finish.luminance_cd_m2));
    }
    toml
}
