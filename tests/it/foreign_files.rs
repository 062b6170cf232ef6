//! A file that is neither a job nor a program is refused with its first bytes and what it seems to be.

use crate::support::folder::{Folder, err};

/// A file: its name, its first bytes, and what the message must contain.
const FILES: [(&str, &[u8], &[&str]); 18] = [
    ("part", b"%PDF-1.7\n%\xe2\xe3\n1 0 obj\n", &["the format of part is unknown: it begins with `%PDF-1.7`", "PDF"]),
    ("part.nc", b"%PDF-1.7\nGOTO/1,2,3\n", &["part.nc is not an NC program: it begins with `%PDF-1.7`", "PDF"]),
    ("part.json", b"%PDF-1.7\n", &["part.json is not a JSON document", "PDF", "`--from json`"]),
    ("part.cl", b"%!PS-Adobe-3.0\n", &["part.cl is not an APT CL file", "PS (PostScript)"]),
    (
        "part.nci",
        b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR",
        &["not a Mastercam NCI file", "`\\x89PNG\\r\\n\\x1a\\n\\x00", "PNG"],
    ),
    ("part.FCStd", b"\xff\xd8\xff\xe0\0\x10JFIF\0", &["not a FreeCAD document", "JPEG"]),
    ("part.jsonl", b"\x1f\x8b\x08\0\0\0\0\0", &["part.jsonl is not JSON Lines", "GZ (gzip)", "end its name with .gz"]),
    ("part.tap", b"MZ\x90\0\x03\0", &["part.tap is not an NC program", "MS-DOS Executable"]),
    (
        "zip.nc",
        b"PK\x03\x04\x14\0",
        &["zip.nc is not an NC program", "seems to be a FreeCAD document or another zip archive"],
    ),
    ("part", b"\xa0\xa0\xa0{", &["the format of part is unknown: it begins with `\\xa0\\xa0\\xa0{`"]),
    ("part.ngc", b"G\x000\0 \0", &["PN014"]),
    ("part.mpf", b"\xff\xfeG\x000\0", &["PN001", "the program is UTF-16", "save it as plain text"]),
    (
        "part.h",
        b"<!DOCTYPE html>\n<html>\n",
        &["part.h is not an NC program: it begins with `<!DOCTYPE html>`", "HTML"],
    ),
    ("part.step", b"ISO-10303-21;\nHEADER;\n", &["the format of part.step is unknown", "`ISO-10303-21;`", "STEP"]),
    ("part.stl", b"solid part\n facet normal 0 0 1\n", &["the format of part.stl is unknown", "STL"]),
    (
        "part.txt",
        b"Dear customer,\n",
        &["it begins with `Dear customer,`\n", "one of json, jsonl, cl, nc, freecad, nci"],
    ),
    (
        "cl.json",
        b"PARTNO X\nGOTO/1,2,3\n",
        &["cl.json is not a JSON document", "seems to be an APT CL file", "`--from cl`"],
    ),
    ("job.nc", b"{\"postform\": 1}", &["job.nc is not an NC program", "seems to be a JSON document", "`--from json`"]),
];

#[test]
fn a_file_that_is_no_job_is_refused_with_what_it_seems_to_be() {
    let folder = Folder::new("foreign-files");
    for (name, bytes, wanted) in FILES {
        folder.write(name, bytes);
        let output = folder.run(&["check", name]);
        let message = err(&output);
        assert!(matches!(output.status.code(), Some(1 | 2)), "{name}: {message}");
        for text in wanted {
            assert!(message.contains(text), "{name}: no `{text}` in\n{message}");
        }
    }
}

#[test]
fn commands_for_programs_refuse_other_files() {
    let folder = Folder::new("foreign-programs");
    for (name, bytes) in [
        ("part.pdf", &b"%PDF-1.7\n"[..]),
        ("part.nc", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR"),
        ("part.FCStd", b"PK\x03\x04\x14\0"),
    ] {
        folder.write(name, bytes);
        let output = folder.run(&["simulate", "--control", "haas", name]);
        let message = err(&output);
        assert_eq!(output.status.code(), Some(2), "{name}: {message}");
        assert!(message.contains(&format!("{name} is not an NC program: it begins with")), "{name}: {message}");
    }
}

/// A word of a program can be the signature of a format, and a comment can look like one.
#[test]
fn programs_that_begin_like_other_formats_are_read() {
    let folder = Folder::new("foreign-words");
    for head in ["MZ=3", "(module 3)", "P1 ", "ZOO=1", "%!", "MOVI", "BLENDER=2"] {
        folder.write("part.mpf", format!("{head}\nG0 X1\nM30\n"));
        let message = err(&folder.run(&["check", "part.mpf", "--assume-units", "mm"]));
        assert!(!message.contains("seems to be"), "{head}: {message}");
    }
}
