//! File URIs as editors send them: `file:///home/ann/my%20post.pf`.

use std::path::{Path, PathBuf};

use gen_lsp_types::Uri;

/// The file of a URI; `None`: the URI names no file of this machine, such as `untitled:Untitled-1`.
pub fn path(uri: &Uri) -> Option<PathBuf> {
    let rest = uri.as_ref().strip_prefix("file://")?;
    let rest = rest.strip_prefix("localhost").unwrap_or(rest);
    if !rest.starts_with('/') {
        return None;
    }
    let bytes = decoded(rest)?;
    Some(of_bytes(bytes))
}

/// The URI of a file.
pub fn of_path(path: &Path) -> Uri {
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    let mut text = String::from("file://");
    let bytes = bytes_of(&absolute);
    if !bytes.starts_with(b"/") {
        text.push('/');
    }
    for &byte in &bytes {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'/' | b'-' | b'.' | b'_' | b'~' => text.push(char::from(byte)),
            _ => text += &format!("%{byte:02X}"),
        }
    }
    Uri(text)
}

/// The text without its escapes; `None`: an escape is invalid.
fn decoded(text: &str) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((&byte, behind)) = rest.split_first() {
        rest = behind;
        if byte == b'%' {
            let digits = std::str::from_utf8(rest.get(..2)?).ok()?;
            bytes.push(u8::from_str_radix(digits, 16).ok()?);
            rest = &rest[2..];
        } else {
            bytes.push(byte);
        }
    }
    Some(bytes).filter(|bytes| !bytes.contains(&0))
}

#[cfg(unix)]
fn of_bytes(bytes: Vec<u8>) -> PathBuf {
    use std::os::unix::ffi::OsStringExt;
    PathBuf::from(std::ffi::OsString::from_vec(bytes))
}

#[cfg(unix)]
fn bytes_of(path: &Path) -> Vec<u8> {
    use std::os::unix::ffi::OsStrExt;
    path.as_os_str().as_bytes().to_vec()
}

/// `/c:/posts` becomes `c:\posts`.
#[cfg(not(unix))]
fn of_bytes(bytes: Vec<u8>) -> PathBuf {
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let drive = text.get(2..3) == Some(":");
    PathBuf::from(if drive { text[1..].to_owned() } else { text })
}

#[cfg(not(unix))]
fn bytes_of(path: &Path) -> Vec<u8> {
    path.to_string_lossy().replace('\\', "/").into_bytes()
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn names_go_there_and_back() {
        for name in ["/a/b.pf", "/a b/ü#%.pf"] {
            assert_eq!(path(&of_path(Path::new(name))).as_deref(), Some(Path::new(name)));
        }
        assert_eq!(path(&Uri("file:///a%20b/c.pf".into())), Some("/a b/c.pf".into()));
        assert_eq!(path(&Uri("file://localhost/a.pf".into())), Some("/a.pf".into()));
    }

    #[test]
    fn a_name_that_is_not_utf_8_is_a_file_all_the_same() {
        let file = path(&Uri("file:///tmp/fr%E4se.pf".into())).unwrap();
        assert_eq!(bytes_of(&file), b"/tmp/fr\xe4se.pf");
        assert_eq!(of_path(&file), Uri("file:///tmp/fr%E4se.pf".into()));
    }

    #[test]
    fn what_is_no_file_is_none() {
        for name in
            ["untitled:Untitled-1", "file://server/share/a.pf", "file:///a%", "file:///a%zz", "file:///a%00", ""]
        {
            assert_eq!(path(&Uri(name.into())), None, "{name}");
        }
    }
}
