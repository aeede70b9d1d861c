//! Values of spaces as plain vectors of numbers, and back.
//!
//! As in Gymnasium: a discrete value is one-hot, an array its entries, a dictionary its parts in the order of keys, a
//! tuple its parts in order. A text is its characters' scalar values, filled up with -1. Sequences and graphs, whose length is not
//! known, have no flat form.

use super::space::{Bounds, Space, SpaceError, SpaceValue, entries};

/// Flat forms are at most this long, so that a space that is large by mistake fills no memory.
const LONGEST: usize = 1 << 24;

impl Space {
    /// How many numbers the flat form of each member has; none for sequences, graphs, and more than 2^24 numbers.
    pub fn flat_length(&self) -> Option<usize> {
        let length = match self {
            Self::Discrete { n, .. } => usize::try_from(*n).ok(),
            Self::Box { shape, .. } => entries(shape),
            Self::MultiBinary { n } => Some(*n),
            Self::MultiDiscrete { n, .. } => sum(n.iter().map(|n| usize::try_from(*n).ok())),
            Self::Text { max_length } => Some(*max_length),
            Self::Dict(parts) => sum(parts.values().map(Self::flat_length)),
            Self::Tuple(parts) => sum(parts.iter().map(Self::flat_length)),
            Self::Sequence { .. } | Self::Graph { .. } => None,
        };
        length.filter(|length| *length <= LONGEST)
    }

    /// The box of flat forms, one-dimensional; none where there is no [`flat_length`](Self::flat_length).
    pub fn flattened(&self) -> Option<Self> {
        let length = self.flat_length()?;
        let (mut low, mut high) = (Vec::with_capacity(length), Vec::with_capacity(length));
        self.flat_bounds(&mut low, &mut high);
        Some(Self::bounded(low, high, vec![length]))
    }

    /// The flat form of a member, appended to `out`.
    ///
    /// # Errors
    /// The value is not in the space, or the space has no flat form.
    pub fn flatten_into(&self, value: &SpaceValue, out: &mut Vec<f64>) -> Result<(), SpaceError> {
        self.check(value)?;
        self.flat_length().ok_or_else(|| no_flat_form().under("value"))?;
        self.append(value, out);
        Ok(())
    }

    /// The flat form of a member.
    ///
    /// # Errors
    /// As [`flatten_into`](Self::flatten_into).
    pub fn flatten(&self, value: &SpaceValue) -> Result<Vec<f64>, SpaceError> {
        let mut out = Vec::new();
        self.flatten_into(value, &mut out)?;
        Ok(out)
    }

    /// The member that has this flat form.
    ///
    /// # Errors
    /// It is that of none.
    pub fn unflatten(&self, flat: &[f64]) -> Result<SpaceValue, SpaceError> {
        let length = self.flat_length().ok_or_else(|| no_flat_form().under("flat"))?;
        if flat.len() != length {
            let reason = format!("{} numbers where {length} are due", flat.len());
            return Err(SpaceError { path: "flat".to_owned(), reason });
        }
        let value = self.take(&mut { flat }).map_err(|error| error.under("flat"))?;
        self.check(&value)?;
        Ok(value)
    }

    fn flat_bounds(&self, low: &mut Vec<f64>, high: &mut Vec<f64>) {
        let mut fill = |count: usize, least: f64, most: f64| {
            low.resize(low.len() + count, least);
            high.resize(high.len() + count, most);
        };
        match self {
            Self::Box { low: lows, high: highs, shape } => {
                for index in 0..entries(shape).unwrap_or(0) {
                    low.push(bound(lows, index, f64::NEG_INFINITY));
                    high.push(bound(highs, index, f64::INFINITY));
                }
            }
            Self::Text { max_length } => fill(*max_length, -1.0, f64::from(u32::from(char::MAX))),
            Self::Dict(parts) => parts.values().for_each(|part| part.flat_bounds(low, high)),
            Self::Tuple(parts) => parts.iter().for_each(|part| part.flat_bounds(low, high)),
            _ => fill(self.flat_length().unwrap_or(0), 0.0, 1.0),
        }
    }

