//! Statements of a CL file: `MAJOR/minor,minor`.

/// The word before the slash, and the words and numbers after it.
#[derive(Clone, Debug)]
pub struct Statement {
    /// Such as GOTO, CYCLE, RAPID.
    pub major: String,
    /// Words and numbers after the slash, in order.
    pub minors: Vec<Minor>,
}

/// A word or number after the slash.
#[derive(Clone, Debug, PartialEq)]
pub enum Minor {
    /// Such as DEPTH, MMPM.
    Word(String),
    /// Such as 12.5.
    Number(f64),
}

impl Minor {
    /// The number, if it is one.
    pub fn number(&self) -> Option<f64> {
        match self {
            Minor::Number(number) => Some(*number),
            Minor::Word(_) => None,
        }
    }

    /// Whether the value is this word.
    pub fn is(&self, word: &str) -> bool {
        matches!(self, Minor::Word(own) if own == word)
    }
}

impl Statement {
    /// All numbers after the slash.
    pub fn numbers(&self) -> Vec<f64> {
        self.minors.iter().filter_map(Minor::number).collect()
    }

    /// Whether the statement contains this word after the slash.
    pub fn has(&self, word: &str) -> bool {
        self.minors.iter().any(|minor| minor.is(word))
    }
}

/// The statements of a file. A `$` at the end of a line continues the statement on the next line.
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
