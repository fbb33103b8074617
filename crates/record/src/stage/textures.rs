//! The pictures on the things of a world.

use crate::data::Attachment;
use simbeeotic_model::world::{Texture, World};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The bytes of all texture files of a world that are taken at most.
pub const TEXTURE_BYTES_MAX: u64 = 8 << 20;

/// What stands before the names of textures among the attachments of a recording.
pub const TEXTURES: &str = "textures/";

/// What a texture is called in a [`Prop`](super::Prop): `brick`, or the path of its file as the world has it. A file
/// that is called like a built-in one has `./` before its name.
pub(super) fn name_of(texture: &Texture) -> String {
    match texture {
        Texture::Builtin(name) => name.clone(),
        Texture::File(name) if Texture::is_builtin(name) => format!("./{name}"),
        Texture::File(name) => name.clone(),
    }
}

/// The texture files of a world, each once, and what there is to say about those that are missing.
///
/// Each is called `textures/` and its name in [`Prop::texture`](super::Prop::texture). Files that are not there or are neither
/// PNG nor JPEG are left out, and of several those that would make more than 8 MiB of all.
pub fn textures(world: &World) -> (Vec<Attachment>, Vec<String>) {
    let (mut files, mut notes) = (Vec::<Attachment>::new(), Vec::new());
    let mut left = TEXTURE_BYTES_MAX;
    let obstacles = world.obstacles.iter().map(|o| &o.texture);
    let structures = world.structures.iter().map(|s| &s.texture);
    let terrain = world.terrain.iter().map(|t| &t.texture);
    let ground = std::iter::once(&world.ground.texture);
    let all = obstacles.chain(structures).chain(terrain).chain(ground);
    let mut named: Vec<(&str, String)> = (all.flatten())
        .filter_map(|texture| match texture {
            Texture::File(file) => Some((file.as_str(), name_of(texture))),
            Texture::Builtin(_) => None,
        })
        .collect();
    named.sort_unstable();
    named.dedup();
    let folder = world.folder.as_deref().unwrap_or(Path::new(""));
    for (file, name) in named {
        match read(&folder.join(file), left) {
            Ok((bytes, media_type)) => {
                left -= bytes.len() as u64;
                files.push(Attachment {
                    name: format!("{TEXTURES}{name}"),
                    media_type: media_type.to_owned(),
                    bytes,
                });
            }
            Err(why) => notes.push(format!("texture {file} is left out: {why}")),
        }
    }
    (files, notes)
}

fn read(path: &Path, left: u64) -> Result<(Vec<u8>, &'static str), String> {
    // Devices and pipes may have no end.
    if !path.metadata().map_err(|e| e.to_string())?.is_file() {
        return Err("it is not a plain file".to_owned());
    }
    let file = File::open(path).map_err(|e| e.to_string())?;
    let mut bytes = Vec::new();
    let read = file.take(left + 1).read_to_end(&mut bytes);
    read.map_err(|e| e.to_string())?;
    if bytes.len() as u64 > left {
        let most = TEXTURE_BYTES_MAX >> 20;
        return Err(format!("with it there would be more than {most} MiB"));
    }
    match bytes.as_slice() {
        [0x89, b'P', b'N', b'G', ..] => Ok((bytes, "image/png")),
        [0xff, 0xd8, 0xff, ..] => Ok((bytes, "image/jpeg")),
        _ => Err("it is neither PNG nor JPEG".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::super::Stage;
    use super::*;
    use simbeeotic_model::world::Obstacle;

    fn world(folder: &Path, files: &[&str]) -> World {
        let obstacle = |file: &&str| Obstacle {
            texture: Some(Texture::File((*file).to_owned())),
            ..Obstacle::default()
        };
        World {
            obstacles: files.iter().map(obstacle).collect(),
            folder: Some(folder.to_owned()),
            ..World::default()
        }
    }

    #[test]
    fn each_file_is_taken_once_under_the_name_that_its_things_have() {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::create_dir(folder.path().join("pictures")).expect("made");
        let png = b"\x89PNG, it says".as_slice();
        std::fs::write(folder.path().join("pictures/a.png"), png).expect("written");
        std::fs::write(folder.path().join("brick"), b"\xff\xd8\xff").expect("written");
        std::fs::write(folder.path().join("lawn.jpg"), b"\xff\xd8\xff").expect("written");
        let mut world = world(
            folder.path(),
            &["pictures/a.png", "brick", "pictures/a.png"],
        );
        world.ground.texture = Some(Texture::File("lawn.jpg".to_owned()));

        let (files, notes) = textures(&world);
        let names: Vec<_> = (files.iter())
            .map(|file| (file.name.as_str(), file.media_type.as_str()))
            .collect();
        assert_eq!(
            names,
            [
                ("textures/./brick", "image/jpeg"),
                ("textures/lawn.jpg", "image/jpeg"),
                ("textures/pictures/a.png", "image/png")
            ]
        );
        assert_eq!(notes, [""; 0]);
        let stage = Stage::of(&world, 1);
        let on_things = stage.props.iter().map(|prop| &prop.texture);
        for texture in on_things.chain([&stage.texture]) {
            let name = format!("{TEXTURES}{texture}");
            assert!(files.iter().any(|file| file.name == name), "{name}");
        }
    }

    #[test]
    fn what_is_missing_too_large_or_no_picture_is_told() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut large = b"\x89PNG".to_vec();
        large.resize(TEXTURE_BYTES_MAX as usize - 10, 0);
        std::fs::write(folder.path().join("a.png"), &large).expect("written");
        std::fs::write(folder.path().join("b.png"), b"\x89PNG and more").expect("written");
        std::fs::write(folder.path().join("c.png"), b"BM").expect("written");
        let world = world(folder.path(), &["a.png", "b.png", "c.png", "none.png", "."]);
        let (files, notes) = textures(&world);
        assert_eq!(files.len(), 1);
        assert_eq!(notes.len(), 4);
        assert!(
            notes
                .iter()
                .any(|n| n.contains("b.png") && n.contains("8 MiB"))
        );
        assert!(
            notes
                .iter()
                .any(|n| n.contains("c.png") && n.contains("neither"))
        );
        assert!(notes.iter().any(|n| n.contains("none.png")));
    }
}
