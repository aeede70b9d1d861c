//! A reader that bounds what a file may ask for.

use std::io::{self, BufRead, Read};

/// Bytes of text that are read at most, after decompression.
const MOST_BYTES: u64 = 16 << 30;
/// Bytes of one piece of markup: a tag of OSM XML has some hundred.
const MOST_MARKUP: u64 = 1 << 20;

/// Counts what is read, in all and since the last piece of markup, and fails beyond a limit.
pub(super) struct Guard<R> {
    inner: R,
    total: u64,
    piece: u64,
}

impl<R> Guard<R> {
    pub(super) fn of(inner: R) -> Self {
        Self { inner, total: 0, piece: 0 }
    }

    /// A piece of markup ends here.
    pub(super) fn begin_piece(&mut self) {
        self.piece = 0;
    }
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
            return Err(io::Error::other("the text is longer than 16 GiB: cut out a smaller extract"));
        }
        if self.piece > MOST_MARKUP {
            return Err(io::Error::other("a piece of markup is longer than 1 MiB: this is no OSM XML"));
        }
        self.inner.fill_buf()
    }

    fn consume(&mut self, amount: usize) {
        self.total += amount as u64;
        self.piece += amount as u64;
        self.inner.consume(amount);
    }
}
