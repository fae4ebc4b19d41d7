//! The page, and what it may do in a browser.

use crate::answer::of_type;
use crate::error::ServeError;
use crate::token::Token;
use axum::body::Bytes;
use axum::http::header::CONTENT_SECURITY_POLICY;
use axum::http::{HeaderName, HeaderValue};
use axum::response::Response;
use std::borrow::Cow;

/// The page that is served. It must hold all it needs: scripts and styles inline, pictures as
/// `data:`, workers as `blob:`. Scripts stand between `<script` and `</script`, in small letters;
/// attributes like `onclick` are not run.
#[derive(Clone, Debug)]
pub struct Page {
    /// The page in HTML.
    pub html: Cow<'static, str>,
}

/// Where the page is found.
pub(crate) const PATHS: [&str; 2] = ["/", "/index.html"];

/// The page with leave for its own scripts only.
pub(crate) struct Sealed {
    html: Bytes,
    policy: HeaderValue,
}

impl Sealed {
    /// Marks the scripts of the page with a random word, so that no others are run.
    pub(crate) fn new(page: &Page) -> Result<Self, ServeError> {
        let word = Token::fresh()?;
        let policy = format!(
            "default-src 'none'; script-src 'nonce-{}'; worker-src blob:; \
             style-src 'unsafe-inline'; img-src data: blob:; connect-src 'self'; \
             base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
            word.text()
        );
        Ok(Self {
            html: Bytes::from(marked(&page.html, word.text())),
            policy: policy.try_into().expect("a policy of ASCII characters is a header"),
        })
    }

    pub(crate) fn response(&self) -> Response {
        let mut response = of_type("text/html; charset=utf-8", self.html.clone());
        let headers = response.headers_mut();
        headers.insert(CONTENT_SECURITY_POLICY, self.policy.clone());
        let opener = HeaderName::from_static("cross-origin-opener-policy");
        headers.insert(opener, HeaderValue::from_static("same-origin"));
        response
    }
}

/// HTML with a nonce in each script element. What stands inside scripts is left as it is.
fn marked(html: &str, nonce: &str) -> String {
    let mut out = String::with_capacity(html.len() + 64);
    let mut rest = html;
    while let Some((before, after)) = rest.split_once("<script") {
        out.push_str(before);
        out.push_str("<script");
        let is_element = after.starts_with(|c: char| c == '>' || c.is_ascii_whitespace());
        let script = if is_element { after.find("</script").unwrap_or(after.len()) } else { 0 };
        if is_element {
            out.push_str(&format!(" nonce=\"{nonce}\""));
        }
        out.push_str(&after[..script]);
        rest = &after[script..];
    }
    out + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scripts_are_marked_and_nothing_else() {
        for (html, expected) in [
            ("", ""),
            ("<p>a</p>", "<p>a</p>"),
            ("<script>a()</script>b", "<script nonce=\"n\">a()</script>b"),
            (
                "<script\ttype=\"module\">x='<script>'</script><script>b</script>",
                "<script nonce=\"n\"\ttype=\"module\">x='<script>'</script>\
                 <script nonce=\"n\">b</script>",
            ),
            ("<scripture>", "<scripture>"),
            ("<script>never closed", "<script nonce=\"n\">never closed"),
        ] {
            assert_eq!(marked(html, "n"), expected, "{html}");
        }
    }

    #[test]
    fn policy_and_page_have_the_same_word() {
        let page = Page { html: "<script>a</script>".into() };
        let sealed = Sealed::new(&page).unwrap();
        let policy = sealed.policy.to_str().unwrap();
        let word = policy.split("'nonce-").nth(1).unwrap().split('\'').next().unwrap();
        let html = format!("<script nonce=\"{word}\">a</script>");
        assert_eq!(sealed.html, html.as_bytes());
        assert!(!policy.split("style-src").next().unwrap().contains("unsafe"));
    }
}