    /// A value that was checked.
    fn append(&self, value: &SpaceValue, out: &mut Vec<f64>) {
        match (self, value) {
            (Self::Discrete { n, start }, SpaceValue::Discrete(value)) => one_hot(*n, *start, *value, out),
            (Self::Box { .. }, SpaceValue::Box(entries)) => out.extend_from_slice(entries),
            (Self::MultiBinary { .. }, SpaceValue::MultiBinary(bits)) => {
                out.extend(bits.iter().map(|bit| f64::from(u8::from(*bit))));
            }
            (Self::MultiDiscrete { n, start }, SpaceValue::MultiDiscrete(values)) => {
                let ranges = n.iter().zip(start).zip(values);
                ranges.for_each(|((n, start), value)| one_hot(*n, *start, *value, out));
            }
            (Self::Text { max_length }, SpaceValue::Text(text)) => {
                let end = out.len() + max_length;
                out.extend(text.chars().map(|char| f64::from(u32::from(char))));
                out.resize(end, -1.0);
            }
            (Self::Dict(spaces), SpaceValue::Dict(values)) => {
                spaces.values().zip(values.values()).for_each(|(space, value)| space.append(value, out));
            }
            (Self::Tuple(spaces), SpaceValue::Tuple(values)) => {
                spaces.iter().zip(values).for_each(|(space, value)| space.append(value, out));
            }
            // The kinds agree, and sequences and graphs have no flat form: both were checked before.
            _ => {}
        }
    }

    /// Reads one member off the front; there are as many numbers as it takes.
    fn take(&self, rest: &mut &[f64]) -> Result<SpaceValue, SpaceError> {
        Ok(match self {
            Self::Discrete { n, start } => SpaceValue::Discrete(hot(*start, split(rest, *n as usize))?),
            Self::Box { shape, .. } => SpaceValue::Box(split(rest, entries(shape).unwrap_or(0)).to_vec()),
            Self::MultiBinary { n } => {
                let bits = split(rest, *n).iter().map(|number| match number {
                    0.0 => Ok(false),
                    1.0 => Ok(true),
                    _ => Err(SpaceError::here(format!("{number} is neither 0 nor 1"))),
                });
                SpaceValue::MultiBinary(bits.collect::<Result<_, _>>()?)
            }
            Self::MultiDiscrete { n, start } => {
                let each = n.iter().zip(start).map(|(n, start)| hot(*start, split(rest, *n as usize)));
                SpaceValue::MultiDiscrete(each.collect::<Result<_, _>>()?)
            }
            Self::Text { max_length } => SpaceValue::Text(text(split(rest, *max_length))?),
            Self::Dict(spaces) => {
                let parts = spaces.iter().map(|(key, space)| Ok((key.clone(), space.take(rest)?)));
                SpaceValue::Dict(parts.collect::<Result<_, SpaceError>>()?)
            }
            Self::Tuple(spaces) => {
                SpaceValue::Tuple(spaces.iter().map(|space| space.take(rest)).collect::<Result<_, _>>()?)
            }
            Self::Sequence { .. } | Self::Graph { .. } => return Err(no_flat_form()),
        })
    }
}

/// None where a part has none, or the sum is more than can be counted.
fn sum(mut parts: impl Iterator<Item = Option<usize>>) -> Option<usize> {
    parts.try_fold(0_usize, |sum, part| sum.checked_add(part?))
}

fn no_flat_form() -> SpaceError {
    SpaceError::here("has no flat form: its length is not known, or is above 2^24")
}

fn bound(bounds: &Bounds, index: usize, none: f64) -> f64 {
    bounds.at(index).unwrap_or(none)
}

fn split<'a>(rest: &mut &'a [f64], count: usize) -> &'a [f64] {
    let (head, tail) = rest.split_at(count.min(rest.len()));
    *rest = tail;
    head
}

fn one_hot(n: u64, start: i64, value: i64, out: &mut Vec<f64>) {
    let begin = out.len();
    out.resize(begin + n as usize, 0.0);
    // in range, because the value was checked
    out[begin + value.wrapping_sub(start) as usize] = 1.0;
}

fn hot(start: i64, numbers: &[f64]) -> Result<i64, SpaceError> {
    let mut set = numbers.iter().enumerate().filter(|(_, number)| **number != 0.0);
    match (set.next(), set.next()) {
        (Some((index, 1.0)), None) => Ok(start.wrapping_add(index as i64)),
        _ => Err(SpaceError::here("is not one-hot: exactly one 1 among zeros is due")),
    }
}

fn text(numbers: &[f64]) -> Result<String, SpaceError> {
    let end = numbers.iter().position(|number| *number == -1.0).unwrap_or(numbers.len());
    let (codes, fill) = numbers.split_at(end);
    let character = |code: &f64| {
        let whole = code.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(code);
        whole.then(|| char::from_u32(*code as u32)).flatten()
    };
    let text: Option<String> = codes.iter().map(character).collect();
    match text {
        Some(text) if fill.iter().all(|number| *number == -1.0) => Ok(text),
        _ => Err(SpaceError::here("is no text: scalar values are due, filled up with -1")),
    }
}
