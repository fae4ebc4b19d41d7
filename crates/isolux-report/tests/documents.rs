//! Reports as documents: well-formed, complete, with text that is nobody's markup.

use isolux::map::{Figure, GridFigures, Verdict};
use isolux::scene::{Condition, GridQuantity};
use isolux_report::{
    Area, Budget, BudgetLine, Daylight, DaylightArea, Emergency, EmergencyCriterion,
    EmergencyRequirement, Finding, Glare, Image, Language, Luminaire, LuminousBody, Maintenance,
    Observer, Project, Report, Requirement, Scene, Severity, Surface, UncertainInput, View, html,
    typst,
};

const HOSTILE: &str = "a \"b\" <script>alert(1)</script> & #panic(\"x\") \\ $x$ \u{1}";

fn figure(value: f64, half: f64) -> Figure {
    Figure { value, low: value - half, high: value + half }
}

fn area() -> Area {
    let requirement = |of, bound, figure: Figure| Requirement {
        condition: Condition { of, is_least: true, bound },
        source: Some("EN 12464-1:2021, 34.2, writing".into()),
        figure,
        verdict: figure.reaches(bound),
        probability: figure.probability_above(bound),
    };
    let figures = GridFigures {
        known: 6,
        mean_lx: figure(512.3, 4.0),
        least_lx: figure(321.0, 6.0),
        greatest_lx: figure(640.0, 6.0),
        uniformity: figure(0.61, 0.014),
        diversity: figure(0.5, 0.01),
        direct_lx: 400.0,
        indirect_lx: 112.3,
    };
    Area {
        name: HOSTILE.into(),
        plan: Some(Image::Svg(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9\" height=\"9\"/>".into(),
        )),
        counts: [3, 2],
        sides_m: [3.0, 2.0],
        border_m: 0.5,
        height_m: Some(0.75),
        maintenance_factor: 0.8,
        figures: Some(figures),
        values_lx: vec![Some(321.0), Some(500.0), None, Some(640.0), Some(510.0), Some(520.0)],
        error_lx: 3.0,
        outside: 2,
        requirements: vec![
            requirement(GridQuantity::Mean, 500.0, figures.mean_lx),
            requirement(GridQuantity::Uniformity, 0.6, figures.uniformity),
            requirement(GridQuantity::Least, 400.0, figures.least_lx),
        ],
        budget: Some(Budget {
            grid: "desks".into(),
            mean_lx: figures.mean_lx,
            with_inputs_lx: figure(512.3, 40.0),
            lines: vec![BudgetLine {
                source: UncertainInput::Reflectance("walls".into()),
                input: Some(0.1),
                half_lx: 12.0,
                share: 0.2,
            }],
        }),
    }
}

fn year() -> Daylight {
    let area = DaylightArea {
        name: "desks".into(),
        plan: None,
        factor_mean: figure(0.021, 0.001),
        sky_component: figure(0.012, 0.001),
        factor_median: figure(0.018, 0.001),
        factor_95: figure(0.006, 0.001),
        target_lx: [figure(310.0, 20.0), figure(104.0, 10.0)],
        en_17037: [Verdict::Undecided, Verdict::NotMet, Verdict::NotMet],
        autonomy: figure(0.62, 0.01),
        spatial_autonomy: figure(0.7, 0.02),
        spatial_autonomy_reaches: [Verdict::Met, Verdict::NotMet],
        sunlight_exposure: 0.08,
        sunlight_acceptable: Verdict::Met,
        useful: [figure(0.1, 0.01), figure(0.3, 0.01), figure(0.5, 0.01), figure(0.1, 0.01)],
    };
    Daylight {
        place: "Berlin".into(),
        hours: [8, 18],
        ground_reflectance: 0.2,
        paths: 16_384,
        areas: vec![area],
    }
}

fn emergency() -> Emergency {
    let of = |criterion, bound: f64, figure: Figure| EmergencyRequirement {
        area: HOSTILE.into(),
        criterion,
        bound,
        figure,
        verdict: match criterion {
            EmergencyCriterion::CentreLineSpread | EmergencyCriterion::OpenAreaSpread => {
                figure.keeps_within(bound)
            }
            _ => figure.reaches(bound),
        },
    };
    let requirements = vec![
        of(EmergencyCriterion::CentreLine, 1.0, figure(1.53, 0.02)),
        of(EmergencyCriterion::MiddleHalf, 0.5, Figure::exact(0.3)),
        of(EmergencyCriterion::CentreLineSpread, 40.0, Figure::exact(f64::INFINITY)),
        of(EmergencyCriterion::OpenArea, 0.5, Figure::exact(0.62)),
        of(EmergencyCriterion::OpenAreaSpread, 40.0, Figure::exact(12.0)),
        of(EmergencyCriterion::HighRiskMean, 50.0, figure(52.0, 3.0)),
        of(EmergencyCriterion::HighRiskUniformity, 0.1, figure(0.4, 0.02)),
    ];
    Emergency { luminaires: 7, requirements }
}

