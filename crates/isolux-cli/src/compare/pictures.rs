//! Pictures of maps as a viewer of the file shows them, and how far they are from others.

use super::folder::Folder;
use super::plan::Plan;
use crate::failure::Failure;
use crate::{render, traced, viewpoint};
use isolux::map::IlluminationMap;
use isolux::scene::{Camera, Scene};
use isolux_compare::metric::{DeltaE, White, Xyz, colour_difference, picture_distance};
use isolux_compare::study::{Distances, Errors};
use isolux_view::{Development, Exposure, LuminanceImage, MonitorProfile, develop};

/// Looks at maps of one scene, always alike.
pub(crate) struct Viewer {
    camera: Camera,
    size: (u32, u32),
    /// The luminance that is shown as white, cd/m2: that of the reference picture.
    exposure: Exposure,
    profile: MonitorProfile,
    /// The illuminance that the reference shows at every pixel, lx.
    reference_lx: Vec<Option<f64>>,
}

impl Viewer {
    /// As a map asks for.
    pub(crate) fn of(scene: &Scene, map: &IlluminationMap, plan: &Plan) -> Result<Self, Failure> {
        let viewer = Self {
            camera: viewpoint::camera(scene, None).map_err(Failure::bad_input)?,
            size: plan.picture.into(),
            exposure: Exposure::Automatic,
            profile: MonitorProfile::srgb(),
            reference_lx: Vec::new(),
        };
        let seen = traced::bare(scene, map, &viewer.camera, viewer.size)?;
        let white = Exposure::Automatic.white_cd_m2(&seen).map_err(Failure::bad_input)?;
        let reference_lx = illuminances_lx(&seen);
        Ok(Self { exposure: Exposure::WhiteCdM2(white), reference_lx, ..viewer })
    }

    /// By how much the illuminance that a bare map shows differs from that of the reference, pixel by pixel.
    pub(crate) fn errors(&self, scene: &Scene, map: &IlluminationMap) -> Result<Errors, Failure> {
        Ok(self.errors_of(&traced::bare(scene, map, &self.camera, self.size)?))
    }

    fn errors_of(&self, seen: &LuminanceImage) -> Errors {
        let share = |(shown, right): (Option<f64>, &Option<f64>)| {
            let right_lx = right.filter(|right_lx| *right_lx > 0.0)?;
            Some(shown? / right_lx - 1.0)
        };
        let shares = illuminances_lx(seen).into_iter().zip(&self.reference_lx).map(share).collect();
        Errors { width: self.size.0, height: self.size.1, shares }
    }

    /// Makes a picture of a bare map, all light interpolated between its vertices, and keeps it; where the map errs.
    pub(crate) fn keep(
        &self,
        (scene, map): (&Scene, &IlluminationMap),
        (folder, name): (&Folder, &str),
    ) -> Result<Errors, Failure> {
        let how = Development { exposure: self.exposure, ..Development::default() };
        let seen = traced::bare(scene, map, &self.camera, self.size)?;
        let picture = develop(&seen, &how).map_err(Failure::bad_input)?;
        render::write(&folder.output(name, "png")?, &picture)?;
        Ok(self.errors_of(&seen))
    }

    /// How far a picture that was kept is from another; `None` where one of them is not there.
    pub(crate) fn distances(
        &self,
        folder: &Folder,
        [reference, of]: [&str; 2],
    ) -> Option<Distances> {
        let [reference, of] = [read(folder, reference)?, read(folder, of)?];
        let [x, y, z] = self.profile.white_xyz();
        let white = White::new(Xyz { x, y, z })?;
        let colours = |codes: &[[u8; 3]]| -> Vec<Xyz> {
            codes.iter().map(|&code| Xyz::from(self.profile.xyz_from_code(code))).collect()
        };
        let [a, b] = [colours(&reference), colours(&of)];
        let difference = |formula| colour_difference(formula, &a, &b, white).ok();
        Some(Distances {
            rgb: picture_distance(&reference, &of).ok()?,
            cie1976: difference(DeltaE::Cie1976)?,
            cie1994: difference(DeltaE::Cie1994)?,
            ciede2000: difference(DeltaE::Ciede2000)?,
        })
    }
}

/// The mean illuminance of the surfaces that a pixel shows, lx; `None` where it shows none.
fn illuminances_lx(seen: &LuminanceImage) -> Vec<Option<f64>> {
    let mean = |pixel: usize| {
        let readings = seen.samples(pixel).iter().filter_map(|sample| sample.reading);
        let lx: Vec<f64> = readings.map(|reading| f64::from(reading.illuminance_lx)).collect();
        (!lx.is_empty()).then(|| lx.iter().sum::<f64>() / lx.len() as f64)
    };
    (0..seen.size().pixels()).map(mean).collect()
}

/// The codes of a picture that was kept.
fn read(folder: &Folder, name: &str) -> Option<Vec<[u8; 3]>> {
    let picture = isolux_formats::picture::read(&folder.path(name)).ok()?;
    Some(picture.srgb.as_chunks::<3>().0.to_vec())
}
