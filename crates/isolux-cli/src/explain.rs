//! What a run will do, and why, in sentences.

use crate::quantity::{flux, show_bytes, show_seconds, show_share};
use isolux::engine::SolveRequest;
use isolux::map::Method;
use isolux::scene::Scene;

/// One sentence a line.
pub(crate) fn lines(scene: &Scene, request: &SolveRequest) -> Vec<String> {
    let mut said = vec![light(scene), surfaces(scene), method(request.method), stop(request)];
    if request.method == Method::Radiosity {
        said.extend(limits(request));
    }
    said.push(format!(
        "Elements are bisected until the map read without its scene is good to {}, or memory reaches \
         {}.",
        show_share(request.mesh_accuracy),
        show_bytes(request.max_memory_bytes)
    ));
    said.push(format!(
        "Random numbers are counted from seed {}: the same command gives the same bits, on any number \
         of threads.",
        request.seed
    ));
    said
}

fn light(scene: &Scene) -> String {
    let parallel = scene.luminaires().iter().filter(|l| l.kind.is_infinitely_far()).count();
    format!(
        "Light comes from {} point luminaires, {parallel} that are infinitely far away and {} emitting surfaces; \
         luminous flux {}.",
        scene.luminaires().len() - parallel,
        scene.area_luminaires().len(),
        flux(scene.luminous_flux_lm(), parallel > 0)
    )
}

fn surfaces(scene: &Scene) -> String {
    let sides = |material: u32| {
        let material = &scene.materials()[material as usize];
        [false, true].into_iter().filter_map(|back| material.finish(back)).collect::<Vec<_>>()
    };
    let (mut mirrors, mut glossy, mut clear) = (0_u64, 0_u64, 0_u64);
    for triangle in 0..scene.triangle_count() {
        let sides = sides(scene.material_index(triangle));
        clear += u64::from(sides.is_empty());
        mirrors += u64::from(sides.iter().any(|f| !f.mirror.is_black()));
        glossy += u64::from(sides.iter().any(|f| f.is_glossy()));
    }
    format!(
        "Of {} triangles {mirrors} mirror, {glossy} are glossy and {clear} are clear; light is \
         followed through all of them.",
        scene.triangle_count()
    )
}

fn method(method: Method) -> String {
    match method {
        Method::Hybrid => {
            "Direct light is evaluated at every receiver, indirect light gathered over the map itself in \
             sweeps, and light that reaches a surface only by way of mirrors or glass carried by \
             particles: the cheapest way to an accurate map. Each increment repeats all of it \
             independently, so that their spread is the error."
        }
        Method::Cache => {
            "Direct light is evaluated at every receiver, indirect light sampled where it varies and carried \
             over to the receivers around by its gradients (an irradiance cache). Rays from samples \
             read coarser samples of all further reflections. Each increment repeats all of it \
             independently at the same places, so that their spread is the error."
        }
        Method::Forward => {
            "Particles leave the luminaires in proportion to their flux and are counted where they \
             land: a complete picture in the first second, and slow to converge after it."
        }
        Method::Radiosity => {
            "Direct light is evaluated at every receiver. Then the patch with most light still to send \
             shoots it to all receivers, over form factors in closed form whose visibility is tested \
             by rays, until little is left; light by planar mirrors comes from their images, by gloss \
             and glass along rays. Light gathered afresh at test points gives the error."
        }
    }
    .to_owned()
}

/// What the accuracy, or its quality, sets for radiosity, and why.
fn limits(request: &SolveRequest) -> Vec<String> {
    let accuracy = request.accuracy.unwrap_or(0.01);
    let by = |flag: &str, is_set: bool| {
        if is_set { format!("set by {flag}") } else { format!("{flag} sets it by hand") }
    };
    let set = &request.radiosity;
    let limits = set.limits(accuracy);
    let subdivision = match (set.max_receivers, set.min_element_m) {
        (None, None) => {
            "Elements for indirect light are bisected by its gradient and at borders of \
                         shadows, down to a thousandth of the scene, up to 40,000 receivers; \
                         --min-element and --max-receivers set these limits by hand."
                .to_owned()
        }
        (most, least) => format!(
            "Elements for indirect light are bisected by its gradient and at borders of shadows, down \
             to {}, up to {} receivers.",
            least.map_or("a thousandth of the scene".to_owned(), |m| format!("{m} m")),
            most.unwrap_or(40_000)
        ),
    };
    let tolerance = show_share(limits.form_factor_tolerance);
    let links = show_share(limits.largest_link);
    let visibility = show_share(limits.visibility_tolerance);
    vec![
        subdivision,
        format!(
            "Form factors: a source is divided for a receiver until its light is linear to {tolerance} \
             of the scene's light, so that even errors of one sign stay below the accuracy; {}.",
            by("--form-factor-tolerance", set.form_factor_tolerance.is_some())
        ),
        format!(
            "Visibility: two rays a source, which brings {links} of the light at most; where they \
             disagree about more than {visibility}, it is divided.",
        ),
        format!(
            "Shooting stops as soon as the map has its accuracy, at the latest at {} unshot, whose reflections \
             are a small part of that; {}.",
            show_share(limits.unshot),
            by("--unshot", set.unshot.is_some())
        ),
        format!(
            "Test points gather {} rays each, eight times, over the finished map: what they find \
             different is the error that the run stops at.",
            limits.check_rays
        ),
    ]
}

fn stop(request: &SolveRequest) -> String {
    let limit = request.time_limit.map(|t| show_seconds(t.as_secs_f64()));
    match (request.accuracy, limit) {
        (Some(accuracy), Some(limit)) => {
            format!("It stops at an error of {} or after {limit}.", show_share(accuracy))
        }
        (Some(accuracy), None) => format!("It stops at an error of {}.", show_share(accuracy)),
        (None, Some(limit)) => format!("It stops after {limit}."),
        (None, None) => "It runs until it is interrupted.".to_owned(),
    }
}
