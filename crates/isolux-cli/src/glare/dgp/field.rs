//! The hemisphere before an eye, by looks: several in each pixel.

use isolux::geometry::{Direction, Vector};
use isolux::scene::Camera;
use isolux_view::{LuminanceImage, Projection, View, ViewRays};
use std::f64::consts::{FRAC_PI_2, PI};

/// A look: about where it goes, how much it stands for, how bright it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    /// Counted in rows.
    pub(super) pixel: usize,
    pub(super) towards: Vector,
    pub(super) steradians: f64,
    pub(super) luminance_cd_m2: f64,
}

/// The pieces of the hemisphere.
pub(super) struct Field {
    /// Pixels in a row of the square picture.
    pub(super) across: usize,
    pub(super) pieces: Vec<Piece>,
}

/// Half of the space around the eye, every place at its angle from the middle.
pub(super) fn view_of(eye: &Camera) -> View {
    let projection = Projection::Angular { horizontal_rad: PI, vertical_rad: PI };
    View { projection, ..View::from(eye) }
}

impl Field {
    /// Of a square picture of [`view_of`]. Borders within a pixel are kept: the mean of a pixel half on the sun would be neither.
    pub(super) fn of(image: &LuminanceImage, eye: &Camera) -> Self {
        let size = image.size();
        let rays = ViewRays::new(view_of(eye), size);
        let [across, down] = [size.width(), size.height()].map(f64::from);
        let pixel = |k: usize| {
            let (x, y) = (k as u32 % size.width(), k as u32 / size.width());
            let (_, towards) = rays.through(f64::from(x) + 0.5, f64::from(y) + 0.5)?;
            let steradians = angular_sr(towards, eye.direction, PI * PI / (across * down))?;
            Some((k, towards.to_vector(), steradians / f64::from(image.samples_per_pixel())))
        };
        let looks = |(k, towards, steradians): (usize, Vector, f64)| {
            image.samples(k).iter().map(move |look| Piece {
                pixel: k,
                towards,
                steradians,
                luminance_cd_m2: look.luminance().luminance(),
            })
        };
        let across = size.width() as usize;
        Self { across, pieces: (0..size.pixels()).filter_map(pixel).flat_map(looks).collect() }
    }

    /// Mean over the solid angle.
    pub(super) fn mean_cd_m2(&self) -> f64 {
        let light: f64 = self.pieces.iter().map(|p| p.luminance_cd_m2 * p.steradians).sum();
        light / self.pieces.iter().map(|p| p.steradians).sum::<f64>()
    }
}

/// The solid angle of a small piece of the picture, given in squares of its angles; `None` behind the eye.
fn angular_sr(towards: Direction, ahead: Direction, of_picture: f64) -> Option<f64> {
    let cosine = towards.dot(ahead);
    let sine = towards.to_vector().cross(ahead.to_vector()).length();
    let angle = libm::atan2(sine, cosine);
    let squeezed = if angle > 0.0 { sine / angle } else { 1.0 };
    (angle < FRAC_PI_2).then_some(of_picture * squeezed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::geometry::Point;
    use isolux_view::Size;

    /// All pixels together are the hemisphere, and with their cosines pi.
    #[test]
    fn pixels_fill_the_hemisphere() {
        let eye = Camera {
            name: "eye".into(),
            position: Point::ORIGIN,
            direction: Direction::Y,
            up: Direction::Z,
            vertical_fov_rad: 1.0,
        };
        const ACROSS: u32 = 200;
        let rays = ViewRays::new(view_of(&eye), Size::new(ACROSS, ACROSS).unwrap());
        let (mut whole, mut projected) = (0.0, 0.0);
        for k in 0..ACROSS * ACROSS {
            let (x, y) = (f64::from(k % ACROSS) + 0.5, f64::from(k / ACROSS) + 0.5);
            let Some((_, towards)) = rays.through(x, y) else { continue };
            let part = PI * PI / f64::from(ACROSS * ACROSS);
            let Some(steradians) = angular_sr(towards, eye.direction, part) else { continue };
            whole += steradians;
            projected += steradians * towards.dot(eye.direction);
        }
        // Pixels on the rim are in or out as a whole.
        assert!((whole / (2.0 * PI) - 1.0).abs() < 2e-3, "{whole}");
        assert!((projected / PI - 1.0).abs() < 1e-3, "{projected}");
    }
}
