//! Files that appear whole or not at all.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

/// Writes a file beside `path` and gives it that name when it is complete and on the disk.
///
/// Whoever opens `path` sees the old file or the new one, never a part. After an error the new
/// one is removed; after a `kill -9` it may stay, as `.NAME.PID-N.part`. A link is followed. What is
/// there and is no file (`/dev/null`, a pipe) is written to as it is, and not replaced.
///
/// # Errors
/// Whatever `write` returns, and the errors of the file system.
pub fn publish<T, E: From<io::Error>>(
    path: &Path,
    write: impl FnOnce(&File) -> Result<T, E>,
) -> Result<T, E> {
    let path = &fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    if fs::metadata(path).is_ok_and(|there| !there.is_file()) {
        return write(&File::options().write(true).open(path)?);
    }
    let part = part_of(path)?;
    let written = File::create_new(&part)
        .map_err(E::from)
        .and_then(|file| {
            let value = write(&file)?;
            file.sync_all()?;
            Ok(value)
        })
        .and_then(|value| {
            fs::rename(&part, path)?;
            Ok(value)
        });
    if written.is_err() {
        let _ = fs::remove_file(&part);
    }
    written
}

/// Whether [`publish`] could write `path` now. It makes the file beside it, and removes it again; what is
/// there and is no file is left alone.
///
/// # Errors
/// A folder has this name, or no file can be made beside it.
pub fn publishable(path: &Path) -> io::Result<()> {
    let path = &fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    match fs::metadata(path) {
        Ok(there) if there.is_dir() => Err(io::Error::new(
            io::ErrorKind::IsADirectory,
            "this is a folder, and a file is wanted",
        )),
        Ok(there) if !there.is_file() => Ok(()),
        _ => {
            let part = part_of(path)?;
            File::create_new(&part)?;
            fs::remove_file(&part)
        }
    }
}

fn part_of(path: &Path) -> io::Result<PathBuf> {
    static COUNT: AtomicU32 = AtomicU32::new(0);

    let Some(name) = path.file_name() else {
        return Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            "this is the name of a folder",
        ));
    };
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    let mut part = OsString::from(".");
    part.push(name);
    part.push(format!(".{}-{number}.part", std::process::id()));
    Ok(path.with_file_name(part))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    #[test]
    fn a_failed_file_leaves_the_old_one_and_no_rubbish() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("table");
        publish(&path, |mut file| file.write_all(b"old")).expect("written");

        let failed: io::Result<()> = publish(&path, |mut file| {
            file.write_all(b"half of the n")?;
            Err(io::Error::other("no more"))
        });

        assert!(failed.is_err());
        assert_eq!(fs::read(&path).expect("still there"), b"old");
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1);
    }

    #[test]
    fn what_can_be_written_is_known_before_and_nothing_is_left_of_the_question() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("table");
        publishable(&path).expect("it is not there yet");
        fs::write(&path, "old").expect("written");
        publishable(&path).expect("it is there");
        assert_eq!(fs::read(&path).expect("still there"), b"old");
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 1);
        assert!(publishable(folder.path()).is_err(), "a folder");
        assert!(publishable(&folder.path().join("none/table")).is_err());
    }

    #[test]
    fn a_folder_is_no_file_name() {
        assert!(publish(Path::new("/"), |_| io::Result::Ok(())).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_and_devices_stay_devices() {
        let folder = tempfile::tempdir().expect("a folder");
        let (path, link) = (folder.path().join("table"), folder.path().join("link"));
        fs::write(&path, "old").expect("written");
        std::os::unix::fs::symlink(&path, &link).expect("linked");
        publish(&link, |mut file| file.write_all(b"new")).expect("written");
        assert!(link.is_symlink());
        assert_eq!(fs::read(&path).expect("still there"), b"new");

        let device = folder.path().join("device");
        std::os::unix::fs::symlink("/dev/null", &device).expect("linked");
        publish(&device, |mut file| file.write_all(b"gone")).expect("written");
        assert_eq!(fs::read(&device).expect("still there"), b"");
    }
}
