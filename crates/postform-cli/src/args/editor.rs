//! Commands for editors.

use clap::Args;

/// `postform lsp`.
#[derive(Debug, Args)]
pub struct LspArgs {
    /// Use standard input and output, which is always the case
    #[arg(long, hide = true)]
    pub stdio: bool,
}
