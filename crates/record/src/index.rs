//! Finds out where things are in a file.
//!
//! A finished file says so itself, in its summary. A file without one (the process was killed,
//! the disk was full, somebody cut the file) is walked from record to record: chunks are skipped,
//! so this reads only a few bytes for each megabyte. Whatever follows the first record that makes
//! no sense is ignored.

use crate::chunk;
use crate::frame::{self, ChunkHeader, Fields, MAGIC, RECORD_HEADER, op};
use crate::source::Source;
use crate::topic::Topic;
use std::collections::{BTreeMap, BTreeSet};
use std::io;

/// The ids of the channels that we know.
pub(crate) type Channels = BTreeMap<u16, Topic>;

/// Where things are in a file.
#[derive(Debug, Default)]
pub(crate) struct Index {
    pub(crate) chunks: Vec<ChunkEntry>,
    pub(crate) metadata: Vec<Extent>,
    pub(crate) attachments: Vec<Extent>,
    pub(crate) channels: Channels,
    /// Whether the file was finished.
    pub(crate) whole: bool,
    /// Whether the file said so itself: then all its channels are known.
    pub(crate) summed_up: bool,
}

/// A record in the file, with its opcode and length.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    pub(crate) offset: u64,
    pub(crate) length: u64,
}

/// A chunk in the file.
#[derive(Clone, Debug)]
pub(crate) struct ChunkEntry {
    pub(crate) extent: Extent,
    pub(crate) start_ns: u64,
    pub(crate) end_ns: u64,
    /// Channels that have messages in it, and where in the file their message indexes stand; `None` if that is
    /// not known.
    pub(crate) channels: Option<Vec<(u16, u64)>>,
}

/// The index of a file, or `None` if it is no MCAP file.
pub(crate) fn index(source: &Source) -> io::Result<Option<Index>> {
    let mut magic = Vec::new();
    if !source.read(0, MAGIC.len() as u64, &mut magic)? || magic != MAGIC {
        return Ok(None);
    }
    match from_summary(source)? {
        Some(index) => Ok(Some(index)),
        None => scan(source).map(Some),
    }
}

/// Reads the summary section. `None` if there is none or if it has the slightest fault.
fn from_summary(source: &Source) -> io::Result<Option<Index>> {
    const FOOTER: u64 = 8 + 8 + 4;
    let magic = MAGIC.len() as u64;
    let Some(footer_at) = source.len().checked_sub(RECORD_HEADER + FOOTER + magic) else {
        return Ok(None);
    };

    let mut bytes = Vec::new();
    source.read(footer_at, source.len() - footer_at, &mut bytes)?;
    let Some((start, crc)) = footer(&bytes) else {
        return Ok(None);
    };
    if start == 0 || start > footer_at {
        return Ok(None);
    }

    // The checksum covers the footer as well, up to the checksum itself.
    let covered = footer_at + RECORD_HEADER + FOOTER - 4 - start;
    if !source.read(start, covered, &mut bytes)? {
        return Ok(None);
    }
    if crc32fast::hash(&bytes) != crc {
        return Ok(None);
    }
    Ok(summary(&bytes, source.len()))
}

/// Start and checksum of the summary section.
fn footer(bytes: &[u8]) -> Option<(u64, u32)> {
    let mut fields = Fields(bytes);
    let (opcode, body) = fields.record()?;
    if opcode != op::FOOTER || fields.0 != MAGIC {
        return None;
    }
    let mut fields = Fields(body);
    let start = fields.u64()?;
    let _offsets = fields.u64()?;
    Some((start, fields.u32()?))
}

fn summary(bytes: &[u8], file_length: u64) -> Option<Index> {
    let mut index = Index {
        whole: true,
        summed_up: true,
        ..Index::default()
    };
    let mut records = Fields(bytes);
    while let Some((opcode, body)) = records.record() {
        let mut fields = Fields(body);
        let extent = |fields: &mut Fields<'_>| {
            let offset = fields.u64()?;
            let length = fields.u64()?;
            let inside = offset.checked_add(length)? <= file_length;
            inside.then_some(Extent { offset, length })
        };
        match opcode {
            op::CHANNEL => add_channel(&mut index.channels, body)?,
            op::CHUNK_INDEX => {
                let start_ns = fields.u64()?;
                let end_ns = fields.u64()?;
                let extent = extent(&mut fields)?;
                let mut offsets = fields.list()?;
                let mut channels = Vec::new();
                while !offsets.0.is_empty() {
                    channels.push((offsets.u16()?, offsets.u64()?));
                }
                index.chunks.push(ChunkEntry {
                    extent,
                    start_ns,
                    end_ns,
                    channels: Some(channels),
                });
            }
            op::METADATA_INDEX => index.metadata.push(extent(&mut fields)?),
            op::ATTACHMENT_INDEX => index.attachments.push(extent(&mut fields)?),
            _ => {}
        }
    }
    index.chunks.sort_by_key(|chunk| chunk.extent.offset);
    Some(index)
}

