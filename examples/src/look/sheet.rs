//! A contact sheet: pictures of one size in rows, each with a line of words under it.

/// Height of the line of words under a picture, pixels.
const CAPTION: usize = 22;
/// Between pictures, pixels.
const GAP: usize = 6;
/// Of the letters: pixels to one dot of the 3 x 5 that a letter has.
const DOT: usize = 2;
const PAPER: u8 = 250;
const INK: u8 = 40;

/// Pictures of one size, 8-bit RGB.
pub struct Sheet {
    columns: usize,
    tile: [usize; 2],
    tiles: Vec<(String, Vec<u8>)>,
}

impl Sheet {
    /// A sheet of as many columns of pictures that are `width` by `height` pixels.
    pub fn new(columns: usize, width: usize, height: usize) -> Self {
        Self { columns: columns.max(1), tile: [width, height], tiles: Vec::new() }
    }

    /// Adds a picture; one of another size is left out and `false` returned.
    pub fn add(&mut self, caption: &str, rgb: &[u8]) -> bool {
        let fits = rgb.len() == 3 * self.tile[0] * self.tile[1];
        if fits {
            self.tiles.push((caption.to_owned(), rgb.to_vec()));
        }
        fits
    }

    /// Width, height and bytes of the whole.
    pub fn draw(&self) -> (usize, usize, Vec<u8>) {
        let [width, height] = self.tile;
        let rows = self.tiles.len().div_ceil(self.columns);
        let across = GAP + self.columns * (width + GAP);
        let down = GAP + rows * (height + CAPTION);
        let mut bytes = vec![PAPER; 3 * across * down];
        for (index, (caption, rgb)) in self.tiles.iter().enumerate() {
            let left = GAP + (index % self.columns) * (width + GAP);
            let top = GAP + (index / self.columns) * (height + CAPTION);
            for (row, line) in rgb.chunks_exact(3 * width).enumerate() {
                let start = 3 * ((top + row) * across + left);
                bytes[start..start + 3 * width].copy_from_slice(line);
            }
            write(&mut bytes, across, [left, top + height + 6], caption, width);
        }
        (across, down, bytes)
    }
}

/// Writes words from a corner on, at most `room` pixels of them.
fn write(bytes: &mut [u8], across: usize, [left, top]: [usize; 2], words: &str, room: usize) {
    let step = 4 * DOT;
    for (index, letter) in words.chars().take(room / step).enumerate() {
        let rows = glyph(letter);
        for (row, bits) in rows.into_iter().enumerate() {
            for column in (0..3).filter(|column| bits & (4 >> column) != 0) {
                for dot in 0..DOT * DOT {
                    let x = left + index * step + column * DOT + dot % DOT;
                    let at = 3 * ((top + row * DOT + dot / DOT) * across + x);
                    bytes[at..at + 3].fill(INK);
                }
            }
        }
    }
}

/// Five rows of three dots; small letters are large ones, and what is unknown is a space.
fn glyph(letter: char) -> [u8; 5] {
    let rows = match letter.to_ascii_uppercase() {
        'A' => 0o25755,
        'B' => 0o65656,
        'C' => 0o34443,
        'D' => 0o65556,
        'E' => 0o74647,
        'F' => 0o74644,
        'G' => 0o34553,
        'H' => 0o55755,
        'I' => 0o72227,
        'J' => 0o11152,
        'K' => 0o55655,
        'L' => 0o44447,
        'M' => 0o57755,
        'N' => 0o65555,
        'O' => 0o25552,
        'P' => 0o65644,
        'Q' => 0o25563,
        'R' => 0o65655,
        'S' => 0o34216,
        'T' => 0o72222,
        'U' => 0o55557,
        'V' => 0o55552,
        'W' => 0o55775,
        'X' => 0o55255,
        'Y' => 0o55222,
        'Z' => 0o71247,
        '0' => 0o75557,
        '1' => 0o26227,
        '2' => 0o71747,
        '3' => 0o71717,
        '4' => 0o55711,
        '5' => 0o74717,
        '6' => 0o74757,
        '7' => 0o71244,
        '8' => 0o75757,
        '9' => 0o75717,
        ':' => 0o02020,
        '-' => 0o00700,
        '.' => 0o00002,
        ',' => 0o00024,
        '/' => 0o11244,
        _ => 0_u16,
    };
    std::array::from_fn(|row| (rows >> (12 - 3 * row) & 7) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_keeps_its_pixels_and_has_its_words_under_it() {
        let mut sheet = Sheet::new(2, 40, 10);
        assert!(sheet.add("noon", &[7; 3 * 400]) && !sheet.add("wrong", &[7; 3]));
        sheet.add("night", &[9; 3 * 400]);
        sheet.add("rain", &[11; 3 * 400]);
        let (across, down, bytes) = sheet.draw();
        assert_eq!(bytes.len(), 3 * across * down);
        let pixel = |x: usize, y: usize| bytes[3 * (y * across + x)];
        assert_eq!((pixel(GAP, GAP), pixel(GAP + 39, GAP + 9), pixel(GAP + 40 + GAP, GAP)), (7, 7, 9));
        assert_eq!(pixel(GAP, GAP + 10 + CAPTION), 11);
        let caption = &bytes[3 * across * (GAP + 10)..3 * across * (GAP + 10 + CAPTION)];
        assert!(caption.contains(&INK));
    }

    #[test]
    fn letters_differ() {
        let known: Vec<[u8; 5]> = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789:-.,/".chars().map(glyph).collect();
        for (index, one) in known.iter().enumerate() {
            assert!(known[..index].iter().all(|other| other != one), "{index}");
        }
    }
}
