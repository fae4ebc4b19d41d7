//! The walk through the files of a scene, in the order in which Radiance reads them.

use super::build::{Builder, placed};
use super::command::{self, Command, IesCommand, Source};
use super::frame::Frame;
use super::limits;
use super::look::{Look, look};
use super::luminaires;
use super::material::Made;
use super::modifiers::{Modifiers, Named};
use super::named_files::named_file;
use super::parse::parse;
use super::record::{Item, Kind, Object, kind_of};
use super::skies::{Skies, Wide};
use super::sky_function::SkyFunction;
use super::tables::Tables;
use super::tessellate::tessellate;
use crate::Reach;
use crate::efficacy::EFFICACY_LM_W;
use crate::lines::{At, Notes};
use crate::reach::{Root, Unreachable, directory_of};
use crate::source;
use isolux::geometry::{Direction, Point};
use isolux::photometry::IntensityDistribution;
use isolux::scene::{Body, Finish, SceneParts};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// The scene so far, and the files that were read for it.
pub(super) struct Reader<'a> {
    /// The folders of the files that make up the scene, each once.
    roots: Vec<Root>,
    is_replaced: &'a dyn Fn(&str) -> bool,
    notes: Notes,
    files: HashMap<PathBuf, Rc<[Item]>>,
    photometry: HashMap<PathBuf, Option<IntensityDistribution>>,
    /// Files that are open, the outermost first.
    open: Vec<PathBuf>,
    bytes_left: u64,
    visits_left: usize,
    modifiers: Modifiers,
    looks: HashMap<usize, Option<Rc<Look>>>,
    tables: Tables,
    skies: Skies,
    builder: Builder,
    first_light: Option<At>,
}

/// Whether to go on.
type Going = Option<()>;

impl<'a> Reader<'a> {
    pub(super) fn new(path: &Path, is_replaced: &'a dyn Fn(&str) -> bool) -> Self {
        Self {
            roots: Vec::new(),
            is_replaced,
            notes: Notes::new(path),
            files: HashMap::new(),
            photometry: HashMap::new(),
            open: Vec::new(),
            bytes_left: limits::BYTES,
            visits_left: limits::VISITS,
            modifiers: Modifiers::default(),
            looks: HashMap::new(),
            tables: Tables::default(),
            skies: Skies::default(),
            builder: Builder::default(),
            first_light: None,
        }
    }

    /// Reads files one after the other, and all they name; the scene has the name of the first.
    pub(super) fn read(mut self, paths: &[&Path], reach: Reach) -> (SceneParts, Notes) {
        for path in paths {
            let root = Root::of(path, reach);
            if self.roots.iter().all(|known| known.folder() != root.folder()) {
                self.roots.push(root);
            }
        }
        for path in paths {
            let at = At { file: (*path).into(), line: 1 };
            if self.file(path, &Frame::world(), &at).is_none() {
                break;
            }
        }
        self.tables.finish(&self.modifiers, &self.roots, &mut self.builder, &mut self.notes);
        self.builder.luminaires.extend(self.skies.luminaire());
        if let Some(at) = &self.first_light {
            let what = format!(
                "radiances are read as luminances of {EFFICACY_LM_W} lm/W: 179 (0.265 red + 0.670 green + \
                 0.065 blue) cd/m2"
            );
            self.notes.warning(
                at,
                what,
                "nothing needs to be done if they came from ies2rad or \
                                          were divided by 179",
            );
        }
        let stem = paths.first().and_then(|path| path.file_stem());
        let name = stem.map_or_else(String::new, |s| s.to_string_lossy().into());
        (self.builder.into_parts(name), self.notes)
    }

    /// The statements of a file in a frame.
    fn file(&mut self, path: &Path, frame: &Frame, at: &At) -> Going {
        if self.open.iter().any(|open| open == path) || self.open.len() >= limits::DEPTH {
            let what = format!("`{}` is read inside itself", path.display());
            let deep = format!("files are nested more than {} deep", limits::DEPTH);
            let what = if self.open.len() >= limits::DEPTH { deep } else { what };
            self.notes.problem(at, what, "a file cannot hold itself; name another");
            return Some(());
        }
        let items = match self.files.get(path) {
            Some(items) => items.clone(),
            None => self.open_file(path, at)?,
        };
        let file: Rc<Path> = path.into();
        self.open.push(path.to_owned());
        let going = items.iter().try_for_each(|item| self.item(item, &file, frame));
        self.open.pop();
        going
    }

