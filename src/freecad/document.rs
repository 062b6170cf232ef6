//! Reads `Document.xml`: the objects of a document, and the properties of these objects that a toolpath needs.

use indexmap::IndexMap;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use super::wrong;
use crate::diag::{Code, Diag};

/// The value of a property.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    /// A float or an integer.
    Number(f64),
    /// Yes or no.
    Yes(bool),
    /// A text, or the selected value of an enumeration.
    Text(String),
    /// Texts in order.
    Texts(Vec<String>),
    /// The name of another object; empty if there is none.
    Link(String),
    /// Names of other objects in order.
    Links(Vec<String>),
    /// The file in the archive that contains a path.
    Path(String),
    /// The class of the object's Python code, without its module.
    Class(String),
    /// A tool as it is stored in documents before 0.19.
    Tool(OldTool),
    /// The position and the orientation of an object.
    Placement(Placement),
}

/// The position and the orientation of an object. FreeCAD shows the path of an operation moved and turned by the placement
/// of the operation. Of FreeCAD's own posts in 1.1, some print the path as it is shown (`grbl`), others do not (`linuxcnc`).
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Placement {
    /// X, Y and Z in millimetres. NaN if the document has no number.
    pub position: [f64; 3],
    /// The rotation as a quaternion: x, y, z, w. NaN if the document has no number.
    pub rotation: [f64; 4],
}

impl Placement {
    /// Whether the object is neither moved nor turned.
    pub fn is_identity(&self) -> bool {
        let [x, y, z, _] = self.rotation;
        self.position.iter().chain(&[x, y, z]).all(|number| number.abs() < 1e-9)
    }
}

/// A tool that is stored in a property, as in documents before 0.19.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct OldTool {
    /// Name of the tool.
    pub name: String,
    /// Diameter in millimetres.
    pub diameter: Option<f64>,
    /// Corner radius in millimetres.
    pub corner: Option<f64>,
}

/// An object of the document, with its properties by name.
#[derive(Clone, Debug, Default)]
pub(super) struct Object {
    properties: IndexMap<String, Value>,
}

impl Object {
    /// The value of a property; `None` if the object does not have the property.
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.properties.get(name)
    }

    /// The number in a property.
    pub fn number(&self, name: &str) -> Option<f64> {
        match self.get(name) {
            Some(Value::Number(number)) => Some(*number),
            _ => None,
        }
    }

    /// The text in a property, or the selected value of an enumeration.
    pub fn text(&self, name: &str) -> Option<&str> {
        match self.get(name) {
            Some(Value::Text(text)) => Some(text),
            _ => None,
        }
    }

    /// The yes-or-no value of a property.
    pub fn yes(&self, name: &str) -> Option<bool> {
        match self.get(name) {
            Some(Value::Yes(yes)) => Some(*yes),
            _ => None,
        }
    }

    /// The name of a linked object. If the property is a list (a path array of 1.1), the first object in the list.
    pub fn link(&self, name: &str) -> Option<&str> {
        match self.get(name) {
            Some(Value::Link(link)) => Some(link.as_str()),
            Some(Value::Links(links)) => links.first().map(String::as_str),
            _ => None,
        }
        .filter(|link| !link.is_empty())
    }

    /// The names of linked objects.
    pub fn links(&self, name: &str) -> &[String] {
        match self.get(name) {
            Some(Value::Links(links)) => links,
            _ => &[],
        }
    }

    /// The file in the archive with the object's path. `None`: the object has no path.
    pub fn path(&self) -> Option<&str> {
        match self.get("Path") {
            Some(Value::Path(file)) => Some(file.as_str()),
            _ => None,
        }
        .filter(|file| !file.is_empty())
    }

    /// The texts in a property.
    pub fn texts(&self, name: &str) -> &[String] {
        match self.get(name) {
            Some(Value::Texts(texts)) => texts,
            _ => &[],
        }
    }

    /// The class of the object's Python code. `None` if FreeCAD 1.1 saved a document of 0.20 without the old modules.
    pub fn class(&self) -> Option<&str> {
        match self.get("Proxy") {
            Some(Value::Class(class)) => Some(class),
            _ => None,
        }
    }
}

/// A document.
#[derive(Clone, Debug, Default)]
pub(super) struct Document {
    /// The version of FreeCAD, such as `0.20R` or `1.1R20260725 (Git shallow)`.
    pub version: String,
    /// The properties of the document itself.
    pub own: Object,
    /// The objects of the document by name, in the order of the file.
    pub objects: IndexMap<String, Object>,
}

impl Document {
    /// Reads `Document.xml`.
    pub fn parse(text: &str) -> Result<Document, Box<Diag>> {
        let mut reader = Reader::from_str(text);
        let mut document = Document::default();
        let mut at = Cursor::default();
        let mut root = false;
        loop {
            let event = match reader.read_event() {
                Ok(event) => event,
                Err(error) => return broken(format!("byte {}: {error}", reader.error_position())),
            };
            match event {
                Event::Start(tag) => {
                    root |= tag.name().as_ref() == "Document";
                    at.tag(&tag, &mut document)?;
                }
                Event::Empty(tag) => {
                    root |= tag.name().as_ref() == "Document";
                    at.tag(&tag, &mut document)?;
                    at.end(tag.name().as_ref(), &mut document);
                }
                Event::End(tag) => at.end(tag.name().as_ref(), &mut document),
                // FreeCAD writes no DTD; entities are refused, because they could expand without limit
                Event::DocType(_) => return broken("it declares entities"),
                Event::Eof if root && !at.data && at.object.is_none() => return Ok(document),
                Event::Eof => return broken("the file is incomplete or not a FreeCAD document"),
                _ => {}
            }
        }
    }

