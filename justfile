# what CI does
ci:
    .ci/run

# rewrite expected programs and transcripts; read the difference before committing
overwrite:
    SAMPLES=overwrite cargo test --test it -- samples:: reference::
    TRYCMD=overwrite cargo test transcripts::

# how time and memory grow with the input: fails where they grow faster
growth:
    cargo build --release
    benches/growth.py target/release/postform

# figures for docs/performance.md
bench:
    cargo bench --bench render
    benches/throughput
