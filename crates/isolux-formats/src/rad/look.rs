//! From the modifier of a surface to what it is made of.

use super::limits;
use super::material::{self, Made};
use super::mixture;
use super::modifiers::{Definition, Modifiers, Named};
use super::record::{Kind, kind_of};
use super::sky_function;
use super::words::number;
use crate::lines::{At, Notes};
use isolux::scene::Body;
use isolux::units::Rgb;

/// What a surface of a modifier is.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Look {
    /// The name of the modifier.
    pub(super) name: String,
    pub(super) made: Made,
    /// The `brightdata` of a light.
    pub(super) table: Option<usize>,
    /// What the brightness of a sky varies by.
    pub(super) sky: Option<usize>,
}

impl Look {
    /// Luminance in front of the surface.
    pub(super) fn luminance_cd_m2(&self) -> Rgb {
        match &self.made {
            Made::Body(Body::Opaque { front, .. }) => front.luminance_cd_m2,
            Made::Spot(spot) => spot.luminance_cd_m2,
            Made::Body(Body::Dielectric(_)) | Made::Invisible => Rgb::BLACK,
        }
    }

    /// Whether it gives light.
    pub(super) fn is_emitter(&self) -> bool {
        !self.luminance_cd_m2().is_black()
    }
}

/// What surfaces of a modifier are; `None` after a problem.
pub(super) fn look(modifier: usize, modifiers: &Modifiers, notes: &mut Notes) -> Option<Look> {
    look_at_depth(modifier, modifiers, notes, 0)
}

/// What surfaces of a modifier are that lies in so many mixtures.
fn look_at_depth(
    modifier: usize,
    modifiers: &Modifiers,
    notes: &mut Notes,
    depth: usize,
) -> Option<Look> {
    let mut chain = Chain { modifiers, patterns: Vec::new(), left: limits::CHAIN };
    let name = modifiers.get(modifier).object.name.clone();
    let material = match chain.follow(Named::Known(modifier), notes) {
        Ok(Some(index)) => index,
        Ok(None) => return Some(Look { name, made: Made::Invisible, table: None, sky: None }),
        Err(()) => return None,
    };
    let definition = modifiers.get(material);
    let made = match kind_of(&definition.object.type_) {
        Some(Kind::Mixture) => mixed(definition, modifiers, notes, depth)?,
        _ => material::make(&definition.object, &definition.at, notes)?,
    };
    // A material may modify a material; then only the first counts.
    chain.follow(definition.modifier, notes).ok()?;
    let look = Look { name, made, table: None, sky: None };
    let (table, sky) = chain.end(&look, &definition.at, notes)?;
    Some(Look { table, sky, ..look })
}

/// The share of the first of two materials where only a function would tell it.
const HALF: f64 = 0.5;

/// What a mixture mixes, by the share that it gives as a number, else half of each; `None` after a problem.
fn mixed(
    definition: &Definition,
    modifiers: &Modifiers,
    notes: &mut Notes,
    depth: usize,
) -> Option<Made> {
    let object = &definition.object;
    let label = format!("{} `{}`", object.type_, object.name);
    let refuse = |notes: &mut Notes, what: &str| {
        notes.problem(&definition.at, format!("{label} {what}"), "choose one of what it mixes");
        None
    };
    let [one, other, ..] = &object.strings[..] else {
        return refuse(notes, "does not name what it mixes");
    };
    if depth == limits::MIXTURES {
        return refuse(notes, &format!("lies in more than {} others", limits::MIXTURES));
    }
    let mut side = |named: Named| match named {
        Named::Nothing => Some(Made::Invisible),
        // Where the name stands it was told.
        Named::Unknown => None,
        Named::Known(index) => {
            let look = look_at_depth(index, modifiers, notes, depth + 1)?;
            match look.table.or(look.sky) {
                None => Some(look.made),
                Some(_) => refuse(notes, "mixes a light with a table of intensities"),
            }
        }
    };
    let (foreground, background) = (side(definition.target)?, side(definition.background)?);
    let has_hole = [&foreground, &background].contains(&&Made::Invisible);
    let is_function = object.type_ == "mixfunc";
    let given = object.strings.get(2).filter(|_| is_function).and_then(|word| number(word));
    let share = given.filter(|share| (0.0..=1.0).contains(share));
    let made = match mixture::mixed(foreground, background, share.unwrap_or(HALF)) {
        Ok(made) => made,
        Err(what) => return refuse(notes, what),
    };
    if share.is_some() && !has_hole {
        return Some(made);
    }
    let what = match has_hole {
        true => format!("{label} has holes, which are closed: it mixes `{one}` and `{other}`"),
        false => {
            format!("{label} is read as half `{one}`, half `{other}`: its pattern is left out")
        }
    };
    notes.warning(&definition.at, what, "give each part a surface where the shares differ much");
    Some(made)
}

