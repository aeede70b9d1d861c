//! OSM PBF: <https://wiki.openstreetmap.org/wiki/PBF_Format>. Block by block, so that memory holds one of them at a time.

use std::io::Read;

use flate2::read::ZlibDecoder;

use super::wire::{Fault, Field, Message, Packed, zigzag};
use crate::osm::error::OsmError;
use crate::osm::raw::{Member, Raw, Role};
use crate::osm::tags::Key;

/// Sizes that the format allows, bytes.
const MOST_HEADER: usize = 64 << 10;
const MOST_BLOB: usize = 32 << 20;
/// Features of a file that are understood.
const KNOWN: [&[u8]; 3] = [b"OsmSchema-V0.6", b"DenseNodes", b"HistoricalInformation"];

/// Reads a whole file.
pub(in crate::osm) fn read(mut reader: impl Read) -> Result<Raw, OsmError> {
    let mut raw = Raw::default();
    let mut content = Vec::new();
    for block in 0.. {
        let at = |reason: Fault| OsmError::Pbf { block, reason };
        let Some(length) = length_of_header(&mut reader, block)? else { break };
        let header = bytes(&mut reader, length, MOST_HEADER, block)?;
        let (mut is_data, mut size) = (false, 0);
        for field in Message(&header) {
            match field.map_err(at)? {
                (1, kind) => is_data = kind.bytes().map_err(at)? == b"OSMData",
                (3, number) => size = usize::try_from(number.number().map_err(at)?).unwrap_or(usize::MAX),
                _ => {}
            }
        }
        let blob = bytes(&mut reader, size, MOST_BLOB, block)?;
        inflate(&blob, &mut content).map_err(at)?;
        if is_data {
            Block::of(&content).and_then(|parsed| parsed.read_into(&mut raw)).map_err(
                |fault| match fault {
                    Halt::Fault(reason) => at(reason),
                    Halt::Limit(error) => error,
                },
            )?;
        } else {
            check_features(&content, block)?;
        }
    }
    raw.finish()
}

/// The length of the next header; none at the end of the file.
fn length_of_header(reader: &mut impl Read, block: u64) -> Result<Option<usize>, OsmError> {
    let mut length = [0; 4];
    let mut filled = 0;
    while filled < 4 {
        match reader.read(&mut length[filled..])? {
            0 if filled == 0 => return Ok(None),
            0 => return Err(OsmError::Pbf { block, reason: "the file is cut short" }),
            count => filled += count,
        }
    }
    Ok(Some(u32::from_be_bytes(length) as usize))
}

fn bytes(reader: &mut impl Read, count: usize, most: usize, block: u64) -> Result<Vec<u8>, OsmError> {
    if count > most {
        return Err(OsmError::Pbf { block, reason: "a block is larger than the format allows" });
    }
    let mut found = Vec::new();
    reader.take(count as u64).read_to_end(&mut found)?;
    if found.len() == count {
        Ok(found)
    } else {
        Err(OsmError::Pbf { block, reason: "the file is cut short" })
    }
}

/// The content of a blob.
fn inflate(blob: &[u8], content: &mut Vec<u8>) -> Result<(), Fault> {
    content.clear();
    for field in Message(blob) {
        match field? {
            (1, plain) => content.extend_from_slice(plain.bytes()?),
            (3, packed) => {
                let decoder = ZlibDecoder::new(packed.bytes()?);
                let read = decoder.take(MOST_BLOB as u64 + 1).read_to_end(content);
                read.map_err(|_| "compressed data is damaged")?;
            }
            (4..=7, _) => return Err("a block is compressed otherwise than with zlib"),
            _ => {}
        }
    }
    if content.len() > MOST_BLOB { Err("a block is larger than the format allows") } else { Ok(()) }
}

