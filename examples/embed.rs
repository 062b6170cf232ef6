//! Prints and proves a job in ten lines of code.

use postform::{Error, Job, NoFiles, Options, Post, Source};

const FORM: &str = include_str!("../postforms/haas.pf");
const JOB: &str = include_str!("../samples/bracket/job.json");

fn main() -> Result<(), Error> {
    let post = Post::compile(Source::from_text("haas.pf", FORM), &NoFiles)?;
    let program = post.render(Job::json(JOB), &Options::default())?;
    print!("{}", program.text());
    eprintln!("{}", program.verdict());
    Ok(())
}
