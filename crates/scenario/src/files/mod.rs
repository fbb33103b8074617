//! The files that a world names: meshes, grids of heights, pictures.
//!
//! Paths count from the folder of the world file. What is wrong with a file is told at the key that
//! names it, with the place inside the file. A file that several objects name is read once.
//!
//! Reading order: `stl`, `obj`, `gltf` (meshes), `grid`, `picture` (heights).

mod base64;
mod gltf;
mod grid;
mod obj;
mod picture;
mod stl;

pub(crate) use gltf::percent_decoded;

use crate::limit::FILE_BYTES_MAX;
use simbeeotic_units::{Length, Offset};
use simbeeotic_world::{
    HeightField, Hull, Mesh, Obstacle, ObstacleShape, Texture, UpAxis, World, WorldError,
};
use std::collections::BTreeMap;
use std::fs;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What is wrong with the files of a world.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Found {
    /// What the world cannot be without.
    pub(crate) errors: Vec<WorldError>,
    /// Textures that are not there: only views would show them.
    pub(crate) warnings: Vec<WorldError>,
}

/// Reads all files that a world names, and fills in what they hold. What cannot be read keeps its
/// name.
pub(crate) fn fill(world: &mut World, folder: &Path) -> Found {
    let mut files = Files {
        folder,
        meshes: BTreeMap::new(),
        textures: 0,
        found: Found::default(),
    };
    for (i, obstacle) in world.obstacles.iter_mut().enumerate() {
        files.obstacle(&format!("obstacle.{i}"), obstacle);
    }
    for (i, structure) in world.structures.iter().enumerate() {
        files.texture(&format!("structure.{i}"), structure.texture.as_ref());
    }
    files.texture("ground", world.ground.texture.as_ref());
    if let Some(terrain) = &mut world.terrain {
        files.texture("terrain", terrain.texture.as_ref());
        files.heights("terrain.height_field", &mut terrain.height_field);
    }
    let (textures, found) = (files.textures, files.found);
    if textures > 0 {
        world.folder = Some(folder.to_owned());
    }
    found
}

/// Triangles as a file has them.
#[derive(Clone, Debug, Default, PartialEq)]
struct Triangles {
    points: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

/// More triangles than this are refused.
const TRIANGLES_MAX: usize = 4_000_000;

impl Triangles {
    /// Adds a triangle; one without area by its corners' numbers is left out.
    fn push(&mut self, corners: [u32; 3]) -> Result<(), String> {
        let [a, b, c] = corners;
        if a == b || b == c || c == a {
            return Ok(());
        }
        if self.triangles.len() >= TRIANGLES_MAX {
            return Err(format!("it has more than {TRIANGLES_MAX} triangles"));
        }
        self.triangles.push(corners);
        Ok(())
    }
}

/// Points by what they are, so that each is kept once.
#[derive(Default)]
struct Corners {
    numbers: BTreeMap<[u64; 3], u32>,
}

impl Corners {
    fn number(&mut self, point: [f64; 3], all: &mut Vec<[f64; 3]>) -> u32 {
        // Adding zero makes the two zeros one.
        let key = point.map(|x| (x + 0.0).to_bits());
        *self.numbers.entry(key).or_insert_with(|| {
            all.push(point);
            all.len() as u32 - 1
        })
    }
}

/// What a mesh file holds, with the axis that points up in its format; or what is wrong with it.
type Read = Result<(Arc<Triangles>, UpAxis), String>;

struct Files<'f> {
    folder: &'f Path,
    meshes: BTreeMap<PathBuf, Read>,
    /// How many textures are there.
    textures: usize,
    found: Found,
}

