# what CI does
ci:
    .ci/run

# rewrite expected programs and transcripts; read the difference before committing
overwrite:
    SAMPLES=overwrite cargo test --test it -- samples:: reference:: verdicts::
    TRYCMD=overwrite cargo test transcripts::

# how time and memory grow with the input: fails where they grow faster
growth:
    cargo build --profile dist
    benches/growth.py target/dist/postform

# random jobs through all forms, right programs made wrong, and blocks inserted: what comparing gets wrong is printed
hunt jobs="1000000" programs="20000" inserted="20000" seed="0":
    git rev-parse --short HEAD; date -u +%F
    cargo run --quiet --release --locked --manifest-path fuzz/Cargo.toml --bin jobs {{jobs}} {{seed}}
    cargo run --quiet --release --locked --manifest-path fuzz/Cargo.toml --bin programs {{programs}} {{seed}}
    cargo run --quiet --release --locked --manifest-path fuzz/Cargo.toml --bin programs {{inserted}} {{seed}} all all insert

# the same for one kind of job: mill, rotary, subprograms, lathe, wire, cl, nc, freecad
hunt-kind kind jobs="20000" programs="5000" seed="0":
    cargo run --quiet --release --locked --manifest-path fuzz/Cargo.toml --bin jobs {{jobs}} {{seed}} {{kind}}
    cargo run --quiet --release --locked --manifest-path fuzz/Cargo.toml --bin programs {{programs}} {{seed}} {{kind}}

# random turning programs through an executor of their own, and the same with a mistake
hunt-turning programs="20000" changed="12000" seed="0":
    cargo run --quiet --release --locked --manifest-path fuzz/Cargo.toml --bin turning {{programs}} {{seed}}
    cargo run --quiet --release --locked --manifest-path fuzz/Cargo.toml --bin turning {{changed}} {{seed}} fanuc-lathe change
    cargo run --quiet --release --locked --manifest-path fuzz/Cargo.toml --bin turning {{changed}} {{seed}} haas-lathe change

# 30 mistakes in each of three forms: which the standard cases see
broken-forms:
    BROKEN=30 cargo test --test it -- cases::the_standard_cases_see_broken_forms --nocapture

# ten million of them: a night
hunt-long:
    just hunt 10000000 1000000 1000000

# what the proof costs: render with it and without it, in turn
proof-cost:
    cargo build --profile dist --bin postform --example floor
    benches/proof.py target/dist/postform target/dist/examples/floor

# two binaries of postform for the same work, in turn: ratios of their CPU times
pairs old new runs="7":
    cargo build --profile dist --example floor
    benches/pairs.py {{old}} {{new}} {{runs}}

# mutated jobs of all formats through their readers: a panic is printed with its seed
readers count="1000000" seed="0":
    git rev-parse --short HEAD; date -u +%F
    cargo run --quiet --release --locked --manifest-path fuzz/Cargo.toml --bin readers {{count}} {{seed}}

# small changes of a source file that no test notices, by the tests with these names: `just mutants src/number/quantise.rs numbers`
mutants file *tests:
    cargo run --quiet --release --locked --manifest-path fuzz/Cargo.toml --bin mutants {{file}} {{tests}}

# figures for docs/performance.md
bench:
    cargo bench --profile dist --bench render
    benches/throughput

# beside other programs that do the same (awk, C++, rs274, GNU diff), in one run: ratios for docs/performance.md
compare count="1000000":
    benches/compare {{count}}

# the post for FreeCAD's window, inside FreeCAD (installs Debian's): its programs are those of the saved documents
freecad:
    integrations/freecad/run

# the page, from page/src; what is built is in the repository
page:
    cd page && npm ci --ignore-scripts --no-audit --no-fund && npm run check && npm run build

# the page in a real browser
page-test: page
    cargo build --locked
    cd page && node test/page.mjs

# the page with the bracket, a hundred thousand moves and a million: figures for docs/performance.md
page-figures: page
    cargo build --profile dist --locked
    cd page && POSTFORM=../target/dist/postform node test/figures.mjs

# the page without a server, in docs/playground
playground:
    docs/playground/build
    cd page && node test/playground.mjs

# the configuration of editors/neovim.md in a headless Neovim
look-neovim:
    cargo build
    editors/neovim-test target/debug/postform

# the configuration of editors/emacs.md in Emacs without a window
look-emacs:
    cargo build
    editors/emacs-test target/debug/postform

# the extension for VS Code as one file, editors/vscode/postform.vsix
vsix:
    cd editors/vscode && npm ci && npm run check && npm test && npm run package

# that file in a real VS Code (`npm install code-server` with node 24), pictures into FOLDER: too heavy for CI
vscode-shot code-server="code-server" folder="docs/images": vsix
    cargo build
    node editors/vscode/look.mjs {{code-server}} target/debug/postform {{folder}}

# the documentation as a site with search, in target/site; its links are checked (needs mdbook)
site:
    docs/site

# the packages that the toolchain here can build, each installed in a clean place and run
dist:
    packages/build
    packages/try

# licences, sources and known vulnerabilities of the crates
dependencies:
    packages/dependencies

# how often postform takes each of its branches, for `just dist`: target/postform.profdata
profile:
    packages/profile

# 10,000 jobs in one command beside a loop of a shell: a ratio
many-jobs count="10000":
    cargo build --profile dist --locked --bin postform
    benches/many_jobs target/dist/postform {{count}}

# everything that tries to break postform, as a table for docs/reliability.md; 5 runs a twentieth of it
campaign percent="100":
    fuzz/campaign {{percent}}
