//! Prints several jobs with one post, each job on its own thread.

use std::thread;

use postform::{Error, Job, NoFiles, Options, Post, Source};

const FORM: &str = include_str!("../postforms/fanuc.pf");
const JOBS: [(&str, &str); 3] = [
    ("bracket", include_str!("../samples/bracket/job.json")),
    ("holes", include_str!("../samples/drill-machine/job.json")),
    ("sections", include_str!("../samples/sections/job.json")),
];

fn main() -> Result<(), Error> {
    let post = Post::compile(Source::from_text("fanuc.pf", FORM), &NoFiles)?;
    let threads = JOBS.map(|(name, job)| {
        let post = post.clone(); // the clone shares the form
        (name, thread::spawn(move || post.render(Job::json(job), &Options::default())))
    });
    for (name, thread) in threads {
        match thread.join() {
            Ok(Ok(program)) => println!("{name}: {} lines", program.text().lines().count()),
            Ok(Err(error)) => println!("{name}: {error}"),
            Err(_) => println!("{name}: stopped"),
        }
    }
    Ok(())
}
