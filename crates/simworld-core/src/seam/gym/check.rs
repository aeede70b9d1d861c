//! Whether a value is in a space, and whether a space is one.

use super::space::{Space, SpaceError, SpaceValue, entries};

type Checked = Result<(), SpaceError>;

fn wrong(reason: impl Into<String>) -> Checked {
    Err(SpaceError::here(reason))
}

impl Space {
    /// Checks that a value is in the space.
    ///
    /// # Errors
    /// The first place where it is not.
    pub fn check(&self, value: &SpaceValue) -> Checked {
        self.check_inside(value).map_err(|error| error.under("value"))
    }

    /// Checks that the space is one: counts of at least 1, bounds that are in order and as many as the shape says.
    ///
    /// # Errors
    /// The first part that is none.
    pub fn validate(&self) -> Checked {
        self.validate_inside().map_err(|error| error.under("space"))
    }

    fn check_inside(&self, value: &SpaceValue) -> Checked {
        match (self, value) {
            (Self::Discrete { n, start }, SpaceValue::Discrete(value)) => check_integer(*n, *start, *value),
            (Self::Box { shape, .. }, SpaceValue::Box(given)) => self.check_box(shape, given),
            (Self::MultiBinary { n }, SpaceValue::MultiBinary(bits)) => same_count(bits.len(), *n, "bits"),
            (Self::MultiDiscrete { n, start }, SpaceValue::MultiDiscrete(values)) => {
                same_count(values.len(), n.len(), "integers")?;
                let ranges = n.iter().zip(start).zip(values).enumerate();
                ranges
                    .map(|(index, ((n, start), value))| (index, check_integer(*n, *start, *value)))
                    .try_for_each(at)
            }
            (Self::Text { max_length }, SpaceValue::Text(text)) => {
                at_most(text.chars().count(), *max_length, "characters")
            }
            (Self::Dict(spaces), SpaceValue::Dict(values)) => {
                if let Some(key) = values.keys().find(|key| !spaces.contains_key(*key)) {
                    return wrong(format!("unknown key {key}"));
                }
                spaces.iter().try_for_each(|(key, space)| {
                    let value = values.get(key).ok_or_else(|| SpaceError::here("is missing"));
                    value
                        .and_then(|value| space.check_inside(value))
                        .map_err(|error| error.under(&format!(".{key}")))
                })
            }
            (Self::Tuple(spaces), SpaceValue::Tuple(values)) => {
                same_count(values.len(), spaces.len(), "parts")?;
                let pairs = spaces.iter().zip(values).enumerate();
                pairs.map(|(index, (space, value))| (index, space.check_inside(value))).try_for_each(at)
            }
            (Self::Sequence { of, max_length }, SpaceValue::Sequence(values)) => {
                at_most(values.len(), *max_length, "values")?;
                of.check_all(values)
            }
            (Self::Graph { .. }, SpaceValue::Graph { nodes, edges, links }) => {
                self.check_graph(nodes, edges, links)
            }
            _ => wrong("is of another kind than the space"),
        }
    }

    fn check_all(&self, values: &[SpaceValue]) -> Checked {
        values.iter().map(|value| self.check_inside(value)).enumerate().try_for_each(at)
    }

    fn check_box(&self, shape: &[usize], given: &[f64]) -> Checked {
        let Self::Box { low, high, .. } = self else { return Ok(()) };
        if entries(shape) != Some(given.len()) {
            return wrong(format!("{} entries do not fill the shape {shape:?}", given.len()));
        }
        for (index, entry) in given.iter().enumerate() {
            let (Some(low), Some(high)) = (low.at(index), high.at(index)) else {
                return wrong(format!("the space has no bounds for entry {index}"));
            };
            if !(low..=high).contains(entry) {
                return wrong(format!("entry {index} = {entry} is not in [{low}, {high}]"));
            }
        }
        Ok(())
    }

