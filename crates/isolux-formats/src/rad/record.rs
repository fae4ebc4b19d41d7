//! A Radiance file as written.

/// One statement of a file.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Item {
    /// A surface, or a modifier of surfaces.
    Object(Object),
    /// The text after an exclamation mark.
    Command {
        /// Where it begins.
        line: usize,
        /// Without the mark, continued lines joined.
        text: String,
    },
}

/// `modifier type identifier`, then its arguments.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Object {
    pub(super) line: usize,
    pub(super) modifier: String,
    /// Its type, one of [`kind_of`]'s.
    pub(super) type_: String,
    pub(super) name: String,
    /// String arguments; of an alias, what it stands for.
    pub(super) strings: Vec<String>,
    /// Real arguments.
    pub(super) numbers: Vec<f64>,
}

/// What a type is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Geometry.
    Surface,
    /// What geometry is made of.
    Material,
    /// Varies the brightness of a material.
    Pattern,
    /// Bends the normal of a surface.
    Texture,
    /// Blends modifiers.
    Mixture,
    /// Another name for a modifier.
    Alias,
}

/// The kind of a type of the Radiance reference manual; `None` for any other word.
pub(super) fn kind_of(type_: &str) -> Option<Kind> {
    Some(match type_ {
        "polygon" | "sphere" | "bubble" | "ring" | "cylinder" | "tube" | "cone" | "cup"
        | "source" | "instance" | "mesh" => Kind::Surface,
        "plastic" | "metal" | "trans" | "glass" | "dielectric" | "interface" | "mirror"
        | "light" | "glow" | "spotlight" | "illum" | "antimatter" | "plastic2" | "metal2"
        | "trans2" | "ashik2" | "plasfunc" | "metfunc" | "transfunc" | "BRTDfunc" | "plasdata"
        | "metdata" | "transdata" | "BSDF" | "aBSDF" | "WGMDfunc" | "prism1" | "prism2"
        | "mist" => Kind::Material,
        "colorfunc" | "brightfunc" | "colordata" | "brightdata" | "colorpict" | "colortext"
        | "brighttext" | "spectrum" | "specfile" | "specfunc" | "specdata" | "specpict" => {
            Kind::Pattern
        }
        "texfunc" | "texdata" => Kind::Texture,
        "mixfunc" | "mixdata" | "mixpict" | "mixtext" => Kind::Mixture,
        "alias" => Kind::Alias,
        _ => return None,
    })
}
