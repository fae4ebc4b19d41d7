//! Irradiance caches: samples of indirect light that later runs reuse and extend.
//!
//! In the file: `ISOLUXIC`, the format version and the length of a JSON text as `u32`, the text (scene,
//! its hash, version), the BLAKE3 hash of all before it; then blocks of samples. A block is `SAMP`, the
//! number of its samples as `u32`, the samples, the BLAKE3 hash of all of the block before it. Everything is
//! little-endian.
//!
//! Blocks are only ever appended, whole, by whoever holds the lock of the file, so that processes can share
//! it. Who is killed while appending leaves a block cut short at the end: readers leave it out, and the next
//! writer puts its own block in its place.

mod blocks;
mod head;
mod sample;

#[cfg(test)]
mod tests;

use crate::Problem;
use crate::atomic;
use crate::counted;
use blocks::{Blocks, pack};
use head::Head;
use isolux::engine::{CacheSample, IrradianceCache};
use std::fs::{File, OpenOptions};
use std::io::{self, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// What to do about a file that is not what it should be.
const REMOVE: &str = "remove it, or choose another file";

/// The cache of a scene in a file.
#[derive(Debug)]
pub struct CacheFile {
    path: PathBuf,
    scene_hash: String,
    scene: String,
    max_bytes: u64,
    /// Bytes of it that were read: whole blocks.
    read_bytes: u64,
}

/// What a cache file holds, without its samples' scene at hand.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CacheHead {
    /// Name of the scene.
    pub scene: String,
    /// Its hash, hexadecimal.
    pub scene_hash: String,
    /// Version of isolux that made it.
    pub version: String,
}

/// Samples that were read, and what had to be left out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Found {
    /// The samples.
    pub cache: IrradianceCache,
    /// That the last block is cut short, to be shown to the user.
    pub warning: Option<Problem>,
}

impl CacheFile {
    /// Reads the samples of a scene from a file of any origin that is no longer than `max_bytes`. One that
    /// is not there holds none; it is made when there are some to be kept.
    pub fn open(
        path: &Path,
        (scene, scene_hash): (&str, &str),
        max_bytes: u64,
    ) -> Result<(Self, Found), Problem> {
        let mut file = Self {
            path: path.to_owned(),
            scene_hash: scene_hash.to_owned(),
            scene: scene.to_owned(),
            max_bytes,
            read_bytes: 0,
        };
        if !path.exists() {
            atomic::check_writable(path)?;
            return Ok((file, Found::default()));
        }
        let mut open = regular_file(path, OpenOptions::new().read(true))?;
        open.lock_shared().map_err(|error| file.unlockable(&error))?;
        let found = file.read_on(&mut open)?;
        Ok((file, found))
    }

    /// Appends samples; returns those that others have appended since this was read.
    pub fn append(&mut self, samples: &[CacheSample]) -> Result<Found, Problem> {
        let mut options = OpenOptions::new();
        options.read(true).write(true).create(true).truncate(false);
        let mut open = regular_file(&self.path, &options)?;
        open.lock().map_err(|error| self.unlockable(&error))?;
        let others = self.read_on(&mut open)?;
        let bytes = if self.read_bytes == 0 {
            let head = Head::new(&self.scene, &self.scene_hash);
            [head.pack(), pack(samples)].concat()
        } else {
            pack(samples)
        };
        let whole = self.read_bytes.saturating_add(bytes.len() as u64);
        if whole > self.max_bytes {
            let what =
                format!("would take {whole} bytes, more than the {} allowed", self.max_bytes);
            return Err(self.problem(what, "allow more memory, or choose another file"));
        }
        let mut write = || -> io::Result<()> {
            // What a writer that was killed has left behind the last whole block goes.
            open.set_len(self.read_bytes)?;
            open.seek(SeekFrom::Start(self.read_bytes))?;
            open.write_all(&bytes)?;
            open.sync_all()
        };
        write().map_err(|error| {
            self.problem(format!("cannot be written: {error}"), "free some space")
        })?;
        self.read_bytes = whole;
        Ok(Found { warning: None, ..others })
    }

