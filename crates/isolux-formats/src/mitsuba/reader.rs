//! The walk through a scene.

use super::emitter;
use super::geometry::{Files, Mesh, placed};
use super::limits;
use super::palette::{Asked, Chosen, Palette};
use super::property::{boolean, transform};
use super::record::{Element, Wrong, names};
use super::scope::Scope;
use super::sensor;
use super::surroundings;
use crate::Reach;
use crate::efficacy::EFFICACY_LM_W;
use crate::lines::Notes;
use crate::reach::Root;
use crate::round::inside_out;
use isolux::geometry::{Point, Transform};
use isolux::scene::{Camera, Luminaire, SceneParts, Shape, UpAxis};
use isolux::units::Rgb;
use std::path::Path;

/// What is known of a file from elsewhere.
pub(crate) struct Reading<'a> {
    /// Whether its unit of length is known, so that its size surprises nobody.
    pub(crate) unit_is_known: bool,
    /// Whether a material is replaced by another: then it is not looked at, and comes out black.
    pub(crate) is_replaced: &'a dyn Fn(&str) -> bool,
    /// Lumens for each watt of the file, where somebody chose.
    pub(crate) efficacy_lm_w: Option<f64>,
    /// Which files it may name.
    pub(crate) reach: Reach,
}

/// The scene that a tree of elements is; what is wrong goes to the notes.
pub(super) fn read(
    root: &Element,
    path: &Path,
    reading: &Reading,
    notes: &mut Notes,
) -> SceneParts {
    let names = names(root);
    let mut reader = Reader {
        scope: Scope { names, notes, root: Root::of(path, reading.reach) },
        palette: Palette::new(reading.is_replaced),
        files: Files::default(),
        efficacy_lm_w: reading.efficacy_lm_w.unwrap_or(EFFICACY_LM_W),
        says_efficacy: reading.efficacy_lm_w.is_none(),
        shapes: Vec::new(),
        luminaires: Vec::new(),
        cameras: Vec::new(),
        has_surroundings: false,
        visits_left: limits::SHAPES,
        triangles: 0,
        idle: Vec::new(),
        lamps: Vec::new(),
    };
    for element in &root.children {
        if reader.element(element).is_none() && reader.is_full() {
            break;
        }
    }
    reader.finish(path)
}

struct Reader<'a, 'r, 'n> {
    scope: Scope<'a, 'n>,
    palette: Palette<'r>,
    files: Files,
    efficacy_lm_w: f64,
    says_efficacy: bool,
    shapes: Vec<Shape>,
    luminaires: Vec<Luminaire>,
    cameras: Vec<Camera>,
    /// Whether it was said what is seen where there is nothing.
    has_surroundings: bool,
    visits_left: usize,
    triangles: usize,
    /// What makes pictures, and no light.
    idle: Vec<&'a Element>,
    /// Area emitters that stand outside of shapes.
    lamps: Vec<&'a Element>,
}

impl<'a> Reader<'a, '_, '_> {
    fn element(&mut self, element: &'a Element) -> Option<()> {
        match element.tag.as_str() {
            "shape" => return self.shape(element, &Transform::IDENTITY, 0),
            // Looked at where a shape refers to it.
            "emitter" if element.kind() == "area" => self.lamps.push(element),
            "emitter" => return self.emitter(element),
            "sensor" => self.sensor(element),
            "integrator" | "sampler" | "film" => self.idle.push(element),
            // Looked at where something refers to them.
            "bsdf" | "texture" | "alias" => {}
            "medium" | "phase" | "volume" => {
                self.scope.refuse(
                    element,
                    "is not read: light goes through air alone",
                    "remove it",
                );
            }
            "ref" => return self.scope.object(element).map(drop),
            "float" | "integer" | "boolean" | "string" => {}
            _ => self.scope.warn(
                element,
                "is not used",
                "nothing needs to be done if it is no surface and no light",
            ),
        }
        Some(())
    }

    /// Whether a limit is reached, after which nothing more is read.
    fn is_full(&self) -> bool {
        self.visits_left == 0 || self.triangles > limits::TRIANGLES
    }

    fn shape(&mut self, shape: &'a Element, outer: &Transform, depth: usize) -> Option<()> {
        if self.visits_left == 0 || depth > limits::DEPTH {
            let what = format!("is one of more than {} shapes, or lies too deep", limits::SHAPES);
            self.scope.refuse(shape, &what, "join the meshes of one material");
            self.visits_left = 0;
            return None;
        }
        self.visits_left -= 1;
        match shape.kind() {
            // Stands where instances of it stand.
            "shapegroup" if depth == 0 => Some(()),
            "shapegroup" | "merge" => self.group(shape, outer, depth),
            "instance" => {
                let read = transform(shape, "to_world");
                let map = outer.then_from(&self.scope.take(&shape.at, read)?);
                self.group(shape, &map, depth)
            }
            _ => self.surface(shape, outer),
        }
    }