    fn check_graph(&self, nodes: &[SpaceValue], edges: &[SpaceValue], links: &[[u32; 2]]) -> Checked {
        let Self::Graph { node, edge, max_nodes, max_edges } = self else { return Ok(()) };
        at_most(nodes.len(), *max_nodes, "nodes")?;
        at_most(links.len(), *max_edges, "links")?;
        node.check_all(nodes).map_err(|error| error.under(".nodes"))?;
        let with_values = if edge.is_some() { links.len() } else { 0 };
        same_count(edges.len(), with_values, "values of links")?;
        if let Some(edge) = edge {
            edge.check_all(edges).map_err(|error| error.under(".edges"))?;
        }
        match links.iter().flatten().find(|end| **end as usize >= nodes.len()) {
            Some(end) => wrong(format!("a link ends at node {end} of {}", nodes.len())),
            None => Ok(()),
        }
    }

    fn validate_inside(&self) -> Checked {
        match self {
            Self::Discrete { n, start } => validate_integer(*n, *start),
            Self::Box { low, high, shape } => {
                let Some(count) = entries(shape) else {
                    return wrong(format!("the shape {shape:?} is too large"));
                };
                for (bounds, side) in [(low, "low"), (high, "high")] {
                    if let super::Bounds::Each(each) = bounds {
                        same_count(each.len(), count, "bounds")
                            .map_err(|error| error.under(&format!(".{side}")))?;
                    }
                }
                let ordered = |index: &usize| {
                    low.at(*index) <= high.at(*index) && low.at(*index).is_some_and(|b| b < f64::INFINITY)
                };
                match (0..count.min(1 << 24)).find(|index| !ordered(index)) {
                    Some(index) => {
                        wrong(format!("entry {index} has no value: its low bound is above its high one"))
                    }
                    None => Ok(()),
                }
            }
            Self::MultiDiscrete { n, start } => {
                same_count(start.len(), n.len(), "starts")?;
                let ranges = n.iter().zip(start).map(|(n, start)| validate_integer(*n, *start));
                ranges.enumerate().try_for_each(at)
            }
            Self::Dict(parts) => parts
                .iter()
                .try_for_each(|(key, part)| part.validate_inside().map_err(|e| e.under(&format!(".{key}")))),
            Self::Tuple(parts) => parts.iter().map(Self::validate_inside).enumerate().try_for_each(at),
            Self::Sequence { of, .. } => of.validate_inside(),
            Self::Graph { node, edge, .. } => {
                node.validate_inside().map_err(|error| error.under(".nodes"))?;
                edge.as_ref().map_or(Ok(()), |edge| edge.validate_inside().map_err(|e| e.under(".edges")))
            }
            Self::MultiBinary { .. } | Self::Text { .. } => Ok(()),
        }
    }
}

/// The place of what is wrong in a list.
fn at((index, checked): (usize, Checked)) -> Checked {
    checked.map_err(|error| error.under(&format!("[{index}]")))
}

fn check_integer(n: u64, start: i64, value: i64) -> Checked {
    // wide enough for every start and every count
    let offset = i128::from(value) - i128::from(start);
    if (0..i128::from(n)).contains(&offset) {
        Ok(())
    } else if start == 0 {
        wrong(format!("{value} is not below {n}"))
    } else {
        wrong(format!("{value} is none of the {n} integers from {start} on"))
    }
}

fn validate_integer(n: u64, start: i64) -> Checked {
    if n == 0 {
        wrong("it has no value: give n = 1 or more")
    } else if i128::from(start) + i128::from(n) - 1 > i128::from(i64::MAX) {
        wrong(format!("{n} integers from {start} on pass the greatest of 64 bits"))
    } else {
        Ok(())
    }
}

fn same_count(given: usize, due: usize, what: &str) -> Checked {
    if given == due { Ok(()) } else { wrong(format!("{given} {what} where {due} are due")) }
}

fn at_most(given: usize, most: usize, what: &str) -> Checked {
    if given <= most { Ok(()) } else { wrong(format!("{given} {what}, at most {most}")) }
}
