//! Who is served: not the pages of others, and where others can connect only who knows the token.

use crate::answer::Refusal;
use crate::page;
use crate::query::parameter;
use crate::token::Token;
use axum::http::header::{AUTHORIZATION, HOST, ORIGIN};
use axum::http::request::Parts;
use axum::http::{HeaderMap, StatusCode};
use std::net::SocketAddr;

const TARGET: Refusal = Refusal::new(StatusCode::BAD_REQUEST, "ask for a path of this server");
const FOREIGN_HOST: Refusal =
    Refusal::new(StatusCode::FORBIDDEN, "this server is not known by that name: use its address");
const FOREIGN_PAGE: Refusal =
    Refusal::new(StatusCode::FORBIDDEN, "pages of other origins are not served");
const NO_TOKEN: Refusal = Refusal::new(
    StatusCode::UNAUTHORIZED,
    "open the whole address that was printed, with its token",
);

/// Decides who is served.
pub(crate) struct Guard {
    /// Names under which browsers may know the server. `None`: any, as a token tells friends.
    hosts: Option<Vec<String>>,
    token: Option<Token>,
}

impl Guard {
    /// For the address where the server listens. What others can reach must have a token.
    pub(crate) fn new(address: SocketAddr, token: Option<Token>) -> Self {
        debug_assert!(address.ip().is_loopback() || token.is_some(), "others need a token");
        Self { hosts: address.ip().is_loopback().then(|| hosts(address)), token }
    }

    /// Whether a request is served.
    pub(crate) fn admit(&self, request: &Parts) -> Result<(), Refusal> {
        let is_path = request.uri.authority().is_none() && request.uri.path().starts_with('/');
        let checks = [
            (is_path, TARGET),
            (self.knows_host(&request.headers), FOREIGN_HOST),
            (is_own_origin(&request.headers), FOREIGN_PAGE),
            (is_own_fetch(request), FOREIGN_PAGE),
            (self.knows_token(request), NO_TOKEN),
        ];
        checks.into_iter().find(|(passed, _)| !passed).map_or(Ok(()), |(_, refusal)| Err(refusal))
    }

    /// A foreign name that resolves to this machine shows itself in `Host` (DNS rebinding).
    fn knows_host(&self, headers: &HeaderMap) -> bool {
        let is_known = |host: &str| {
            self.hosts
                .as_ref()
                .is_none_or(|known| known.iter().any(|h| h.eq_ignore_ascii_case(host)))
        };
        only(headers, HOST.as_str()).is_ok_and(|host| host.is_some_and(is_known))
    }

    fn knows_token(&self, request: &Parts) -> bool {
        let Some(token) = &self.token else { return true };
        let header = only(&request.headers, AUTHORIZATION.as_str()).ok().flatten();
        let bearer = header.and_then(|text| text.strip_prefix("Bearer "));
        [bearer, parameter(&request.uri, "token")].into_iter().flatten().any(|t| token.is(t))
    }
}

/// Names of a server that listens at a loopback address.
fn hosts(address: SocketAddr) -> Vec<String> {
    let names = ["127.0.0.1", "localhost", "[::1]"];
    let port = address.port();
    let with_port = names.iter().map(|name| format!("{name}:{port}"));
    let bare = names.iter().filter(|_| port == 80).map(|name| (*name).to_owned());
    with_port.chain([address.to_string()]).chain(bare).collect()
}

/// The value of a header that may be given once; an error if it is given twice or not as text.
fn only<'a>(headers: &'a HeaderMap, name: &str) -> Result<Option<&'a str>, ()> {
    let mut values = headers.get_all(name).iter();
    match (values.next(), values.next()) {
        (None, _) => Ok(None),
        (Some(value), None) => value.to_str().map(Some).map_err(|_| ()),
        _ => Err(()),
    }
}

/// Browsers say with `Origin` which page asks.
fn is_own_origin(headers: &HeaderMap) -> bool {
    let own = only(headers, HOST.as_str()).ok().flatten().map(|host| format!("http://{host}"));
    match only(headers, ORIGIN.as_str()) {
        Ok(None) => true,
        Ok(Some(origin)) => own.is_some_and(|own| own.eq_ignore_ascii_case(origin)),
        Err(()) => false,
    }
}

