//! The small part of HTTP that one page on one machine needs. A request is read within limits, an answer is written, and the
//! connection is closed. `httparse` parses the head of a request.

use std::io::{self, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

/// Longest head of a request.
const LONGEST_HEAD: usize = 16 << 10;
/// Largest body of a request about forms: their texts, as JSON.
pub const LARGEST_BODY: usize = 8 << 20;
/// Largest job that can be opened in the page.
pub const LARGEST_JOB: usize = 512 << 20;
/// Maximum number of fields in a head.
const MOST_FIELDS: usize = 64;
/// A request that takes longer than this time is refused.
const PATIENCE: Duration = Duration::from_secs(10);

/// A request.
#[derive(Debug, Default, PartialEq)]
pub struct Asked {
    /// `GET`, `POST`.
    pub method: String,
    /// The path as sent.
    pub path: String,
    /// The fields of the head: names in lower case, and values.
    pub fields: Vec<(String, String)>,
}

impl Asked {
    /// A field of the head; `Some(None)`: the head contains it more than once.
    pub fn field(&self, name: &str) -> Option<Option<&str>> {
        let mut found = self.fields.iter().filter(|(known, _)| known == name).map(|(_, value)| value.as_str());
        let first = found.next()?;
        Some(if found.next().is_some() { None } else { Some(first) })
    }
}

/// An answer.
#[derive(Debug)]
pub struct Answer {
    /// 200, 404.
    pub status: u16,
    /// The `Content-Type` of the answer.
    pub kind: &'static str,
    /// The content after the head.
    pub body: Vec<u8>,
    /// Further fields of the head of the answer.
    pub fields: Vec<(&'static str, String)>,
}

impl Answer {
    /// A successful answer.
    pub fn of(kind: &'static str, body: impl Into<Vec<u8>>) -> Answer {
        Answer { status: 200, kind, body: body.into(), fields: Vec::new() }
    }

    /// A refusal with its reason.
    pub fn no(status: u16, why: &str) -> Answer {
        Answer { status, ..Answer::of("text/plain; charset=utf-8", why) }
    }
}

/// Reads the head of a request, and the part of the body that was received with it.
///
/// # Errors
/// The answer to an invalid, too long or too slow request. `None`: the connection ended, so no answer is needed.
pub fn read_head(stream: &mut TcpStream) -> Result<(Asked, Vec<u8>), Option<Answer>> {
    let until = Instant::now() + PATIENCE;
    let mut bytes = Vec::new();
    loop {
        let mut fields = [httparse::EMPTY_HEADER; MOST_FIELDS];
        let mut request = httparse::Request::new(&mut fields);
        match request.parse(&bytes) {
            Ok(httparse::Status::Complete(length)) => {
                let asked = Asked {
                    method: request.method.unwrap_or_default().to_owned(),
                    path: request.path.unwrap_or_default().to_owned(),
                    fields: request.headers.iter().map(field).collect(),
                };
                bytes.drain(..length);
                return Ok((asked, bytes));
            }
            Ok(httparse::Status::Partial) if bytes.len() < LONGEST_HEAD => {}
            Ok(httparse::Status::Partial) | Err(httparse::Error::TooManyHeaders) => {
                return Err(Some(Answer::no(431, "the head of the request is too long")));
            }
            Err(_) => return Err(Some(Answer::no(400, "this is not an HTTP request"))),
        }
        more(stream, &mut bytes, LONGEST_HEAD, until)?;
    }
}

fn field(header: &httparse::Header<'_>) -> (String, String) {
    (header.name.to_ascii_lowercase(), String::from_utf8_lossy(header.value).trim().to_owned())
}

/// Reads the body of a request, of at most `most` bytes; `read` is the part that was already received.
///
/// # Errors
/// As [`read_head`].
pub fn read_body(
    stream: &mut TcpStream,
    asked: &Asked,
    mut read: Vec<u8>,
    most: usize,
) -> Result<Vec<u8>, Option<Answer>> {
    if asked.field("transfer-encoding").is_some() {
        return Err(Some(Answer::no(501, "send the body in one piece, with its length")));
    }
    let Some(Some(length)) = asked.field("content-length") else {
        return Err(Some(Answer::no(411, "send the length of the body")));
    };
    let digits = !length.is_empty() && length.bytes().all(|byte| byte.is_ascii_digit());
    let Some(length) = length.parse::<usize>().ok().filter(|_| digits) else {
        return Err(Some(Answer::no(400, "the length of the body is not a number")));
    };
    if length > most {
        return Err(Some(Answer::no(413, "the body is too large")));
    }
    let until = Instant::now() + PATIENCE;
    while read.len() < length {
        more(stream, &mut read, length, until)?;
    }
    read.truncate(length);
    Ok(read)
}

/// Reads more bytes, at most up to a length.
fn more(stream: &mut TcpStream, bytes: &mut Vec<u8>, most: usize, until: Instant) -> Result<(), Option<Answer>> {
    let slow = || Some(Answer::no(408, "the request took too long"));
    let left = until.saturating_duration_since(Instant::now());
    if left.is_zero() || stream.set_read_timeout(Some(left)).is_err() {
        return Err(slow());
    }
    let mut part = [0; 16 << 10];
    let room = most.saturating_sub(bytes.len()).clamp(1, part.len());
    match stream.read(&mut part[..room]) {
        Ok(0) => Err(None),
        Ok(count) => {
            bytes.extend_from_slice(&part[..count]);
            Ok(())
        }
        Err(error) if error.kind() == io::ErrorKind::Interrupted => Ok(()),
        Err(error) if matches!(error.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut) => Err(slow()),
        Err(_) => Err(None),
    }
}

/// Fields of every answer: browsers must not store the answer or guess its type, and other pages must not embed or read
/// the answer.
const ALWAYS: &str = "Connection: close\r\nCache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n\
    Referrer-Policy: no-referrer\r\nCross-Origin-Resource-Policy: same-origin\r\nCross-Origin-Opener-Policy: same-origin\r\n\
    X-Frame-Options: DENY\r\n";

/// Writes an answer. If the client has closed the connection, the answer is dropped.
pub fn write(stream: &mut TcpStream, answer: &Answer) {
    let mut head = format!(
        "HTTP/1.1 {} {}\r\n{ALWAYS}Content-Type: {}\r\nContent-Length: {}\r\n",
        answer.status,
        reason(answer.status),
        answer.kind,
        answer.body.len()
    );
    for (name, value) in &answer.fields {
        head += &format!("{name}: {value}\r\n");
    }
    head += "\r\n";
    _ = stream.set_write_timeout(Some(PATIENCE));
    if stream.write_all(head.as_bytes()).and_then(|()| stream.write_all(&answer.body)).is_ok() {
        _ = stream.flush();
    }
}

/// Writes the head of an answer that ends with the connection.
///
/// # Errors
/// The client has closed the connection.
pub fn begin(stream: &mut TcpStream, kind: &str) -> io::Result<()> {
    stream.set_write_timeout(Some(PATIENCE))?;
    // parts are sent at once, however small they are
    stream.set_nodelay(true)?;
    stream.write_all(format!("HTTP/1.1 200 OK\r\n{ALWAYS}Content-Type: {kind}\r\n\r\n").as_bytes())
}

fn reason(status: u16) -> &'static str {
    match status {
        200 => "OK",
        400 => "Bad Request",
        403 => "Forbidden",
        404 => "Not Found",
        405 => "Method Not Allowed",
        408 => "Request Timeout",
        409 => "Conflict",
        410 => "Gone",
        411 => "Length Required",
        413 => "Content Too Large",
        415 => "Unsupported Media Type",
        422 => "Unprocessable Content",
        431 => "Request Header Fields Too Large",
        501 => "Not Implemented",
        503 => "Service Unavailable",
        _ => "Error",
    }
}
