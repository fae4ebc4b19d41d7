//! Values as TOML.

use isolux::units::Rgb;

/// A number that reads back to the same bits.
pub(super) fn number(x: f64) -> String {
    toml::Value::Float(x).to_string()
}

pub(super) fn triple(values: [f64; 3]) -> String {
    format!("[{}]", values.map(number).join(", "))
}

/// One number for grey.
pub(super) fn colour(Rgb(channels): Rgb) -> String {
    let [red, green, blue] = channels;
    if red == green && green == blue { number(red) } else { triple(channels) }
}

pub(super) fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_toml() {
        assert_eq!(number(0.1), "0.1");
        assert_eq!(colour(Rgb::grey(1.0)), "1.0");
        assert_eq!(colour(Rgb::new(1.0, 0.5, 0.25)), "[1.0, 0.5, 0.25]");
        for text in ["a", "\"", "a\\b", "line\nbreak", "'", "ä\u{7f}"] {
            let table: toml::Table = format!("key = {}", quoted(text)).parse().unwrap();
            assert_eq!(table["key"].as_str(), Some(text));
        }
        for x in [1e300, 5e-324, -0.0, 123_456.789] {
            let table: toml::Table = format!("key = {}", number(x)).parse().unwrap();
            assert_eq!(table["key"].as_float().map(f64::to_bits), Some(x.to_bits()));
        }
    }
}
