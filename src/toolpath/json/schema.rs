//! The JSON Schema of a job document. The schema is generated from the reader's tables of keys.

use serde_json::{Value, json};

use super::objects::{CycleObject, ItemObject, JobHead, OperationHead, SubprogramHead};
use super::values::{Point, Position};

/// The schema as a document. This function adds the lists that are read as streams, because the tables of keys do not
/// contain these lists.
pub fn schema() -> Value {
    let mut generator = schemars::SchemaGenerator::default();
    let list =
        |schema: schemars::Schema, about: &str| json!({ "type": "array", "items": schema, "description": about });
    generator.subschema_for::<Position>();
    let points = list(generator.subschema_for::<Point>(), "the points of the cycle");
    let cycle = generator.subschema_for::<CycleObject>().to_value();
    let path = list(generator.subschema_for::<ItemObject>(), "the moves; in a stream the last key");
    let subprograms = list(generator.subschema_for::<SubprogramHead>(), "subprograms, before the operations");
    let operations = list(generator.subschema_for::<OperationHead>(), "the operations; in a stream the last key");
    let mut root = generator.root_schema_for::<JobHead>().to_value();
    for (at, key, value) in [
        ("/properties", "subprograms", subprograms),
        ("/properties", "operations", operations),
        ("/$defs/SubprogramHead/properties", "path", path.clone()),
        ("/$defs/OperationHead/properties", "path", path),
        ("/$defs/ItemObject/properties", "cycle", cycle),
        ("/$defs/CycleObject/properties", "points", points),
        ("", "title", "postform job".into()),
        ("", "required", json!(["operations", "units"])),
    ] {
        if let Some(object) = root.pointer_mut(at).and_then(Value::as_object_mut) {
            object.insert(key.to_owned(), value);
        }
    }
    without_null(&mut root);
    root
}

/// Removes null from the schema: a key may be left out, but its value must not be null. Only coordinates may be null.
fn without_null(schema: &mut Value) {
    let Value::Object(object) = schema else { return };
    for (key, value) in object.iter_mut() {
        match (key.as_str(), value) {
            ("properties" | "$defs", Value::Object(schemas)) => schemas.iter_mut().for_each(|(_, s)| without_null(s)),
            ("enum", Value::Array(words)) => words.retain(|word| !word.is_null()),
            ("type", value @ Value::Array(_)) => {
                if let Some(first) = value.as_array().and_then(|types| types.first()).cloned() {
                    *value = first;
                }
            }
            ("anyOf", Value::Array(schemas)) => schemas.retain(|s| s["type"] != "null"),
            _ => {}
        }
    }
    if let Some([Value::Object(only)]) = object.get("anyOf").and_then(Value::as_array).map(Vec::as_slice) {
        let only = only.clone();
        object.remove("anyOf");
        object.extend(only);
    }
}
