//! Files whose names end with `.gz`: they are read and written like uncompressed files.

use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use flate2::Compression;
use flate2::read::MultiGzDecoder;
use flate2::write::GzEncoder;

/// The name without its `.gz`. `None`: the name does not end with `.gz`.
pub fn unpacked_name(path: &Path) -> Option<PathBuf> {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("gz")).then(|| path.with_extension(""))
}

/// The text of a compressed file.
pub fn unpacked(file: impl Read) -> impl Read {
    Named(MultiGzDecoder::new(file))
}

/// An encoder whose output contains no date and no name, so that equal texts give equal outputs.
pub fn packing() -> GzEncoder<Vec<u8>> {
    GzEncoder::new(Vec::new(), Compression::default())
}

/// Compresses a part and passes on the finished bytes.
///
/// # Errors
/// As reported by `write`.
pub fn pack(
    encoder: &mut GzEncoder<Vec<u8>>,
    bytes: &[u8],
    write: impl FnOnce(&[u8]) -> io::Result<()>,
) -> io::Result<()> {
    encoder.write_all(bytes)?;
    write(&std::mem::take(encoder.get_mut()))
}

/// The decoder has the same error for a file that ends too early, and for a few bytes after the end of a complete file.
const CUT_OFF: &str = "the compressed file is cut off, or other bytes follow its end";

/// A reader with error messages about the compressed file.
struct Named<R>(R);

impl<R: Read> Read for Named<R> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        self.0.read(out).map_err(|error| match error.kind() {
            io::ErrorKind::UnexpectedEof => io::Error::new(error.kind(), CUT_OFF),
            io::ErrorKind::InvalidInput | io::ErrorKind::InvalidData => {
                io::Error::new(error.kind(), format!("the file is not a gzip file, or the file is damaged: {error}"))
            }
            _ => error,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn packed(text: &[u8]) -> Vec<u8> {
        let mut all = Vec::new();
        let mut encoder = packing();
        for part in text.chunks(1000) {
            pack(&mut encoder, part, |bytes| all.write_all(bytes)).unwrap();
        }
        all.extend(encoder.finish().unwrap());
        all
    }

    #[test]
    fn text_comes_back_and_a_cut_file_is_an_error() {
        let text: Vec<u8> = (0..100_000u32).flat_map(|n| n.to_string().into_bytes()).collect();
        let file = packed(&text);
        assert_eq!(file, packed(&text));
        let mut read = Vec::new();
        unpacked(&file[..]).read_to_end(&mut read).unwrap();
        assert!(read == text);
        let error = unpacked(&file[..file.len() / 2]).read_to_end(&mut Vec::new()).unwrap_err();
        assert_eq!(error.to_string(), CUT_OFF);
        let error = unpacked(&[&file[..], b"\r\n"].concat()[..]).read_to_end(&mut Vec::new()).unwrap_err();
        assert_eq!(error.to_string(), CUT_OFF);
        let error = unpacked(&b"G0 X1\nG1 X2 F100\n"[..]).read_to_end(&mut Vec::new()).unwrap_err();
        assert!(error.to_string().starts_with("the file is not a gzip file"), "{error}");
    }

    #[test]
    fn names() {
        assert_eq!(unpacked_name(Path::new("a/part.cl.gz")), Some(PathBuf::from("a/part.cl")));
        assert_eq!(unpacked_name(Path::new("part.GZ")), Some(PathBuf::from("part")));
        assert_eq!(unpacked_name(Path::new("part.cl")), None);
    }
}
