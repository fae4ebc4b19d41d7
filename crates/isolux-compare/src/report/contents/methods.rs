//! What each measure is, and whose it is.

use crate::report::document::{Block, Section, Source, Table, words};

/// A measure: its name, formula, unit and source.
type Measure = [&'static str; 4];

const MEASURES: [Measure; 16] = [
    [
        "Measured error of CUBE",
        "√(Σ w ((m − e)/e)² / Σ w) over points A to F: m as read from the map, e the right value, w the weight of the point",
        "%",
        "[1], 2.1",
    ],
    ["Measured error of SPHERE", "|m − e|/e at the middle of the octant", "%", "[1], 2.2"],
    [
        "Error over a grid",
        "√(Σ (m − e)² / Σ e²) over places of equal area: 32 × 32 of a face of CUBE, 16 × 16 of SPHERE",
        "%",
        "[1], 3.3, for illuminance",
    ],
    [
        "Reported error",
        "What a run reports of its own map: root mean square error over all surfaces, from the spread of independent increments and from test points, over \
         the root mean square illuminance, or twice its mean if that is less",
        "%",
        "isolux",
    ],
    [
        "Reported error of the interpolated map",
        "The same if all light is interpolated, direct light, too",
        "%",
        "isolux",
    ],
    ["Not yet shot", "Share of all light that radiosity has not distributed", "%", "[1], 2.1"],
    [
        "Audited error",
        "√(mean of (m − p)(m − q)) over places drawn by area, relative as the reported error: p and q are independent means of complete paths, which know \
         neither elements nor map; with an interval of 95 %",
        "%",
        "isolux",
    ],
    [
        "Intervals that hold",
        "Share of the places of the grid where |m − e| ≤ 1.96 s, s the standard error reported there; of an honest map 95 %",
        "%",
        "isolux",
    ],
    ["Reported over true", "√(Σ s² / Σ (m − e)²) over the same places", "–", "isolux"],
    [
        "Light landing over emitted",
        "Luminous flux that lands on surfaces, each time it is reflected anew, over that of all luminaires. A map that loses or makes light shows it here",
        "–",
        "isolux",
    ],
    [
        "Figure of merit",
        "1 / (ε² t), ε the error, t the time; it does not depend on t where ε falls as 1/√t",
        "1/s",
        "[2], chapter 2",
    ],
    [
        "Order",
        "p of ε = c t^(−p), by least squares in logarithms of both; 0.5 of independent samples",
        "–",
        "isolux",
    ],
    [
        "Relative L2 distance d_rel",
        "√(1/N Σ (f − g)²) / √(1/N Σ f²) of each component of the frame buffer, f the picture compared with; mean of the three components",
        "%",
        "[1], 3.3",
    ],
    ["ΔE*ab", "√(ΔL*² + Δa*² + Δb*²), mean over the pixels", "–", "CIE 1976 [3]"],
    [
        "ΔE*94",
        "√(ΔL*² + (ΔC*/(1 + 0.045 C*))² + (ΔH*/(1 + 0.015 C*))²), C* of the picture compared with, mean over the pixels; the study calls it CIE 1995",
        "–",
        "CIE 1994 [4]",
    ],
    ["ΔE00", "Mean over the pixels", "–", "CIEDE2000 [5]"],
];

const SOURCES: [Source; 7] = [
    Source {
        text: "E. A. Kopylov, A. B. Khodulev, V. L. Volevich: The comparison of illumination maps technique in computer graphics software. GraphiCon’98, \
               Moscow, 1998.",
        address: None,
    },
    Source {
        text: "J. F. Briesmeister (ed.): MCNP, a general Monte Carlo N-particle transport code, version 4C. LA-13709-M, Los Alamos National Laboratory, \
               2000.",
        address: None,
    },
    Source {
        text: "CIE 15:2004, Colorimetry, 3rd edition. Commission Internationale de l’Éclairage, Vienna, 2004.",
        address: None,
    },
    Source {
        text: "CIE 116-1995, Industrial colour-difference evaluation. Commission Internationale de l’Éclairage, Vienna, 1995.",
        address: None,
    },
    Source {
        text: "G. Sharma, W. Wu, E. N. Dalal: The CIEDE2000 color-difference formula: implementation notes, supplementary test data, and mathematical \
               observations. Color Research and Application 30, 21–30, 2005.",
        address: Some("https://doi.org/10.1002/col.20070"),
    },
    Source {
        text: "M. Okabe, K. Ito: Color universal design: how to make figures and presentations that are friendly to colorblind people, 2008. The colours \
               of the graphs.",
        address: None,
    },
    Source {
        text: "CIE 171:2006, Test cases to assess the accuracy of lighting computer programs. Commission Internationale de l’Éclairage, Vienna, 2006.",
        address: None,
    },
];

/// How everything was measured.
pub(super) fn section() -> Section {
    let row = |measure: &Measure| measure.map(str::to_owned).to_vec();
    let columns = ["Measure", "Definition", "Unit", "Source"].map(words).to_vec();
    let table = Table::plain("Measures", columns, MEASURES.iter().map(row).collect());
    Section {
        id: "methods".to_owned(),
        title: "Methods and definitions".to_owned(),
        blocks: vec![Block::Text(how().to_owned()), Block::Table(table)],
    }
}

/// What is cited.
pub(super) fn sources() -> Section {
    Section {
        id: "sources".to_owned(),
        title: "Sources".to_owned(),
        blocks: vec![Block::Sources(SOURCES.to_vec())],
    }
}

fn how() -> &'static str {
    "Every map is a run of its own from the start; all have the same seed and number of threads, one is made at a time, and systems take turns. For every \
     time a run is asked for an accuracy that fits it: the shortest for 10 %, others for what so much time makes of the least error that their \
     system has reported so far: with light between all pairs of elements (radiosity) it falls as time to the power −¼, else −½. A run that takes twice its time is stopped as soon as its system can be. Times are as measured, without reading the \
     scene. What was not measured, or is not known to the system, is a dash, never zero."
}
