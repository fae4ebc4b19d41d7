//! Parameters of a request's address.

use crate::answer::Refusal;
use axum::http::Uri;

/// The first parameter of a name, as written.
pub(crate) fn parameter<'a>(uri: &'a Uri, name: &str) -> Option<&'a str> {
    let pairs = uri.query().unwrap_or_default().split('&');
    pairs
        .filter_map(|pair| pair.split_once('='))
        .find_map(|(n, value)| (n == name).then_some(value))
}

/// A parameter that is a whole number.
pub(crate) fn number(uri: &Uri, name: &str) -> Result<u64, Refusal> {
    let refusal = || Refusal::bad(format!("`{name}` must be given as a whole number from 0"));
    parameter(uri, name).and_then(|text| text.parse().ok()).ok_or_else(refusal)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, name: &str) -> Option<u64> {
        number(&text.parse().unwrap(), name).ok()
    }

    #[test]
    fn numbers_are_read() {
        assert_eq!(read("/a?world=1&mesh=18446744073709551615", "world"), Some(1));
        assert_eq!(read("/a?world=1&mesh=18446744073709551615", "mesh"), Some(u64::MAX));
        assert_eq!(read("/a?x&=&world=2&world=3", "world"), Some(2));
    }

    #[test]
    fn what_is_no_number_is_refused() {
        for text in ["/a", "/a?", "/a?world", "/a?world=", "/a?world=-1", "/a?world=1.5"] {
            assert_eq!(read(text, "world"), None, "{text}");
        }
        for text in ["/a?worlds=1", "/a?world=18446744073709551616", "/a?world=%31"] {
            assert_eq!(read(text, "world"), None, "{text}");
        }
    }
}
