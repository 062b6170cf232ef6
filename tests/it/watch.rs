//! `postform watch`: the data for the page, and refused requests. The tests send requests as raw bytes, because a
//! client may be a program other than a browser.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{SocketAddr, TcpStream, UdpSocket};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::support::folder::{Folder, err};
use crate::support::root;

/// A running `postform watch`, which is killed at the end of the test.
struct Watch {
    child: Child,
    address: SocketAddr,
    token: String,
}

impl Drop for Watch {
    fn drop(&mut self) {
        _ = self.child.kill();
        _ = self.child.wait();
    }
}

struct Answer {
    status: u16,
    head: String,
    body: Vec<u8>,
}

impl Watch {
    /// Starts `postform watch` in a folder with a form and a job, with further arguments.
    fn new(folder: &Folder, arguments: &[&str]) -> Watch {
        Watch::of(folder, &[&["--job", "job.json"], arguments].concat())
    }

    /// Starts `postform watch` with only the jobs in the arguments.
    fn of(folder: &Folder, arguments: &[&str]) -> Watch {
        let mut child = Command::new(env!("CARGO_BIN_EXE_postform"))
            .args(["watch", "my.pf", "--no-open"])
            .args(arguments)
            .current_dir(&folder.0)
            .env("XDG_RUNTIME_DIR", folder.0.join("runtime"))
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.as_mut().unwrap()).read_line(&mut line).unwrap();
        let rest =
            line.trim().strip_prefix("http://").unwrap_or_else(|| panic!("the first line is the address: {line}"));
        let (address, token) = rest.split_once('/').unwrap();
        Watch { child, address: address.parse().unwrap(), token: token.trim_end_matches('/').to_owned() }
    }

    /// Sends bytes and reads the answer.
    fn send(&self, request: impl AsRef<[u8]>) -> Answer {
        let mut stream = TcpStream::connect(self.address).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
        _ = stream.write_all(request.as_ref()); // the server may refuse a request before it has read the whole request
        let mut bytes = Vec::new();
        _ = stream.read_to_end(&mut bytes);
        let end = bytes.windows(4).position(|four| four == b"\r\n\r\n").map_or(bytes.len(), |at| at + 4);
        let head = String::from_utf8_lossy(&bytes[..end]).into_owned();
        let status = head.get(9..12).and_then(|code| code.parse().ok()).unwrap_or(0);
        Answer { status, head, body: bytes[end..].to_vec() }
    }

    /// Sends a request as the page's own script does.
    fn post(&self, what: &str, body: &Value) -> Answer {
        let (address, token, body) = (self.address, &self.token, body.to_string());
        self.send(format!(
            "POST /{token}/{what} HTTP/1.1\r\nHost: {address}\r\nOrigin: http://{address}\r\nSec-Fetch-Site: same-origin\r\n\
             Content-Type: application/json\r\nContent-Length: {}\r\n\r\n{body}",
            body.len()
        ))
    }

    /// Opens a job with this name (as JSON) and this content.
    fn add(&self, name: &str, content: &[u8]) -> Answer {
        let (address, token) = (self.address, &self.token);
        let body = [name.as_bytes(), b"\n", content].concat();
        let head = format!(
            "POST /{token}/add HTTP/1.1\r\nHost: {address}\r\nOrigin: http://{address}\r\nSec-Fetch-Site: same-origin\r\n\
             Content-Type: application/octet-stream\r\nContent-Length: {}\r\n\r\n",
            body.len()
        );
        self.send([head.as_bytes(), &body].concat())
    }

    fn get(&self, path: &str) -> Answer {
        self.send(format!("GET {path} HTTP/1.1\r\nHost: {}\r\n\r\n", self.address))
    }

    fn scene(&self, texts: &Value) -> (Value, Vec<u8>) {
        let answer = self.post("scene", &json!({ "job": 0, "texts": texts }));
        assert_eq!(answer.status, 200, "{}", String::from_utf8_lossy(&answer.body));
        unpacked(&answer.body)
    }
}

/// The head of a scene, and its sections.
fn unpacked(bytes: &[u8]) -> (Value, Vec<u8>) {
    let mut scenes = scenes(bytes);
    assert_eq!(scenes.len(), 1, "the verdict on a small program comes with it");
    scenes.remove(0)
}

/// The heads and sections of consecutive scenes.
fn scenes(mut bytes: &[u8]) -> Vec<(Value, Vec<u8>)> {
    let mut found = Vec::new();
    while !bytes.is_empty() {
        assert_eq!(&bytes[..4], b"PFS2");
        let head = u32::from_le_bytes(bytes[4..8].try_into().unwrap()) as usize;
        let body = u64::from_le_bytes(bytes[8..16].try_into().unwrap()) as usize;
        let (this, after) = bytes[16..].split_at(head + body);
        found.push((serde_json::from_slice(&this[..head]).unwrap(), this[head..].to_vec()));
        bytes = after;
    }
    found
}

