//! PF445: a tool change that does not retract the old tool. Some machines retract by themselves at M6, but not all.

use crate::control::Meaning;
use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::blocks::{Block, calls};
use crate::lint::view::{Body, Purpose, View};
use crate::sema::{Word, WordKind};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let Some(body) = view.body(SequenceId::ToolChange).filter(|_| view.is_mill() && !view.is_flat()) else { return };
    let Some(change) = body.meaning(Meaning::changes_tool) else { return };
    let before = &view.blocks(body)[..=body.line_of(change)];
    let is_earlier = |body: &&Body| match body.purpose {
        Purpose::Sequence(id) => id == SequenceId::EndOperation,
        Purpose::Upon(var, _) => var == VarId::Tool,
    };
    let mut earlier = view.bodies.iter().filter(is_earlier).flat_map(|body| view.blocks(*body));
    if before.iter().any(|block| may_retract(view, block)) || earlier.any(|block| may_retract(view, block)) {
        return;
    }
    diags.push(
        Diag::new(Code::PF445, "ToolChange does not retract the tool before the change")
            .at(change.span, "the old tool is at the height of its last move")
            .help(
                "retract first: `G91 G28 Z0` and `G90`, or `G0 G53 Z0`; if the change itself retracts the tool on this \
                 machine, allow the rule: `# postform: allow PF445`",
            ),
    );
}

/// Whether the block may lift the tool: by a height, at a move to home, in a macro, by a code of the machine's builder,
/// or by text that lint does not read.
fn may_retract(view: &View, block: &Block) -> bool {
    let unread = |word: &Word| {
        let is_builders = word.code().is_some_and(|code| code.letter == b'M')
            && matches!(view.meaning(word), None | Some(Meaning::Unsaid | Meaning::Harmless));
        let is_text = matches!(word.kind, WordKind::Quote(_) | WordKind::PropertyText(_) | WordKind::TextVar(_));
        is_builders || is_text || calls(view.settings.codes(), word)
    };
    block.reference || block.axis_words.iter().any(|(_, axis)| *axis == 2) || block.line.words.iter().any(unread)
}
