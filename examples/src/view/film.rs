//! Films without a window: an animated GIF, a folder of PNG files, or (feature `mp4`) a video.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use simworld_render::{Frame, RenderError};
use thiserror::Error;

use super::Canvas;
#[cfg(feature = "mp4")]
use super::video::Video;
use crate::folder::{FolderError, make_folder};

/// Why there is no film.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FilmError {
    /// A file cannot be made.
    #[error("{} cannot be written: {source}; give a path that can be written to", path.display())]
    File {
        /// Which.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The folder cannot be made.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// A GIF is at most 65535 pixels wide and high.
    #[error("a GIF of {width} x {height} pixels cannot be: give at most 65535 each way")]
    Size {
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
    },
    /// The GIF cannot be written.
    #[error("the GIF cannot be written: {0}")]
    Gif(#[from] gif::EncodingError),
    /// The PNG cannot be written.
    #[error(transparent)]
    Png(#[from] RenderError),
    /// The video cannot be made.
    #[error("the video cannot be made: {reason}; take --gif or --png, or another --width and --height")]
    Video {
        /// Why.
        reason: String,
    },
}

/// A film in the making; all pictures have the size of the first.
pub enum Film {
    /// An animated GIF that begins anew at its end.
    Gif {
        /// Where to.
        path: PathBuf,
        /// Hundredths of a second a picture.
        delay: u16,
        /// Begins with the first picture.
        encoder: Option<Box<gif::Encoder<BufWriter<File>>>>,
    },
    /// `00000.png`, `00001.png` and so on.
    Pngs {
        /// The folder.
        folder: PathBuf,
        /// How many there are.
        taken: usize,
    },
    /// A video: AV1 in MP4.
    #[cfg(feature = "mp4")]
    Mp4 {
        /// Where to.
        path: PathBuf,
        /// Seconds a picture.
        seconds: f64,
        /// Begins with the first picture.
        video: Option<Box<Video>>,
    },
}

impl Film {
    /// A GIF with that many seconds a picture; viewers show at most 50 a second.
    pub fn gif(path: &Path, seconds: f64) -> Self {
        let delay = (seconds * 100.0).round().clamp(2.0, 1000.0) as u16;
        Self::Gif { path: path.to_owned(), delay, encoder: None }
    }

    /// A folder of pictures, which is made.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn pngs(folder: &Path) -> Result<Self, FilmError> {
        make_folder(folder)?;
        Ok(Self::Pngs { folder: folder.to_owned(), taken: 0 })
    }

    /// A video with that many seconds a picture, which replaces the file.
    #[cfg(feature = "mp4")]
    pub fn mp4(path: &Path, seconds: f64) -> Self {
        Self::Mp4 { path: path.to_owned(), seconds, video: None }
    }

    /// Takes a picture.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn take(&mut self, canvas: &Canvas) -> Result<(), FilmError> {
        match self {
            Self::Gif { path, delay, encoder } => {
                let fault = FilmError::Size { width: canvas.width, height: canvas.height };
                let (Ok(width), Ok(height)) = (u16::try_from(canvas.width), u16::try_from(canvas.height))
                else {
                    return Err(fault);
                };
                if encoder.is_none() {
                    *encoder = Some(Box::new(begin_gif(path, width, height)?));
                }
                let mut picture = gif::Frame::from_rgb_speed(width, height, &canvas.rgb, 12);
                picture.delay = *delay;
                if let Some(encoder) = encoder {
                    encoder.write_frame(&picture)?;
                }
            }
            Self::Pngs { folder, taken } => {
                write_png(canvas, &folder.join(format!("{taken:05}.png")))?;
                *taken += 1;
            }
            #[cfg(feature = "mp4")]
            Self::Mp4 { path, seconds, video } => {
                let video = match video {
                    Some(video) => video,
                    None => video.insert(Box::new(Video::begin(path, *seconds, canvas)?)),
                };
                video.take(canvas)?;
            }
        }
        Ok(())
    }

    /// Ends the film.
    ///
    /// # Errors
    /// The rest of a video cannot be written.
    pub fn finish(self) -> Result<(), FilmError> {
        #[cfg(feature = "mp4")]
        if let Self::Mp4 { video: Some(video), .. } = self {
            video.finish()?;
        }
        Ok(())
    }
}

/// Writes a canvas to a PNG file.
///
/// # Errors
/// The file cannot be written.
pub(super) fn write_png(canvas: &Canvas, path: &Path) -> Result<(), FilmError> {
    let mut frame = Frame::new();
    (frame.width, frame.height) = (canvas.width as u32, canvas.height as u32);
    frame.rgb.extend_from_slice(&canvas.rgb);
    Ok(frame.write_png(path)?)
}

fn begin_gif(path: &Path, width: u16, height: u16) -> Result<gif::Encoder<BufWriter<File>>, FilmError> {
    let file = File::create(path).map_err(|source| FilmError::File { path: path.to_owned(), source })?;
    let mut encoder = gif::Encoder::new(BufWriter::new(file), width, height, &[])?;
    encoder.set_repeat(gif::Repeat::Infinite)?;
    Ok(encoder)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_film_has_as_many_pictures_as_were_taken() {
        let folder = tempfile::tempdir().unwrap();
        let mut canvas = Canvas::default();
        canvas.load(32, 20, &[]);
        let path = folder.path().join("film.gif");
        let mut films = [Film::gif(&path, 0.05), Film::pngs(&folder.path().join("all")).unwrap()];
        for shade in [0, 90, 200] {
            canvas.rgb.fill(shade);
            for film in &mut films {
                film.take(&canvas).unwrap();
            }
        }
        for film in films {
            film.finish().unwrap();
        }
        let mut decoder = gif::DecodeOptions::new().read_info(File::open(&path).unwrap()).unwrap();
        let mut delays = Vec::new();
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            delays.push(frame.delay);
        }
        assert_eq!(delays, [5, 5, 5]);
        assert!(folder.path().join("all/00002.png").is_file());
        assert!(Film::gif(&folder.path().join("no/such.gif"), 0.1).take(&canvas).is_err());
    }
}
