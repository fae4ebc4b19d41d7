//! A scene, light on it, and the file that comes of both.

use isolux::geometry::{Normal, Point};
use isolux::lightmap::{Lightmap, LightmapSettings, Pace, UvUnwrap, bake, plan};
use isolux::map::{IlluminationMap, Standing, VertexLight};
use isolux::scene::Scene;
use isolux::units::Rgb;
use isolux_formats::lightmap::Target;
use isolux_formats::map_glb::{Preview, TexelFile};
use isolux_formats::onto::{Onto, Options};
use isolux_formats::{Loaded, Problem, Problems};
use std::path::Path;

/// Light that tells places and sides from each other, lx: even in space, so that all texels and lookups have it.
pub(crate) fn illuminance_lx(place: Point, normal: Normal) -> f64 {
    let n = normal.to_vector();
    400.0 + 20.0 * place.x + 10.0 * place.y - 15.0 * place.z + 90.0 * n.x + 120.0 * n.y + 60.0 * n.z
}

/// A scene and its lightmap.
pub(crate) struct Lit {
    pub(crate) scene: Scene,
    map: IlluminationMap,
    lightmap: Lightmap,
}

impl Lit {
    /// A file as it is solved.
    pub(crate) fn of(path: &Path, page: u32) -> Self {
        let scene = Scene::assemble(isolux_formats::load(path).unwrap().value).unwrap();
        let map = map(&scene);
        let settings =
            LightmapSettings { texels_per_m: Some(16.0), page, ..LightmapSettings::default() };
        let layout = plan(&scene, &settings, &UvUnwrap).unwrap();
        let lightmap = bake(&scene, &map, &layout, &mut |_| Pace::Whole).unwrap();
        Self { scene, map, lightmap }
    }

    /// The same light onto a file.
    pub(crate) fn onto(
        &self,
        path: &Path,
        (target, options): (Target, Options),
    ) -> Result<(Vec<u8>, Vec<Problem>), Problems> {
        let Loaded { value, warnings } = Onto::open(path, &self.scene, (target, options))?;
        let bytes = value.write(&self.file(target)).unwrap();
        assert_eq!(bytes, value.write(&self.file(target)).unwrap());
        Ok((bytes, warnings))
    }

    /// The same for three.js, or what is said of a file that will not do.
    pub(crate) fn written(&self, path: &Path) -> Result<Vec<u8>, String> {
        let opened = Onto::open(path, &self.scene, (Target::Three, Options::default()));
        let opened = opened.map_err(|problems| problems.to_string())?;
        opened.value.write(&self.file(Target::Three)).map_err(|error| error.to_string())
    }

    /// What is said of a file that is found to be wrong only when it is written.
    pub(crate) fn refused(&self, path: &Path) -> String {
        self.written(path).unwrap_err()
    }

    fn file(&self, target: Target) -> TexelFile<'_> {
        let (scene, map, lightmap) = (&self.scene, &self.map, &self.lightmap);
        let preview = Preview { exposure_m2_cd: 0.01, white_cd_m2: 400.0 };
        TexelFile { scene, map, lightmap, preview, target, with_record: false }
    }
}

fn map(scene: &Scene) -> IlluminationMap {
    let lit = |place: Point, normal: Normal| VertexLight {
        indirect_lx: Rgb::grey(illuminance_lx(place, normal)),
        standard_error_lx: 1e-3,
        indirect_standard_error_lx: 1e-3,
        standing: Standing::Open,
        ..VertexLight::NOTHING
    };
    crate::lit::map(scene, |place, normal| Some(lit(place, normal)))
}
