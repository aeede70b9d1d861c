//! The wire format of protocol buffers, as far as OSM PBF needs it: <https://protobuf.dev/programming-guides/encoding/>.
//!
//! Borrowed fields of a message in memory; a message that is cut short or malformed ends the iteration with a fault.

/// What is wrong with a message.
pub(super) type Fault = &'static str;

const CUT_SHORT: Fault = "a message is cut short";

/// A field of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Field<'a> {
    /// A number.
    Varint(u64),
    /// Bytes, text, packed numbers or a message.
    Bytes(&'a [u8]),
    /// A number of four or eight bytes, which OSM PBF does not use.
    Fixed,
}

impl<'a> Field<'a> {
    /// As bytes.
    pub(super) fn bytes(self) -> Result<&'a [u8], Fault> {
        match self {
            Self::Bytes(bytes) => Ok(bytes),
            _ => Err("a field is a number that should be bytes"),
        }
    }

    /// As a number.
    pub(super) fn number(self) -> Result<u64, Fault> {
        match self {
            Self::Varint(number) => Ok(number),
            _ => Err("a field is no number"),
        }
    }

    /// As a signed number that is not in zigzag order.
    pub(super) fn signed(self) -> Result<i64, Fault> {
        Ok(self.number()? as i64)
    }
}

/// Takes a number from the front of some bytes.
pub(super) fn varint(bytes: &mut &[u8]) -> Result<u64, Fault> {
    let mut value = 0_u64;
    for shift in (0..70).step_by(7) {
        let (first, rest) = bytes.split_first().ok_or(CUT_SHORT)?;
        *bytes = rest;
        // The tenth byte holds one bit; what is above is lost, as everywhere.
        value |= u64::from(first & 0x7f).checked_shl(shift).unwrap_or(0);
        if first & 0x80 == 0 {
            return Ok(value);
        }
    }
    Err("a number is longer than ten bytes")
}

/// A signed number from zigzag order.
pub(super) const fn zigzag(number: u64) -> i64 {
    (number >> 1) as i64 ^ -((number & 1) as i64)
}

/// The fields of a message, each with its number.
pub(super) struct Message<'a>(pub(super) &'a [u8]);

impl<'a> Message<'a> {
    fn take(&mut self, count: u64) -> Result<&'a [u8], Fault> {
        let count = usize::try_from(count).ok().filter(|count| *count <= self.0.len()).ok_or(CUT_SHORT)?;
        let (taken, rest) = self.0.split_at(count);
        self.0 = rest;
        Ok(taken)
    }

    fn field(&mut self) -> Result<(u32, Field<'a>), Fault> {
        let key = varint(&mut self.0)?;
        let field = match key & 7 {
            0 => Field::Varint(varint(&mut self.0)?),
            1 => self.take(8).map(|_| Field::Fixed)?,
            2 => {
                let length = varint(&mut self.0)?;
                Field::Bytes(self.take(length)?)
            }
            5 => self.take(4).map(|_| Field::Fixed)?,
            _ => return Err("a field has no known type"),
        };
        Ok(((key >> 3) as u32, field))
    }
}

impl<'a> Iterator for Message<'a> {
    type Item = Result<(u32, Field<'a>), Fault>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.0.is_empty() {
            return None;
        }
        let field = self.field();
        if field.is_err() {
            self.0 = &[];
        }
        Some(field)
    }
}

/// Packed numbers.
#[derive(Clone, Debug, Default)]
pub(super) struct Packed<'a>(pub(super) &'a [u8]);

impl Iterator for Packed<'_> {
    type Item = Result<u64, Fault>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.0.is_empty() {
            return None;
        }
        let number = varint(&mut self.0);
        if number.is_err() {
            self.0 = &[];
        }
        Some(number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_fields_are_read() {
        // The examples of the specification: 150 in field 1, "testing" in field 2.
        let message = [0x08, 0x96, 0x01, 0x12, 0x07, 0x74, 0x65, 0x73, 0x74, 0x69, 0x6e, 0x67];
        let fields: Vec<_> = Message(&message).map(Result::unwrap).collect();
        assert_eq!(fields, [(1, Field::Varint(150)), (2, Field::Bytes(b"testing"))]);
        assert_eq!([0, 1, 2, 3].map(zigzag), [0, -1, 1, -2]);
        assert_eq!(
            Packed(&[0x03, 0x8e, 0x02, 0x9e, 0xa7, 0x05]).map(Result::unwrap).collect::<Vec<_>>(),
            [3, 270, 86_942]
        );
    }

    #[test]
    fn what_is_cut_short_is_a_fault() {
        for broken in [&[0x08][..], &[0x12, 0x07, 0x74], &[0xff; 11], &[0x0b], &[0x09, 1, 2]] {
            assert!(Message(broken).any(|field| field.is_err()), "{broken:?}");
        }
    }
}
