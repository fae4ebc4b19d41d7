//! What is refused, and files made to harm.

use super::*;

/// Insides of scenes, and what is said of them.
const REFUSED: &[(&str, &str)] = &[
    ("<shape type='serialized'/>", "line 2: shape `serialized` is not read"),
    ("<shape type='hair' id='h'/>", "line 2: shape `hair` (`h`) is not read"),
    ("<shape type='obj'/>", "line 2: shape `obj` names no file"),
    (
        "\n<shape type='ply'><string name='filename' value='a.ply'/></shape>",
        "line 3: file `a.ply` does not exist",
    ),
    ("<shape type='cube'><bsdf type='measured'/></shape>", "bsdf `measured` is not read"),
    ("<shape type='cube'><bsdf type='roughdielectric'/></shape>", "`roughdielectric` is not read"),
    ("<shape type='cube'><ref id='gone'/></shape>", "there is no object `gone`"),
    ("<shape type='cube'><ref name='interior' id='x'/></shape>", "holds a medium"),
    (
        "<shape type='cube'><emitter type='area'><blackbody name='radiance' temperature='3000'/></emitter></shape>",
        "black bodies are not read",
    ),
    (
        "<shape type='cube'><emitter type='area'><spectrum name='radiance' value='500:1, 400:2'/></emitter></shape>",
        "no list of `wavelength:value`",
    ),
    (
        "<shape type='cube'><emitter type='area'><rgb name='radiance' value='-1'/></emitter></shape>",
        "is not zero or more",
    ),
    (
        "<shape type='cube'><bsdf type='dielectric'/><emitter type='area'/></shape>",
        "is of glass and gives light",
    ),
    (
        "<shape type='cube'><bsdf type='twosided'><bsdf type='dielectric'/></bsdf></shape>",
        "holds what light passes",
    ),
    (
        "<shape type='cube'><bsdf type='conductor'><string name='material' value='Xx'/></bsdf></shape>",
        "is of `Xx`, which is not known",
    ),
    (
        "<shape type='cube'><bsdf type='dielectric'><string name='int_ior' value='jelly'/></bsdf></shape>",
        "no substance `jelly`",
    ),
    (
        "<shape type='cube'><bsdf type='dielectric'><float name='int_ior' value='0'/></bsdf></shape>",
        "`int_ior` is 0",
    ),
    ("<shape type='sphere'><float name='radius' value='-1'/></shape>", "`radius` is -1"),
    (
        "<shape type='sphere'><float name='radius' value='one'/></shape>",
        "`one` is not one finite number",
    ),
    (
        "<shape type='cube'><transform name='to_world'><scale x='0'/></transform></shape>",
        "flattens",
    ),
    (
        "<shape type='cube'><transform name='to_world'><shear x='1'/></transform></shape>",
        "step `shear`",
    ),
    (
        "<shape type='cube'><transform name='to_world'><matrix value='1 2 3'/></transform></shape>",
        "neither 9 nor 16",
    ),
    (
        "<shape type='cube'><transform name='to_world'><rotate angle='1'/></transform></shape>",
        "without an axis",
    ),
    (
        "<shape type='cube'><transform name='to_world'><lookat origin='0 0 0' target='0 1 0' up='0 1 0'/></transform></shape>",
        "lie on a line",
    ),
    ("<emitter type='sunsky'/><shape type='cube'/>", "`sunsky` is not read"),
    (
        "<emitter type='constant'/><emitter type='constant'/>",
        "`constant` is the second that surrounds",
    ),
    ("<emitter type='envmap'/>", "emitter `envmap` names no file"),
    (
        "<emitter type='spot'><float name='cutoff_angle' value='190'/></emitter>",
        "give angles from the axis",
    ),
    ("<medium type='homogeneous'/>", "line 2: medium `homogeneous` is not read"),
    ("<shape type='$kind'/>", "line 2: parameter `$kind` has no value"),
    ("<default name='x'/>", "default without name and value"),
    ("<include filename='/etc/hostname'/>", "lies outside the directory"),
    ("<include filename='gone.xml'/>", "line 2: file `gone.xml` does not exist"),
    ("<shape type='cube'>", "is no XML that is read here"),
    ("<!DOCTYPE a [<!ENTITY b 'c'>]>&b;", "line 2: is no XML"),
    ("&b;", "is no XML"),
];

