//! Optical constants that Mitsuba knows by name.

/// Refractive indices of transparent matter, as in the table of Mitsuba's manual.
const INDICES: [(&str, f64); 17] = [
    ("vacuum", 1.0),
    ("helium", 1.000_036),
    ("hydrogen", 1.000_132),
    ("air", 1.000_277),
    ("carbon dioxide", 1.000_45),
    ("water", 1.333),
    ("acetone", 1.36),
    ("ethanol", 1.361),
    ("carbon tetrachloride", 1.461),
    ("glycerol", 1.4729),
    ("benzene", 1.501),
    ("silicone oil", 1.520_45),
    ("water ice", 1.31),
    ("fused quartz", 1.458),
    ("bk7", 1.5046),
    ("polypropylene", 1.49),
    ("diamond", 2.419),
];

/// Index of transparent matter.
pub(super) fn index(name: &str) -> Option<f64> {
    INDICES.iter().find(|(known, _)| *known == name).map(|(_, index)| *index)
}

/// eta and k of metals for red, green and blue: what Mitsuba 3.9.1 makes, in its variants of three
/// channels, of the measured spectra that it ships.
const METALS: [(&str, [f64; 3], [f64; 3]); 11] = [
    ("Ag", [0.155_28, 0.116_73, 0.138_39], [4.828_35, 3.122_22, 2.146_90]),
    ("Al", [1.657_50, 0.880_40, 0.521_24], [9.223_81, 6.269_50, 4.837_00]),
    ("Au", [0.143_04, 0.375_31, 1.442_05], [3.983_00, 2.385_56, 1.603_36]),
    ("Be", [4.185_01, 3.185_03, 2.784_06], [3.835_47, 3.010_12, 2.868_99]),
    ("Cr", [4.369_67, 2.916_51, 1.654_90], [5.206_55, 4.231_31, 3.754_70]),
    ("Cu", [0.201_01, 0.923_75, 1.102_22], [3.913_26, 2.453_05, 2.142_09]),
    ("Hg", [2.398_94, 1.440_03, 0.909_57], [6.327_59, 4.371_92, 3.421_76]),
    ("Ir", [3.086_30, 2.082_19, 1.617_91], [5.592_15, 4.067_09, 3.267_31]),
    ("Ni_palik", [2.367_30, 1.663_37, 1.467_08], [4.498_81, 3.050_15, 2.345_44]),
    ("Rh", [2.585_79, 1.860_22, 1.554_26], [6.782_26, 4.702_99, 3.976_07]),
    ("W", [4.370_82, 3.300_25, 2.998_41], [3.500_64, 2.604_87, 2.273_23]),
];

/// eta and k of a metal.
pub(super) fn metal(name: &str) -> Option<([f64; 3], [f64; 3])> {
    METALS.iter().find(|(known, ..)| *known == name).map(|(_, eta, k)| (*eta, *k))
}

/// Names of metals, for messages.
pub(super) fn metals() -> String {
    METALS.map(|(name, ..)| name).join(", ")
}
