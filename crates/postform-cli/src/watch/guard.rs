//! Admits requests only from the page that this program served, and only from this machine.
//!
//! Any web site that is open in a browser can send requests to ports of the browser's machine, but the site does not
//! have the token. If the host name of a foreign site leads to this machine, the `Host` field contains that name. A
//! request with a body must come from the page's own origin.

use super::http::{Answer, Asked};

/// Bytes of randomness in a token.
const TOKEN: usize = 16;

/// The data for checking requests.
#[derive(Debug)]
pub struct Guard {
    /// The token of the page: the first part of the path, between two slashes.
    pub token: String,
    /// The allowed values of the `Host` field, such as 127.0.0.1:8080 and localhost:8080.
    hosts: [String; 2],
}

impl Guard {
    /// A guard for a port, with a new token.
    ///
    /// # Errors
    /// The system has no random numbers.
    pub fn new(port: u16) -> Result<Guard, String> {
        let mut random = [0; TOKEN];
        getrandom::fill(&mut random).map_err(|error| format!("error: can't get random numbers: {error}"))?;
        let token = random.iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Guard::with(token, port))
    }

    /// A guard with an existing token.
    pub fn with(token: String, port: u16) -> Guard {
        Guard { token, hosts: [format!("127.0.0.1:{port}"), format!("localhost:{port}")] }
    }

    /// The requested path after the token; empty for the page itself.
    ///
    /// # Errors
    /// The answer to a refused request.
    pub fn admit<'a>(&self, asked: &'a Asked) -> Result<&'a str, Answer> {
        match asked.field("host") {
            Some(Some(host)) if self.is_host(host) => {}
            _ => return Err(Answer::no(403, "this host is not served")),
        }
        let nothing = || Answer::no(404, "not found: use the address that postform watch printed");
        let (token, rest) = asked.path.strip_prefix('/').and_then(|path| path.split_once('/')).ok_or_else(nothing)?;
        if !same(token.as_bytes(), self.token.as_bytes()) {
            return Err(nothing());
        }
        let page = matches!(asked.field("sec-fetch-site"), None | Some(Some("same-origin" | "none")));
        if !page {
            return Err(Answer::no(403, "requests from other pages are refused"));
        }
        match asked.field("origin") {
            // a browser sends this field with every body; otherwise it may be missing
            None if asked.method != "POST" => {}
            Some(Some(origin)) if origin.strip_prefix("http://").is_some_and(|host| self.is_host(host)) => {}
            _ => return Err(Answer::no(403, "requests from other pages are refused")),
        }
        // a browser sends these types to another origin only after a preflight request, which is refused
        let kind = if rest == "add" { "application/octet-stream" } else { "application/json" };
        if asked.method == "POST" && asked.field("content-type") != Some(Some(kind)) {
            return Err(Answer::no(415, &format!("send {kind}")));
        }
        Ok(rest)
    }

    fn is_host(&self, host: &str) -> bool {
        self.hosts.iter().any(|known| known.eq_ignore_ascii_case(host))
    }
}

/// Compares two values in a time that does not depend on the position of the first difference.
fn same(a: &[u8], b: &[u8]) -> bool {
    a.len() == b.len() && a.iter().zip(b).fold(0, |differs, (a, b)| differs | (a ^ b)) == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(method: &str, path: &str, fields: &[(&str, &str)]) -> Asked {
        let fields = fields.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
        Asked { method: method.into(), path: path.into(), fields }
    }

    #[test]
    fn who_is_admitted() {
        let guard = Guard::with("abc".into(), 8080);
        let (host, own) = (("host", "127.0.0.1:8080"), ("origin", "http://localhost:8080"));
        let json = ("content-type", "application/json");
        let foreign = ("origin", "http://evil.example");
        let status = |asked: &Asked| guard.admit(asked).map_err(|answer| answer.status).map(str::to_owned);
        for (method, path, fields, expected) in [
            ("GET", "/abc/", vec![host], Ok("")),
            ("GET", "/abc/events", vec![host], Ok("events")),
            ("POST", "/abc/scene", vec![host, own, json], Ok("scene")),
            // a foreign host name that leads to this machine
            ("GET", "/abc/", vec![("host", "evil.example:8080")], Err(403)),
            ("GET", "/abc/", vec![("host", "127.0.0.1")], Err(403)),
            ("GET", "/abc/", vec![], Err(403)),
            ("GET", "/abc/", vec![host, host], Err(403)),
            // a wrong or missing token
            ("GET", "/", vec![host], Err(404)),
            ("GET", "/abd/", vec![host], Err(404)),
            ("GET", "/abc", vec![host], Err(404)),
            ("GET", "/abcd/", vec![host], Err(404)),
            ("GET", "http://127.0.0.1:8080/abc/", vec![host], Err(404)),
            // another page
            ("POST", "/abc/save", vec![host, json], Err(403)),
            ("POST", "/abc/save", vec![host, foreign, json], Err(403)),
            ("POST", "/abc/save", vec![host, ("origin", "null"), json], Err(403)),
            ("POST", "/abc/save", vec![host, ("origin", "https://127.0.0.1:8080"), json], Err(403)),
            ("POST", "/abc/save", vec![host, own, foreign, json], Err(403)),
            ("GET", "/abc/events", vec![host, foreign], Err(403)),
            ("GET", "/abc/", vec![host, ("sec-fetch-site", "cross-site")], Err(403)),
            ("GET", "/abc/", vec![host, ("sec-fetch-site", "same-site")], Err(403)),
            // requests that the form of any web page can send
            ("POST", "/abc/save", vec![host, own, ("content-type", "text/plain")], Err(415)),
            ("POST", "/abc/save", vec![host, own], Err(415)),
            ("POST", "/abc/add", vec![host, own, ("content-type", "text/plain")], Err(415)),
            ("POST", "/abc/add", vec![host, own, json], Err(415)),
            ("POST", "/abc/add", vec![host, own, ("content-type", "application/octet-stream")], Ok("add")),
            ("POST", "/abc/save", vec![host, own, ("content-type", "application/octet-stream")], Err(415)),
        ] {
            assert_eq!(
                status(&asked(method, path, &fields)),
                expected.map(str::to_owned),
                "{method} {path} {fields:?}"
            );
        }
    }

    #[test]
    fn each_guard_has_a_token_of_its_own() {
        let [a, b] = [Guard::new(1), Guard::new(1)].map(|guard| guard.unwrap().token);
        assert!(a.len() == 32 && a != b, "{a} {b}");
    }
}