    /// The value of a property of an operation. If the operation is a dressup without this property: the value of the
    /// dressup's base operation (as in FreeCAD's `opProperty`).
    pub fn inherited<'a>(&'a self, name: &str, property: &str) -> Option<&'a Value> {
        let mut object = self.objects.get(name)?;
        // the number of steps is limited, in case the bases form a circle
        for _ in 0..=self.objects.len() {
            if let Some(value) = object.get(property) {
                return Some(value);
            }
            object = self.objects.get(object.link("Base")?)?;
        }
        None
    }
}

/// The state while `Document.xml` is read.
#[derive(Default)]
struct Cursor {
    /// Whether the section with the values has begun. This section comes after the list of objects.
    data: bool,
    object: Option<(String, Object)>,
    property: Option<String>,
    value: Option<Value>,
    /// The index of the selected value of an enumeration, and the number of values read so far.
    chosen: Option<(usize, usize)>,
}

impl Cursor {
    fn tag(&mut self, tag: &BytesStart<'_>, document: &mut Document) -> Result<(), Box<Diag>> {
        match tag.name().as_ref() {
            "Document" => document.version = attribute(tag, "ProgramVersion")?.unwrap_or_default(),
            "ObjectData" => self.data = true,
            "Properties" if !self.data => self.object = Some(Default::default()),
            "Object" if self.data => {
                self.object = attribute(tag, "name")?.map(|name| (name, Object::default()));
            }
            "Property" if self.object.is_some() => {
                (self.property, self.value, self.chosen) = (attribute(tag, "name")?, None, None);
            }
            element if self.property.is_some() => self.element(element, tag)?,
            _ => {}
        }
        Ok(())
    }

    fn element(&mut self, element: &str, tag: &BytesStart<'_>) -> Result<(), Box<Diag>> {
        let value = |name: &str| attribute(tag, name).map(Option::unwrap_or_default);
        match (element, &mut self.value) {
            ("Float", None) => self.value = number(&value("value")?).map(Value::Number),
            ("Integer", None) => {
                let index = number(&value("value")?);
                if attribute(tag, "CustomEnum")?.is_some() {
                    self.chosen = index.map(|index| (index as usize, 0));
                } else {
                    self.value = index.map(Value::Number);
                }
            }
            ("Enum", _) => {
                if let Some((chosen, count)) = &mut self.chosen {
                    if chosen == count {
                        self.value = Some(Value::Text(value("value")?));
                    }
                    *count += 1;
                }
            }
            ("Bool", None) => self.value = Some(Value::Yes(value("value")? == "true")),
            ("String", None) => self.value = Some(Value::Text(value("value")?)),
            ("StringList", None) => self.value = Some(Value::Texts(Vec::new())),
            ("String", Some(Value::Texts(texts))) => texts.push(value("value")?),
            ("Link", None) => self.value = attribute(tag, "value")?.map(Value::Link),
            ("LinkList", None) => self.value = Some(Value::Links(Vec::new())),
            ("Link", Some(Value::Links(links))) => links.push(value("value")?),
            ("Path", None) => self.value = Some(Value::Path(value("file")?)),
            ("Python", None) => self.value = Some(Value::Class(value("class")?)),
            ("PropertyPlacement", None) => {
                let mut numbers = [f64::NAN; 7];
                for (held, name) in numbers.iter_mut().zip(["Px", "Py", "Pz", "Q0", "Q1", "Q2", "Q3"]) {
                    *held = number(&value(name)?).unwrap_or(f64::NAN);
                }
                let [px, py, pz, q0, q1, q2, q3] = numbers;
                let placement = Placement { position: [px, py, pz], rotation: [q0, q1, q2, q3] };
                self.value = Some(Value::Placement(placement));
            }
            ("Tool", None) => {
                let (diameter, corner) = (number(&value("diameter")?), number(&value("corner")?));
                self.value = Some(Value::Tool(OldTool { name: value("name")?, diameter, corner }));
            }
            _ => {}
        }
        Ok(())
    }

    fn end(&mut self, element: &str, document: &mut Document) {
        match element {
            "Property" => {
                if let (Some((_, object)), Some(name), Some(value)) =
                    (&mut self.object, self.property.take(), self.value.take())
                {
                    object.properties.insert(name, value);
                }
            }
            "Properties" if !self.data => document.own = self.object.take().unwrap_or_default().1,
            "Object" => {
                if let Some((name, object)) = self.object.take() {
                    document.objects.insert(name, object);
                }
            }
            "ObjectData" => self.data = false,
            _ => {}
        }
    }
}

/// Reads a finite number.
fn number(text: &str) -> Option<f64> {
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

/// Reads the text of an attribute.
fn attribute(tag: &BytesStart<'_>, name: &str) -> Result<Option<String>, Box<Diag>> {
    match tag.try_get_attribute(name) {
        Ok(None) => Ok(None),
        Ok(Some(attribute)) => match attribute.normalized_value(quick_xml::XmlVersion::Implicit1_0) {
            Ok(text) => Ok(Some(text.into_owned())),
            Err(error) => broken(format!("the attribute {name}: {error}")),
        },
        Err(error) => broken(format!("the attributes of an element: {error}")),
    }
}

fn broken<T>(what: impl std::fmt::Display) -> Result<T, Box<Diag>> {
    let help = "open the document in FreeCAD and save it again";
    wrong(Code::PD001, format!("Document.xml can't be read: {what}"), help)
}
