//! Reflectances as far as surfaces have them.
//!
//! A surface that reflects all light has no illuminance in a closed room: what luminaires bring there is never absorbed. Exporters write
//! such surfaces all the same, as a white of 1 or a picture with white in it. Nothing that scatters light reflects more than
//! sintered PTFE, 0.99 (Weidner, Hsia 1981, "Reflection properties of pressed polytetrafluoroethylene powder"); what
//! files say beyond that is held there. Perfect mirrors are let be: light on them comes from somewhere else, and goes there.

use super::check::ENERGY_ROUNDING;
use super::{Body, Finish, SceneParts};
use crate::units::Rgb;

/// The share of light that surfaces which scatter it reflect at most.
pub const MOST_REFLECTANCE: f64 = 0.99;

/// A material that reflected more.
#[derive(Clone, Debug, PartialEq)]
pub struct Lowered {
    /// Its name.
    pub material: String,
    /// Its texture, by number, if it has one.
    pub texture: Option<u32>,
    /// What it reflected in the channel where that was most, at the brightest place.
    pub reflectance: f64,
}

impl SceneParts {
    /// Lowers reflectances above [`MOST_REFLECTANCE`], but for those of mirrors: diffuse ones as far as that will do, then gloss.
    pub fn hold_reflectances(&mut self) -> Vec<Lowered> {
        let Self { materials, textures, .. } = self;
        let brightest: Vec<Rgb> = textures.iter().map(super::Texture::brightest).collect();
        let mut lowered = Vec::new();
        for material in materials {
            let Body::Opaque { front, back } = &mut material.body else { continue };
            let sides = [front, back].map(|finish| {
                let texture = finish.diffuse.texture;
                let brightest = texture.and_then(|t| brightest.get(t as usize));
                Some((texture, hold(finish, brightest.copied().unwrap_or(Rgb::WHITE))?))
            });
            let most = sides.into_iter().flatten().max_by(|a, b| a.1.total_cmp(&b.1));
            if let Some((texture, reflectance)) = most {
                lowered.push(Lowered { material: material.name.clone(), texture, reflectance });
            }
        }
        lowered
    }
}

/// Lowers what one side reflects, under a texture that is so bright where it is brightest. Returns what that was, if it was too much.
fn hold(finish: &mut Finish, brightest: Rgb) -> Option<f64> {
    let gloss = finish.glossy_f0();
    let diffuse = finish.diffuse.colour * brightest;
    let all = (diffuse + finish.mirror + gloss).max_channel();
    // What is more than all is refused, not held.
    let is_too_much = all > MOST_REFLECTANCE + ENERGY_ROUNDING && all <= 1.0 + ENERGY_ROUNDING;
    if !is_too_much || finish.is_pure_mirror() {
        return None;
    }
    for c in 0..3 {
        let room = (MOST_REFLECTANCE - finish.mirror.0[c] - gloss.0[c]).max(0.0);
        if diffuse.0[c] > room {
            finish.diffuse.colour.0[c] = room / brightest.0[c];
        }
    }
    if let Some(gloss) = &mut finish.gloss {
        let f0 = |c: usize| gloss.f0.0[c].min((MOST_REFLECTANCE - finish.mirror.0[c]).max(0.0));
        gloss.f0 = Rgb([0, 1, 2].map(f0));
    }
    Some(all)
}
