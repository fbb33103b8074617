//! glTF 2.0: of all that it can say, triangles, where the nodes of its scene put them.
//!
//! A `.glb` file is a header, a chunk of JSON and a chunk of bytes; a `.gltf` file is the JSON alone,
//! with its bytes in base64 or in files beside it. Axes are `y` up, lengths metres. Materials, skins
//! and animations are not used. Sparse and compressed meshes are refused.

use super::{Triangles, base64, text};
use serde::Deserialize;
use serde_json::{Map, Value};
use simbeeotic_units::glam::{DMat4, DQuat, DVec3};
use std::collections::BTreeMap;

/// Nodes inside nodes, at most.
const DEPTH_MAX: usize = 64;
/// Nodes in all, at most, a node counted each time that it is put somewhere.
const NODES_MAX: usize = 100_000;

const GLB: u32 = 0x4654_6c67;
const JSON_CHUNK: u32 = 0x4e4f_534a;
const BYTES_CHUNK: u32 = 0x004e_4942;

pub(super) fn parse(
    bytes: &[u8],
    other: impl Fn(&str) -> Result<Vec<u8>, String>,
) -> Result<Triangles, String> {
    let (json, inner) = match number(bytes, 0) {
        Some(GLB) => chunks(bytes)?,
        _ => (bytes, None),
    };
    let document: Document = serde_json::from_str(text(json)?).map_err(|e| e.to_string())?;
    if !document.asset.version.starts_with("2.") {
        return Err(format!("glTF 2 is read, not {}", document.asset.version));
    }
    if let Some(extension) = document.required.iter().find(|e| !harmless(e)) {
        return Err(format!(
            "it needs the extension {extension}, which is not read"
        ));
    }
    let buffers = document.buffers.iter().enumerate();
    let buffers: Result<Vec<Vec<u8>>, String> =
        buffers.map(|(at, b)| b.bytes(at, inner, &other)).collect();
    let mut reader = Reader {
        buffers: buffers?,
        document: &document,
        meshes: BTreeMap::new(),
        read: Triangles::default(),
        nodes: 0,
    };
    for root in document.roots()? {
        reader.node(root, DMat4::IDENTITY, 0)?;
    }
    Ok(reader.read)
}

/// Whether a file with this extension can be read without knowing it: it says how things look.
fn harmless(extension: &str) -> bool {
    extension.starts_with("KHR_materials_")
        || matches!(extension, "KHR_texture_transform" | "KHR_lights_punctual")
}

fn number(bytes: &[u8], at: usize) -> Option<u32> {
    let bytes = bytes.get(at..at.checked_add(4)?)?.try_into().ok()?;
    Some(u32::from_le_bytes(bytes))
}

/// The JSON and the bytes of a binary file.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), String> {
    if number(bytes, 4) != Some(2) {
        return Err("this is no binary glTF file of version 2".into());
    }
    let (mut json, mut inner, mut at) = (None, None, 12);
    while at < bytes.len() {
        let short = || format!("the file ends inside the chunk at byte {at}");
        let length = number(bytes, at).ok_or_else(short)? as usize;
        let kind = number(bytes, at + 4).ok_or_else(short)?;
        let chunk = bytes.get(at + 8..).and_then(|rest| rest.get(..length));
        let chunk = chunk.ok_or_else(short)?;
        match kind {
            JSON_CHUNK => json = json.or(Some(chunk)),
            BYTES_CHUNK => inner = inner.or(Some(chunk)),
            _ => {}
        }
        at += 8 + length;
    }
    json.map(|json| (json, inner))
        .ok_or_else(|| "there is no JSON in this file".into())
}

#[derive(Deserialize)]
struct Document {
    asset: Asset,
    #[serde(rename = "extensionsRequired", default)]
    required: Vec<String>,
    scene: Option<usize>,
    #[serde(default)]
    scenes: Vec<Scene>,
    #[serde(default)]
    nodes: Vec<Node>,
    #[serde(default)]
    meshes: Vec<MeshOf>,
    #[serde(default)]
    accessors: Vec<Accessor>,
    #[serde(rename = "bufferViews", default)]
    views: Vec<View>,
    #[serde(default)]
    buffers: Vec<Buffer>,
}

