//! What editors start.

use clap::Args;

/// `postform lsp`.
#[derive(Debug, Args)]
pub struct LspArgs {
    /// Talk over standard input and output, as it always does
    #[arg(long, hide = true)]
    pub stdio: bool,
}
