//! Files about luminaires that are not read: each is refused by its name, with what to give instead.

use crate::Problem;
use std::path::Path;

/// A format by the files that have it.
struct Unread {
    extensions: &'static [&'static str],
    what: &'static str,
    remedy: &'static str,
}

/// Where the root element of an XML document is looked for, bytes: after a declaration and comments.
const MOST_PROLOGUE: usize = 4096;

const EXPORT: &str = "export it as .ies or .ldt";

const TM33: Unread = Unread {
    extensions: &["tm33", "iesxml"],
    what: "is luminaire data as XML (ANSI/IES TM-33, UNI 11733, ATLA S001), which is not read: public \
           sources contradict each other on its elements",
    remedy: EXPORT,
};
const GLDF: Unread = Unread {
    extensions: &["gldf"],
    what: "is a luminaire as GLDF, a ZIP archive that is not read itself",
    remedy: "unpack it as a .zip and give the .ies or .ldt file in it",
};
const PRODUCTS: [Unread; 4] = [
    Unread {
        extensions: &["uld"],
        what: "is a luminaire of DIALux, whose format is not public",
        remedy: EXPORT,
    },
    Unread {
        extensions: &["rolf", "rolfz"],
        what: "is a luminaire of Relux, whose format is not public",
        remedy: EXPORT,
    },
    Unread {
        extensions: &["l3d"],
        what: "is the shape of a luminaire (L3D), without its light",
        remedy: "give its .ies or .ldt file",
    },
    Unread {
        extensions: &["cen", "cib", "cie", "tm14"],
        what: "is photometric data in a format that is not read",
        remedy: EXPORT,
    },
];

impl Unread {
    fn problem(&self, path: &Path) -> Problem {
        Problem::new(path, "", self.what, self.remedy)
    }
}

/// The refusal of a file by its extension.
pub(crate) fn by_extension(path: &Path) -> Option<Problem> {
    let extension = path.extension()?.to_string_lossy().to_lowercase();
    let all = [&TM33, &GLDF].into_iter().chain(&PRODUCTS);
    let is_of = |unread: &&Unread| unread.extensions.contains(&extension.as_str());
    Some(all.into_iter().find(is_of)?.problem(path))
}

/// The refusal of a file whose content is another's than its extension promises.
pub(crate) fn by_content(bytes: &[u8], path: &Path) -> Option<Problem> {
    if bytes.starts_with(b"PK\x03\x04") {
        let what = "is a ZIP archive, as GLDF and what shops send are";
        return Some(Problem::new(path, "", what, GLDF.remedy));
    }
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(MOST_PROLOGUE)]);
    if start.split('<').skip(1).any(is_tm33) {
        return Some(TM33.problem(path));
    }
    let is_xml = start.trim_start_matches('\u{feff}').starts_with("<?xml");
    is_xml.then(|| Problem::new(path, "", "is XML, no photometric file", EXPORT))
}

/// What an XML document is by its root element, if not a scene, and the remedy.
pub(crate) fn by_root(name: &str) -> Option<[&'static str; 2]> {
    is_tm33(name).then_some([TM33.what, TM33.remedy])
}

/// Root elements of TM-33-18 and its kin, and of later editions, which count up: `IESTM33-22`.
fn is_tm33(element: &str) -> bool {
    element.starts_with("LuminaireOpticalData") || element.starts_with("IESTM33")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_is_refused_for_what_it_is() {
        for (bytes, what) in [
            (&b"PK\x03\x04rest"[..], "a ZIP archive"),
            (b"<?xml version=\"1.0\"?>\n<!-- lamp -->\n<IESTM33-22>", "TM-33"),
            (b"\xef\xbb\xbf<?xml version=\"1.0\"?><LuminaireOpticalData version=\"1.0\">", "TM-33"),
            (b"<LuminaireOpticalData>", "TM-33"),
            (b"<?xml version=\"1.0\"?><scene version=\"3.0.0\">", "is XML"),
        ] {
            let problem = by_content(bytes, Path::new("lamp.ies")).unwrap();
            assert!(problem.what.contains(what), "{problem}");
        }
        for bytes in [&b""[..], b"IES:LM-63-2019\n", b"<a company>\n1\n1\n", b"P"] {
            assert_eq!(by_content(bytes, Path::new("lamp.ldt")), None);
        }
    }

    #[test]
    fn extensions_are_read_in_either_case() {
        for (name, what) in [("a.GLDF", "GLDF"), ("a.uld", "DIALux"), ("a.tm33", "TM-33")] {
            assert!(by_extension(Path::new(name)).unwrap().what.contains(what), "{name}");
        }
        assert_eq!(by_extension(Path::new("a.ies")), None);
        assert_eq!(by_extension(Path::new("gldf")), None);
    }
}