#[derive(Deserialize)]
struct Asset {
    version: String,
}

#[derive(Deserialize)]
struct Scene {
    #[serde(default)]
    nodes: Vec<usize>,
}

#[derive(Deserialize)]
struct Node {
    #[serde(default)]
    children: Vec<usize>,
    mesh: Option<usize>,
    matrix: Option<[f64; 16]>,
    translation: Option<[f64; 3]>,
    rotation: Option<[f64; 4]>,
    scale: Option<[f64; 3]>,
}

#[derive(Deserialize)]
struct MeshOf {
    primitives: Vec<Primitive>,
}

#[derive(Deserialize)]
struct Primitive {
    attributes: Map<String, Value>,
    indices: Option<usize>,
    #[serde(default = "triangles")]
    mode: u32,
    #[serde(default)]
    extensions: Map<String, Value>,
}

const fn triangles() -> u32 {
    4
}

#[derive(Deserialize)]
struct Accessor {
    #[serde(rename = "bufferView")]
    view: Option<usize>,
    #[serde(rename = "byteOffset", default)]
    offset: usize,
    #[serde(rename = "componentType")]
    component: u32,
    count: usize,
    #[serde(rename = "type")]
    kind: String,
    sparse: Option<Value>,
}

#[derive(Deserialize)]
struct View {
    buffer: usize,
    #[serde(rename = "byteOffset", default)]
    offset: usize,
    #[serde(rename = "byteLength")]
    length: usize,
    #[serde(rename = "byteStride")]
    stride: Option<usize>,
}

#[derive(Deserialize)]
struct Buffer {
    uri: Option<String>,
}

impl Buffer {
    fn bytes(
        &self,
        at: usize,
        inner: Option<&[u8]>,
        other: impl Fn(&str) -> Result<Vec<u8>, String>,
    ) -> Result<Vec<u8>, String> {
        let Some(uri) = &self.uri else {
            let inner = inner.filter(|_| at == 0).map(<[u8]>::to_vec);
            return inner.ok_or_else(|| format!("buffer {at} has no bytes"));
        };
        match uri
            .strip_prefix("data:")
            .and_then(|data| data.split_once(";base64,"))
        {
            Some((_, text)) => {
                base64::decode(text).ok_or_else(|| format!("buffer {at} is no base64"))
            }
            None => percent_decoded(uri)
                .and_then(|name| other(&name))
                .map_err(|message| format!("{uri}: {message}")),
        }
    }
}

/// The name of a file from a relative URI: `%20` is a space (RFC 3986, section 2.1).
pub(crate) fn percent_decoded(uri: &str) -> Result<String, String> {
    let mut name = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let [first, after @ ..] = rest {
        (rest, _) = match (first, after) {
            (b'%', [high, low, after @ ..]) => {
                let digit = |byte: &u8| char::from(*byte).to_digit(16);
                let (Some(high), Some(low)) = (digit(high), digit(low)) else {
                    return Err("two hexadecimal digits follow a `%`".into());
                };
                (after, name.push((16 * high + low) as u8))
            }
            (b'%', _) => return Err("two hexadecimal digits follow a `%`".into()),
            (byte, after) => (after, name.push(*byte)),
        };
    }
    String::from_utf8(name).map_err(|_| "its name is not UTF-8".into())
}

impl Document {
    /// The nodes of the scene; all that are nobody's children if there is none.
    fn roots(&self) -> Result<Vec<usize>, String> {
        match (self.scene, self.scenes.first()) {
            (Some(at), _) => {
                let scene = self.scenes.get(at);
                let scene = scene.ok_or_else(|| format!("there is no scene {at}"))?;
                Ok(scene.nodes.clone())
            }
            (None, Some(scene)) => Ok(scene.nodes.clone()),
            (None, None) => {
                let is_root = |at: &usize| !self.nodes.iter().any(|n| n.children.contains(at));
                Ok((0..self.nodes.len()).filter(is_root).collect())
            }
        }
    }
}

