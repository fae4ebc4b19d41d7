//! `isolux render`: views from a map, or of a scene.

mod light;
mod outputs;
mod report;

use crate::console::{print, print_json};
use crate::exposed;
use crate::failure::{Failure, Outcome};
use crate::flags::RenderFlags;
use crate::look::Look;
use crate::notes::{Note, note};
use crate::output::OutputPath;
use crate::viewpoint::{self, NamedView};
use isolux_formats::luminance::{Luminances, encode_exr, encode_radiance};
use isolux_view::{LuminanceImage, Picture};
use light::{Opened, Seen};
use outputs::{Kind, Output, Wanted};
use report::{Indirect, Report, ViewReport};

/// Runs the subcommand.
pub(crate) fn run(flags: &RenderFlags, json: bool) -> Result<Outcome, Failure> {
    let wanted = Wanted::of(flags)?;
    let look = Look::of(&flags.look)?;
    let opened = Opened::of(flags)?;
    // All that can be wrong with views and files is found before minutes are spent on light.
    let asked = viewpoint::asked(&opened.scene, &flags.eye, &flags.map)?;
    let names: Vec<&str> = match &asked {
        Some(views) => views.iter().map(|view| view.name.as_str()).collect(),
        None => vec![viewpoint::OWN],
    };
    let outputs = wanted.of_views(&names, &flags.map)?;
    let Some(lit) = opened.lit(flags)? else { return Ok(Outcome::Interrupted) };
    let look = look.of_scene(&lit.scene, lit.map());
    let views = asked.unwrap_or_else(|| vec![lit.own_view(flags)]);
    let (mut drawn, mut problems) = (Vec::new(), Vec::new());
    for (named, outputs) in views.iter().zip(outputs) {
        let size = fitted(flags.size, named.view.projection.aspect());
        let Some(seen) = lit.see(named.view, size)? else { return Ok(Outcome::Interrupted) };
        match draw(named, seen, (&look, &outputs)) {
            Ok(view) => drawn.push(view),
            // The other cameras may see something.
            Err(Failure::BadInput(lines)) => problems.extend(lines),
            Err(other) => return Err(other),
        }
    }
    if drawn.is_empty() {
        return Err(Failure::BadInput(problems));
    }
    problems.iter().for_each(|problem| note(Note::Error, &problem.message));
    let outcome = if problems.is_empty() { Outcome::Done } else { Outcome::Unusable };
    let report = Report::of(drawn, problems);
    if json {
        print_json(&report)?
    } else {
        print(&report.text())?
    }
    Ok(outcome)
}

/// Writes the files of a view.
fn draw(
    named: &NamedView,
    seen: Seen,
    (look, outputs): (&Look, &[Output]),
) -> Result<ViewReport, Failure> {
    let Seen { view, gathered, cache } = seen;
    let charts_alone = outputs.iter().all(|output| output.kind == Kind::Chart);
    exposed::check(&view, &named.name, charts_alone)?;
    let (mut size, mut is_warned) = (None, false);
    for Output { path, kind } in outputs {
        match kind {
            Kind::Picture => {
                let picture = look.picture(&view)?;
                write(path, &picture)?;
                if !std::mem::replace(&mut is_warned, true) {
                    exposed::warn(&view, &picture, look.development());
                }
                size.get_or_insert((picture.width, picture.height));
            }
            Kind::Chart => {
                let picture = look.chart(&view)?;
                write(path, &picture)?;
                size.get_or_insert((picture.width, picture.height));
            }
            Kind::Exr | Kind::Hdr => write_luminance(path, *kind, &view)?,
        }
    }
    let (width, height) = size.unwrap_or((view.size().width(), view.size().height()));
    let is_picture = outputs.iter().any(|output| output.kind == Kind::Picture);
    let files = report::files(outputs);
    Ok(ViewReport {
        picture: files.first().cloned().unwrap_or_default(),
        files,
        camera: named.name.clone(),
        width,
        height,
        profile: look.profile(is_picture).to_owned(),
        indirect: gathered.map(Indirect::of),
        cache,
    })
}

/// The largest size of this aspect within another one.
fn fitted((width, height): (u32, u32), aspect: Option<f64>) -> (u32, u32) {
    let Some(aspect) = aspect else { return (width, height) };
    let (across, down) = (f64::from(width), f64::from(height));
    match across > aspect * down {
        true => (((aspect * down).round() as u32).max(1), height),
        false => (width, ((across / aspect).round() as u32).max(1)),
    }
}

/// Writes a picture.
pub(crate) fn write(output: &OutputPath, picture: &Picture) -> Result<(), Failure> {
    let Picture { width, height, rgb, icc } = picture;
    let bytes = isolux_formats::png::encode_profiled(*width, *height, rgb, icc.as_deref())
        .map_err(|e| Failure::Refused(format!("{}: {e}", output.path().display())))?;
    output.write(&bytes)
}

/// Writes the luminances of a view.
fn write_luminance(output: &OutputPath, kind: Kind, view: &LuminanceImage) -> Result<(), Failure> {
    let (width, height) = (view.size().width(), view.size().height());
    let pixel = |pixel| view.luminance_cd_m2(pixel).0.map(|channel| channel as f32);
    let rgb_cd_m2: Vec<[f32; 3]> = (0..view.size().pixels()).map(pixel).collect();
    let luminances = Luminances { width, height, rgb_cd_m2: &rgb_cd_m2 };
    let bytes = match kind {
        Kind::Exr => encode_exr(&luminances),
        _ => encode_radiance(&luminances),
    };
    let bytes = bytes.map_err(|e| Failure::Refused(format!("{}: {e}", output.path().display())))?;
    output.write(&bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_of_a_shape_fit_in() {
        assert_eq!(fitted((1280, 720), None), (1280, 720));
        assert_eq!(fitted((1280, 720), Some(2.0)), (1280, 640));
        assert_eq!(fitted((1280, 720), Some(1.0)), (720, 720));
        assert_eq!(fitted((10, 10), Some(1e9)), (10, 1));
    }
}