fn section<'a>(head: &Value, body: &'a [u8], name: &str) -> &'a [u8] {
    let place = &head["sections"][name];
    let [start, length] = [0, 1].map(|i| place[i].as_u64().unwrap() as usize);
    &body[start..start + length]
}

/// A folder with the bracket job and a form for it.
fn bracket(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("my.pf", fs::read(root().join("postforms/fanuc.pf")).unwrap());
    folder.write("job.json", fs::read(root().join("samples/bracket/job.json")).unwrap());
    folder
}

#[test]
fn the_page_is_one_file_that_asks_nobody_else() {
    let folder = bracket("watch-page");
    let watch = Watch::new(&folder, &[]);
    let answer = watch.get(&format!("/{}/", watch.token));
    assert_eq!(answer.status, 200);
    for field in [
        "Content-Type: text/html",
        "Cache-Control: no-store",
        "X-Content-Type-Options: nosniff",
        "Referrer-Policy: no-referrer",
        "X-Frame-Options: DENY",
        "Content-Security-Policy: frame-ancestors 'none'",
        "Cross-Origin-Resource-Policy: same-origin",
    ] {
        assert!(answer.head.contains(field), "{field}: {}", answer.head);
    }
    let page = String::from_utf8(answer.body).unwrap();
    assert!(page.contains("default-src 'none'; script-src 'sha256-"), "the page says what it may do");
    let elsewhere = page.match_indices("src=").chain(page.match_indices("href=\"http")).count();
    assert_eq!(elsewhere, 0, "nothing is loaded");
    assert_eq!(watch.token.len(), 32);
    let other = bracket("watch-page-other");
    assert_ne!(watch.token, Watch::new(&other, &[]).token, "each form has a token of its own");
}

