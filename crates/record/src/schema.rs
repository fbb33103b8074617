//! What each message means, told to readers that have never heard of this program.
//!
//! An MCAP schema with encoding `protobuf` is a serialized `google.protobuf.FileDescriptorSet`:
//! the file that defines the message and all files it imports. The `foxglove.*` messages here are
//! Foxglove's own (same file names, field names and numbers), so that Foxglove and Rerun draw
//! them; the `simbeeotic.*` ones are ours, and any protobuf reader can print them.

mod descriptor;
mod known;
mod ours;
mod scene;
#[cfg(test)]
mod tests;

pub(crate) use known::{LOG, POSES_IN_FRAME, RAW_IMAGE};
pub(crate) use ours::{EVENT, LINKS, METRICS, PACKET, RADIO, READING, TWISTS, WIND};
pub(crate) use scene::{ABOUT, POINT_CLOUD, SCENE_UPDATE, VEHICLES};

use prost::Message;

/// One message type, in a `.proto` file of its own.
pub(crate) struct Type {
    package: &'static str,
    name: &'static str,
    fields: &'static [Field],
}

struct Field {
    name: &'static str,
    number: i32,
    kind: Kind,
    repeated: bool,
}

const fn one(name: &'static str, number: i32, kind: Kind) -> Field {
    Field {
        name,
        number,
        kind,
        repeated: false,
    }
}

const fn many(name: &'static str, number: i32, kind: Kind) -> Field {
    Field {
        name,
        number,
        kind,
        repeated: true,
    }
}

/// The protobuf types in use.
#[derive(Clone, Copy)]
enum Kind {
    Double,
    Float,
    Int64,
    Int32,
    Fixed32,
    Bool,
    Text,
    Bytes,
    Message(&'static Type),
    /// Declared within the message that uses it.
    Enum(&'static Enum),
}

struct Enum {
    name: &'static str,
    /// Numbered from 0 on.
    values: &'static [&'static str],
}

impl Type {
    /// The name by which MCAP readers know the type, for example `foxglove.Log`.
    pub(crate) fn full_name(&self) -> String {
        format!("{}.{}", self.package, self.name)
    }

    /// The serialized descriptor set: this type's file after all that it imports.
    pub(crate) fn descriptor_set(&self) -> Vec<u8> {
        let mut set = descriptor::FileDescriptorSet::default();
        self.collect(&mut set.file);
        set.encode_to_vec()
    }

    fn collect(&self, files: &mut Vec<descriptor::FileDescriptor>) {
        for import in self.imports() {
            import.collect(files);
        }
        if files.iter().all(|known| known.name != self.file()) {
            files.push(self.describe());
        }
    }

    /// The types of its fields that are messages: each once, by name.
    fn imports(&self) -> Vec<&'static Type> {
        let messages = self.fields.iter().filter_map(|field| match field.kind {
            Kind::Message(of) => Some(of),
            _ => None,
        });
        let mut imports: Vec<_> = messages.collect();
        imports.sort_by_key(|of| of.name);
        imports.dedup_by_key(|of| of.name);
        imports
    }

    /// The file that defines it, named as Foxglove and Google name theirs.
    fn file(&self) -> String {
        match self.package {
            "google.protobuf" => format!("google/protobuf/{}.proto", self.name.to_lowercase()),
            package => format!("{package}/{}.proto", self.name),
        }
    }

    fn describe(&self) -> descriptor::FileDescriptor {
        let enums = self.fields.iter().filter_map(|field| match field.kind {
            Kind::Enum(of) => Some(of.describe()),
            _ => None,
        });
        let message = descriptor::Descriptor {
            name: self.name.into(),
            field: self.fields.iter().map(|f| f.describe(self)).collect(),
            enum_type: enums.collect(),
        };
        descriptor::FileDescriptor {
            name: self.file(),
            package: self.package.into(),
            dependency: self.imports().iter().map(|of| of.file()).collect(),
            message_type: vec![message],
            syntax: "proto3".into(),
        }
    }
}

impl Field {
    fn describe(&self, message: &Type) -> descriptor::FieldDescriptor {
        let (code, type_name) = match self.kind {
            Kind::Double => (1, None),
            Kind::Float => (2, None),
            Kind::Int64 => (3, None),
            Kind::Int32 => (5, None),
            Kind::Fixed32 => (7, None),
            Kind::Bool => (8, None),
            Kind::Text => (9, None),
            Kind::Bytes => (12, None),
            Kind::Message(of) => (11, Some(format!(".{}", of.full_name()))),
            Kind::Enum(of) => (14, Some(format!(".{}.{}", message.full_name(), of.name))),
        };
        descriptor::FieldDescriptor {
            name: self.name.into(),
            number: self.number,
            label: if self.repeated { 3 } else { 1 },
            r#type: code,
            type_name,
        }
    }
}

impl Enum {
    fn describe(&self) -> descriptor::EnumDescriptor {
        let value = |(number, name): (i32, &&str)| descriptor::EnumValue {
            name: (*name).into(),
            number: Some(number),
        };
        descriptor::EnumDescriptor {
            name: self.name.into(),
            value: (0..).zip(self.values).map(value).collect(),
        }
    }
}
