//! Commands for editors.

use clap::Args;

/// `postform lsp`.
#[derive(Debug, Args)]
pub struct LspArgs {
    /// Has no effect: standard input and output are always used; editors may pass this option
    #[arg(long, hide = true)]
    pub stdio: bool,
}