    /// Reads what was appended since the last time.
    fn read_on(&mut self, open: &mut File) -> Result<Found, Problem> {
        let path = self.path.clone();
        let unreadable = |error: io::Error| Problem::unreadable(&path, &error);
        let length = open.metadata().map_err(unreadable)?.len();
        if length > self.max_bytes {
            let what = format!("takes {length} bytes, more than the {} allowed", self.max_bytes);
            return Err(self.problem(what, "allow more memory, or choose another file"));
        }
        if length < self.read_bytes {
            return Err(self.problem("has become shorter meanwhile".into(), REMOVE));
        }
        let new = length - self.read_bytes;
        let mut bytes = Vec::with_capacity(new as usize);
        open.seek(SeekFrom::Start(self.read_bytes)).map_err(unreadable)?;
        open.take(new).read_to_end(&mut bytes).map_err(unreadable)?;
        let mut rest = bytes.as_slice();
        if self.read_bytes == 0 && !rest.is_empty() {
            let (head, after) = Head::unpack(rest).map_err(|what| self.problem(what, REMOVE))?;
            self.check(&head)?;
            self.read_bytes = (rest.len() - after.len()) as u64;
            rest = after;
        }
        let Blocks { samples, bytes: whole, is_cut } =
            Blocks::unpack(rest).map_err(|what| self.problem(what, REMOVE))?;
        self.read_bytes += whole;
        let warning = is_cut.then(|| {
            let whole = counted(samples.len(), "sample before it is", "samples before it are");
            let what = format!("the last block is cut short: {whole} whole");
            self.problem(what, "nothing need be done: the next run replaces it")
        });
        Ok(Found { cache: IrradianceCache { samples }, warning })
    }

    fn check(&self, head: &Head) -> Result<(), Problem> {
        if head.scene_hash == self.scene_hash {
            return Ok(());
        }
        let what = format!(
            "holds samples of another scene, or of this one before it was changed: `{}`, not `{}`",
            head.scene, self.scene
        );
        Err(self.problem(what, "choose another file for this scene, or remove this one"))
    }

    fn unlockable(&self, error: &io::Error) -> Problem {
        self.problem(
            format!("cannot be locked: {error}"),
            "choose a place whose files can be locked",
        )
    }

    fn problem(&self, what: String, remedy: &str) -> Problem {
        Problem::new(&self.path, "", what, remedy)
    }
}

/// Whether a file is a cache.
pub fn is_cache(path: &Path) -> bool {
    let mut magic = [0; head::MAGIC.len()];
    let read = File::open(path).and_then(|mut file| file.read_exact(&mut magic));
    read.is_ok() && &magic == head::MAGIC
}

/// Reads whatever scene a file is of, and its samples.
pub fn read(path: &Path, max_bytes: u64) -> Result<(CacheHead, Found), Problem> {
    let mut start = Vec::new();
    let open = regular_file(path, OpenOptions::new().read(true))?;
    let unreadable =
        |error: io::Error| Problem::new(path, "", format!("cannot be read ({error})"), REMOVE);
    open.take(head::MOST_BYTES as u64).read_to_end(&mut start).map_err(unreadable)?;
    let (head, _) = Head::unpack(&start).map_err(|what| Problem::new(path, "", what, REMOVE))?;
    let (_, found) = CacheFile::open(path, (&head.scene, &head.scene_hash), max_bytes)?;
    let Head { scene, scene_hash, version } = head;
    Ok((CacheHead { scene, scene_hash, version }, found))
}

fn regular_file(path: &Path, options: &OpenOptions) -> Result<File, Problem> {
    let unopenable = |error: io::Error| {
        let remedy = match error.kind() {
            ErrorKind::PermissionDenied => "allow reading and writing it, or choose another file",
            _ => "check the path",
        };
        Problem::new(path, "", format!("cannot be opened: {error}"), remedy)
    };
    // Before it is opened: opening a pipe may take forever.
    let is_other = path.metadata().is_ok_and(|known| !known.is_file());
    if is_other {
        return Err(Problem::new(path, "", "is not a regular file", "choose another file"));
    }
    options.open(path).map_err(unopenable)
}
