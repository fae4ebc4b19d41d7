//! Lights on nodes, of both extensions.

use super::buffers::Document;
use super::ies_profile::{self, Instance, Profile};
use super::nodes::Placed;
use super::notes::{Flaw, Notes};
use super::punctual;
use isolux::scene::Luminaire;
use std::collections::HashMap;

/// The luminaires of the scene, in the order of their nodes.
pub(super) fn luminaires(
    document: &Document,
    placed: &[Placed],
    notes: &mut Notes,
) -> Vec<Luminaire> {
    let mut profiles = HashMap::new();
    let mut luminaires = Vec::new();
    for instance in placed {
        let place = format!("nodes[{}].extensions", instance.node);
        for made in [
            punctual_luminaire(document, instance, notes),
            ies_luminaire(document, instance, &mut profiles, notes),
        ] {
            luminaires.extend(notes.accept(made.map_err(|flaw| flaw.rooted(&place))).flatten());
        }
    }
    luminaires
}

fn punctual_luminaire(
    document: &Document,
    instance: &Placed,
    notes: &mut Notes,
) -> Result<Option<Luminaire>, Flaw> {
    let node = &document.root.nodes[instance.node];
    let extension = node.extensions.as_ref().and_then(|e| e.khr_lights_punctual.as_ref());
    let Some(index) = extension.map(|e| e.light.value()) else { return Ok(None) };
    let light = punctual::get(document, index).map_err(|f| f.at("KHR_lights_punctual.light"))?;
    let place = format!("extensions.KHR_lights_punctual.lights[{index}]");
    let (colour, kind) = punctual::resolve(light, &place, &instance.world_from_node, notes)
        .map_err(|flaw| flaw.rooted(place))?;
    let name = name(document, instance.node, light.name.as_deref());
    Ok(Some(Luminaire { name, group: 0, colour, kind }))
}

type Profiles = HashMap<usize, Result<Profile, Flaw>>;

fn ies_luminaire(
    document: &Document,
    instance: &Placed,
    profiles: &mut Profiles,
    notes: &mut Notes,
) -> Result<Option<Luminaire>, Flaw> {
    let node = &document.root.nodes[instance.node];
    let extension = node.extensions.as_ref().and_then(|e| e.others.get(ies_profile::NAME));
    let Some(extension) = extension else { return Ok(None) };
    let ies = Instance::read(extension).map_err(|flaw| flaw.at(ies_profile::NAME))?;
    let profile = profiles
        .entry(ies.profile)
        .or_insert_with(|| ies_profile::profile(document, ies.profile, notes))
        .as_ref()
        .map_err(|flaw| flaw.clone().at(format!("{}.light", ies_profile::NAME)))?;
    let (colour, factor) = punctual::photometric(ies.colour, ies.multiplier)?;
    let intensity = profile.intensity.scaled(factor);
    let kind = punctual::point(&instance.world_from_node, intensity, profile.area);
    let name = name(document, instance.node, None);
    Ok(Some(Luminaire { name, group: 0, colour, kind }))
}

/// After its node, else its light.
fn name(document: &Document, node: usize, light: Option<&str>) -> String {
    let own = document.root.nodes[node].name.as_deref();
    own.or(light).map_or_else(|| format!("node {node}"), str::to_owned)
}
