//! `isolux render`: views from a map, or of a scene.

mod light;
mod outputs;
mod refined;
mod report;

use crate::caller::{self, Told};
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
use refined::Wish;
use report::{Indirect, Report, ViewReport};

/// The mean noise, CIE94, that a picture may have unless another is asked for.
const JUST_UNSEEN: f64 = 0.5;

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
    let (mut drawn, mut problems, mut is_interrupted) = (Vec::new(), Vec::new(), false);
    for (named, outputs) in views.iter().zip(outputs) {
        let size = fitted(flags.size, named.view.projection.aspect());
        let wish =
            Wish { goal: flags.picture_accuracy.unwrap_or(JUST_UNSEEN), how: look.development() };
        // One in which nothing is lit is refused in the end.
        let show = &mut |view: &LuminanceImage| {
            let is_worth = exposed::check(view, &named.name, charts_alone(&outputs)).is_ok();
            if is_worth { write_all(view, (&look, &outputs)).map(|_| ()) } else { Ok(()) }
        };
        let seen = lit.see(named.view, size, (&wish, show))?;
        let Some(seen) = seen else { return Ok(Outcome::Interrupted) };
        is_interrupted |= seen.interrupted;
        match draw(named, seen, (&look, &outputs)) {
            Ok(view) => drawn.push(view),
            // The other cameras may see something.
            Err(Failure::BadInput(lines)) => problems.extend(lines),
            Err(other) => return Err(other),
        }
        if is_interrupted {
            break;
        }
    }
    if drawn.is_empty() {
        return Err(Failure::BadInput(problems));
    }
    problems.iter().for_each(|problem| note(Note::Error, &problem.message));
    let outcome = match () {
        () if is_interrupted => Outcome::Interrupted,
        () if problems.is_empty() => Outcome::Done,
        () => Outcome::Unusable,
    };
    let report = Report::of(drawn, problems);
    if json {
        print_json(&report)?
    } else {
        print(&report.text())?
    }
    Ok(outcome)
}

/// Writes the files of a view, and tells of it.
fn draw(
    named: &NamedView,
    seen: Seen,
    (look, outputs): (&Look, &[Output]),
) -> Result<ViewReport, Failure> {
    let Seen { view, gathered, cache, noise, .. } = seen;
    exposed::check(&view, &named.name, charts_alone(outputs))?;
    let drawn = write_all(&view, (look, outputs))?;
    if let Some(picture) = &drawn.picture {
        exposed::warn(&view, picture, look.development());
    }
    let (width, height) = drawn.size.unwrap_or((view.size().width(), view.size().height()));
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
        noise,
    })
}

fn charts_alone(outputs: &[Output]) -> bool {
    outputs.iter().all(|output| output.kind == Kind::Chart)
}

/// What has been written of a view.
#[derive(Default)]
struct Drawn {
    /// The first picture that is no chart.
    picture: Option<Picture>,
    /// The size of the first picture or chart.
    size: Option<(u32, u32)>,
}

/// Writes the files of a view.
fn write_all(view: &LuminanceImage, (look, outputs): (&Look, &[Output])) -> Result<Drawn, Failure> {
    let mut drawn = Drawn::default();
    for Output { path, kind } in outputs {
        match kind {
            Kind::Picture => {
                let picture = look.picture(view)?;
                write(path, &picture)?;
                drawn.size.get_or_insert((picture.width, picture.height));
                drawn.picture.get_or_insert(picture);
            }
            Kind::Chart => {
                let picture = look.chart(view)?;
                write(path, &picture)?;
                drawn.size.get_or_insert((picture.width, picture.height));
            }
            Kind::Exr | Kind::Hdr => write_luminance(path, *kind, view)?,
        }
    }
    Ok(drawn)
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
    if let Some(call) = caller::here() {
        call.tell(Told::Picture(picture.clone()));
    }
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
    if let Some(call) = caller::here() {
        call.tell(Told::Luminances { width, height, rgb_cd_m2 });
    }
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
