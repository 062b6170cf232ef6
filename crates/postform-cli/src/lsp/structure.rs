//! The structure of a form: outline, folding, colours, layout.

use std::ops::Range;

use gen_lsp_types as lsp;
use postform::Span;
use postform::internals::ide::{Symbol, SymbolKind, TokenKind};
use similar::{Algorithm, DiffOp, capture_diff_slices};

use super::convert::range;
use super::server::Server;
use super::texts::Kind;
use super::uri;
use super::view::View;
use crate::files;
use crate::forms;

/// The parts of a form.
pub fn outline(view: &View) -> Vec<lsp::DocumentSymbol> {
    let shown = |symbol: Symbol| lsp::DocumentSymbol {
        kind: kind(symbol.kind),
        range: range(view.source(), symbol.span),
        selection_range: range(view.source(), symbol.name_span),
        detail: Some(symbol.detail).filter(|detail| !detail.is_empty()),
        name: symbol.name,
        tags: None,
        #[expect(deprecated, reason = "the structure has it")]
        deprecated: None,
        children: None,
    };
    view.document.symbols(view.file).into_iter().map(shown).collect()
}

fn kind(kind: SymbolKind) -> lsp::SymbolKind {
    match kind {
        SymbolKind::Command => lsp::SymbolKind::Property,
        SymbolKind::Format => lsp::SymbolKind::Number,
        SymbolKind::Sequence => lsp::SymbolKind::Function,
        SymbolKind::Upon => lsp::SymbolKind::Event,
    }
}

/// Maximum number of forms in the open folders that are searched for their parts.
const MOST_FORMS: usize = 500;
/// Maximum number of parts in a list.
const MOST_SYMBOLS: usize = 2000;

/// The parts of all forms in the open folders. The name of a part must contain this text, in upper or lower case.
pub fn everywhere(server: &Server, asked: &str) -> Vec<lsp::WorkspaceSymbol> {
    let asked = asked.to_ascii_lowercase();
    let mut paths = forms::named(&server.folders).unwrap_or_default();
    paths.truncate(MOST_FORMS);
    let open = server.texts.all().filter(|text| text.kind == Kind::Form).filter_map(|text| text.path.clone());
    paths.extend(open);
    paths.sort();
    paths.dedup();
    let mut found = Vec::new();
    for path in paths {
        let source = match server.texts.of_path(&path) {
            Some(open) => open.source.clone(),
            None => match files::read_form(&path) {
                Ok(bytes) => postform::Source::from_bytes(files::name(&path), &bytes),
                Err(_) => continue,
            },
        };
        let uri = server.texts.of_path(&path).map_or_else(|| uri::of_path(&path), |text| text.uri.clone());
        for symbol in postform::internals::ide::symbols_of(&source) {
            if found.len() < MOST_SYMBOLS && symbol.name.to_ascii_lowercase().contains(&asked) {
                let place = lsp::Location { uri: uri.clone(), range: range(&source, symbol.name_span) };
                let file = path.file_name().map(|name| name.to_string_lossy().into_owned());
                found.push(lsp::WorkspaceSymbol {
                    location: lsp::WorkspaceSymbolLocation::Location(place),
                    data: None,
                    base_symbol_information: lsp::BaseSymbolInformation {
                        name: symbol.name,
                        kind: kind(symbol.kind),
                        tags: None,
                        container_name: file,
                    },
                });
            }
        }
    }
    found
}

/// The ranges that can be folded.
pub fn folding(view: &View) -> Vec<lsp::FoldingRange> {
    let folds = view.document.folding(view.file).into_iter();
    folds
        .map(|fold| lsp::FoldingRange {
            start_line: fold.first,
            end_line: fold.last,
            kind: fold.comment.then_some(lsp::FoldingRangeKind::Comment),
            ..lsp::FoldingRange::default()
        })
        .collect()
}

/// The kinds of tokens for colouring, by the protocol's names.
pub const TOKEN_TYPES: [&str; 9] =
    ["keyword", "parameter", "type", "function", "variable", "macro", "number", "string", "comment"];

fn token_type(kind: TokenKind) -> &'static str {
    match kind {
        TokenKind::Command | TokenKind::Keyword => "keyword",
        TokenKind::Argument => "parameter",
        TokenKind::Format => "type",
        TokenKind::Sequence => "function",
        TokenKind::Variable => "variable",
        TokenKind::Code => "macro",
        TokenKind::Word => "number",
        TokenKind::Note => "string",
        TokenKind::Comment | TokenKind::Lost => "comment",
    }
}

/// The mark of ignored words, which follow two spaces in a line.
pub const TOKEN_MODIFIERS: [&str; 1] = ["deprecated"];

/// The words of a form with their kinds.
pub fn tokens(view: &View, within: Option<Span>) -> lsp::SemanticTokens {
    let mut data = Vec::new();
    let mut last = lsp::Position::default();
    for token in view.document.tokens(view.file) {
        if within.is_some_and(|within| token.span.end < within.start || token.span.start > within.end) {
            continue;
        }
        let place = range(view.source(), token.span);
        if place.start.line != place.end.line {
            continue;
        }
        let delta_line = place.start.line - last.line;
        let from = if delta_line == 0 { last.character } else { 0 };
        let index = TOKEN_TYPES.iter().position(|name| *name == token_type(token.kind)).unwrap_or(0);
        data.push(lsp::SemanticToken {
            delta_line,
            delta_start: place.start.character - from,
            length: place.end.character - place.start.character,
            token_type: index as u32,
            token_modifiers_bitset: u32::from(token.kind == TokenKind::Lost),
        });
        last = place.start;
    }
    lsp::SemanticTokens { result_id: None, data }
}

/// The canonical layout as one edit; none if the form already has this layout.
pub fn format(server: &Server, uri: &lsp::Uri) -> Option<Vec<lsp::TextEdit>> {
    let text = server.texts.get(uri).filter(|text| text.kind == Kind::Form)?;
    let laid_out = postform::internals::fmt::format(&text.source);
    if laid_out == text.source.text {
        return Some(Vec::new());
    }
    let whole = Span::new(0, 0, text.source.text.len());
    Some(vec![lsp::TextEdit { range: range(&text.source, whole), new_text: laid_out }])
}

/// The canonical layout of the lines of a range. A change that goes beyond the range is left out, because all lines of
/// a change belong together.
pub fn format_range(server: &Server, uri: &lsp::Uri, within: lsp::Range) -> Option<Vec<lsp::TextEdit>> {
    let text = server.texts.get(uri).filter(|text| text.kind == Kind::Form)?;
    let laid_out = postform::internals::fmt::format(&text.source);
    let [old, new] = [&text.source.text, &laid_out].map(|text| text.split_inclusive('\n').collect::<Vec<_>>());
    // a range that ends at the beginning of a line does not include that line
    let last = within.end.line + u32::from(within.end.character > 0 || within.end.line == within.start.line);
    let lines = within.start.line as usize..last as usize;
    let changes = capture_diff_slices(Algorithm::Myers, &old, &new).into_iter().filter_map(|change| match change {
        DiffOp::Equal { .. } => None,
        change => Some((change.old_range(), change.new_range())),
    });
    let inside =
        changes.filter(|(from, _)| from.start >= lines.start && from.end <= lines.end && from.start < lines.end);
    let at = |line: usize| lsp::Position { line: line as u32, character: 0 };
    let edit = |(from, to): (Range<usize>, Range<usize>)| lsp::TextEdit {
        range: lsp::Range { start: at(from.start), end: at(from.end) },
        new_text: new[to].concat(),
    };
    Some(inside.map(edit).collect())
}
