//! What readers of SUMO's files share: one pass over the elements of a document, and attributes as numbers and shapes.

use std::borrow::Cow;
use std::io::{self, BufRead, Read};

use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use simworld_core::geometry::Point2;

use super::SumoError;

/// Elements are nested four deep at most.
const DEEPEST: usize = 16;
/// Bytes of text that are read at most.
const MOST_BYTES: u64 = 16 << 30;
/// Bytes of one tag: the longest are the shapes of edges.
const MOST_MARKUP: u64 = 16 << 20;
/// Farthest coordinate, m.
const FARTHEST: f64 = 1e7;

/// Takes up the elements of a document as they come.
pub(super) trait Visit {
    /// An element begins, so deep below the root: its children are at 1.
    fn begin(&mut self, element: &Element<'_>, depth: usize) -> Result<(), SumoError>;
    /// It ends.
    fn end(&mut self, name: &str, depth: usize) -> Result<(), SumoError>;
}

/// Reads a whole document whose root is one of `roots`; the root itself is visited at depth 0.
pub(super) fn read(reader: impl BufRead, roots: &[&str], visit: &mut impl Visit) -> Result<(), SumoError> {
    let mut xml = Reader::from_reader(Guard { inner: reader, total: 0, piece: 0 });
    let mut buffer = Vec::with_capacity(4096);
    let mut depth = 0_usize;
    let mut seen = false;
    loop {
        buffer.clear();
        let offset = xml.buffer_position();
        let at = |reason: String| SumoError::Xml { offset, reason };
        match xml.read_event_into(&mut buffer).map_err(|error| at(error.to_string()))? {
            Event::Start(tag) => {
                seen |= check_root(&tag, depth, roots).map_err(at)?;
                visit.begin(&Element { tag: &tag }, depth)?;
                depth += 1;
                if depth > DEEPEST {
                    return Err(at("elements are nested too deeply".to_owned()));
                }
            }
            Event::Empty(tag) => {
                seen |= check_root(&tag, depth, roots).map_err(at)?;
                visit.begin(&Element { tag: &tag }, depth)?;
                visit.end(tag.name().as_ref(), depth)?;
            }
            Event::End(tag) => {
                depth = depth
                    .checked_sub(1)
                    .ok_or_else(|| at("an element ends that did not begin".to_owned()))?;
                visit.end(tag.name().as_ref(), depth)?;
            }
            Event::Eof if depth > 0 || !seen => return Err(at("the document ends too early".to_owned())),
            Event::Eof => return Ok(()),
            _ => {}
        }
        xml.get_mut().piece = 0;
    }
}

fn check_root(tag: &BytesStart<'_>, depth: usize, roots: &[&str]) -> Result<bool, String> {
    let name = tag.name();
    match depth {
        0 if !roots.contains(&name.as_ref()) => {
            Err(format!("the document is <{}>, not <{}>", name.as_ref(), roots.join("> or <")))
        }
        _ => Ok(true),
    }
}

/// One element with its attributes.
pub(super) struct Element<'a> {
    tag: &'a BytesStart<'a>,
}

impl Element<'_> {
    pub(super) fn name(&self) -> &str {
        self.tag.name().into_inner()
    }

    /// An attribute, its entities resolved; `None` if it is not there or malformed.
    pub(super) fn get(&self, wanted: &str) -> Option<Cow<'_, str>> {
        let mut attributes = self.tag.attributes();
        attributes.with_checks(false);
        let found = attributes.filter_map(Result::ok).find(|attribute| attribute.key.as_ref() == wanted)?;
        found
            .normalized_value(quick_xml::XmlVersion::Implicit1_0)
            .ok()
            .map(|value| Cow::Owned(value.into_owned()))
    }

    pub(super) fn text(&self, wanted: &'static str) -> Result<String, SumoError> {
        self.get(wanted).map(Cow::into_owned).ok_or_else(|| self.error(wanted, "is missing"))
    }

    /// A finite number; `None` if it is not there.
    pub(super) fn number(&self, wanted: &'static str) -> Result<Option<f64>, SumoError> {
        let Some(text) = self.get(wanted) else { return Ok(None) };
        let number = text.trim().parse().ok().filter(|number: &f64| number.is_finite());
        number.map(Some).ok_or_else(|| self.error(wanted, format!("= `{}` is no number", short(&text))))
    }

    pub(super) fn required_number(&self, wanted: &'static str) -> Result<f64, SumoError> {
        self.number(wanted)?.ok_or_else(|| self.error(wanted, "is missing"))
    }

    pub(super) fn index(&self, wanted: &'static str) -> Result<Option<usize>, SumoError> {
        let Some(text) = self.get(wanted) else { return Ok(None) };
        let index = text.trim().parse::<u32>().ok();
        let index = index.map(|index| Some(index as usize));
        index.ok_or_else(|| self.error(wanted, format!("= `{}` is no index", short(&text))))
    }

    /// Words between spaces.
    pub(super) fn words(&self, wanted: &str) -> Vec<String> {
        self.get(wanted).map(|text| text.split_whitespace().map(str::to_owned).collect()).unwrap_or_default()
    }

    /// Points `x,y` or `x,y,z`, with their heights; no points if there is no such attribute.
    pub(super) fn shape(&self, wanted: &'static str) -> Result<Line, SumoError> {
        let text = self.get(wanted).unwrap_or_default();
        let mut line = Line::default();
        for point in text.split_whitespace() {
            let mut parts =
                point.split(',').map(|part| part.parse().ok().filter(|x: &f64| x.abs() <= FARTHEST));
            let (x, y) = (parts.next().flatten(), parts.next().flatten());
            let z = parts.next().unwrap_or(Some(0.0));
            let (Some(x), Some(y), Some(z)) = (x, y, z) else {
                return Err(self.error(wanted, format!("has `{}`, which is no point", short(point))));
            };
            line.points.push(Point2::new(x, y));
            line.heights.push(z);
        }
        Ok(line)
    }

    pub(super) fn error(&self, attribute: &'static str, reason: impl Into<Cow<'static, str>>) -> SumoError {
        let id = self.get("id").unwrap_or_default().into_owned();
        SumoError::Attribute { element: self.name().to_owned(), id, attribute, reason: reason.into() }
    }
}

/// The beginning of a text that may be very long.
fn short(text: &str) -> String {
    text.chars().take(40).collect()
}

/// A shape with its heights.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Line {
    pub(super) points: Vec<Point2>,
    pub(super) heights: Vec<f64>,
}

/// A reader that bounds what a file may ask for.
struct Guard<R> {
    inner: R,
    total: u64,
    piece: u64,
}

impl<R: BufRead> Read for Guard<R> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let count = self.fill_buf()?.read(into)?;
        self.consume(count);
        Ok(count)
    }
}

impl<R: BufRead> BufRead for Guard<R> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.total > MOST_BYTES {
            return Err(io::Error::other("the text is longer than 16 GiB"));
        }
        if self.piece > MOST_MARKUP {
            return Err(io::Error::other("a tag is longer than 16 MiB"));
        }
        self.inner.fill_buf()
    }

    fn consume(&mut self, amount: usize) {
        self.total += amount as u64;
        self.piece += amount as u64;
        self.inner.consume(amount);
    }
}
