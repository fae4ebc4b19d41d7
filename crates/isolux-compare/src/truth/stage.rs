//! A scene while it is built: surfaces, things and luminaires by a call each.

use super::draw::{Draw, thousandths};
use crate::hall::lamps;
use crate::model::{Rectangle, inward_box, outward_box, sphere};
use isolux::geometry::{Direction, Point, Vector};
use isolux::photometry::IntensityDistribution;
use isolux::scene::{
    Body, Dielectric, Finish, Luminaire, LuminaireKind, Material, SceneParts, Shape, UpAxis,
    world_from_luminaire,
};
use isolux::units::{Rgb, sincos_deg};

/// A scene in the making, z up.
pub(super) struct Stage {
    pub(super) draw: Draw,
    /// 0 of the scene for tuning, 1 of the one for judging.
    pub(super) half: usize,
    /// Whether surfaces reflect on both sides.
    two_sided: bool,
    parts: SceneParts,
}

impl Stage {
    /// Nothing yet.
    pub(super) fn new(name: String, seed: u64, index: u32) -> Self {
        let mut draw = Draw::new(seed, u64::from(index));
        let two_sided = draw.chance(0.5);
        let parts = SceneParts { name, ..SceneParts::default() };
        Self { draw, half: index as usize % 2, two_sided, parts }
    }

    /// What was built.
    pub(super) fn into_parts(self) -> SceneParts {
        self.parts
    }

    /// Adds a material; its number.
    pub(super) fn material(&mut self, mut material: Material) -> u32 {
        let number = self.parts.materials.len() as u32;
        material.name = format!("{} {number}", material.name);
        self.parts.materials.push(material);
        number
    }

    fn sided(&mut self, name: &str, finish: Finish) -> u32 {
        let two_sided = self.two_sided;
        let material = if two_sided { Material::two_sided } else { Material::one_sided };
        self.material(material(name, finish))
    }

    /// A diffuse material, one-sided or two-sided as the whole scene is.
    pub(super) fn paint(&mut self, colour: Rgb) -> u32 {
        self.sided("paint", Finish::diffuse(colour))
    }

    /// A grey or tinted paint of a reflectance between two.
    pub(super) fn any_paint(&mut self, low: f64, high: f64) -> u32 {
        let reflectance = self.draw.between(low, high);
        let [r, b] = [0.0; 2].map(|_| self.draw.between(0.7, 1.0));
        self.paint(Rgb([r, 1.0, b].map(|tint| thousandths(tint * reflectance))))
    }

    /// A grey that reflects on both sides, in every scene.
    pub(super) fn sheet_paint(&mut self, reflectance: f64) -> u32 {
        let finish = Finish::diffuse(Rgb::grey(reflectance));
        self.material(Material::two_sided("sheet", finish))
    }

    /// A mirror with a black back.
    pub(super) fn mirror_paint(&mut self, reflectance: Rgb) -> u32 {
        self.material(Material::one_sided("mirror", Finish::mirror(reflectance)))
    }

    /// Window glass: a pane, or the face of a solid.
    pub(super) fn glass(&mut self, thin: bool, transmittance: f64) -> u32 {
        let transmittance = Rgb::grey(transmittance);
        let body = Body::Dielectric(Dielectric { ior: 1.5, transmittance, thin });
        self.material(Material { name: "glass".into(), body })
    }

    /// A surface that shines to its front, and reflects there.
    pub(super) fn luminous(&mut self, luminance_cd_m2: f64, reflectance: f64) -> u32 {
        let light = Rgb::grey(luminance_cd_m2);
        let finish = Finish { luminance_cd_m2: light, ..Finish::diffuse(Rgb::grey(reflectance)) };
        self.material(Material::one_sided("luminous", finish))
    }

    /// Adds a mesh as it is.
    pub(super) fn shape(&mut self, shape: Shape) {
        self.parts.shapes.push(shape);
    }

    /// A rectangle from a corner along two edges, in front where `u x v` points.
    pub(super) fn sheet(
        &mut self,
        name: &str,
        corner: [f64; 3],
        u: [f64; 3],
        v: [f64; 3],
        material: u32,
    ) {
        self.shape(Rectangle::new(corner, u, v).shape(name, material));
    }

    /// A box with its front outside.
    pub(super) fn solid(&mut self, name: &str, low: [f64; 3], high: [f64; 3], material: u32) {
        self.shape(outward_box(name, low, high, material));
    }

    /// A box turned about the vertical through its middle.
    pub(super) fn turned_solid(
        &mut self,
        name: &str,
        low: [f64; 3],
        high: [f64; 3],
        turn_deg: f64,
        material: u32,
    ) {
        let mut shape = outward_box(name, low, high, material);
        let (s, c) = sincos_deg(turn_deg);
        let [x, y] = [0, 1].map(|axis| 0.5 * (low[axis] + high[axis]));
        for p in &mut shape.positions {
            let [a, b] = [p[0] - x, p[1] - y];
            (p[0], p[1]) = (x + c * a - s * b, y + s * a + c * b);
        }
        self.shape(shape);
    }

    /// A room of one paint from the origin, front inside.
    pub(super) fn bare_room(&mut self, size: [f64; 3], material: u32) {
        self.shape(inward_box("room", [0.0; 3], size, material));
    }

