//! What is here of the standard, and what is not.

/// A case of the standard and the names of ours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Listed {
    /// Its number in the standard.
    pub number: &'static str,
    /// What it is about, in a few words.
    pub title: &'static str,
    /// The cases here that follow it.
    pub names: &'static [&'static str],
}

/// A part of the standard without a case here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// The number of the case in the standard.
    pub number: &'static str,
    /// Which part of it.
    pub part: &'static str,
    /// Why.
    pub reason: &'static str,
}

const fn listed(
    number: &'static str,
    title: &'static str,
    names: &'static [&'static str],
) -> Listed {
    Listed { number, title, names }
}

/// The cases by the number of the standard.
pub const CASES: [Listed; 13] = [
    listed("5.2", "point light sources", &["cie171_5_2_isotropic", "cie171_5_2_web"]),
    listed("5.3", "area light source", &["cie171_5_3"]),
    listed("5.4", "luminous flux conservation", &["cie171_5_4"]),
    listed("5.5", "directional transmittance of clear glass", &["cie171_5_5"]),
    listed("5.6", "light reflection over diffuse surfaces", &["cie171_5_6"]),
    listed("5.7", "diffuse reflection with an obstruction", &["cie171_5_7"]),
    listed(
        "5.8",
        "internally reflected component, diffuse surfaces",
        &["cie171_5_8_sphere", "cie171_5_8_cube"],
    ),
    listed(
        "5.9",
        "sky component, unglazed roof opening",
        &["cie171_5_9_uniform", "cie171_5_9_overcast", "cie171_5_9_clear"],
    ),
    listed(
        "5.10",
        "sky component, glazed roof opening",
        &["cie171_5_10_uniform", "cie171_5_10_overcast"],
    ),
    listed(
        "5.11",
        "sky and externally reflected components, unglazed facade opening",
        &["cie171_5_11_uniform", "cie171_5_11_overcast", "cie171_5_11_clear"],
    ),
    listed(
        "5.12",
        "sky and externally reflected components, glazed facade opening",
        &["cie171_5_12_uniform"],
    ),
    listed("5.13", "facade opening with a horizontal mask", &["cie171_5_13_uniform"]),
    listed("5.14", "facade opening with a vertical mask", &["cie171_5_14_uniform"]),
];

/// What of the standard is not here, and why.
pub const fn left_out() -> &'static [LeftOut] {
    const TYPES: &str = "two of the fifteen types show gradation and indicatrix; a facet needs a luminance, and \
                         every type gives one in the same way";
    const GROUND: &str = "under a sky that is not uniform the ground beside a building has no short exact illuminance";
    &[
        LeftOut {
            number: "5.8",
            part: "a room of unequal edges",
            reason: "only its balance of energy is exact, not a value at a place",
        },
        LeftOut { number: "5.9 to 5.14", part: "sky types but 1, 5 and 12", reason: TYPES },
        LeftOut {
            number: "5.10",
            part: "the clear sky",
            reason: "it adds nothing to the pane under the other skies",
        },
        LeftOut {
            number: "5.11 to 5.14",
            part: "the externally reflected component of skies that are not uniform, and with it all of 5.12 to 5.14 under them",
            reason: GROUND,
        },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_case_is_listed_once_under_its_number() {
        let listed: Vec<(&str, &str)> =
            CASES.iter().flat_map(|l| l.names.iter().map(|&name| (l.number, name))).collect();
        let cases = super::super::cases();
        assert_eq!(listed.len(), cases.len());
        for (case, (number, name)) in cases.iter().zip(listed) {
            let stem = format!("cie171_{}", number.replace('.', "_"));
            assert_eq!(case.name, name);
            assert!(name == stem || name.starts_with(&format!("{stem}_")), "{name}");
            assert!(case.notes.starts_with(&format!("CIE 171 {number}: ")), "{}", case.notes);
        }
    }
}
