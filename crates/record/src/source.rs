//! Reading pieces of a file by their place.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// An open file of known length. Several readers may share it.
#[derive(Debug)]
pub(crate) struct Source {
    file: Mutex<File>,
    len: u64,
}

impl Source {
    pub(crate) fn open(path: &Path) -> io::Result<Source> {
        let mut file = File::open(path)?;
        // Not the length in the metadata: a device has none there.
        let len = file.seek(SeekFrom::End(0))?;
        Ok(Source {
            file: Mutex::new(file),
            len,
        })
    }

    pub(crate) fn len(&self) -> u64 {
        self.len
    }

    /// Reads `length` bytes from `offset` on into `bytes`, replacing what it held. `false` when
    /// the file ends before; nothing is allocated for bytes that are not there.
    pub(crate) fn read(&self, offset: u64, length: u64, bytes: &mut Vec<u8>) -> io::Result<bool> {
        bytes.clear();
        match offset.checked_add(length) {
            Some(end) if end <= self.len => {}
            _ => return Ok(false),
        }
        // A poisoned lock means that another reader panicked; each seeks for itself.
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.seek(SeekFrom::Start(offset))?;
        // The file may have become shorter since it was opened.
        let read = Read::by_ref(&mut *file).take(length).read_to_end(bytes)?;
        Ok(read as u64 == length)
    }
}
