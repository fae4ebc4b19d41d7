//! Colours of surfaces, constant or from pictures.

use super::property::{boolean, string, transform};
use super::record::Element;
use super::scope::Scope;
use super::spectrum::{Of, colour};
use crate::picture::Room;
use crate::srgb::code;
use isolux::geometry::Transform;
use isolux::scene::Texture;
use isolux::units::Rgb;
use std::collections::HashMap;
use std::path::PathBuf;

/// A colour of a surface: what it is, or in the mean.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Paint {
    pub(super) colour: Rgb,
    pub(super) picture: Option<Picture>,
}

/// A picture on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Picture {
    /// Index into the textures of the scene.
    pub(super) index: u32,
    /// Takes texture coordinates of the surface to those of the picture.
    pub(super) to_uv: Transform,
}

/// Pixels along a side of a checkerboard, half of them of each colour: the blur between is a
/// sixty-fourth of it.
const BOARD: u32 = 64;

/// The textures of a scene, each file once.
#[derive(Default)]
pub(super) struct Pictures {
    pub(super) list: Vec<Texture>,
    of_file: HashMap<(PathBuf, bool), Option<u32>>,
    room: Room,
    of_board: HashMap<[u64; 6], u32>,
}

impl Pictures {
    /// What fills a slot of an object, or else the usual colour; `None` after a problem.
    pub(super) fn paint(
        &mut self,
        object: &Element,
        slot: &str,
        usual: Rgb,
        scope: &mut Scope,
    ) -> Option<Paint> {
        let constant = |colour| Paint { colour, picture: None };
        let Some(child) = object.child(slot) else { return Some(constant(usual)) };
        let texture = match child.tag.as_str() {
            "texture" => child,
            "ref" => {
                let id = child.attribute("id").unwrap_or_default();
                let Some(found) = scope.names.get(id).copied() else {
                    scope.refuse(
                        object,
                        &format!("refers to `{id}`, which is not there"),
                        "define it",
                    );
                    return None;
                };
                found.is_used.set(true);
                found
            }
            _ => return scope.take(&child.at, colour(child, Of::Surface)).map(constant),
        };
        let picture = match texture.kind() {
            "bitmap" => self.bitmap(texture, scope),
            "checkerboard" => self.board(texture, scope),
            _ => {
                scope.refuse(texture, "is not read", "use a bitmap, a checkerboard or a colour");
                None
            }
        }?;
        scope.finish(texture);
        Some(Paint { colour: self.list[picture.index as usize].mean(), picture: Some(picture) })
    }

    fn bitmap(&mut self, texture: &Element, scope: &mut Scope) -> Option<Picture> {
        let to_uv = scope.take(&texture.at, transform(texture, "to_uv"))?;
        let raw = scope.take(&texture.at, boolean(texture, "raw", false))?;
        string(texture, "filter_type");
        if string(texture, "wrap_mode").is_some_and(|mode| mode != "repeat") {
            scope.warn(
                texture,
                "is repeated beyond its borders",
                "keep texture coordinates within 0 to 1",
            );
        }
        let path = scope.file(texture)?;
        let (list, room) = (&mut self.list, &mut self.room);
        let index =
            *self.of_file.entry((path.clone(), raw)).or_insert_with(|| match room.read(&path) {
                Ok(mut read) => {
                    if raw {
                        read.srgb.iter_mut().for_each(|c| *c = code(f64::from(*c) / 255.0));
                    }
                    list.push(read);
                    Some(list.len() as u32 - 1)
                }
                Err(problem) => {
                    let what = format!("`{}` {}", path.display(), problem.what);
                    scope.notes.problem(&texture.at, what, problem.remedy);
                    None
                }
            });
        Some(Picture { index: index?, to_uv })
    }

    fn board(&mut self, texture: &Element, scope: &mut Scope) -> Option<Picture> {
        let to_uv = scope.take(&texture.at, transform(texture, "to_uv"))?;
        let mut colours = [Rgb::grey(0.4), Rgb::grey(0.2)];
        for (colour, slot) in colours.iter_mut().zip(["color0", "color1"]) {
            if let Some(child) = texture.child(slot) {
                *colour = scope.take(&child.at, self::colour(child, Of::Surface))?;
            }
        }
        let [a, b] = colours.map(|c| c.0.map(|share| code(share.clamp(0.0, 1.0))));
        let bits = [colours[0].0, colours[1].0].concat();
        let key = std::array::from_fn(|k| bits[k].to_bits());
        let list = &mut self.list;
        let index = *self.of_board.entry(key).or_insert_with(|| {
            let half = |k: u32| k >= BOARD / 2;
            let pixel = |k: u32| if half(k % BOARD) == half(k / BOARD) { a } else { b };
            let srgb = (0..BOARD * BOARD).flat_map(pixel).collect();
            list.push(Texture { width: BOARD, height: BOARD, srgb });
            list.len() as u32 - 1
        });
        Some(Picture { index, to_uv })
    }
}
