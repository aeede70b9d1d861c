//! The frame of a saved city: magic, version, sections with lengths and checksums.

use std::io::Write;

use serde::Serialize;
use serde::de::DeserializeOwned;
use simworld_core::hash::StateHasher;

use super::source::Source;
use super::{MAGIC, SaveError, VERSION};

/// The version of before, which is read still.
const BEFORE: u32 = VERSION - 1;
/// Items a section of a list.
const CHUNK: usize = 1 << 16;

/// What a section holds.
#[derive(Clone, Copy, PartialEq, Eq)]
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
    Footpaths,
    /// As before there were sections after ways for walkers.
    End,
    Levels,
    Steps,
    Plazas,
    Ways,
}

impl Tag {
    /// In the order in which they stand in a file.
    const ALL: [(Self, &'static str); 18] = [
        (Self::Head, "the head"),
        (Self::Plan, "the street plan"),
        (Self::Ways, "the known ways over junctions"),
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
        (Self::Footpaths, "the ways for walkers"),
        (Self::Levels, "the ways for walkers off the ground"),
        (Self::Steps, "the flights of steps off the ground"),
        (Self::Plazas, "the plazas"),
        (Self::End, "the end"),
    ];

    pub(super) fn name(self) -> &'static str {
        Self::ALL[self.rank()].1
    }

    /// Its place in the order of a file; each of them has one.
    fn rank(self) -> usize {
        Self::ALL.iter().position(|(tag, _)| *tag == self).unwrap_or(Self::ALL.len() - 1)
    }

    /// The tag of a number in a file of some version.
    fn from_number(number: u32, version: u32) -> Option<Self> {
        // The version of before ends where ways for walkers stand now.
        let is_end = version == BEFORE && number == Self::Footpaths as u32;
        let number = if is_end { Self::End as u32 } else { number };
        Self::ALL.iter().map(|(tag, _)| *tag).find(|tag| *tag as u32 == number)
    }
}

/// Writes sections.
pub(super) struct Writer<'a, W> {
    out: &'a mut W,
    /// Kept between sections, so that a section allocates nothing.
    buffers: [Vec<u8>; 2],
}

/// The content of a section, and its checksum.
type Encoded = Result<(Vec<u8>, u64), SaveError>;

fn encode<T: Serialize + ?Sized>(tag: Tag, content: &T, mut buffer: Vec<u8>) -> Encoded {
    buffer.clear();
    let bytes = postcard::to_extend(content, buffer)
        .map_err(|error| SaveError::Content { section: tag.name(), reason: error.to_string() })?;
    let checksum = checksum(&bytes);
    Ok((bytes, checksum))
}

impl<'a, W: Write> Writer<'a, W> {
    pub(super) fn begin(out: &'a mut W) -> Result<Self, SaveError> {
        out.write_all(&MAGIC)?;
        out.write_all(&VERSION.to_le_bytes())?;
        Ok(Self { out, buffers: Default::default() })
    }

    pub(super) fn section<T: Serialize + ?Sized>(&mut self, tag: Tag, content: &T) -> Result<(), SaveError> {
        let buffer = std::mem::take(&mut self.buffers[0]);
        self.buffers[0] = self.write(tag, encode(tag, content, buffer))?;
        Ok(())
    }

    /// Writes what was encoded, and gives its memory back.
    fn write(&mut self, tag: Tag, encoded: Encoded) -> Result<Vec<u8>, SaveError> {
        let (bytes, checksum) = encoded?;
        self.out.write_all(&(tag as u32).to_le_bytes())?;
        self.out.write_all(&(bytes.len() as u64).to_le_bytes())?;
        self.out.write_all(&checksum.to_le_bytes())?;
        self.out.write_all(&bytes)?;
        Ok(bytes)
    }

    /// A long list, in sections of so many items that framing costs nothing and buffers stay small; two are encoded at
    /// once.
    pub(super) fn list<T: Serialize + Sync>(&mut self, tag: Tag, items: &[T]) -> Result<(), SaveError> {
        for some in items.chunks(2 * CHUNK) {
            let (first, second) = some.split_at(CHUNK.min(some.len()));
            if second.is_empty() {
                self.section(tag, first)?;
                continue;
            }
            let [one, two] = std::mem::take(&mut self.buffers);
            let (one, two) = rayon::join(|| encode(tag, first, one), || encode(tag, second, two));
            self.buffers = [self.write(tag, one)?, self.write(tag, two)?];
        }
        Ok(())
    }

    pub(super) fn end(mut self) -> Result<(), SaveError> {
        self.section(Tag::End, &())
    }
}

/// The sections of a file, in order, not yet looked into.
pub(super) struct Sections<'a> {
    source: Source<'a>,
    found: Vec<Section>,
    version: u32,
}

struct Section {
    tag: Tag,
    checksum: u64,
    /// Where its content begins, and how many bytes it has; they lie within the source.
    start: u64,
    length: u64,
}

