//! OSM XML: <https://wiki.openstreetmap.org/wiki/OSM_XML>. One pass of borrowed events; nothing is kept of an element
//! but what means something here.

use std::io::BufRead;

use quick_xml::Reader;
use quick_xml::escape::unescape;
use quick_xml::events::{BytesStart, Event};

use super::guard::Guard;
use super::number::{angle, integer};
use crate::osm::error::OsmError;
use crate::osm::raw::{Member, Raw, Role};
use crate::osm::tags::Key;

/// Elements are nested two deep; a change file, four.
const DEEPEST: usize = 16;

/// Reads a whole document.
pub(in crate::osm) fn read(reader: impl BufRead) -> Result<Raw, OsmError> {
    let mut xml = Reader::from_reader(Guard::of(reader));
    // The nesting is checked here, without a copy of every name.
    xml.config_mut().check_end_names = false;
    let mut state = State::default();
    let mut buffer = Vec::with_capacity(4096);
    let mut depth = 0_usize;
    let mut is_osm = false;
    loop {
        buffer.clear();
        let event = xml.read_event_into(&mut buffer);
        let at = |reason: String| OsmError::Xml { offset: xml.buffer_position(), reason };
        match event.map_err(|error| at(error.to_string()))? {
            Event::Empty(tag) => {
                state.begin(&tag)?;
                state.end(tag.name().as_ref())?;
            }
            Event::Start(tag) => {
                if depth == 0 && !matches!(tag.name().as_ref(), "osm" | "osmChange") {
                    return Err(at(format!("the document is <{}>, not <osm>", tag.name().as_ref())));
                }
                is_osm = true;
                depth += 1;
                if depth > DEEPEST {
                    return Err(at("elements are nested too deeply".to_owned()));
                }
                state.begin(&tag)?;
            }
            Event::End(tag) => {
                depth = depth
                    .checked_sub(1)
                    .ok_or_else(|| at("an element ends that did not begin".to_owned()))?;
                state.end(tag.name().as_ref())?;
            }
            Event::Eof if depth > 0 => return Err(at("the document ends too early".to_owned())),
            Event::Eof if !is_osm => return Err(at("there is no <osm> element".to_owned())),
            Event::Eof => return state.raw.finish(),
            _ => {}
        }
        xml.get_mut().begin_piece();
    }
}

/// The element that is being read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Open {
    #[default]
    None,
    Node,
    Way,
    Relation,
    /// One that was deleted, or whose number is no number.
    Ignored,
}

#[derive(Default)]
struct State {
    raw: Raw,
    open: Open,
    id: i64,
    at: [i32; 2],
    mark: u32,
    nodes: Vec<i64>,
    members: Vec<Member>,
}

impl State {
    fn begin(&mut self, tag: &BytesStart<'_>) -> Result<(), OsmError> {
        match tag.name().as_ref() {
            "nd" if self.open == Open::Way => {
                let node = attribute(tag, "ref").and_then(integer);
                self.raw.unreadable += u64::from(node.is_none());
                self.nodes.extend(node);
            }
            "tag" if !matches!(self.open, Open::None | Open::Ignored) => self.keep_tag(tag)?,
            "member" if self.open == Open::Relation => self.keep_member(tag),
            "node" => self.begin_node(tag),
            "way" => self.begin_element(tag, Open::Way),
            "relation" => self.begin_element(tag, Open::Relation),
            _ => {}
        }
        Ok(())
    }

    fn begin_node(&mut self, tag: &BytesStart<'_>) {
        let (mut id, mut longitude, mut latitude, mut is_gone) = (None, None, None, false);
        for (name, value) in attributes(tag) {
            match name {
                "id" => id = integer(value),
                "lon" => longitude = angle(value),
                "lat" => latitude = angle(value),
                "visible" | "action" => is_gone |= matches!(value, "false" | "delete"),
                _ => {}
            }
        }
        self.mark = self.raw.tags.mark();
        self.open = Open::Ignored;
        match (id, longitude, latitude) {
            _ if is_gone => {}
            (Some(id), Some(longitude), Some(latitude)) => {
                (self.id, self.at, self.open) = (id, [longitude, latitude], Open::Node);
            }
            _ => self.raw.unreadable += 1,
        }
    }

    fn begin_element(&mut self, tag: &BytesStart<'_>, open: Open) {
        self.mark = self.raw.tags.mark();
        self.nodes.clear();
        self.members.clear();
        let is_gone =
            attribute(tag, "visible") == Some("false") || attribute(tag, "action") == Some("delete");
        let id = attribute(tag, "id").and_then(integer);
        self.raw.unreadable += u64::from(id.is_none());
        self.open = if is_gone || id.is_none() { Open::Ignored } else { open };
        self.id = id.unwrap_or_default();
    }

    fn keep_tag(&mut self, tag: &BytesStart<'_>) -> Result<(), OsmError> {
        let (mut key, mut value) = (None, "");
        for (name, text) in attributes(tag) {
            match name {
                "k" => key = Key::from_name(text.as_bytes()),
                "v" => value = text,
                _ => {}
            }
        }
        let Some(key) = key else { return Ok(()) };
        let kept = if value.contains('&') {
            // An entity that is not known stays as it stands.
            self.raw.tags.push(key, unescape(value).as_deref().unwrap_or(value))
        } else {
            self.raw.tags.push(key, value)
        };
        if kept { Ok(()) } else { Err(OsmError::TooMuch { what: "bytes of tags", limit: 1 << 30 }) }
    }

    fn keep_member(&mut self, tag: &BytesStart<'_>) {
        let is_way = match attribute(tag, "type") {
            Some("way") => true,
            Some("node") => false,
            _ => return,
        };
        let word = attribute(tag, "role").unwrap_or_default();
        let Some(role) = Role::of(word.as_bytes(), is_way) else { return };
        let number = attribute(tag, "ref").and_then(integer);
        self.raw.unreadable += u64::from(number.is_none());
        self.members.extend(number.map(|number| Member { number, role }));
    }

    fn end(&mut self, name: &str) -> Result<(), OsmError> {
        match (name, self.open) {
            ("node", Open::Node) => self.raw.add_node(self.id, self.at, self.mark)?,
            ("way", Open::Way) => self.raw.add_way(self.id, &self.nodes, self.mark)?,
            ("relation", Open::Relation) => self.raw.add_relation(self.id, &self.members, self.mark)?,
            ("node" | "way" | "relation", _) => {}
            _ => return Ok(()),
        }
        self.open = Open::None;
        Ok(())
    }
}

/// The attributes of a tag, as they stand there; up to the first that is malformed.
fn attributes<'a>(tag: &'a BytesStart<'_>) -> impl Iterator<Item = (&'a str, &'a str)> {
    let mut rest = tag.attributes_raw();
    std::iter::from_fn(move || {
        let equals = rest.bytes().position(|byte| byte == b'=')?;
        let name = rest[..equals].trim();
        let after = rest[equals + 1..].trim_start();
        let quote = *after.as_bytes().first().filter(|byte| matches!(byte, b'"' | b'\''))?;
        let end = after.bytes().skip(1).position(|byte| byte == quote)?;
        let value = &after[1..=end];
        rest = &after[end + 2..];
        Some((name, value))
    })
}

fn attribute<'a>(tag: &'a BytesStart<'_>, wanted: &str) -> Option<&'a str> {
    attributes(tag).find(|(name, _)| *name == wanted).map(|(_, value)| value)
}
