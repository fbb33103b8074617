//! Unpacks one chunk.

use crate::frame::{ChunkHeader, Fields, op};
use crate::index::ChunkEntry;
use crate::source::Source;
use std::io::{self, Read};

/// Chunks that claim to be larger than this are refused: ours have a megabyte, or one tick.
const SIZE_MAX: u64 = 1 << 30;

/// Why a chunk cannot be used.
pub(crate) enum ChunkError {
    Io(io::Error),
    /// It is not what it claims to be.
    Damaged(&'static str),
    /// It is compressed in a way we do not know.
    Compression(String),
}

/// The records of a chunk.
pub(crate) fn load(source: &Source, entry: &ChunkEntry) -> Result<Vec<u8>, ChunkError> {
    let mut packed = Vec::new();
    let extent = entry.extent;
    let complete = source
        .read(extent.offset, extent.length, &mut packed)
        .map_err(ChunkError::Io)?;
    if !complete {
        return Err(ChunkError::Damaged("the file became shorter"));
    }
    let Some((op::CHUNK, body)) = Fields(&packed).record() else {
        return Err(ChunkError::Damaged("the index names a chunk that is none"));
    };
    let (header, data) =
        open(body).ok_or(ChunkError::Damaged("the chunk is shorter than it claims"))?;
    if header.size > SIZE_MAX {
        return Err(ChunkError::Damaged(
            "the chunk claims to be larger than 1 GiB",
        ));
    }

    let unpacked = match header.compression {
        "" => data.to_vec(),
        "zstd" => unzstd(data, header.size).map_err(|_| ChunkError::Damaged("bad zstd data"))?,
        other => return Err(ChunkError::Compression(other.to_string())),
    };
    if unpacked.len() as u64 != header.size {
        return Err(ChunkError::Damaged("the chunk has not the size it claims"));
    }
    // By the format, 0 means that the writer did not say.
    if header.crc != 0 && crc32fast::hash(&unpacked) != header.crc {
        return Err(ChunkError::Damaged("wrong checksum"));
    }
    Ok(unpacked)
}

/// The header of a chunk and its compressed records.
fn open(body: &[u8]) -> Option<(ChunkHeader<'_>, &[u8])> {
    let mut fields = Fields(body);
    let header = ChunkHeader::read(&mut fields)?;
    let data = fields.bytes(header.compressed_size)?;
    Some((header, data))
}

/// Unpacks at most one byte more than `size`. Grows with what is really there.
fn unzstd(data: &[u8], size: u64) -> io::Result<Vec<u8>> {
    let mut unpacked = Vec::new();
    zstd::stream::read::Decoder::with_buffer(data)?
        .take(size + 1)
        .read_to_end(&mut unpacked)?;
    Ok(unpacked)
}
