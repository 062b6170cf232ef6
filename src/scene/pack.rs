//! Packs a JSON head and sections of numbers into one sequence of bytes.

use std::cell::OnceCell;
use std::collections::HashMap;
use std::hash::{BuildHasher, Hash, Hasher};

use foldhash::quality::FixedState;
use serde_json::{Map, Value, json};

/// The first bytes of a scene.
const MAGIC: &[u8; 4] = b"PFS2";

/// The contents of the page in packed form: the head and the sections.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    head: Map<String, Value>,
    sections: Vec<Section>,
}

/// Numbers or text with a name.
#[derive(Clone, Debug)]
struct Section {
    name: String,
    bytes: Vec<u8>,
    /// The hash of the bytes. The hash is calculated when it is first needed.
    hash: OnceCell<u64>,
}

impl Section {
    /// A hash of the bytes. Sections with different bytes almost never have the same hash.
    fn hash(&self) -> u64 {
        *self.hash.get_or_init(|| FixedState::with_seed(0).hash_one(&self.bytes))
    }
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

    /// The value of the head with this name.
    pub fn said(&self, name: &str) -> Option<&Value> {
        self.head.get(name)
    }

    /// Adds a section of numbers.
    pub(super) fn section<const N: usize>(&mut self, name: String, values: impl IntoIterator<Item = [u8; N]>) {
        let values = values.into_iter();
        let mut bytes = Vec::with_capacity(values.size_hint().0 * N);
        values.for_each(|value| bytes.extend_from_slice(&value));
        self.bytes(name, bytes);
    }

    /// Adds a section of bytes.
    pub(super) fn bytes(&mut self, name: String, bytes: Vec<u8>) {
        self.sections.push(Section { name, bytes, hash: OnceCell::new() });
    }

    /// Adds the head values and the sections of another scene.
    pub fn absorb(&mut self, other: Scene) {
        self.head.extend(other.head);
        self.sections.extend(other.sections);
    }

    /// A hash of the sections and of the two arguments. Different inputs almost never have the same hash.
    pub(super) fn fingerprint(&self, run: &str, old: &[u8]) -> String {
        let mut hasher = FixedState::with_seed(0).build_hasher();
        self.sections.iter().for_each(|section| section.hash().hash(&mut hasher));
        (run, old).hash(&mut hasher);
        format!("{:016x}", hasher.finish())
    }

    /// Removes all sections, for a client that already has these sections.
    pub fn without_sections(&mut self) {
        self.sections.clear();
    }

    /// Removes each section that the client already has. `known` contains the hashes of the client's sections by name,
    /// as in the head of an earlier scene. The head lists the names of the removed sections as `kept`.
    pub fn without_known(&mut self, known: &HashMap<String, String>) {
        let mut hashes = Map::new();
        let mut kept = Vec::new();
        self.sections.retain(|section| {
            let hash = format!("{:016x}", section.hash());
            let is_known = known.get(&section.name) == Some(&hash);
            if is_known {
                kept.push(json!(section.name));
            }
            hashes.insert(section.name.clone(), hash.into());
            !is_known
        });
        self.say("hashes", Value::Object(hashes));
        self.say("kept", Value::Array(kept));
    }

    /// The scene as bytes: `PFS2`, the length of the head, the length of the sections, the head, spaces up to a
    /// multiple of eight, the sections. Numbers are little-endian. The offset of each section is relative to the first
    /// section and a multiple of eight. Several scenes may follow one another.
    pub fn into_bytes(mut self) -> Vec<u8> {
        let mut places = Map::new();
        let mut length = 0;
        for Section { name, bytes, .. } in &self.sections {
            places.insert(name.clone(), json!([length, bytes.len()]));
            length += bytes.len().next_multiple_of(8);
        }
        self.head.insert("sections".to_owned(), Value::Object(places));
        let mut head = Value::Object(self.head).to_string().into_bytes();
        head.resize(head.len().next_multiple_of(8), b' ');
        let mut out = Vec::with_capacity(16 + head.len() + length);
        out.extend_from_slice(MAGIC);
        out.extend_from_slice(&(head.len() as u32).to_le_bytes());
        out.extend_from_slice(&(length as u64).to_le_bytes());
        out.append(&mut head);
        for Section { bytes, .. } in self.sections {
            out.extend_from_slice(&bytes);
            out.resize(out.len().next_multiple_of(8), 0);
        }
        out
    }
}