/// Walks the file from record to record.
fn scan(source: &Source) -> io::Result<Index> {
    let mut index = Index::default();
    let mut bytes = Vec::new();
    let mut offset = MAGIC.len() as u64;

    while source.read(offset, RECORD_HEADER, &mut bytes)? {
        let mut fields = Fields(&bytes);
        let (Some(opcode), Some(length)) = (fields.u8(), fields.u64()) else {
            break;
        };
        let body_at = offset + RECORD_HEADER;
        match body_at.checked_add(length) {
            Some(end) if end <= source.len() => {}
            _ => break,
        }
        let extent = Extent {
            offset,
            length: RECORD_HEADER + length,
        };
        let mut read_body = |limit: u64| source.read(body_at, length.min(limit), &mut bytes);
        match opcode {
            op::HEADER | op::SCHEMA => {}
            op::CHANNEL => {
                read_body(u64::MAX)?;
                if add_channel(&mut index.channels, &bytes).is_none() {
                    break;
                }
            }
            op::CHUNK => {
                read_body(ChunkHeader::LENGTH_MAX)?;
                let Some(header) = ChunkHeader::read(&mut Fields(&bytes)) else {
                    break;
                };
                index.chunks.push(ChunkEntry {
                    extent,
                    start_ns: header.start_ns,
                    end_ns: header.end_ns,
                    // Filled by the message indexes that follow; without them, unknown.
                    channels: None,
                });
            }
            op::MESSAGE_INDEX => {
                read_body(2)?;
                let (Some(chunk), Some(channel)) = (index.chunks.last_mut(), Fields(&bytes).u16())
                else {
                    break;
                };
                // One cut off between its message indexes must not look as if it had fewer
                // channels: see below.
                let channels = chunk.channels.get_or_insert_default();
                channels.push((channel, offset));
            }
            op::METADATA => index.metadata.push(extent),
            op::ATTACHMENT => index.attachments.push(extent),
            op::DATA_END | op::FOOTER => {
                index.whole = true;
                break;
            }
            // What we do not know is skipped, as the format asks; 0 is what a file system puts
            // where bytes were lost.
            0 => break,
            _ => {}
        }
        offset = body_at + length;
    }

    if let Some(last) = index.chunks.last_mut() {
        last.channels = None;
    }
    Ok(index)
}

/// Learns the channels of a file without summary: looks into its chunks, in order, until all that have messages are
/// known. Most are declared in the first chunk; those of pictures and of the wind when there are any, and whoever
/// passes over that chunk would not know them later.
pub(crate) fn learn_channels(source: &Source, index: &mut Index) {
    if index.summed_up {
        return;
    }
    let mut unknown = BTreeSet::new();
    // Behind the first message of the last channel there is nothing to learn.
    let mut last = 0;
    for (place, chunk) in index.chunks.iter().enumerate() {
        for (id, _) in chunk.channels.iter().flatten() {
            if !index.channels.contains_key(id) && unknown.insert(*id) {
                last = place;
            }
        }
    }
    for entry in &index.chunks[..(last + 1).min(index.chunks.len())] {
        if unknown.is_empty() {
            return;
        }
        // One that is damaged is told when somebody wants what is in it.
        let Ok(bytes) = chunk::load(source, entry) else {
            continue;
        };
        let mut records = Fields(&bytes);
        while let Some((opcode, body)) = records.record() {
            if opcode != op::CHANNEL {
                continue;
            }
            if let Some((id, _)) = frame::channel(body) {
                unknown.remove(&id);
            }
            if add_channel(&mut index.channels, body).is_none() {
                break;
            }
        }
    }
}

/// The times of the messages of one channel in one chunk, ns, from the message index that stands at `offset`; `None` if
/// there is none.
pub(crate) fn message_times(
    source: &Source,
    offset: u64,
    channel: u16,
) -> io::Result<Option<Vec<u64>>> {
    let mut bytes = Vec::new();
    if !source.read(offset, RECORD_HEADER, &mut bytes)? {
        return Ok(None);
    }
    let mut fields = Fields(&bytes);
    let (Some(op::MESSAGE_INDEX), Some(length)) = (fields.u8(), fields.u64()) else {
        return Ok(None);
    };
    let body_at = offset.saturating_add(RECORD_HEADER);
    if !source.read(body_at, length, &mut bytes)? {
        return Ok(None);
    }
    let times = || {
        let mut fields = Fields(&bytes);
        let same = fields.u16()? == channel;
        let mut entries = fields.list()?;
        let mut times = Vec::new();
        while !entries.0.is_empty() {
            times.push(entries.u64()?);
            entries.u64()?;
        }
        same.then_some(times)
    };
    Ok(times())
}

/// Remembers a channel, if it is one of ours. `None` when the record is damaged.
pub(crate) fn add_channel(channels: &mut Channels, body: &[u8]) -> Option<()> {
    let (id, name) = frame::channel(body)?;
    if let Some(topic) = Topic::named(name) {
        channels.insert(id, topic);
    }
    Some(())
}