    /// A closed room from the origin with floor, walls and ceiling of their own.
    pub(super) fn room(&mut self, size: [f64; 3]) {
        let [floor, walls, ceiling] =
            [(0.15, 0.45), (0.4, 0.75), (0.7, 0.88)].map(|(low, high)| self.any_paint(low, high));
        self.level("floor", size, 0.0, floor);
        self.ceiling(size, ceiling);
        self.walls([0.0; 2], [size[0], size[1]], [0.0, size[2]], walls);
    }

    /// A level of a room, in front above.
    pub(super) fn level(&mut self, name: &str, size: [f64; 3], z: f64, material: u32) {
        self.sheet(name, [0.0, 0.0, z], [size[0], 0.0, 0.0], [0.0, size[1], 0.0], material);
    }

    /// The ceiling of a room, in front below.
    pub(super) fn ceiling(&mut self, [x, y, z]: [f64; 3], material: u32) {
        self.sheet("ceiling", [0.0, 0.0, z], [0.0, y, 0.0], [x, 0.0, 0.0], material);
    }

    /// Four walls between two corners of a plan and two heights, front inside.
    pub(super) fn walls(
        &mut self,
        [x0, y0]: [f64; 2],
        [x1, y1]: [f64; 2],
        heights: [f64; 2],
        material: u32,
    ) {
        self.walls_along(&[[x0, y0], [x1, y0], [x1, y1], [x0, y1]], heights, material);
    }

    /// Walls along a plan that is walked counter-clockwise, front inside.
    pub(super) fn walls_along(&mut self, plan: &[[f64; 2]], [z0, z1]: [f64; 2], material: u32) {
        for (k, &[x, y]) in plan.iter().enumerate() {
            let [to_x, to_y] = plan[(k + 1) % plan.len()];
            let along = [to_x - x, to_y - y, 0.0];
            self.sheet("wall", [x, y, z0], [0.0, 0.0, z1 - z0], along, material);
        }
    }

    /// A sphere with smooth normals, front outside.
    pub(super) fn ball(&mut self, centre: [f64; 3], radius_m: f64, rows: u32, material: u32) {
        let mut shape = sphere(radius_m, rows).shape("ball", material, |_| true);
        shape.triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
        shape.normals.iter_mut().flatten().for_each(|n| *n = n.map(|c| -c));
        for p in &mut shape.positions {
            *p = [0, 1, 2].map(|axis| p[axis] + centre[axis]);
        }
        self.shape(shape);
    }

    /// An isotropic lamp.
    pub(super) fn lamp(&mut self, at: [f64; 3], intensity_cd: f64) {
        self.aimed(at, [0.0, 0.0, -1.0], IntensityDistribution::Isotropic { intensity_cd });
    }

    /// A lamp that aims along a direction.
    pub(super) fn aimed(&mut self, at: [f64; 3], aim: [f64; 3], intensity: IntensityDistribution) {
        let aim = Vector::from(aim).direction().unwrap_or(-Direction::Z);
        let kind = LuminaireKind::Point {
            position: at.into(),
            world_from_luminaire: world_from_luminaire(UpAxis::Z, aim, 0.0),
            intensity,
            area: None,
        };
        self.luminaire(kind);
    }

    /// A photometric file of the hall: downlight, batwing or wall washer.
    pub(super) fn filed(&mut self, at: [f64; 3], aim: [f64; 3], file: usize) {
        self.aimed(at, aim, lamps()[file].distribution());
    }

    /// Parallel light.
    pub(super) fn sun(&mut self, direction: [f64; 3], illuminance_lx: f64) {
        let direction = Vector::from(direction).direction().unwrap_or(-Direction::Z);
        self.luminaire(LuminaireKind::Directional {
            direction,
            illuminance_lx,
            half_angle_rad: 0.0,
        });
    }

    fn luminaire(&mut self, kind: LuminaireKind) {
        let name = format!("luminaire {}", self.parts.luminaires.len());
        self.parts.luminaires.push(Luminaire { name, group: 0, colour: Rgb::WHITE, kind });
    }

    /// Everything so many times as large, then shifted; lamps give the same lux as before.
    pub(super) fn remove(&mut self, scale: f64, shift: [f64; 3]) {
        let moved = |p: [f64; 3]| [0, 1, 2].map(|axis| scale * p[axis] + shift[axis]);
        for shape in &mut self.parts.shapes {
            shape.positions.iter_mut().for_each(|p| *p = moved(*p));
        }
        for luminaire in &mut self.parts.luminaires {
            let LuminaireKind::Point { position, intensity, .. } = &mut luminaire.kind else {
                continue;
            };
            *position = Point::from(moved((*position).into()));
            brighten(intensity, scale * scale);
        }
    }
}

/// Photometric files are not for scenes of another scale.
fn brighten(intensity: &mut IntensityDistribution, factor: f64) {
    use IntensityDistribution::{CosinePower, Isotropic, Spot, Web};
    match intensity {
        Isotropic { intensity_cd: cd }
        | CosinePower { peak_cd: cd, .. }
        | Spot { peak_cd: cd, .. } => *cd *= factor,
        Web(_) => assert!(factor == 1.0, "a photometric file holds candela of its own"),
    }
}
