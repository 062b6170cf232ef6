//! Messages between editor and server: a header with a length, then JSON.

use std::io::{BufRead, Read, Write};

use lsp_server::Message;

/// Largest message: a longer message is an error, and no memory is allocated for it.
const LARGEST: usize = 64 << 20;
/// Longest line of a header.
const LONGEST_HEADER: u64 = 4096;

/// The result of a read.
#[derive(Debug)]
pub enum Frame {
    /// A message.
    Message(Message),
    /// Invalid text; the next message can still be read.
    Malformed(String),
    /// The editor has closed the connection between two messages.
    Closed,
}

/// Reads a message.
///
/// # Errors
/// The reason why no further message can be read: its beginning is unknown.
pub fn read(input: &mut impl BufRead) -> Result<Frame, String> {
    let mut length = None;
    let mut first = true;
    loop {
        let mut line = Vec::new();
        let count =
            input.by_ref().take(LONGEST_HEADER).read_until(b'\n', &mut line).map_err(|error| error.to_string())?;
        match count {
            0 if first => return Ok(Frame::Closed),
            _ if !line.ends_with(b"\n") => return Err(cut_off("a header")),
            _ => first = false,
        }
        let line = String::from_utf8_lossy(&line);
        let line = line.trim_end_matches(['\r', '\n']);
        if line.is_empty() {
            break;
        }
        let Some((name, value)) = line.split_once(':') else {
            return Err(format!("`{}` is not a header such as `Content-Length: 123`", shown(line)));
        };
        if name.eq_ignore_ascii_case("Content-Length") {
            let value = value.trim();
            let number =
                value.parse::<usize>().map_err(|_| format!("`{}` is not the length of a message", shown(value)))?;
            length = Some(number);
        }
    }
    let length = length.ok_or("a message without Content-Length")?;
    if length > LARGEST {
        return Err(format!("a message of {length} bytes: the limit is {} MB", LARGEST >> 20));
    }
    let mut body = Vec::new();
    let got = input.by_ref().take(length as u64).read_to_end(&mut body).map_err(|error| error.to_string())?;
    if got < length {
        return Err(cut_off("a message"));
    }
    Ok(match serde_json::from_slice(&body) {
        Ok(message) => Frame::Message(message),
        Err(error) => Frame::Malformed(format!("this is not a JSON-RPC message: {error}")),
    })
}

fn cut_off(what: &str) -> String {
    format!("the connection ended inside {what}")
}

fn shown(text: &str) -> String {
    text.chars().take(40).collect()
}

/// Writes a message.
pub fn write(out: &mut impl Write, body: &serde_json::Value) -> std::io::Result<()> {
    let text = body.to_string();
    write!(out, "Content-Length: {}\r\n\r\n{text}", text.len())?;
    out.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(text: &str) -> Result<Frame, String> {
        read(&mut text.as_bytes())
    }

    #[test]
    fn a_message_is_read_whatever_its_other_headers() {
        let body = r#"{"jsonrpc":"2.0","id":1,"method":"shutdown"}"#;
        let text = format!("content-length: {}\r\nContent-Type: x\r\n\r\n{body}rest", body.len());
        assert!(matches!(frame(&text), Ok(Frame::Message(Message::Request(_)))));
        assert!(matches!(frame(""), Ok(Frame::Closed)));
    }

    #[test]
    fn what_is_no_message_is_said() {
        assert!(matches!(frame("Content-Length: 2\r\n\r\n[]"), Ok(Frame::Malformed(_))));
        assert!(frame("Content-Length: 99\r\n\r\n{").unwrap_err().contains("ended inside a message"));
        assert!(frame("Content-Len").unwrap_err().contains("ended inside a header"));
        assert!(frame("Content-Length: 99999999999\r\n\r\n").unwrap_err().contains("the limit is 64 MB"));
        assert!(frame("Content-Length: -1\r\n\r\n").unwrap_err().contains("not the length"));
        assert!(frame("\r\n").unwrap_err().contains("without Content-Length"));
        assert!(frame("hello\r\n").unwrap_err().contains("not a header"));
    }
}
