//! The frame of a saved city: magic, version, sections with lengths and checksums.

use std::io::Write;

use serde::Serialize;
use serde::de::DeserializeOwned;
use simworld_core::hash::StateHasher;

use super::{MAGIC, SaveError, VERSION};

/// Items a section of a list.
const CHUNK: usize = 1 << 16;

/// What a section holds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Tag {
    Head = 1,
    Plan,
    Buildings,
    Elements,
    Roads,
    Lanes,
    Connections,
    Intersections,
    Sidewalks,
    Crossings,
    Signals,
    Names,
    End,
}

impl Tag {
    /// In the order in which they stand in a file.
    const ALL: [(Self, &'static str); 13] = [
        (Self::Head, "the head"),
        (Self::Plan, "the street plan"),
        (Self::Buildings, "the buildings"),
        (Self::Elements, "the street elements"),
        (Self::Roads, "the roads"),
        (Self::Lanes, "the lanes"),
        (Self::Connections, "the connections"),
        (Self::Intersections, "the intersections"),
        (Self::Sidewalks, "the sidewalks"),
        (Self::Crossings, "the crossings"),
        (Self::Signals, "the signal plans"),
        (Self::Names, "the street names"),
        (Self::End, "the end"),
    ];

    pub(super) fn name(self) -> &'static str {
        Self::ALL[self as usize - 1].1
    }

    fn from_number(number: u32) -> Option<Self> {
        Self::ALL.iter().map(|(tag, _)| *tag).find(|tag| *tag as u32 == number)
    }
}

/// Writes sections.
pub(super) struct Writer<'a, W> {
    out: &'a mut W,
    /// Kept between sections, so that a section allocates nothing.
    buffer: Vec<u8>,
}

impl<'a, W: Write> Writer<'a, W> {
    pub(super) fn begin(out: &'a mut W) -> Result<Self, SaveError> {
        out.write_all(&MAGIC)?;
        out.write_all(&VERSION.to_le_bytes())?;
        Ok(Self { out, buffer: Vec::new() })
    }

    pub(super) fn section<T: Serialize + ?Sized>(&mut self, tag: Tag, content: &T) -> Result<(), SaveError> {
        let mut buffer = std::mem::take(&mut self.buffer);
        buffer.clear();
        let buffer = postcard::to_extend(content, buffer)
            .map_err(|error| SaveError::Content { section: tag.name(), reason: error.to_string() })?;
        self.out.write_all(&(tag as u32).to_le_bytes())?;
        self.out.write_all(&(buffer.len() as u64).to_le_bytes())?;
        self.out.write_all(&checksum(&buffer).to_le_bytes())?;
        self.out.write_all(&buffer)?;
        self.buffer = buffer;
        Ok(())
    }

    /// A long list, in sections of so many items that framing costs nothing and buffers stay small.
    pub(super) fn list<T: Serialize>(&mut self, tag: Tag, items: &[T]) -> Result<(), SaveError> {
        items.chunks(CHUNK).try_for_each(|some| self.section(tag, some))
    }

    pub(super) fn end(mut self) -> Result<(), SaveError> {
        self.section(Tag::End, &())
    }
}

/// The sections of a file, in order, not yet looked into.
pub(super) struct Sections<'a> {
    found: Vec<Section<'a>>,
}

struct Section<'a> {
    tag: Tag,
    checksum: u64,
    content: &'a [u8],
}

impl<'a> Sections<'a> {
    pub(super) fn of(bytes: &'a [u8]) -> Result<Self, SaveError> {
        if !bytes.starts_with(&MAGIC[..bytes.len().min(MAGIC.len())]) || bytes.is_empty() {
            return Err(SaveError::Foreign);
        }
        let mut rest = Rest(bytes);
        rest.take::<8>("the magic")?;
        let version = u32::from_le_bytes(rest.take("the version")?);
        if version != VERSION {
            return Err(SaveError::Version { found: version });
        }
        let mut found: Vec<Section<'a>> = Vec::new();
        while found.last().is_none_or(|section| section.tag != Tag::End) {
            let within = found.last().map_or("the head", |section| section.tag.name());
            let tag = Tag::from_number(u32::from_le_bytes(rest.take(within)?));
            let tag =
                tag.ok_or(SaveError::Section { found: "an unknown section", expected: "a known one" })?;
            if let Some(before) = found.last().filter(|before| before.tag > tag) {
                return Err(SaveError::Section { found: tag.name(), expected: before.tag.name() });
            }
            let length = u64::from_le_bytes(rest.take(tag.name())?);
            let checksum = u64::from_le_bytes(rest.take(tag.name())?);
            found.push(Section { tag, checksum, content: rest.bytes(length, tag.name())? });
        }
        if !rest.0.is_empty() {
            return Err(SaveError::Section { found: "more", expected: "nothing after the end" });
        }
        let sections = Self { found };
        // Nobody asks for the end, which has a checksum all the same.
        sections.one::<()>(Tag::End)?;
        Ok(sections)
    }

    /// The content of the one section of a kind.
    pub(super) fn one<T: DeserializeOwned>(&self, tag: Tag) -> Result<T, SaveError> {
        let mut all = self.found.iter().filter(|section| section.tag == tag);
        match (all.next(), all.next()) {
            (Some(section), None) => section.decode(),
            (None, _) => Err(SaveError::Section { found: "nothing", expected: tag.name() }),
            (Some(_), Some(_)) => Err(SaveError::Section { found: "two of", expected: tag.name() }),
        }
    }

    /// A list of as many items as were announced, from all sections of its kind.
    pub(super) fn list<T: DeserializeOwned>(&self, tag: Tag, count: u64) -> Result<Vec<T>, SaveError> {
        let sections = self.found.iter().filter(|section| section.tag == tag);
        // An item takes a byte at least, so that memory follows the file and not what it announces.
        let bytes: usize = sections.clone().map(|section| section.content.len()).sum();
        let mut items: Vec<T> = Vec::with_capacity(count.min(bytes as u64) as usize);
        for section in sections {
            items.append(&mut section.decode()?);
        }
        if items.len() as u64 == count {
            Ok(items)
        } else {
            let reason = format!("{} items where {count} were announced", items.len());
            Err(SaveError::Content { section: tag.name(), reason })
        }
    }
}

impl Section<'_> {
    fn decode<T: DeserializeOwned>(&self) -> Result<T, SaveError> {
        let section = self.tag.name();
        if checksum(self.content) != self.checksum {
            return Err(SaveError::Checksum { section });
        }
        let broken = |reason: String| SaveError::Content { section, reason };
        let (value, left) =
            postcard::take_from_bytes(self.content).map_err(|error| broken(error.to_string()))?;
        if left.is_empty() { Ok(value) } else { Err(broken(format!("{} bytes too many", left.len()))) }
    }
}

/// What is left of the bytes of a file.
struct Rest<'a>(&'a [u8]);

impl<'a> Rest<'a> {
    fn take<const N: usize>(&mut self, section: &'static str) -> Result<[u8; N], SaveError> {
        let mut taken = [0; N];
        taken.copy_from_slice(self.bytes(N as u64, section)?);
        Ok(taken)
    }

    fn bytes(&mut self, length: u64, section: &'static str) -> Result<&'a [u8], SaveError> {
        let left = self.0.len() as u64;
        if length > left {
            return Err(SaveError::Truncated { section, missing: length - left });
        }
        let (bytes, rest) = self.0.split_at(length as usize);
        self.0 = rest;
        Ok(bytes)
    }
}

fn checksum(bytes: &[u8]) -> u64 {
    StateHasher::new().bytes(bytes).finish().0
}
