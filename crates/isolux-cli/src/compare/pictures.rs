//! Pictures of maps as a viewer of the file shows them, and how far they are from others.

use super::folder::Folder;
use super::plan::Plan;
use crate::failure::Failure;
use crate::viewpoint;
use isolux::map::IlluminationMap;
use isolux::scene::{Camera, Scene};
use isolux_compare::metric::{DeltaE, White, Xyz, colour_difference, picture_distance};
use isolux_compare::study::Distances;
use isolux_view::{
    Development, Exposure, LuminanceImage, MonitorProfile, Size, SurfacePoint, TraceSettings,
    develop, trace,
};

/// Walls of one side only are looked through from outside.
const SETTINGS: TraceSettings = TraceSettings { through_black_backs: true, ..TraceSettings::FINE };

/// Looks at maps of one scene, always alike.
pub(crate) struct Viewer {
    camera: Camera,
    size: Size,
    /// The luminance that is shown as white, cd/m2: that of the reference picture.
    exposure: Exposure,
    profile: MonitorProfile,
}

impl Viewer {
    /// As a map asks for.
    pub(crate) fn of(scene: &Scene, map: &IlluminationMap, plan: &Plan) -> Result<Self, Failure> {
        let [width, height] = plan.picture;
        let viewer = Self {
            camera: viewpoint::camera(scene, None).map_err(Failure::bad_input)?,
            size: Size::new(width, height).map_err(Failure::bad_input)?,
            exposure: Exposure::Automatic,
            profile: MonitorProfile::srgb(),
        };
        let seen = viewer.look(scene, map)?;
        let white = Exposure::Automatic.white_cd_m2(&seen).map_err(Failure::bad_input)?;
        Ok(Self { exposure: Exposure::WhiteCdM2(white), ..viewer })
    }

    /// The bare map: all light interpolated between its vertices.
    fn look(&self, scene: &Scene, map: &IlluminationMap) -> Result<LuminanceImage, Failure> {
        let read = |at: SurfacePoint| map.interpolate(at.triangle, at.back, at.u, at.v);
        trace(scene, &self.camera, self.size, &SETTINGS, &read).map_err(Failure::bad_input)
    }

    /// Makes a picture of a map and keeps it.
    pub(crate) fn keep(
        &self,
        (scene, map): (&Scene, &IlluminationMap),
        (folder, name): (&Folder, &str),
    ) -> Result<(), Failure> {
        let how = Development { exposure: self.exposure, ..Development::default() };
        let picture = develop(&self.look(scene, map)?, &how).map_err(Failure::bad_input)?;
        let bytes = isolux_formats::png::encode(picture.width, picture.height, &picture.rgb)
            .map_err(|e| Failure::Refused(format!("{name}: {e}")))?;
        folder.write(name, &bytes)
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
