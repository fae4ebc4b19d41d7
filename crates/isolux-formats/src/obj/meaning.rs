//! What the writer of an MTL file means, by the weight of what is in it, where the letter says something that nobody models:
//! surfaces that cannot be seen, and have a colour.
//!
//! The letter is that of Wavefront's "MTL material format" (1995): `d` is opacity, `Tr` its complement, `Tf` what passes, and
//! `illum` 4, 6, 7 and 9 let light through. Maya writes `illum 4`, `Tf 1 1 1`, `Ni 1` for materials that are opaque, so that
//! there `Tf` is one minus what passes; MeshLab and OpenMVS wrote `Tr 1` for them (vcglib issue 213, meshlab 1399, openMVS 1285).

use super::lines::place;
use super::record::MtlMaterial;
use crate::counted;
use crate::findings::Findings;
use isolux::units::Rgb;

/// Whether materials of other programs are read as their writers mean them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Materials {
    /// Where the letter makes coloured surfaces invisible and most of a file agrees, they are opaque.
    #[default]
    AsMeant,
    /// By the letter of the format.
    AsWritten,
}

/// Changes the materials of a library to what its writer means.
pub(super) fn mend(list: &mut [MtlMaterial], findings: &mut Findings) {
    mend_opacity(list, findings);
    mend_dissolve(list, findings);
    mend_filters(list, findings);
    mend_all_transparent(list, findings);
}

/// Whether it has a colour, which would be of no account if it could not be seen.
fn is_coloured(material: &MtlMaterial) -> bool {
    material.map_kd.is_some() || material.kd.is_some_and(|kd| !kd.is_black())
}

/// `Tr` is opacity where more coloured materials have 1 than 0.
fn mend_opacity(list: &mut [MtlMaterial], findings: &mut Findings) {
    let is_told = |m: &MtlMaterial| m.d.is_none() && is_coloured(m);
    let with = |tr: f64| list.iter().filter(|m| is_told(m) && m.tr == Some(tr)).count();
    if with(1.0) <= with(0.0) {
        return;
    }
    let what = "`Tr 1` would make them invisible: `Tr` is read as opacity";
    tell(list, |m| m.d.is_none() && m.tr == Some(1.0), what, findings);
    for material in list.iter_mut().filter(|m| m.d.is_none()) {
        material.d = material.tr;
    }
}

/// `d 0` of most materials says nothing.
fn mend_dissolve(list: &mut [MtlMaterial], findings: &mut Findings) {
    let is_invisible = |m: &MtlMaterial| m.d == Some(0.0) && is_coloured(m);
    let count = list.iter().filter(|m| is_invisible(m)).count();
    if count == 0 || 2 * count <= list.len() {
        return;
    }
    tell(list, is_invisible, "`d 0` would make them invisible: they are read as opaque", findings);
    list.iter_mut().filter(|m| is_invisible(m)).for_each(|m| m.d = None);
}

/// Whether all light passes it unbent by its `illum`.
fn is_invisible_by_filter(material: &MtlMaterial) -> bool {
    let passes_all = material.tf.is_none_or(|tf| tf.min_channel() >= 1.0);
    material.is_transmitting()
        && passes_all
        && material.dissolve() == 1.0
        && material.ni.is_some_and(|ni| ni <= 1.0)
        && is_coloured(material)
}

/// `Tf` is one minus what passes where it would make most transmitting materials invisible.
fn mend_filters(list: &mut [MtlMaterial], findings: &mut Findings) {
    let transmitting = list.iter().filter(|m| m.is_transmitting()).count();
    let count = list.iter().filter(|m| is_invisible_by_filter(m)).count();
    if count == 0 || 2 * count < transmitting {
        return;
    }
    let what = "`illum` 4, 6, 7 or 9 with `Ni 1` and all light passing would make them invisible: they \
                are read as opaque, and `Tf` as one minus what passes";
    tell(list, is_invisible_by_filter, what, findings);
    for material in list.iter_mut().filter(|m| m.is_transmitting()) {
        let is_opaque = is_invisible_by_filter(material);
        if is_opaque {
            material.illum = None;
        } else if material.ni.is_none_or(|ni| ni <= 1.0) {
            material.tf = material.tf.map(|tf| tf.map(|c| (1.0 - c).max(0.0)));
        }
    }
}

/// Nobody models a scene that is glass for the most part: where `illum` alone says so of most of several, without an index
/// of refraction, or of all, it says nothing.
fn mend_all_transparent(list: &mut [MtlMaterial], findings: &mut Findings) {
    let by_model_alone = |m: &MtlMaterial| {
        let passes_all = m.tf.is_none_or(|tf| tf == Rgb::WHITE);
        m.is_transmitting() && m.dissolve() == 1.0 && passes_all && is_coloured(m)
    };
    let without_index = |m: &MtlMaterial| by_model_alone(m) && m.ni.is_none_or(|ni| ni <= 1.0);
    let are_most = 2 * list.iter().filter(|m| without_index(m)).count() > list.len();
    if list.len() < 3 || !(are_most || list.iter().all(by_model_alone)) {
        return;
    }
    let is_meant = |m: &MtlMaterial| if are_most { without_index(m) } else { by_model_alone(m) };
    let what = "most materials would be glass by `illum` alone: they are read as opaque";
    tell(list, is_meant, what, findings);
    list.iter_mut().filter(|m| is_meant(m)).for_each(|m| m.illum = None);
}

/// One warning of all materials of a kind, at the first.
fn tell(
    list: &[MtlMaterial],
    is_one: impl Fn(&MtlMaterial) -> bool,
    what: &str,
    findings: &mut Findings,
) {
    let mut found = list.iter().filter(|m| is_one(m));
    let Some(first) = found.next() else { return };
    let more = match found.count() {
        0 => String::new(),
        count => format!(" and {}", counted(count, "other", "others")),
    };
    let what = format!("material `{}`{more}: {what}", first.name);
    let remedy = "nothing needs to be done if they are; `--materials as-written` keeps the letter";
    findings.warning(place(first.line), what, remedy);
}