impl Files<'_> {
    fn fault(&mut self, path: String, message: String) {
        self.found.errors.push(WorldError {
            path,
            message,
            help: None,
        });
    }

    fn obstacle(&mut self, path: &str, obstacle: &mut Obstacle) {
        self.texture(path, obstacle.texture.as_ref());
        if let ObstacleShape::Parts(parts) = &mut obstacle.shape {
            for (i, part) in parts.iter_mut().enumerate() {
                self.shape(&format!("{path}.shape.parts.{i}.shape"), &mut part.shape);
            }
        } else {
            self.shape(&format!("{path}.shape"), &mut obstacle.shape);
        }
    }

    fn shape(&mut self, path: &str, shape: &mut ObstacleShape) {
        match shape {
            ObstacleShape::Mesh(mesh) => self.mesh(&format!("{path}.mesh"), mesh),
            ObstacleShape::Hull(hull) => self.hull(&format!("{path}.hull"), hull),
            _ => {}
        }
    }

    fn mesh(&mut self, path: &str, mesh: &mut Mesh) {
        let Some(name) = mesh.file.clone() else {
            self.alone(path, mesh.scale, mesh.up);
            return;
        };
        if !(mesh.points.is_empty() && mesh.triangles.is_empty()) {
            let message = "a mesh has a file, or points and triangles of its own, not both";
            self.fault(format!("{path}.points"), message.into());
        } else if is_scale(mesh.scale)
            && let Some((read, up)) = self.read_mesh(path, &name)
        {
            mesh.points = points(&read, mesh.scale, mesh.up.unwrap_or(up));
            mesh.triangles = read.triangles.as_slice().into();
            mesh.file = None;
            (mesh.scale, mesh.up) = (1.0, None);
        }
    }

    fn hull(&mut self, path: &str, hull: &mut Hull) {
        let Some(name) = hull.file.clone() else {
            self.alone(path, hull.scale, hull.up);
            return;
        };
        if !hull.points.is_empty() {
            let message = "a hull has a file, or points of its own, not both";
            self.fault(format!("{path}.points"), message.into());
        } else if is_scale(hull.scale)
            && let Some((read, up)) = self.read_mesh(path, &name)
        {
            hull.points = points(&read, hull.scale, hull.up.unwrap_or(up));
            hull.file = None;
            (hull.scale, hull.up) = (1.0, None);
        }
    }

    /// `scale` and `up` say how a file is meant; without one they say nothing.
    fn alone(&mut self, path: &str, scale: f64, up: Option<UpAxis>) {
        let message = "this says how a `file` is meant, and there is none";
        if scale != 1.0 {
            self.fault(format!("{path}.scale"), message.into());
        }
        if up.is_some() {
            self.fault(format!("{path}.up"), message.into());
        }
    }

    fn read_mesh(&mut self, path: &str, name: &str) -> Option<(Arc<Triangles>, UpAxis)> {
        let file = self.folder.join(name);
        let read = match self.meshes.get(&file) {
            Some(read) => read.clone(),
            None => {
                let read = read_mesh(&file);
                self.meshes.insert(file, read.clone());
                read
            }
        };
        read.map_err(|message| self.fault(format!("{path}.file"), format!("{name}: {message}")))
            .ok()
    }

    fn heights(&mut self, path: &str, field: &mut HeightField) {
        let Some(name) = field.file.clone() else {
            for (key, height) in [
                ("min_height", field.min_height),
                ("max_height", field.max_height),
            ] {
                if height.is_some() {
                    let message = "this says how a `file` is meant, and there is none";
                    self.fault(format!("{path}.{key}"), message.into());
                }
            }
            return;
        };
        if !field.heights.is_empty() {
            let message = "terrain has a file, or heights of its own, not both";
            self.fault(format!("{path}.heights"), message.into());
            return;
        }
        let before = self.found.errors.len();
        // A picture's black is at 0 m if nothing is said.
        let low = field.min_height.unwrap_or(Length::ZERO);
        if let Some(high) = field.max_height
            && !(high > low && low.is_finite() && high.is_finite())
        {
            let message = format!("`max_height` is more than `min_height`, not {high} and {low}");
            self.fault(format!("{path}.max_height"), message);
        }
        match read_grid(&self.folder.join(&name), field) {
            Ok(grid) => {
                for (key, size) in [("length", &mut field.length), ("width", &mut field.width)] {
                    let of_grid = match key {
                        "length" => grid.length_m,
                        _ => grid.width_m,
                    };
                    match (of_grid, *size == Length::ZERO) {
                        (Some(metres), true) => *size = Length::si(metres),
                        (Some(metres), false) => {
                            let message = format!("{name} says itself that this is {metres} m");
                            self.fault(format!("{path}.{key}"), message);
                        }
                        (None, true) => {
                            let message = format!("`{key}` is missing: {name} does not say it");
                            self.fault(format!("{path}.{key}"), message);
                        }
                        (None, false) => {}
                    }
                }
                if self.found.errors.len() == before {
                    let row = |row: Vec<f64>| row.into_iter().map(Length::si).collect();
                    field.heights = grid.rows.into_iter().map(row).collect();
                    field.file = None;
                    (field.min_height, field.max_height) = (None, None);
                }
            }
            Err(message) => self.fault(format!("{path}.file"), format!("{name}: {message}")),
        }
    }

    fn texture(&mut self, path: &str, texture: Option<&Texture>) {
        let Some(Texture::File(name)) = texture else {
            return;
        };
        let read = read_start(&self.folder.join(name), 8);
        let checked = read.and_then(|bytes| match bytes.as_slice() {
            [0x89, b'P', b'N', b'G', ..] | [0xff, 0xd8, 0xff, ..] => Ok(()),
            _ => Err("this is neither a PNG nor a JPEG picture".into()),
        });
        if let Err(message) = checked {
            self.found.warnings.push(WorldError {
                path: format!("{path}.texture.file"),
                message: format!("{name}: {message}"),
                help: Some("nothing but a view needs it; there the plain colour is shown".into()),
            });
        } else {
            self.textures += 1;
        }
    }
}