fn check_features(content: &[u8], block: u64) -> Result<(), OsmError> {
    for field in Message(content) {
        match field.map_err(|reason| OsmError::Pbf { block, reason })? {
            (4, Field::Bytes(feature)) if !KNOWN.contains(&feature) => {
                return Err(OsmError::Feature {
                    feature: String::from_utf8_lossy(feature).chars().take(80).collect(),
                });
            }
            _ => {}
        }
    }
    Ok(())
}

/// Why a block is not read on.
enum Halt {
    Fault(Fault),
    Limit(OsmError),
}

impl From<Fault> for Halt {
    fn from(fault: Fault) -> Self {
        Self::Fault(fault)
    }
}

impl From<OsmError> for Halt {
    fn from(error: OsmError) -> Self {
        Self::Limit(error)
    }
}

/// A block of elements: its strings, how its coordinates are written, and its groups.
struct Block<'a> {
    strings: Vec<&'a [u8]>,
    /// The key that a string is.
    keys: Vec<Option<Key>>,
    groups: Vec<&'a [u8]>,
    /// Nanodegrees a unit, and those of the origin, longitude first.
    granularity: i64,
    offset: [i64; 2],
}

impl<'a> Block<'a> {
    fn of(content: &'a [u8]) -> Result<Self, Halt> {
        let mut block = Self {
            strings: Vec::new(),
            keys: Vec::new(),
            groups: Vec::new(),
            granularity: 100,
            offset: [0; 2],
        };
        for field in Message(content) {
            match field? {
                (1, table) => {
                    for string in Message(table.bytes()?) {
                        if let (1, string) = string? {
                            block.strings.push(string.bytes()?);
                        }
                    }
                }
                (2, group) => block.groups.push(group.bytes()?),
                (17, number) => block.granularity = number.signed()?,
                (19, number) => block.offset[1] = number.signed()?,
                (20, number) => block.offset[0] = number.signed()?,
                _ => {}
            }
        }
        block.keys = block.strings.iter().map(|string| Key::from_name(string)).collect();
        Ok(block)
    }

    fn read_into(&self, raw: &mut Raw) -> Result<(), Halt> {
        for group in &self.groups {
            for field in Message(group) {
                match field? {
                    (1, node) => self.node(node.bytes()?, raw)?,
                    (2, nodes) => self.dense(nodes.bytes()?, raw)?,
                    (3, way) => self.way(way.bytes()?, raw)?,
                    (4, relation) => self.relation(relation.bytes()?, raw)?,
                    _ => {}
                }
            }
        }
        Ok(())
    }

    /// Tenths of microdegrees of a coordinate; beyond all degrees if it overflows.
    fn angle(&self, axis: usize, value: i64) -> i32 {
        let nano = value.checked_mul(self.granularity).and_then(|nano| nano.checked_add(self.offset[axis]));
        nano.and_then(|nano| i32::try_from(nano.div_euclid(100)).ok()).unwrap_or(i32::MAX)
    }

    fn keep(&self, key: u64, value: u64, raw: &mut Raw) -> Result<(), Halt> {
        let index = |number: u64| usize::try_from(number).unwrap_or(usize::MAX);
        let key = self.keys.get(index(key)).ok_or("a tag refers to no string")?;
        let value = self.strings.get(index(value)).ok_or("a tag refers to no string")?;
        let Some(key) = key else { return Ok(()) };
        if raw.tags.push(*key, &String::from_utf8_lossy(value)) {
            Ok(())
        } else {
            Err(OsmError::TooMuch { what: "bytes of tags", limit: 1 << 30 }.into())
        }
    }