/// Modifiers upon modifiers.
struct Chain<'a> {
    modifiers: &'a Modifiers,
    patterns: Vec<usize>,
    left: usize,
}

impl Chain<'_> {
    /// Up to the next material.
    fn follow(&mut self, from: Named, notes: &mut Notes) -> Result<Option<usize>, ()> {
        let mut next = from;
        while let Named::Known(index) = next {
            let definition = self.modifiers.get(index);
            let object = &definition.object;
            let label = format!("{} `{}`", object.type_, object.name);
            if self.left == 0 {
                let what =
                    format!("{label}: more than {} modifiers one upon the other", limits::CHAIN);
                notes.problem(&definition.at, what, "use fewer");
                return Err(());
            }
            self.left -= 1;
            next = definition.modifier;
            match kind_of(&object.type_) {
                Some(Kind::Material | Kind::Mixture) => return Ok(Some(index)),
                Some(Kind::Pattern) => self.patterns.push(index),
                Some(Kind::Alias) => {
                    self.follow_side(definition.modifier, notes)?;
                    next = definition.target;
                }
                Some(Kind::Texture) => {
                    let what = format!("{label}: textures are left out, the surface is smooth");
                    notes.warning(&definition.at, what, "model its shape where it matters");
                }
                Some(Kind::Surface) | None => {
                    let what = format!("{label} is no modifier");
                    notes.problem(&definition.at, what, "name a material");
                    return Err(());
                }
            }
        }
        if next == Named::Unknown {
            // Where the name stands it was told.
            return Err(());
        }
        Ok(None)
    }

    /// What an alias puts upon the material it stands for.
    fn follow_side(&mut self, modifier: Named, notes: &mut Notes) -> Result<(), ()> {
        self.follow(modifier, notes).map(|_| ())
    }

    /// The one pattern of a light that is read, a table or a function of a sky; `None` after a problem.
    fn end(
        &self,
        look: &Look,
        at: &At,
        notes: &mut Notes,
    ) -> Option<(Option<usize>, Option<usize>)> {
        let (mut table, mut sky) = (None, None);
        for &index in &self.patterns {
            let definition = self.modifiers.get(index);
            let label = format!("{} `{}`", definition.object.type_, definition.object.name);
            if !look.is_emitter() {
                let what = format!(
                    "{label}: patterns are left out; `{}` reflects evenly what it says",
                    look.name
                );
                notes.warning(&definition.at, what, "give the material its mean colour");
            } else if definition.object.type_ == "brightdata" && self.patterns.len() == 1 {
                table = Some(index);
            } else if sky_function::is_one(&definition.object) && self.patterns.len() == 1 {
                sky = Some(index);
            } else {
                let what =
                    format!("{label}: patterns of lights are not read, as of `{}`", look.name);
                let remedy = "only one brightdata as ies2rad writes it is, or one brightfunc of gensky or gendaylit; name the photometric file \
                              in `!ies2rad FILE.ies` or in a [[luminaire]] of a scene.toml";
                notes.problem(&definition.at, what, remedy);
                return None;
            }
        }
        if table.is_some() && matches!(look.made, Made::Spot(_)) {
            let what = format!("spotlight of `{}` with brightdata", look.name);
            notes.problem(at, what, "use a light instead of the spotlight");
            return None;
        }
        Some((table, sky))
    }
}
