//! Films as MP4, by a program `ffmpeg` that is on the PATH.

use super::{Picture, RenderError};
use std::ffi::OsString;
use std::io::{ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::JoinHandle;

/// Writes an MP4 (H.264, 4:2:0), picture by picture. The file appears when it is complete; a film that is
/// dropped before leaves none.
#[derive(Debug)]
pub struct Mp4 {
    path: PathBuf,
    part: PathBuf,
    child: Child,
    said: Option<JoinHandle<String>>,
    done: bool,
}

impl Mp4 {
    /// Begins a film.
    ///
    /// # Errors
    /// If a side has an odd number of pixels, which the format does not have; if there is no `ffmpeg`.
    pub fn new(path: &Path, size: [u32; 2], rate_hz: f64) -> Result<Self, RenderError> {
        Self::by("ffmpeg", path, size, rate_hz)
    }

    fn by(program: &str, path: &Path, size: [u32; 2], rate_hz: f64) -> Result<Self, RenderError> {
        if size.iter().any(|side| !side.is_multiple_of(2)) {
            return Err(RenderError::Form(format!(
                "{} x {} pixels: an .mp4 has an even number of them, both ways",
                size[0], size[1]
            )));
        }
        let Some(name) = path.file_name() else {
            let source =
                std::io::Error::new(ErrorKind::InvalidInput, "this is the name of a folder");
            return Err(RenderError::io(path, source));
        };
        // Beside the film, under a name that nobody takes for it.
        let mut hidden = OsString::from(".");
        hidden.push(name);
        hidden.push(format!(".{}.part", std::process::id()));
        let part = path.with_file_name(hidden);
        let mut command = Command::new(program);
        command
            .args(["-hide_banner", "-loglevel", "error", "-nostdin", "-y"])
            .args(["-f", "rawvideo", "-pix_fmt", "rgb24"])
            .args(["-s", &format!("{}x{}", size[0], size[1])])
            .args(["-r", &rate_hz.to_string(), "-i", "-"])
            .args(["-an", "-c:v", "libx264", "-preset", "medium", "-crf", "18"])
            .args(["-vf", "scale=out_color_matrix=bt709:out_range=tv"])
            .args([
                "-colorspace",
                "bt709",
                "-color_primaries",
                "bt709",
                "-color_trc",
                "bt709",
            ])
            .args([
                "-pix_fmt",
                "yuv420p",
                "-movflags",
                "+faststart",
                "-f",
                "mp4",
            ])
            .arg(part_argument(&part))
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped());
        let mut child = command.spawn().map_err(|source| match source.kind() {
            ErrorKind::NotFound => RenderError::NoFfmpeg(path.to_path_buf()),
            _ => RenderError::io(path, source),
        })?;
        let said = child.stderr.take().map(|mut stderr| {
            std::thread::spawn(move || {
                let mut said = Vec::new();
                let _ = stderr.read_to_end(&mut said);
                String::from_utf8_lossy(&said).trim().to_owned()
            })
        });
        Ok(Self {
            path: path.to_path_buf(),
            part,
            child,
            said,
            done: false,
        })
    }

    /// Adds a picture.
    ///
    /// # Errors
    /// If `ffmpeg` has ended.
    pub fn add(&mut self, picture: &Picture) -> Result<(), RenderError> {
        let written = match &mut self.child.stdin {
            Some(stdin) => stdin.write_all(&picture.rgb),
            None => Ok(()),
        };
        written.map_err(|_| {
            let _ = self.child.wait();
            self.failed()
        })
    }

    /// Ends the film, and gives it its name.
    ///
    /// # Errors
    /// If `ffmpeg` failed, or the file cannot be named.
    pub fn finish(mut self) -> Result<(), RenderError> {
        drop(self.child.stdin.take());
        let ended = self.child.wait();
        let ended = ended.map_err(|source| RenderError::io(&self.path, source))?;
        if !ended.success() {
            return Err(self.failed());
        }
        std::fs::rename(&self.part, &self.path)
            .map_err(|source| RenderError::io(&self.path, source))?;
        self.done = true;
        Ok(())
    }

    fn failed(&mut self) -> RenderError {
        let said = self.said.take().and_then(|said| said.join().ok());
        let said = said.filter(|said| !said.is_empty());
        RenderError::Ffmpeg {
            path: self.path.clone(),
            said: said.unwrap_or_else(|| "it ended without a word".to_owned()),
        }
    }
}

