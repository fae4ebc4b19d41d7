//! Pictures of a report, and what its observers see.

use crate::failure::Failure;
use crate::flags::ReportFlags;
use crate::look::Look;
use crate::shown::name;
use crate::{glare, traced, viewpoint};
use isolux::engine::MapReader;
use isolux::map::IlluminationMap;
use isolux::scene::{Camera, Scene};
use isolux_formats::png::encode_profiled;
use isolux_report::{Glare, Image, Observer, View};
use isolux_view::Picture;

/// The size of pictures, pixels.
const SIZE: (u32, u32) = (1120, 630);

/// The pictures of the cameras asked for, of all if none is, and the glare that each sees.
pub(super) fn of(
    flags: &ReportFlags,
    (scene, map, reader): (&Scene, &IlluminationMap, &MapReader<'_>),
) -> Result<(Vec<View>, Vec<Glare>), Failure> {
    let (mut views, mut glares) = (Vec::new(), Vec::new());
    let look = Look::usual(scene);
    for camera in cameras(flags, scene)? {
        views.push(view((scene, map), &camera, &look)?);
        glares.extend(rated((scene, reader), &camera));
    }
    Ok((views, glares))
}

pub(super) fn cameras(flags: &ReportFlags, scene: &Scene) -> Result<Vec<Camera>, Failure> {
    if flags.camera.is_empty() {
        return Ok(scene.cameras().to_vec());
    }
    let of = |name: &String| viewpoint::camera(scene, Some(name)).map_err(Failure::bad_input);
    flags.camera.iter().map(of).collect()
}

fn view(
    (scene, map): (&Scene, &IlluminationMap),
    camera: &Camera,
    look: &Look,
) -> Result<View, Failure> {
    let (view, _) = traced::view(scene, map, camera, SIZE)?;
    Ok(View {
        name: name(&camera.name),
        picture: image(&look.picture(&view)?)?,
        chart: Some(image(&look.chart(&view)?)?),
    })
}

fn image(Picture { width, height, rgb, icc }: &Picture) -> Result<Image, Failure> {
    let png = encode_profiled(*width, *height, rgb, icc.as_deref());
    png.map(Image::Png).map_err(|e| Failure::Refused(e.to_string()))
}

/// `None` of an observer who is inside of something.
fn rated((scene, reader): (&Scene, &MapReader<'_>), camera: &Camera) -> Option<Glare> {
    let (rating, background_cd_m2) = glare::rated(scene, reader, camera)?;
    Some(Glare {
        observer: Observer {
            name: name(&camera.name),
            position_m: camera.position.into(),
            direction: camera.direction.to_vector().into(),
        },
        rating,
        background_cd_m2,
    })
}
