# what CI does
ci:
    .ci/run

# rewrite expected programs and transcripts; read the difference before committing
overwrite:
    SAMPLES=overwrite cargo test --test it -- samples:: reference::
    TRYCMD=overwrite cargo test transcripts::

# figures for docs/performance.md
bench:
    cargo bench --bench render
    benches/throughput
