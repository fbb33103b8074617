//! The file end of a recording: whole records or nothing.

use std::fs::File;
use std::io::{self, ErrorKind, Seek, SeekFrom, Write};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};

/// What the run's thread may know about the file.
#[derive(Debug, Default)]
pub(crate) struct Progress {
    /// Bytes in the file: whole records, readable whatever happens next.
    bytes: AtomicU64,
    messages: AtomicU64,
    /// One more than the time of the last tick in the file; 0 if there is none.
    safe_ns: AtomicU64,
    failure: OnceLock<Arc<io::Error>>,
}

impl Progress {
    pub(crate) fn bytes(&self) -> u64 {
        self.bytes.load(Ordering::Relaxed)
    }

    pub(crate) fn messages(&self) -> u64 {
        self.messages.load(Ordering::Relaxed)
    }

    pub(crate) fn count_message(&self) {
        self.messages.fetch_add(1, Ordering::Relaxed);
    }

    pub(crate) fn safe_until_ns(&self) -> Option<u64> {
        self.safe_ns.load(Ordering::Acquire).checked_sub(1)
    }

    pub(crate) fn mark_safe(&self, time_ns: u64) {
        self.safe_ns
            .store(time_ns.saturating_add(1), Ordering::Release);
    }

    /// The first error; everything after it follows from it.
    pub(crate) fn failure(&self) -> Option<Arc<io::Error>> {
        self.failure.get().cloned()
    }

    pub(crate) fn fail(&self, error: io::Error) {
        let _ = self.failure.set(Arc::new(error));
    }
}

/// Collects what is written and hands it to the file at each flush, in one piece.
///
/// The MCAP writer flushes at record boundaries only, so the file holds whole records at any
/// time. When a write fails, the file is cut back to the last of them (best effort) and every
/// later write fails.
#[derive(Debug)]
pub(crate) struct Sink {
    file: File,
    pending: Vec<u8>,
    written: u64,
    progress: Arc<Progress>,
}

impl Sink {
    pub(crate) fn new(file: File, progress: Arc<Progress>) -> Self {
        Sink {
            file,
            pending: Vec::new(),
            written: 0,
            progress,
        }
    }

    fn position(&self) -> u64 {
        self.written + self.pending.len() as u64
    }
}

impl Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if let Some(first) = self.progress.failure.get() {
            return Err(io::Error::new(first.kind(), "the recording failed before"));
        }
        self.pending.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        if let Some(first) = self.progress.failure.get() {
            return Err(io::Error::new(first.kind(), "the recording failed before"));
        }
        if let Err(error) = self.file.write_all(&self.pending) {
            let _ = self.file.set_len(self.written);
            let kind = error.kind();
            self.progress.fail(error);
            return Err(kind.into());
        }
        self.written = self.position();
        self.pending.clear();
        self.progress.bytes.store(self.written, Ordering::Relaxed);
        Ok(())
    }
}

/// Tells the position, as the MCAP writer asks for; goes nowhere.
impl Seek for Sink {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        match to {
            SeekFrom::Current(0) => Ok(self.position()),
            _ => Err(ErrorKind::Unsupported.into()),
        }
    }
}
