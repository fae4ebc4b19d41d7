//! What one must know to be served.

use crate::error::ServeError;
use std::net::IpAddr;

/// Random bits of a fresh token: nobody guesses them.
const BITS: usize = 128;
/// A given token is not shorter.
const MIN_LENGTH: usize = 16;

/// What one must know to be served.
#[derive(Clone)]
pub(crate) struct Token(String);

impl Token {
    /// The token for an address: the given one; otherwise none at loopback addresses, and a fresh
    /// one where others can connect.
    pub(crate) fn choose(
        address: IpAddr,
        given: Option<String>,
    ) -> Result<Option<Self>, ServeError> {
        match given {
            Some(text) if is_sound(&text) => Ok(Some(Self(text))),
            Some(_) => Err(ServeError::Token),
            None if address.is_loopback() => Ok(None),
            None => Self::fresh().map(Some),
        }
    }

    /// A token that nobody can guess.
    pub(crate) fn fresh() -> Result<Self, ServeError> {
        let mut bytes = [0; BITS / 8];
        getrandom::fill(&mut bytes).map_err(|e| ServeError::Random(e.to_string()))?;
        Ok(Self(bytes.iter().map(|b| format!("{b:02x}")).collect()))
    }

    pub(crate) fn text(&self) -> &str {
        &self.0
    }

    /// Whether a text is the token. How long this takes tells nothing but the length.
    pub(crate) fn is(&self, text: &str) -> bool {
        let different = self.0.bytes().zip(text.bytes()).fold(0, |all, (a, b)| all | (a ^ b));
        self.0.len() == text.len() && std::hint::black_box(different) == 0
    }
}

fn is_sound(text: &str) -> bool {
    let is_plain = |b: u8| b.is_ascii_alphanumeric() || b == b'-' || b == b'_';
    text.len() >= MIN_LENGTH && text.bytes().all(is_plain)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::net::{Ipv4Addr, Ipv6Addr};

    #[test]
    fn only_loopback_goes_without() {
        let given = |address: IpAddr| Token::choose(address, None).unwrap().is_some();
        assert!(!given(Ipv4Addr::LOCALHOST.into()));
        assert!(!given(Ipv6Addr::LOCALHOST.into()));
        assert!(given(Ipv4Addr::UNSPECIFIED.into()));
        assert!(given(Ipv6Addr::UNSPECIFIED.into()));
        assert!(given(Ipv4Addr::new(192, 0, 2, 1).into()));
    }

    #[test]
    fn fresh_tokens_are_long_and_differ() {
        let (a, b) = (Token::fresh().unwrap(), Token::fresh().unwrap());
        assert_eq!(a.text().len(), BITS / 4);
        assert!(is_sound(a.text()) && a.text() != b.text());
    }

    #[test]
    fn only_the_token_is_the_token() {
        let token = Token("0123456789abcdef".to_owned());
        assert!(token.is("0123456789abcdef"));
        for other in ["", "0123456789abcde", "0123456789abcdeg", "0123456789abcdef0"] {
            assert!(!token.is(other), "{other}");
        }
    }

    #[test]
    fn poor_tokens_are_refused() {
        for poor in ["", "secret", "0123456789 abcdef", "0123456789abcde&", "0123456789abcdeé"] {
            let chosen = Token::choose(Ipv4Addr::LOCALHOST.into(), Some(poor.to_owned()));
            assert!(matches!(chosen, Err(ServeError::Token)), "{poor}");
        }
    }
}
