//! `mutants FILE [TEST ...]` checks whether a test fails for every small change of a source file.
//!
//! All changes are compiled at once into a copy of the repository, each under a number. The environment variable
//! `POSTFORM_MUTANT` selects one change, so the given tests are built only once and run once for each change. A change
//! that no test notices is printed with its line. With `CASES=FOLDER`, a random program whose verdict the change alters
//! is kept for each such change, with the program's job and correct verdict. The changes are: a condition is always
//! true or always false, `<` replaces `<=`, `+` replaces `-`, `/` replaces `*`, and a statement is left out.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::time::{Duration, Instant};

use quote::ToTokens as _;
use serde_json::Value;
use syn::spanned::Spanned as _;
use syn::visit_mut::{self, VisitMut};
use syn::{Attribute, BinOp, Expr, ImplItemFn, ItemConst, ItemFn, ItemMod, ItemStatic, Stmt, parse_quote};

/// The code that selects a change while the tests run.
const SWITCH: &str = "
pub fn on(mutant: u32) -> bool {
    static ACTIVE: std::sync::OnceLock<u32> = std::sync::OnceLock::new();
    let read = || std::env::var(\"POSTFORM_MUTANT\").ok().and_then(|number| number.parse().ok()).unwrap_or(0);
    *ACTIVE.get_or_init(read) == mutant
}
";

/// Number of random jobs that are printed to find a program whose verdict a change alters.
const JOBS: &str = "40000";

/// A test run may take at most this many times as long as without a change.
const PATIENCE: u32 = 6;

/// Inserts all changes into a file.
#[derive(Default)]
struct Changes {
    /// The line and the description of each change, by its number.
    made: BTreeMap<u32, (usize, String)>,
}

impl Changes {
    fn next(&mut self, line: usize, what: String) -> u32 {
        let number = self.made.len() as u32 + 1;
        self.made.insert(number, (line, what));
        number
    }

    /// Changes a condition: always true, always false, and, for a comparison, the similar operator.
    fn condition(&mut self, expr: &mut Expr, almost: Option<Expr>, (line, text): (usize, String)) {
        let yes = self.next(line, format!("`{text}` is always true"));
        let no = self.next(line, format!("`{text}` is always false"));
        let rest: Expr = match almost {
            Some(almost) => {
                let number = self.next(line, format!("`{text}` has its comparison changed where both sides are equal"));
                parse_quote!(if crate::mutants::on(#number) { #almost } else { #expr })
            }
            None => expr.clone(),
        };
        *expr = parse_quote!((if crate::mutants::on(#yes) { true } else if crate::mutants::on(#no) { false } else { #rest }));
    }

    /// Changes each part of a condition.
    fn conditions(&mut self, expr: &mut Expr) {
        match expr {
            Expr::Binary(binary) if matches!(binary.op, BinOp::And(_) | BinOp::Or(_)) => {
                self.conditions(&mut binary.left);
                self.conditions(&mut binary.right);
            }
            Expr::Paren(paren) => self.conditions(&mut paren.expr),
            Expr::Let(_) => self.visit_expr_mut(expr),
            Expr::Binary(binary) if comparison(&binary.op).is_some() => self.visit_expr_mut(expr),
            _ => {
                let place = (expr.span().start().line, shown(expr));
                self.visit_expr_mut(expr);
                if !matches!(expr, Expr::Lit(_)) {
                    self.condition(expr, None, place);
                }
            }
        }
    }
}

/// The comparison that differs from the given comparison only if both sides are equal.
fn comparison(op: &BinOp) -> Option<Option<BinOp>> {
    Some(match op {
        BinOp::Lt(_) => Some(parse_quote!(<=)),
        BinOp::Le(_) => Some(parse_quote!(<)),
        BinOp::Gt(_) => Some(parse_quote!(>=)),
        BinOp::Ge(_) => Some(parse_quote!(>)),
        BinOp::Eq(_) | BinOp::Ne(_) => None,
        _ => return None,
    })
}

fn shown(expr: &impl quote::ToTokens) -> String {
    let text = expr.to_token_stream().to_string();
    match text.char_indices().nth(100) {
        Some((end, _)) => format!("{} ..", &text[..end]),
        None => text,
    }
}

fn is_test(attributes: &[Attribute]) -> bool {
    let is_doc = |attribute: &Attribute| attribute.path().is_ident("doc");
    attributes.iter().any(|attribute| !is_doc(attribute) && attribute.to_token_stream().to_string().contains("test"))
}

impl VisitMut for Changes {
    fn visit_item_mod_mut(&mut self, item: &mut ItemMod) {
        if !is_test(&item.attrs) {
            visit_mut::visit_item_mod_mut(self, item);
        }
    }

    fn visit_item_const_mut(&mut self, _: &mut ItemConst) {}

    fn visit_item_static_mut(&mut self, _: &mut ItemStatic) {}

    fn visit_item_fn_mut(&mut self, item: &mut ItemFn) {
        if item.sig.constness.is_none() && !is_test(&item.attrs) {
            visit_mut::visit_block_mut(self, &mut item.block);
        }
    }

    fn visit_impl_item_fn_mut(&mut self, item: &mut ImplItemFn) {
        if item.sig.constness.is_none() {
            visit_mut::visit_block_mut(self, &mut item.block);
        }
    }

    fn visit_expr_mut(&mut self, expr: &mut Expr) {
        match expr {
            Expr::If(branch) => {
                self.conditions(&mut branch.cond);
                self.visit_block_mut(&mut branch.then_branch);
                if let Some((_, other)) = &mut branch.else_branch {
                    self.visit_expr_mut(other);
                }
            }
            Expr::Match(of) => {
                self.visit_expr_mut(&mut of.expr);
                for arm in &mut of.arms {
                    if let Some((_, guard)) = &mut arm.guard {
                        self.conditions(guard);
                    }
                    self.visit_expr_mut(&mut arm.body);
                }
            }
            Expr::Binary(binary) if matches!(binary.op, BinOp::And(_) | BinOp::Or(_)) => self.conditions(expr),
            Expr::Binary(binary) => {
                let almost = comparison(&binary.op);
                let line = binary.span().start().line;
                let other: Option<BinOp> = match (&almost, &binary.op) {
                    (None, BinOp::Sub(_)) => Some(parse_quote!(+)),
                    (None, BinOp::Mul(_)) => Some(parse_quote!(/)),
                    _ => None,
                };
                let text = shown(binary);
                visit_mut::visit_expr_binary_mut(self, binary);
                if let Some(almost) = almost {
                    let almost = almost.map(|op| {
                        let mut almost = binary.clone();
                        almost.op = op;
                        Expr::Binary(almost)
                    });
                    self.condition(expr, almost, (line, text));
                } else if let Some(op) = other {
                    let number = self.next(line, format!("`{text}` with `{}`", op.to_token_stream()));
                    let mut changed = binary.clone();
                    changed.op = op;
                    *expr = parse_quote!((if crate::mutants::on(#number) { #changed } else { #expr }));
                }
            }
            _ => visit_mut::visit_expr_mut(self, expr),
        }
    }

    fn visit_stmt_mut(&mut self, stmt: &mut Stmt) {
        let line = stmt.span().start().line;
        let text = shown(stmt);
        visit_mut::visit_stmt_mut(self, stmt);
        let Stmt::Expr(expr, Some(_)) = stmt else { return };
        let is_done = match expr {
            Expr::MethodCall(_) | Expr::Call(_) | Expr::Assign(_) | Expr::Try(_) => true,
            Expr::Binary(binary) => matches!(
                binary.op,
                BinOp::AddAssign(_) | BinOp::SubAssign(_) | BinOp::BitOrAssign(_) | BinOp::BitAndAssign(_)
            ),
            _ => false,
        };
        if is_done {
            let number = self.next(line, format!("`{text}` is left out"));
            *stmt = parse_quote!(if !crate::mutants::on(#number) { #stmt });
        }
    }
}

/// Copies the files of the repository in their current state, except those that git ignores.
fn copy(from: &Path, to: &Path) {
    let listed = Command::new("git")
        .args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"])
        .current_dir(from)
        .output()
        .expect("git");
    for name in String::from_utf8(listed.stdout).expect("names in UTF-8").split('\0').filter(|name| !name.is_empty()) {
        let (old, new) = (from.join(name), to.join(name));
        let Ok(bytes) = fs::read(&old) else { continue };
        // an unchanged file keeps its time, so that it is not compiled again
        if fs::read(&new).ok().as_ref() != Some(&bytes) {
            fs::create_dir_all(new.parent().expect("a folder")).expect("a folder in target/");
            fs::write(&new, &bytes).expect("a file in target/");
            fs::set_permissions(&new, fs::metadata(&old).expect("a file").permissions()).expect("a file of ours");
        }
    }
}

/// Builds the tests. Returns the paths of their programs.
fn build(tree: &Path) -> Option<Vec<PathBuf>> {
    let mut cargo = Command::new("cargo");
    cargo.args(["test", "--no-run", "--quiet", "--message-format=json", "--lib", "--test", "it"]);
    // changed conditions make some code unused
    cargo
        .env("RUSTFLAGS", "-A warnings")
        .env("CARGO_PROFILE_DEV_OPT_LEVEL", "1")
        .env("CARGO_TARGET_DIR", tree.join("../build"));
    let built = cargo.current_dir(tree).stderr(Stdio::inherit()).output().expect("cargo");
    let lines = String::from_utf8_lossy(&built.stdout).into_owned();
    let messages = lines.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    let mut programs = Vec::new();
    for message in messages {
        if let Some(error) = message["message"]["rendered"].as_str().filter(|_| message["message"]["level"] == "error")
        {
            eprintln!("{error}");
        }
        let is_test = message["profile"]["test"] == true;
        programs.extend(message["executable"].as_str().filter(|_| is_test).map(PathBuf::from));
    }
    built.status.success().then_some(programs)
}

/// Runs the tests with one change; `false`: one of them fails, or they take too long.
fn pass(programs: &[PathBuf], tree: &Path, tests: &[String], mutant: u32, limit: Duration) -> bool {
    programs.iter().all(|program| {
        let mut command = Command::new(program);
        command.args(tests).env("POSTFORM_MUTANT", mutant.to_string());
        command.current_dir(tree.join("crates/postform-cli")).stdout(Stdio::null()).stderr(Stdio::null());
        let mut child = command.spawn().expect("a test program");
        let begun = Instant::now();
        loop {
            if let Some(status) = child.try_wait().expect("a child") {
                return status.success();
            }
            if begun.elapsed() > limit {
                _ = child.kill();
                _ = child.wait();
                return false;
            }
            std::thread::sleep(Duration::from_millis(20));
        }
    })
}

/// For each change, looks for a random program whose verdict the change alters, and keeps the program in a folder.
/// Returns the changes without such a program.
fn cases(tree: &Path, folder: &Path, survivors: &[u32]) -> Vec<u32> {
    let corpus = |arguments: &[&str], mutant: u32| {
        let mut cargo = Command::new("cargo");
        cargo
            .args("run --quiet --release --manifest-path fuzz/Cargo.toml --bin corpus --".split(' '))
            .args([JOBS, "0"]);
        cargo.args(arguments).env("POSTFORM_MUTANT", mutant.to_string()).env("RUSTFLAGS", "-A warnings");
        cargo.env("CARGO_TARGET_DIR", tree.join("../corpus")).current_dir(tree).stderr(Stdio::null());
        cargo.output().expect("cargo")
    };
    let verdicts = tree.join("../verdicts");
    fs::write(&verdicts, corpus(&[], 0).stdout).expect("a file in target/");
    fs::create_dir_all(folder).expect("the folder of the cases");
    let arguments = [verdicts.to_string_lossy(), folder.to_string_lossy()];
    let finds = |number: &u32| corpus(&[&arguments[0], &arguments[1]], *number).status.success();
    survivors.iter().copied().filter(|number| !finds(number)).collect()
}

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let Some(file) = arguments.next() else {
        eprintln!("mutants FILE [TEST ...]");
        return ExitCode::from(2);
    };
    let tests: Vec<String> = arguments.collect();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let tree = root.join("target/mutants/tree");
    copy(&root, &tree);
    let text = fs::read_to_string(root.join(&file)).unwrap_or_else(|error| panic!("{file}: {error}"));
    let mut source = syn::parse_file(&text).unwrap_or_else(|error| panic!("{file}: {error}"));
    let mut changes = Changes::default();
    changes.visit_file_mut(&mut source);
    fs::write(tree.join(&file), source.to_token_stream().to_string()).expect("a file in target/");
    let library = fs::read_to_string(root.join("src/lib.rs")).expect("src/lib.rs");
    fs::write(tree.join("src/lib.rs"), library + "\nmod mutants;\n").expect("a file in target/");
    fs::write(tree.join("src/mutants.rs"), SWITCH).expect("a file in target/");
    let Some(programs) = build(&tree) else { return ExitCode::from(2) };
    let begun = Instant::now();
    if !pass(&programs, &tree, &tests, 0, Duration::MAX) {
        eprintln!("the tests fail without a change");
        return ExitCode::from(2);
    }
    let limit = begun.elapsed() * PATIENCE + Duration::from_secs(2);
    let mut survivors = Vec::new();
    for (&number, (line, what)) in &changes.made {
        if pass(&programs, &tree, &tests, number, limit) {
            survivors.push(number);
            println!("{file}:{line}: no test fails where {what}");
        }
    }
    println!(
        "{file}: {} of {} changes are noticed by a test",
        changes.made.len() - survivors.len(),
        changes.made.len()
    );
    if let Some(folder) = std::env::var_os("CASES") {
        for number in cases(&tree, &root.join(folder), &survivors) {
            let (line, what) = &changes.made[&number];
            println!("{file}:{line}: no random program has another verdict where {what}");
        }
    }
    ExitCode::from(u8::from(!survivors.is_empty()))
}
