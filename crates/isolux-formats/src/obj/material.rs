//! MTL records into materials.

use super::lines::place;
use super::reading::Reading;
use super::record::{MtlMaterial, Named, ObjFile};
use super::{libraries, meaning, mtl};
use crate::findings::Findings;
use crate::other_case::Listings;
use crate::picture::Room;
use crate::reach::{Root, directory_of};
use crate::{Loaded, Problem, Problems, source};
use isolux::scene::{Body, Dielectric, Finish, Material, Texture};
use isolux::units::Rgb;
use isolux::units::short;
use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

/// Bytes of all libraries of a file.
const MOST_BYTES: u64 = 64 << 20;
/// What a surface reflects of which nothing is known.
pub(super) const UNKNOWN_REFLECTANCE: f64 = 0.5;
/// The material of faces without one.
const UNNAMED: &str = "unnamed";
/// Window glass.
const USUAL_INDEX: f64 = 1.5;

/// The materials that faces of the file use, in the order of its parts.
#[derive(Default)]
pub(super) struct Materials {
    pub(super) list: Vec<Material>,
    pub(super) textures: Vec<Texture>,
    /// Index of the material of every part.
    pub(super) of_part: Vec<u32>,
    /// Those of which nothing is known.
    pub(super) unknown: HashSet<u32>,
}

/// Reads the material libraries of a file and makes materials of those it uses and nothing replaces.
pub(super) fn read_libraries(
    file: &ObjFile,
    reading: &Reading,
    findings: &mut Findings,
) -> Materials {
    let root = &Root::of(findings.file(), reading.reach);
    let mut known: HashMap<String, (PathBuf, MtlMaterial)> = HashMap::new();
    let mut listings = Listings::default();
    let mut bytes_left = MOST_BYTES;
    for path in libraries::paths((root, &mut listings), file, findings) {
        let read = library(&path, reading.materials, &mut bytes_left);
        for material in findings.absorb(read).unwrap_or_default() {
            known.insert(material.name.clone(), (path.clone(), material));
        }
    }
    let mut maker = Maker {
        glossy: None,
        root,
        reading,
        known,
        made: HashMap::new(),
        pictures: HashMap::new(),
        room: Room::default(),
        listings,
        materials: Materials::default(),
    };
    for part in &file.parts {
        let index = maker.material(part.material.as_ref(), findings);
        maker.materials.of_part.push(index);
    }
    if let Some(glossy) = maker.glossy.take() {
        findings.absorb::<()>(Ok(Loaded { value: (), warnings: vec![glossy.warning()] }));
    }
    maker.materials
}

struct Maker<'a> {
    root: &'a Root,
    reading: &'a Reading<'a>,
    known: HashMap<String, (PathBuf, MtlMaterial)>,
    made: HashMap<Option<String>, u32>,
    pictures: HashMap<PathBuf, Option<u32>>,
    room: Room,
    listings: Listings,
    materials: Materials,
    glossy: Option<Glossy>,
}

/// The materials of a library.
fn library(
    path: &Path,
    materials: meaning::Materials,
    bytes_left: &mut u64,
) -> Result<Loaded<Vec<MtlMaterial>>, Problems> {
    let text = source::read_text(path, *bytes_left)?;
    *bytes_left = bytes_left.saturating_sub(text.len() as u64);
    let mut findings = Findings::new(path);
    let mut list = mtl::parse(&text, &mut findings);
    if materials == meaning::Materials::AsMeant {
        meaning::mend(&mut list, &mut findings);
    }
    findings.finish(list)
}

/// Materials whose gloss is left out.
struct Glossy {
    file: PathBuf,
    line: usize,
    first: String,
    more: usize,
}

impl Glossy {
    fn warning(self) -> Problem {
        let more = if self.more > 0 { format!(" (and {} more)", self.more) } else { String::new() };
        let what = format!(
            "material `{}`{more}: its gloss Ks, Ns is left out, because MTL does not say how much \
             light it reflects",
            self.first
        );
        let remedy = "assign a material of scene.toml with `gloss`, or set illum 3 for a mirror";
        Problem::new(&self.file, place(self.line), what, remedy)
    }
}