    fn open_file(&mut self, path: &Path, at: &At) -> Option<Rc<[Item]>> {
        let items = match source::read_text(path, self.bytes_left) {
            Ok(text) => {
                self.bytes_left -= text.len().min(self.bytes_left as usize) as u64;
                let file: Rc<Path> = path.into();
                parse(&text, &file, &mut self.notes)
            }
            Err(problem) if self.open.is_empty() => {
                self.notes.findings().absorb::<()>(Err(problem.into()));
                Vec::new()
            }
            Err(problem) => {
                let what = format!("`{}` {}", path.display(), problem.what);
                self.notes.problem(at, what, problem.remedy);
                Vec::new()
            }
        };
        let items: Rc<[Item]> = items.into();
        self.files.insert(path.to_owned(), items.clone());
        Some(items)
    }

    fn item(&mut self, item: &Item, file: &Rc<Path>, frame: &Frame) -> Going {
        match item {
            Item::Object(object) => {
                self.object(object, At { file: file.clone(), line: object.line }, frame)
            }
            Item::Command { line, text } => {
                self.command(text, At { file: file.clone(), line: *line }, frame)
            }
        }
    }

    /// Counts what is read, and stops at the limit.
    fn visit(&mut self, at: &At) -> Going {
        if self.visits_left == 0 {
            let what =
                format!("more than {} statements, repeated ones counted each time", limits::VISITS);
            self.notes.problem(at, what, "lower the counts of the arrays");
            return None;
        }
        self.visits_left -= 1;
        Some(())
    }

    fn full(&mut self, at: &At, what: String) -> Going {
        self.notes.problem(at, what, "lower the counts of the arrays, or the detail");
        None
    }

    fn command(&mut self, text: &str, at: At, frame: &Frame) -> Going {
        self.visit(&at)?;
        let mut lookup = |name: &str| self.arguments(name, &at);
        match command::parse(text, at.line, &mut lookup) {
            Ok(commands) => commands.into_iter().try_for_each(|c| self.obey(c, &at, frame)),
            Err((what, remedy)) => {
                self.notes.problem(&at, what, remedy);
                Some(())
            }
        }
    }

    /// The text of a file of arguments.
    fn arguments(&mut self, name: &str, at: &At) -> Result<String, String> {
        let path = self.path_of(name, &at.file).map_err(|why| why.explain(name).0)?;
        let text = source::read_text(&path, self.bytes_left)
            .map_err(|problem| format!("`{name}` {}", problem.what))?;
        self.bytes_left = self.bytes_left.saturating_sub(text.len() as u64);
        Ok(text)
    }

    fn obey(&mut self, command: Command, at: &At, frame: &Frame) -> Going {
        self.visit(at)?;
        let Command { source, stages } = command;
        let frames = match frame.within(&stages) {
            Ok(frames) => frames,
            Err(what) => return self.full(at, what),
        };
        let paths = match &source {
            Source::Files(names) => self.paths_of(names, at),
            Source::Ies(command) => self.paths_of(std::slice::from_ref(&command.file), at),
            Source::Objects(_) => Some(Vec::new()),
        };
        let Some(paths) = paths else { return Some(()) };
        for frame in &frames {
            self.visit(at)?;
            match &source {
                Source::Files(_) => {
                    paths.iter().try_for_each(|path| self.file(path, frame, at))?;
                }
                Source::Objects(objects) => {
                    objects.iter().try_for_each(|object| self.object(object, at.clone(), frame))?;
                }
                Source::Ies(command) => self.ies(command, &paths[0], at, frame)?,
            }
        }
        Some(())
    }

    /// The paths of files that a command names; `None` after a problem.
    fn paths_of(&mut self, names: &[String], at: &At) -> Option<Vec<PathBuf>> {
        let mut paths = Vec::new();
        for name in names {
            match self.path_of(name, &at.file) {
                Ok(path) => paths.push(path),
                Err(why) => {
                    let (what, remedy) = why.explain(name);
                    self.notes.problem(at, what, remedy);
                }
            }
        }
        (paths.len() == names.len()).then_some(paths)
    }

    /// A file named in another, relative to it or to the scene.
    fn path_of(&self, name: &str, file: &Path) -> Result<PathBuf, Unreachable> {
        named_file(&self.roots, directory_of(file), name)
    }

