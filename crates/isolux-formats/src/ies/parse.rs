//! Bytes to an [`IesFile`].

use super::header::{Header, split};
use super::numbers::Numbers;
use super::tilt::{Tilt, TiltTable};
use super::{
    Edition, IesFile, LampFactor, LengthUnit, LuminousOpening, PhotometricType, RecordLines, audit,
};
use crate::plain_text::{decode, lines};
use crate::{Loaded, Problem, Problems, product_file};
use std::path::{Component, Path};

/// Intensities a file may hold: a quarter of a degree over the whole sphere.
const MAX_INTENSITIES: u32 = 1 << 20;

/// The bytes of a tilt file; `None` if there is no such file.
type TiltBytes = Result<Option<Vec<u8>>, Problem>;

/// What may stand after `TILT=`.
const TILT_REMEDY: &str = "write TILT=NONE, TILT=INCLUDE with the table after it, or the name of a tilt file that lies beside it";
const CUT_TILT_REMEDY: &str = "get it again from its maker; TILT= is NONE, INCLUDE with a table after it, or the \
                               name of a tilt file that lies beside it";

/// Reads a photometric file from memory. `file` is its name for messages; `read_tilt` gives the
/// bytes of the tilt file beside it, which is asked for by plain name only, and `None` if there is none.
pub fn parse(
    bytes: &[u8],
    file: &Path,
    read_tilt: &mut dyn FnMut(&str) -> TiltBytes,
) -> Result<Loaded<IesFile>, Problems> {
    if let Some(problem) = product_file::by_content(bytes, file) {
        return Err(problem.into());
    }
    let text = decode(bytes, file)?;
    let lines = lines(&text);
    let (header, rest) = split(&lines, file)?;
    let mut numbers = Numbers::new(file, rest);
    let tilt = tilt(&header, &mut numbers, file, read_tilt)?;
    let unknown_edition = header.unknown_edition.map(str::to_owned);
    let value = luminaire(header, tilt, &mut numbers, file)?;
    let mut warnings = Vec::new();
    if let Some(line) = unknown_edition {
        warnings.push(audit::unknown_edition(file, &line));
    }
    warnings.extend(after_the_table(&mut numbers)?);
    warnings.extend(audit::warnings(&value));
    Ok(Loaded { value, warnings })
}

fn tilt(
    header: &Header,
    numbers: &mut Numbers,
    file: &Path,
    read_tilt: &mut dyn FnMut(&str) -> TiltBytes,
) -> Result<Tilt, Problem> {
    let name = header.tilt;
    if name.eq_ignore_ascii_case("NONE") {
        return Ok(Tilt::None);
    }
    if name.eq_ignore_ascii_case("INCLUDE") {
        return Ok(Tilt::Included(TiltTable::parse(numbers)?));
    }
    let wrong =
        |what, remedy| Problem::new(file, format!("line {}", header.tilt_line), what, remedy);
    let told = |problem: Problem| {
        wrong(format!("the file of TILT={name} {}", problem.what), problem.remedy)
    };
    let found = if is_plain_name(name) { read_tilt(name).map_err(told)? } else { None };
    let Some(bytes) = found else {
        let what = format!("TILT={name} names no file beside this one");
        let (what, remedy) = match numbers.is_at_end() {
            true => (format!("the file seems cut in this line: {what}"), CUT_TILT_REMEDY),
            false => (what, TILT_REMEDY),
        };
        return Err(wrong(what, remedy.into()));
    };
    let tilt_file = file.with_file_name(name);
    let text = decode(&bytes, &tilt_file)?;
    let table = TiltTable::parse(&mut Numbers::new(&tilt_file, &lines(&text)))?;
    Ok(Tilt::File(name.into(), table))
}

/// Whether a name from an untrusted file is that of a file in the same directory, on any system.
fn is_plain_name(name: &str) -> bool {
    let mut components = Path::new(name).components();
    let plain =
        matches!((components.next(), components.next()), (Some(Component::Normal(_)), None));
    plain && name.len() <= 255 && !name.contains(['/', '\\', ':', '\0'])
}