fn report() -> Report {
    let pixel = include_bytes!("pixel.png").to_vec();
    Report {
        project: Project {
            title: HOSTILE.into(),
            client: Some("Example AG".into()),
            author: Some("A. Engineer".into()),
            date: Some("2026-11-29".into()),
            remarks: Some(HOSTILE.into()),
        },
        scene: Scene {
            name: "Office".into(),
            size_m: [6.0, 5.0, 2.8],
            surface_m2: 121.6,
            mean_reflectance: 0.55,
            flux_lm: Some(21_600.0),
            maintenance: Maintenance::Maintained { least: 0.7, greatest: 0.8 },
            skies: vec!["sky".into()],
        },
        areas: vec![area(), Area { figures: None, plan: None, ..area() }],
        emergency: Some(emergency()),
        luminaires: vec![Luminaire {
            name: "panel".into(),
            manufacturer: Some("Maker".into()),
            positions_m: vec![[1.0, 1.0, 2.7], [2.0, 1.0, 2.7]],
            flux_lm: 3600.0,
            power_w: None,
            body: LuminousBody::Surface(0.36, 3183.0),
            diagram: None,
        }],
        daylight: Some(year()),
        glare: vec![Glare {
            observer: Observer {
                name: "door".into(),
                position_m: [0.4, 0.3, 1.6],
                direction: [0.6, 0.8, 0.0],
            },
            rating: Some(figure(18.2, 0.2)),
            background_cd_m2: 42.0,
        }],
        views: vec![View {
            name: "door".into(),
            picture: Image::Png(pixel.clone()),
            chart: Some(Image::Png(pixel)),
        }],
        surfaces: vec![Surface {
            name: "walls".into(),
            area_m2: 61.6,
            reflectance: Some(0.6),
            specular: 0.0,
        }],
        provenance: None,
        reference_lx: 0.0,
        energy: None,
        findings: vec![Finding { severity: Severity::Warning, text: HOSTILE.into() }],
        software: "isolux".into(),
    }
}

#[test]
fn html_is_well_formed_and_says_what_was_found() {
    for (language, words) in [
        (
            Language::English,
            ["Lighting and daylight report", "512 (508 to 516)", "0.61 (0.60 to 0.62)", "not met"],
        ),
        (
            Language::German,
            [
                "Lichttechnischer Bericht mit Tageslicht",
                "512 (508 bis 516)",
                "0,61 (0,60 bis 0,62)",
                "nicht erf\u{fc}llt",
            ],
        ),
    ] {
        let text = html(&report(), language);
        let document = roxmltree::Document::parse_with_options(
            &text,
            roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() },
        )
        .unwrap();
        assert!(document.descendants().all(|node| !node.has_tag_name("script")));
        let shown: String =
            document.descendants().filter_map(|node| node.text()).collect::<Vec<_>>().join(" ");
        for word in words {
            assert!(shown.contains(word), "{word}: {shown}");
        }
        let badges = |class: &str| {
            document.descendants().filter(|node| node.attribute("class") == Some(class)).count()
        };
        // Two grids with a mean that is met, a uniformity that is undecided, a least value that is not met; the cover; daylight;
        // four of emergency lighting, in the results and in a section of their own.
        assert_eq!(badges("badge met"), 2 + 2 + 2 * 4);
        assert!(badges("badge undecided") >= 3 && badges("badge not-met") >= 5);
    }
}

/// All links of the contents lead somewhere, and all pictures say what they show.
#[test]
fn html_can_be_found_through_and_heard() {
    let text = html(&report(), Language::English);
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
    let document = roxmltree::Document::parse_with_options(&text, options).unwrap();
    let links = document.descendants().filter_map(|node| node.attribute("href"));
    for link in links {
        let id = link.strip_prefix('#').expect("links stay on the page");
        assert!(document.descendants().any(|node| node.attribute("id") == Some(id)), "{link}");
    }
    let images = document.descendants().filter(|node| node.has_tag_name("img"));
    assert!(images.clone().count() >= 3);
    assert!(images.clone().all(|image| image.attribute("alt").is_some_and(|alt| !alt.is_empty())));
}

/// The values of a grid lie as on its plan: the last row on top.
#[test]
fn values_lie_as_on_the_plan() {
    let text = html(&report(), Language::English);
    let table = text.split("class=\"dense\"").nth(1).unwrap();
    let (top, bottom) = (table.find("640").unwrap(), table.find("321").unwrap());
    assert!(top < bottom);
    assert!(table.contains("\u{2013}"), "an unknown value is no number");
}

#[test]
fn typst_has_all_text_in_literals() {
    let (source, files) = typst(&report(), Language::German);
    assert!(!source.contains("#panic(\"x\")"), "quotes of text are escaped");
    assert_eq!(files.len(), 4, "cover, plan, picture, chart");
    for file in &files {
        assert!(source.contains(&file.name));
    }
}

#[cfg(feature = "pdf")]
#[test]
fn pdf_is_tagged_and_has_text() {
    for language in [Language::English, Language::German] {
        let bytes = isolux_report::pdf(&report(), language).unwrap();
        assert!(bytes.starts_with(b"%PDF-"));
        let has = |what: &[u8]| bytes.windows(what.len()).any(|part| part == what);
        assert!(has(b"/StructTreeRoot") && has(b"/MarkInfo"), "tagged");
        assert!(has(b"/ToUnicode"), "text can be searched");
    }
}
