//! Noun phrases: what a thing is called, and near what it stands.

use simworld_core::geometry::Point3;
use simworld_core::id::EntityId;
use simworld_core::scene::Relation;

use super::Fault;

/// A thing, as it was said.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Phrase {
    /// At coordinates, m.
    Point(Point3),
    /// By id.
    Id(EntityId),
    /// By words, perhaps beside another thing.
    Thing { words: String, beside: Option<(Relation, Box<Phrase>)> },
}

/// Words that lead to a thing and say nothing of it.
const LEADING: &[&str] = &[
    "to", "towards", "toward", "at", "on", "onto", "in", "into", "down", "over", "up", "for", "the", "a",
    "an", "nearest", "closest", "next", "near", "by", "back", "inside", "some", "any", "that", "this", "my",
];

/// Relations by their words, the longer first.
const RELATIONS: &[(&[&str], Relation)] = &[
    (&["in", "front", "of"], Relation::InFrontOf),
    (&["to", "the", "left", "of"], Relation::LeftOf),
    (&["to", "the", "right", "of"], Relation::RightOf),
    (&["left", "of"], Relation::LeftOf),
    (&["right", "of"], Relation::RightOf),
    (&["next", "to"], Relation::NextTo),
    (&["close", "to"], Relation::Near),
    (&["beside"], Relation::NextTo),
    (&["near"], Relation::Near),
    (&["by"], Relation::Near),
    (&["behind"], Relation::Behind),
    (&["far", "from"], Relation::FarFrom),
    (&["on", "top", "of"], Relation::OnTopOf),
];

/// How deep things may stand beside things.
const DEEPEST: usize = 4;

pub(super) fn parse(words: &[String]) -> Result<Phrase, Fault> {
    parse_nested(words, 0)
}

fn parse_nested(words: &[String], depth: usize) -> Result<Phrase, Fault> {
    if depth > DEEPEST {
        return Err(Fault::Unclear("too many things beside things: name fewer".to_owned()));
    }
    let start = words.iter().position(|word| !LEADING.contains(&word.as_str())).unwrap_or(words.len());
    let words = &words[start..];
    if let [only] = words {
        if let Some(point) = point(only) {
            return point.map(Phrase::Point);
        }
        if let Some(number) = only.strip_prefix('#') {
            let id = number
                .parse::<u64>()
                .map_err(|_| Fault::Unclear("an id is # and a number: #12".to_owned()))?;
            return Ok(Phrase::Id(EntityId::from(id)));
        }
    }
    for at in 1..words.len() {
        let rest = &words[at..];
        let relation = RELATIONS.iter().find(|(pattern, _)| {
            rest.len() > pattern.len() && pattern.iter().zip(rest).all(|(wanted, word)| wanted == word)
        });
        if let Some((pattern, relation)) = relation {
            let beside = parse_nested(&rest[pattern.len()..], depth + 1)?;
            return Ok(Phrase::Thing {
                words: words[..at].join(" "),
                beside: Some((*relation, Box::new(beside))),
            });
        }
    }
    Ok(Phrase::Thing { words: words.join(" "), beside: None })
}

/// "(10,-3)" or "(10,-3,0)"; `None` if it is no such thing, an error if its numbers are not.
fn point(word: &str) -> Option<Result<Point3, Fault>> {
    let inner = word.strip_prefix('(')?.strip_suffix(')')?;
    let numbers: Result<Vec<f64>, _> = inner.split(',').map(str::parse).collect();
    let point = match numbers.as_deref() {
        Ok([x, y]) => Some(Point3::new(*x, *y, 0.0)),
        Ok([x, y, z]) => Some(Point3::new(*x, *y, *z)),
        _ => None,
    };
    let point = point.filter(|point| point.iter().all(|number| number.abs() < 1e7));
    Some(point.ok_or_else(|| Fault::Unclear("coordinates are (east, north) in metres: (10, -3)".to_owned())))
}
