//! XML with bounds: numbers, names and places of elements.

use roxmltree::{Document, Node, ParsingOptions};

use super::ImportLimits;
use crate::robot::RobotError;

/// Where an element begins, for errors and reports.
pub(super) fn place(node: Node<'_, '_>) -> String {
    let at = node.document().text_pos_at(node.range().start);
    let tag = node.tag_name().name();
    match node.attribute("name") {
        Some(name) => format!("line {}:{}, <{tag}> {:?}", at.row, at.col, shortened(name)),
        None => format!("line {}:{}, <{tag}>", at.row, at.col),
    }
}

/// So much of a text as an error shows.
pub(super) fn shortened(text: &str) -> String {
    const SHOWN: usize = 60;
    if text.chars().count() <= SHOWN {
        text.to_owned()
    } else {
        text.chars().take(SHOWN).chain("...".chars()).collect()
    }
}

/// The document of a text, within bounds.
pub(super) fn parse<'a>(text: &'a str, limits: &ImportLimits) -> Result<Document<'a>, RobotError> {
    let too_many =
        |what, found, most| RobotError::TooMany { place: "the file".to_owned(), what, found, most };
    if text.len() > limits.bytes {
        return Err(too_many("bytes", text.len(), limits.bytes));
    }
    // Attributes and texts are nodes as well.
    let options =
        ParsingOptions { nodes_limit: limits.elements.saturating_mul(3), ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|error| match error {
        roxmltree::Error::DtdDetected => RobotError::Unsupported {
            place: "the file".to_owned(),
            what: "a document type with entities of its own".to_owned(),
            mend: "take the DOCTYPE out and write out what its entities stand for",
        },
        roxmltree::Error::NodesLimitReached => {
            let most = limits.elements as usize;
            too_many("elements", most + 1, most)
        }
        other => RobotError::Xml { reason: other.to_string() },
    })?;
    let mut depths: Vec<usize> = Vec::new();
    for node in document.descendants() {
        let depth = node.parent().map_or(0, |parent| depths[parent.id().get_usize()] + 1);
        depths.push(depth);
        if depth > limits.depth {
            return Err(too_many("elements within one another", depth, limits.depth));
        }
    }
    Ok(document)
}

/// The first child of a name.
pub(super) fn child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    children(node, name).next()
}

/// The children of a name.
pub(super) fn children<'a, 'i, 'n>(
    node: Node<'a, 'i>,
    name: &'n str,
) -> impl Iterator<Item = Node<'a, 'i>> + use<'a, 'i, 'n> {
    node.children().filter(move |child| child.has_tag_name(name))
}

/// An attribute that has to be there.
#[cfg(feature = "urdf")]
pub(super) fn required<'a>(
    node: Node<'a, '_>,
    attribute: &str,
    mend: &'static str,
) -> Result<&'a str, RobotError> {
    node.attribute(attribute).ok_or_else(|| RobotError::Missing {
        place: place(node),
        what: attribute.to_owned(),
        mend,
    })
}

/// The finite numbers of a text, separated by spaces; of very many the first.
pub(super) fn numbers(node: Node<'_, '_>, attribute: &str, text: &str) -> Result<Vec<f64>, RobotError> {
    numbers_up_to(node, attribute, text, 16)
}

/// The finite numbers of a text, separated by spaces; where there are more than so many, one more than that.
pub(super) fn numbers_up_to(
    node: Node<'_, '_>,
    attribute: &str,
    text: &str,
    most: usize,
) -> Result<Vec<f64>, RobotError> {
    let wrong = |allowed| RobotError::Text {
        place: place(node),
        attribute: attribute.to_owned(),
        value: shortened(text),
        allowed,
    };
    let words = text.split_whitespace().take(most.saturating_add(1));
    let numbers: Result<Vec<f64>, _> = words.map(str::parse::<f64>).collect();
    let numbers = numbers.map_err(|_| wrong("numbers, separated by spaces"))?;
    if numbers.iter().all(|number| number.is_finite()) { Ok(numbers) } else { Err(wrong("finite numbers")) }
}

/// Exactly so many numbers, if the text is there.
pub(super) fn exactly<const N: usize>(
    node: Node<'_, '_>,
    attribute: &str,
    text: Option<&str>,
) -> Result<Option<[f64; N]>, RobotError> {
    let Some(text) = text else { return Ok(None) };
    let numbers = numbers(node, attribute, text)?;
    match <[f64; N]>::try_from(numbers) {
        Ok(numbers) => Ok(Some(numbers)),
        Err(_) => Err(RobotError::Text {
            place: place(node),
            attribute: attribute.to_owned(),
            value: shortened(text),
            allowed: match N {
                1 => "one number",
                2 => "two numbers",
                3 => "three numbers",
                4 => "four numbers",
                6 => "six numbers",
                _ => "another count of numbers",
            },
        }),
    }
}

/// One number, if it is there.
#[cfg(feature = "urdf")]
pub(super) fn number(node: Node<'_, '_>, attribute: &str) -> Result<Option<f64>, RobotError> {
    Ok(exactly::<1>(node, attribute, node.attribute(attribute))?.map(|[number]| number))
}
