//! Follows docs/guide.md like a reader: writes its files into an empty folder, runs its commands there, and compares
//! their output with the guide. `TRYCMD=overwrite cargo test guide::` writes the outputs into the guide again.

use crate::support;
use std::fs;
use std::path::Path;
use std::process::Command;

use crate::support::root;

#[test]
fn every_step_does_what_the_guide_shows() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("guide");
    _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    // until the guide writes its own postform.toml, an empty postform.toml hides the files of the folders above
    fs::write(folder.join("postform.toml"), "").unwrap();
    let path = root().join("docs/guide.md");
    let text = fs::read_to_string(&path).unwrap();
    let mut made = String::new();
    let (mut files, mut commands) = (0, 0);
    let mut rest = text.as_str();
    while let Some((before, fenced)) = rest.split_once("\n```") {
        let (head, body) = fenced.split_once('\n').unwrap();
        let (body, after) = body.split_once("\n```\n").unwrap_or_else(|| panic!("a fence without its end: {head}"));
        made += &format!("{before}\n```{head}\n");
        match head.split_once(' ') {
            Some((_, name)) => {
                fs::write(folder.join(name), format!("{body}\n")).unwrap();
                files += 1;
                made += body;
            }
            None => {
                assert!(head == "text" && body.starts_with("$ "), "a fence that is neither file nor command: {head}");
                let lines = body.lines().filter_map(|line| line.strip_prefix("$ postform "));
                let outputs: Vec<String> = lines.map(|line| run(&folder, line)).collect();
                commands += outputs.len();
                made += outputs.join("").trim_end();
            }
        }
        made += "\n```\n";
        // the line end belongs to the following text
        rest = &rest[rest.len() - after.len()..];
    }
    made += rest;
    assert!(files >= 7 && commands >= 14, "{files} files, {commands} commands");
    if std::env::var("TRYCMD").is_ok_and(|v| v == "overwrite") {
        fs::write(&path, &made).unwrap();
    }
    support::assert_same("docs/guide.md", &text, &made);
}

/// The output of a command as on a terminal.
fn run(folder: &Path, line: &str) -> String {
    let mut args: Vec<&str> = line.split(' ').collect();
    args.retain(|arg| !arg.is_empty());
    let output = Command::new(env!("CARGO_BIN_EXE_postform")).args(args).current_dir(folder).output().unwrap();
    assert_ne!(output.status.code(), Some(2), "{line}: {}", String::from_utf8_lossy(&output.stderr));
    let text = [output.stderr, output.stdout].map(|bytes| String::from_utf8(bytes).unwrap()).concat();
    format!("$ postform {line}\n{text}")
}
