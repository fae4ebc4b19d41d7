//! Pictures of maps as a viewer of the file shows them, and how far they are from others.

use super::folder::Folder;
use super::plan::Plan;
use crate::failure::Failure;
use crate::{render, viewpoint};
use isolux::map::IlluminationMap;
use isolux::scene::{Camera, Scene};
use isolux_compare::metric::{DeltaE, White, Xyz, colour_difference, picture_distance};
use isolux_compare::study::Distances;
use isolux_view::{Development, Exposure, MonitorProfile, develop};

/// Looks at maps of one scene, always alike.
pub(crate) struct Viewer {
    camera: Camera,
    size: (u32, u32),
    /// The luminance that is shown as white, cd/m2: that of the reference picture.
    exposure: Exposure,
    profile: MonitorProfile,
}

impl Viewer {
    /// As a map asks for.
    pub(crate) fn of(scene: &Scene, map: &IlluminationMap, plan: &Plan) -> Result<Self, Failure> {
        let viewer = Self {
            camera: viewpoint::camera(scene, None).map_err(Failure::bad_input)?,
            size: plan.picture.into(),
            exposure: Exposure::Automatic,
            profile: MonitorProfile::srgb(),
        };
        let seen = render::bare(scene, map, &viewer.camera, viewer.size)?;
        let white = Exposure::Automatic.white_cd_m2(&seen).map_err(Failure::bad_input)?;
        Ok(Self { exposure: Exposure::WhiteCdM2(white), ..viewer })
    }

    /// Makes a picture of a bare map, all light interpolated between its vertices, and keeps it.
    pub(crate) fn keep(
        &self,
        (scene, map): (&Scene, &IlluminationMap),
        (folder, name): (&Folder, &str),
    ) -> Result<(), Failure> {
        let how = Development { exposure: self.exposure, ..Development::default() };
        let seen = render::bare(scene, map, &self.camera, self.size)?;
        let picture = develop(&seen, &how).map_err(Failure::bad_input)?;
        render::write(&folder.output(name, "png")?, &picture)
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

/// The codes of a picture that was kept.
fn read(folder: &Folder, name: &str) -> Option<Vec<[u8; 3]>> {
    let picture = isolux_formats::picture::read(&folder.path(name)).ok()?;
    Some(picture.srgb.as_chunks::<3>().0.to_vec())
}
