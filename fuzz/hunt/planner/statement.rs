//! Statements of a CL file: `MAJOR/minor,minor`.

/// A word before the slash and what comes after it.
#[derive(Clone, Debug)]
pub struct Statement {
    /// GOTO, CYCLE, RAPID.
    pub major: String,
    /// Words and numbers in their order.
    pub minors: Vec<Minor>,
}

/// One of the words after the slash.
#[derive(Clone, Debug, PartialEq)]
pub enum Minor {
    /// DEPTH, MMPM.
    Word(String),
    /// 12.5.
    Number(f64),
}

impl Minor {
    /// Its number.
    pub fn number(&self) -> Option<f64> {
        match self {
            Minor::Number(number) => Some(*number),
            Minor::Word(_) => None,
        }
    }

    /// Is it this word?
    pub fn is(&self, word: &str) -> bool {
        matches!(self, Minor::Word(own) if own == word)
    }
}

impl Statement {
    /// All its numbers, without its words.
    pub fn numbers(&self) -> Vec<f64> {
        self.minors.iter().filter_map(Minor::number).collect()
    }

    /// Has it this word?
    pub fn has(&self, word: &str) -> bool {
        self.minors.iter().any(|minor| minor.is(word))
    }
}

/// The statements of a file; `$` at the end of a line goes on in the next.
pub fn statements(text: &str) -> Vec<Statement> {
    let mut list = Vec::new();
    let mut whole = String::new();
    for line in text.lines() {
        let line = line.trim();
        if let Some(part) = line.strip_suffix('$') {
            whole += part;
            continue;
        }
        whole += line;
        let statement = std::mem::take(&mut whole);
        let (major, rest) = statement.split_once('/').unwrap_or((&statement, ""));
        if major.trim().is_empty() {
            continue;
        }
        let minor = |text: &str| {
            let text = text.trim();
            text.parse().map_or_else(|_| Minor::Word(text.to_uppercase()), Minor::Number)
        };
        let minors = rest.split(',').filter(|text| !text.trim().is_empty()).map(minor).collect();
        list.push(Statement { major: major.trim().to_uppercase(), minors });
    }
    list
}
