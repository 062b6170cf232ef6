//! A head in JSON, and sections of numbers.

use std::hash::{DefaultHasher, Hash, Hasher};

use serde_json::{Map, Value, json};

/// The first bytes of a scene.
const MAGIC: &[u8; 4] = b"PFS2";

/// The contents of the page in packed form.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    head: Map<String, Value>,
    sections: Map<String, Value>,
    body: Vec<u8>,
}

impl Scene {
    /// An empty scene.
    pub(super) fn new() -> Scene {
        Scene::default()
    }

    /// Sets a value in the head.
    pub fn say(&mut self, name: &str, value: Value) {
        self.head.insert(name.to_owned(), value);
    }

    /// A value of the head.
    pub fn said(&self, name: &str) -> Option<&Value> {
        self.head.get(name)
    }

    /// Adds a section; each begins at a multiple of eight bytes.
    pub(super) fn section<const N: usize>(&mut self, name: String, values: impl IntoIterator<Item = [u8; N]>) {
        self.body.resize(self.body.len().next_multiple_of(8), 0);
        let start = self.body.len();
        let values = values.into_iter();
        self.body.reserve(values.size_hint().0 * N);
        values.for_each(|value| self.body.extend_from_slice(&value));
        self.sections.insert(name, json!([start, self.body.len() - start]));
    }

    /// Adds a section of bytes.
    pub(super) fn bytes(&mut self, name: String, bytes: &[u8]) {
        self.body.resize(self.body.len().next_multiple_of(8), 0);
        self.sections.insert(name, json!([self.body.len(), bytes.len()]));
        self.body.extend_from_slice(bytes);
    }

    /// Adds what another scene contains.
    pub fn absorb(&mut self, other: Scene) {
        self.head.extend(other.head);
        for (name, place) in other.sections {
            let at = |i: usize| place[i].as_u64().unwrap_or(0) as usize;
            self.bytes(name, &other.body[at(0)..at(0) + at(1)]);
        }
    }

    /// A hash of the sections and the other inputs: equal inputs have the same one, others differ.
    pub(super) fn fingerprint(&self, run: &str, old: &[u8]) -> String {
        let mut hasher = DefaultHasher::new();
        (&self.body, run, old).hash(&mut hasher);
        format!("{:016x}", hasher.finish())
    }

    /// Removes the sections, for a client that already has them.
    pub fn without_sections(&mut self) {
        self.sections.clear();
        self.body.clear();
    }

    /// The whole scene: `PFS2`, the lengths of the head and of the sections, the head, spaces up to a multiple of eight, the
    /// sections. Numbers are little-endian. Offsets of sections are relative to the first section. Several scenes may follow
    /// each other.
    pub fn into_bytes(mut self) -> Vec<u8> {
        self.head.insert("sections".to_owned(), Value::Object(self.sections));
        let mut head = Value::Object(self.head).to_string().into_bytes();
        head.resize(head.len().next_multiple_of(8), b' ');
        let mut out = Vec::with_capacity(16 + head.len() + self.body.len());
        out.extend_from_slice(MAGIC);
        out.extend_from_slice(&(head.len() as u32).to_le_bytes());
        out.extend_from_slice(&(self.body.len() as u64).to_le_bytes());
        out.append(&mut head);
        out.append(&mut self.body);
        out
    }
}