impl<'a> Sections<'a> {
    pub(super) fn of(source: Source<'a>) -> Result<Self, SaveError> {
        let magic = source.read(0, source.len().min(MAGIC.len() as u64))?;
        if !magic.starts_with(&MAGIC[..magic.len()]) || magic.is_empty() {
            return Err(SaveError::Foreign);
        }
        let mut rest = Rest { source: &source, at: 0 };
        rest.take::<8>("the magic")?;
        let version = u32::from_le_bytes(rest.take("the version")?);
        if ![BEFORE, VERSION].contains(&version) {
            return Err(SaveError::Version { found: version });
        }
        let mut found: Vec<Section> = Vec::new();
        while found.last().is_none_or(|section| section.tag != Tag::End) {
            let within = found.last().map_or("the head", |section| section.tag.name());
            let tag = Tag::from_number(u32::from_le_bytes(rest.take(within)?), version);
            let tag =
                tag.ok_or(SaveError::Section { found: "an unknown section", expected: "a known one" })?;
            if let Some(before) = found.last().filter(|before| before.tag.rank() > tag.rank()) {
                return Err(SaveError::Section { found: tag.name(), expected: before.tag.name() });
            }
            let length = u64::from_le_bytes(rest.take(tag.name())?);
            let checksum = u64::from_le_bytes(rest.take(tag.name())?);
            found.push(Section { tag, checksum, start: rest.pass(length, tag.name())?, length });
        }
        if rest.at < source.len() {
            return Err(SaveError::Section { found: "more", expected: "nothing after the end" });
        }
        let sections = Self { source, found, version };
        // Nobody asks for the end, which has a checksum all the same.
        sections.one::<()>(Tag::End)?;
        Ok(sections)
    }

    /// Whether the file is of the version of before.
    pub(super) fn are_of_before(&self) -> bool {
        self.version == BEFORE
    }

    /// Whether there is a section of a kind; some are left out where they would say nothing.
    pub(super) fn have(&self, tag: Tag) -> bool {
        self.found.iter().any(|section| section.tag == tag)
    }

    /// The content of the one section of a kind.
    pub(super) fn one<T: DeserializeOwned>(&self, tag: Tag) -> Result<T, SaveError> {
        let mut all = self.found.iter().filter(|section| section.tag == tag);
        match (all.next(), all.next()) {
            (Some(section), None) => section.decode(&self.source),
            (None, _) => Err(SaveError::Section { found: "nothing", expected: tag.name() }),
            (Some(_), Some(_)) => Err(SaveError::Section { found: "two of", expected: tag.name() }),
        }
    }

    /// A list of as many items as were announced, from all sections of its kind.
    pub(super) fn list<T: DeserializeOwned>(&self, tag: Tag, count: u64) -> Result<Vec<T>, SaveError> {
        let sections = self.found.iter().filter(|section| section.tag == tag);
        // An item takes a byte at least, so that memory follows the file and not what it announces.
        let bytes: u64 = sections.clone().map(|section| section.length).sum();
        let mut items: Vec<T> = Vec::with_capacity(count.min(bytes) as usize);
        for section in sections {
            items.append(&mut section.decode(&self.source)?);
        }
        if items.len() as u64 == count {
            Ok(items)
        } else {
            let reason = format!("{} items where {count} were announced", items.len());
            Err(SaveError::Content { section: tag.name(), reason })
        }
    }
}

impl Section {
    fn decode<T: DeserializeOwned>(&self, source: &Source<'_>) -> Result<T, SaveError> {
        let section = self.tag.name();
        let content = source.read(self.start, self.length)?;
        if checksum(&content) != self.checksum {
            return Err(SaveError::Checksum { section });
        }
        let broken = |reason: String| SaveError::Content { section, reason };
        let (value, left) = postcard::take_from_bytes(&content).map_err(|error| broken(error.to_string()))?;
        if left.is_empty() { Ok(value) } else { Err(broken(format!("{} bytes too many", left.len()))) }
    }
}

/// What is left of the bytes of a file.
struct Rest<'s, 'a> {
    source: &'s Source<'a>,
    at: u64,
}

impl Rest<'_, '_> {
    fn take<const N: usize>(&mut self, section: &'static str) -> Result<[u8; N], SaveError> {
        let start = self.pass(N as u64, section)?;
        let mut taken = [0; N];
        taken.copy_from_slice(&self.source.read(start, N as u64)?);
        Ok(taken)
    }

    /// Passes over so many bytes; where they begin.
    fn pass(&mut self, length: u64, section: &'static str) -> Result<u64, SaveError> {
        let left = self.source.len() - self.at;
        if length > left {
            return Err(SaveError::Truncated { section, missing: length - left });
        }
        let start = self.at;
        self.at += length;
        Ok(start)
    }
}

fn checksum(bytes: &[u8]) -> u64 {
    StateHasher::new().bytes(bytes).finish().0
}
