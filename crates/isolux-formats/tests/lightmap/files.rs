//! EXR and KTX2, by the readers of their crates.

use crate::card;
use exr::meta::attribute::{AttributeValue, Text};
use exr::prelude::{ReadChannels, ReadLayers, read};
use isolux::lightmap::{Cover, Lightmap};
use isolux_formats::lightmap::{Target, write_exr, write_ktx2};
use std::f64::consts::PI;
use std::io::Cursor;

fn baked() -> Lightmap {
    let scene = card::scene();
    card::lightmap(&scene, &card::map(&scene))
}

type Flat = exr::image::Layer<exr::image::AnyChannels<exr::image::FlatSamples>>;

fn layer(bytes: &[u8]) -> Flat {
    let image = read().no_deep_data().largest_resolution_level().all_channels();
    let image = image.first_valid_layer().all_attributes();
    image.from_buffered(Cursor::new(bytes)).unwrap().layer_data
}

fn channel(layer: &Flat, name: &str) -> Vec<f32> {
    let text = Text::from(name);
    let found = layer.channel_data.list.iter().find(|c| c.name == text).unwrap();
    found.sample_data.values_as_f32().collect()
}

/// The colours of an EXR.
pub(crate) fn colours(bytes: &[u8]) -> Vec<[f32; 3]> {
    let layer = layer(bytes);
    let [r, g, b] = ["R", "G", "B"].map(|name| channel(&layer, name));
    (0..r.len()).map(|k| [r[k], g[k], b[k]]).collect()
}

#[test]
fn exr_keeps_every_bit_and_says_what_it_holds() {
    let lightmap = baked();
    let bytes = write_exr(&lightmap, 0, &Target::Viewer.convention()).unwrap();
    assert_eq!(bytes, write_exr(&lightmap, 0, &Target::Viewer.convention()).unwrap());
    let layer = layer(&bytes);
    assert_eq!(layer.size.0, lightmap.layout.width as usize);
    let channel = |name: &str| channel(&layer, name);
    for (k, name) in ["R", "G", "B"].into_iter().enumerate() {
        let kept: Vec<f32> = lightmap.page(0).iter().map(|rgb| rgb[k]).collect();
        assert_eq!(channel(name), kept, "{name}");
    }
    let (errors, coverage) = (channel("standard_error.Y"), channel("coverage.Y"));
    for texel in 0..lightmap.covers.len() {
        match (lightmap.texel(texel), lightmap.covers[texel]) {
            (Some(known), _) => {
                assert_eq!(f64::from(errors[texel]), known.standard_error_lx);
                assert!(coverage[texel] > 0.0);
            }
            (None, Cover::Unknown) => assert!(errors[texel].is_nan() && coverage[texel] == -1.0),
            (None, _) => assert!(errors[texel].is_nan() && coverage[texel] == 0.0),
        }
    }
    let Some(AttributeValue::Text(note)) = layer.attributes.other.get(&Text::from("isolux")) else {
        panic!("no note");
    };
    let note: serde_json::Value = serde_json::from_str(&note.to_string()).unwrap();
    assert_eq!(note["unit"], "lx");
    assert_eq!(note["texels_per_meter"], 10.0);
    assert_eq!(note["formula"], "luminance = albedo * texel / pi");
}

/// EXT_texture_shared_exponent, section "shared exponent texture color conversion", written anew.
fn unpacked(word: u32) -> [f64; 3] {
    let scale = 2_f64.powi((word >> 27) as i32 - 15 - 9);
    [word & 0x1ff, word >> 9 & 0x1ff, word >> 18 & 0x1ff]
        .map(|mantissa| f64::from(mantissa) * scale)
}

#[test]
fn ktx2_is_read_by_a_reader_of_its_own() {
    let lightmap = baked();
    for (target, from_lux) in [(Target::Three, 1.0), (Target::Bevy, 1.0 / PI)] {
        let file = write_ktx2(&lightmap, 0, &target.convention()).unwrap();
        assert_eq!(file.scale, 1.0);
        let reader = ktx2::Reader::new(&file.bytes[..]).unwrap();
        let header = reader.header();
        assert_eq!(header.format, Some(ktx2::Format::E5B9G9R9_UFLOAT_PACK32));
        assert_eq!(
            (header.pixel_width, header.pixel_height),
            (lightmap.layout.width, lightmap.layout.height)
        );
        assert_eq!(header.type_size, 4);
        let keys: Vec<&str> = reader.key_value_data().map(|(key, _)| key).collect();
        assert_eq!(keys, ["KTXorientation", "KTXwriter", "isolux"]);
        let level = reader.levels().next().unwrap();
        let words: Vec<u32> =
            level.data.as_chunks::<4>().0.iter().map(|b| u32::from_le_bytes(*b)).collect();
        assert_eq!(words.len(), lightmap.covers.len());
        for (word, kept) in words.iter().zip(lightmap.page(0)) {
            let largest = kept.iter().fold(0.0, |most, c| f64::max(most, f64::from(*c)));
            for (found, kept) in unpacked(*word).into_iter().zip(kept) {
                // Nine bits of mantissa for the largest channel: half a step of at least 256.
                let off = (found - f64::from(*kept) * from_lux).abs();
                assert!(off <= largest * from_lux / 512.0, "{found} {kept}");
            }
        }
    }
}

#[test]
fn light_beyond_the_format_is_scaled_and_said() {
    let mut lightmap = baked();
    lightmap.shown_lx[0] = [120_000.0; 3];
    let file = write_ktx2(&lightmap, 0, &Target::Three.convention()).unwrap();
    assert_eq!(file.scale, 2.0);
    let reader = ktx2::Reader::new(&file.bytes[..]).unwrap();
    let (_, note) = reader.key_value_data().find(|(key, _)| *key == "isolux").unwrap();
    assert!(String::from_utf8_lossy(note).contains("times 2;"));
}
