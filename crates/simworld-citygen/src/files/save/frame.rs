//! The frame of a saved city: magic, version, sections with lengths and checksums.

use std::io::Write;

use serde::Serialize;
use serde::de::DeserializeOwned;
use simworld_core::hash::StateHasher;

use super::{MAGIC, SaveError, VERSION};

/// What a section holds.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Tag {
    Head = 1,
    Plan = 2,
    Buildings = 3,
    Elements = 4,
    End = 5,
}

impl Tag {
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Head => "the head",
            Self::Plan => "the street plan",
            Self::Buildings => "the buildings",
            Self::Elements => "the street elements",
            Self::End => "the end",
        }
    }

    fn from_number(number: u32) -> Option<Self> {
        [Self::Head, Self::Plan, Self::Buildings, Self::Elements, Self::End]
            .into_iter()
            .find(|tag| *tag as u32 == number)
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

    pub(super) fn end(mut self) -> Result<(), SaveError> {
        self.section(Tag::End, &())
    }
}

/// Reads sections in order.
pub(super) struct Frames<'a> {
    rest: &'a [u8],
}

impl<'a> Frames<'a> {
    pub(super) fn of(bytes: &'a [u8]) -> Result<Self, SaveError> {
        let mut frames = Self { rest: bytes };
        if !bytes.starts_with(&MAGIC[..bytes.len().min(MAGIC.len())]) || bytes.is_empty() {
            return Err(SaveError::Foreign);
        }
        frames.take::<8>("the magic")?;
        let found = u32::from_le_bytes(frames.take("the version")?);
        if found == VERSION { Ok(frames) } else { Err(SaveError::Version { found }) }
    }

    /// Bytes not read yet.
    pub(super) fn left(&self) -> u64 {
        self.rest.len() as u64
    }

    /// The next section, which must hold what is expected.
    pub(super) fn decode<T: DeserializeOwned>(&mut self, expected: Tag) -> Result<T, SaveError> {
        let section = expected.name();
        let number = u32::from_le_bytes(self.take(section)?);
        let tag = Tag::from_number(number);
        if tag != Some(expected) {
            let found = tag.map_or("an unknown section", Tag::name);
            return Err(SaveError::Section { found, expected: section });
        }
        let length = u64::from_le_bytes(self.take(section)?);
        let sum = u64::from_le_bytes(self.take(section)?);
        let content = self.bytes(length, section)?;
        if checksum(content) != sum {
            return Err(SaveError::Checksum { section });
        }
        let broken = |reason: String| SaveError::Content { section, reason };
        let (value, left) = postcard::take_from_bytes(content).map_err(|error| broken(error.to_string()))?;
        if left.is_empty() { Ok(value) } else { Err(broken(format!("{} bytes too many", left.len()))) }
    }

    /// Nothing may follow the end.
    pub(super) fn finish(&mut self) -> Result<(), SaveError> {
        self.decode::<()>(Tag::End)?;
        if self.rest.is_empty() {
            Ok(())
        } else {
            Err(SaveError::Section { found: "more", expected: "nothing after the end" })
        }
    }

    fn take<const N: usize>(&mut self, section: &'static str) -> Result<[u8; N], SaveError> {
        let bytes = self.bytes(N as u64, section)?;
        let mut taken = [0; N];
        taken.copy_from_slice(bytes);
        Ok(taken)
    }

    fn bytes(&mut self, length: u64, section: &'static str) -> Result<&'a [u8], SaveError> {
        if length > self.left() {
            return Err(SaveError::Truncated { section, missing: length - self.left() });
        }
        let (bytes, rest) = self.rest.split_at(length as usize);
        self.rest = rest;
        Ok(bytes)
    }
}

fn checksum(bytes: &[u8]) -> u64 {
    StateHasher::new().bytes(bytes).finish().0
}