/// Browsers say with `Sec-Fetch-Site` whether a page of ours asks, or the user. A link elsewhere
/// may lead to the page, as it acts on nothing by itself.
fn is_own_fetch(request: &Parts) -> bool {
    let is = |name, value| only(&request.headers, name) == Ok(Some(value));
    let is_visit = || {
        page::PATHS.contains(&request.uri.path())
            && is("sec-fetch-mode", "navigate")
            && is("sec-fetch-dest", "document")
    };
    match only(&request.headers, "sec-fetch-site") {
        Ok(None | Some("same-origin" | "none")) => true,
        Ok(Some(_)) => is_visit(),
        Err(()) => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use axum::http::Request;

    const TOKEN: &str = "0123456789abcdef";

    fn status(address: &str, token: Option<&str>, uri: &str, headers: &[(&str, &str)]) -> u16 {
        let address: SocketAddr = address.parse().unwrap();
        let token = Token::choose(address.ip(), token.map(str::to_owned)).unwrap();
        let request = headers.iter().fold(Request::get(uri), |r, (n, v)| r.header(*n, *v));
        let (parts, ()) = request.body(()).unwrap().into_parts();
        Guard::new(address, token).admit(&parts).map_or_else(|r| r.status.as_u16(), |()| 200)
    }

    fn at_home(headers: &[(&str, &str)]) -> u16 {
        status("127.0.0.1:8000", None, "/api/hello", headers)
    }

    #[test]
    fn own_names_are_known_and_foreign_ones_are_not() {
        for host in ["127.0.0.1:8000", "localhost:8000", "[::1]:8000", "LocalHost:8000"] {
            assert_eq!(at_home(&[("host", host)]), 200, "{host}");
        }
        for host in ["evil.example:8000", "127.0.0.1:8001", "localhost", "", "localhost:8000.evil"]
        {
            assert_eq!(at_home(&[("host", host)]), 403, "{host}");
        }
        assert_eq!(at_home(&[]), 403);
        assert_eq!(at_home(&[("host", "localhost:8000"), ("host", "localhost:8000")]), 403);
        assert_eq!(status("127.0.0.9:80", None, "/", &[("host", "127.0.0.9:80")]), 200);
        assert_eq!(status("127.0.0.1:80", None, "/", &[("host", "localhost")]), 200);
    }

    #[test]
    fn only_own_pages_are_served() {
        let host = ("host", "localhost:8000");
        assert_eq!(at_home(&[host, ("origin", "http://localhost:8000")]), 200);
        for origin in ["null", "http://evil.example", "https://localhost:8000", "http://localhost"]
        {
            assert_eq!(at_home(&[host, ("origin", origin)]), 403, "{origin}");
        }
        for (site, expected) in [
            ("same-origin", 200),
            ("none", 200),
            ("same-site", 403),
            ("cross-site", 403),
            ("", 403),
        ] {
            assert_eq!(at_home(&[host, ("sec-fetch-site", site)]), expected, "{site}");
        }
    }

    #[test]
    fn links_from_elsewhere_lead_to_the_page_only() {
        let visit = |uri, dest| {
            let headers = [
                ("host", "localhost:8000"),
                ("sec-fetch-site", "cross-site"),
                ("sec-fetch-mode", "navigate"),
                ("sec-fetch-dest", dest),
            ];
            status("127.0.0.1:8000", None, uri, &headers)
        };
        assert_eq!(visit("/", "document"), 200);
        assert_eq!(visit("/index.html?a=b", "document"), 200);
        assert_eq!(visit("/", "iframe"), 403);
        assert_eq!(visit("/api/hello", "document"), 403);
    }

    #[test]
    fn others_need_the_token() {
        let abroad = |uri: &str, headers: &[(&str, &str)]| {
            let headers = [&[("host", "any.example:8000")], headers].concat();
            status("192.0.2.1:8000", Some(TOKEN), uri, &headers)
        };
        assert_eq!(abroad("/api/hello?token=0123456789abcdef", &[]), 200);
        assert_eq!(abroad("/", &[("authorization", "Bearer 0123456789abcdef")]), 200);
        assert_eq!(abroad("/", &[]), 401);
        assert_eq!(abroad("/?token=", &[]), 401);
        assert_eq!(abroad("/?token=0123456789abcdeF", &[]), 401);
        assert_eq!(abroad("/", &[("authorization", "Basic 0123456789abcdef")]), 401);
        let foreign = [("origin", "http://evil.example")];
        assert_eq!(abroad("/?token=0123456789abcdef", &foreign), 403);
    }

    #[test]
    fn only_paths_are_served() {
        let host = [("host", "localhost:8000")];
        for uri in ["http://localhost:8000/", "http://evil.example/", "*", "evil.example:80"] {
            assert_eq!(status("127.0.0.1:8000", None, uri, &host), 400, "{uri}");
        }
    }
}