impl Node {
    fn pose(&self) -> DMat4 {
        if let Some(matrix) = &self.matrix {
            return DMat4::from_cols_array(matrix);
        }
        let [x, y, z, w] = self.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
        DMat4::from_scale_rotation_translation(
            DVec3::from_array(self.scale.unwrap_or([1.0; 3])),
            DQuat::from_xyzw(x, y, z, w),
            DVec3::from_array(self.translation.unwrap_or_default()),
        )
    }
}

struct Reader<'d> {
    document: &'d Document,
    buffers: Vec<Vec<u8>>,
    /// The triangles of a mesh as it is written, before a node puts it somewhere.
    meshes: BTreeMap<usize, Triangles>,
    read: Triangles,
    nodes: usize,
}

impl Reader<'_> {
    fn node(&mut self, at: usize, above: DMat4, depth: usize) -> Result<(), String> {
        let document = self.document;
        let node = document.nodes.get(at);
        let node = node.ok_or_else(|| format!("there is no node {at}"))?;
        self.nodes += 1;
        if depth > DEPTH_MAX || self.nodes > NODES_MAX {
            return Err("its nodes are nested too deeply, or in a circle".into());
        }
        let pose = above * node.pose();
        if let Some(mesh) = node.mesh {
            self.put(mesh, pose)?;
        }
        for child in &node.children {
            self.node(*child, pose, depth + 1)?;
        }
        Ok(())
    }

    /// Adds a mesh where a node puts it.
    fn put(&mut self, at: usize, pose: DMat4) -> Result<(), String> {
        if !self.meshes.contains_key(&at) {
            let mesh = self.mesh(at)?;
            self.meshes.insert(at, mesh);
        }
        let mesh = &self.meshes[&at];
        let base = u32::try_from(self.read.points.len()).map_err(|_| "it has too many points")?;
        if self.read.points.len() + mesh.points.len() > super::TRIANGLES_MAX * 3 {
            return Err("it has too many points".into());
        }
        for point in &mesh.points {
            let point = pose.transform_point3(DVec3::from_array(*point));
            if !point.is_finite() {
                return Err(format!("mesh {at} has a point that is no number"));
            }
            self.read.points.push(point.to_array());
        }
        // A mirror turns the triangles inside out.
        let mirrored = pose.determinant() < 0.0;
        for &[a, b, c] in &mesh.triangles {
            let corners = if mirrored { [a, c, b] } else { [a, b, c] };
            self.read.push(corners.map(|corner| base + corner))?;
        }
        Ok(())
    }

    fn mesh(&self, at: usize) -> Result<Triangles, String> {
        let mesh = self.document.meshes.get(at);
        let mesh = mesh.ok_or_else(|| format!("there is no mesh {at}"))?;
        let mut read = Triangles::default();
        for primitive in &mesh.primitives {
            self.primitive(primitive, &mut read)
                .map_err(|message| format!("mesh {at}: {message}"))?;
        }
        Ok(read)
    }

    fn primitive(&self, primitive: &Primitive, read: &mut Triangles) -> Result<(), String> {
        // Points and lines have no surface.
        if !(4..=6).contains(&primitive.mode) {
            return Ok(());
        }
        if let Some((name, _)) = primitive
            .extensions
            .iter()
            .find(|(e, _)| e.contains("draco"))
        {
            return Err(format!("it is compressed ({name}), which is not read"));
        }
        let position = primitive.attributes.get("POSITION").and_then(Value::as_u64);
        let position = position.ok_or("it has no points")?;
        let position = usize::try_from(position).map_err(|_| "it has no points")?;
        let base = u32::try_from(read.points.len()).map_err(|_| "it has too many points")?;
        let points = self.points(position)?;
        let count = points.len();
        read.points.extend(points);
        let corners = match primitive.indices {
            Some(at) => self.indices(at, count)?,
            None => (0..count as u32).collect(),
        };
        let corner = |i: usize| base + corners[i];
        let last = corners.len().saturating_sub(2);
        for i in 0..last {
            let triangle = match primitive.mode {
                4 if i % 3 != 0 => continue,
                5 if i % 2 == 1 => [i + 1, i, i + 2],
                6 => [0, i + 1, i + 2],
                _ => [i, i + 1, i + 2],
            };
            read.push(triangle.map(corner))?;
        }
        Ok(())
    }

    fn points(&self, at: usize) -> Result<Vec<[f64; 3]>, String> {
        let (accessor, bytes, stride) =
            self.accessor(at, |a| match (a.component, a.kind.as_str()) {
                (5126, "VEC3") => Some(12),
                _ => None,
            })?;
        let number = |item: usize, i: usize| {
            let from = item * stride + 4 * i;
            let four = bytes.get(from..from + 4).and_then(|b| b.try_into().ok());
            four.map_or(f64::NAN, |four| f64::from(f32::from_le_bytes(four)))
        };
        let point = |item: usize| {
            let point = [0, 1, 2].map(|i| number(item, i));
            match point.iter().all(|x| x.is_finite()) {
                true => Ok(point),
                false => Err(format!("point {item} is no number")),
            }
        };
        (0..accessor.count).map(point).collect()
    }

    fn indices(&self, at: usize, points: usize) -> Result<Vec<u32>, String> {
        let (accessor, bytes, stride) =
            self.accessor(at, |a| match (a.component, a.kind.as_str()) {
                (5121, "SCALAR") => Some(1),
                (5123, "SCALAR") => Some(2),
                (5125, "SCALAR") => Some(4),
                _ => None,
            })?;
        let index = |item: usize| {
            let at = item * stride;
            let index = match (accessor.component, &bytes[at..]) {
                (5121, [a, ..]) => u32::from(*a),
                (5123, [a, b, ..]) => u32::from(u16::from_le_bytes([*a, *b])),
                (5125, [a, b, c, d, ..]) => u32::from_le_bytes([*a, *b, *c, *d]),
                _ => u32::MAX,
            };
            match (index as usize) < points {
                true => Ok(index),
                false => Err(format!("there is no point {index}: there are {points}")),
            }
        };
        (0..accessor.count).map(index).collect()
    }

    /// An accessor, the bytes from its first item on, and how far apart its items are. `size` says how
    /// many bytes an item has, if it is of the right type. All items lie within the bytes.
    fn accessor(
        &self,
        at: usize,
        size: impl Fn(&Accessor) -> Option<usize>,
    ) -> Result<(&Accessor, &[u8], usize), String> {
        let document = self.document;
        let missing = |what: &str, at: usize| format!("there is no {what} {at}");
        let accessor = document
            .accessors
            .get(at)
            .ok_or_else(|| missing("accessor", at))?;
        if accessor.sparse.is_some() {
            return Err(format!("accessor {at} is sparse, which is not read"));
        }
        let size = size(accessor).ok_or_else(|| format!("accessor {at} is of the wrong type"))?;
        let view = accessor
            .view
            .ok_or_else(|| format!("accessor {at} has no bytes"))?;
        let view_of = document
            .views
            .get(view)
            .ok_or_else(|| missing("view", view))?;
        let buffer = self.buffers.get(view_of.buffer);
        let buffer = buffer.ok_or_else(|| missing("buffer", view_of.buffer))?;
        let stride = view_of.stride.unwrap_or(size);
        let bytes = buffer
            .get(view_of.offset..)
            .and_then(|rest| rest.get(..view_of.length))
            .and_then(|rest| rest.get(accessor.offset..));
        let needed = match accessor.count {
            0 => Some(0),
            count => (count - 1)
                .checked_mul(stride)
                .and_then(|n| n.checked_add(size)),
        };
        let short = || format!("accessor {at} reaches past the end of its bytes");
        let bytes = bytes.ok_or_else(short)?;
        if stride == 0 || needed.is_none_or(|needed| needed > bytes.len()) {
            return Err(short());
        }
        Ok((accessor, bytes, stride))
    }
}