/// Whether a material has highlights and is no mirror.
fn is_glossy(record: &MtlMaterial) -> bool {
    !matches!(record.illum, Some(3 | 5)) && record.ks.is_some_and(|ks| !ks.is_black())
}

impl Maker<'_> {
    fn material(&mut self, named: Option<&Named>, findings: &mut Findings) -> u32 {
        let key = named.map(|n| n.name.clone());
        if let Some(&index) = self.made.get(&key) {
            return index;
        }
        let name = key.as_deref().unwrap_or(UNNAMED);
        if (self.reading.is_replaced)(name) {
            let index = self.push(Material::two_sided(name, Finish::BLACK));
            self.made.insert(key, index);
            return index;
        }
        let known = key.as_ref().and_then(|name| self.known.remove(name));
        let is_unknown = known.is_none();
        let material = match known {
            Some((file, record)) => {
                let mut own = Findings::new(&file);
                let material = self.make(&record, &mut own);
                findings.absorb(own.finish(material)).unwrap_or_else(|| unknown(key.as_deref()))
            }
            None => {
                // Colours of vertices tell what such faces reflect.
                if !self.reading.vertex_colours {
                    warn_of_unknown(named, findings);
                }
                unknown(key.as_deref())
            }
        };
        let index = self.push(material);
        self.made.insert(key, index);
        if is_unknown {
            self.materials.unknown.insert(index);
        }
        index
    }

    fn push(&mut self, material: Material) -> u32 {
        self.materials.list.push(material);
        self.materials.list.len() as u32 - 1
    }

    fn make(&mut self, record: &MtlMaterial, findings: &mut Findings) -> Material {
        match dielectric(record, self.reading.materials, findings) {
            Some(glass) => Material { name: record.name.clone(), body: Body::Dielectric(glass) },
            None => {
                if is_glossy(record) {
                    self.note_gloss(record, findings.file());
                }
                let base = directory_of(findings.file()).to_owned();
                let texture =
                    record.map_kd.as_ref().and_then(|named| self.picture(&base, named, findings));
                let mut finish = finish(record, texture.is_some(), findings);
                finish.diffuse.texture = texture;
                Material::two_sided(record.name.clone(), finish)
            }
        }
    }

    fn note_gloss(&mut self, record: &MtlMaterial, file: &Path) {
        match &mut self.glossy {
            Some(known) => known.more += 1,
            None => {
                let (file, first) = (file.to_owned(), record.name.clone());
                self.glossy = Some(Glossy { file, line: record.line, first, more: 0 });
            }
        }
    }

    fn picture(&mut self, base: &Path, named: &Named, findings: &mut Findings) -> Option<u32> {
        let without = "; the material keeps its Kd alone";
        let path = match self.root.file_beside(base, &named.name) {
            Ok(path) => path,
            Err(why) => match self.listings.find(self.root, base, &named.name) {
                Some(path) => {
                    libraries::warn_of_case(named, &path, findings);
                    path
                }
                None => {
                    let (what, remedy) = why.explain(&named.name);
                    findings.warning(place(named.line), what + without, remedy);
                    return None;
                }
            },
        };
        if let Some(&known) = self.pictures.get(&path) {
            return known;
        }
        let index = match self.room.read(&path) {
            Ok(texture) => {
                self.materials.textures.push(texture);
                Some(self.materials.textures.len() as u32 - 1)
            }
            Err(problem) => {
                let what = format!("`{}` {}{without}", named.name, problem.what);
                findings.warning(place(named.line), what, problem.remedy);
                None
            }
        };
        self.pictures.insert(path, index);
        index
    }
}