/// Whether a scale is one. Of one that is not the world's own check tells.
fn is_scale(scale: f64) -> bool {
    scale > 0.0 && scale.is_finite()
}

fn points(read: &Triangles, scale: f64, up: UpAxis) -> Arc<[Offset]> {
    let point = |point: &[f64; 3]| {
        let [x, y, z] = up.turn(*point).map(|x| x * scale);
        Offset::from_xyz(x, y, z)
    };
    read.points.iter().map(point).collect()
}

/// The bytes of a file that is not too large.
fn read(path: &Path) -> Result<Vec<u8>, String> {
    let bytes = read_start(path, FILE_BYTES_MAX + 1)?;
    if bytes.len() as u64 > FILE_BYTES_MAX {
        let most = FILE_BYTES_MAX >> 20;
        return Err(format!("it is too large: at most {most} MiB are read"));
    }
    Ok(bytes)
}

/// The first bytes of a file, at most so many. Devices and pipes are refused unopened: they may have
/// no end, or nobody who writes.
fn read_start(path: &Path, most: u64) -> Result<Vec<u8>, String> {
    if !fs::metadata(path).map_err(|e| e.to_string())?.is_file() {
        return Err("this is not a plain file".into());
    }
    let file = fs::File::open(path).map_err(|e| e.to_string())?;
    let mut bytes = Vec::new();
    let read = file.take(most).read_to_end(&mut bytes);
    read.map(|_| bytes).map_err(|e| e.to_string())
}

fn text(bytes: &[u8]) -> Result<&str, String> {
    let text = std::str::from_utf8(bytes);
    text.map_err(|e| format!("from byte {} on this is not text", e.valid_up_to()))
}

fn extension(path: &Path) -> String {
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    extension.to_ascii_lowercase()
}

fn read_mesh(path: &Path) -> Read {
    let extension = extension(path);
    if !matches!(extension.as_str(), "stl" | "obj" | "gltf" | "glb") {
        return Err("a mesh is a file `.stl`, `.obj`, `.gltf` or `.glb`".into());
    }
    let bytes = read(path)?;
    let (triangles, up) = match extension.as_str() {
        "stl" => (stl::parse(&bytes)?, UpAxis::Z),
        "obj" => (obj::parse(text(&bytes)?)?, UpAxis::Y),
        _ => {
            let folder = path.parent().unwrap_or(Path::new(""));
            let other = |name: &str| read(&folder.join(name));
            (gltf::parse(&bytes, other)?, UpAxis::Y)
        }
    };
    if triangles.triangles.is_empty() {
        return Err("there is no triangle in it".into());
    }
    Ok((Arc::new(triangles), up))
}

/// Heights as a file has them: rows from south to north, in metres.
struct Grid {
    rows: Vec<Vec<f64>>,
    length_m: Option<f64>,
    width_m: Option<f64>,
}

fn read_grid(path: &Path, field: &HeightField) -> Result<Grid, String> {
    let range = (field.min_height, field.max_height);
    let range = (range.0.map(Length::get), range.1.map(Length::get));
    let mut grid = match extension(path).as_str() {
        "png" => picture::parse(&read(path)?, range)?,
        "asc" => grid::stretch(grid::parse_asc(text(&read(path)?)?)?, range)?,
        "csv" => grid::stretch(grid::parse_csv(text(&read(path)?)?)?, range)?,
        _ => return Err("terrain is a file `.png`, `.asc` or `.csv`".into()),
    };
    // Files begin in the north.
    grid.rows.reverse();
    Ok(grid)
}

#[cfg(test)]
mod tests;
