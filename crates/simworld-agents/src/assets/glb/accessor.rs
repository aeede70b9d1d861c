//! Columns of numbers in the bytes of a file; nothing is read beyond the view that holds a column.

use super::document::Document;
use super::error::GlbError;

/// A file's document and its bytes.
#[derive(Clone, Copy)]
pub(super) struct Data<'a> {
    pub(super) document: &'a Document,
    pub(super) bytes: &'a [u8],
}

/// Rows of a few numbers each.
pub(super) struct Column<'a> {
    bytes: &'a [u8],
    stride: usize,
    number: Number,
    normalized: Normalized,
    wide: usize,
    pub(super) count: usize,
}

/// How a number is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    F32,
    I8,
    U8,
    I16,
    U16,
    U32,
}

impl Number {
    const fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::F32 | Self::U32 => 4,
        }
    }
}

impl<'a> Data<'a> {
    /// Whether positions, normals and coordinates of textures may be whole numbers.
    pub(super) fn is_quantized(&self) -> bool {
        self.document.extensions_required.iter().any(|name| name == "KHR_mesh_quantization")
    }

    /// The bytes of a view.
    pub(super) fn view(&self, index: usize) -> Result<&'a [u8], GlbError> {
        let view = get("buffer view", &self.document.buffer_views, index)?;
        let buffer = get("buffer", &self.document.buffers, view.buffer)?;
        if view.buffer != 0 {
            return Err(unsupported("buffer", view.buffer, "only the one in the file can be read"));
        }
        let length = buffer.byte_length.min(self.bytes.len() as u64);
        let end = view.byte_offset.saturating_add(view.byte_length);
        if end > length {
            return Err(GlbError::Bounds { what: "buffer view", index, end, length });
        }
        Ok(&self.bytes[view.byte_offset as usize..end as usize])
    }

    /// A column of a shape (`SCALAR`, `VEC3`) with that many numbers a row; the reader says which writings it takes.
    pub(super) fn column(
        &self,
        index: usize,
        shapes: &[(&str, usize)],
        takes: impl Fn(Number, Normalized) -> bool,
    ) -> Result<Column<'a>, GlbError> {
        let accessor = get("accessor", &self.document.accessors, index)?;
        let refused = |reason: &str| unsupported("accessor", index, reason);
        if accessor.sparse.is_some() {
            return Err(refused("it is sparse: export the file without sparse accessors"));
        }
        let view_index = accessor.buffer_view.ok_or_else(|| refused("it has no buffer view"))?;
        let number = match accessor.component_type {
            5126 => Number::F32,
            5120 => Number::I8,
            5122 => Number::I16,
            5121 => Number::U8,
            5123 => Number::U16,
            5125 => Number::U32,
            _ => return Err(refused("its numbers are of a type that does not belong there")),
        };
        let normalized = if accessor.normalized { Normalized::Yes } else { Normalized::No };
        let shape = shapes.iter().find(|(name, _)| *name == accessor.shape);
        let Some((_, wide)) = shape.filter(|_| takes(number, normalized)) else {
            return Err(refused("its numbers are of a type or shape that does not belong there"));
        };
        let row = wide * number.size();
        let view = self.view(view_index)?;
        let stride = self.document.buffer_views[view_index].byte_stride.map_or(row as u64, |stride| stride);
        if accessor.count == 0 || stride < row as u64 {
            return Err(refused("it is empty, or its rows overlap"));
        }
        let end = (accessor.count - 1)
            .checked_mul(stride)
            .and_then(|rows| rows.checked_add(accessor.byte_offset)?.checked_add(row as u64))
            .unwrap_or(u64::MAX);
        if end > view.len() as u64 {
            return Err(GlbError::Bounds { what: "accessor", index, end, length: view.len() as u64 });
        }
        Ok(Column {
            bytes: &view[accessor.byte_offset as usize..end as usize],
            stride: stride as usize,
            number,
            normalized,
            wide: *wide,
            count: accessor.count as usize,
        })
    }
}

/// Whether whole numbers stand for [0, 1].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Normalized {
    Yes,
    No,
}

impl Column<'_> {
    /// A number of a row; normalized ones stand for [0, 1], or for [-1, 1] where they have a sign.
    pub(super) fn real(&self, row: usize, which: usize) -> f64 {
        let at = self.at(row, which);
        let (number, most) = match self.number {
            Number::F32 => return f64::from(f32::from_le_bytes(self.array(at))),
            Number::I8 => (f64::from(i8::from_le_bytes(self.array(at))), 127.0),
            Number::U8 => (f64::from(self.bytes[at]), 255.0),
            Number::I16 => (f64::from(i16::from_le_bytes(self.array(at))), 32_767.0),
            Number::U16 => (f64::from(u16::from_le_bytes(self.array(at))), 65_535.0),
            Number::U32 => (f64::from(u32::from_le_bytes(self.array(at))), f64::from(u32::MAX)),
        };
        // The least of a sign has no counterpart: it is -1 too.
        if self.normalized == Normalized::Yes { (number / most).max(-1.0) } else { number }
    }

    /// How many numbers a row has.
    pub(super) const fn wide(&self) -> usize {
        self.wide
    }

    /// The first numbers of a row.
    pub(super) fn reals<const N: usize>(&self, row: usize) -> [f64; N] {
        std::array::from_fn(|which| self.real(row, which))
    }

    /// An index.
    pub(super) fn index(&self, row: usize) -> u32 {
        self.whole(row, 0)
    }

    /// A whole number of a row.
    pub(super) fn whole(&self, row: usize, which: usize) -> u32 {
        let at = self.at(row, which);
        match self.number {
            Number::U8 | Number::I8 => u32::from(self.bytes[at]),
            Number::U16 | Number::I16 => u32::from(u16::from_le_bytes(self.array(at))),
            Number::U32 | Number::F32 => u32::from_le_bytes(self.array(at)),
        }
    }

    fn at(&self, row: usize, which: usize) -> usize {
        assert!(row < self.count && which < self.wide, "within what was checked");
        row * self.stride + which * self.number.size()
    }

    /// Rows lie within the bytes: the constructor has checked it.
    fn array<const N: usize>(&self, at: usize) -> [u8; N] {
        std::array::from_fn(|offset| self.bytes[at + offset])
    }
}

/// What an index of a list refers to.
pub(super) fn get<'a, T>(what: &'static str, list: &'a [T], index: usize) -> Result<&'a T, GlbError> {
    list.get(index).ok_or(GlbError::Missing { what, index: index as u64, count: list.len() as u64 })
}

pub(super) fn unsupported(what: &'static str, index: usize, reason: &str) -> GlbError {
    GlbError::Unsupported { what, index, reason: reason.to_owned() }
}
