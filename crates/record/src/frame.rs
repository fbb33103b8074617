//! MCAP as bytes: records and their fields, read without trust.
//!
//! The `mcap` crate reads files too, but it takes lengths at their word (a damaged length makes
//! it allocate that much, a short attachment makes it panic), and it copies every message. The
//! format is simple enough to read here: <https://mcap.dev/spec>.

use std::collections::BTreeMap;

/// The first and the last eight bytes of a file.
pub(crate) use mcap::MAGIC;
pub(crate) use mcap::records::op;

/// Bytes before a record's body: an opcode and the length of the body.
pub(crate) const RECORD_HEADER: u64 = 9;

/// Reads the fields of one record, in order. `None` when the record is too short for a field.
pub(crate) struct Fields<'a>(pub(crate) &'a [u8]);

impl<'a> Fields<'a> {
    pub(crate) fn bytes(&mut self, length: u64) -> Option<&'a [u8]> {
        let length = usize::try_from(length).ok()?;
        let (head, tail) = self.0.split_at_checked(length)?;
        self.0 = tail;
        Some(head)
    }

    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (head, tail) = self.0.split_first_chunk()?;
        self.0 = tail;
        Some(*head)
    }

    pub(crate) fn u8(&mut self) -> Option<u8> {
        self.array().map(u8::from_le_bytes)
    }

    pub(crate) fn u16(&mut self) -> Option<u16> {
        self.array().map(u16::from_le_bytes)
    }

    pub(crate) fn u32(&mut self) -> Option<u32> {
        self.array().map(u32::from_le_bytes)
    }

    pub(crate) fn u64(&mut self) -> Option<u64> {
        self.array().map(u64::from_le_bytes)
    }

    /// A text with its length before it.
    pub(crate) fn text(&mut self) -> Option<&'a str> {
        let length = self.u32()?;
        std::str::from_utf8(self.bytes(length.into())?).ok()
    }

    /// A list whose length in bytes stands before it.
    pub(crate) fn list(&mut self) -> Option<Fields<'a>> {
        let length = self.u32()?;
        self.bytes(length.into()).map(Fields)
    }

    pub(crate) fn texts_by_name(&mut self) -> Option<BTreeMap<String, String>> {
        let mut list = self.list()?;
        let mut map = BTreeMap::new();
        while !list.0.is_empty() {
            let name = list.text()?;
            map.insert(name.to_string(), list.text()?.to_string());
        }
        Some(map)
    }

    /// The next record: opcode and body.
    pub(crate) fn record(&mut self) -> Option<(u8, &'a [u8])> {
        let opcode = self.u8()?;
        let length = self.u64()?;
        Some((opcode, self.bytes(length)?))
    }
}

/// Header of a chunk record, without the compressed bytes.
pub(crate) struct ChunkHeader<'a> {
    pub(crate) start_ns: u64,
    pub(crate) end_ns: u64,
    pub(crate) size: u64,
    pub(crate) crc: u32,
    pub(crate) compression: &'a str,
    pub(crate) compressed_size: u64,
}

impl<'a> ChunkHeader<'a> {
    /// More bytes than any header of ours has; the rest of the body may follow.
    pub(crate) const LENGTH_MAX: u64 = 8 + 8 + 8 + 4 + 4 + 16 + 8;

    pub(crate) fn read(fields: &mut Fields<'a>) -> Option<Self> {
        Some(ChunkHeader {
            start_ns: fields.u64()?,
            end_ns: fields.u64()?,
            size: fields.u64()?,
            crc: fields.u32()?,
            compression: fields.text()?,
            compressed_size: fields.u64()?,
        })
    }
}

/// Header of a message record; the message is the rest of the body.
pub(crate) struct MessageHeader {
    pub(crate) channel: u16,
    pub(crate) time_ns: u64,
}

impl MessageHeader {
    pub(crate) fn read(fields: &mut Fields<'_>) -> Option<Self> {
        let channel = fields.u16()?;
        let _sequence = fields.u32()?;
        let time_ns = fields.u64()?;
        let _publish_time = fields.u64()?;
        Some(MessageHeader { channel, time_ns })
    }
}

/// Channel id and topic of a channel record.
pub(crate) fn channel(body: &[u8]) -> Option<(u16, &str)> {
    let mut fields = Fields(body);
    let id = fields.u16()?;
    let _schema = fields.u16()?;
    Some((id, fields.text()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_that_claims_more_than_there_is_is_refused() {
        let mut bytes = vec![op::CHUNK];
        bytes.extend(u64::MAX.to_le_bytes());
        bytes.extend([0; 100]);
        assert!(Fields(&bytes).record().is_none());
    }

    #[test]
    fn text_that_is_not_utf_8_is_refused() {
        assert!(Fields(&[1, 0, 0, 0, 0xff]).text().is_none());
        assert_eq!(Fields(&[1, 0, 0, 0, b'a']).text(), Some("a"));
    }
}
