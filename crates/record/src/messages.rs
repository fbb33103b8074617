//! Walks over the messages of a recording, chunk by chunk.

use crate::chunk;
use crate::frame::{Fields, MessageHeader, op};
use crate::index::{self, Channels, ChunkEntry};
use crate::recording::{ReadError, Recording};
use crate::topic::Topic;
use prost::Message;
use std::ops::{Range, RangeInclusive};

/// The messages of some topics at some times, in the order of the file.
#[derive(Debug)]
pub(crate) struct Messages<'a> {
    recording: &'a Recording,
    wanted: &'static [Topic],
    times_ns: RangeInclusive<u64>,
    channels: Channels,
    /// Chunks not yet opened.
    chunks: &'a [ChunkEntry],
    /// Where the open chunk stands in the file.
    chunk_at: u64,
    /// The records of the open chunk.
    bytes: Vec<u8>,
    /// How many of them were read.
    read: usize,
}

/// One message; its bytes stand in the iterator's chunk.
pub(crate) struct Found {
    pub(crate) topic: Topic,
    pub(crate) time_ns: u64,
    place: Range<usize>,
}

impl<'a> Messages<'a> {
    pub(crate) fn new(
        recording: &'a Recording,
        wanted: &'static [Topic],
        times_ns: RangeInclusive<u64>,
    ) -> Self {
        Messages {
            recording,
            wanted,
            times_ns,
            channels: recording.index.channels.clone(),
            chunks: &recording.index.chunks,
            chunk_at: 0,
            bytes: Vec::new(),
            read: 0,
        }
    }

    /// The next message. After an error, the next one behind the damaged chunk.
    pub(crate) fn next(&mut self) -> Option<Result<Found, ReadError>> {
        loop {
            while self.read < self.bytes.len() {
                match self.next_in_chunk() {
                    Ok(Some(found)) => return Some(Ok(found)),
                    Ok(None) => {}
                    Err(what) => {
                        self.read = self.bytes.len();
                        return Some(Err(self.recording.damaged(self.chunk_at, what)));
                    }
                }
            }
            let (entry, rest) = self.chunks.split_first()?;
            self.chunks = rest;
            if !self.may_hold_wanted(entry) {
                continue;
            }
            self.read = 0;
            self.chunk_at = entry.extent.offset;
            match chunk::load(&self.recording.source, entry) {
                Ok(bytes) => self.bytes = bytes,
                Err(error) => {
                    self.bytes.clear();
                    return Some(Err(self.recording.chunk_error(self.chunk_at, error)));
                }
            }
        }
    }

    /// Reads one record; `None` if it is not a wanted message.
    fn next_in_chunk(&mut self) -> Result<Option<Found>, &'static str> {
        let mut rest = Fields(&self.bytes[self.read..]);
        let (opcode, body) = rest.record().ok_or("a record longer than its chunk")?;
        let end = self.bytes.len() - rest.0.len();
        self.read = end;

        match opcode {
            op::CHANNEL => {
                index::add_channel(&mut self.channels, body).ok_or("a bad channel")?;
                Ok(None)
            }
            op::MESSAGE => {
                let mut fields = Fields(body);
                let header = MessageHeader::read(&mut fields).ok_or("a bad message")?;
                let Some(&topic) = self.channels.get(&header.channel) else {
                    return Ok(None);
                };
                let wanted = self.wanted.contains(&topic);
                let found = Found {
                    topic,
                    time_ns: header.time_ns,
                    place: end - fields.0.len()..end,
                };
                Ok((wanted && self.times_ns.contains(&header.time_ns)).then_some(found))
            }
            _ => Ok(None),
        }
    }

    fn may_hold_wanted(&self, chunk: &ChunkEntry) -> bool {
        let in_time =
            chunk.start_ns <= *self.times_ns.end() && chunk.end_ns >= *self.times_ns.start();
        // A channel that is not known yet may be declared in this very chunk.
        let wanted = |id: &u16| match self.channels.get(id) {
            Some(topic) => self.wanted.contains(topic),
            None => true,
        };
        in_time
            && chunk
                .channels
                .as_ref()
                .is_none_or(|ids| ids.iter().any(|(id, _)| wanted(id)))
    }

    pub(crate) fn decode<M: Message + Default>(&self, found: &Found) -> Result<M, ReadError> {
        M::decode(&self.bytes[found.place.clone()])
            .map_err(|error| self.damaged(format!("a message of {}: {error}", found.topic.name())))
    }

    /// Something is wrong with the message found last.
    pub(crate) fn damaged(&self, what: impl ToString) -> ReadError {
        self.recording.damaged(self.chunk_at, what)
    }

    pub(crate) fn into_channels(self) -> Channels {
        self.channels
    }
}