    fn group(&mut self, group: &'a Element, map: &Transform, depth: usize) -> Option<()> {
        for inner in self.scope.objects(group, "shape") {
            self.shape(inner, map, depth + 1)?;
        }
        self.scope.finish(group);
        Some(())
    }

    fn surface(&mut self, shape: &'a Element, outer: &Transform) -> Option<()> {
        let luminance_cd_m2 = self.luminance(shape)?;
        let is_emitter = !luminance_cd_m2.is_black();
        let mesh = self.files.mesh(shape, is_emitter, &mut self.scope)?;
        let flip = self.scope.take(&shape.at, boolean(shape, "flip_normals", false))?;
        for medium in ["interior", "exterior"] {
            if shape.child(medium).is_some() {
                self.scope.refuse(shape, "holds a medium, which is not read", "remove it");
                return None;
            }
        }
        for sensor in self.scope.objects(shape, "sensor") {
            self.scope.warn(
                sensor,
                "is not used",
                "ask `isolux probe` or `grid` for the light on it",
            );
        }
        let bsdfs = self.scope.objects(shape, "bsdf");
        if bsdfs.len() > 1 {
            self.scope.refuse(shape, "has more than one bsdf", "keep one");
        }
        self.scope.finish(shape);
        let usual = format!("{} line {}", shape.kind(), shape.at.line);
        let name = shape.attribute("id").map_or(usual, str::to_owned);
        let Mesh { shapes, world_from_shape, keeps_front } = mesh;
        let map = outer.then_from(&world_from_shape);
        for part in shapes.iter() {
            let asked = Asked {
                bsdf: bsdfs.first().copied(),
                name: name.clone(),
                luminance_cd_m2,
                has_uvs: part.uvs.is_some(),
            };
            let Some(Chosen { material, to_uv }) =
                self.palette.choose(shape, &asked, &mut self.scope)?
            else {
                continue;
            };
            self.triangles += part.triangles.len();
            if self.triangles > limits::TRIANGLES {
                let what = format!("makes more than {} triangles in all", limits::TRIANGLES);
                self.scope.refuse(shape, &what, "reduce the detail");
                return None;
            }
            let mut made = placed(part, &map, keeps_front);
            if flip {
                made = inside_out(made);
            }
            for uv in made.uvs.iter_mut().flatten() {
                let moved = to_uv.point(Point::new(uv[0], uv[1], 0.0));
                *uv = [moved.x, moved.y];
            }
            let own = if part.name.is_empty() { String::new() } else { format!("/{}", part.name) };
            self.shapes.push(Shape { name: format!("{name}{own}"), material, ..made });
        }
        Some(())
    }

    /// What a shape emits, in front.
    fn luminance(&mut self, shape: &'a Element) -> Option<Rgb> {
        let mut sum = Rgb::BLACK;
        for emitter in self.scope.objects(shape, "emitter") {
            if emitter.kind() != "area" {
                self.scope.refuse(emitter, "is not read on a shape", "use an area emitter");
                return None;
            }
            sum += self.radiance(emitter)? * self.efficacy_lm_w;
            self.scope.finish(emitter);
            self.say_efficacy(emitter);
        }
        Some(sum)
    }

    /// The radiance of an area emitter, of a picture its mean.
    fn radiance(&mut self, emitter: &'a Element) -> Option<Rgb> {
        let is_picture = |child: &&Element| matches!(child.tag.as_str(), "texture" | "ref");
        if !emitter.child("radiance").as_ref().is_some_and(is_picture) {
            let read = emitter::light(emitter, "radiance", 1.0);
            return self.scope.take(&emitter.at, read);
        }
        let what = "has a texture as its radiance: its mean is taken";
        self.scope.warn(emitter, what, "cut the shape where its light differs");
        let pictures = self.palette.pictures();
        pictures.paint(emitter, "radiance", Rgb::WHITE, &mut self.scope).map(|paint| paint.colour)
    }