#[test]
fn who_is_refused() {
    let folder = bracket("watch-refused");
    let watch = Watch::new(&folder, &[]);
    let (host, token) = (watch.address.to_string(), watch.token.clone());
    let own = format!("Host: {host}\r\nOrigin: http://{host}\r\nContent-Type: application/json\r\n");
    let body = r#"{"job":0}"#;
    let with = |head: &str| format!("{head}Content-Length: {}\r\n\r\n{body}", body.len());
    let long = "x".repeat(20_000);
    for (what, request, status) in [
        ("the page", format!("GET /{token}/ HTTP/1.1\r\nHost: {host}\r\n\r\n"), 200),
        ("as localhost", format!("GET /{token}/ HTTP/1.1\r\nHost: localhost:{}\r\n\r\n", watch.address.port()), 200),
        ("the page's own request", with(&format!("POST /{token}/scene HTTP/1.1\r\n{own}")), 200),
        ("no token", format!("GET / HTTP/1.1\r\nHost: {host}\r\n\r\n"), 404),
        ("another token", format!("GET /{}/ HTTP/1.1\r\nHost: {host}\r\n\r\n", "0".repeat(32)), 404),
        ("half a token", format!("GET /{}/ HTTP/1.1\r\nHost: {host}\r\n\r\n", &token[..16]), 404),
        ("another name of this machine", format!("GET /{token}/ HTTP/1.1\r\nHost: evil.example\r\n\r\n"), 403),
        ("this machine's, at no port", format!("GET /{token}/ HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n"), 403),
        ("no name", format!("GET /{token}/ HTTP/1.1\r\n\r\n"), 403),
        ("two names", format!("GET /{token}/ HTTP/1.1\r\nHost: {host}\r\nHost: evil.example\r\n\r\n"), 403),
        (
            "another page",
            with(&format!(
                "POST /{token}/scene HTTP/1.1\r\nHost: {host}\r\nOrigin: http://evil.example\r\nContent-Type: application/json\r\n"
            )),
            403,
        ),
        (
            "a page without a name",
            with(&format!(
                "POST /{token}/save HTTP/1.1\r\nHost: {host}\r\nOrigin: null\r\nContent-Type: application/json\r\n"
            )),
            403,
        ),
        (
            "nobody says from where",
            with(&format!("POST /{token}/save HTTP/1.1\r\nHost: {host}\r\nContent-Type: application/json\r\n")),
            403,
        ),
        (
            "a link of another page",
            format!("GET /{token}/ HTTP/1.1\r\nHost: {host}\r\nSec-Fetch-Site: cross-site\r\n\r\n"),
            403,
        ),
        (
            "a page of another port of this machine",
            format!("GET /{token}/ HTTP/1.1\r\nHost: {host}\r\nSec-Fetch-Site: same-site\r\n\r\n"),
            403,
        ),
        (
            "this address by TLS",
            with(&format!(
                "POST /{token}/save HTTP/1.1\r\nHost: {host}\r\nOrigin: https://{host}\r\nContent-Type: application/json\r\n"
            )),
            403,
        ),
        (
            "a form of a page",
            with(&format!(
                "POST /{token}/scene HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nContent-Type: text/plain\r\n"
            )),
            415,
        ),
        ("a file", format!("GET /{token}/my.pf HTTP/1.1\r\nHost: {host}\r\n\r\n"), 404),
        ("a way up", format!("GET /{token}/../my.pf HTTP/1.1\r\nHost: {host}\r\n\r\n"), 404),
        ("a way up, hidden", format!("GET /{token}/%2e%2e/%2e%2e/etc/passwd HTTP/1.1\r\nHost: {host}\r\n\r\n"), 404),
        ("another method", format!("DELETE /{token}/ HTTP/1.1\r\nHost: {host}\r\n\r\n"), 405),
        ("help without a question", format!("GET /{token}/help HTTP/1.1\r\nHost: {host}\r\n\r\n"), 405),
        ("a scene without a question", format!("GET /{token}/scene HTTP/1.1\r\nHost: {host}\r\n\r\n"), 405),
        (
            "what a browser asks first",
            format!("OPTIONS /{token}/save HTTP/1.1\r\nHost: {host}\r\nOrigin: http://evil.example\r\n\r\n"),
            403,
        ),
        ("no length", format!("POST /{token}/scene HTTP/1.1\r\n{own}\r\n{body}"), 411),
        (
            "two lengths",
            format!("POST /{token}/scene HTTP/1.1\r\n{own}Content-Length: 9\r\nContent-Length: 90\r\n\r\n{body}"),
            411,
        ),
        ("no number", format!("POST /{token}/scene HTTP/1.1\r\n{own}Content-Length: +9\r\n\r\n{body}"), 400),
        ("in pieces", format!("POST /{token}/scene HTTP/1.1\r\n{own}Transfer-Encoding: chunked\r\n\r\n0\r\n\r\n"), 501),
        (
            "a byte too large",
            format!("POST /{token}/scene HTTP/1.1\r\n{own}Content-Length: {}\r\n\r\n", (8 << 20) + 1),
            413,
        ),
        ("too large", format!("POST /{token}/scene HTTP/1.1\r\n{own}Content-Length: 99999999999\r\n\r\n"), 413),
        ("a long head", format!("GET /{token}/ HTTP/1.1\r\nHost: {host}\r\nCookie: {long}\r\n\r\n"), 431),
        ("a long path", format!("GET /{token}/{long} HTTP/1.1\r\nHost: {host}\r\n\r\n"), 431),
        ("many fields", format!("GET /{token}/ HTTP/1.1\r\nHost: {host}\r\n{}\r\n", "A: b\r\n".repeat(100)), 431),
        ("no request", "hello\r\n\r\n".to_owned(), 400),
        ("TLS", "\u{16}\u{3}\u{1}\u{2}\r\n\r\n".to_owned(), 400),
        ("no JSON", format!("POST /{token}/scene HTTP/1.1\r\n{own}Content-Length: 2\r\n\r\n[}}"), 400),
        (
            "more than is asked",
            format!("POST /{token}/scene HTTP/1.1\r\n{own}Content-Length: 20\r\n\r\n{{\"job\":0,\"path\":\"/\"}}"),
            400,
        ),
        (
            "a job that is not there",
            format!("POST /{token}/scene HTTP/1.1\r\n{own}Content-Length: 9\r\n\r\n{{\"job\":9}}"),
            422,
        ),
    ] {
        let answer = watch.send(&request);
        assert_eq!(answer.status, status, "{what}: {}", answer.head);
        assert!(!answer.head.contains("Access-Control"), "{what}: no other page may read an answer");
    }
}

