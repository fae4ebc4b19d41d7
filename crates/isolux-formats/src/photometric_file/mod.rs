//! Photometric files of either kind: read, and converted into each other.

mod convert;
mod difference;
mod direct_ratios;
mod to_ies;
mod to_ldt;

pub use convert::{Conversion, Target, convert};
pub use difference::Difference;
pub use direct_ratios::{ROOM_INDICES, direct_ratios};

use crate::ies::{self, IesFile};
use crate::ldt::{self, LdtFile};
use crate::{Loaded, Problem, Problems, product_file, source};
use isolux::photometry::{IntensityDistribution, PhotometricWeb};
use std::path::Path;
use std::sync::Arc;

/// A photometric file as written.
#[derive(Clone, Debug, PartialEq)]
pub enum PhotometricFile {
    /// IES LM-63.
    Ies(IesFile),
    /// EULUMDAT.
    Ldt(LdtFile),
}

/// What the extension of a file promises.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Ies,
    Ldt,
}

impl Kind {
    fn of(path: &Path) -> Result<Self, Problem> {
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("ies") => Ok(Self::Ies),
            Some("ldt") => Ok(Self::Ldt),
            _ => Err(product_file::by_extension(path).unwrap_or_else(|| {
                let remedy = match extension.as_deref() {
                    Some("xml") => "TM-33 and other XML is not read; export it as .ies or .ldt",
                    _ => "give a file that ends in .ies or .ldt",
                };
                Problem::new(path, "", "is no photometric file by its extension", remedy)
            })),
        }
    }
}

impl PhotometricFile {
    /// Reads a file by its extension.
    pub fn read(path: &Path) -> Result<Loaded<Self>, Problems> {
        source::check_present(path)?;
        Ok(match Kind::of(path)? {
            Kind::Ies => {
                let Loaded { value, warnings } = ies::read(path)?;
                Loaded { value: Self::Ies(value), warnings }
            }
            Kind::Ldt => {
                let Loaded { value, warnings } = ldt::read(path)?;
                Loaded { value: Self::Ldt(value), warnings }
            }
        })
    }

    /// Reads a file from memory, by the extension of its name; no tilt file is looked for.
    pub fn parse(bytes: &[u8], path: &Path) -> Result<Loaded<Self>, Problems> {
        Ok(match Kind::of(path)? {
            Kind::Ies => {
                let Loaded { value, warnings } = ies::parse(bytes, path, &mut |_| {
                    let remedy = "write TILT=NONE or TILT=INCLUDE";
                    Err(Problem::new(path, "", "is not read here", remedy))
                })?;
                Loaded { value: Self::Ies(value), warnings }
            }
            Kind::Ldt => {
                let Loaded { value, warnings } = ldt::parse(bytes, path)?;
                Loaded { value: Self::Ldt(value), warnings }
            }
        })
    }

    /// The intensity distribution, of EULUMDAT with the first lamp set, in candela.
    pub fn resolve(&self) -> Result<IntensityDistribution, Problem> {
        match self {
            Self::Ies(file) => file.resolve(),
            Self::Ldt(file) => file.resolve(),
        }
    }

    /// As [`Self::resolve`]: the table of a file is a web.
    pub(crate) fn web(&self) -> Result<Arc<PhotometricWeb>, Problem> {
        match self.resolve()? {
            IntensityDistribution::Web(web) => Ok(web),
            IntensityDistribution::Isotropic { .. }
            | IntensityDistribution::CosinePower { .. }
            | IntensityDistribution::Spot { .. } => {
                Err(Problem::new(self.path(), "", "holds no table", "give a measured file"))
            }
        }
    }

    /// The file.
    pub fn path(&self) -> &Path {
        match self {
            Self::Ies(file) => &file.file,
            Self::Ldt(file) => &file.file,
        }
    }

    /// Flux declared for the lamps, lm; `None` for absolute photometry.
    pub fn lamp_flux_lm(&self) -> Option<f64> {
        match self {
            Self::Ies(file) => file.lamp_lumens(),
            Self::Ldt(file) => {
                file.lamp_sets.first().filter(|set| !set.absolute).map(|set| set.flux_lm)
            }
        }
    }

    /// Input power, W; `None` where the file gives none.
    pub fn input_watts(&self) -> Option<f64> {
        let watts = match self {
            Self::Ies(file) => file.input_watts,
            Self::Ldt(file) => file.lamp_sets.first().map_or(0.0, |set| set.watts),
        };
        Some(watts).filter(|watts| *watts > 0.0)
    }
}
