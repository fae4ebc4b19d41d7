//! From the scene as written to its parts.

use super::context::Context;
use super::groups::Groups;
use super::library::Libraries;
use super::materials::Palette;
use super::record::SceneFile;
use super::{cameras, geometry, grids, luminaires, requirements, sky};
use isolux::scene::SceneParts;

/// All parts that could be made; what is wrong goes to the findings.
pub(super) fn resolve(mut file: SceneFile, context: &mut Context) -> SceneParts {
    context.unit_m = file.units.map_or(1.0, |unit| unit.metres());
    context.up = file.up.unwrap_or_default();
    let mut scene = SceneParts {
        name: file.name.take().unwrap_or_else(|| stem(context)),
        up: context.up,
        ..SceneParts::default()
    };
    let mut palette = Palette::resolve(std::mem::take(&mut file.materials), &mut scene, context);
    for (number, entry) in (1..).zip(&file.geometry) {
        geometry::add(entry, number, &mut palette, &mut scene, context);
    }
    palette.warn_of_unused(context);
    let mut groups = Groups::new(&file, &scene);
    let mut libraries = Libraries::read(&file.libraries, context);
    luminaires::add(&file.luminaires, &mut groups, &mut libraries, &mut scene, context);
    libraries.finish(context);
    if let Some(entry) = &file.sky {
        let found = sky::luminaires(entry, context);
        groups.put(found, &mut scene.luminaires);
    }
    scene.groups = groups.names;
    cameras::add(&file.cameras, &mut scene, context);
    grids::add(&file.grids, &mut scene, context);
    requirements::add(&file.requirements, &mut scene, context);
    if scene.shapes.is_empty() && !context.has_problems() {
        context.problem(&(0..0), "the scene has no geometry", "add a [[geometry]]");
    }
    scene
}

fn stem(context: &Context) -> String {
    let stem = context.findings.file().file_stem();
    stem.map_or_else(String::new, |s| s.to_string_lossy().into_owned())
}
