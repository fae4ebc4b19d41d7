//! Lights with tables of intensity, gathered until all their surfaces are known.

use super::build::Builder;
use super::limits;
use super::look::Look;
use super::luminaires::{self, Middle, middle};
use super::modifiers::Modifiers;
use super::named_files::named_file;
use super::table::{self, Half, Table};
use super::tessellate::area;
use crate::lines::Notes;
use crate::reach::{Root, directory_of};
use isolux::geometry::{Point, Vector};
use isolux::scene::Shape;
use isolux::units::Rgb;
use std::collections::HashMap;
use std::path::Path;

/// Share by which the surfaces of a body may miss what its table says: sizes of six digits, and
/// ends that are left open.
const UNLIKE_BODY: f64 = 0.01;

/// Surfaces of lights, by the definition of their `brightdata`.
#[derive(Default)]
pub(super) struct Tables {
    lights: Vec<Light>,
    light_of: HashMap<usize, usize>,
}

/// Surfaces that share a table.
struct Light {
    definition: usize,
    luminance_cd_m2: Rgb,
    faces: Vec<Face>,
}

struct Face {
    name: String,
    middle: Middle,
    area_m2: f64,
}

impl Tables {
    /// Adds a surface in its place.
    pub(super) fn add(&mut self, definition: usize, name: String, look: &Look, shape: &Shape) {
        let Some(middle) = middle(shape) else { return };
        let luminance_cd_m2 = look.luminance_cd_m2();
        let lights = &mut self.lights;
        let index = *self.light_of.entry(definition).or_insert_with(|| {
            lights.push(Light { definition, luminance_cd_m2, faces: Vec::new() });
            lights.len() - 1
        });
        self.lights[index].faces.push(Face { name, middle, area_m2: area(shape) });
    }

    /// Makes the luminaires.
    pub(super) fn finish(
        &self,
        modifiers: &Modifiers,
        roots: &[Root],
        builder: &mut Builder,
        notes: &mut Notes,
    ) {
        for light in &self.lights {
            let definition = modifiers.get(light.definition);
            let label = format!("brightdata `{}`", definition.object.name);
            if let Err(what) = light.make(modifiers, roots, builder) {
                let remedy = "write it by ies2rad again, or use `!ies2rad FILE.ies`";
                notes.problem(&definition.at, format!("{label}: {what}"), remedy);
                continue;
            }
            let what = format!(
                "{label}: the light is a point in the middle of its surfaces, which are left out"
            );
            notes.warning(&definition.at, what, "nothing needs to be done five diameters away");
        }
    }
}

impl Light {
    fn make(
        &self,
        modifiers: &Modifiers,
        roots: &[Root],
        builder: &mut Builder,
    ) -> Result<(), String> {
        let definition = modifiers.get(self.definition);
        let table = table::parse(definition)?;
        let base = directory_of(&definition.at.file);
        let path =
            named_file(roots, base, &table.file).map_err(|why| why.explain(&table.file).0)?;
        if let table::Shape::Body { area_m2 } = table.shape {
            return self.body(&table, &path, area_m2, builder);
        }
        for face in &self.faces {
            let half = table::half_of(&table, &face.middle)?;
            let name = face.name.clone();
            self.add(&table, &path, half, (name, face.middle.centroid, face.area_m2), builder)?;
        }
        Ok(())
    }

    /// Surfaces that make up a body shine as one.
    fn body(
        &self,
        table: &Table,
        path: &Path,
        due_m2: f64,
        builder: &mut Builder,
    ) -> Result<(), String> {
        let total: f64 = self.faces.iter().map(|face| face.area_m2).sum();
        let is_like = (total / due_m2 - 1.0).abs() < UNLIKE_BODY;
        if !is_like {
            return Err(format!("surfaces of {total:.6} m2 on a body of {due_m2:.6} m2"));
        }
        let moment = self.faces.iter().fold(Vector::ZERO, |sum, face| {
            sum + (face.middle.centroid - Point::ORIGIN) * face.area_m2
        });
        let centre = Point::ORIGIN + moment * (1.0 / total);
        let first = self.faces.first().map(|face| &face.name);
        let name = first.map_or("", |n| n.rsplit_once('.').map_or(n, |(whole, _)| whole));
        self.add(table, path, Half::Both, (name.to_owned(), centre, due_m2), builder)
    }

    fn add(
        &self,
        table: &Table,
        path: &Path,
        half: Half,
        (name, centre, area_m2): (String, Point, f64),
        builder: &mut Builder,
    ) -> Result<(), String> {
        let luminance = self.luminance_cd_m2.luminance();
        let Some(intensity) = table.distribution(path, half, luminance, area_m2)? else {
            return Ok(());
        };
        let map = &table.world_from_table;
        let made = luminaires::point(name, self.luminance_cd_m2, centre, intensity, map);
        if made.is_some_and(|luminaire| !builder.luminaire(luminaire)) {
            return Err(format!("more than {} luminaires", limits::LUMINAIRES));
        }
        Ok(())
    }
}