/// A name that is none of `ffmpeg`'s options or protocols.
fn part_argument(part: &Path) -> OsString {
    let mut argument = OsString::from("file:");
    argument.push(part);
    argument
}

impl Drop for Mp4 {
    fn drop(&mut self) {
        if self.done {
            return;
        }
        drop(self.child.stdin.take());
        let _ = self.child.kill();
        let _ = self.child.wait();
        let _ = std::fs::remove_file(&self.part);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(light: u8) -> Picture {
        Picture {
            width: 64,
            height: 48,
            rgb: vec![light; 64 * 48 * 3],
        }
    }

    /// Grey, with a red block of eight by sixteen pixels.
    fn moved(k: usize) -> Picture {
        let mut picture = picture(30 + 20 * k as u8);
        for (x, y) in (8 * k..8 * k + 8).flat_map(|x| (12..28).map(move |y| (x, y))) {
            picture.rgb[3 * (64 * y + x)..][..3].copy_from_slice(&[200, 40, 30]);
        }
        picture
    }

    fn there(program: &str) -> bool {
        Command::new(program)
            .arg("-version")
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status()
            .is_ok()
    }

    #[test]
    fn a_film_has_its_pictures_and_its_size() {
        if !there("ffmpeg") || !there("ffprobe") {
            return;
        }
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("film.mp4");
        let mut film = Mp4::new(&path, [64, 48], 25.0).expect("begun");
        for k in 0..7 {
            film.add(&moved(k)).expect("added");
        }
        film.finish().expect("written");
        let probe = Command::new("ffprobe")
            .args(["-v", "error", "-count_frames", "-select_streams", "v:0"])
            .args([
                "-show_entries",
                "stream=width,height,nb_read_frames,pix_fmt,r_frame_rate",
            ])
            .args(["-of", "default=noprint_wrappers=1"])
            .arg(&path)
            .output()
            .expect("ffprobe");
        let said = String::from_utf8_lossy(&probe.stdout).into_owned();
        for line in [
            "width=64",
            "height=48",
            "nb_read_frames=7",
            "pix_fmt=yuv420p",
            "r_frame_rate=25/1",
        ] {
            assert!(said.lines().any(|found| found == line), "{line}: {said}");
        }
        let files = std::fs::read_dir(folder.path()).expect("a folder").count();
        assert_eq!(files, 1);

        // What comes back is what was put in: a block that goes from left to right, before more and more light.
        let read = Command::new("ffmpeg")
            .args(["-v", "error", "-nostdin", "-i"])
            .arg(&path)
            .args(["-f", "rawvideo", "-pix_fmt", "rgb24", "-"])
            .output()
            .expect("ffmpeg");
        let shown: Vec<&[u8]> = read.stdout.chunks(64 * 48 * 3).collect();
        assert_eq!(shown.len(), 7);
        for (k, rgb) in shown.iter().enumerate() {
            let own = moved(k);
            for (x, y) in [(8 * k + 4, 20), (60, 5), (2, 45)] {
                let at = 3 * (64 * y + x);
                for part in 0..3 {
                    let off = rgb[at + part].abs_diff(own.rgb[at + part]);
                    assert!(off <= 6, "picture {k}, {x}, {y}: {off}");
                }
            }
        }
    }

    #[test]
    fn a_film_that_is_left_leaves_nothing() {
        if !there("ffmpeg") {
            return;
        }
        let folder = tempfile::tempdir().expect("a folder");
        let mut film = Mp4::new(&folder.path().join("film.mp4"), [64, 48], 25.0).expect("begun");
        film.add(&picture(9)).expect("added");
        drop(film);
        assert_eq!(
            std::fs::read_dir(folder.path()).expect("a folder").count(),
            0
        );
    }

    #[test]
    fn without_ffmpeg_it_says_what_to_do() {
        let missing = Mp4::by("no-such-program-here", Path::new("a.mp4"), [64, 48], 25.0);
        let said = missing.expect_err("there is none").to_string();
        assert!(said.contains("install") && said.contains(".gif"), "{said}");
    }

    #[test]
    fn an_odd_size_is_refused() {
        let odd = Mp4::new(Path::new("a.mp4"), [65, 48], 25.0);
        let said = odd.expect_err("odd").to_string();
        assert!(said.contains("65 x 48"), "{said}");
    }
}