#[test]
fn what_is_not_read_is_refused_by_name_with_its_line() {
    for (inside, due) in REFUSED {
        refused(inside, due);
    }
    refused("", "there are no surfaces");
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.xml");
    std::fs::write(&path, "<?xml version='1.0'?>\n<X3D/>").unwrap();
    let message = mitsuba::read(&path).unwrap_err().to_string();
    assert!(message.contains("line 2: `X3D` is not a Mitsuba `scene`"), "{message}");
    std::fs::write(&path, "<!DOCTYPE scene SYSTEM 'http://a/b'>\n<scene version='3.0.0'/>")
        .unwrap();
    assert!(
        mitsuba::read(&path).unwrap_err().to_string().contains("DTDs and entities are not read")
    );
}

#[test]
fn hostile_files_end() {
    let deep = "<bsdf type='twosided'>".repeat(200_000) + &"</bsdf>".repeat(200_000);
    refused(&deep, "elements or files one in the other");
    refused("<include filename='scene.xml'/>", "elements or files one in the other");
    let group = "<shape type='shapegroup' id='g'><shape type='instance'><ref id='g'/></shape>\
                 <shape type='instance'><ref id='g'/></shape></shape><shape type='instance'><ref id='g'/></shape>";
    refused(group, "lies too deep");
    let ring =
        "<bsdf type='twosided' id='a'><ref id='a'/></bsdf><shape type='cube'><ref id='a'/></shape>";
    refused(ring, "lies in too many others");
    let long = format!(
        "<default name='a' value='{}'/><float name='{}' value='1'/>",
        "x".repeat(60_000),
        "$a".repeat(9)
    );
    refused(&long, "parameters make more than 65536 bytes");
    let many = "<a/>".repeat(3_000_000);
    refused(&many, "is no XML that is read here");
    let large = format!("<!-- {} -->", "x".repeat(65 << 20));
    let message = read_with(&large, &[]).unwrap_err().to_string();
    assert!(message.contains("larger than 64 MiB"), "{}", message.len());
}

#[test]
fn spoilt_files_are_read_or_refused() {
    const WORDS: [&str; 18] = [
        "<ref",
        "id=\"white\"/>",
        "type=\"sphere\"",
        "type=\"area\">",
        "value=\"1e308\"",
        "value=\"-1\"",
        "value=\"nan\"",
        "/>",
        "",
        "<shape",
        "</shape>",
        "name=\"radius\"",
        "$size",
        "<include",
        "type=\"twosided\">",
        "x=\"0\"",
        "&amp;",
        "<bsdf",
    ];
    let good = std::fs::read(cornell()).unwrap();
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("scene.xml");
    let mut dice = Dice(7);
    let (mut was_read, mut was_refused) = (0, 0);
    for _ in 0..1500 {
        let mut bytes = good.clone();
        spoil(&mut bytes, &mut dice, &WORDS);
        std::fs::write(&path, &bytes).unwrap();
        match mitsuba::read(&path) {
            // What is read is a scene or says why not, far coordinates among the reasons.
            Ok(loaded) => drop(Scene::assemble(loaded.value).map(|_| was_read += 1)),
            Err(Problems(list)) => {
                assert!(!list.is_empty());
                was_refused += 1;
            }
        }
    }
    // Both must happen often, or the changes are too weak or too strong.
    assert!(was_read > 150 && was_refused > 500, "{was_read} read, {was_refused} refused");
}