    fn keep_all(&self, [keys, values]: [Packed<'_>; 2], raw: &mut Raw) -> Result<(), Halt> {
        for (key, value) in keys.zip(values) {
            self.keep(key?, value?, raw)?;
        }
        Ok(())
    }

    fn node(&self, message: &[u8], raw: &mut Raw) -> Result<(), Halt> {
        let (mut id, mut at, mut tags) = (0, [0; 2], <[Packed<'_>; 2]>::default());
        for field in Message(message) {
            match field? {
                (1, number) => id = zigzag(number.number()?),
                (8, number) => at[1] = zigzag(number.number()?),
                (9, number) => at[0] = zigzag(number.number()?),
                (which @ (2 | 3), list) => tags[which as usize - 2] = Packed(list.bytes()?),
                _ => {}
            }
        }
        let mark = raw.tags.mark();
        self.keep_all(tags, raw)?;
        Ok(raw.add_node(id, [self.angle(0, at[0]), self.angle(1, at[1])], mark)?)
    }

    fn dense(&self, message: &[u8], raw: &mut Raw) -> Result<(), Halt> {
        let [mut ids, mut latitudes, mut longitudes, mut tags] = <[Packed<'_>; 4]>::default();
        for field in Message(message) {
            match field? {
                (1, list) => ids = Packed(list.bytes()?),
                (8, list) => latitudes = Packed(list.bytes()?),
                (9, list) => longitudes = Packed(list.bytes()?),
                (10, list) => tags = Packed(list.bytes()?),
                _ => {}
            }
        }
        let (mut id, mut at) = (0_i64, [0_i64; 2]);
        while let (Some(step), Some(north), Some(east)) = (ids.next(), latitudes.next(), longitudes.next()) {
            id = id.wrapping_add(zigzag(step?));
            at[0] = at[0].wrapping_add(zigzag(east?));
            at[1] = at[1].wrapping_add(zigzag(north?));
            let mark = raw.tags.mark();
            // Keys and values in turn; a zero ends those of a node.
            while let Some(key) = tags.next().transpose()?.filter(|key| *key != 0) {
                let value = tags.next().ok_or("a tag has no value")??;
                self.keep(key, value, raw)?;
            }
            raw.add_node(id, [self.angle(0, at[0]), self.angle(1, at[1])], mark)?;
        }
        Ok(())
    }

    fn way(&self, message: &[u8], raw: &mut Raw) -> Result<(), Halt> {
        let (mut id, mut tags, mut references) = (0, <[Packed<'_>; 2]>::default(), Packed::default());
        for field in Message(message) {
            match field? {
                (1, number) => id = number.signed()?,
                (which @ (2 | 3), list) => tags[which as usize - 2] = Packed(list.bytes()?),
                (8, list) => references = Packed(list.bytes()?),
                _ => {}
            }
        }
        let mark = raw.tags.mark();
        self.keep_all(tags, raw)?;
        let (mut node, mut nodes) = (0_i64, Vec::new());
        for step in references {
            node = node.wrapping_add(zigzag(step?));
            nodes.push(node);
        }
        Ok(raw.add_way(id, &nodes, mark)?)
    }

    fn relation(&self, message: &[u8], raw: &mut Raw) -> Result<(), Halt> {
        let (mut id, mut tags) = (0, <[Packed<'_>; 2]>::default());
        let [mut roles, mut steps, mut kinds] = <[Packed<'_>; 3]>::default();
        for field in Message(message) {
            match field? {
                (1, number) => id = number.signed()?,
                (which @ (2 | 3), list) => tags[which as usize - 2] = Packed(list.bytes()?),
                (8, list) => roles = Packed(list.bytes()?),
                (9, list) => steps = Packed(list.bytes()?),
                (10, list) => kinds = Packed(list.bytes()?),
                _ => {}
            }
        }
        let mark = raw.tags.mark();
        self.keep_all(tags, raw)?;
        let (mut member, mut members) = (0_i64, Vec::new());
        while let (Some(role), Some(step), Some(kind)) = (roles.next(), steps.next(), kinds.next()) {
            member = member.wrapping_add(zigzag(step?));
            let role = usize::try_from(role?).ok().and_then(|role| self.strings.get(role));
            // Kind 0 is a node, 1 a way.
            let kind = kind?;
            if let Some(role) = Role::of(role.copied().unwrap_or_default(), kind == 1).filter(|_| kind < 2) {
                members.push(Member { number: member, role });
            }
        }
        Ok(raw.add_relation(id, &members, mark)?)
    }
}