fn luminaire(
    header: Header,
    tilt: Tilt,
    numbers: &mut Numbers,
    file: &Path,
) -> Result<IesFile, Problem> {
    let mut lines = RecordLines { lamps: numbers.next_line(), ..RecordLines::default() };
    let lamps = numbers.count("the number of lamps", 0, 100_000)?;
    let lumens_per_lamp = lumens(numbers)?;
    let multiplier = factor(numbers, "the multiplier of the intensities")?;
    let verticals = numbers.count("the number of vertical angles", 2, MAX_INTENSITIES)?;
    let horizontals =
        numbers.count("the number of horizontal angles", 1, MAX_INTENSITIES / verticals)?;
    let photometric_type = match numbers.count("the photometric type", 1, 3)? {
        1 => PhotometricType::C,
        2 => PhotometricType::B,
        _ => PhotometricType::A,
    };
    let (length_unit, metres) = match numbers.count("the unit of length", 1, 2)? {
        1 => (LengthUnit::Feet, 0.3048),
        _ => (LengthUnit::Metres, 1.0),
    };
    let opening = opening(numbers, metres, header.edition)?;
    let ballast_factor = factor(numbers, "the ballast factor")?;
    let lamp_factor = lamp_factor(numbers, header.edition)?;
    let input_watts = numbers.number(|| "the input power".into())?;
    let bounds = if photometric_type == PhotometricType::C { [0.0, 180.0] } else { [-90.0, 90.0] };
    lines.vertical = numbers.next_line();
    let vertical_deg = numbers.angles("vertical angle", verticals, bounds)?;
    let bounds = if photometric_type == PhotometricType::C { [0.0, 360.0] } else { [-90.0, 90.0] };
    lines.horizontal = numbers.next_line();
    let horizontal_deg = numbers.angles("horizontal angle", horizontals, bounds)?;
    lines.candela = numbers.next_line();
    let (candela, intensity_lines) = intensities(numbers, &horizontal_deg, &vertical_deg)?;
    Ok(IesFile {
        file: file.to_owned(),
        lines,
        edition: header.edition,
        keywords: header.keywords,
        labels: header.labels,
        tilt,
        lamps,
        lumens_per_lamp,
        multiplier,
        photometric_type,
        length_unit,
        opening,
        ballast_factor,
        lamp_factor,
        input_watts,
        vertical_deg,
        horizontal_deg,
        candela,
        intensity_lines,
    })
}

fn lumens(numbers: &mut Numbers) -> Result<Option<f64>, Problem> {
    let name = || "the flux of a lamp".into();
    let must = "-1 (absolute photometry) or from 0 to 1e12 lm";
    let possible = |v: f64| v == -1.0 || (0.0..=1e12).contains(&v);
    let lumens = numbers.number_that(name, must, possible)?;
    Ok((lumens >= 0.0).then_some(lumens))
}

fn factor(numbers: &mut Numbers, what: &str) -> Result<f64, Problem> {
    let possible = |v: f64| v > 0.0 && v <= 1e9;
    numbers.number_that(|| what.into(), "above 0 and at most 1e9", possible)
}

fn opening(
    numbers: &mut Numbers,
    metres: f64,
    edition: Edition,
) -> Result<LuminousOpening, Problem> {
    let mut sizes = [0.0; 3];
    for (size, what) in sizes.iter_mut().zip(["width", "length", "height"]) {
        let name = || format!("the {what} of the luminous opening");
        let possible = |v: f64| v.abs() <= 1e6;
        *size = numbers.number_that(name, "within -1e6 and 1e6", possible)? * metres;
    }
    Ok(LuminousOpening::from_signed(sizes, edition))
}

fn lamp_factor(numbers: &mut Numbers, edition: Edition) -> Result<LampFactor, Problem> {
    Ok(match edition {
        Edition::E1986 | Edition::E1991 | Edition::E1995 => {
            LampFactor::BallastLamp(factor(numbers, "the ballast-lamp photometric factor")?)
        }
        Edition::E2002 => {
            LampFactor::Reserved(numbers.number(|| "the number after the ballast factor".into())?)
        }
        Edition::E2019 => {
            LampFactor::GenerationType(numbers.number(|| "the file generation type".into())?)
        }
    })
}

fn intensities(
    numbers: &mut Numbers,
    horizontal_deg: &[f64],
    vertical_deg: &[f64],
) -> Result<(Vec<f64>, Vec<u32>), Problem> {
    let (mut candela, mut lines) = (Vec::new(), Vec::new());
    for horizontal in horizontal_deg {
        for vertical in vertical_deg {
            let name = || {
                format!("the intensity at {vertical} degrees vertically, {horizontal} horizontally")
            };
            let possible = |v: f64| (0.0..=1e15).contains(&v);
            candela.push(numbers.number_that(name, "from 0 to 1e15", possible)?);
            lines.push(numbers.line());
        }
    }
    Ok((candela, lines))
}

/// Text after the table is left out; numbers after it mean that the table is not what was read.
fn after_the_table(numbers: &mut Numbers) -> Result<Option<Problem>, Problem> {
    let Some(word) = numbers.word() else { return Ok(None) };
    if word.parse::<f64>().is_ok() {
        return Err(numbers.problem(
            "numbers follow after the last intensity",
            "make the counts of angles agree with the table; decimals take a point, not a comma",
        ));
    }
    Ok(Some(numbers.problem("text after the table is left out", "remove it")))
}
