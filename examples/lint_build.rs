//! For a `build.rs`: lints the forms that ship with a program when the program is built. A finding makes the build
//! fail.

use std::path::Path;
use std::process::ExitCode;

use postform::diag::Severity;
use postform::{NoFiles, Post, Source};

fn main() -> ExitCode {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("postforms");
    println!("cargo::rerun-if-changed={}", folder.display());
    let mut ending = ExitCode::SUCCESS;
    for name in ["fanuc.pf", "haas.pf", "linuxcnc.pf"] {
        let Ok(bytes) = std::fs::read(folder.join(name)) else {
            println!("cargo::error={name} can't be read");
            return ExitCode::FAILURE;
        };
        let findings = match Post::compile(Source::from_bytes(name, &bytes), &NoFiles) {
            Ok(post) => post.findings().clone(),
            Err(error) => error.into_findings(),
        };
        for diag in findings.diags.iter().filter(|diag| diag.severity > Severity::Note) {
            println!("cargo::error={}", diag.line(&findings.files));
            ending = ExitCode::FAILURE;
        }
    }
    ending
}