/// Jobs that are opened in the page are kept in memory. Their names are never used as paths.
#[test]
fn jobs_are_opened_and_closed() {
    let folder = bracket("watch-jobs");
    let watch = Watch::new(&folder, &[]);
    let names = || watch.scene(&json!({})).0["jobs"].clone();
    let job = fs::read(root().join("samples/drill-machine/job.json")).unwrap();
    let before = names();
    assert_eq!(before.as_array().unwrap().len(), 1);
    for (name, content, tab) in [
        (r#""drill.json""#, &job[..], [1, 0]),
        (r#""../../my.pf.json""#, &job[..], [2, 0]),
        // a job with the same name is replaced
        (r#""drill.json""#, &job[..], [1, 1]),
        // recognised by its content
        (r#""drill""#, &job[..], [3, 0]),
        // a broken job is accepted: its tab shows the error
        (r#""empty.json""#, b"", [4, 0]),
    ] {
        let answer = watch.add(name, content);
        let added: Value = serde_json::from_slice(&answer.body).unwrap();
        assert_eq!((answer.status, &added), (200, &json!({ "tab": tab[0], "replaced": tab[1] == 1 })), "{name}");
    }
    assert_eq!(names(), json!([before[0], "drill.json", "my.pf.json", "drill", "empty.json"]));
    for (name, content, status, why) in [
        (r#""letter""#, &b"Dear customer"[..], 422, "the format of letter is unknown"),
        (r#""form.pf""#, b"Machine Mill", 422, "form.pf is a form, not a job"),
        (r#""job.json.gz""#, b"\x1f\x8b\x08", 422, "the compressed file is cut off"),
        (r#""..""#, b"{}", 422, "a job needs a name"),
        (r#""""#, b"{}", 422, "a job needs a name"),
        ("7", b"{}", 400, "no name of a job"),
        ("", b"", 400, "no name of a job"),
    ] {
        let answer = watch.add(name, content);
        let said = String::from_utf8_lossy(&answer.body).into_owned();
        assert!(answer.status == status && said.contains(why), "{name}: {} {said}", answer.status);
    }
    let shown = watch.post("scene", &json!({ "job": 1 }));
    let (head, body) = unpacked(&shown.body);
    assert_eq!(head["verdict"]["kind"], "proven", "{head}");
    assert!(section(&head, &body, "text").windows(3).any(|word| word == b"G81"));
    // a tab that has another name now is not closed
    watch.post("close", &json!({ "job": 1, "name": "my.pf.json" }));
    assert_eq!(names().as_array().unwrap().len(), 5);
    for _ in 0..4 {
        let name = names()[1].clone();
        assert_eq!(watch.post("close", &json!({ "job": 1, "name": name })).status, 200);
    }
    assert_eq!(names(), before);
    // after the last job is closed, the sample job is shown
    watch.post("close", &json!({ "job": 0, "name": before[0] }));
    assert_eq!(names(), json!(["the sample job"]));
}

/// The port is open only on this machine.
#[test]
fn nobody_else_can_connect() {
    let folder = bracket("watch-loopback");
    let watch = Watch::new(&folder, &[]);
    assert!(watch.address.ip().is_loopback());
    // the network address of this machine, if it has an address; no data is sent
    let socket = UdpSocket::bind("0.0.0.0:0").unwrap();
    let outside = socket.connect("192.0.2.1:9").and_then(|()| socket.local_addr()).map(|address| address.ip());
    if let Some(outside) = outside.ok().filter(|ip| !ip.is_loopback() && !ip.is_unspecified()) {
        let found = TcpStream::connect_timeout(&(outside, watch.address.port()).into(), Duration::from_secs(2));
        assert!(found.is_err(), "{outside} answers");
    }
}

/// Idle connections block other clients only for a short time. Clients beyond the maximum number get an answer that
/// explains this.
#[test]
fn idle_connections_are_bounded() {
    let folder = bracket("watch-idle");
    let watch = Watch::new(&folder, &[]);
    let idle: Vec<TcpStream> = (0..64).map(|_| TcpStream::connect(watch.address).unwrap()).collect();
    let until = Instant::now() + Duration::from_secs(30);
    let page = format!("/{}/", watch.token);
    while watch.get(&page).status != 503 {
        assert!(Instant::now() < until, "64 connections and one more");
    }
    drop(idle);
    while watch.get(&page).status != 200 {
        assert!(Instant::now() < until, "there is room again");
        sleep(Duration::from_millis(50));
    }
}

/// A request that arrives byte by byte has the same time limit as any other request.
#[test]
fn a_slow_request_is_ended() {
    let folder = bracket("watch-slow");
    let watch = Watch::new(&folder, &[]);
    let (host, token) = (watch.address, &watch.token);
    let body = format!(
        "POST /{token}/scene HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nContent-Type: application/json\r\nContent-Length: 900\r\n\r\n"
    );
    let slow = ["GET / HTTP/1.1\r\nA: ".to_owned(), body].map(|begins| {
        let mut stream = TcpStream::connect(watch.address).unwrap();
        stream.write_all(begins.as_bytes()).unwrap();
        stream.set_read_timeout(Some(Duration::from_millis(500))).unwrap();
        stream
    });
    let until = Instant::now() + Duration::from_secs(60);
    for mut stream in slow {
        let mut byte = [0];
        // bytes after the end may make the system discard the answer; the connection is closed in any case
        while stream.read(&mut byte).is_err_and(|error| error.kind() == std::io::ErrorKind::WouldBlock) {
            assert!(Instant::now() < until, "a request of any length of time");
            _ = stream.write_all(b"x");
        }
    }
    assert_eq!(watch.get(&format!("/{token}/")).status, 200);
}

/// The scene contains the program byte for byte, the origin of each block, and the verdict.
#[test]
fn the_scene_is_the_program() {
    let folder = bracket("watch-scene");
    let old = fs::read_to_string(root().join("samples/bracket/expected.fanuc.nc")).unwrap();
    folder.write("old.nc", old.replacen(" Z-.25 I", " Z-.2 I", 1));
    let watch = Watch::new(&folder, &["--against", "old.nc", "--job", "job.json"]);
    let (head, body) = watch.scene(&json!({}));
    assert!(section(&head, &body, "text") == old.as_bytes(), "as render prints it");
    assert_eq!(head["verdict"]["kind"], "proven");
    assert_eq!(head["form"]["files"], json!(["my.pf"]));
    assert_eq!(head["jobs"], json!(["job.json", "job.json"]));
    assert_eq!(head["against"]["blocks"], 1, "{}", head["against"]);
    assert!(section(&head, &body, "old/text") != old.as_bytes());
    let lines = old.lines().count();
    assert_eq!(section(&head, &body, "lineForm").len(), lines * 4);
    assert_eq!(section(&head, &body, "lineItem").len(), lines * 16);
    // the block of the tool change comes from the tool change line of the form
    let at = old.lines().position(|line| line.contains("T2 M6")).unwrap();
    let packed = i32::from_le_bytes(section(&head, &body, "lineForm")[at * 4..][..4].try_into().unwrap());
    let form = folder.read("my.pf");
    assert_eq!(form.lines().nth(packed as usize), Some("T[tool] M6"));
    let verdict = watch.post("verdict", &json!({ "job": 1 }));
    let verdict: Value = serde_json::from_slice(&verdict.body).unwrap();
    assert_eq!(verdict["kind"], "proven", "{verdict}");
}

/// Without `--job`, the page shows the jobs of postform.toml. If postform.toml names no jobs, the page shows the sample
/// job for the form's machine. Without `--date`, the date is the current day.
#[test]
fn without_a_job_there_is_one() {
    let folder = bracket("watch-sample");
    let dated = folder.read("my.pf").replacen("End", "(PRINTED [date])\nEnd", 1);
    folder.write("my.pf", &dated);
    let watch = Watch::of(&folder, &["--date", "2026-03-31"]);
    let (head, body) = watch.scene(&json!({}));
    assert_eq!(head["jobs"], json!(["the sample job"]));
    assert_eq!(head["verdict"]["kind"], "proven", "{}", head["verdict"]);
    let text = String::from_utf8(section(&head, &body, "text").to_vec()).unwrap();
    assert!(text.contains("(PRINTED 2026-03-31)"), "{text}");
    drop(watch);
    let (head, body) = Watch::of(&folder, &[]).scene(&json!({}));
    let text = String::from_utf8(section(&head, &body, "text").to_vec()).unwrap();
    assert!(text.contains("(PRINTED 2"), "{text}");
    folder.write("postform.toml", "jobs = [\"job.json\"]\n");
    let (head, _) = Watch::of(&folder, &[]).scene(&json!({}));
    assert_eq!(head["jobs"], json!(["job.json"]));
}

/// A program that the page already shows is not sent again, but its verdict is.
#[test]
fn the_same_program_is_not_sent_again() {
    let folder = bracket("watch-same");
    let watch = Watch::new(&folder, &[]);
    let (first, _) = watch.scene(&json!({}));
    let shown = &first["program"];
    let ask = |texts: &Value| unpacked(&watch.post("scene", &json!({ "job": 0, "texts": texts, "shown": shown })).body);
    let (again, body) = ask(&json!({ "my.pf": folder.read("my.pf").replacen("Name Fanuc", "Name My Fanuc", 1) }));
    assert_eq!((&again["same"], body.len(), &again["program"]), (&json!(true), 0, shown));
    assert_eq!(again["verdict"], first["verdict"]);
    // after an additional line before the sequences, all blocks come from other lines of the form
    let (other, body) = ask(&json!({ "my.pf": format!("# mine\n{}", folder.read("my.pf")) }));
    assert!(other["same"].is_null() && !body.is_empty() && other["program"] != *shown);
}

/// Typed text is used for the scene, but not written to the file.
#[test]
fn what_is_typed_is_shown_and_not_written() {
    let folder = bracket("watch-typed");
    let form = folder.read("my.pf");
    let watch = Watch::new(&folder, &[]);
    let (head, body) = watch.scene(&json!({ "my.pf": form.replace("T[tool] M6", "T[tool]  M6") }));
    let found = head["form"]["findings"].as_array().unwrap();
    let lost = found.iter().find(|found| found["code"] == "PF101").unwrap_or_else(|| panic!("{found:?}"));
    let line = form.lines().position(|line| line == "T[tool] M6").unwrap();
    assert_eq!(lost["labels"][0]["at"], json!([0, line, 9, line, 11]));
    assert_eq!(head["texts"][0], form.as_str(), "as it is on the disk");
    assert!(head["stopped"].is_null() || head["stopped"]["by"] == "form");
    if head["stopped"].is_null() {
        assert_eq!(head["saved"]["blocks"], 5, "{}", head["saved"]);
        assert!(!section(&head, &body, "text").is_empty());
    }
    assert_eq!(folder.read("my.pf"), form);
    // a name that is not a file of the form is ignored
    let (head, _) = watch.scene(&json!({ "/etc/passwd": "Name x" }));
    assert_eq!(head["verdict"]["kind"], "proven");
}

/// A long program is shown before it is proven.
#[test]
fn a_long_program_is_shown_before_it_is_proven() {
    let folder = bracket("watch-long");
    let moves: String = (0..20_000).map(|i| format!(r#",{{"line":[{},{},-1]}}"#, f64::from(i) / 8.0, i % 7)).collect();
    // in the order in which the reader expects the keys
    folder.write(
        "job.json",
        format!(
            r#"{{"postform":1,"program":1,"units":"mm","tools":[{{"number":1,"diameter":6}}],"operations":[{{"tool":1,"work":54,
            "spindle":{{"speed":8000,"direction":"cw"}},"feed":1500,"path":[{{"rapid":[0,0,20]}}{moves}]}}]}}"#
        ),
    );
    let watch = Watch::new(&folder, &[]);
    let form = folder.read("my.pf");
    for texts in [json!({}), json!({ "my.pf": form.replace("Name Fanuc 0i-M", "Name Mine") })] {
        let scenes = scenes(&watch.post("scene", &json!({ "job": 0, "texts": texts })).body);
        let (head, body) = &scenes[0];
        assert!(section(head, body, "text").len() > 256 << 10 && !head["picture"].is_null());
        let changed = scenes.iter().find_map(|(head, _)| head["saved"]["blocks"].as_u64());
        assert_eq!(changed, texts.get("my.pf").map(|_| 0));
        // the verdict is in the first scene or in a later one
        let mut said = scenes.iter().map(|(head, _)| &head["verdict"]).filter(|verdict| !verdict.is_null());
        let verdict = said.next_back().unwrap_or(&Value::Null);
        assert_eq!(verdict["kind"], "proven", "{verdict}");
    }
}

/// The typed text is compared with the form's current file, not with the file at the time when the page was opened.
#[test]
fn the_last_save_may_be_somebody_elses() {
    let folder = bracket("watch-saved");
    let form = folder.read("my.pf");
    let watch = Watch::new(&folder, &[]);
    let typed = json!({ "my.pf": form.replace("Name Fanuc 0i-M", "Name Mine") });
    let blocks = || watch.scene(&typed).0["saved"]["blocks"].clone();
    watch.scene(&json!({}));
    assert_eq!(blocks(), 0, "a name is not printed");
    folder.write("my.pf", form.replace("G40 G49 G80 G90", "G40 G49 G80 G90 G94"));
    let until = Instant::now() + Duration::from_secs(30);
    while blocks() != 1 {
        assert!(Instant::now() < until, "one block has another word");
        sleep(Duration::from_millis(50));
    }
}

/// Completion works with an incomplete word and shows values of the job; help explains a word.
#[test]
fn words_are_completed_and_explained() {
    let folder = bracket("watch-help");
    let watch = Watch::new(&folder, &[]);
    let form = folder.read("my.pf");
    let line = form.lines().position(|line| line.contains("G81")).unwrap();
    let ask = |texts: &Value, at: &Value| {
        let answer = watch.post("help", &json!({ "job": 0, "texts": texts, "at": at }));
        assert_eq!(answer.status, 200, "{}", String::from_utf8_lossy(&answer.body));
        serde_json::from_slice::<Value>(&answer.body).unwrap()
    };
    let old = form.lines().nth(line).unwrap();
    let (first, rest) = old.rsplit_once(' ').unwrap();
    let begun = format!("{first} R[vcl");
    let texts = json!({ "my.pf": form.replacen(old, &format!("{begun} {rest}"), 1) });
    let at = |column: usize, ask: &str| json!({ "file": "my.pf", "line": line, "column": column, "ask": ask });
    let found = ask(&texts, &at(begun.len(), "complete"));
    let vclear = found["list"].as_array().unwrap().iter().find(|found| found["label"] == "vclear").unwrap();
    assert_eq!(vclear["kind"], "variable");
    let detail = vclear["detail"].as_str().unwrap();
    assert!(detail.contains("0.1") && detail.contains("job"), "what it holds in the job: {detail}");
    assert!(vclear["info"].as_str().unwrap().contains("clearance plane"));
    let hover = ask(&json!({}), &at(old.find("[retplane]").unwrap() + 2, "hover"));
    assert!(hover["text"].as_str().unwrap().contains("retplane"), "{hover}");
    assert_eq!(ask(&json!({}), &json!({ "file": "other.pf", "line": 0, "column": 0, "ask": "hover" })), Value::Null);
}

/// For a wrong job, and for a form with errors, the scene contains the findings.
#[test]
fn what_is_wrong_is_in_the_scene() {
    let folder = bracket("watch-wrong");
    let watch = Watch::new(&folder, &[]);
    let (head, _) = watch.scene(&json!({ "my.pf": "Nmae x\nStartCode\n" }));
    assert_eq!(head["stopped"]["by"], "form");
    assert!(head["form"]["errors"].as_u64().unwrap() > 0 && head["picture"].is_null());
    folder.write("job.json", "{\"postform\": 1,");
    let (head, _) = watch.scene(&json!({}));
    assert_eq!(head["stopped"]["by"], "job", "{head}");
    fs::remove_file(folder.0.join("job.json")).unwrap();
    let gone = watch.post("scene", &json!({ "job": 0 }));
    let (head, _) = unpacked(&gone.body);
    assert_eq!(gone.status, 200, "the form is there");
    assert!(head["stopped"]["message"].as_str().unwrap().contains("can't read job.json"));
}

#[test]
fn only_the_form_is_written_and_only_on_save() {
    let folder = bracket("watch-save");
    let form = folder.read("my.pf");
    let watch = Watch::new(&folder, &[]);
    let save = |name: &str, text: &str, was: &str| {
        let answer = watch.post("save", &json!({ "name": name, "text": text, "was": was }));
        (answer.status, String::from_utf8_lossy(&answer.body).into_owned())
    };
    let new = form.replace("Name Fanuc 0i-M", "Name Mine");
    assert_eq!(save("my.pf", &new, &form), (200, String::new()));
    assert_eq!(folder.read("my.pf"), new);
    // files that do not belong to the form, and wrong names of files
    folder.write("other.pf", "Name x");
    for name in ["other.pf", "./my.pf", "../my.pf", "job.json", "", "/etc/passwd", "my.pf\0"] {
        assert_eq!(save(name, "x", "Name x").0, 404, "{name}");
    }
    // the file was saved by another program in the meantime
    assert_eq!(save("my.pf", &form, &form), (409, "the file has changed on the disk".to_owned()));
    assert_eq!(folder.read("my.pf"), new);
    // line ends and the byte order mark are kept
    folder.write("my.pf", format!("\u{feff}{}", form.replace('\n', "\r\n")));
    assert_eq!(save("my.pf", &new, &form).0, 200);
    assert_eq!(folder.read("my.pf"), format!("\u{feff}{}", new.replace('\n', "\r\n")));
    // a text that could not be read again is not written
    let (status, why) = save("my.pf", &"# x\n".repeat(200_000), &new);
    assert!(status == 409 && why.contains("larger than 512 KB"), "{why}");
    // a file in Windows-1252 keeps its encoding; a character that the encoding lacks is refused
    folder.write("my.pf", b"Name Fr\xe4se\n");
    assert_eq!(save("my.pf", "Name Fr\u{e4}sen \u{20ac}\n", "Name Fr\u{e4}se\n").0, 200);
    assert_eq!(fs::read(folder.0.join("my.pf")).unwrap(), b"Name Fr\xe4sen \x80\n");
    let (status, why) = save("my.pf", "Name \u{442}\n", "Name Fr\u{e4}sen \u{20ac}\n");
    assert!(status == 409 && why.contains("Windows-1252") && why.contains('\u{442}'), "{why}");
    assert_eq!(fs::read(folder.0.join("my.pf")).unwrap(), b"Name Fr\xe4sen \x80\n");
    let left =
        fs::read_dir(&folder.0).unwrap().filter(|entry| entry.as_ref().unwrap().file_name() != "runtime").count();
    assert_eq!(left, 4, "my.pf, job.json, other.pf, postform.toml, and nothing beside them");
}

#[test]
fn a_form_that_was_deleted_is_written_again() {
    let folder = bracket("watch-deleted");
    let form = folder.read("my.pf");
    let watch = Watch::new(&folder, &[]);
    assert_eq!(watch.post("scene", &json!({ "job": 0 })).status, 200);
    fs::remove_file(folder.0.join("my.pf")).unwrap();
    let gone = watch.post("scene", &json!({ "job": 0 }));
    assert!(gone.status == 410 && String::from_utf8_lossy(&gone.body).contains("can't read my.pf"));
    let save = |name: &str| watch.post("save", &json!({ "name": name, "text": form, "was": "" })).status;
    assert_ne!(save("other.pf"), 200);
    assert!(!folder.0.join("other.pf").exists());
    assert_eq!(save("my.pf"), 200);
    assert_eq!(folder.read("my.pf"), form);
    assert_eq!(watch.post("scene", &json!({ "job": 0 })).status, 200);
}

/// Port and token are stored, so that an open page connects again after a restart. Other users can't read the file. A
/// file that others can read is not used.
#[cfg(unix)]
#[test]
fn a_restart_has_the_address_of_before() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = bracket("watch-again");
    let address = |watch: &Watch| (watch.address, watch.token.clone());
    let first = address(&Watch::new(&folder, &[]));
    let second = Watch::new(&folder, &[]);
    assert_eq!(address(&second), first);
    // while another one runs: another port, the same token
    let third = Watch::new(&folder, &[]);
    assert_ne!(third.address, first.0);
    drop((second, third));
    let kept = fs::read_dir(folder.0.join("runtime/postform")).unwrap().next().unwrap().unwrap().path();
    let mode = |path: &std::path::Path| fs::metadata(path).unwrap().permissions().mode() & 0o777;
    assert_eq!((mode(&kept), mode(kept.parent().unwrap())), (0o600, 0o700));
    fs::set_permissions(&kept, fs::Permissions::from_mode(0o644)).unwrap();
    let token = Watch::new(&folder, &[]).token.clone();
    assert_ne!(token, first.1, "a token that others could read is no secret");
    for text in ["", "0 x", "99999 0123456789abcdef0123456789abcdef", "8080 <script>", "\u{0}"] {
        fs::write(&kept, text).unwrap();
        assert_eq!(Watch::new(&folder, &[]).token.len(), 32, "{text:?}");
    }
}

/// The page is notified when the form, the job or a called form changes.
#[test]
fn changes_are_told() {
    let folder = bracket("watch-changes");
    let form = folder.read("my.pf");
    folder.write("my.pf", format!("{form}\nCall part.pf\n"));
    folder.write("part.pf", "# nothing\n");
    let watch = Watch::new(&folder, &[]);
    let (address, token) = (watch.address, &watch.token);
    let mut stream = TcpStream::connect(address).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
    stream.write_all(format!("GET /{token}/events HTTP/1.1\r\nHost: {address}\r\n\r\n").as_bytes()).unwrap();
    let mut events = BufReader::new(stream).lines().map(Result::unwrap);
    assert!(events.by_ref().any(|line| line == ": here"), "the page is told that it is heard");
    sleep(Duration::from_millis(500));
    for (name, text) in [("part.pf", "# something\n"), ("job.json", "{}"), ("my.pf", "Name x\n")] {
        folder.write(name, text);
        assert!(events.by_ref().any(|line| line == "event: changed"), "{name}");
        sleep(Duration::from_millis(500));
    }
}

#[test]
fn how_watch_ends() {
    let folder = bracket("watch-ends");
    let taken = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    for (arguments, says) in [
        (vec!["no-such.pf", "--job", "job.json"], "can't read no-such.pf"),
        (vec!["my.pf", "--job", "-"], "standard input (-)"),
        (vec!["my.pf", "--job", "job.json", "--against", "no-such.nc"], "can't read no-such.nc"),
        (vec!["my.pf", "--job", "job.json", "--port", &port], "can't listen on port"),
        (vec!["my.pf", "--job", "job.json", "--port", "99999"], "99999"),
        (vec!["my.pf", "--job", "job.json", "--set", "nonsense"], "write a name"),
    ] {
        let output = folder.run(&[&["watch", "--no-open"], arguments.as_slice()].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(err(&output).contains(says), "{arguments:?}: {}", err(&output));
    }
}

/// `render --watch` prints again after every change. If there is an error, it waits, and the previous program stays.
#[test]
fn render_watches_its_files() {
    let folder = bracket("watch-render");
    let form = folder.read("my.pf");
    let arguments = ["render", "job.json", "--form", "my.pf", "-o", "part.nc", "--watch"];
    let mut child = Command::new(env!("CARGO_BIN_EXE_postform"))
        .args(arguments)
        .current_dir(&folder.0)
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut said = BufReader::new(child.stderr.take().unwrap()).lines().map(Result::unwrap);
    let mut waits =
        || said.by_ref().take_while(|line| !line.contains("waiting for changes")).collect::<Vec<_>>().join("\n");
    let said = waits();
    assert!(said.starts_with("equivalent: ") && said.lines().count() == 1, "{said}");
    let first = folder.read("part.nc");
    assert!(first.contains("N10 (G54 X"));
    sleep(Duration::from_millis(50));
    folder.write("my.pf", form.replace("Sequence#s N 10 10", "Sequence#s N 100 10"));
    let said = waits();
    assert!(said.starts_with("equivalent: ") && said.lines().count() == 1, "{said}");
    let second = folder.read("part.nc");
    assert!(second.contains("N100 (G54 X"), "{second}");
    folder.write("my.pf", "Nmae x\n");
    assert!(waits().contains("PF"), "what is wrong is said");
    assert_eq!(folder.read("part.nc"), second, "and the program stays");
    _ = child.kill();
    _ = child.wait();
}

/// `lint --watch` reports again after every change, also about a new form in a folder.
#[test]
fn lint_watches_its_folder() {
    let folder = Folder::new("watch-lint");
    folder.write("forms/a.pf", fs::read(root().join("postforms/fanuc.pf")).unwrap());
    let mut child = Command::new(env!("CARGO_BIN_EXE_postform"))
        .args(["lint", "forms", "--watch"])
        .current_dir(&folder.0)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let mut reports = BufReader::new(child.stdout.take().unwrap()).lines().map(Result::unwrap);
    let mut next = || reports.by_ref().find(|line| line.contains(" warning")).unwrap();
    assert!(next().starts_with("0 errors, 0 warnings"));
    sleep(Duration::from_millis(50));
    folder.write("forms/b.pf", "Nmae x\n");
    assert!(!next().starts_with("0 errors"));
    _ = child.kill();
    _ = child.wait();
    let both = folder.run(&["lint", "forms", "--watch", "--fix"]);
    assert_eq!(both.status.code(), Some(2), "who fixes does not wait");
    assert_eq!(folder.run(&["lint", "-", "--watch"]).status.code(), Some(2), "standard input can't be read again");
}