    fn ies(&mut self, command: &IesCommand, path: &Path, at: &At, frame: &Frame) -> Going {
        if !self.photometry.contains_key(path) {
            let read = luminaires::read_ies(path);
            if read.is_err() {
                let what =
                    format!("`{}` cannot be used, for the reason that follows", command.file);
                self.notes.problem(at, what, "mend it, or name another file");
            }
            let read = self.notes.findings().absorb(read);
            self.photometry.insert(path.to_owned(), read);
        }
        if command.looks_up_lamp {
            let what =
                "the light of `!ies2rad` is white and undiminished: no table of lamps is read";
            self.notes.warning(at, what, "give -c and -m, or -t default to say that this is meant");
        }
        let Some(Some(intensity)) = self.photometry.get(path) else { return Some(()) };
        let stem = path.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into());
        let position = frame.world_from_file.point(Point::ORIGIN);
        let intensity = intensity.scaled(command.factor);
        let map = &frame.world_from_file;
        let made = luminaires::point(frame.name(&stem), command.colour, position, intensity, map);
        self.add_luminaire(made, at)
    }

    fn add_luminaire(&mut self, made: Option<isolux::scene::Luminaire>, at: &At) -> Going {
        let Some(luminaire) = made else { return Some(()) };
        if self.builder.luminaire(luminaire) {
            return Some(());
        }
        self.full(at, format!("more than {} luminaires", limits::LUMINAIRES))
    }

    fn object(&mut self, object: &Object, at: At, frame: &Frame) -> Going {
        self.visit(&at)?;
        if kind_of(&object.type_) == Some(Kind::Surface) {
            return self.surface(object, &at, frame);
        }
        let named = match kind_of(&object.type_) {
            Some(Kind::Alias) => 1,
            Some(Kind::Mixture) => 2,
            _ => 0,
        };
        for name in std::iter::once(&object.modifier).chain(object.strings.iter().take(named)) {
            if self.modifiers.find(name) == Named::Unknown {
                self.unknown(name, &at);
            }
        }
        if self.modifiers.define(object, at.clone(), &frame.world_from_file) {
            return Some(());
        }
        self.full(&at, format!("more than {} modifiers", limits::MODIFIERS))
    }

    fn unknown(&mut self, name: &str, at: &At) {
        let shown: String = name.chars().take(60).collect();
        let what = format!("modifier `{shown}` is not defined before it is used");
        let remedy = "name the file that defines it before, by `!xform FILE`, or assign a material \
                      in a scene.toml";
        self.notes.problem(at, what, remedy);
    }

    /// What a surface is made of; `None` if it is left out, with a reason told.
    fn look_of(&mut self, name: &str, at: &At) -> Option<Rc<Look>> {
        if (self.is_replaced)(name) {
            let made = Made::Body(Body::Opaque { front: Finish::BLACK, back: Finish::BLACK });
            return Some(Rc::new(Look { name: name.to_owned(), made, table: None, sky: None }));
        }
        match self.modifiers.find(name) {
            Named::Nothing => {
                let what = "surfaces of `void` are left out, as they cannot be seen";
                self.notes.warning(at, what, "remove them");
                None
            }
            Named::Unknown => {
                self.unknown(name, at);
                None
            }
            Named::Known(index) => {
                let (modifiers, notes) = (&self.modifiers, &mut self.notes);
                let made = self.looks.entry(index);
                made.or_insert_with(|| look(index, modifiers, notes).map(Rc::new)).clone()
            }
        }
    }

    fn surface(&mut self, object: &Object, at: &At, frame: &Frame) -> Going {
        let label = format!("{} `{}`", object.type_, frame.name(&object.name));
        if matches!(object.type_.as_str(), "mesh" | "instance") {
            return self.refuse_compiled(object, &label, at);
        }
        let modifier = frame.modifier.as_deref().unwrap_or(&object.modifier);
        let Some(look) = self.look_of(modifier, at) else { return Some(()) };
        if look.is_emitter() {
            self.first_light.get_or_insert_with(|| at.clone());
        }
        if object.type_ == "source" {
            return self.distant(object, &label, &look, at, frame);
        }
        if look.sky.is_some() {
            let what = format!("{label}: `{}` varies as a sky does, and is no source", look.name);
            self.notes.problem(at, what, "use it for a `source`");
            return Some(());
        }
        let made = match tessellate(object, look.is_emitter()) {
            Ok(made) => made,
            Err(what) => {
                let remedy = "give the arguments that the Radiance manual lists for it";
                self.notes.problem(at, format!("{label}: {what}"), remedy);
                return Some(());
            }
        };
        if let Some((what, remedy)) = made.oddity {
            self.notes.warning(at, format!("{label}: {what}"), remedy);
        }
        if made.shape.triangles.is_empty() {
            return Some(());
        }
        let shape = placed(made.shape, frame);
        let name = frame.name(&object.name);
        if let Some(table) = look.table {
            self.tables.add(table, name, &look, &shape);
            return Some(());
        }
        match &look.made {
            Made::Invisible => {
                let what = format!("{label} is left out, as its modifier has no material");
                self.notes.warning(at, what, "remove it");
                Some(())
            }
            Made::Spot(spot) => {
                let is_ball = matches!(object.type_.as_str(), "sphere" | "bubble");
                self.spot(luminaires::spot(name, spot, &shape, is_ball), &label, at)
            }
            Made::Body(body) => {
                let material = self.builder.material(&look.name, body);
                if self.builder.surface(name, material, shape) {
                    return Some(());
                }
                self.full(at, format!("more than {} triangles", limits::TRIANGLES))
            }
        }
    }

    fn refuse_compiled(&mut self, object: &Object, label: &str, at: &At) -> Going {
        let remedy = "name the .rad or .obj file it was compiled from: the first by `!xform FILE`, the \
                      other in a scene.toml";
        let file = object.strings.first().map_or("", String::as_str);
        let what = format!("{label}: compiled geometry, `{file}`, is not read");
        self.notes.problem(at, what, remedy);
        Some(())
    }

    fn spot(
        &mut self,
        made: Result<isolux::scene::Luminaire, String>,
        label: &str,
        at: &At,
    ) -> Going {
        match made {
            Ok(luminaire) => {
                let what = format!(
                    "{label}: the spotlight is a point in the middle of its surface, with the flux of \
                     its cone; the surface itself is left out"
                );
                self.notes.warning(at, what, "nothing needs to be done where it is small");
                self.add_luminaire(Some(luminaire), at)
            }
            Err(what) => {
                let remedy = "aim a flat surface or a sphere";
                self.notes.problem(at, format!("{label}: {what}"), remedy);
                Some(())
            }
        }
    }

    fn distant(
        &mut self,
        object: &Object,
        label: &str,
        look: &Look,
        at: &At,
        frame: &Frame,
    ) -> Going {
        if look.table.is_some() || matches!(look.made, Made::Spot(_)) {
            let what = format!("{label}: distant sources with patterns or cones are not read");
            self.notes.problem(at, what, "use a light without pattern");
            return Some(());
        }
        match luminaires::cone(&object.numbers, &frame.world_from_file) {
            // What is dark lights nothing, however large it is.
            _ if !look.is_emitter() => Some(()),
            Ok(cone) => self.cone(cone, (frame.name(&object.name), label), look, at),
            Err((what, remedy)) => {
                self.notes.problem(at, format!("{label}: {what}"), remedy);
                Some(())
            }
        }
    }

    /// A source that shines: a disc, or a part of the sky.
    fn cone(
        &mut self,
        (towards, angle_deg): (Direction, f64),
        (name, label): (String, &str),
        look: &Look,
        at: &At,
    ) -> Going {
        let luminance_cd_m2 = look.luminance_cd_m2();
        if look.sky.is_none() && angle_deg <= luminaires::WIDEST_DISC_DEG {
            let disc = luminaires::disc(name, (towards, angle_deg), luminance_cd_m2);
            return self.add_luminaire(Some(disc), at);
        }
        let function = look.sky.map(|index| SkyFunction::of(self.modifiers.get(index)));
        let function = match function.transpose() {
            Ok(function) => function,
            Err(what) => {
                let what = format!("{label}: the function of `{}` {what}", look.name);
                self.notes.problem(at, what, "write it by gensky or gendaylit again");
                return Some(());
            }
        };
        if self.skies.add(Wide { name, towards, angle_deg, luminance_cd_m2, function }) {
            return Some(());
        }
        self.full(at, format!("more than {} wide sources", limits::SKIES))
    }
}