fn warn_of_unknown(named: Option<&Named>, findings: &mut Findings) {
    let (at, what) = match named {
        Some(n) => (place(n.line), format!("material `{}` is not known", n.name)),
        None => (String::new(), "some faces have no material".to_owned()),
    };
    let what = format!("{what}: taken as grey {UNKNOWN_REFLECTANCE}");
    findings.warning(at, what, "define it in the file that `mtllib` names");
}

fn unknown(name: Option<&str>) -> Material {
    let finish = Finish::diffuse(Rgb::grey(UNKNOWN_REFLECTANCE));
    Material::two_sided(name.unwrap_or(UNNAMED), finish)
}

fn dielectric(
    record: &MtlMaterial,
    materials: meaning::Materials,
    findings: &mut Findings,
) -> Option<Dielectric> {
    let dissolve = record.dissolve();
    let thin = match record.illum {
        Some(6 | 7) => false,
        Some(4 | 9) => true,
        _ if dissolve < 1.0 => true,
        _ => return None,
    };
    let through = if dissolve < 1.0 { Rgb::grey(1.0 - dissolve) } else { Rgb::WHITE };
    let transmittance = record.tf.unwrap_or(through).map(|t| t.min(1.0));
    let least = if materials == meaning::Materials::AsWritten { 0.0 } else { 1.0 };
    let (ior, instead) = match record.ni {
        Some(ni) if ni > least => (ni, String::new()),
        Some(ni) => {
            (USUAL_INDEX, format!(" (instead of Ni {}, which would not refract)", short(ni, 4)))
        }
        None => (USUAL_INDEX, String::new()),
    };
    let kind = if thin { "a thin pane" } else { "solid glass" };
    let through = shares(transmittance);
    findings.warning(
        place(record.line),
        format!(
            "material `{}` is read as {kind} of index {}{instead}, transmitting {through}",
            record.name,
            short(ior, 4)
        ),
        "assign a material of scene.toml where this is not meant",
    );
    Some(Dielectric { ior, transmittance, thin })
}

/// Three channels in a message.
fn shares(colour: Rgb) -> String {
    colour.0.map(|channel| short(channel, 4)).join(" ")
}

/// Without its picture, which alone tells what is reflected where there is no Kd beside it.
fn finish(record: &MtlMaterial, is_textured: bool, findings: &mut Findings) -> Finish {
    let mut say = |what: String, remedy: &str| {
        findings.warning(place(record.line), format!("material `{}`: {what}", record.name), remedy);
    };
    let written = record.kd.unwrap_or_else(|| match is_textured {
        true => Rgb::WHITE,
        false => {
            say(format!("no Kd: taken as {UNKNOWN_REFLECTANCE}"), "write its diffuse reflectance");
            Rgb::grey(UNKNOWN_REFLECTANCE)
        }
    });
    let diffuse = written.map(|c| c.min(1.0));
    if diffuse != written {
        say(format!("Kd {} is cut at 1", shares(written)), "write Kd as a share of the light");
    }
    let mut finish = Finish::diffuse(diffuse);
    let ks = record.ks.unwrap_or(Rgb::BLACK);
    if matches!(record.illum, Some(3 | 5)) {
        let room = Rgb::WHITE - diffuse;
        finish.mirror = Rgb(std::array::from_fn(|k| ks.0[k].min(room.0[k])));
        if finish.mirror != ks {
            say(
                format!("mirror Ks {} is cut so that Kd + Ks is at most 1", shares(ks)),
                "lower Ks or Kd",
            );
        }
        say(
            format!("read as a mirror that reflects {}, beside its Kd", shares(finish.mirror)),
            "assign a material of scene.toml where this is not meant",
        );
    }
    finish.luminance_cd_m2 = record.ke.unwrap_or(Rgb::BLACK);
    if finish.is_emitter() {
        say(
            "Ke is read as luminance in cd/m2, emitted from both sides".into(),
            "assign a material of scene.toml with `luminance_cd_m2` where this is not meant",
        );
    }
    finish
}