    fn emitter(&mut self, emitter: &'a Element) -> Option<()> {
        type Read = fn(&Element, f64) -> Result<Luminaire, Wrong>;
        let read: Read = match emitter.kind() {
            "point" => emitter::point,
            "spot" => emitter::spot,
            "directional" => emitter::directional,
            "constant" | "envmap" => return self.surroundings(emitter),
            "sky" | "sun" | "sunsky" => {
                let remedy = "remove it, and give the sky by `--sky` or by [sky] of a scene.toml";
                self.scope.refuse(emitter, "is not read", remedy);
                return None;
            }
            _ => {
                let remedy = "use point, spot, directional, constant, envmap, or area on a shape";
                self.scope.refuse(emitter, "is not read", remedy);
                return None;
            }
        };
        let luminaire = self.scope.take(&emitter.at, read(emitter, self.efficacy_lm_w))?;
        self.scope.finish(emitter);
        self.say_efficacy(emitter);
        self.luminaires.push(luminaire);
        if self.luminaires.len() > limits::LUMINAIRES {
            let what = format!("is one of more than {} luminaires", limits::LUMINAIRES);
            self.scope.refuse(emitter, &what, "use fewer");
            self.visits_left = 0;
            return None;
        }
        Some(())
    }

    /// What is seen where there is nothing.
    fn surroundings(&mut self, emitter: &'a Element) -> Option<()> {
        let made = match emitter.kind() {
            "envmap" => surroundings::picture(emitter, self.efficacy_lm_w, &mut self.scope)?,
            _ => {
                let read = surroundings::constant(emitter, self.efficacy_lm_w);
                self.scope.take(&emitter.at, read)?
            }
        };
        self.scope.finish(emitter);
        if std::mem::replace(&mut self.has_surroundings, true) {
            let what = "is the second that surrounds the scene";
            self.scope.refuse(emitter, what, "keep one");
            return None;
        }
        self.say_efficacy(emitter);
        self.luminaires.push(made);
        Some(())
    }

    fn say_efficacy(&mut self, emitter: &Element) {
        if std::mem::take(&mut self.says_efficacy) {
            let what = format!(
                "radiances are read as luminances of {0} lm/W: {0} (0.2126 red + 0.7152 green + 0.0722 blue) cd/m2",
                EFFICACY_LM_W
            );
            let remedy = "refer to the file from a scene.toml with `efficacy_lm_w` to choose another: 1 \
                          where its values are photometric";
            self.scope.notes.warning(&emitter.at, what, remedy);
        }
    }

    fn sensor(&mut self, sensor: &'a Element) {
        match sensor.kind() {
            "perspective" | "thinlens" => {}
            _ => {
                self.scope.warn(
                    sensor,
                    "is not used",
                    "cameras are `perspective`; for light at places ask `isolux probe`",
                );
                return;
            }
        }
        let read = sensor::camera(sensor, self.cameras.len() + 1);
        // What makes the picture and not the view.
        for child in &sensor.children {
            let is_optics = ["near_clip", "far_clip", "focus_distance", "aperture_radius", "srf"];
            if matches!(child.tag.as_str(), "film" | "sampler") {
                self.idle.push(child);
            }
            if is_optics.contains(&child.slot()) || matches!(child.tag.as_str(), "film" | "sampler")
            {
                child.is_used.set(true);
            }
        }
        self.cameras.extend(self.scope.take(&sensor.at, read));
        self.scope.finish(sensor);
    }

    fn finish(mut self, path: &Path) -> SceneParts {
        for lamp in self.lamps.iter().filter(|lamp| !lamp.is_used.get()) {
            let remedy = "refer to it from a shape by <ref>, or remove it";
            self.scope.warn(lamp, "lights nothing, as no shape refers to it", remedy);
        }
        if let Some(first) = self.idle.first() {
            let mut labels: Vec<String> = self.idle.iter().map(|idle| idle.label()).collect();
            labels.sort();
            labels.dedup();
            labels.truncate(8);
            let what = format!("{}: not used", labels.join(", "));
            let remedy = "nothing needs to be done; a map has methods of its own and no pixels";
            self.scope.notes.warning(&first.at, what, remedy);
        }
        let (materials, textures) = self.palette.finish();
        SceneParts {
            name: path.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into()),
            up: up(&self.cameras),
            shapes: self.shapes,
            materials,
            textures,
            luminaires: self.luminaires,
            cameras: self.cameras,
            ..SceneParts::default()
        }
    }
}

/// The axis that is up in the first camera's picture; y without one, as in most scenes of Mitsuba.
fn up(cameras: &[Camera]) -> UpAxis {
    let is_z = |camera: &Camera| camera.up.to_vector().z.abs() > camera.up.to_vector().y.abs();
    if cameras.first().is_some_and(is_z) { UpAxis::Z } else { UpAxis::Y }
}
